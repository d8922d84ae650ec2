"""Ratio, the two terms and their minimum for every sample; then the mean."""

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from rldrill.problems.exact import Weight
from rldrill.problems.policy_gradient.ppo_clip import Given, Sample
from rldrill.solutions.exact import Value, exact, largest, sign, simplest
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.ratios import new_chance, old_chance, outside
from rldrill.solutions.sheet.policy_gradient import (
    CLIP_WITHOUT_MIN,
    PPO,
    PPO_BATCH,
    PPO_CLIPPED,
    PPO_RATIO,
    PPO_UNCLIPPED,
    RATIO_INVERTED,
    SOFTMAX_POLICY,
)
from rldrill.solutions.work import Work


def _smaller(work: Work, known: Mapping[str, Any], time: int) -> Value:
    return work.step(PPO, t=time, **known)


def solve(given: Given, work: Work, objective_of: Callable[[Work, Mapping[str, Any], int], Value] = _smaller) -> None:
    """All samples through one step after the other."""
    times = range(len(given.samples))
    known: dict[str, Any] = {
        "S": {time: sample.state for time, sample in enumerate(given.samples)},
        "A": {time: sample.action for time, sample in enumerate(given.samples)},
        "A_t": {time: exact(sample.advantage) for time, sample in enumerate(given.samples)},
        "epsilon": exact(given.epsilon),
        "samples": tuple(times),
    }
    ratios = []
    for time, sample in enumerate(given.samples):
        pair = sample.action, sample.state
        if sample.preferences and sample.old_preferences:
            work.say(f"The new policy and the old one at time ${time}$:")
        chances = {
            "new_chance": {pair: _chance(work, sample, sample.new, sample.preferences)},
            "old_chance": {pair: _chance(work, sample, sample.old, sample.old_preferences)},
        }
        ratios.append(work.step(PPO_RATIO, t=time, **known, **chances))
    known["rho"] = _given(work, ratios)
    known["unclipped"] = _given(work, [work.step(PPO_UNCLIPPED, t=time, **known) for time in times])
    known["clipped"] = _given(work, [work.step(PPO_CLIPPED, t=time, **known) for time in times])
    objective = {time: objective_of(work, known, time) for time in times}
    work.answer(work.step(PPO_BATCH, L_t=objective, **known) if len(times) > 1 else objective[0])
    for time in times:
        unclipped, clipped = known["unclipped"][time], known["clipped"][time]
        cut = sign(unclipped - clipped) != 0 and sign(objective[time] - clipped) == 0
        work.say(_reason(time, cut=cut, inside=sign(unclipped - clipped) == 0))
        work.answer(cut)


def _reason(time: int, *, cut: bool, inside: bool) -> str:
    if inside:
        return f"The ratio $ρ_{{{time}}}$ lies inside the range, so nothing is clipped and the gradient stays."
    if cut:
        return (
            f"$L_{{{time}}}$ is the clipped term, in which the bound stands for $ρ_{{{time}}}$: it is constant in $θ$."
        )
    return f"$L_{{{time}}}$ is the unclipped term, which still changes with $θ$."


def _given(work: Work, values: Sequence[Value]) -> dict[int, Value]:
    """Answer a number for every sample, and go on with what was answered."""
    if len(values) == 1:
        return {0: work.answer(values[0])}
    return dict(enumerate(work.answer(tuple(values))))


def _chance(work: Work, sample: Sample, chance: Fraction | None, preferences: Mapping[str, Weight] | None) -> Value:
    """How likely a policy makes the action: given, or by its preferences."""
    if preferences is None:
        return exact(chance or 0)
    by_pair = {(sample.state, action): exact(value) for action, value in preferences.items()}
    return simplest(work.step(SOFTMAX_POLICY, s=sample.state, a=sample.action, H=by_pair, choices=tuple(preferences)))


@slip(
    "wrong-side-for-negative-advantage",
    "For a negative advantage the smaller term is the other one: below 1 − ε the ratio is held, above 1 + ε it is not.",
    when=lambda given: any(sample.advantage < 0 and outside(sample, given) for sample in given.samples),
)
def wrong_side(given: Given, work: Work) -> None:
    """The greater of the two terms, where the advantage is negative."""

    def other(work: Work, known: Mapping[str, Any], time: int) -> Value:
        if sign(known["A_t"][time]) < 0:
            return largest((known["unclipped"][time], known["clipped"][time]))
        return _smaller(work, known, time)

    solve(given, work, other)


MISCONCEPTIONS = (CLIP_WITHOUT_MIN, wrong_side, RATIO_INVERTED)


def oracle(given: Given) -> Answers:
    """The objective as a function of the ratio; the gradient is cut where moving the ratio changes nothing."""
    epsilon = at(given.epsilon)

    def objective(ratio: float, advantage: float) -> float:
        # Written by cases: what a better action may gain, and a worse one may lose, is bounded.
        return advantage * (min(ratio, 1 + epsilon) if advantage > 0 else max(ratio, 1 - epsilon))

    ratios = np.array([new_chance(sample) / old_chance(sample) for sample in given.samples])
    advantages = np.array([at(sample.advantage) for sample in given.samples])
    worth = [objective(r, a) for r, a in zip(ratios, advantages, strict=True)]
    answers: list[Any] = [
        ratios,
        ratios * advantages,
        np.minimum(np.maximum(ratios, 1 - epsilon), 1 + epsilon) * advantages,
        np.mean(worth),
    ]
    step = 1e-6
    for ratio, advantage in zip(ratios, advantages, strict=True):
        moved = objective(ratio + step, advantage), objective(ratio - step, advantage)
        answers.append(bool(moved[0] == moved[1]))
    return answers
