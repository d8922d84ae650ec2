"""Ratio, the two terms and their minimum for every sample; then the mean."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

from msgspec.structs import replace

from rldrill.problems.exact import Weight, needed, shown
from rldrill.problems.fractions import Fraction
from rldrill.problems.policy_gradient.ppo_clip import CUT, Given, Sample
from rldrill.solutions.exact import ZERO, NoSolution, Value, absolute, equals, exact, largest, sign, simplest, told
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.rational import generator
from rldrill.solutions.ratios import new_chance, old_chance, outside
from rldrill.solutions.sheet.policy_gradient import (
    CLIP_WITHOUT_MIN,
    CLIPPED_ABOVE_ALONE,
    GREATER_TERM,
    NOT_AVERAGED,
    PPO,
    PPO_AT_THE_LOWER_BOUND,
    PPO_AT_THE_UPPER_BOUND,
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
    """All samples through one step after the other; or the clipping range, from what is known of the objective."""
    times = range(len(given.samples))
    known: dict[str, Any] = {
        "S": {time: sample.state for time, sample in enumerate(given.samples)},
        "A": {time: sample.action for time, sample in enumerate(given.samples)},
        "A_t": {time: exact(sample.advantage) for time, sample in enumerate(given.samples)},
        "epsilon": generator("epsilon") if given.epsilon is None else exact(given.epsilon),
        "samples": tuple(times),
    }
    known["rho"] = _given(work, [_ratio(work, sample, known, time) for time, sample in enumerate(given.samples)])
    if given.epsilon is None and given.objective is None:
        _thresholds(work, known)
        return
    unclipped = [work.step(PPO_UNCLIPPED, t=time, **known) for time in times]
    if len(times) == 1 and given.epsilon is not None:
        both = work.answer((unclipped[0], _clipped(work, known, 0)))
        known |= {"unclipped": {0: both[0]}, "clipped": {0: both[1]}}
    else:
        known["unclipped"] = _given(work, unclipped)
        if given.objective is not None:
            _from_the_objective(work, known, exact(given.objective))
            return
        known["clipped"] = _given(work, [_clipped(work, known, time) for time in times])
    objective = {time: objective_of(work, known, time) for time in times}
    work.answer(work.step(PPO_BATCH, L_t=objective, **known) if len(times) > 1 else objective[0])
    cuts = []
    for time in times:
        unclipped, clipped = known["unclipped"][time], known["clipped"][time]
        cuts.append(sign(unclipped - clipped) != 0 and sign(objective[time] - clipped) == 0)
        if sign(known["A_t"][time]) == 0:
            work.say(f"$A_{{{time}}} = 0$, so both terms are $0$ and have no gradient, clipped or not.")
        else:
            work.say(_reason(time, cut=cuts[-1], inside=sign(unclipped - clipped) == 0))
    verdict = _told(cuts)
    if isinstance(verdict, str):
        work.say(f"So the answer is: {CUT[verdict]}.")
    work.answer(verdict)


def _told(cuts: Sequence[bool]) -> Any:
    """Which gradients are cut off, as it is asked for: yes or no, an option, or of many samples how many."""
    if len(cuts) == 1:
        return cuts[0]
    return "ABCD"[cuts[0] + 2 * cuts[1]] if len(cuts) == len(CUT) // 2 else ZERO + sum(cuts)


def _ratio(work: Work, sample: Sample, known: Mapping[str, Any], time: int) -> Value:
    pair = sample.action, sample.state
    if sample.preferences and sample.old_preferences:
        work.say(f"The new policy and the old one at time ${time}$:")
    chances = {
        "new_chance": {pair: _chance(work, sample, sample.new, sample.preferences)},
        "old_chance": {pair: _chance(work, sample, sample.old, sample.old_preferences)},
    }
    ratio: Value = work.step(PPO_RATIO, t=time, **known, **chances)
    return ratio


def _clipped(work: Work, known: Mapping[str, Any], time: int) -> Value:
    """The clipped term; before it, which number stands for the ratio."""
    ratio, low, high = known["rho"][time], 1 - known["epsilon"], 1 + known["epsilon"]
    rho = f"$ρ_{{{time}}} = {shown(ratio)}$"
    if sign(ratio - low) < 0:
        work.say(f"{rho} lies below $1 − ε = {shown(low)}$, so $ρ_{{{time}}}$ is clipped to ${shown(low)}$:")
    elif sign(high - ratio) < 0:
        work.say(f"{rho} lies above $1 + ε = {shown(high)}$, so $ρ_{{{time}}}$ is clipped to ${shown(high)}$:")
    else:
        work.say(f"{rho} lies between $1 − ε = {shown(low)}$ and $1 + ε = {shown(high)}$, so it stays as it is:")
    clipped: Value = work.step(PPO_CLIPPED, t=time, **known)
    return clipped


def _reason(time: int, *, cut: bool, inside: bool) -> str:
    if inside:
        return (
            f"$ρ_{{{time}}}$ lies inside the range: nothing is clipped, and clipping does not make "
            f"$∇_θ L_{{{time}}}$ zero."
        )
    if cut:
        return (
            f"$c_{{{time}}}$ is the smaller term. In it $ρ_{{{time}}}$ is replaced by the bound, which does not "
            f"depend on $θ$: clipping makes $∇_θ L_{{{time}}}$ zero."
        )
    return f"$u_{{{time}}}$ is the smaller term, which depends on $θ$: clipping does not make $∇_θ L_{{{time}}}$ zero."


def _can_be_cut(known: Mapping[str, Any], time: int) -> bool:
    """Whether a better action is likelier now, or a worse one less likely: then some ε cuts off the gradient."""
    return sign(known["rho"][time] - 1) * sign(known["A_t"][time]) > 0


def _thresholds(work: Work, known: Mapping[str, Any]) -> None:
    """Below which ε every gradient is cut off, and what is left of the objective where all of them are."""
    for formula in (PPO_UNCLIPPED, PPO_CLIPPED, PPO):
        work.recall(formula)
    known = {**known, "unclipped": {}}
    bounds: dict[int, Value] = {}
    for time, ratio in known["rho"].items():
        known["unclipped"][time] = work.step(PPO_UNCLIPPED, t=time, **known)
        wanted, moved = _ADVANTAGE[sign(known["A_t"][time])], _LIKELY[sign(ratio - 1)]
        said = f"The advantage $A_{{{time}}}$ is {wanted}, and the action {moved}"
        if not _can_be_cut(known, time):
            work.say(f"{said}: $u_{{{time}}}$ is never the larger term, so no $ε$ cuts off this gradient: $0$.")
            bounds[time] = ZERO
            continue
        bound = "upper" if sign(ratio - 1) > 0 else "lower"
        work.say(f"{said}: the {bound} bound stands for $ρ_{{{time}}}$ until the term is as large as $u_{{{time}}}$:")
        bounds[time] = work.equate("epsilon", _at_the_bound(work, known, time), known["unclipped"][time])
    _given(work, list(bounds.values()))
    left = {}
    work.say("As $ε$ goes to $0$:")
    for time in bounds:
        if _can_be_cut(known, time):
            left[time] = _at_the_bound(work, {**known, "epsilon": ZERO}, time, "→")
        else:
            left[time] = known["unclipped"][time]
            work.say(f"$L_{{{time}}}$ stays the unclipped term, $u_{{{time}}} {equals(left[time])}$.")
    work.answer(work.step(PPO_BATCH, L_t=left, sign="→", **known) if len(left) > 1 else left[0])


def _at_the_bound(work: Work, known: Mapping[str, Any], time: int, relation: str = "=") -> Value:
    """An objective whose ratio is clipped, with the bound that stands for the ratio."""
    above = sign(known["rho"][time] - 1) > 0
    formula = PPO_AT_THE_UPPER_BOUND if above else PPO_AT_THE_LOWER_BOUND
    held: Value = work.step(formula, t=time, sign=relation, **known)
    return held


#: By the sign of the advantage, and of the ratio less 1.
_ADVANTAGE = {1: "positive", 0: "$0$", -1: "negative"}
_LIKELY = {1: "has become more likely", 0: "is as likely as before", -1: "has become less likely"}


def _from_the_objective(work: Work, known: Mapping[str, Any], objective: Value) -> None:
    """The one objective that clipping can change is linear in ε; the others are the unclipped terms."""
    times = known["samples"]
    cut = [time for time in times if _can_be_cut(known, time)]
    if len(cut) != 1:
        raise NoSolution("the objective tells ε only where clipping can cut off the gradient of exactly one sample")
    (one,) = cut
    above = sign(known["rho"][one] - 1) > 0
    unclipped = sum(known["unclipped"].values(), ZERO) / len(times)
    work.say(
        f"Clipping lowers an objective only where the advantage is positive and the ratio above $1$, or the advantage "
        f"negative and the ratio below $1$. That is so at $t = {one}$ alone; the other objectives are the unclipped "
        f"terms. The mean of all unclipped terms is ${told(unclipped)}$, but $L {equals(objective)}$ is less by "
        f"${told(unclipped - objective)}$, so "
        f"$ρ_{{{one}}}$ is clipped. For such a sample:"
    )
    held = _at_the_bound(work, known, one)
    mean = work.step(PPO_BATCH, L_t={**known["unclipped"], one: held}, **known)
    epsilon = work.equate("epsilon", mean, objective)
    if sign(epsilon) <= 0 or sign(absolute(known["rho"][one] - 1) - epsilon) <= 0:
        raise NoSolution("no ε gives this objective")
    edge, side = (1 + epsilon, "above $1 + ε") if above else (1 - epsilon, "below $1 − ε")
    ratio = equals(known["rho"][one])
    work.say(f"With this $ε$ the ratio $ρ_{{{one}}} {ratio}$ lies {side} {equals(edge)}$: it is clipped indeed.")
    work.answer(epsilon)


def _given(work: Work, values: Sequence[Value]) -> dict[int, Value]:
    """Answer a number for every sample, and go on with what was answered."""
    if len(values) == 1:
        return {0: work.answer(values[0])}
    return dict(enumerate(work.answer(tuple(values))))


def _chance(work: Work, sample: Sample, chance: Fraction | None, preferences: Mapping[str, Weight] | None) -> Value:
    """How likely a policy makes the action: given, or by its preferences."""
    if preferences is None:
        return exact(needed(chance))
    by_pair = {(sample.state, action): exact(value) for action, value in preferences.items()}
    return simplest(work.step(SOFTMAX_POLICY, s=sample.state, a=sample.action, H=by_pair, choices=tuple(preferences)))


@slip(
    "wrong-side-for-negative-advantage",
    "For a negative advantage the smaller term is the other one: the ratio is clipped below 1 − ε, not above 1 + ε.",
    when=lambda given: (
        given.epsilon is not None and any(sample.advantage < 0 and outside(sample, given) for sample in given.samples)
    ),
)
def wrong_side(given: Given, work: Work) -> None:
    """The greater of the two terms, where the advantage is negative."""

    def other(work: Work, known: Mapping[str, Any], time: int) -> Value:
        if sign(known["A_t"][time]) < 0:
            return largest((known["unclipped"][time], known["clipped"][time]))
        return _smaller(work, known, time)

    solve(given, work, other)


MISCONCEPTIONS = (
    CLIP_WITHOUT_MIN,
    wrong_side,
    RATIO_INVERTED,
    GREATER_TERM.where_it_shows(),
    CLIPPED_ABOVE_ALONE.where_it_shows(),
    replace(NOT_AVERAGED.where_it_shows(), when=lambda given: len(given.samples) > 1),
)


def oracle(given: Given) -> Answers:
    """The objective as a function of the ratio; the gradient is cut where moving the ratio changes nothing."""
    ratios = np.array([new_chance(sample) / old_chance(sample) for sample in given.samples])
    advantages = np.array([at(sample.advantage) for sample in given.samples])
    if given.epsilon is None:
        return _searched(given, ratios, advantages)
    epsilon = at(given.epsilon)
    terms = (ratios * advantages, np.minimum(np.maximum(ratios, 1 - epsilon), 1 + epsilon) * advantages)
    return (
        ratios,
        *([np.concatenate(terms)] if len(ratios) == 1 else terms),
        np.mean(_objectives(ratios, advantages, epsilon)),
        _told(_cut(ratios, advantages, epsilon)),
    )


def _objectives(ratios: Array, advantages: Array, epsilon: float) -> Array:
    """Written by cases: what a better action may gain, and a worse one may lose, is bounded."""
    held = np.where(advantages > 0, np.minimum(ratios, 1 + epsilon), np.maximum(ratios, 1 - epsilon))
    return np.asarray(advantages * held)


def _cut(ratios: Array, advantages: Array, epsilon: float) -> list[bool]:
    step = 1e-9
    moved = [_objectives(ratios + way, advantages, epsilon) for way in (step, -step)]
    return [bool(one == other) for one, other in zip(*moved, strict=True)]


def _is_cut(ratios: Array, advantages: Array, time: int, epsilon: float) -> bool:
    return _cut(ratios, advantages, epsilon)[time]


def _searched(given: Given, ratios: Array, advantages: Array) -> Answers:
    """Halving: the objective grows with ε, and a gradient that is cut off is cut off no more."""

    def edge(too_small: Callable[[float], bool]) -> float:
        low, high = 0.0, 1.0
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if too_small(middle) else (low, middle)
        return low

    if given.objective is None:
        edges = [edge(partial(_is_cut, ratios, advantages, time)) for time in range(len(ratios))]
        return (ratios, edges, np.mean(_objectives(ratios, advantages, 0.0)))
    wanted = at(given.objective)
    return (
        ratios,
        ratios * advantages,
        edge(lambda epsilon: bool(np.mean(_objectives(ratios, advantages, epsilon)) < wanted)),
    )
