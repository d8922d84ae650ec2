"""The value of a letter from what comes out: exactly from an equation, independently from two trials."""

from collections.abc import Callable
from fractions import Fraction
from typing import Any, TypeVar

from rldrill.problems.reversible import Reversible
from rldrill.solutions.exact import Value, exact
from rldrill.solutions.oracle import at
from rldrill.solutions.work import Work

Given = TypeVar("Given", bound=Reversible)

#: Two numbers that any letter may stand for: between 0 and 1.
_TRIALS = Fraction(1, 4), Fraction(3, 4)


def find(given: Reversible, work: Work, value: Value) -> Value:
    """Answer with the number for the letter that makes the value, worked out with the letter in it, what is known."""
    return work.answer(work.equate(given.letter, value, exact(given.known or 0)))


def tried(given: Given, outcome: Callable[[Given], float]) -> float:
    """The number for the letter, where a straight line through the outcomes of two trials reaches what is known."""
    low, high = (outcome(with_letter(given, trial)) for trial in _TRIALS)
    first, second = map(float, _TRIALS)
    return first + (second - first) * (at(given.known or 0) - low) / (high - low)


def with_letter(given: Given, number: Fraction) -> Given:
    """The problem with a number for its letter, and nothing known of what comes out."""
    data = given.model_dump(mode="json", exclude_none=True, exclude={"known"})
    return type(given).model_validate(_replaced(data, given.letter, str(number)))


def _replaced(data: Any, letter: str, number: str) -> Any:
    if isinstance(data, dict):
        return {key: _replaced(inner, letter, number) for key, inner in data.items()}
    if isinstance(data, list):
        return [_replaced(inner, letter, number) for inner in data]
    if data == f"1-{letter}":
        return str(1 - Fraction(number))
    return number if data == letter else data
