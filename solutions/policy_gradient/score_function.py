"""The probabilities, where weights are given; then each action's features minus the expected ones."""

from collections.abc import Mapping

import numpy as np

from rldrill.problems.policy_gradient.score_function import Given
from rldrill.solutions.exact import Value, exact
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.policy_gradient import EXPECTED_ADDED, FEATURES_ALONE
from rldrill.solutions.softmax import action_features, by_number, chances, log_gradient, score
from rldrill.solutions.work import Work

MISCONCEPTIONS = (FEATURES_ALONE, EXPECTED_ADDED)


def solve(given: Given, work: Work) -> None:
    """One state, written s."""
    actions = tuple(given.features)
    known = action_features({"s": given.features})
    probabilities: Mapping[str, Value]
    if given.theta is None:
        probabilities = {action: exact(chance) for action, chance in (given.policy or {}).items()}
    else:
        known |= by_number([exact(weight) for weight in given.theta])
        worked_out = chances(work, known, "s", actions)
        probabilities = work.answer({action: worked_out[action, "s"] for action in actions})
    known["pi"] = {(action, "s"): chance for action, chance in probabilities.items()}
    for action in given.asked:
        work.answer(tuple(score(work, known, "s", action, actions)))


def oracle(given: Given) -> Answers:
    """The logarithm of the probability, differentiated by a complex step.

    Where only probabilities are given, the logarithms are differentiated at preferences that give them.
    """
    features = np.array([[at(value) for value in row] for row in given.features.values()])
    answers = []
    if given.theta is None:
        chance = np.array([at(number) for number in (given.policy or {}).values()])
        with np.errstate(divide="ignore"):
            present = np.log(chance)
        theta = np.zeros(features.shape[1])
    else:
        theta = np.array([at(weight) for weight in given.theta])
        present = np.zeros(len(features))
        preferences = features @ theta
        answers.append(np.exp(preferences - np.logaddexp.reduce(preferences)))
    for action in given.asked:
        answers.append(log_gradient(theta, given.features, action, present))
    return answers
