"""The discounted features of every trajectory, averaged; one component after the other."""

from typing import Any

from rldrill.problems.exact import shown
from rldrill.problems.inverse_rl.feature_expectations import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import Value, exact
from rldrill.solutions.numerics import Array, np
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
    count = len(runs)
    over = f"the mean over the $m = {count}$ trajectories" if count > 1 else "the sum along the one trajectory"
    work.recall(FEATURE_EXPECTATIONS)
    work.say(f"The expectation is estimated by {over}:")
    if given.estimate is None:
        work.answer(_estimates(work, known, range(1, given.size + 1)))
        return
    (first,) = _estimates(work, known, range(1, 2))
    work.say(f"This estimate is ${shown(given.estimate)}$:")
    known["gamma"] = work.answer(work.equate("gamma", first, exact(given.estimate)))
    rest = _estimates(work, known, range(2, given.size + 1))
    work.answer(rest if len(rest) > 1 else rest[0])


def _estimates(work: Work, known: dict[str, Any], components: range) -> tuple[Value, ...]:
    return tuple(work.step(FEATURE_EXPECTATIONS, component=index, **known) for index in components)


def oracle(given: Given) -> Answers:
    """Horner's scheme along every trajectory, from its end, on whole vectors."""
    if given.estimate is None:
        return (_means(given, at(given.gamma)),)
    at_0, at_1 = (_means(given, gamma)[0] for gamma in (0.0, 1.0))
    gamma = (at(given.estimate) - at_0) / (at_1 - at_0)
    return (gamma, _means(given, gamma)[1:])


def possible(given: Given) -> bool:
    """Whether some discount from 0 to 1 gives the estimate that is printed."""
    return given.estimate is None or bool(-1e-9 <= oracle(given)[0] <= 1 + 1e-9)


def _means(given: Given, gamma: float) -> Array:
    totals = []
    for states in given.trajectories:
        total = np.zeros(len(next(iter(given.features.values()))))
        for state in reversed(states):
            total = np.array([at(value) for value in given.features[state]]) + gamma * total
        totals.append(total)
    means: Array = np.mean(totals, axis=0)
    return means
