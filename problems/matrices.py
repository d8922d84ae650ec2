"""Matrices as problems give them: lists of rows, a plain number where they are 1×1."""

import re
from collections.abc import Sequence
from itertools import combinations
from typing import Annotated, Any

from pydantic import AfterValidator, BeforeValidator, WithJsonSchema

from rldrill.problems.exact import Exact, Open, Scalar, shown
from rldrill.problems.fractions import Fraction
from rldrill.problems.mathematics import Math, Tabular, mathematics, number

Rows = tuple[tuple[Scalar, ...], ...]

#: What stands around the entries of a matrix that is written as a text, and what stands between them.
_WRITTEN = re.compile(
    r"\\(?:begin|end)\s*\{[bpv]?(?:small)?matrix\}|\\\\|&|^\s*(?:(?:np|numpy|jnp)\.)?(?:array|matrix)\(|\)\s*$"
)
_PLAIN = {"&": ",", "\\\\": ";"}
_MADE = re.compile(r"\s*(?:(?:np|numpy|jnp)\.)?(?:eye|diag|identity|zeros|ones)\s*\(|\s*I(?:_?\d)?\s*$")
_ROW = re.compile(r"\[([^\[\]]+)\]")
#: What stands around a matrix of numpy, and the signs that may stand between a matrix and a number.
_CALLED, _TIMES = re.compile(r"(?:(?:np|numpy|jnp)\.)?(?:array|matrix)\($"), "*·×⋅"


def _typed_rows(text: str) -> list[list[str]] | None:
    """The rows of a matrix as MATLAB, numpy or LaTeX write it; None for what is one number."""
    bare = _WRITTEN.sub(lambda match: _PLAIN.get(match[0].strip(), ""), text)
    rows = _ROW.findall(bare) if "[[" in bare.replace(" ", "") else re.split("[;\n]", bare.strip().strip("[]"))
    if len(rows) == 1 and "[" not in text and "&" not in text:
        return None
    return [re.split(r"\s*,\s*" if "," in row else r"\s+", row.strip().rstrip(",")) for row in rows if row.strip()]


def _read_rows(text: str) -> Any:
    """The rows of a matrix that is written as a text, or the text of one number.

    Raises:
        ValueError: it names a matrix that would have to be made.
    """
    if _MADE.match(text):
        raise ValueError(f"{text[:40]!r} is not worked out here; write its rows, as [[1, 2], [3, 4]] or '[1 2; 3 4]'")
    begin, end = text.find("["), text.rfind("]")
    if begin < 0 or end < begin or "\\" in text:
        return _typed_rows(text) or text
    before, behind = text[:begin].strip(), text[end + 1 :].strip()
    if called := _CALLED.search(before):
        before, behind = before[: called.start()].strip(), behind.removeprefix(")").lstrip()
    if not (before or behind) or (behind and behind[0] not in f"{_TIMES}/"):
        return _typed_rows(text) or text
    before = before.rstrip(_TIMES).rstrip()
    times = before if before in ("", "-", "−", "+") else f"({before})*"
    over = f"{behind[0]}({behind[1:].strip()})" if behind else ""
    return [[f"{times}({entry}){over}" for entry in row] for row in _typed_rows(text[begin : end + 1]) or ()]


def _rows(value: Any) -> Any:
    if isinstance(value, str):
        value = _read_rows(value)
    if not isinstance(value, list | tuple):
        return ((value,),)
    if not all(isinstance(line, list | tuple) for line in value):
        raise ValueError("a matrix is a list of rows, such as [[1, 2], [3, 4]]; a column is [[1], [2]]")
    return value


def _column(value: Any) -> Any:
    """A column may be a plain list, as vectors are."""
    plain = isinstance(value, list | tuple) and not any(isinstance(entry, list | tuple) for entry in value)
    return [[entry] for entry in value] if plain else value


def _by_time(value: Any) -> Any:
    """One matrix for all times, or a list of matrices, one for every time; 1×1 ones may be plain numbers."""
    if isinstance(value, str):
        value = _read_rows(value)
    if not isinstance(value, list | tuple):
        return (value,)
    rows_of_one = all(isinstance(line, list | tuple) and not any(map(_is_row, line)) for line in value)
    return (value,) if rows_of_one else value


def _is_row(value: Any) -> bool:
    return isinstance(value, list | tuple)


def _even(matrix: Rows, which: str = "") -> Rows:
    """Refuse what is no rectangle of entries."""
    if not matrix or not matrix[0]:
        raise ValueError(f"{which}is empty; a matrix needs at least one row with one entry")
    for index, line in enumerate(matrix, 1):
        if len(line) != len(matrix[0]):
            raise ValueError(f"{which}row {index} has length {len(line)}, row 1 has {len(matrix[0])}; make them equal")
    return matrix


def _all_even(series: tuple[Rows, ...]) -> tuple[Rows, ...]:
    for index, matrix in enumerate(series, 1):
        _even(matrix, f"matrix {index}: " if len(series) > 1 else "")
    return series


_Exact = Annotated[tuple[tuple[Exact, ...], ...], BeforeValidator(_rows)]
_Open = Annotated[tuple[tuple[Open, ...], ...], BeforeValidator(_rows)]
_MATRIX: dict[str, Any] = {
    "title": "a matrix, as a list of rows, or a text such as '[1 2; 3 4]' (a number, if it is 1×1)",
    "type": ["array", "number", "string"],
}
_BY_TIME = _MATRIX | {"title": "a matrix, as a list of rows or a text such as '[1 2; 3 4]', or a list of matrices"}
MatrixField = Annotated[_Exact, AfterValidator(_even), WithJsonSchema(_MATRIX)]
ColumnField = Annotated[_Exact, BeforeValidator(_column), AfterValidator(_even), WithJsonSchema(_MATRIX)]
OpenMatrixField = Annotated[_Open, AfterValidator(_even), WithJsonSchema(_MATRIX)]
#: A matrix without anything left open.
NumberRows = tuple[tuple[Fraction, ...], ...]
#: Matrices by time; a single one holds at all times.
MatricesField = Annotated[
    tuple[_Exact, ...], BeforeValidator(_by_time), AfterValidator(_all_even), WithJsonSchema(_BY_TIME)
]
OpenMatricesField = Annotated[
    tuple[_Open, ...], BeforeValidator(_by_time), AfterValidator(_all_even), WithJsonSchema(_BY_TIME)
]


def check_shape(name: str, matrix: Rows, rows: int, columns: int, where: str = "") -> None:
    """Refuse a matrix that has another shape.

    Raises:
        ValueError: it has; the sentence names it.
    """
    height, width = len(matrix), len(matrix[0]) if matrix else 0
    if (height, width) != (rows, columns):
        raise ValueError(f"{name} is {height}×{width}, but {where}it must be {rows}×{columns}")


def check_symmetric(name: str, matrix: Rows) -> None:
    """Refuse a square matrix that is not its own transpose.

    Raises:
        ValueError: it is not.
    """
    for i, j in combinations(range(len(matrix)), 2):
        if matrix[i][j] != matrix[j][i]:
            places = f"row {i + 1}, column {j + 1}, and row {j + 1}, column {i + 1}"
            raise ValueError(f"{name} must be symmetric; give {places}, the same entry")


def check_weights(name: str, matrix: Rows, *, positive: bool) -> None:
    """Refuse a matrix of a quadratic cost that is not symmetric and positive definite (or semidefinite).

    Raises:
        ValueError: it is not. What depends on an open parameter is not checked.
    """
    check_symmetric(name, matrix)
    rows = [[entry for entry in line if isinstance(entry, Fraction)] for line in matrix]
    if any(len(line) != len(matrix) for line in rows):
        return
    if not _definite(rows, positive=positive):
        raise ValueError(f"{name} must be positive {'' if positive else 'semi'}definite; make its diagonal larger")


def check_sign(name: str, matrix: NumberRows, *, costs: bool) -> None:
    """Refuse the matrix of a cost where that of a value is given, and the other way round.

    Raises:
        ValueError: it has the other sign.
    """
    other = [[-entry if costs else entry for entry in line] for line in matrix]
    if any(map(any, matrix)) and _definite(other, positive=False):
        what, sign = ("a cost", "positive") if costs else ("a value", "negative")
        theirs = "'value'" if costs else "'cost-to-go' or 'xuKP'"
        raise ValueError(
            f"{name} is the matrix of {what} here, which is {sign}; give −{name}, or convention = {theirs}"
        )


def is_positive(matrix: Sequence[Sequence[Fraction]]) -> bool:
    """Whether a symmetric matrix is positive definite."""
    return _definite([list(line) for line in matrix], positive=True)


def _definite(rows: list[list[Fraction]], *, positive: bool) -> bool:
    """Whether all pivots of the elimination are positive, or not negative with nothing beside a zero."""
    rows = [list(line) for line in rows]
    for k, pivot_row in enumerate(rows):
        pivot = pivot_row[k]
        if pivot < 0 or (positive and pivot == 0) or (pivot == 0 and any(pivot_row[k:])):
            return False
        if pivot:
            for line in rows[k + 1 :]:
                factor = line[k] / pivot
                line[k:] = [entry - factor * above for entry, above in zip(line[k:], pivot_row[k:], strict=True)]
    return True


def diagonal(*entries: Scalar) -> Rows:
    """A matrix with these on its diagonal and zeros elsewhere."""
    size = range(len(entries))
    return tuple(tuple(entries[i] if i == j else Fraction(0) for j in size) for i in size)


def tabular(lines: Rows) -> Math:
    """A given matrix as mathematics; a 1×1 matrix is a number."""
    if len(lines) == len(lines[0]) == 1:
        return scalar(lines[0][0])
    return Tabular(tuple(tuple(scalar(entry) for entry in line) for line in lines))


def scalar(entry: Scalar) -> Math:
    """A given number, or a parameter, as mathematics."""
    return number(entry) if isinstance(entry, Fraction) else mathematics(shown(entry))
