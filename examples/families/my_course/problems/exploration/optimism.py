"""The largest value that any policy can have, which an optimistic start must not be below."""

from pydantic import Field

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Exact, Parameter, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.parts import Number, Part

TITLE = "An optimistic start"
SOURCE = "Brafman & Tennenholtz 2002, section 2"
REVISION = 1


class Given(Givens):
    """The largest reward, the time from which on it can be had, and the discount."""

    reward: Exact = Field(gt=0, description="The largest reward of a step.", examples=["3"])
    time: int = Field(ge=0, le=20, description="How many steps give nothing before.", examples=[2])
    gamma: Discount


def draw(level: int, rng: Draws) -> Given:
    """At once; after some steps; with the discount left open."""
    gamma = Parameter("gamma") if level == 3 else rng.fraction("1/2", "2/3", "3/4", "4/5")
    return Given(reward=rng.fraction(*map(str, range(2, 10))), time=1 + rng.below(level), gamma=gamma)


def question(given: Given) -> Question:
    """The bound is asked for."""
    steps = "step gives" if given.time == 1 else "steps give"
    told = (
        f"No reward is larger than ${shown(given.reward)}$, the first {given.time} {steps} nothing, and nothing "
        f"else is known. The discount is $γ = {shown(given.gamma)}$."
    )
    return Question((Paragraph(told),), (Part("How large can the value $V_max$ of the start be?", Number()),))
