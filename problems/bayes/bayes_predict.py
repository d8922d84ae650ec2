"""The belief over the states of a robot after one or several actions."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.bars import belief_bars
from rldrill.problems.beliefs import (
    MOTION_TOLD,
    MotionField,
    check_distribution,
    check_motion,
    motion_table,
)
from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import DistributionField, Name, check_keys
from rldrill.problems.parts import Part, Values
from rldrill.problems.phrases import in_open
from rldrill.problems.scenes import SCENES, draw_motion

TITLE = "Belief after an action"
SOURCE = "Thrun, Burgard & Fox 2005, section 2.4"
REVISION = 1


class Given(Givens):
    """A belief over states, where every action leads from every state, and the actions taken."""

    belief: DistributionField = Field(min_length=2, description="The probability of every state beforehand.")
    motion: MotionField = Field(description="For every action and state the probabilities of the next states.")
    actions: tuple[Name, ...] = Field(
        min_length=1, max_length=26, description="The actions in the order in which they are taken."
    )
    story: str = Field(
        default="", max_length=200, pattern=r"^[^$\\]*$", description="A sentence that is printed first."
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_distribution(self.belief, "belief")
        check_motion(self.motion, tuple(self.belief))
        check_keys(dict.fromkeys(self.actions), tuple(self.motion), "an action", needed=())
        return self


def draw(level: int, rng: Draws) -> Given:
    """One action over two states; two actions over three; two over three with a probability left open."""
    scene = rng.choice(SCENES)
    states = (scene.states[0], scene.states[-1]) if level == 1 else rng.sample(scene.states, 3)
    chances = rng.fraction("1/2", "3/4", "4/5", "9/10"), rng.fraction("1/2", "3/4", "4/5", "9/10")
    motion = draw_motion(scene, states, (Parameter("p"), Parameter("p")) if level == 3 else chances)
    actions = rng.shuffled(tuple(motion)) if level == 2 else (rng.choice(tuple(motion)),) * (1 if level == 1 else 2)
    return Given(
        belief=dict(zip(states, rng.split(len(states), (4, 5, 10)), strict=True)),
        motion={action: motion[action] for action in motion if action in actions},
        actions=actions,
        story=scene.told,
    )


def question(given: Given) -> Question:
    """The belief and the motion as tables; the belief after every action is a part."""
    states = tuple(given.belief)
    blocks = (
        *([Paragraph(given.story)] if given.story else []),
        Paragraph("Beforehand the belief $p(s)$ is:"),
        belief_bars(belief=given.belief),
        Paragraph(MOTION_TOLD),
        motion_table(given.motion, states),
        *([Paragraph("The probability $p$ is left open.")] if given.parameters() else []),
    )
    parts: list[Part] = []
    for action in given.actions:
        told = f"The {'next ' if parts else ''}action is “{action}”; nothing is measured."
        parts.append(Part(f"{told} What is the belief after it{in_open(given)}?", Values("p", states)))
    return Question(blocks, tuple(parts))
