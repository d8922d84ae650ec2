"""The belief over states after one or several actions."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.beliefs import (
    BELIEF_TOLD,
    MOTION_TOLD,
    MotionField,
    Outcome,
    belief_shown,
    check_distribution,
    check_motion,
    check_outcome,
    check_predictions,
    filled,
    motion_table,
    predicted,
)
from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter, Scalar, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Name, OpenDistributionField, check_keys
from rldrill.problems.parts import Number, Part, Values
from rldrill.problems.phrases import in_open
from rldrill.problems.scenes import SCENES, draw_motion

TITLE = "Belief after an action"
SOURCE = "Thrun, Burgard & Fox 2005, section 2.4"
REVISION = 5


class Given(Givens):
    """A belief over states, where every action leads from every state, and the actions taken.

    A probability may be left open; with ``outcome`` it is found from the belief after the first action, or after
    more of them.
    """

    FOUND_BY = "outcome"

    belief: OpenDistributionField = Field(min_length=2, description="The probability of every state beforehand.")
    motion: MotionField = Field(description="For every action and state the probabilities of the next states.")
    actions: tuple[Name, ...] = Field(
        min_length=1, max_length=26, description="The actions in the order in which they are taken."
    )
    outcome: Outcome | None = Field(
        default=None,
        description="What is known of the belief after the first action, if a probability is to be found from it.",
        examples=[{"state": "open", "probability": "3/4"}],
    )
    after: int = Field(
        default=1,
        ge=1,
        exclude_if=lambda after: after == 1,
        description="After how many actions the belief is that of the outcome.",
    )
    story: str = Field(
        default="", max_length=200, pattern=r"^[^$\\]*$", description="A sentence that is printed first."
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_distribution(self.belief, "belief")
        check_motion(self.motion, tuple(self.belief))
        check_keys(dict.fromkeys(self.actions), tuple(self.motion), "an action", (), by="motion")
        check_outcome(self.outcome, self.left_open, states=tuple(self.belief))
        check_predictions(len(self.actions), len(self.belief), "actions")
        if self.after > 1 and (self.outcome is None or self.after > len(self.actions)):
            raise ValueError(f"after: there is no outcome, or there are fewer than {self.after} actions before it")
        return self


_OPEN = Parameter("q")
#: The greatest denominator of a belief on the way.
_FINEST = {1: 16, 2: 36, 3: 80}


def draw(level: int, rng: Draws) -> Given:
    """One action over two states; two actions; two, with a probability left open, or found from the end of them."""
    scene = rng.choice(SCENES)
    states = (scene.states[0], scene.states[-1]) if level == 1 else rng.sample(scene.states, 2 + rng.below(2))
    left_open = rng.choice(("motion", "motion", "belief")) if level == 3 else ""
    found = left_open == "belief" or (level == 3 and rng.chance(Fraction(1, 2)))
    if left_open == "belief":
        states = (states[0], states[-1])
    while True:
        chances = rng.fraction("1/2", "1/4", "3/4"), rng.fraction("1/2", "1/4", "3/4")
        motion = draw_motion(scene, states, (_OPEN, _OPEN) if left_open == "motion" else chances)
        q = rng.fraction("1/4", "1/2", "3/4", "1/3", "2/3", "1/5", "4/5") if left_open else Fraction(0)
        belief: tuple[Scalar, ...] = (
            (_OPEN, Parameter("1-q")) if left_open == "belief" else rng.split(len(states), (3, 4, 5))
        )
        actions = tuple(rng.choice(tuple(motion)) for _ in range(1 if level == 1 else 2))
        start = {state: filled(chance, q) for state, chance in zip(states, belief, strict=True)}
        beliefs = [start]
        for action in actions:
            beliefs.append(predicted(beliefs[-1], motion[action], q))
        finest = max(chance.denominator for each in beliefs for chance in each.values())
        changing = len({tuple(each.values()) for each in beliefs}) == len(beliefs)
        if finest <= _FINEST[level] and changing:
            break
    state = rng.choice(states)
    after = 2 if left_open == "belief" else 1  # in two actions with the same letter it would be squared
    return Given(
        belief=dict(zip(states, belief, strict=True)),
        motion={action: motion[action] for action in motion if action in actions},
        actions=actions,
        outcome=Outcome(state=state, probability=beliefs[after][state]) if found else None,
        after=after if found else 1,
        story=scene.told,
    )


def question(given: Given) -> Question:
    """The belief and the motion as tables; the belief after every action is a part."""
    states = tuple(given.belief)
    letter = shown(Parameter(given.left_open[0])) if given.left_open else ""
    open_ = "unknown" if given.outcome else "left open"
    blocks = (
        *([Paragraph(given.story)] if given.story else []),
        Paragraph(BELIEF_TOLD),
        belief_shown(given.belief),
        Paragraph(MOTION_TOLD),
        motion_table(given.motion, states),
        *([Paragraph(f"The probability ${letter}$ is {open_}.")] if letter else []),
    )
    parts: list[Part] = []
    if given.outcome is not None:
        first = ", then ".join(f"“{action}”" for action in given.actions[: given.after])
        which = f"action is {first}" if given.after == 1 else f"actions are {first}"
        known = f"Afterwards the belief is $p({given.outcome.state}) = {shown(given.outcome.probability)}$."
        parts.append(Part(f"The {which}; nothing is measured. {known} What is ${letter}$?", Number()))
        parts += [
            Part(f"What was the belief after action {number}, “{action}”?", Values("p", states))
            for number, action in enumerate(given.actions[: given.after - 1], 1)
        ]
    for action in given.actions[given.after if given.outcome else 0 :]:
        told = f"The {'next ' if parts else ''}action is “{action}”; nothing is measured."
        parts.append(Part(f"{told} What is the belief afterwards{in_open(given)}?", Values("p", states)))
    return Question(blocks, tuple(parts))
