"""Softmax policies that are linear in features, and runs of agents that follow them."""

from collections.abc import Mapping, Sequence
from math import prod
from typing import Any, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Logarithm, Parameter, Weight, WeightField
from rldrill.problems.family import Givens
from rldrill.problems.features import (
    ActionFeatures,
    FeatureVector,
    action_features_table,
    check_action_features,
    features_table,
    weight_names,
    weights,
)
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import check_keys
from rldrill.problems.parts import Numbers, Part
from rldrill.problems.phrases import in_open
from rldrill.problems.runs import Trajectory, trajectory_table
from rldrill.problems.settings import draw_setting, draw_way


class SoftmaxRun(Givens):
    """A run of an agent, its weights before it, and the features of the actions in every state that it leaves."""

    trajectory: Trajectory = Field(description="What the agent did.")
    features: ActionFeatures = Field(description="For every state that is left the features of its actions.")
    theta: tuple[WeightField, ...] = Field(min_length=1, max_length=20, description="The weights before the run.")
    gamma: Discount

    @model_validator(mode="after")
    def _chosen(self) -> Self:
        run = self.trajectory
        check_action_features(self.features, len(self.theta))
        if len(run.actions) != len(run.rewards):
            raise ValueError(
                f"trajectory: {len(run.rewards)} steps need as many actions, not {len(run.actions)}; give as many"
            )
        left = tuple(dict.fromkeys(run.states[:-1]))
        check_keys(self.features, left, "the row of features", needed=left)
        for state, action in zip(run.states, run.actions, strict=False):
            if action not in self.features[state]:
                raise ValueError(f"features: {action!r} is taken in {state!r} but has no features there; add them")
        return self


class Episode(SoftmaxRun):
    """A run that goes on to a terminal state, so that every return is known."""

    @model_validator(mode="after")
    def _ends(self) -> Self:
        if (last := self.trajectory.states[-1]) not in self.trajectory.terminal:
            raise ValueError(
                f"trajectory: the episode must end in a terminal state, but {last!r} is not one; "
                "add it to terminal, or go on to the end"
            )
        return self


def policy_blocks(features: ActionFeatures, theta: tuple[Weight, ...]) -> tuple[Block, ...]:
    """What a softmax policy is made of."""
    if len(features) == 1:
        ((state, row),) = features.items()
        table = features_table(row)
        opening = f"In {state} the actions have these features:"
    else:
        table = action_features_table(features)
        opening = "The actions have these features:"
    return (
        Paragraph(f"The agent's policy is softmax in the preferences $h(s, a) = θ^⊤ f(s, a)$. {opening}"),
        table,
        Paragraph(f"The weights are ${weights(theta)}$."),
    )


def episode_blocks(given: Episode) -> tuple[Block, ...]:
    """An episode, and the policy that was followed in it."""
    run = given.trajectory
    return (
        Paragraph(
            f"This is an agent's episode, which ends at $T = {len(run.rewards)}$ (each reward stands at the time at "
            "which it is received):"
        ),
        trajectory_table(run),
        *policy_blocks(given.features, given.theta),
    )


def gradient_parts(given: Episode, weighted: str, entries: tuple[str, ...]) -> tuple[Part, ...]:
    """What is asked about an episode: the weight of every step, the gradient, the new weights.

    Args:
        given: the episode.
        weighted: what the steps' scores are weighted with, in words.
        entries: the same as mathematics, for every step.
    """
    names = weight_names(given.theta)
    asked = f"What are the {weighted} ${', '.join(entries)}${in_open(given)}?"
    return (
        Part(asked, Numbers(entries), zero=True),
        Part(
            f"What is the estimate of the gradient $∇_θ J(θ)$ of the expected return $J${in_open(given)}?",
            Numbers(tuple(f"∂J/∂{name}" for name in names)),
        ),
        Part(
            f"What are the weights $θ$ after one step of gradient ascent{in_open(given)}?",
            Numbers(names),
        ),
    )


def draw_episode(level: int, rng: Draws) -> dict[str, Any]:
    """Trajectory, weights, features and discount of a run.

    Two steps and even chances; then three steps in two states; then also three actions, and γ left open.
    """
    setting = draw_setting(rng)
    actions = setting.actions[: 3 if level == 3 else 2]
    visits = {1: ("aa.",), 2: ("aba.",), 3: ("abb.", "aab.")}[level]
    states, taken = draw_way(rng, setting, rng.choice(visits), actions)
    policy = draw_even_policy if level == 1 else draw_log_policy
    while True:
        theta, features = policy(rng, tuple(dict.fromkeys(states[:-1])), actions)
        if not told_apart(features):
            continue
        if level == 1 or (denominator(theta, features) <= _MOST_BELOW[level] and not is_even(theta, features)):
            break
    gamma = Parameter("gamma") if level == 3 else rng.fraction("1/2", "1/2", "1")
    run = draw_run(rng, states, taken, setting.terminal, doubled=gamma == Fraction(1, 2))
    return {"trajectory": run, "theta": theta, "features": features, "gamma": gamma}


#: The largest product of what stands below the line in the probabilities of two states, by level.
_MOST_BELOW = {2: 20, 3: 50}


def denominator(theta: tuple[Weight, ...], features: ActionFeatures) -> int:
    """The product over all states of the sum of all e^h there, for weights that are logarithms of whole numbers."""
    return prod(map(sum, _exponentials(theta, features)))


def is_even(theta: tuple[Weight, ...], features: ActionFeatures) -> bool:
    """Whether in some state every action is as likely as any other, so that the weights there do no work."""
    return any(len(set(row)) == 1 for row in _exponentials(theta, features))


def _exponentials(theta: tuple[Weight, ...], features: ActionFeatures) -> list[list[int]]:
    """Of every state the e^h of its actions, for weights that are logarithms of whole numbers."""
    bases = [int(str(weight).removeprefix("ln ")) if weight else 1 for weight in theta]
    return [
        [prod(base ** int(x) for base, x in zip(bases, row, strict=True)) for row in rows.values()]
        for rows in features.values()
    ]


def returns(run: Trajectory, gamma: Fraction) -> tuple[Fraction, ...]:
    """The discounted return from every step on."""
    later = [Fraction(0)]
    for reward in reversed(run.rewards):
        later.append(reward + gamma * later[-1])
    return tuple(later[:0:-1])


def gradient(episode: Mapping[str, Any], weights: Sequence[Fraction]) -> list[Fraction]:
    """The sum of the scores of a run, each with its weight; the policy's weights are 0 or logarithms."""
    run, features = episode["trajectory"], episode["features"]
    total = [Fraction(0)] * len(episode["theta"])
    likely = dict(zip(features, _exponentials(episode["theta"], features), strict=True))
    for state, action, weight in zip(run.states, run.actions, weights, strict=False):
        rows, chances = features[state], likely[state]
        for place, own in enumerate(rows[action]):
            mean = Fraction(sum(chance * row[place] for chance, row in zip(chances, rows.values(), strict=True)))
            total[place] += weight * (own - mean / sum(chances))
    return total


def every_step_counts(run: Trajectory, weights: Sequence[Fraction]) -> bool:
    """Whether the scores of no state and action that were taken cancel each other."""
    total: dict[tuple[str, str], Fraction] = {}
    for state, action, weight in zip(run.states, run.actions, weights, strict=False):
        total[state, action] = total.get((state, action), Fraction(0)) + weight
    return 0 not in weights and 0 not in total.values()


def draw_run(
    rng: Draws, states: tuple[str, ...], taken: tuple[str, ...], terminal: str, *, doubled: bool = False
) -> Trajectory:
    """A run through these states with these actions, its rewards drawn.

    With ``doubled`` every reward is a multiple of twice what the one before is: then halved returns are whole.
    """
    units = [2**time if doubled else 1 for time in range(len(states) - 1)]
    return Trajectory(
        states=states,
        actions=taken[: len(units)],
        rewards=tuple(unit * rng.nonzero(-(4 // unit), 8 // unit) for unit in units),
        terminal=(terminal,) if terminal in states else (),
    )


def draw_log_policy(
    rng: Draws, states: tuple[str, ...], actions: tuple[str, ...], size: int = 2
) -> tuple[tuple[Weight, ...], ActionFeatures]:
    """Weights that are logarithms and whole features, so that every e^h is a whole number."""
    theta = tuple(Logarithm(f"ln {base}") for base in sorted(rng.choice((2, 2, 3)) for _ in range(size)))
    return theta, _drawn(rng, states, actions, size, 1)


def draw_even_policy(
    rng: Draws, states: tuple[str, ...], actions: tuple[str, ...], size: int = 2
) -> tuple[tuple[Weight, ...], ActionFeatures]:
    """All weights zero, so that every action is as likely as any other."""
    return (Fraction(0),) * size, _drawn(rng, states, actions, size, 2)


def _drawn(rng: Draws, states: tuple[str, ...], actions: tuple[str, ...], size: int, high: int) -> ActionFeatures:
    """Features such that every weight matters to some choice."""
    while True:
        features = {state: _different(rng, actions, size, high) for state in states}
        differ = [any(len({row[place] for row in rows.values()}) > 1 for rows in features.values())
                  for place in range(size)]  # fmt: skip
        if all(differ):
            return features


def told_apart(features: ActionFeatures) -> bool:
    """Whether no two weights make the same difference to every choice, so that they would get the same gradient."""
    columns = [
        tuple(row[place] - first[place] for first, *others in map(tuple, _rows(features)) for row in others)
        for place in range(len(next(iter(_rows(features)))[0]))
    ]
    return len(set(columns)) == len(columns)


def _rows(features: ActionFeatures) -> list[list[FeatureVector]]:
    return [list(row.values()) for row in features.values()]


def _different(rng: Draws, actions: tuple[str, ...], size: int, high: int) -> dict[str, FeatureVector]:
    """Features from 0 to ``high``, no two actions with the same."""
    base = high + 1
    rows = rng.distinct(len(actions), 0, base**size - 1)
    return {
        action: tuple(Fraction(int(row) // base**place % base) for place in range(size))
        for action, row in zip(actions, rows, strict=True)
    }
