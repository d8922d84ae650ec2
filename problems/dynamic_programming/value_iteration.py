"""Values after some sweeps of value iteration, and the greedy policy for them."""

from pydantic import Field

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Probability
from rldrill.problems.family import Question
from rldrill.problems.models import model_blocks
from rldrill.problems.parts import Part, Policy, Values
from rldrill.problems.phrases import discount
from rldrill.problems.settings import Shape, draw_model, draw_setting
from rldrill.problems.sweeps import SYNCHRONOUS, Sweeps, begin, counted

TITLE = "Value iteration"
SOURCE = "Sutton & Barto 2018, section 4.4"
REVISION = 1


class Given(Sweeps):
    """A model, the discount, how many sweeps, and the values to start from (0 where none are given)."""

    gamma: Probability = Field(description="The discount.")


def draw(level: int, rng: Draws) -> Given:
    """One sweep from given values; then two from zero; then three over three states."""
    setting = draw_setting(rng)
    shape = Shape(states=3 if level == 3 else 2, actions=2, branches=1 if level == 1 else 2, denominators=(2,))
    mdp = draw_model(rng, setting, shape)
    start = {state: rng.nonzero(-4, 9) for state in mdp.states} if level == 1 else None
    return Given(mdp=mdp, gamma=rng.fraction("1/2", "4/5", "9/10"), sweeps=level, start=start)


def question(given: Given) -> Question:
    """The model; values after the sweeps, then the policy that is greedy for them."""
    blocks = (
        *model_blocks(given.mdp),
        *begin(given, "Value iteration"),
        Paragraph(f"{discount(given.gamma)} {SYNCHRONOUS}"),
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
