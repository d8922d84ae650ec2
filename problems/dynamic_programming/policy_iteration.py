"""Values and policies of some rounds of policy iteration, and whether it has ended."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Probability
from rldrill.problems.family import Givens, Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Model, Name, Named, check_policy, model_blocks
from rldrill.problems.parts import Part, Policy, Values, YesNo
from rldrill.problems.phrases import discount
from rldrill.problems.settings import Shape, draw_setting
from rldrill.problems.valued import UNITS, choices_table, deterministic, draw_valued

TITLE = "Policy iteration"
SOURCE = "Sutton & Barto 2018, section 4.3"
REVISION = 3


class Given(Givens):
    """A model, the policy to start from, the discount, and how many rounds of evaluation and improvement."""

    mdp: Model = Field(description="The Markov decision process.")
    start: Named[Name] = Field(description="The action of the policy to start from in every state.")
    gamma: Probability = Field(description="The discount.")
    rounds: int = Field(ge=1, le=12, description="How many rounds of evaluation and improvement.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_policy(deterministic(self.start), self.mdp)
        return self


def draw(level: int, rng: Draws) -> Given:
    """One round over two states whose moves are certain; then two rounds; then two over three states."""
    gamma = rng.choice(tuple(UNITS)[:2])
    shape = {
        1: Shape(states=2, actions=3, branches=1),
        2: Shape(states=2, actions=2 + rng.below(2), branches=2, denominators=(2,)),
        3: Shape(states=3, actions=2, branches=2, denominators=(2,)),
    }[level]
    others = (-4, -1) if rng.chance({1: Fraction(3, 5), 2: Fraction(1, 10), 3: Fraction(0)}[level]) else (-3, 5)
    mdp, policy, _ = draw_valued(rng, draw_setting(rng), shape, gamma, others, forked="own")
    return Given(mdp=mdp, start=policy, gamma=gamma, rounds=min(level, 2))


def question(given: Given) -> Question:
    """The model and the first policy; values and policy of every round are asked for."""
    states = given.mdp.states
    blocks = (
        *model_blocks(given.mdp),
        Paragraph("Policy iteration starts from this policy:"),
        choices_table(given.start, "π_0"),
        Paragraph(
            f"{discount(given.gamma)} Each policy is evaluated exactly. Improvement changes an action only where "
            "another one is better: on a tie the old action is kept."
        ),
    )
    parts = []
    for number in range(given.rounds):
        before, after = f"π_{{{number}}}", f"π_{{{number + 1}}}"
        of = f"V^{{{before}}}"
        parts += [
            Part(f"What is ${of}(s)$, the value of every state?", Values(of, states)),
            Part(f"Which policy ${after}$ does improvement give?", Policy(given.mdp.actions, after)),
        ]
    return Question(
        blocks,
        (
            *parts,
            Part(f"Is ${before}$ an optimal policy?", YesNo()),
        ),
    )
