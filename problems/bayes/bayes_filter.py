"""The belief over the states of a robot after a run of actions and measurements."""

from itertools import pairwise
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.beliefs import (
    BELIEF_TOLD,
    MOTION_TOLD,
    SENSOR_TOLD,
    Likelihood,
    LikelihoodField,
    Motion,
    MotionField,
    Outcome,
    belief_shown,
    check_distribution,
    check_likelihood,
    check_motion,
    check_outcome,
    check_possible,
    check_predictions,
    filled,
    likelihood_table,
    motion_table,
    predicted,
    updated,
)
from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter, Scalar, shown
from rldrill.problems.family import AskedFor, Givens, Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Name, OpenDistributionField, check_keys
from rldrill.problems.parts import Number, Part, Values
from rldrill.problems.scenes import SCENES, draw_motion, draw_sensor

TITLE = "Bayes filter"
SOURCE = "Thrun, Burgard & Fox 2005, section 2.4"
REVISION = 7


class Event(Givens):
    """What happens in one step: first an action, then a measurement; one of them may be missing."""

    action: Name | None = Field(
        default=None, description="The action that is taken, if there is one.", examples=["push"]
    )
    measurement: Name | None = Field(
        default=None, description="What is measured after it, if anything is.", examples=["light"]
    )

    @model_validator(mode="after")
    def _something(self) -> Self:
        if self.action is None and self.measurement is None:
            raise ValueError("a step of the run has neither an action nor a measurement; give one of them, or both")
        return self


class Given(AskedFor):
    """A belief over states, where actions lead, what the sensor reads in every state, and the run.

    With ``outcome`` a probability is left open, and found from the belief after the first step. With ``ahead`` there is
    one step more, of which the probability of its measurement is asked for.
    """

    belief: OpenDistributionField = Field(min_length=2, description="The probability of every state beforehand.")
    motion: MotionField = Field(
        default_factory=dict,
        description="For every action and state the probabilities of the next states; needed if the run has actions.",
    )
    likelihood: LikelihoodField = Field(
        default_factory=dict,
        description="For every reading its probability in every state; needed if the run has measurements.",
    )
    run: tuple[Event, ...] = Field(
        min_length=1, max_length=25, description="The steps, each with an action, a measurement or both."
    )
    outcome: Outcome | None = Field(
        default=None,
        description="What is known of the belief after the first step, if a probability is to be found from it.",
        examples=[{"state": "open", "probability": "3/4"}],
    )
    ahead: Event | None = Field(
        default=None,
        description="One step more, whose measurement is not made yet: its probability is asked for.",
        examples=[{"action": "push", "measurement": "light"}],
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
        if self.left_open and self.outcome is None:
            raise ValueError("motion: no probability may be left open here without an outcome to find it from")
        check_outcome(self.outcome, self.left_open, states)
        if self.ahead is not None and self.ahead.measurement is None:
            raise ValueError(
                "ahead: the step ahead has no measurement whose probability could be asked for; give it one"
            )
        for event in self.events:
            check_keys(dict.fromkeys(filter(None, [event.action])), tuple(self.motion), "an action", (), by="motion")
            read = dict.fromkeys(filter(None, [event.measurement]))
            check_keys(read, tuple(self.likelihood), "a measurement", (), by="likelihood")
        check_predictions(sum(event.action is not None for event in self.events), len(states), "run")
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

    @property
    def events(self) -> tuple[Event, ...]:
        """The steps of the run, and the one ahead."""
        return self.run if self.ahead is None else (*self.run, self.ahead)


_BOTH, _MOVE, _SENSE = (True, True), (True, False), (False, True)
#: Which of action and measurement the steps have, by level.
_SHAPES = {
    1: ((_BOTH,),),
    2: ((_BOTH, _BOTH), (_SENSE, _BOTH), (_BOTH, _MOVE), (_MOVE, _BOTH)),
    3: ((_BOTH, _BOTH), (_BOTH, _SENSE), (_BOTH, _MOVE)),
}
#: The greatest denominator of a belief on the way.
_FINEST = {1: 16, 2: 32, 3: 100}
_OPEN = Parameter("q")


def draw(level: int, rng: Draws) -> Given:
    """One step over two states; two steps; a probability that is found from the first, or what is read next."""
    scene = rng.choice(SCENES)
    states = (scene.states[0], scene.states[-1]) if level == 1 else rng.sample(scene.states, 2 + rng.below(2))
    found = rng.choice(("nothing", "motion", "belief")) if level == 3 else "nothing"
    if found == "belief":
        states = (states[0], states[-1])
    while True:
        chances = rng.fraction("1/2", "3/4"), rng.fraction("1/2", "3/4")
        q = rng.fraction("1/4", "1/2", "3/4", "1/3", "2/3") if found != "nothing" else Fraction(0)
        motion = draw_motion(scene, states, (_OPEN, _OPEN) if found == "motion" else chances)
        likelihood = draw_sensor(scene, states, rng, "1/4", "1/2", "3/4")
        belief: tuple[Scalar, ...] = (
            (_OPEN, Parameter("1-q")) if found == "belief" else rng.split(len(states), (2, 3, 4))
        )
        run = tuple(
            Event(
                action=rng.choice(tuple(motion)) if moves else None,
                measurement=rng.choice(scene.readings) if senses else None,
            )
            for moves, senses in rng.choice(_SHAPES[level] if level < 3 or found != "nothing" else _SHAPES[level][:2])
        )
        start = {state: filled(chance, q) for state, chance in zip(states, belief, strict=True)}
        beliefs = _beliefs(start, motion, likelihood, run, q)
        unchanged = any(before == after for before, after in pairwise((start, *beliefs)))
        finest = max(chance.denominator for after in beliefs for chance in after.values())
        # What is read next depends on every move, if the readings tell all states apart.
        alike = level == 3 and len(set(likelihood[scene.readings[0]].values())) < len(states)
        if finest <= _FINEST[level] and not unchanged and not alike:
            break
    state = rng.choice(states)
    steps = run if level < 3 or found != "nothing" else run[:1]
    taken, read = {event.action for event in run}, {event.measurement for event in run}
    return Given(
        belief=dict(zip(states, belief, strict=True)),
        motion={action: rows for action, rows in motion.items() if action in taken},
        likelihood={reading: row for reading, row in likelihood.items() if reading in read},
        run=steps,
        outcome=Outcome(state=state, probability=beliefs[0][state]) if found != "nothing" else None,
        ahead=run[1] if steps != run else None,
        story=scene.told,
    )


def _beliefs(
    belief: dict[str, Fraction], motion: Motion, likelihood: Likelihood, run: tuple[Event, ...], q: Fraction
) -> list[dict[str, Fraction]]:
    """The belief after every step."""
    beliefs = []
    for event in run:
        if event.action is not None:
            belief = predicted(belief, motion[event.action], q)
        if event.measurement is not None:
            belief = updated(belief, likelihood[event.measurement], q)
        beliefs.append(belief)
    return beliefs


def question(given: Given) -> Question:
    """The belief, the motion and the sensor as tables; the belief after every step is a part."""
    states = tuple(given.belief)
    moves = any(event.action for event in given.events)
    senses = any(event.measurement for event in given.events)
    blocks = (
        *([Paragraph(given.story)] if given.story else []),
        Paragraph(BELIEF_TOLD),
        belief_shown(given.belief),
        *((Paragraph(MOTION_TOLD), motion_table(given.motion, states)) if moves else ()),
        *((Paragraph(SENSOR_TOLD), likelihood_table(given.likelihood, states)) if senses else ()),
        *(
            [Paragraph(f"The probability ${shown(Parameter(given.left_open[0]))}$ is unknown.")]
            if given.outcome
            else []
        ),
    )
    several = len(given.events) > 1
    parts = []
    for number, event in enumerate(given.run, 1):
        told = _told(event, number if several else None, moves=moves)
        if given.outcome is not None and number == 1:
            letter, share = shown(Parameter(given.left_open[0])), shown(given.outcome.probability)
            known = f"Afterwards the belief is $p({given.outcome.state}) = {share}$."
            parts.append(Part(f"{told} {known} What is ${letter}$?", Number()))
        else:
            parts.append(Part(f"{told} What is the belief afterwards?", Values("p", states)))
    if given.ahead is not None:
        acts = f"the action will be “{given.ahead.action}”. " if given.ahead.action else ""
        told = f"Step {len(given.events)}: {acts or 'a measurement follows. '}"
        ask = f"With what probability will the sensor then read “{given.ahead.measurement}”?"
        parts.append(Part(told + ask, Number()))
    return Question(blocks, tuple(parts))


def _told(event: Event, number: int | None, *, moves: bool) -> str:
    """What happens in a step, one of which moves; the number is None where there is only one."""
    if event.action is None:
        told = f"{'no action is taken; ' if moves else ''}the sensor reads “{event.measurement}”."
    elif event.measurement is None:
        told = f"the action is “{event.action}”; nothing is measured."
    else:
        told = f"the action is “{event.action}”, then the sensor reads “{event.measurement}”."
    return told[0].upper() + told[1:] if number is None else f"Step {number}: {told}"
