"""What is left open, found from a value that updates lead to."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias

from rldrill.problems.asking_back import AskingBack, Outcome
from rldrill.problems.exact import Parameter, shown
from rldrill.solutions.exact import Value, exact
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.work import Work

Pair: TypeAlias = tuple[str, str]


def find(work: Work, outcome: Outcome, letter: str, Q: Mapping[Any, Value]) -> None:
    """Set what a pair is worth, an expression in the letter, equal to its value; the letter's value is the answer.

    Raises:
        NoSolution: no value of the letter leads there, every one does, or the equation is not linear.
    """
    work.say(f"The value of ({outcome.state}, {outcome.action}) has to be ${shown(outcome.value)}$:")
    work.answer(work.equate(letter, Q[outcome.state, outcome.action], exact(outcome.value)))


def answer_along(given: AskingBack, work: Work, Q: Mapping[Any, Value], pairs: Sequence[Pair]) -> None:
    """Answer with what these pairs are worth after a run; or with what follows from what one of them is worth."""
    if given.outcome:
        find(work, given.outcome, given.asked_for, Q)
    else:
        work.answer({pair: Q[pair] for pair in pairs})


def asks_for(given: Any, letter: str) -> bool:
    """Whether this letter follows from a value in the end, so that whoever leaves it out has no answer."""
    return getattr(given, "outcome", None) is not None and given.asked_for == letter


def oracle_along(given: AskingBack, learned: Callable[[Any], Answers], pairs: Sequence[Pair]) -> Answers:
    """What is learned; or the parameter at which the value of a pair, which is linear in it, is what it is in the end.

    Args:
        given: the problem.
        learned: the answers where nothing is asked back, in the last of which the values of the pairs stand.
        pairs: these pairs, in their order.
    """
    if given.outcome is None:
        return learned(given)
    field = next(name for name in type(given).model_fields if isinstance(getattr(given, name), Parameter))
    place = pairs.index((given.outcome.state, given.outcome.action))
    at_0, at_1 = (
        float(learned(given.model_copy(update={field: number, "outcome": None}))[-1][place]) for number in (0, 1)
    )
    return ((at(given.outcome.value) - at_0) / (at_1 - at_0),)
