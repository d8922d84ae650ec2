"""Values after some sweeps of iterative policy evaluation, synchronous or in place."""

from pydantic import Field

from rldrill.problems.document import Block, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter
from rldrill.problems.family import Question
from rldrill.problems.models import ModelAndPolicy, Process, model_blocks, policy_table
from rldrill.problems.parts import Part, Values
from rldrill.problems.phrases import discount, in_open
from rldrill.problems.settings import Shape, draw_model, draw_setting
from rldrill.problems.sweeps import SYNCHRONOUS, Sweeps, begin, counted, in_place

TITLE = "Iterative policy evaluation"
SOURCE = "Sutton & Barto 2018, section 4.1"
REVISION = 1


class Given(ModelAndPolicy, Sweeps):
    """A model, a policy (without one, every action is equally probable), the discount, and the kind of sweeps.

    A Markov reward process has no actions: then the rows of its transitions are state, next state, probability, reward.
    """

    mdp: Process
    in_place: bool = Field(
        default=False, description="Whether a sweep uses values as soon as they are new, state by state."
    )


def draw(level: int, rng: Draws) -> Given:
    """One sweep from given values; then two from zero; then three, or two over three states with γ left open."""
    setting = draw_setting(rng)
    left_open = level == 3 and rng.chance(rng.fraction("1/2"))
    shape = Shape(
        states=3 if left_open else 2,
        actions=2,
        branches=1 if level == 1 else 2,
        denominators=(2,),
        reward=4 + 2 * level,
    )
    mdp = draw_model(rng, setting, shape)
    denominators = (2, 4) if level < 3 else (2,)
    policy = {
        state: dict(zip(actions, rng.split(2, denominators), strict=True)) for state, actions in mdp.actions.items()
    }
    return Given(
        mdp=mdp,
        policy=policy,
        gamma=Parameter("gamma") if left_open else rng.fraction("1/2") if level == 3 else rng.fraction("1/2", "4/5"),
        sweeps=2 if left_open else level,
        start={state: rng.nonzero(-4, 9) for state in mdp.states} if level == 1 else None,
        in_place=rng.chance(rng.fraction("1/2")),
    )


def question(given: Given) -> Question:
    """The model, the policy and the kind of sweep; the values after the last sweep are asked for."""
    k = given.sweeps
    blocks: tuple[Block, ...] = (
        *model_blocks(given.mdp),
        *((Paragraph("The policy is:"), policy_table(given.chances)) if given.mdp.chooses else ()),
        *begin(given, "Policy evaluation"),
        Paragraph(f"{discount(given.gamma)} {in_place(given.mdp.states) if given.in_place else SYNCHRONOUS}"),
    )
    ask = f"What is $V_{{{k}}}(s)$, the value of every state after {counted(k)}{in_open(given)}?"
    return Question(blocks, (Part(ask, Values(f"V_{{{k}}}", given.mdp.states)),))
