"""The key of a worksheet: for every problem the answers, each exact and as a decimal, then the whole working."""

from collections.abc import Sequence
from decimal import Decimal
from fractions import Fraction
from typing import Any

from rldrill.exam.exam import Version
from rldrill.exercise import Exercise
from rldrill.print.heading import heading, setup, title
from rldrill.print.paper import Paper
from rldrill.problems.document import Equation
from rldrill.problems.mathematics import EMPTY, Glyph, Math, Script, Tabular, number, operator, relation, row
from rldrill.problems.parts import Part
from rldrill.render.mathematics.typst import text
from rldrill.render.typst import block, document
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.answers.rule import RULE
from rldrill.solutions.exact import Value, decimal, exact, is_whole

_DIGITS = 4


def key_source(version: Version, paper: Paper) -> str:
    """The key: for every problem the answers, then the whole working."""
    problems = "".join(_solved(index, item) for index, item in enumerate(version.exercises, 1))
    return (
        f"{setup(version, paper, f'{version.title} – key')}{title(version, 'Key')}"
        f"#par[{text(f'Right is {RULE}.')}]\n{problems}"
    )


def _solved(index: int, exercise: Exercise) -> str:
    answers = "".join(_answer(exercise, part) for part in exercise.parts)
    return (
        f"#block(above: 1.8em, sticky: true, {heading(index, exercise)})\n"
        f"#block(width: 100%, fill: luma(240), radius: 2pt, inset: 0.7em, sticky: true)[{answers}]\n"
        f"{document(exercise.working())}"
    )


def _answer(exercise: Exercise, part: Part) -> str:
    label = text(f"({part.label})") if len(exercise.parts) > 1 else ""
    written = answer_lines(part, exercise.solution.answers[part.label])
    body = block(Equation(EMPTY, written, ("",) * len(written)))
    return f"#grid(columns: (auto, 1fr), column-gutter: 0.6em, align: horizon, [{label}], [{body}])\n"


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
