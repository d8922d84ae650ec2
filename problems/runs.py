"""Runs of an agent: what was visited, done and earned, and the updates that follow it."""

from collections.abc import Mapping
from fractions import Fraction
from itertools import pairwise
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Exact, Scalar, StepSize, shown
from rldrill.problems.family import Givens
from rldrill.problems.models import Name, check_keys
from rldrill.problems.phrases import check_one_open, discount, step_size, terminal_note
from rldrill.problems.pictures import Timeline
from rldrill.problems.settings import draw_setting

#: Runs of at most so many states are drawn.
_DRAWN = 12


class Trajectory(Givens):
    """A run $s_0, (a_0,) r_1, s_1, (a_1,) r_2, …$; there is one reward fewer than states."""

    states: tuple[Name, ...] = Field(
        min_length=2, description="The states in the order of the visits, the last one included."
    )
    actions: tuple[Name, ...] = Field(
        default=(),
        description="The actions taken in them; some methods need them, and the last state's too.",
        examples=[["left", "right"]],
    )
    rewards: tuple[Exact, ...] = Field(min_length=1, description="The reward after every state but the last.")
    terminal: tuple[Name, ...] = Field(
        default=(),
        description="The states in which an episode ends.",
        examples=[["end"]],
    )

    @model_validator(mode="after")
    def _consistent(self) -> "Trajectory":
        if len(self.rewards) != len(self.states) - 1:
            raise ValueError(
                f"{len(self.states)} states need {len(self.states) - 1} rewards between them, not {len(self.rewards)}"
            )
        if self.actions and len(self.actions) not in (len(self.rewards), len(self.states)):
            raise ValueError(f"{len(self.rewards)} rewards need as many actions, not {len(self.actions)}")
        for state, after in pairwise(self.states):
            if state in self.terminal:
                raise ValueError(f"{state!r} is terminal, so the run cannot go on to {after!r}")
        return self


class Episode(Trajectory):
    """A run to its end: the last state is terminal."""

    states: tuple[Name, ...] = Field(
        min_length=2, max_length=301, description="The states in the order of the visits, the terminal one included."
    )

    @model_validator(mode="after")
    def _ends(self) -> Self:
        if self.states[-1] not in self.terminal:
            raise ValueError(f"an episode ends in a terminal state; list {self.states[-1]!r}, its last, as terminal")
        return self


def draw_episode(rng: Draws, states: tuple[str, ...], terminal: str) -> Episode:
    """An episode through these states to the terminal one, with small whole rewards that are not 0."""
    rewards = tuple(rng.nonzero(-4, 8) for _ in states)
    return Episode(states=(*states, terminal), rewards=rewards, terminal=(terminal,))


class ValueRun(Givens):
    """A run, the state values before it, the step size and the discount."""

    trajectory: Trajectory = Field(description="What the agent did.")
    values: dict[Name, Exact] = Field(description="The value of every state before the run.")
    alpha: StepSize = Field(description="The step size.")
    gamma: Discount

    @model_validator(mode="after")
    def _valued(self) -> Self:
        check_values(self.values, self.trajectory)
        check_one_open(self)
        return self

    @property
    def visited(self) -> tuple[str, ...]:
        """The states that are left, in the order of their first visit."""
        return tuple(dict.fromkeys(self.trajectory.states[:-1]))


class ActionRun(Givens):
    """A run with its actions, the action values before it, the step size and the discount."""

    trajectory: Trajectory = Field(description="What the agent did.")
    values: dict[Name, dict[Name, Exact]] = Field(
        description="For every state the values of its actions before the run."
    )
    alpha: StepSize = Field(description="The step size.")
    gamma: Discount

    @model_validator(mode="after")
    def _valued(self) -> Self:
        run = self.trajectory
        if len(run.actions) < len(run.rewards):
            raise ValueError("trajectory: the action taken in every state that is left is needed")
        for state in run.states:
            if state not in run.terminal and not self.values.get(state):
                raise ValueError(f"values: the action values of {state!r} are missing")
        for state, action in zip(run.states, run.actions, strict=False):
            if state in run.terminal:
                raise ValueError(f"trajectory: the run ends in {state!r}, so no action is taken there")
            if action not in self.values[state]:
                raise ValueError(f"values: {action!r} is taken in {state!r} but has no value there")
        return self

    def demand_last_action(self, method: str) -> None:
        """Raise a ``ValueError`` unless the method, which needs the last action, is given it."""
        if not self.last_action_known:
            last = self.trajectory.states[-1]
            raise ValueError(f"trajectory: {method} needs the action taken in {last!r}, the last state, too")

    @property
    def updated(self) -> tuple[tuple[str, str], ...]:
        """The pairs of state and action that are updated, in the order of their first visit."""
        run = self.trajectory
        return tuple(dict.fromkeys(zip(run.states[: len(run.rewards)], run.actions, strict=False)))

    @property
    def last_action_known(self) -> bool:
        """Whether something is known to be done in the last state, or nothing is because the run ends there."""
        run = self.trajectory
        return run.states[-1] in run.terminal or len(run.actions) == len(run.states)


def check_values(values: Mapping[str, object], run: Trajectory) -> None:
    """Demand a value for every state of a run that is not terminal.

    Raises:
        ValueError: one is missing, or given for an unknown state.
    """
    known = tuple(dict.fromkeys((*run.states, *run.terminal)))
    check_keys(values, known, "the value", needed=tuple(state for state in known if state not in run.terminal))


def draw_action_run(
    rng: Draws, visits: str, choices: int, *, last: bool = True, same: bool = False
) -> tuple[Trajectory, dict[str, dict[str, Fraction]]]:
    """A run through a world, and different action values in every state that it visits.

    Args:
        rng: the stream of choices.
        visits: a letter for every state, in the order of the visits; a full stop is the end: ``"aba."``.
        choices: how many actions each state has.
        last: whether the action in the last state is known too, unless the run ends there.
        same: whether a state that is visited again sees the same action again.
    """
    setting = draw_setting(rng)
    named = dict(zip(sorted(set(visits) - {"."}), rng.shuffled(setting.states), strict=False))
    states = tuple(named.get(letter, setting.terminal) for letter in visits)
    left = [state for state in (states if last else states[:-1]) if state != setting.terminal]
    actions = tuple(rng.choice(setting.actions[:choices]) for _ in left)
    if same:
        habit = dict(zip(left, actions, strict=True))
        actions = tuple(habit[state] for state in left)
    run = Trajectory(
        states=states,
        actions=actions,
        rewards=tuple(rng.nonzero(-4, 8) for _ in states[1:]),
        terminal=tuple(state for state in states if state == setting.terminal),
    )
    return run, {state: draw_row(rng, setting.actions[:choices]) for state in setting.states if state in states}


def draw_row(rng: Draws, actions: tuple[str, ...]) -> dict[str, Fraction]:
    """A different whole number for every action."""
    return dict(zip(actions, rng.distinct(len(actions), -3, 9), strict=True))


def trajectory_table(run: Trajectory) -> Table:
    """A run as a table over time; what lies outside it is a dash."""
    times = range(len(run.states))
    rows = [("$s_t$", *run.states)]
    if run.actions:
        rows.append(("$a_t$", *run.actions, *["–"] * (len(run.states) - len(run.actions))))
    rows.append(("$r_t$", "–", *(f"${shown(reward)}$" for reward in run.rewards)))
    return Table(header=("$t$", *(f"${t}$" for t in times)), rows=tuple(rows))


def timeline(run: Trajectory) -> Timeline:
    """A run as a picture."""
    return Timeline(
        tuple(f"$t = {time}$" for time in range(len(run.states))),
        run.states,
        run.actions,
        tuple(f"$r_{{{time}}} = {shown(reward)}$" for time, reward in enumerate(run.rewards, 1)),
        ended=run.states[-1] in run.terminal,
    )


def seen(run: Trajectory) -> tuple[Block, ...]:
    """What an agent was seen to do, and where that ends; a long run is a table."""
    drawn = len(run.states) <= _DRAWN
    told = "" if drawn else " (a reward stands at the time at which it is received)"
    return (
        Paragraph(f"An agent was seen to do this{told}:"),
        timeline(run) if drawn else trajectory_table(run),
        *terminal_note(run.terminal),
    )


def action_values_table(values: Mapping[str, Mapping[str, Scalar]], of: str = "Q(s, a)") -> Table:
    """Action values or the like, a line for every state and a column for every action."""
    actions = tuple(dict.fromkeys(action for row in values.values() for action in row))
    return Table(
        header=(f"${of}$", *actions),
        rows=tuple(
            (state, *(f"${shown(row[action])}$" if action in row else "–" for action in actions))
            for state, row in values.items()
        ),
    )


def run_situation(given: ValueRun | ActionRun, *values: Table, more: str = "") -> tuple[Block, ...]:
    """A run, and the values before it; ``more`` is said after the step size and the discount."""
    told = f"Before the run the values are these. {step_size(given.alpha)} {discount(given.gamma)} {more}"
    return (*seen(given.trajectory), Paragraph(told.rstrip()), *values)


def values_asked(given: ValueRun) -> str:
    """What a question asks for where every visited state changes."""
    visited = given.visited
    return f'$V("{visited[0]}")$' if len(visited) == 1 else "the value of every visited state"


def run_blocks(given: ValueRun | ActionRun, values: Table, method: str) -> tuple[Block, ...]:
    """The situation of a question about updates along a run: the run, the values before it, and the method."""
    return (
        *run_situation(given, values),
        Paragraph(f"{method} updates after every transition, with the values that are current then."),
    )
