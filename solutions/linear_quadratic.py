"""Linear systems of problems as formulas need them."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from rldrill.problems.linear_quadratic import LinearQuadratic, by_time
from rldrill.problems.matrices import Rows
from rldrill.solutions import matrices
from rldrill.solutions.exact import ZERO, Value, exact
from rldrill.solutions.oracle import Array, at


def known(given: LinearQuadratic) -> dict[str, Any]:
    """The matrices of all times by the formulas' letters."""
    last = given.horizon
    ends = {"A": last, "B": last, "Q": last + 1, "R": last + 1}
    converted: dict[Rows, Any] = {}
    result: dict[str, Any] = {}
    for name, end in ends.items():
        series = getattr(given, name)
        result[f"{name}t"] = {
            time: converted.setdefault(by_time(series, time), matrices.given(by_time(series, time)))
            for time in range(end)
        }
    return result


def start(given: LinearQuadratic) -> matrices.AnyMatrix:
    """The first state, a column."""
    return matrices.column(map(exact, given.start))


def number(value: Any) -> Value:
    """A 1×1 matrix as a number; 0, where nothing stands in its place."""
    return value[0, 0] if matrices.is_matrix(value) else ZERO + value


def array(rows: Rows) -> Array:
    """A given matrix in floating point."""
    return np.array([[at(entry) for entry in line] for line in rows], dtype=float)


def arrays(given: LinearQuadratic, time: int) -> Mapping[str, Array]:
    """The matrices of one time in floating point; A and B of the last time are those of the time before."""
    return {
        name: array(by_time(getattr(given, name), min(time, len(getattr(given, name)) - 1)))
        for name in ("A", "B", "Q", "R")
    }
