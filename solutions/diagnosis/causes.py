"""What somebody may have done, and what comes of it."""

from collections.abc import Callable, Mapping
from typing import Any

from msgspec import Struct
from sympy import Expr

from rldrill.solutions.diagnosis.replay import Application
from rldrill.solutions.formula.edits import Edit, Probe
from rldrill.solutions.formula.formula import Formula, Misconception


class Cause(Struct, frozen=True, eq=False):
    """One way to err, at one place or everywhere.

    Args:
        kind: what was done, a name.
        weight: how likely it is.
        application: where it was done; None where it was done all along.
        formula: the formula that it was done to, if any.
        edit: how that was edited, if it was.
        probe: the place in it whose value is another one, if there is one.
        term: the term of a sum that it was done in alone, its letters' values.
        nth: the number of that term, from 0, where it was done in every sum.
        was: the value that was right, of the place in the formula if there is one, else of the application.
        other: the value that was put in for it.
        became: the value that came out of the application.
        what: of what else is said what it was.
        mistake: the listed mistake that it is, if it is one.
        on_paper: whether it was done to the answer, behind the working.
        then: what was done besides.
        always: whether it was done wherever the quantity of the application is worked out, in every sweep.
        time: the time at which it was done in every step by the formula of the application.
        here: the part that it was done in alone, though the same was done rightly before; empty where it was not.
        anew: the part before whose right answer it does not go on from; empty where it denies none.
    """

    kind: str
    weight: float
    application: Application | None = None
    formula: Formula | None = None
    edit: Edit | None = None
    probe: Probe | None = None
    term: tuple[Any, ...] = ()
    was: Any = None
    other: Any = None
    became: Any = None
    what: str = ""
    nth: int | None = None
    mistake: Misconception | None = None
    on_paper: bool = False
    then: "Cause | None" = None
    always: bool = False
    time: int | None = None
    here: str = ""
    anew: str = ""

    @property
    def part(self) -> Expr | None:
        """The part of a formula that was changed; None where it is all of a step, or the answer."""
        return self.edit.part if self.edit is not None else self.probe.part if self.probe is not None else None


#: The answers that a cause leads to, for somebody who goes on from these answers to earlier parts.
Again = Callable[[Mapping[str, Any]], Mapping[str, Any] | None]


class Candidate(Struct, frozen=True, eq=False):
    """A cause, the answers that it leads to, and how to get those that it leads to from other earlier ones."""

    cause: Cause
    answers: Mapping[str, Any]
    again: Again
