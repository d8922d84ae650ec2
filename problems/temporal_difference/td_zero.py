"""The values of the updated states after TD(0) updates along a run of transitions."""

from itertools import pairwise
from typing import Annotated, Self

from pydantic import Tag, model_validator

from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import values_table
from rldrill.problems.parts import Part, Values
from rldrill.problems.phrases import in_open
from rldrill.problems.runs import (
    RUN_OR_MOVES,
    AskErrors,
    Trajectory,
    ValueMoves,
    ValueRun,
    after,
    draw_reward,
    draw_values,
    errors_asked,
    readable,
    run_blocks,
    sought_parts,
    told_apart,
    values_asked,
)
from rldrill.problems.settings import draw_visits, in_order

TITLE = "TD(0)"
SOURCE = "Sutton & Barto 2018, section 6.1"
REVISION = 4


class AlongRun(ValueRun):
    """A run, the values before it, the step size and the discount.

    Where ``known`` is the value of the first state after the run, what is left open is asked for.
    """

    td_errors: AskErrors = False

    @model_validator(mode="after")
    def _one_question(self) -> Self:
        if self.td_errors and self.known is not None:
            raise ValueError("td_errors: they are not asked for where a value after the run is known")
        return self


class Separate(ValueMoves):
    """Transitions that need not join, the values before them, the step size and the discount."""

    td_errors: AskErrors = False


Given = Annotated[Annotated[AlongRun, Tag("run")] | Annotated[Separate, Tag("transitions")], RUN_OR_MOVES]


def draw(level: int, rng: Draws) -> Given:
    """One transition; then three that come back to a state; then a letter left open, or to be found."""
    if level == 1:
        return _run(rng, "ab")
    if level == 2:
        run = _run(rng, "abac", "aba.", "aab.", "abb.", "abaa")
        if rng.chance(Fraction(1, 3)):
            return run.model_copy(update={"td_errors": True})
        return run if rng.chance(Fraction(1, 2)) else _separate(run)
    kind = rng.below(4)
    if kind == 0:
        run = _run(rng, "abab", "aba.", "abb.")
        return run.model_copy(update={"alpha": Parameter("alpha")})
    if kind == 1:
        run = _run(rng, "abab", "abac", "abbc")
        return run.model_copy(update={"gamma": Parameter("gamma")})
    run = _run(rng, *(("abc", "ab.") if kind == 2 else ("aba.", "abac")))
    first, second, *_ = run.trajectory.states
    known = _learned(run)[first]
    if kind == 2:
        return run.model_copy(update={"alpha": Parameter("alpha"), "known": known})
    return run.model_copy(update={"values": run.values | {second: Parameter("x")}, "known": known})


def _run(rng: Draws, *visits: str) -> AlongRun:
    """A run with one of these orders of visits, whose values stay readable."""
    setting, states = draw_visits(rng, *visits)
    run = _rewarded(rng, states, setting.terminal)
    while not (readable(_learned(run).values()) and (len(states) == _ONE_STEP or _is_told_apart(run))):
        run = _rewarded(rng, states, setting.terminal)
    return run


#: The states of a run of one transition.
_ONE_STEP = 2


def _is_told_apart(run: AlongRun) -> bool:
    return told_apart(run.trajectory, {state: Fraction(value) for state, value in run.values.items()})


def _rewarded(rng: Draws, states: tuple[str, ...], end: str) -> AlongRun:
    """A run after whose first updates the values are whole, and are so when they are discounted, if that can be."""
    terminal = tuple(state for state in states if state == end)
    alpha, gamma = rng.fraction("1/2", "1/4", "1/5"), rng.fraction("1/2", "1/2", "3/4", "4/5")
    values = draw_values(rng, in_order(states), gamma)
    V = values | dict.fromkeys(terminal, Fraction(0))
    rewards: list[Fraction] = []
    for number, (state, next_) in enumerate(pairwise(states)):
        unit = gamma.denominator if number == 0 and len(states) > 2 else None
        rewards.append(draw_reward(rng, V[state], gamma * V[next_], alpha, unit))
        V[state] += alpha * (rewards[-1] + gamma * V[next_] - V[state])
    run = Trajectory(states=states, rewards=tuple(rewards), terminal=terminal)
    return AlongRun(trajectory=run, values=values, alpha=alpha, gamma=gamma)


def _learned(run: AlongRun) -> dict[str, Fraction]:
    """The values after a run in which nothing is left open."""
    V = {state: Fraction(value) for state, value in run.values.items()} | dict.fromkeys(run.terminal, Fraction(0))
    for state, next_, reward in run.moves:
        V[state] += Fraction(run.alpha) * (reward + Fraction(run.gamma) * V[next_] - V[state])
    return V


def _separate(run: AlongRun) -> Separate:
    """The same transitions in a list, as if they had been stored."""
    return Separate(transitions=run.moves, terminal=run.terminal, values=run.values, alpha=run.alpha, gamma=run.gamma)


def question(given: Given) -> Question:
    """The run, the values before it; all updated states are asked for, or the letter left open."""
    if isinstance(given, AlongRun) and given.known is not None:
        return Question(run_blocks(given, values_table(given.values), "TD(0)"), sought_parts(given))
    return Question(
        run_blocks(given, values_table(given.values), "TD(0)"),
        (
            *([errors_asked(given)] if given.td_errors else []),
            Part(f"What is {values_asked(given)} {after(given)}{in_open(given)}?", Values("V", given.visited)),
        ),
    )
