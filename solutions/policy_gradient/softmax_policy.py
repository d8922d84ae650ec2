"""Preferences, then their softmax; the probabilities stay closed forms in e."""

import numpy as np
import sympy

from rldrill.problems.policy_gradient.softmax_policy import Given
from rldrill.solutions.exact import Value, exact
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.policy_gradient import NOT_NORMALISED, PREFERENCE, SOFTMAX_POLICY, WITHOUT_EXP, entropy
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
    chances = work.answer({action: work.step(SOFTMAX_POLICY, a=action, **known) for action in actions})
    if given.entropy:
        known["pi"] = {(action, "s"): chances[action] for action in actions}
        work.answer(_in_short(work, work.step(entropy(), **known)))


def _in_short(work: Work, value: Value) -> Value:
    """An entropy by the logarithms of prime numbers, where it is a number."""
    if not isinstance(value, sympy.Expr) or value.free_symbols:
        return value
    shorter: Value = sympy.expand_log(value, factor=True)
    if shorter != value:
        work.say("With as few different logarithms as possible:")
        work.give(entropy(), shorter)
    return shorter


def oracle(given: Given) -> Answers:
    """A matrix product, then numpy's logarithm of a sum of exponentials."""
    preferences = np.array([[at(value) for value in row] for row in given.features.values()]) @ np.array(
        [at(weight) for weight in given.theta]
    )
    logarithms = preferences - np.logaddexp.reduce(preferences)
    chances = np.exp(logarithms)
    return (preferences, chances, *([float(-chances @ logarithms)] if given.entropy else []))
