"""Preferences, then their softmax; the probabilities stay closed forms in e."""

import numpy as np

from rldrill.problems.policy_gradient.softmax_policy import Given
from rldrill.solutions.exact import exact
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.policy_gradient import NOT_NORMALISED, PREFERENCE, SOFTMAX_POLICY, WITHOUT_EXP
from rldrill.solutions.softmax import action_features, by_number
from rldrill.solutions.work import Work

MISCONCEPTIONS = (NOT_NORMALISED, WITHOUT_EXP)


def solve(given: Given, work: Work) -> None:
    """The preference of every action, then every probability."""
    actions = tuple(given.features)
    known = by_number([exact(weight) for weight in given.theta]) | action_features({"s": given.features})
    known |= {"s": "s", "choices": actions}
    preferences = work.answer({action: work.step(PREFERENCE, a=action, **known) for action in actions})
    known["H"] = {("s", action): preferences[action] for action in actions}
    work.answer({action: work.step(SOFTMAX_POLICY, a=action, **known) for action in actions})


def oracle(given: Given) -> Answers:
    """A matrix product, then numpy's logarithm of a sum of exponentials."""
    preferences = np.array([[at(value) for value in row] for row in given.features.values()]) @ np.array(
        [at(weight) for weight in given.theta]
    )
    return (preferences, np.exp(preferences - np.logaddexp.reduce(preferences)))
