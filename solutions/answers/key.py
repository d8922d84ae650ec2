"""An answer as it stands in a key: every number exact, and then as a decimal."""

from collections.abc import Sequence
from decimal import Decimal
from typing import Any

from rldrill.problems.document import Equation
from rldrill.problems.fractions import Fraction
from rldrill.problems.mathematics import EMPTY, Glyph, Math, Script, Tabular, number, operator, relation, row
from rldrill.problems.parts import Part
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.exact import Value, decimal, exact, is_whole

_DIGITS = 4


def answer_block(part: Part, value: Any) -> Equation:
    """The answer of a part as a block of a page, one line for every number."""
    written = answer_lines(part, value)
    return Equation(EMPTY, written, ("",) * len(written))


def answer_lines(part: Part, value: Any) -> tuple[Math, ...]:
    """The answer of a part as equations, each number exact and then as a decimal."""
    kind = answer_kind(part.kind)
    cells = list(kind.cells(value).values())
    lines = kind.lines(value)
    if len(lines) != len(cells):
        return tuple(_equation(left, right, _rounded_grid(right, cells)) for left, right in lines)
    return tuple(_equation(left, right, rounded(cell)) for (left, right), cell in zip(lines, cells, strict=True))


def _equation(left: Math | None, right: Math, decimals: tuple[str, Math] | None) -> Math:
    head = () if left is None else (left, relation("="))
    tail = () if decimals is None else (relation(decimals[0]), decimals[1])
    return row(*head, right, *tail)


def rounded(value: Any) -> tuple[str, Math] | None:
    """A number as a decimal of at most four digits, and whether it equals that or nearly.

    None for a whole number, for an action, and while a parameter is open.
    """
    if isinstance(value, str | tuple | bool) or is_whole(value):
        return None
    written = decimal(value, _DIGITS)
    if written is None:
        return None
    shortened = Decimal(written)
    return ("=" if value == exact(Fraction(shortened)) else "≈"), _decimal(shortened)


def _decimal(value: Decimal) -> Math:
    exponent = value.adjusted()
    if -_DIGITS <= exponent <= 2 * _DIGITS or not value:
        return number(f"{value:f}")
    power = Script(Glyph("10", "number"), above=number(exponent))
    return row(number(f"{value.scaleb(-exponent):f}"), operator("·"), power)


def _rounded_grid(grid: Math, cells: Sequence[Value]) -> tuple[str, Math] | None:
    decimals = [rounded(cell) for cell in cells]
    if not isinstance(grid, Tabular) or not any(decimals):
        return None
    exact = [entry for line in grid.rows for entry in line]
    entries = [entry if pair is None else pair[1] for entry, pair in zip(exact, decimals, strict=True)]
    width = len(grid.rows[0])
    lines = tuple(tuple(entries[start : start + width]) for start in range(0, len(entries), width))
    sign = "=" if all(pair is None or pair[0] == "=" for pair in decimals) else "≈"
    return sign, Tabular(lines, grid.left, grid.right)
