"""The feature expectations of a policy, estimated from trajectories that were recorded."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Parameter
from rldrill.problems.family import Givens, Question
from rldrill.problems.feature_vectors import FeaturesField, check_features, draw_features
from rldrill.problems.features import features_table
from rldrill.problems.models import Name
from rldrill.problems.parts import Numbers, Part
from rldrill.problems.phrases import discount, in_open
from rldrill.problems.settings import draw_setting

TITLE = "Feature expectations from trajectories"
SOURCE = "Abbeel & Ng 2004, section 2"
REVISION = 2


class Given(Givens):
    """The features of every state that was visited, the trajectories as their states, and the discount."""

    features: FeaturesField = Field(description="The features of every state.")
    trajectories: tuple[tuple[Name, ...], ...] = Field(
        min_length=1, max_length=50, description="The trajectories, each as the list of its states."
    )
    gamma: Discount

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if not all(self.trajectories):
            raise ValueError("trajectories: one of them has no states")
        check_features(self.features, self.features)
        visited = dict.fromkeys(state for trajectory in self.trajectories for state in trajectory)
        for state in visited:
            if state not in self.features:
                raise ValueError(f"features: {state!r} is visited, but its features are missing")
        return self


def draw(level: int, rng: Draws) -> Given:
    """Two short trajectories; three longer ones; two with the discount left open."""
    setting = draw_setting(rng)
    states = setting.states[: 2 if level == 1 else 3]
    count, length = {1: (2, 3), 2: (3, 4), 3: (2, 5)}[level]
    return Given(
        features=draw_features(rng, states, 2, 4),
        trajectories=tuple(_distinct_runs(rng, states, count, length)),
        gamma=Parameter("gamma") if level == 3 else rng.fraction("1/2", "1/3", "1/10"),
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
        Paragraph("Every state has a vector $φ(s)$ of features:"),
        features_table(given.features, "s", "φ", "s"),
        Paragraph("These trajectories of an expert were recorded; nothing counts after the last state of each:"),
        Table(header=("trajectory", *(f"$s_{{{time}}}$" for time in range(longest))), rows=rows),
        Paragraph(discount(given.gamma)),
    )
    size = len(next(iter(given.features.values())))
    ask = f"Which estimate of the feature expectations $μ(π)$ of the expert's policy do they give{in_open(given)}?"
    return Question(blocks, (Part(ask, Numbers(tuple(f"μ_{{{index}}}" for index in range(1, size + 1)))),))
