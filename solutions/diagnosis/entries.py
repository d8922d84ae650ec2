"""One side of a line of somebody's working: the numbers that stand there."""

import re
from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import partial
from typing import Any, TypeAlias

from rldrill.solutions.answers.text import Reading, Unreadable, read_matrix, read_number
from rldrill.solutions.matrices import is_matrix
from rldrill.solutions.vector import Vector

#: An angle in degrees.
_DEGREES = re.compile(r"([\d.]+)\s*°")
#: What stands between the numbers of a list.
_LISTED = re.compile(r"[,;]|\A\[")
#: What stands before a bracket, and is no function: a factor without a value, c(3 − 1), or a name.
_FACTOR = re.compile(r"\A[^\W\d_]\s*\(")

#: The numbers of one side of a line: one, or those of a vector or matrix, row by row.
Entries: TypeAlias = tuple[Reading, ...]


class Reader:
    """Reads the sides of lines.

    Args:
        parameters: the letters that may stand in them.
        steps: what the steps are worth: matrices and vectors of their shapes are read.
        long: how many numbers may be given together otherwise.
    """

    def __init__(self, parameters: tuple[str, ...], steps: Iterable[Any], long: Iterable[int]) -> None:
        self._parameters = parameters
        self._shapes = dict.fromkeys(_shape(value) for value in steps if isinstance(value, Vector) or is_matrix(value))
        self._long = set(long) - {0, 1}

    def read(self, piece: str) -> Entries | None:
        """The numbers of a side; None where it is not understood."""
        grids = [partial(self._grid, piece, shape) for shape in self._shapes]
        lists = [partial(self._grid, piece, (1, long)) for long in self._long] if _LISTED.search(piece) else []
        readings: list[Callable[[], Entries]] = [partial(self._number, piece), *grids, *lists]
        for read_ in reversed(readings) if {"[", "("} & set(piece) else readings:  # [−10 −12] is no difference
            with suppress(Unreadable):
                return read_()
        return None

    def _number(self, piece: str) -> Entries:
        if _FACTOR.match(piece):
            raise Unreadable("What the factor is worth is not known.")
        try:
            return (read_number(piece, self._parameters),)
        except Unreadable:
            if not _DEGREES.search(piece):
                raise
            return (read_number(_DEGREES.sub(r"(\1*pi/180)", piece), self._parameters),)

    def _grid(self, piece: str, shape: tuple[int, int]) -> Entries:
        read_ = [entry for line in read_matrix(piece, shape, self._parameters) for entry in line]
        given = tuple(entry for entry in read_ if entry is not None)
        if len(given) < len(read_):
            raise Unreadable("Entries are left out; give them too.")
        return given


def _shape(value: Any) -> tuple[int, int]:
    return (1, len(list(value))) if isinstance(value, Vector) else (value.nrows(), value.ncols())
