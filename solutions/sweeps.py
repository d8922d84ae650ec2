"""Sweeps over all states: what goes wrong in their order."""

from collections.abc import Callable
from typing import Any

from rldrill.solutions.formula.formula import Misconception


def order_slips(
    solve: Callable[[Any, Any], None], waits: Callable[[Any], bool] = lambda given: not given.in_place
) -> tuple[Misconception, Misconception]:
    """Sweeps in place for synchronous ones, and the other way round.

    Args:
        solve: the family's solver, whose givens say whether the sweeps are ``in_place``.
        waits: whether sweeps are synchronous, and the order of the states can matter.
    """

    def exchanged(given: Any, work: Any) -> None:
        solve(given.model_copy(update={"in_place": not given.in_place}), work)

    return (
        Misconception(
            "in-place",
            "A synchronous sweep uses the values of the sweep before; values found in this sweep wait for the next.",
            waits,
            exchanged,
        ),
        Misconception(
            "synchronous",
            "In place, a value found in this sweep is used at once for the states that follow.",
            lambda given: given.in_place,
            exchanged,
        ),
    )
