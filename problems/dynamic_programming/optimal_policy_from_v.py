"""The optimal policy of a model whose optimal state values are known."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Probability
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import Model, Name, check_state_values, model_blocks, values_table
from rldrill.problems.parts import Part, Policy
from rldrill.problems.phrases import discount
from rldrill.problems.settings import Shape, draw_setting
from rldrill.problems.valued import UNITS, check_optimal_values, draw_valued

TITLE = "Optimal policy given V"
SOURCE = "Sutton & Barto 2018, section 3.6"
REVISION = 1


class Given(Givens):
    """A model, its optimal values (they may be rounded, as books print them), and the discount."""

    mdp: Model = Field(description="The Markov decision process.")
    values: dict[Name, Exact] = Field(description="The optimal value of every state; it may be rounded.")
    gamma: Probability = Field(description="The discount.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_state_values(self.values, self.mdp)
        if not self.parameters():
            check_optimal_values(self.values, self.mdp, self.gamma)
        return self


def draw(level: int, rng: Draws) -> Given:
    """Two states whose moves are certain; then three whose moves are not; then four."""
    gamma = rng.choice(tuple(UNITS)[: level + 1])
    shape = Shape(states=level + 1, actions=3, branches=min(level, 2), denominators=(2,))
    mdp, _, values = draw_valued(rng, draw_setting(rng), shape, gamma, (-6, -1))
    return Given(mdp=mdp, values=values, gamma=gamma)


def question(given: Given) -> Question:
    """The model and its optimal values; an action is asked for in every state."""
    blocks = (
        *model_blocks(given.mdp),
        Paragraph(f"The optimal values are known. {discount(given.gamma)}"),
        values_table(given.values, "V^*"),
    )
    ask = "Which action does an optimal policy take in every state?"
    return Question(blocks, (Part(ask, Policy(given.mdp.actions)),))
