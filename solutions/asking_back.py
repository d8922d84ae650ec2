"""What is left open, found from a value that updates lead to."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias

from rldrill.problems.asking_back import AskingBack, BackMoves, BackRun, Outcome, Rows, rival
from rldrill.problems.exact import Parameter, shown
from rldrill.solutions.exact import Value, exact
from rldrill.solutions.oracle import Answers, at, root_between
from rldrill.solutions.work import Work

Pair: TypeAlias = tuple[str, str]


def find(given: AskingBack, outcome: Outcome, work: Work, Q: Mapping[Any, Value], table: Rows, of: str = "Q") -> None:
    """Set what a pair is worth, an expression in the letter, equal to its value; the letter's value is the answer.

    Args:
        given: the run.
        outcome: what the pair is worth in the end.
        work: where the steps are written.
        Q: what pairs are worth in the end.
        table: the action values before the run; another action there may be as good in the end.
        of: how they are called.

    Raises:
        NoSolution: no value of the letter leads there, every one does, or the equation is not linear.
    """
    state, action, value = outcome
    other = rival(given, outcome, table)
    why = f', as ${of}("{state}", "{other}")$ is, which no update changes' if other else ""
    work.say(f'${of}("{state}", "{action}")$ must be ${shown(value)}${why}:')
    work.answer(work.equate(given.asked_for, Q[state, action], exact(value)))


def answer_along(given: BackRun | BackMoves, work: Work, Q: Mapping[Any, Value], pairs: Sequence[Pair]) -> None:
    """Answer with what these pairs are worth after a run; or with what follows from what one of them is worth."""
    if given.outcome:
        find(given, given.outcome, work, Q, given.values)
    else:
        work.answer({pair: Q[pair] for pair in pairs})


def asks_for(given: Any, letter: str) -> bool:
    """Whether this letter follows from a value in the end, so that whoever leaves it out has no answer."""
    return getattr(given, "outcome", None) is not None and given.asked_for == letter


def oracle_along(given: AskingBack, learned: Callable[[Any], Answers], pairs: Sequence[Pair]) -> Answers:
    """What is learned; or the parameter at which the value of a pair is what it is in the end.

    Args:
        given: the problem.
        learned: the answers where nothing is asked back, in the last of which the values of the pairs stand.
        pairs: these pairs, in their order.
    """
    if given.outcome is None:
        return learned(given)
    field = next(name for name in type(given).model_fields if isinstance(getattr(given, name), Parameter))
    place = pairs.index((given.outcome.state, given.outcome.action))
    value = at(given.outcome.value)
    return (root_between(lambda trial: float(learned(_with(given, field, trial))[-1][place]) - value),)


def _with(given: AskingBack, field: str, number: float) -> AskingBack:
    return given.model_copy(update={field: number, "outcome": None})
