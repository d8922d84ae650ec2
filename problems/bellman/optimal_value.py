"""The optimal values of a small MDP: V*, a best action in every state, and Q*."""

from fractions import Fraction
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Probability
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import Model, Transition, model_blocks
from rldrill.problems.parts import Part, Policy, Values
from rldrill.problems.phrases import discount
from rldrill.problems.settings import Shape, draw_model, draw_setting

TITLE = "Optimal values"
SOURCE = "Sutton & Barto 2018, section 3.6"
REVISION = 1


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
    setting = draw_setting(rng)
    shape = Shape(states=max(2, level), actions=2, branches=1 if level == 1 else 2, denominators=(2,))
    mdp = _with_temptation(rng, draw_model(rng, setting, shape))
    return Given(mdp=mdp, gamma=rng.fraction("1/2", "2/3", "4/5"))


def _with_temptation(rng: Draws, mdp: Model) -> Model:
    """The model with other rewards: one state pays well, but the way there pays less than the ways elsewhere."""
    rich = rng.choice(mdp.states)

    def reward(row: Transition) -> Fraction:
        if row.state == rich:
            return rng.whole(6, 10)
        return rng.whole(-2, 0) if row.next == rich else rng.whole(1, 3)

    rows = tuple(row._replace(reward=reward(row)) for row in mdp.transitions)
    return Model(story=mdp.story, transitions=rows, terminal=mdp.terminal)


def question(given: Given) -> Question:
    """The model; the optimal values of states, the best actions, the optimal values of states with actions."""
    return Question(
        (*model_blocks(given.mdp), Paragraph(discount(given.gamma))),
        (
            Part("What is $V^*(s)$, the optimal value of every state?", Values("V^*", given.mdp.states)),
            Part("Which action is best in every state?", Policy(given.mdp.actions)),
            Part("What is $Q^*(s, a)$ for every state and action?", Values("Q^*", given.mdp.pairs)),
        ),
    )
