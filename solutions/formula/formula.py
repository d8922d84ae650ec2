"""A formula of the sheet, and the mistakes that are made with it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Any

from sympy import Expr

from rldrill.problems.document import Equation
from rldrill.solutions.formula.compiling import value_of
from rldrill.solutions.formula.typesetting import typeset


class Place(Enum):
    """Where a formula stands: on the lecture's sheet, beyond it, or only between the lines of a working."""

    SHEET = "sheet"
    BEYOND = "beyond"
    WORKING = "working"


@dataclass(frozen=True, eq=False)
class Formula:
    """One formula, stated once.

    Args:
        key: its name on the sheet, ``td-zero``.
        left: what it gives.
        right: how, as a sympy expression in textbook order.
        title: what the sheet calls it.
        source: book and equation.
        hint: one sentence for somebody who is stuck.
        sign: ``=``, or ``←`` where it is an update.
        also: further right sides that the sheet prints before the one that is computed with.
        note: what the sheet adds in words.
        hidden: whether the sheet prints only ``also``, since the right side that is computed with names
            intermediate results.
        place: whether the lecture's sheet has it (or needs it to be of use); the printed sheet leaves out what only
            a working needs.
    """

    key: str
    left: Expr
    right: Expr
    title: str
    source: str
    hint: str
    sign: str = "="
    also: tuple[Expr, ...] = ()
    note: str = ""
    hidden: bool = False
    place: Place = Place.SHEET

    def __repr__(self) -> str:
        return f"<formula {self.key}>"

    def equation(self, right: Expr | None = None) -> Equation:
        """The formula typeset, or with another right side: how a mistake reads it."""
        return self._written((*self.also, self.right) if right is None else (right,))

    def printed(self) -> Equation:
        """The formula typeset as the sheet prints it."""
        return self._written(self.also if self.hidden else (*self.also, self.right))

    def _written(self, sides: tuple[Expr, ...]) -> Equation:
        return Equation(
            typeset(self.left), tuple(map(typeset, sides)), (self.sign, *["="] * (len(sides) - 1)), self.key
        )

    def value(self, known: Mapping[str, Any]) -> Any:
        """The exact value for known quantities."""
        return value_of(self.right, known)


@dataclass(frozen=True, eq=False)
class Misconception:
    """A typical mistake.

    Either a formula read with one term changed (``formula`` and ``reads``), or a slip in the procedure:
    then both are None, and the solver asks ``work.makes(SLIP)`` where the procedure forks.

    Args:
        name: a short name, ``forgot-gamma``.
        says: one sentence to the person who made it: what is right instead.
        formula: the formula that is misread.
        reads: the right side that the mistake puts in its place.
        when: for which givens the mistake can be made at all; always, if None.
    """

    name: str
    says: str
    formula: Formula | None = None
    reads: Expr | None = None
    when: Callable[[Any], bool] | None = None

    def __repr__(self) -> str:
        return f"<misconception {self.name}>"

    def applies(self, given: object) -> bool:
        """Whether the mistake can be made in this problem."""
        return self.when is None or self.when(given)


def misread(
    formula: Formula, name: str, reads: Expr, says: str, when: Callable[[Any], bool] | None = None
) -> Misconception:
    """The mistake of reading a formula with one term changed."""
    return Misconception(name, says, formula, reads, when)


def slip(name: str, says: str, when: Callable[[Any], bool] | None = None) -> Misconception:
    """The mistake of going about it the wrong way; solvers ask ``work.makes`` for it."""
    return Misconception(name, says, when=when)
