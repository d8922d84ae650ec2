"""The values of what is visited after Monte Carlo updates from one episode, first visit or every visit."""

from typing import Annotated, Literal, TypeAlias

from pydantic import Discriminator, Field, Tag

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter, StepSize
from rldrill.problems.family import Givens, Question
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.models import values_table
from rldrill.problems.parts import Number, Numbers, Part, Values
from rldrill.problems.phrases import RETURN_DEFINED, in_open
from rldrill.problems.runs import (
    ActionRun,
    Episode,
    Trajectory,
    ValueRun,
    action_values_table,
    draw_rewards,
    run_situation,
    sought_parts,
    values_asked,
)
from rldrill.problems.settings import draw_visits, in_order

TITLE = "Monte Carlo prediction"
SOURCE = "Sutton & Barto 2018, sections 5.1 and 6.1"
REVISION = 6

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
        """Whether the returns are a part of their own; they say nothing about an open α, or a value to be found."""
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
    """An episode, the values before it, the step size, the discount, and which visits count.

    Where ``known`` is the value of the first state after the updates, what is left open is asked for.
    """

    @property
    def in_parts(self) -> bool:
        """Whether the returns are a part of their own: not where a letter is asked for."""
        return super().in_parts and self.known is None


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
    """Two steps; then three or four that come back to a state; then a letter left open, or to be found."""
    tours = ("abac.", "abca.", "abcb.", "aba.", "aab.")
    if level == 1:
        return _episode(rng, "ab.")
    kind = rng.below(4)
    if level == 2 or kind == 0:
        run = _episode(rng, *tours)
        return run if level == 2 else run.model_copy(update={"gamma": Parameter("gamma")})
    if kind == 1:
        run = _episode(rng, *tours[-2:])
        return run.model_copy(update={"alpha": Parameter("alpha")})
    visited = ("ab.", "abc.", "abb.") if kind == 2 else ("aa.", "aaa.")  # nothing else follows from V(a)
    run = _episode(rng, *visited)
    update: dict[str, object] = {"known": _learned(run)}
    update |= (
        {"alpha": Parameter("alpha")}
        if kind == 2
        else {"values": run.values | {run.trajectory.states[0]: Parameter("x")}}
    )
    return run.model_copy(update=update)


def _episode(rng: Draws, *visits: str) -> OfStates:
    setting, states = draw_visits(rng, *visits)
    gamma = rng.fraction("1/2", "3/4", "4/5")
    rewards = draw_rewards(rng, len(states) - 1, gamma)
    returns = _returns(rewards, gamma)
    values = {s: rng.fitting(-4, 10, returns[states.index(s)].__ne__) for s in in_order(states)}
    return OfStates(
        trajectory=Trajectory(states=states, rewards=rewards, terminal=(setting.terminal,)),
        values=values,
        alpha=rng.fraction(*(each for each in ("1/2", "1/4", "1/5") if fraction_of(each) != gamma)),
        gamma=gamma,
        visits=rng.choice(("first", "every")),
    )


def _returns(rewards: tuple[Fraction, ...], gamma: Fraction) -> tuple[Fraction, ...]:
    returns: tuple[Fraction, ...] = ()
    for reward in reversed(rewards):
        returns = (reward + (gamma * returns[0] if returns else 0), *returns)
    return returns


def _learned(run: OfStates) -> Fraction:
    """The value of the first state after an episode in which nothing is left open."""
    first, returns = run.trajectory.states[0], _returns(run.trajectory.rewards, Fraction(run.gamma))
    value = Fraction(run.values[first])
    for time in run.counted:
        if run.trajectory.states[time] == first:
            value += Fraction(run.alpha) * (returns[time] - value)
    return value


def question(given: Given) -> Question:
    """The returns first, then the updated values; in an open α the values alone."""
    what = "pair of state and action" if isinstance(given, OfActions) else "state"
    late = "All returns are computed at the end of the episode."
    if not given.revisits:
        told = f"Monte Carlo makes one update for every visited {what}. {late}"
    elif given.visits == "first":
        told = f"The method is first-visit Monte Carlo: only the first visit to a {what} counts. {late}"
    else:
        told = (
            f"The method is every-visit Monte Carlo: every visit to a {what} counts. {late} Then the updates are "
            "made in the order of the visits, each with the value that is current at that time."
        )
    table = action_values_table(given.values) if isinstance(given, OfActions) else values_table(given.values)
    blocks = (
        *run_situation(given, table),
        Paragraph(f"{told} {RETURN_DEFINED}" if given.in_parts else told),
    )
    if isinstance(given, OfStates) and given.known is not None:
        return Question(blocks, sought_parts(given))
    tail = in_open(given)
    values = _values(given, tail)
    if not given.in_parts:
        return Question(blocks, (values,))
    entries = tuple(f"R_{{{time}}}" for time in range(len(given.trajectory.rewards)))
    if len(entries) == 1:
        returns = Part(f"What is the return ${entries[0]}${tail}?", Number())
    else:
        listed = ", ".join(entries) if len(entries) < 4 else f"{entries[0]}, …, {entries[-1]}"
        returns = Part(f"What are the returns ${listed}$, in this order{in_open(given)}?", Numbers(entries))
    return Question(blocks, (returns, values))


def _values(given: Given, tail: str) -> Part:
    match given:
        case OfStates():
            return Part(f"What is {values_asked(given)} after the updates{tail}?", Values("V", given.visited))
        case OfActions():
            pairs = given.updated
            (state, action), *others = pairs
            asked = "the value of every updated pair" if others else f'$Q("{state}", "{action}")$'
            return Part(f"What is {asked} after the updates{tail}?", Values("Q", pairs))
