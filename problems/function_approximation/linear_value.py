"""Action values that are linear in features, with one block of weights for every action."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.centres import Centred, centres_table, draw_on_a_line, place
from rldrill.problems.document import Block, Paragraph, joined
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.features import FeatureVector, weights
from rldrill.problems.models import Name
from rldrill.problems.parts import Numbers, Part, Policy, Values
from rldrill.problems.settings import draw_setting

TITLE = "Linear action values"
SOURCE = "Sutton & Barto 2018, section 10.1"
REVISION = 1


class Bumps(Centred):
    """Piecewise linear basis functions, and the state whose features they give."""

    width: Exact = Field(gt=0, description="The distance from its centre at which a feature reaches 0, above 0.")


class Given(Givens):
    """The weights, block by block; the actions in the order of the blocks; and the features of the state.

    The features are given as they are, or as those of a state by piecewise linear basis functions.
    """

    theta: tuple[Exact, ...] = Field(min_length=1, max_length=40, description="The weights, a block for every action.")
    actions: tuple[Name, ...] = Field(min_length=2, description="The actions in the order of the blocks.")
    features: FeatureVector | None = Field(default=None, description="The features of the state; instead of bumps.")
    bumps: Bumps | None = Field(
        default=None, description="The state with basis functions that give its features; instead of features."
    )
    action: Name = Field(description="The action whose value is asked for.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if (self.features is None) == (self.bumps is None):
            raise ValueError("give either features or bumps")
        if len(set(self.actions)) < len(self.actions):
            raise ValueError("actions: one is named twice")
        if self.action not in self.actions:
            raise ValueError(f"action: {self.action!r} is not among the actions")
        if len(self.theta) != self.size * len(self.actions):
            raise ValueError(
                f"theta: {self.size} features and {len(self.actions)} actions need "
                f"{self.size * len(self.actions)} weights, not {len(self.theta)}"
            )
        return self

    @property
    def size(self) -> int:
        """How many features a state has."""
        return len(self.features or ()) if self.bumps is None else len(self.bumps.centres)


def draw(level: int, rng: Draws) -> Given:
    """Two features and two actions; then three and three; then features that must be worked out."""
    setting = draw_setting(rng)
    actions = setting.actions[: 2 if level == 1 else 3]
    size = 2 if level == 1 else 3
    theta = tuple(rng.nonzero(-3, 5) for _ in range(size * len(actions)))
    action = rng.choice(actions[1:])
    if level < 3:
        features = tuple(rng.whole(0, 4) if level == 1 else rng.fraction("0", "1/2", "1", "2", "3/2")
                         for _ in range(size))  # fmt: skip
        return Given(theta=theta, actions=actions, features=features, action=action)
    width = rng.whole(3, 5)
    first, second = rng.distinct(2, 1, int(width) - 1)
    centred = draw_on_a_line(rng, rng.shuffled((first, second, width + rng.whole(0, 2))))
    bumps = Bumps(position=centred.position, centres=centred.centres, width=width)
    return Given(theta=theta, actions=actions, bumps=bumps, action=action)


def question(given: Given) -> Question:
    """Features and weights; the stacked features of one action, then all values and the best action."""
    names = tuple(f"φ_{{{number}}}(s)" for number in range(1, given.size + 1))
    blocks: tuple[Block, ...]
    parts: list[Part] = []
    if given.bumps is None:
        features = ", ".join(
            f"{name} = {shown(value)}" for name, value in zip(names, given.features or (), strict=True)
        )
        blocks = (Paragraph(f"In state $s$ the features are ${features}$."),)
    else:
        blocks = (
            place(given.bumps),
            centres_table(given.bumps.centres),
            Paragraph(
                f"They are piecewise linear radial basis functions of the width $b = {shown(given.bumps.width)}$."
            ),
        )
        parts.append(Part(f"What are the features ${', '.join(names)}$, in this order?", Numbers(names)))
    last = given.size * len(given.actions)
    stacked = tuple(f'φ_{{{number}}}(s, "{given.action}")' for number in range(1, last + 1))
    blocks += (
        Paragraph(
            "Action values are estimated as $Q̂(s, a) = θ^⊤ φ(s, a)$. In $φ(s, a)$ the features are stacked, one block "
            f"for each action, in the order {joined(list(given.actions))}; the blocks of the other actions are 0. "
            f"The weights are ${weights(given.theta)}$."
        ),
    )
    asked = (
        (f'What is the stacked vector $φ(s, "{given.action}")$?', Numbers(stacked)),
        ("What is $Q̂(s, a)$ of every action?", Values("Q̂", tuple(("s", action) for action in given.actions))),
        ("Which action is greedy?", Policy({"s": given.actions})),
    )
    parts += [Part(ask, kind, zero=True) for ask, kind in asked]
    return Question(blocks, tuple(parts))
