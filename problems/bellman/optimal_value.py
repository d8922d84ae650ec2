"""The optimal values of a small MDP: V*, a best action in every state, and Q*."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Probability
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import Model, model_blocks
from rldrill.problems.parts import Part, Policy, Values
from rldrill.problems.phrases import discount
from rldrill.problems.settings import Shape, draw_setting
from rldrill.problems.valued import draw_valued

TITLE = "Optimal values"
SOURCE = "Sutton & Barto 2018, section 3.6"
REVISION = 2


class Given(Givens):
    """A model and the discount."""

    mdp: Model = Field(description="The Markov decision process.")
    gamma: Probability = Field(description="The discount.")

    @model_validator(mode="after")
    def _closed(self) -> Self:
        if self.parameters():
            raise ValueError(f"mdp: {self.parameters()[0]} is left open, so no action can be called best; give numbers")
        return self


def draw(level: int, rng: Draws) -> Given:
    """Two states without chance; then with chance; then three states."""
    gamma = rng.fraction("1/2", "2/3") if level < 3 else rng.fraction("1/2", "2/3", "4/5")
    shape = Shape(states=max(2, level), actions=2, branches=min(level, 2), denominators=(2,) if level < 3 else (2, 4))
    mdp, _, _ = draw_valued(rng, draw_setting(rng), shape, gamma, (-5, -1))
    return Given(mdp=mdp, gamma=gamma)


def question(given: Given) -> Question:
    """The model; the optimal values of states, the best actions, the optimal values of states with actions."""
    return Question(
        (*model_blocks(given.mdp), Paragraph(discount(given.gamma))),
        (
            Part("What is $V^*(s)$, the optimal value of every state?", Values("V^*", given.mdp.states)),
            Part("Which action is best in every state?", Policy(given.mdp.actions, "π^*")),
            Part("What is $Q^*(s, a)$ for every state and action?", Values("Q^*", given.mdp.pairs)),
        ),
    )
