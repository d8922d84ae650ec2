"""The feature expectations of a policy, estimated from trajectories that were recorded."""

from collections.abc import Mapping
from operator import mul
from typing import Annotated, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Exact, Parameter, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.feature_vectors import FeaturesField, check_features, draw_features
from rldrill.problems.features import features_table
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Name
from rldrill.problems.parts import Number, Numbers, Part
from rldrill.problems.phrases import discount, in_open, unknown
from rldrill.problems.settings import draw_roaming

TITLE = "Feature expectations from trajectories"
SOURCE = "Abbeel & Ng 2004, section 2"
REVISION = 4


class Given(Givens):
    """The features of every state that was visited, the trajectories as their states, and the discount."""

    FOUND_BY = "estimate"

    features: FeaturesField = Field(min_length=1, description="The features of every state.")
    trajectories: tuple[Annotated[tuple[Name, ...], Field(max_length=300)], ...] = Field(
        min_length=1, max_length=50, description="The trajectories, each as the list of its states."
    )
    gamma: Discount
    estimate: Exact | None = Field(
        default=None,
        description="The estimate for the first feature, from which gamma follows, which is left open.",
        examples=["5/4"],
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.estimate is not None and (not self.left_open or self.size < 2):
            raise ValueError("estimate: leave gamma open, for it is asked for, and give two features at least")
        if not all(self.trajectories):
            raise ValueError("trajectories: one of them has no states; add them")
        check_features(self.features, self.features)
        visited = dict.fromkeys(state for trajectory in self.trajectories for state in trajectory)
        for state in visited:
            if state not in self.features:
                raise ValueError(f"features: {state!r} is visited, but its features are missing; add them")
        return self

    @property
    def size(self) -> int:
        """How many features there are."""
        return len(next(iter(self.features.values())))


def draw(level: int, rng: Draws) -> Given:
    """Two short trajectories; two to four longer ones; the discount left open, or asked for."""
    setting = draw_roaming(rng)
    states = setting.states[: 2 if level == 1 else 3]
    count, length = {1: (2, 3), 2: rng.choice(((2, 4), (4, 3), (3, 3))), 3: rng.choice(((2, 3), (2, 4)))}[level]
    if level == 3 and rng.chance(Fraction(2, 3)):
        return _back(rng, states)
    while True:
        runs = _distinct_runs(rng, states, count, length)
        features = draw_features(rng, states)
        if {state for run in runs for state in run} == set(states) and _different(runs, features):
            break
    return Given(
        features=features,
        trajectories=tuple(runs),
        gamma=Parameter("gamma") if level == 3 else Fraction(1, 2),
    )


def _different(runs: list[tuple[str, ...]], features: Mapping[str, tuple[Fraction, ...]]) -> bool:
    """Whether, with γ = 1/2, every trajectory matters, and every state of it: the mean is another without it."""

    length = len(runs[0])
    weights = [2 ** (length - time) for time in range(length)]
    whole = {state: [feature.numerator for feature in row] for state, row in features.items()}

    def summed(run: tuple[str, ...]) -> list[int]:
        return [sum(map(mul, weights, column)) for column in zip(*[whole[state] for state in run], strict=True)]

    sums = [summed(run) for run in runs]
    total = [sum(column) for column in zip(*sums, strict=True)]
    return all(
        total != [len(runs) * number for number in found]
        and all(summed(run[:time] + run[time + 1 :]) != found for time in range(length))
        for run, found in zip(runs, sums, strict=True)
    )


def _back(rng: Draws, states: tuple[str, ...]) -> Given:
    """Trajectories of at most two states, so that γ follows from the estimate for a feature."""
    count = rng.choice((2, 3, 4))
    runs = [run[: 1 + (index > 0 or rng.chance(Fraction(1, 2)))]
            for index, run in enumerate(_distinct_runs(rng, states, count, 2))]  # fmt: skip
    features = draw_features(rng, states)
    gamma = rng.fraction("1/2", "1/3", "2/3", "1/4", "3/4", "2/5", "4/5")
    first, later = (sum((features[run[time]][0] for run in runs if len(run) > time), Fraction(0)) for time in (0, 1))
    if (
        {state for run in runs for state in run} != set(states)
        or not later
        or not any(features[r[1]][1] for r in runs[1:])
    ):
        return _back(rng, states)
    return Given(
        features=features,
        trajectories=tuple(runs),
        gamma=Parameter("gamma"),
        estimate=(first + gamma * later) / count,
    )


def _distinct_runs(rng: Draws, states: tuple[str, ...], count: int, length: int) -> list[tuple[str, ...]]:
    runs: list[tuple[str, ...]] = []
    while len(runs) < count:
        run = tuple(rng.choice(states) for _ in range(length))
        if run not in runs:
            runs.append(run)
    return runs


def question(given: Given) -> Question:
    """Features and trajectories as tables; the vector of estimates is asked for."""
    longest = max(map(len, given.trajectories))
    rows = tuple(
        (f"${number}$", *trajectory, *["–"] * (longest - len(trajectory)))
        for number, trajectory in enumerate(given.trajectories, 1)
    )
    blocks = (
        Paragraph("Each state has a feature vector $φ(s)$:"),
        features_table(given.features, "s", "φ", "s"),
        Paragraph(
            "An expert followed its policy $π$ along these trajectories; nothing counts after the last state of each:"
        ),
        Table(header=("trajectory", *(f"$s_{{{time}}}$" for time in range(longest))), rows=rows),
        Paragraph(discount(given.gamma) if given.estimate is None else unknown("gamma")),
    )
    if given.estimate is not None:
        told = f"The estimate is $μ_1(π) = {shown(given.estimate)}$."
        others = tuple(f"μ_{{{index}}}(π)" for index in range(2, given.size + 1))
        rest = (
            Part("What is the estimate of $μ_2(π)$ then?", Number())
            if given.size == 2
            else Part("What are the estimates for the other features then, in their order?", Numbers(others))
        )
        return Question(blocks, (Part(f"{told} What is the discount $γ$?", Number()), rest))
    opened = in_open(given)
    ask = f"What is the estimate of the feature expectations $μ(π)$ from them{opened}?"
    return Question(blocks, (Part(ask, Numbers(tuple(f"μ_{{{index}}}(π)" for index in range(1, given.size + 1)))),))
