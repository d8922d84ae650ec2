"""The belief over the states of a robot after a run of actions and measurements."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.bars import belief_bars
from rldrill.problems.beliefs import (
    MOTION_TOLD,
    SENSOR_TOLD,
    LikelihoodField,
    MotionField,
    check_distribution,
    check_likelihood,
    check_motion,
    check_possible,
    likelihood_table,
    motion_table,
)
from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import DistributionField, Name, check_keys
from rldrill.problems.parts import Part, Values
from rldrill.problems.scenes import SCENES, draw_motion, draw_sensor

TITLE = "Bayes filter"
SOURCE = "Thrun, Burgard & Fox 2005, section 2.4"
REVISION = 2


class Event(Givens):
    """What happens in one step: first an action, then a measurement; one of them may be missing."""

    action: Name | None = Field(default=None, description="The action that is taken, if there is one.")
    measurement: Name | None = Field(default=None, description="What is measured after it, if anything is.")

    @model_validator(mode="after")
    def _something(self) -> Self:
        if self.action is None and self.measurement is None:
            raise ValueError("a step of the run has neither an action nor a measurement")
        return self


class Given(Givens):
    """A belief over states, where actions lead, what the sensor reads in every state, and the run."""

    belief: DistributionField = Field(min_length=2, description="The probability of every state beforehand.")
    motion: MotionField = Field(
        default_factory=dict,
        description="For every action and state the probabilities of the next states; needed if the run has actions.",
    )
    likelihood: LikelihoodField = Field(
        default_factory=dict,
        description="For every reading its probability in every state; needed if the run has measurements.",
    )
    run: tuple[Event, ...] = Field(
        min_length=1, max_length=26, description="The steps, each with an action, a measurement or both."
    )
    story: str = Field(
        default="", max_length=200, pattern=r"^[^$\\]*$", description="A sentence that is printed first."
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        states = tuple(self.belief)
        check_distribution(self.belief, "belief")
        check_motion(self.motion, states)
        check_likelihood(self.likelihood, states)
        if self.parameters():
            raise ValueError("motion: no probability may be left open here")
        for event in self.run:
            check_keys(dict.fromkeys(filter(None, [event.action])), tuple(self.motion) or ("none",), "an action", ())
            read = dict.fromkeys(filter(None, [event.measurement]))
            check_keys(read, tuple(self.likelihood) or ("none",), "a measurement", ())
        self._check_run()
        return self

    def _check_run(self) -> None:
        """Demand that every measurement of the run is possible when it is made."""
        believed = tuple(state for state, chance in self.belief.items() if chance)
        for number, event in enumerate(self.run, 1):
            if event.action is not None:
                rows = self.motion[event.action]
                believed = tuple({after: None for state in believed for after, chance in rows[state].items() if chance})
            if event.measurement is not None:
                what = f"run[{number}]: the measurement {event.measurement!r}"
                believed = check_possible(believed, self.likelihood[event.measurement], what)


def draw(level: int, rng: Draws) -> Given:
    """One step over two states; two over three; three over three, in numbers that stay small."""
    scene = rng.choice(SCENES)
    states = (scene.states[0], scene.states[-1]) if level == 1 else rng.sample(scene.states, 3)
    often = ("1/2",) if level == 3 else ("1/2", "3/4", "4/5")
    chances = rng.fraction(*often), rng.fraction(*often)
    motion = draw_motion(scene, states, chances)
    run = tuple(Event(action=rng.choice(tuple(motion)), measurement=rng.choice(scene.readings)) for _ in range(level))
    taken = {event.action for event in run}
    return Given(
        belief=dict(zip(states, rng.split(len(states), (4,) if level == 3 else (2, 4, 5)), strict=True)),
        motion={action: rows for action, rows in motion.items() if action in taken},
        likelihood=draw_sensor(scene, states, rng, *(("1/4", "1/2", "3/4") if level == 3 else ())),
        run=run,
        story=scene.told,
    )


def question(given: Given) -> Question:
    """The belief, the motion and the sensor as tables; the belief after every step is a part."""
    states = tuple(given.belief)
    moves = any(event.action for event in given.run)
    senses = any(event.measurement for event in given.run)
    blocks = (
        *([Paragraph(given.story)] if given.story else []),
        Paragraph("Beforehand the belief $p(s)$ is:"),
        belief_bars(belief=given.belief),
        *((Paragraph(MOTION_TOLD), motion_table(given.motion, states)) if moves else ()),
        *((Paragraph(SENSOR_TOLD), likelihood_table(given.likelihood, states)) if senses else ()),
    )
    numbers = range(1, 1 + len(given.run)) if len(given.run) > 1 else [None]
    parts = [
        Part(f"{_told(event, number)} What is the belief then?", Values("p", states))
        for number, event in zip(numbers, given.run, strict=True)
    ]
    return Question(blocks, tuple(parts))


def _told(event: Event, number: int | None) -> str:
    """What happens in a step; the number is None where there is only one."""
    if event.action is None:
        told = f"the sensor reads “{event.measurement}”."
    elif event.measurement is None:
        told = f"the action is “{event.action}”; nothing is measured."
    else:
        told = f"the action is “{event.action}”, and after it the sensor reads “{event.measurement}”."
    return told[0].upper() + told[1:] if number is None else f"Step {number}: {told}"
