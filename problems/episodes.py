"""Outcomes that say of themselves whether the episode ends, as the transitions of a model with its terminal states."""

from collections.abc import Sequence
from itertools import chain, count
from typing import Any, NamedTuple

from rldrill.problems.grids import OVER
from rldrill.problems.readings import is_zero


class Outcome(NamedTuple):
    """What an action may lead to: the next state, its probability and reward, and whether the episode ends there."""

    state: str
    action: str
    after: str
    probability: Any
    reward: Any
    ends: bool


def model(outcomes: Sequence[Outcome]) -> dict[str, Any]:
    """The transitions, and the terminal states in the order in which they are entered.

    A state that is entered where the episode ends is terminal, whatever is said of it; but where the episode also goes
    on from there, or ends there for who stays only, it ends in a state of its own.
    """
    possible = [each for each in outcomes if not is_zero(each.probability)]
    ended = {each.after for each in possible if each.ends and each.after != each.state}
    lived_in: set[str] = set()
    more = {each.state for each in possible} - ended
    while more:
        lived_in |= more
        more = {each.after for each in possible if not each.ends and each.state in lived_in} - lived_in
    called = {name for each in outcomes for name in (each.state, each.after)}
    over = next(name for name in chain([OVER], (f"{OVER}_{number}" for number in count(2))) if name not in called)
    told = [each._replace(after=over) if each.ends and each.after in lived_in else each for each in possible]
    terminal = dict.fromkeys(each.after for each in told if each.ends)
    return {"transitions": [list(each[:-1]) for each in told if each.state not in terminal], "terminal": list(terminal)}
