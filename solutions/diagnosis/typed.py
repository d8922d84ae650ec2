"""What was typed, beside what is right."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from flint import fmpq

from rldrill.problems.parts import Part
from rldrill.solutions.answers.judging import wrong_cells
from rldrill.solutions.answers.kinds import Cell, answer_kind
from rldrill.solutions.answers.text import Reading
from rldrill.solutions.diagnosis.replay import UNDONE
from rldrill.solutions.exact import enclosure, is_rational

#: Where answers with an open parameter are compared at first.
_POINT = fmpq(37, 101)
#: No two answers that a marker takes for the same are further apart, by their size or near 0.
_NEAR, _NEAR_ZERO = 0.012, 0.0011
_NOT_COMPUTED = float("nan")


@dataclass
class Typed:
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

    def cells_of(self, answers: Mapping[str, Any] | None) -> dict[str, Any] | None:
        """The cells of this part among some answers; None where they have no such part, or another one."""
        if answers is None or self.part.label not in answers:
            return None
        try:
            cells = answer_kind(self.part.kind).cells(answers[self.part.label])
        except UNDONE:
            return None
        return cells if cells.keys() == self.key.keys() else None

    def differing(self, cells: Mapping[str, Any]) -> set[str]:
        """The cells that are not those of the key."""
        return {name for name, right in self.key.items() if not equal(cells[name], right)}

    def near(self, values: Mapping[str, Any]) -> bool:
        """Whether an answer is roughly what was typed, so that it is worth a proof."""
        return all(near(approximate(values[name]), size) for name, size in self.sizes.items())


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
        return float(enclosure(value, _POINT).mid())
    except UNDONE:
        return _NOT_COMPUTED


def equal(one: Any, two: Any) -> bool:
    """Whether two values are the same."""
    try:
        return bool(one == two)
    except UNDONE:
        return False
