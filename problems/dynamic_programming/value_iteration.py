"""Values after some sweeps of value iteration, and the greedy policy for them."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Probability
from rldrill.problems.family import Question
from rldrill.problems.models import model_blocks
from rldrill.problems.parts import Part, Policy, Values
from rldrill.problems.phrases import discount
from rldrill.problems.settings import Shape, draw_model, draw_setting
from rldrill.problems.sweeps import SYNCHRONOUS, Sweeps, begin, counted, in_place

TITLE = "Value iteration"
SOURCE = "Sutton & Barto 2018, section 4.4"
REVISION = 1


class Given(Sweeps):
    """A model, the discount, how many sweeps, and the values to start from (0 where none are given)."""

    gamma: Probability = Field(description="The discount.")
    in_place: bool = Field(
        default=False,
        exclude_if=lambda in_place: not in_place,
        description="Whether a sweep uses values as soon as they are new, state by state.",
    )
    action_values: bool = Field(
        default=False,
        exclude_if=lambda action_values: not action_values,
        description="Whether the sweeps go over action values: then Q_k is asked for instead of V_k.",
    )

    @model_validator(mode="after")
    def _from_zero(self) -> Self:
        if self.action_values and (self.in_place or self.start):
            surplus = "in_place" if self.in_place else "start"
            raise ValueError(
                f"{surplus}: sweeps over action values are synchronous here, and begin with 0; leave out {surplus}, or "
                "action_values"
            )
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
    if given.action_values:
        return _of_actions(given)
    sweeps = in_place(given.mdp.states) if given.in_place else SYNCHRONOUS
    blocks = (
        *model_blocks(given.mdp),
        *begin(given, "Value iteration"),
        Paragraph(f"{discount(given.gamma)} {sweeps}"),
    )
    k = given.sweeps
    return Question(
        blocks,
        (
            Part(
                f"What is $V_{{{k}}}(s)$, the value of every state after {counted(k)}?",
                Values(f"V_{{{k}}}", given.mdp.states),
            ),
            Part(f"Which action is greedy for $V_{{{k}}}$ in every state?", Policy(given.mdp.actions)),
        ),
    )


def _of_actions(given: Given) -> Question:
    k = given.sweeps
    start = "Value iteration goes over the action values, and starts from $Q_0(s, a) = 0$ for all states and actions."
    blocks = (*model_blocks(given.mdp), Paragraph(start), Paragraph(f"{discount(given.gamma)} {SYNCHRONOUS}"))
    ask = f"What is $Q_{{{k}}}(s, a)$, the value of every state and action after {counted(k)}?"
    greedy = f"Which action is greedy for $Q_{{{k}}}$ in every state?"
    return Question(blocks, (Part(ask, Values(f"Q_{{{k}}}", given.mdp.pairs)), Part(greedy, Policy(given.mdp.actions))))
