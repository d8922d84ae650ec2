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
    FEATURES_ALONG,
    FEATURES_EARLY,
    FEATURES_ESTIMATED,
    FEATURES_SUMMED,
    FEATURES_UNDISCOUNTED,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (FEATURES_UNDISCOUNTED, FEATURES_EARLY, FEATURES_SUMMED)


def solve(given: Given, work: Work) -> None:
    """The estimates of all components; where the discount is asked for, it follows from the first."""
    runs = dict(enumerate(given.trajectories, 1))
    known: dict[str, Any] = {
        "gamma": exact(given.gamma),
        "phi": knowns.features(given.features),
        "visited": {(time, run): state for run, states in runs.items() for time, state in enumerate(states)},
        "last": {run: len(states) - 1 for run, states in runs.items()},
        "trajectories": tuple(runs),
        "runs": exact(len(runs)),
    }
    work.recall(FEATURE_EXPECTATIONS)
    mean = f"mean over the $m = {len(runs)}$ trajectories, whose sums come first"
    several = mean if len(runs) > 1 else "sum along the one trajectory"
    work.say(f"The expectation is estimated by the {several}:")
    if given.estimate is None:
        work.answer(_estimates(work, known, range(1, given.size + 1)))
        return
    (first,) = _estimates(work, known, range(1, 2))
    work.say(f"This estimate is ${shown(given.estimate)}$:")
    known["gamma"] = work.answer(work.equate("gamma", first, exact(given.estimate)))
    rest = _estimates(work, known, range(2, given.size + 1))
    work.answer(rest if len(rest) > 1 else rest[0])


def _estimates(work: Work, known: dict[str, Any], components: range) -> tuple[Value, ...]:
    """Component by component, the sums of all trajectories and their mean."""
    runs = known["trajectories"]
    estimates = []
    for index in components:
        sums = {(index, run): work.step(FEATURES_ALONG, component=index, run=run, **known) for run in runs}
        estimates.append(work.step(FEATURES_ESTIMATED, component=index, mu_along=sums, **known))
    return tuple(estimates)


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
