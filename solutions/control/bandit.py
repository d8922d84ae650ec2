"""Three kinds of bandits: sample averages, upper confidence bounds, and preferences that follow a gradient."""

from typing import Any

import numpy as np

from rldrill.problems.control.bandit import NEXT, Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import decimal, exact
from rldrill.solutions.oracle import Answers, Array, at
from rldrill.solutions.sheet.control import (
    ALL_PULLS_COUNTED,
    ARM_ESTIMATE,
    BANDIT_WITHOUT_EXP,
    BASELINE_FORGOTTEN,
    GRADIENT_BANDIT,
    GRADIENT_BANDIT_POLICY,
    GREEDY_ARM,
    OTHERS_UNCHANGED,
    OWN_COUNT_FORGOTTEN,
    REWARD_BASELINE,
    TIME_FOR_LOG,
    UCB,
    UCB_ARM,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (
    ALL_PULLS_COUNTED,
    TIME_FOR_LOG,
    OWN_COUNT_FORGOTTEN,
    BANDIT_WITHOUT_EXP,
    BASELINE_FORGOTTEN,
    OTHERS_UNCHANGED,
)


def solve(given: Given, work: Work) -> None:
    """What the kind of bandit asks for."""
    known: dict[str, Any] = {
        "A": {number: pull.arm for number, pull in enumerate(given.every_pull, 1)},
        "r": {number: exact(pull.reward) for number, pull in enumerate(given.every_pull, 1)},
        "n": len(given.pulls),
        "choices": given.arms,
    }
    if given.kind == "gradient":
        _gradient(given, work, known)
        return
    known["Q"] = work.answer({arm: work.step(ARM_ESTIMATE, a=arm, **known) for arm in given.arms})
    if given.kind == "estimates":
        work.answer({NEXT: work.step(GREEDY_ARM, n=known["n"], Q=known["Q"], choices=given.arms)})
        return
    assert given.c is not None  # or it would be of another kind
    known |= {
        "t": known["n"] + 1,
        "c": exact(given.c),
        "N": {arm: exact(sum(pull.arm == arm for pull in given.pulls)) for arm in given.arms},
    }
    bounds = work.answer({arm: work.step(UCB, a=arm, **known) for arm in given.arms})
    work.say(f"In decimals: {', '.join(f'$U({arm}) ≈ {decimal(bound, 4)}$' for arm, bound in bounds.items())}.")
    work.answer({NEXT: work.step(UCB_ARM, t=known["t"], U=bounds, choices=given.arms)})


def _gradient(given: Given, work: Work, known: dict[str, Any]) -> None:
    """Probabilities, the baseline, then all preferences at once."""
    known["H"] = knowns.values(given.preferences or {})
    known["pi"] = work.answer({arm: work.step(GRADIENT_BANDIT_POLICY, a=arm, **known) for arm in given.arms})
    known["rbar"] = {known["n"]: work.step(REWARD_BASELINE, r=known["r"], n=known["n"])}
    assert given.alpha is not None  # or it would be of another kind
    known["alpha"] = exact(given.alpha)
    work.answer({arm: work.step(GRADIENT_BANDIT, a=arm, **known) for arm in given.arms})


def oracle(given: Given) -> Answers:
    """Estimates by masks; the gradient step by finite differences of the expected reward's surrogate."""
    rewards = np.array([at(pull.reward) for pull in given.pulls])
    pulled = np.array([[pull.arm == arm for pull in given.pulls] for arm in given.arms])
    if given.preferences is not None and given.alpha is not None and given.pulled is not None:
        H = np.array([at(value) for value in given.preferences.values()])
        arm = given.arms.index(given.pulled.arm)
        surplus = at(given.pulled.reward) - rewards.mean()
        return (np.exp(_log_softmax(H)), H + at(given.alpha) * surplus * _slope(H, arm))
    means = np.array([rewards[mask].mean() for mask in pulled])
    if given.c is None:
        return (means, {NEXT: _best(given, means)})
    bounds = means + at(given.c) * np.sqrt(np.log(len(rewards) + 1) / pulled.sum(axis=1))
    return (means, bounds, {NEXT: _best(given, bounds)})


def _best(given: Given, worth: Array) -> set[str]:
    return {arm for arm, value in zip(given.arms, worth, strict=True) if np.isclose(value, worth.max(), rtol=1e-12)}


def _log_softmax(H: Array) -> Array:
    result: Array = H - np.logaddexp.reduce(H)
    return result


def _slope(H: Array, arm: int) -> Array:
    """The gradient of ln π(arm), by central differences of fourth order."""
    slope = np.zeros(len(H))
    for index, unit in enumerate(np.eye(len(H)) * 1e-3):
        one, two = (_log_softmax(H + k * unit)[arm] - _log_softmax(H - k * unit)[arm] for k in (1, 2))
        slope[index] = (8 * one - two) / 12e-3
    return slope
