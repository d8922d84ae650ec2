"""A formula of the sheet, and the mistakes that are made with it."""

from collections.abc import Callable, Mapping
from enum import Enum
from functools import cached_property, lru_cache
from typing import Any

from msgspec import Struct, field
from msgspec.structs import replace
from sympy import Expr

from rldrill.problems.document import Equation
from rldrill.problems.mathematics import Math
from rldrill.solutions.formula.compiling import value_of
from rldrill.solutions.formula.typesetting import typeset


class Place(Enum):
    """Where a formula stands: on the lecture's sheet, beyond it, or only between the lines of a working."""

    SHEET = "sheet"
    BEYOND = "beyond"
    WORKING = "working"


class Misconception(Struct, frozen=True, eq=False, dict=True):
    """A typical mistake; two of one name that say the same are the same mistake.

    Either formulas are misread: then they say how (``Formula.misread``). Or it is a slip in the procedure: then
    ``solve`` is the way that somebody goes who makes it.

    Args:
        name: a short name, ``forgot-gamma``.
        says: one sentence to the person who made it: what is right instead.
        when: for which givens the mistake can be made at all; always, if None.
        solve: the family's solver with the slip in it.
        may_hide: whether it is not made where the numbers hide it; else such a draw is thrown away.
    """

    name: str
    says: str
    when: Callable[[Any], bool] | None = None
    solve: Callable[[Any, Any], None] | None = None
    may_hide: bool = False

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Misconception) and self.key == other.key

    def __hash__(self) -> int:
        return hash(self.name)

    def __repr__(self) -> str:
        return f"<misconception {self.name}>"

    def __reduce__(self) -> tuple[Any, ...]:
        """In another process it is told, not made: what it says goes there, and no code."""
        return Misconception, self.key

    @cached_property
    def key(self) -> tuple[str, str]:
        """What tells it from others, in a form that is quickly looked up."""
        return self.name, self.says

    @property
    def is_slip(self) -> bool:
        """Whether it is made in the procedure, not in reading a formula."""
        return self.solve is not None

    def applies(self, given: object) -> bool:
        """Whether the mistake can be made in this problem."""
        return self.when is None or self.when(given)

    def where_it_shows(self) -> "Misconception":
        """The same, for families whose numbers may hide it: there it is not made, and the draw is not thrown away."""
        return replace(self, may_hide=True)


def slip(
    name: str, says: str, when: Callable[[Any], bool] | None = None
) -> Callable[[Callable[[Any, Any], None]], Misconception]:
    """Make the wrong way through a problem the mistake of going it: decorates a variant of the family's ``solve``."""
    return lambda solve: Misconception(name, says, when, solve)


class Formula(Struct, frozen=True, eq=False, dict=True):
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
        misread: the mistakes that are made in reading it, each with the right side that it puts in the place of
            the right one; a mistake that other formulas are read with, too, stands with each of them.
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
    misread: Mapping[Misconception, Expr] = field(default_factory=dict)

    def __repr__(self) -> str:
        return f"<formula {self.key}>"

    @cached_property
    def readings(self) -> Mapping[tuple[str, str], Expr]:
        """How each mistake reads it, by the mistake's key: every step of every mistake asks for it."""
        return {mistake.key: right for mistake, right in self.misread.items()}

    def equation(self, right: Expr | None = None) -> Equation:
        """The formula typeset, or with another right side: how a mistake reads it."""
        return self._written((*self.also, self.right) if right is None else (right,))

    def printed(self) -> Equation:
        """The formula typeset as the sheet prints it."""
        return self._written(self.also if self.hidden else (*self.also, self.right))

    def _written(self, sides: tuple[Expr, ...]) -> Equation:
        left, *rights = _typeset(self.left, *sides)
        return Equation(left, tuple(rights), (self.sign, *["="] * (len(sides) - 1)), self.key)

    def value(self, known: Mapping[str, Any]) -> Any:
        """The exact value for known quantities."""
        return value_of(self.right, known)


@lru_cache(maxsize=1024)
def _typeset(*sides: Expr) -> tuple[Math, ...]:
    """The sides of a formula; the same formulas are written again and again."""
    return tuple(map(typeset, sides))
