"""The action values after Q-learning updates along a run of transitions."""

from typing import Self

from pydantic import model_validator

from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Probability, StepSize, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import (
    Name,
    Trajectory,
    discount,
    in_open,
    step_size,
    terminal_note,
    trajectory_table,
)
from rldrill.problems.parts import Part
from rldrill.problems.parts import Table as TableKind
from rldrill.problems.settings import draw_setting

TITLE = "Q-learning"
SOURCE = "Sutton & Barto 2018, section 6.5"
REVISION = 1


class Given(Givens):
    """A run with its actions, the action values before it, the step size and the discount."""

    trajectory: Trajectory
    values: dict[Name, dict[Name, Exact]]
    alpha: StepSize
    gamma: Probability

    @model_validator(mode="after")
    def _fits(self) -> Self:
        run = self.trajectory
        if len(run.actions) < len(run.rewards):
            raise ValueError("trajectory: Q-learning needs the action taken in every state that is left")
        for state in run.states:
            if state not in run.terminal and not self.values.get(state):
                raise ValueError(f"values: the action values of {state!r} are missing")
        for state, action in zip(run.states, run.actions, strict=False):
            if action not in self.values.get(state, {}):
                raise ValueError(f"values: {action!r} is taken in {state!r} but has no value there")
        return self

    @property
    def updated(self) -> tuple[tuple[str, str], ...]:
        """The pairs of state and action that are updated, in the order of their first visit."""
        run = self.trajectory
        return tuple(dict.fromkeys(zip(run.states[: len(run.rewards)], run.actions, strict=False)))


def draw(level: int, rng: Draws) -> Given:
    """One transition; then three that come back to a state; then four over three states."""
    setting = draw_setting(rng)
    first, second, third = rng.shuffled(setting.states)[:3]
    choices = setting.actions[: 2 if level == 1 else 3]
    states = {
        1: (first, second),
        2: (first, second, first, second),
        3: (first, second, third, second, first),
    }[level]
    named = [state for state in setting.states if state in states]
    values = {state: dict(zip(choices, rng.distinct(len(choices), -3, 9), strict=True)) for state in named}
    return Given(
        trajectory=Trajectory(
            states=states,
            actions=tuple(rng.choice(choices) for _ in states),
            rewards=tuple(rng.nonzero(-4, 8) for _ in states[1:]),
        ),
        values=values,
        alpha=rng.fraction("1/2", "1/4", "1/5"),
        gamma=rng.fraction("1/2", "4/5", "9/10"),
    )


def values_table(values: dict[str, dict[str, Exact]]) -> Table:
    """Action values, a line for every state and a column for every action."""
    actions = tuple(dict.fromkeys(action for row in values.values() for action in row))
    return Table(
        header=("$Q(s, a)$", *actions),
        rows=tuple(
            (state, *(f"${shown(row[action])}$" if action in row else "–" for action in actions))
            for state, row in values.items()
        ),
    )


def question(given: Given) -> Question:
    """The run and the table before it; all updated pairs are asked for."""
    blocks = (
        Paragraph("An agent was seen to do this (a reward stands at the time at which it is received):"),
        trajectory_table(given.trajectory),
        *terminal_note(given.trajectory.terminal),
        Paragraph(f"Before the run the action values are these. {step_size(given.alpha)} {discount(given.gamma)}"),
        values_table(given.values),
        Paragraph("Q-learning updates after every transition, with the values that are current then."),
    )
    pairs = given.updated
    asked = f'$Q("{pairs[0][0]}", "{pairs[0][1]}")$' if len(pairs) == 1 else "the value of every pair that is updated"
    return Question(blocks, (Part("a", f"What is {asked} after the run{in_open(given)}?", TableKind("Q", pairs)),))
