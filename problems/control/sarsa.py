"""The action values after Sarsa updates along a run of transitions."""

from collections.abc import Mapping
from typing import Annotated, Self

from pydantic import Tag, model_validator

from rldrill.problems.asking_back import BackMoves, BackRun, draw_back, draw_forward, pairs_asked
from rldrill.problems.draws import Draws
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.runs import (
    RUN_OR_MOVES,
    AskErrors,
    action_values_table,
    run_blocks,
)
from rldrill.problems.settings import draw_setting

TITLE = "Sarsa"
SOURCE = "Sutton & Barto 2018, section 6.4"
REVISION = 7
DISTRACTORS = (
    "values.*",  # a table has the values of other pairs, too
)


class AlongRun(BackRun):
    """A run with its actions, the last one too unless it ends; the action values before it, α and γ."""

    td_errors: AskErrors = False

    @model_validator(mode="after")
    def _bootstraps(self) -> Self:
        self.demand_last_action("Sarsa")
        return self


class Separate(BackMoves):
    """Transitions that need not join, the action values before them, the step size and the discount."""

    td_errors: AskErrors = False

    @model_validator(mode="after")
    def _bootstraps(self) -> Self:
        self.demand_last_action("Sarsa")
        return self


Given = Annotated[Annotated[AlongRun, Tag("run")] | Annotated[Separate, Tag("transitions")], RUN_OR_MOVES]


#: The order of visits of the runs at each level; a full stop is the end.
_VISITS = {1: ("ab",), 2: ("aba", "abac", "abcb", "aba.")}


def draw(level: int, rng: Draws) -> Given:
    """One transition; then some that come back to a state, or one back from its outcome; then γ after two updates.

    A value taken that has lost its sign is not the greatest of its row.
    """
    given = _drawn(level, rng)
    run = given.trajectory if isinstance(given, AlongRun) else None
    taken = list(zip(run.states[1:], run.actions[1:], strict=False)) if run is not None else []
    hidden = any(-given.values[state][action] == max(given.values[state].values()) for state, action in taken)
    return draw(level, rng) if hidden else given


def _drawn(level: int, rng: Draws) -> Given:
    if level == 3:
        found = draw_back(rng, draw_setting(rng), 3, _ahead, "gamma", steps=2)
        return Separate(**found if rng.chance(Fraction(3, 4)) else found | {"outcome": None})
    if level == 2 and rng.chance(Fraction(1, 3)):
        return AlongRun(**draw_back(rng, draw_setting(rng), 3, _ahead, rng.choice(("alpha", "gamma"))))
    return AlongRun(**draw_forward(rng, rng.choice(_VISITS[level]), 2 if level == 1 else 3, _ahead))


def _ahead(row: Mapping[str, Fraction], following: str) -> Fraction:
    return row[following]


def question(given: Given) -> Question:
    """The run and the table before it; all updated pairs are asked for."""
    blocks = run_blocks(given, action_values_table(given.values), "Sarsa")
    return Question(blocks, pairs_asked(given, errors=given.td_errors))
