"""PPO's probability ratios in floating point: for the independent solver, and for what can be told apart."""

import math
from collections.abc import Mapping

from rldrill.problems.exact import Weight, needed
from rldrill.problems.policy_gradient.ppo_clip import Given, Sample
from rldrill.solutions.oracle import at


def new_chance(sample: Sample) -> float:
    """How likely the new policy makes the action."""
    return at(needed(sample.new)) if sample.preferences is None else _softmax(sample.preferences, sample.action)


def old_chance(sample: Sample) -> float:
    """How likely the old policy made the action."""
    return at(needed(sample.old)) if sample.old_preferences is None else _softmax(sample.old_preferences, sample.action)


def _softmax(preferences: Mapping[str, Weight], action: str) -> float:
    weights = {name: math.exp(at(value)) for name, value in preferences.items()}
    return weights[action] / math.fsum(weights.values())


def outside(sample: Sample, given: Given) -> int:
    """On which side of the clipping range the ratio lies: −1 below, 1 above, 0 inside or at its edge."""
    ratio, epsilon = new_chance(sample) / old_chance(sample), at(needed(given.epsilon))
    margin = 1e-9
    return (ratio > 1 + epsilon + margin) - (ratio < 1 - epsilon - margin)


def keeps_the_worse(sample: Sample, given: Given) -> bool:
    """Whether clipping would make the objective look better, so that the minimum keeps the unclipped term."""
    return outside(sample, given) * sample.advantage < 0
