"""Matrices of exact values: flint's where all entries are rational, else entry by entry."""

import operator
from collections.abc import Iterable, Sequence
from functools import lru_cache, reduce
from typing import Any, Protocol, TypeGuard

from flint import fmpq, fmpq_mat
from msgspec import Struct

from rldrill.problems.matrices import Rows
from rldrill.solutions import surds
from rldrill.solutions.exact import ONE, ZERO, Value, exact, is_zero, simplest, tidy


class AnyMatrix(Protocol):
    """A matrix of exact values: flint's ``fmpq_mat``, or ``ExactMatrix`` where an entry is not rational."""

    def nrows(self) -> int: ...  # noqa: D102
    def ncols(self) -> int: ...  # noqa: D102
    def tolist(self) -> list[list[Value]]: ...  # noqa: D102
    def entries(self) -> list[Value]: ...  # noqa: D102
    def transpose(self) -> "AnyMatrix": ...  # noqa: D102
    def inv(self) -> "AnyMatrix": ...  # noqa: D102
    def __getitem__(self, place: tuple[int, int], /) -> Value: ...
    def __neg__(self) -> "AnyMatrix": ...
    def __add__(self, other: "AnyMatrix", /) -> "AnyMatrix": ...
    def __sub__(self, other: "AnyMatrix", /) -> "AnyMatrix": ...
    def __mul__(self, other: "AnyMatrix | Value | int", /) -> "AnyMatrix": ...


class ExactMatrix(Struct, frozen=True):
    """A matrix of any exact values, with the operations of ``fmpq_mat``; made by ``matrix``."""

    _rows: tuple[tuple[Value, ...], ...]

    def __getitem__(self, place: tuple[int, int]) -> Value:
        return self._rows[place[0]][place[1]]

    def nrows(self) -> int:
        """How many rows it has."""
        return len(self._rows)

    def ncols(self) -> int:
        """How many columns it has."""
        return len(self._rows[0])

    def tolist(self) -> list[list[Value]]:
        """Its rows."""
        return [list(line) for line in self._rows]

    def entries(self) -> list[Value]:
        """All entries, row by row."""
        return [entry for line in self._rows for entry in line]

    def transpose(self) -> AnyMatrix:
        """Rows as columns."""
        return matrix(zip(*self._rows, strict=True))

    def __neg__(self) -> AnyMatrix:
        return matrix([-entry for entry in line] for line in self._rows)

    def __add__(self, other: AnyMatrix) -> AnyMatrix:
        return matrix(
            [a + b for a, b in zip(mine, its, strict=True)]
            for mine, its in zip(self._rows, other.tolist(), strict=True)
        )

    __radd__ = __add__

    def __sub__(self, other: AnyMatrix) -> AnyMatrix:
        return self + -other

    def __rsub__(self, other: AnyMatrix) -> AnyMatrix:
        return -self + other

    def __mul__(self, other: AnyMatrix | Value | int) -> AnyMatrix:
        return product(self, other) if is_matrix(other) else self._scaled(other)

    def __rmul__(self, other: AnyMatrix | Value | int) -> AnyMatrix:
        return product(other, self) if is_matrix(other) else self._scaled(other)

    def _scaled(self, factor: Any) -> AnyMatrix:
        return matrix([factor * entry for entry in line] for line in self._rows)

    def inv(self) -> AnyMatrix:
        """The inverse, by elimination.

        Raises:
            ZeroDivisionError: there is none.
        """
        size = self.nrows()
        rows = [[*line, *(ONE if i == j else ZERO for j in range(size))] for i, line in enumerate(self._rows)]
        for k in range(size):
            pivot = next((i for i in range(k, size) if not is_zero(rows[i][k])), None)
            if pivot is None:
                raise ZeroDivisionError("the matrix is singular")
            rows[k], rows[pivot] = rows[pivot], rows[k]
            factor = tidy(ONE / rows[k][k])
            rows[k] = [times(factor, entry) for entry in rows[k]]
            for i in range(size):
                if i != k:
                    factor = -rows[i][k]
                    rows[i] = [entry + times(factor, above) for entry, above in zip(rows[i], rows[k], strict=True)]
        return matrix(line[size:] for line in rows)


def is_matrix(value: object) -> TypeGuard[AnyMatrix]:
    """Whether a value is a matrix of either kind."""
    return isinstance(value, fmpq_mat | ExactMatrix)


def matrix(rows: Iterable[Iterable[Value | int]]) -> AnyMatrix:
    """Rows of values as a matrix, of flint's kind if it can be."""
    lines: list[list[Any]] = [
        [entry if type(entry) is fmpq else tidy(simplest(entry)) for entry in line] for line in rows
    ]
    entries = [entry for line in lines for entry in line]
    if {*map(type, entries)} == {fmpq}:
        return fmpq_mat(len(lines), len(lines[0]), entries)
    return ExactMatrix(tuple(map(tuple, lines)))


@lru_cache(maxsize=1024)
def given(rows: Rows) -> AnyMatrix:
    """A matrix of a problem's givens; mistakes need those that the solution needs."""
    return matrix([exact(entry) for entry in line] for line in rows)


def column(values: Iterable[Value]) -> AnyMatrix:
    """A column of values."""
    return matrix([value] for value in values)


def product(left: AnyMatrix, right: AnyMatrix) -> AnyMatrix:
    """The product of two matrices, of which one at least is not flint's.

    Raises:
        ValueError: their shapes do not fit.
    """
    columns = list(zip(*right.tolist(), strict=True))
    return matrix([_inner(line, column) for column in columns] for line in left.tolist())


def times(a: Value, b: Value) -> Value:
    """The product of two values, multiplied out."""
    return _inner((a,), (b,))


def _inner(line: Sequence[Value], column: Sequence[Value]) -> Value:
    total: surds.Surd = {}
    for a, b in zip(line, column, strict=True):
        left, right = surds.read(a), surds.read(b)
        if left is None or right is None:
            products = (a * b for a, b in zip(line, column, strict=True) if a != 0 and b != 0)
            return reduce(operator.add, products, ZERO)
        total = surds.add(total, surds.multiply(left, right))
    return surds.write(total)


def identity(size: int) -> AnyMatrix:
    """The identity matrix."""
    return fmpq_mat(size, size, [int(i == j) for i in range(size) for j in range(size)])


def stacked(rows: int, *blocks: AnyMatrix | Value | int) -> AnyMatrix:
    """Blocks side by side and below one another, as one matrix.

    Args:
        rows: how many rows of blocks.
        *blocks: the blocks, row by row: matrices and scalars; a 0 among matrices fills its place.
    """
    width = len(blocks) // rows
    lines = [blocks[start : start + width] for start in range(0, len(blocks), width)]
    widths = [max(_shape(line[j])[1] for line in lines) for j in range(width)]
    result: list[list[Value]] = []
    for line in lines:
        height = max(_shape(block)[0] for block in line)
        parts = [_entries(block, height, across) for block, across in zip(line, widths, strict=True)]
        result += [[entry for part in parts for entry in part[i]] for i in range(height)]
    return matrix(result)


def _shape(block: object) -> tuple[int, int]:
    return (block.nrows(), block.ncols()) if is_matrix(block) else (1, 1)


def _entries(block: Any, height: int, across: int) -> list[list[Value]]:
    if is_matrix(block):
        return block.tolist()
    return [[block if i == j else ZERO for j in range(across)] for i in range(height)]
