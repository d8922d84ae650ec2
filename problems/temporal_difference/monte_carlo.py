"""The values of what is visited after Monte Carlo updates from one episode, first visit or every visit."""

from typing import Annotated, Literal, TypeAlias

from pydantic import Discriminator, Field, Tag

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter, StepSize
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import values_table
from rldrill.problems.parts import Number, Numbers, Part, Values
from rldrill.problems.phrases import in_open
from rldrill.problems.runs import (
    ActionRun,
    Episode,
    ValueRun,
    action_values_table,
    draw_episode,
    run_situation,
    values_asked,
)
from rldrill.problems.settings import draw_setting

TITLE = "Monte Carlo prediction"
SOURCE = "Sutton & Barto 2018, sections 5.1 and 6.1"
REVISION = 1

#: A state; or a state and an action.
Visited: TypeAlias = str | tuple[str, str]


class Visits(Givens):
    """An episode, and which visits in it count."""

    trajectory: Episode = Field(description="The episode.")
    alpha: StepSize = Field(description="The step size.")
    visits: Literal["first", "every"] = Field(
        description="Whether only the first visit to a state counts, or every visit."
    )

    @property
    def occasions(self) -> tuple[Visited, ...]:
        """What is visited at every time: the state."""
        return self.trajectory.states[:-1]

    @property
    def in_parts(self) -> bool:
        """Whether the returns are a part of their own; they say nothing about an open α."""
        return not isinstance(self.alpha, Parameter)

    @property
    def revisits(self) -> bool:
        """Whether anything is visited more than once."""
        return len(set(self.occasions)) < len(self.occasions)

    @property
    def counted(self) -> tuple[int, ...]:
        """The times of the visits that count: the first of each, or all."""
        seen = self.occasions
        return tuple(time for time, what in enumerate(seen) if self.visits == "every" or seen.index(what) == time)


class OfStates(Visits, ValueRun):
    """An episode, the values before it, the step size, the discount, and which visits count."""


class OfActions(Visits, ActionRun):
    """An episode with its actions, the action values before it, α and γ, and which visits of a pair count."""

    trajectory: Episode = Field(
        description="The episode, with the actions.",
        examples=[{"states": ["A", "B", "end"], "actions": ["left", "right"], "rewards": [1, 2], "terminal": ["end"]}],
    )

    @property
    def occasions(self) -> tuple[Visited, ...]:
        """What is visited at every time: the state with the action taken in it."""
        return tuple((move.state, move.action) for move in self.moves)


def _kind(given: object) -> str:
    match given:
        case {"values": dict(rows)} if any(isinstance(row, dict) for row in rows.values()):
            return "actions"
    return "states"


Given = Annotated[Annotated[OfStates, Tag("states")] | Annotated[OfActions, Tag("actions")], Discriminator(_kind)]


def draw(level: int, rng: Draws) -> Given:
    """Two steps; then four that come back to a state; then the same with γ left open."""
    setting = draw_setting(rng)
    first, second, third = rng.shuffled(setting.states)[:3]
    tours = ((first, second, first, third), (first, second, third, first), (first, second, third, second))
    states = (first, second) if level == 1 else rng.choice(tours)
    return OfStates(
        trajectory=draw_episode(rng, states, setting.terminal),
        values={state: rng.nonzero(-4, 10) for state in setting.states if state in states},
        alpha=rng.fraction("1/2", "1/4", "1/10") if level < 3 else rng.fraction("1/2", "1/4"),
        gamma=Parameter("gamma") if level == 3 else rng.fraction("1/2", "4/5"),
        visits=rng.choice(("first", "every")),
    )


def question(given: Given) -> Question:
    """The returns first, then the updated values; in an open α the values alone."""
    what = "pair of state and action" if isinstance(given, OfActions) else "state"
    order = (
        f"Only the first visit to a {what} in the episode counts: first-visit Monte Carlo."
        if given.visits == "first"
        else f"Every visit to a {what} counts: every-visit Monte Carlo."
    )
    table = action_values_table(given.values) if isinstance(given, OfActions) else values_table(given.values)
    blocks = (
        *run_situation(given, table),
        Paragraph(
            f"{order} All returns are computed when the episode is over. Then the updates are made in the order of "
            "the visits, each with the value that is current then."
        ),
    )
    tail = in_open(given)
    values = _values(given, tail)
    if not given.in_parts:
        return Question(blocks, (values,))
    entries = tuple(f"R_{{{time}}}" for time in range(len(given.trajectory.rewards)))
    if len(entries) == 1:
        returns = Part(f"What is the return ${entries[0]}${tail}?", Number())
    else:
        listed = ", ".join(entries) if len(entries) < 4 else f"{entries[0]}, …, {entries[-1]}"
        returns = Part(f"What are the returns ${listed}$, in this order{tail}?", Numbers(entries))
    return Question(blocks, (returns, values))


def _values(given: Given, tail: str) -> Part:
    match given:
        case OfStates():
            return Part(f"What is {values_asked(given)} after the updates{tail}?", Values("V", given.visited))
        case OfActions():
            pairs = given.updated
            (state, action), *others = pairs
            asked = "the value of every pair that is visited" if others else f'$Q("{state}", "{action}")$'
            return Part(f"What is {asked} after the updates{tail}?", Values("Q", pairs))
