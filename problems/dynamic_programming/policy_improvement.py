"""The greedy policy for the values of a policy, and whether that policy was optimal already."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Probability
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import Model, Name, PolicyField, check_policy, check_state_values, model_blocks
from rldrill.problems.parts import Part, Policy, YesNo
from rldrill.problems.phrases import discount
from rldrill.problems.settings import Shape, draw_setting
from rldrill.problems.valued import (
    UNITS,
    check_policy_values,
    deterministic,
    draw_valued,
    known_or_asked,
    policy_blocks,
)

TITLE = "Policy improvement"
SOURCE = "Sutton & Barto 2018, section 4.2"
REVISION = 1


class Given(Givens):
    """A model, a policy, the discount, and the policy's values; without them, they are asked for first."""

    mdp: Model = Field(description="The Markov decision process.")
    policy: PolicyField = Field(description="The policy that is improved.")
    values: dict[Name, Exact] | None = Field(
        default=None, description="The policy's values; without them they are asked for first."
    )
    gamma: Probability = Field(description="The discount.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_policy(self.policy, self.mdp)
        if self.values is not None:
            check_state_values(self.values, self.mdp)
            if not self.parameters():
                check_policy_values(self.values, self.policy, self.mdp, self.gamma)
        return self


def draw(level: int, rng: Draws) -> Given:
    """Two states whose moves are certain; then three whose moves are not; then the values are asked for, too."""
    gamma = rng.choice(tuple(UNITS)[: level + 1])
    shape = {
        1: Shape(states=2, actions=3, branches=1),
        2: Shape(states=3, actions=3, branches=2, denominators=(2,)),
        3: Shape(states=3, actions=3, branches=2, denominators=(2,)),
    }[level]
    others = (-4, -1) if rng.chance(rng.fraction("1/3")) else (-4, 4)
    mdp, policy, values = draw_valued(rng, draw_setting(rng), shape, gamma, others)
    return Given(mdp=mdp, policy=deterministic(policy), values=None if level == 3 else values, gamma=gamma)


def question(given: Given) -> Question:
    """The model and the policy, with its values or asking for them."""
    states = given.mdp.states
    known, asked = known_or_asked(given.values, states)
    blocks = (*model_blocks(given.mdp), *policy_blocks(given.policy), Paragraph(discount(given.gamma)), *known)
    parts = (
        *asked,
        Part("Which action is greedy for $V^π$ in every state?", Policy(given.mdp.actions)),
        Part("Is $π$ an optimal policy?", YesNo()),
    )
    return Question(blocks, tuple(parts))
