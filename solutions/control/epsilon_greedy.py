"""The probability of every action, then their average of the action values."""

from typing import Any

import numpy as np

from rldrill.problems.control.epsilon_greedy import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import Value, exact
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.greedy import epsilon_greedy
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.bellman import V_FROM_Q
from rldrill.solutions.sheet.control import (
    NOT_SPLIT,
    SHARE_FORGOTTEN,
    SHARED_AMONG_OTHERS,
    TIED_SHARE_FORGOTTEN,
    TIED_SHARED_AMONG_OTHERS,
)
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """The probabilities; then, where it is asked for, the state's value."""
    _average(given, work, _chances(given, work, knowns.values(given.values)))


def _chances(given: Given, work: Work, values: dict[str, Value]) -> dict[str, Value]:
    chances: dict[str, Value] = work.answer(epsilon_greedy(work, given.state, values, exact(given.epsilon)))
    return chances


def _average(given: Given, work: Work, chances: dict[str, Value]) -> None:
    if not given.valued:
        return
    known: dict[str, Any] = {
        "pi": {(action, given.state): chance for action, chance in chances.items()},
        "Q": {(given.state, action): value for action, value in knowns.values(given.values).items()},
        "actions": {given.state: tuple(given.values)},
    }
    work.answer(work.step(V_FROM_Q, s=given.state, **known))


@slip(
    "first-of-the-tied",
    "All actions that are tied for the best are greedy; the probability 1 − ε is shared among them.",
    when=lambda given: len(given.best) > 1,
)
def first_of_tied(given: Given, work: Work) -> None:
    """The probabilities as if the other best actions were worth less."""
    values = knowns.values(given.values)
    _average(given, work, _chances(given, work, values | {other: values[other] - 1 for other in given.best[1:]}))


@slip(
    "value-of-the-best-action",
    "The policy explores, so its value averages over all actions; the greatest action value alone is too much.",
    when=lambda given: given.valued,
)
def value_of_best(given: Given, work: Work) -> None:
    """The probabilities; then the greatest action value."""
    values = knowns.values(given.values)
    _chances(given, work, values)
    work.answer(values[given.best[0]])


MISCONCEPTIONS = (
    SHARE_FORGOTTEN,
    SHARED_AMONG_OTHERS,
    TIED_SHARE_FORGOTTEN,
    TIED_SHARED_AMONG_OTHERS,
    NOT_SPLIT,
    first_of_tied,
    value_of_best,
)


def oracle(given: Given) -> Answers:
    """The uniform distribution mixed with that of the greedy choice, as vectors."""
    Q = np.array([at(value) for value in given.values.values()])
    greedy = (max(Q) == Q) / np.count_nonzero(max(Q) == Q)
    chances = at(given.epsilon) * np.full(len(Q), 1 / len(Q)) + (1 - at(given.epsilon)) * greedy
    return (chances, chances @ Q) if given.valued else (chances,)
