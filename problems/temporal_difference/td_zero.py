"""The values of the visited states after TD(0) updates along a run of transitions."""

from typing import Annotated

from pydantic import Tag

from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter
from rldrill.problems.family import Question
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
    errors_asked,
    run_blocks,
    values_asked,
)
from rldrill.problems.settings import draw_setting

TITLE = "TD(0)"
SOURCE = "Sutton & Barto 2018, section 6.1"
REVISION = 1


class AlongRun(ValueRun):
    """A run, the values before it, the step size and the discount."""

    td_errors: AskErrors = False


class Separate(ValueMoves):
    """Transitions that need not join, the values before them, the step size and the discount."""

    td_errors: AskErrors = False


Given = Annotated[Annotated[AlongRun, Tag("run")] | Annotated[Separate, Tag("transitions")], RUN_OR_MOVES]


def draw(level: int, rng: Draws) -> Given:
    """One transition; then three that come back to a state; then two with the step size left open."""
    setting = draw_setting(rng)
    first, second, third = rng.shuffled(setting.states)[:3]
    states = {
        1: (first, second),
        2: (first, second, first, rng.choice((third, setting.terminal))),
        3: (first, second, first, second),
    }[level]
    rewards = tuple(rng.nonzero(-4, 8) for _ in states[1:])
    terminal = tuple(state for state in states if state == setting.terminal)
    named = [state for state in setting.states if state in states]
    return AlongRun(
        trajectory=Trajectory(states=states, rewards=rewards, terminal=terminal),
        values={state: rng.nonzero(-4, 10) for state in named},
        alpha=Parameter("alpha") if level == 3 else rng.fraction("1/2", "1/4", "1/10", "1/5"),
        gamma=rng.fraction("1/2", "4/5", "9/10"),
    )


def question(given: Given) -> Question:
    """The run, the values before it; all visited states are asked for."""
    return Question(
        run_blocks(given, values_table(given.values), "TD(0)"),
        (
            *([errors_asked(given)] if given.td_errors else []),
            Part(f"What is {values_asked(given)} {after(given)}{in_open(given)}?", Values("V", given.visited)),
        ),
    )
