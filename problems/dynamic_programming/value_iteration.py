"""Values after some sweeps of value iteration, and the greedy policy for them."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Probability
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import Model, Name, check_keys, model_blocks, values_table
from rldrill.problems.parts import Part, Policy, Table
from rldrill.problems.phrases import discount
from rldrill.problems.settings import Shape, draw_model, draw_setting

TITLE = "Value iteration"
SOURCE = "Sutton & Barto 2018, section 4.4"
REVISION = 1


class Given(Givens):
    """A model, the discount, how many sweeps, and the values to start from (0 where none are given)."""

    mdp: Model
    gamma: Probability
    sweeps: int = Field(ge=1, le=1000)
    start: dict[Name, Exact] | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.start is not None:
            check_keys(self.start, (*self.mdp.states, *self.mdp.terminal), "the starting value", self.mdp.states)
        return self


def draw(level: int, rng: Draws) -> Given:
    """One sweep from given values; then two from zero; then three over three states."""
    setting = draw_setting(rng)
    shape = Shape(states=3 if level == 3 else 2, actions=2, branches=1 if level == 1 else 2, denominators=(2,))
    mdp = draw_model(rng, setting, shape)
    start = {state: rng.nonzero(-4, 9) for state in mdp.states} if level == 1 else None
    return Given(mdp=mdp, gamma=rng.fraction("1/2", "4/5", "9/10"), sweeps=level, start=start)


def question(given: Given) -> Question:
    """The model; values after the sweeps, then the policy that is greedy for them."""
    sweeps = "one sweep" if given.sweeps == 1 else f"{given.sweeps} sweeps"
    begin = (
        (Paragraph("Value iteration starts from these values:"), values_table(given.start, "V_0"))
        if given.start
        else (Paragraph("Value iteration starts from $V_0(s) = 0$ for all states."),)
    )
    blocks = (
        *model_blocks(given.mdp),
        *begin,
        Paragraph(f"{discount(given.gamma)} Sweeps are synchronous: each uses only the values of the sweep before."),
    )
    k = given.sweeps
    return Question(
        blocks,
        (
            Part(
                "a",
                f"What is $V_{{{k}}}(s)$, the value of every state after {sweeps}?",
                Table(f"V_{{{k}}}", given.mdp.states),
            ),
            Part("b", f"Which action is greedy for $V_{{{k}}}$ in every state?", Policy(given.mdp.actions)),
        ),
    )
