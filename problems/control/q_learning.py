"""The action values after Q-learning updates along a run of transitions."""

from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import Tag

from rldrill.problems.asking_back import BackMoves, BackRun, draw_back, draw_forward, pairs_asked, updates_of
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

TITLE = "Q-learning"
SOURCE = "Sutton & Barto 2018, section 6.5"
REVISION = 9
DISTRACTORS = (
    "values.*",  # a table has the values of other pairs, too
    "trajectory.actions.*",  # the last action is Sarsa's business
    "transitions.*.4",
)


class AlongRun(BackRun):
    """A run with its actions, the action values before it, the step size and the discount."""

    td_errors: AskErrors = False


class Separate(BackMoves):
    """Transitions that need not join, the action values before them, the step size and the discount."""

    td_errors: AskErrors = False


Given = Annotated[Annotated[AlongRun, Tag("run")] | Annotated[Separate, Tag("transitions")], RUN_OR_MOVES]


#: The order of visits of the runs at each level; a full stop is the end.
_VISITS = {1: ("ab",), 2: ("aba", "abac", "abcb", "aba.")}


def draw(level: int, rng: Draws) -> Given:
    """One transition; then some that come back to a state, or one back from its outcome; then γ after two updates."""
    if level == 3:
        found = draw_back(rng, draw_setting(rng), 3, _ahead, "gamma", steps=2)
        if not _best_differ(found):
            return draw(level, rng)
        return Separate(**found if rng.chance(Fraction(3, 4)) else found | {"outcome": None})
    back = level == 2 and rng.chance(Fraction(1, 4))
    while True:
        if back:
            found = draw_back(rng, draw_setting(rng), 3, _ahead, rng.choice(("alpha", "gamma")))
        else:
            found = draw_forward(rng, rng.choice(_VISITS[level]), 2 if level == 1 else 3, _ahead)
        if _best_differ(found) and (back or level == 1 or _best_changes(found)):
            return AlongRun(**found)


def _best_changes(found: Mapping[str, Any]) -> bool:
    """Whether an update reads a greatest value that has changed: somebody who reads the old one is found out."""
    run = found["trajectory"]
    old = [Fraction(0) if state in run.terminal else max(found["values"][state].values()) for state in run.states[1:]]
    return [update.ahead for update in updates_of(found, _ahead)] != old


def _best_differ(found: Mapping[str, Any]) -> bool:
    """Whether it matters which row is read: no two greatest values are the same."""
    best = [max(row.values()) for row in found["values"].values()]
    return len(set(best)) == len(best)


def _ahead(row: Mapping[str, Fraction], _: str) -> Fraction:
    return max(row.values())


def question(given: Given) -> Question:
    """The run and the table before it; all updated pairs are asked for."""
    blocks = run_blocks(given, action_values_table(given.values), "Q-learning")
    return Question(blocks, pairs_asked(given, errors=given.td_errors))
