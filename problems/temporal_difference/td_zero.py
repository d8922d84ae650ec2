"""The values of the visited states after TD(0) updates along a run of transitions."""

from typing import Self

from pydantic import model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, Probability, StepSize
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import (
    Name,
    Trajectory,
    check_keys,
    discount,
    in_open,
    step_size,
    terminal_note,
    trajectory_table,
    values_table,
)
from rldrill.problems.parts import Part, Table
from rldrill.problems.settings import draw_setting

TITLE = "TD(0)"
SOURCE = "Sutton & Barto 2018, section 6.1"
REVISION = 1


class Given(Givens):
    """A run, the values before it, the step size and the discount."""

    trajectory: Trajectory
    values: dict[Name, Exact]
    alpha: StepSize
    gamma: Probability

    @model_validator(mode="after")
    def _fits(self) -> Self:
        known = tuple(dict.fromkeys((*self.trajectory.states, *self.trajectory.terminal)))
        needed = tuple(state for state in known if state not in self.trajectory.terminal)
        check_keys(self.values, known, "the value", needed=needed)
        return self

    @property
    def visited(self) -> tuple[str, ...]:
        """The states that are updated, in the order of their first visit."""
        return tuple(dict.fromkeys(self.trajectory.states[:-1]))


def draw(level: int, rng: Draws) -> Given:
    """One transition; then three that come back to a state; then two with the step size left open."""
    setting = draw_setting(rng)
    first, second, third = rng.shuffled(setting.states)[:3]
    states = {
        1: (first, second),
        2: (first, second, first, rng.choice((third, setting.terminal))),
        3: (first, second, first),
    }[level]
    rewards = tuple(rng.nonzero(-4, 8) for _ in states[1:])
    terminal = tuple(state for state in states if state == setting.terminal)
    named = [state for state in setting.states if state in states]
    return Given(
        trajectory=Trajectory(states=states, rewards=rewards, terminal=terminal),
        values={state: rng.nonzero(-4, 10) for state in named},
        alpha=Parameter("alpha") if level == 3 else rng.fraction("1/2", "1/4", "1/10", "1/5"),
        gamma=rng.fraction("1/2", "4/5", "9/10"),
    )


def question(given: Given) -> Question:
    """The run, the values before it; all visited states are asked for."""
    blocks = (
        Paragraph("An agent was seen to do this (a reward stands at the time at which it is received):"),
        trajectory_table(given.trajectory),
        *terminal_note(given.trajectory.terminal),
        Paragraph(f"Before the run the values are these. {step_size(given.alpha)} {discount(given.gamma)}"),
        values_table(given.values),
        Paragraph("TD(0) updates after every transition, with the values that are current then."),
    )
    visited = given.visited
    asked = f'$V("{visited[0]}")$' if len(visited) == 1 else "the value of every visited state"
    return Question(blocks, (Part("a", f"What is {asked} after the run{in_open(given)}?", Table("V", visited)),))
