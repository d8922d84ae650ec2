"""What is left open, found from a value that updates lead to."""

from collections.abc import Callable, Mapping
from typing import Any

from rldrill.problems.asking_back import BackMoves, BackRun, Outcome
from rldrill.problems.exact import Parameter, shown
from rldrill.solutions.exact import Value, exact
from rldrill.solutions.oracle import at
from rldrill.solutions.work import Work


def find(work: Work, outcome: Outcome, letter: str, Q: Mapping[Any, Value]) -> None:
    """Set what a pair is worth, an expression in the letter, equal to its value; the letter's value is the answer.

    Raises:
        NoSolution: no value of the letter leads there, every one does, or the equation is not linear.
    """
    work.say(f"The value of ({outcome.state}, {outcome.action}) must be ${shown(outcome.value)}$:")
    work.answer(work.equate(letter, Q[outcome.state, outcome.action], exact(outcome.value)))


def asks_for(given: Any, letter: str) -> bool:
    """Whether this letter follows from a value in the end, so that whoever leaves it out has no answer."""
    return getattr(given, "outcome", None) is not None and given.asked_for == letter


def on_a_line(given: BackRun | BackMoves, outcome: Outcome, value: Callable[[Any], float]) -> float:
    """The parameter at which a value that is linear in it is what it is in the end, from its values at 0 and at 1."""
    field = next(name for name in type(given).model_fields if isinstance(getattr(given, name), Parameter))
    at_0, at_1 = (value(given.model_copy(update={field: number, "outcome": None})) for number in (0, 1))
    return (at(outcome.value) - at_0) / (at_1 - at_0)
