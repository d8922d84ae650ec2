"""What was typed, beside what is right."""

from collections.abc import Mapping
from functools import cached_property
from typing import Any

from flint import fmpq
from msgspec import Struct

from rldrill.problems.parts import Part
from rldrill.solutions.answers.judging import wrong_cells
from rldrill.solutions.answers.kinds import Cell, answer_kind
from rldrill.solutions.answers.text import Reading
from rldrill.solutions.diagnosis.replay import UNDONE
from rldrill.solutions.exact import enclosure, is_rational, is_zero, to_sympy

#: Where answers with an open parameter are compared at first.
_POINT = fmpq(37, 101)
#: No two answers that a marker takes for the same are further apart, by their size or near 0.
_NEAR, _NEAR_ZERO = 0.012, 0.0011
#: From here on a whole number, or a fraction by its denominator, may be a rounded one.
_LONG = 100
_NOT_COMPUTED = float("nan")


class Typed(Struct, dict=True):
    """What was typed for a part, beside what is right."""

    part: Part
    cells: Mapping[str, Cell]
    key: Mapping[str, Any]

    @cached_property
    def wrong(self) -> tuple[str, ...]:
        """The cells that are wrong."""
        return wrong_cells(self.cells, self.key)

    @cached_property
    def sizes(self) -> dict[str, float]:
        """What the typed cells are worth, roughly; words are left out."""
        return {name: approximate(cell.value) for name, cell in self.cells.items() if isinstance(cell, Reading)}


def cells_of(part: Part, key: Mapping[str, Any], answers: Mapping[str, Any] | None) -> dict[str, Any] | None:
    """The cells of a part among some answers; None where they have no such part, or one of other cells than the key."""
    if answers is None or part.label not in answers:
        return None
    try:
        cells = answer_kind(part.kind).cells(answers[part.label])
    except UNDONE:
        return None
    return cells if cells.keys() == key.keys() else None


def may_mean(cell: Cell, value: Any) -> bool:
    """Whether somebody who got a value may have typed this: short fractions and whole numbers are not rounded."""
    if not isinstance(cell, Reading) or cell.decimal:
        return True
    if not is_rational(cell.value):
        return not is_rational(value)
    above, below = abs(cell.value.p), cell.value.q
    return below >= _LONG or (below == 1 and above >= _LONG) or _same(cell.value, value)


def _same(number: fmpq, value: Any) -> bool:
    """Whether a value is a rational number, perhaps written otherwise, ln 16/ln 2."""
    if is_rational(value):
        return bool(number == value)
    try:
        return near(approximate(number), approximate(value)) and is_zero(value - to_sympy(number))
    except UNDONE:
        return False


def reach(size: float) -> tuple[float, float]:
    """Between which numbers all lie that are near one."""
    way = 1.02 * (_NEAR * abs(size) + _NEAR_ZERO)
    return size - way, size + way


def near(one: float, two: float) -> bool:
    """Whether two numbers could be the same, rounded; what could not be computed could."""
    if one != one or two != two:
        return True
    return abs(one - two) <= _NEAR * abs(one) + _NEAR_ZERO


def approximate(value: Any) -> float:
    """What a value is worth, roughly; nan where that is not known."""
    if is_rational(value):
        try:
            return int(value.p) / int(value.q)
        except OverflowError:
            return _NOT_COMPUTED
    try:
        return float(enclosure(value, lambda _: _POINT).mid())
    except UNDONE:
        return _NOT_COMPUTED


def equal(one: Any, two: Any) -> bool:
    """Whether two values are the same."""
    try:
        return bool(one == two)
    except UNDONE:
        return False
