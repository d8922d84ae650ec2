"""The policy's mean of the action values, and their greatest."""

from typing import Any

import numpy as np

from rldrill.problems.bellman.value_from_action_values import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import exact
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.bellman import (
    MAX_FOR_MEAN,
    MEAN_OF_Q_STAR,
    PLAIN_MEAN_OF_Q,
    POLICY_FOR_MAX,
    V_FROM_Q,
    V_STAR_FROM_Q,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (MAX_FOR_MEAN, PLAIN_MEAN_OF_Q, MEAN_OF_Q_STAR, POLICY_FOR_MAX)


def solve(given: Given, work: Work) -> None:
    """Both from the same table."""
    known: dict[str, Any] = {
        "Q": {(state, action): exact(value) for state, row in given.values.items() for action, value in row.items()},
        "actions": {state: tuple(row) for state, row in given.values.items()},
        "pi": knowns.policy(given.policy),
    }
    work.answer({state: work.step(V_FROM_Q, s=state, **known) for state in given.values})
    if not given.parameters():
        work.answer({state: work.step(V_STAR_FROM_Q, s=state, **known) for state in given.values})


def oracle(given: Given) -> Answers:
    """Row by row, a product of vectors; the greatest by sorting."""
    mean = [
        np.dot([at(value) for value in row.values()], [at(given.policy[state].get(action, 0)) for action in row])
        for state, row in given.values.items()
    ]
    best = [sorted(map(at, row.values()))[-1] for row in given.values.values()]
    return (mean,) if given.parameters() else (mean, best)
