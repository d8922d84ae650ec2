"""The discounted features of every trajectory, averaged; one component after the other."""

from typing import Any

import numpy as np

from rldrill.problems.inverse_rl.feature_expectations import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import exact
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.inverse_rl import (
    FEATURE_EXPECTATIONS,
    FEATURES_EARLY,
    FEATURES_SUMMED,
    FEATURES_UNDISCOUNTED,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (FEATURES_UNDISCOUNTED, FEATURES_EARLY, FEATURES_SUMMED)


def solve(given: Given, work: Work) -> None:
    """One application for every component."""
    runs = dict(enumerate(given.trajectories))
    known: dict[str, Any] = {
        "gamma": exact(given.gamma),
        "phi": knowns.features(given.features),
        "visited": {(time, run): state for run, states in runs.items() for time, state in enumerate(states)},
        "last": {run: len(states) - 1 for run, states in runs.items()},
        "trajectories": tuple(runs),
    }
    size = len(next(iter(given.features.values())))
    work.answer(tuple(work.step(FEATURE_EXPECTATIONS, component=index, **known) for index in range(1, size + 1)))


def oracle(given: Given) -> Answers:
    """Horner's scheme along every trajectory, from its end, on whole vectors."""
    gamma = at(given.gamma)
    totals = []
    for states in given.trajectories:
        total = np.zeros(len(next(iter(given.features.values()))))
        for state in reversed(states):
            total = np.array([at(value) for value in given.features[state]]) + gamma * total
        totals.append(total)
    return (np.mean(totals, axis=0),)
