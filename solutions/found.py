"""What was worked out with a letter in it, once the letter is found; equations that are written when somebody looks."""

from collections.abc import Callable
from functools import cached_property
from typing import Any

from sympy import Expr

from rldrill.solutions.exact import value_at
from rldrill.solutions.formula.finding import with_number
from rldrill.solutions.formula.formula import Formula
from rldrill.solutions.formula.putting_in import indexed
from rldrill.solutions.rational import with_found
from rldrill.solutions.value import Value
from rldrill.solutions.work import Equality, Work


class Later(Equality):
    """An equation whose sides are made when somebody looks."""

    def __init__(self, made: Callable[[], tuple[Any, ...]]) -> None:
        self.__dict__["_made"] = made

    @cached_property
    def _sides(self) -> tuple[Any, ...]:
        sides: tuple[Any, ...] = self.__dict__["_made"]()
        return sides

    @property
    def left(self) -> Any:
        """What stands on the left."""
        return self._sides[0]

    @property
    def rights(self) -> tuple[Any, ...]:
        """What stands on the right."""
        return self._sides[1:]


def put_in_found(work: Work, formula: Formula, letter: str, value: Value, found: Value, **indices: Any) -> Value:
    """The value for the number that was found, which is put in in front of the reader.

    Args:
        work: the working.
        formula: the formula whose quantity it is.
        letter: the letter.
        value: what was worked out, in terms of the letter.
        found: the letter's value.
        **indices: those of the quantity.
    """
    work.lines.append(found_line(indexed(formula.left, indices), letter, value, found))
    return with_found(value, found)


def found_line(left: Expr, letter: str, value: Value, found: Value) -> Later:
    """What was worked out in terms of a letter, with the number that was found in its place, and what that is."""
    return Later(lambda: (left, value, with_number([[value]], letter, found), value_at(value, found)))
