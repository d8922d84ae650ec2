"""The probability of every action, then their average of the action values."""

from typing import Any

import numpy as np

from rldrill.problems.control.epsilon_greedy import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import exact
from rldrill.solutions.formula.formula import fork
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

FIRST_OF_TIED = fork(
    "first-of-the-tied",
    "All actions that are tied for the best are greedy; the probability 1 − ε is shared among them.",
    when=lambda given: len(given.best) > 1,
)
VALUE_OF_BEST = fork(
    "value-of-the-best-action",
    "The policy explores, so its value averages over all actions; the greatest action value alone is too much.",
    when=lambda given: given.valued,
)
MISCONCEPTIONS = (
    SHARE_FORGOTTEN,
    SHARED_AMONG_OTHERS,
    TIED_SHARE_FORGOTTEN,
    TIED_SHARED_AMONG_OTHERS,
    NOT_SPLIT,
    FIRST_OF_TIED,
    VALUE_OF_BEST,
)


def solve(given: Given, work: Work) -> None:
    """The probabilities; then, where it is asked for, the state's value."""
    values = knowns.values(given.values)
    seen = values
    if work.makes(FIRST_OF_TIED):  # as if the others that are tied were worth less
        seen = values | {action: values[action] - 1 for action in given.best[1:]}
    chances = work.answer(epsilon_greedy(work, given.state, seen, exact(given.epsilon)))
    if not given.valued:
        return
    if work.makes(VALUE_OF_BEST):
        work.answer(values[given.best[0]])
        return
    known: dict[str, Any] = {
        "pi": {(action, given.state): chance for action, chance in chances.items()},
        "Q": {(given.state, action): value for action, value in values.items()},
        "actions": {given.state: tuple(values)},
    }
    work.answer(work.step(V_FROM_Q, s=given.state, **known))


def oracle(given: Given) -> Answers:
    """The uniform distribution mixed with that of the greedy choice, as vectors."""
    Q = np.array([at(value) for value in given.values.values()])
    greedy = (max(Q) == Q) / np.count_nonzero(max(Q) == Q)
    chances = at(given.epsilon) * np.full(len(Q), 1 / len(Q)) + (1 - at(given.epsilon)) * greedy
    return (chances, chances @ Q)
