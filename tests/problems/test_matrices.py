"""Matrices in problem files: their shapes, their signs, and what is said where they do not fit."""

import re
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

import rldrill
from rldrill.problems.document import Table
from rldrill.problems.errors import FileError
from rldrill.problems.family import Givens
from rldrill.problems.fractions import Fraction
from rldrill.problems.matrices import MatricesField, MatrixField, check_weights, is_positive


class Matrices(Givens):
    one: MatrixField
    series: MatricesField = ()


def exact(rows: Any) -> tuple[tuple[Fraction, ...], ...]:
    return tuple(tuple(Fraction(int(entry)) for entry in line) for line in rows)


def weights(rows: Any, *, positive: bool) -> bool:
    try:
        check_weights("Q", exact(rows), positive=positive)
    except ValueError:
        return False
    return True


@settings(max_examples=60)
@given(st.lists(st.integers(-3, 3), min_size=9, max_size=9), st.integers(1, 3), st.integers(1, 3))
def test_a_square_of_a_matrix_is_semidefinite_and_definite_where_it_has_an_inverse(
    entries: list[int], size: int, rank: int
) -> None:
    root = np.array(entries).reshape(3, 3)[:size, :rank]
    square = root @ root.T
    full = round(float(np.linalg.det(square))) != 0
    assert weights(square, positive=False)
    assert weights(square, positive=True) == is_positive(exact(square)) == full
    lowered = square - np.eye(size, dtype=int) * (int(np.trace(square)) + 1)
    assert not weights(lowered, positive=False)


@pytest.mark.parametrize(
    ("rows", "semidefinite", "definite"),
    [
        ([[0]], True, False),
        ([[1]], True, True),
        ([[-1]], False, False),
        ([[0, 0], [0, 1]], True, False),
        ([[0, 1], [1, 0]], False, False),
        ([[1, 2], [2, 4]], True, False),
        ([[1, 2], [2, 3]], False, False),
        ([[1, 2], [2, 5]], True, True),
        ([[1, 0], [1, 1]], False, False),
        ([[1, 0, 0], [0, 0, 0], [0, 0, -1]], False, False),
        ([[2, -1, 0], [-1, 2, -1], [0, -1, 2]], True, True),
    ],
)
def test_the_signs_of_symmetric_matrices(rows: Any, semidefinite: bool, definite: bool) -> None:
    assert weights(rows, positive=False) == semidefinite
    assert weights(rows, positive=True) == definite


KALMAN = {"mean": 0, "covariance": 1, "process": 1, "sensor": 2, "steps": [{"u": 2}, {"z": 6}]}
LQR = {"A": [[1, 1], [0, 1]], "B": [[0], [1]], "Q": [[1, 0], [0, 1]], "R": 1}


@pytest.mark.parametrize(
    ("family", "changed", "said"),
    [
        ("kalman-filter", {"A": [[1, 2]]}, "A is 1×2, but with a mean of 1 and 1 reading it must be 1×1"),
        ("kalman-filter", {"mean": [[0, 1]]}, "mean is 1×2, but with a mean of 1 and 1 reading it must be 1×1"),
        ("kalman-filter", {"B": [[1], [1]]}, "B is 2×1, but with a mean of 1 and 1 reading it must be 1×1"),
        ("kalman-filter", {"C": [[1], [2]]}, "sensor is 1×1, but with a mean of 1 and 2 readings it must be 2×2"),
        ("kalman-filter", {"steps": [{"u": [[2], [1]]}]}, "u is 2×1, but with 1 inputs it must be 1×1"),
        ("kalman-filter", {"steps": [{"z": [[2], [1]]}]}, "z is 2×1, but with 1 reading it must be 1×1"),
        ("kalman-filter", {"sensor": 0}, "sensor must be positive definite"),
        ("kalman-filter", {"covariance": -1}, "covariance must be positive semidefinite"),
        ("kalman-filter", {"process": -1}, "process must be positive semidefinite"),
        ("lqr-infinite", {"B": [[1], [1, 2]]}, "B: row 2 has length 2, row 1 has 1; make them equal"),
        ("lqr-infinite", {"B": [[1, 2], [1]]}, "B: row 2 has length 1, row 1 has 2; make them equal"),
        ("lqr-infinite", {"B": [[1]]}, "B is 1×1, but with A 2×2 and 1 actions it must be 2×1"),
        ("lqr-infinite", {"R": [[1, 0], [0, 1]]}, "R is 2×2, but with A 2×2 and 1 actions it must be 1×1"),
        ("lqr-infinite", {"A": []}, "A: is empty; a matrix needs at least one row with one entry"),
        ("lqr-infinite", {"A": [[]]}, "A: is empty; a matrix needs at least one row with one entry"),
        ("lqr-infinite", {"A": [1, 2]}, "A: a matrix is a list of rows, such as [[1, 2], [3, 4]]"),
        ("lqr-infinite", {"Q": [[1, 2], [0, 1]]}, "Q must be symmetric"),
        ("lqr-infinite", {"Q": [[1, 2], [2, 1]]}, "Q must be positive semidefinite"),
        ("lqr-infinite", {"A": [[0] * 7] * 7}, "A has 7 rows; 6 are the most"),
    ],
)
def test_a_matrix_that_does_not_fit_is_named(family: str, changed: dict[str, Any], said: str) -> None:
    whole = KALMAN if family == "kalman-filter" else LQR
    rldrill.read({"family": family, "given": whole})
    with pytest.raises(FileError) as refused:
        rldrill.read({"family": family, "given": whole | changed})
    assert said in str(refused.value)


def test_a_step_without_a_command_has_zeros_where_another_step_has_one() -> None:
    exercise = rldrill.read({"family": "kalman-filter", "given": KALMAN})
    (table,) = (block for block in exercise.question() if isinstance(block, Table))
    assert table.rows == (("$u_t$", "$2$", "$0$"), ("$z_t$", "–", "$6$"))
    # 0 + 2 and 1 + 1; 2 + 0 and 2 + 1; with the gain 3/(3 + 2), 2 + 3/5·(6 − 2) and (1 − 3/5)·3.
    assert [tuple(map(str, answer)) for answer in exercise.solve().values()] == [
        ("2", "2"), ("2", "3"), ("22/5", "6/5"),
    ]  # fmt: skip
    without = rldrill.read({"family": "kalman-filter", "given": KALMAN | {"steps": [{"z": 6}]}})
    (table,) = (block for block in without.question() if isinstance(block, Table))
    assert table.rows == (("$z_t$", "$6$"),)


@pytest.mark.parametrize(
    "typed",
    [
        "[1 1/2; 0 -1]", "[1, 1/2; 0, -1]", "[[1, 0.5], [0, -1]]", "[[ 1.   0.5]\n [ 0.  -1. ]]", "1 1/2\n0 -1",
        "np.array([[1, 0.5], [0, -1]])", "numpy.matrix([[1, 0.5],\n        [0, -1]])", "[1 1/2\n0 -1]",
        r"\begin{bmatrix} 1 & \frac{1}{2} \\\\ 0 & -1 \end{bmatrix}", "\\begin{pmatrix}1&1/2\\\\0&-1\\end{pmatrix}",
    ],
)  # fmt: skip
def test_matrices_may_be_written_as_elsewhere(typed: str) -> None:
    rows = ((Fraction(1), Fraction(1, 2)), (Fraction(0), Fraction(-1)))
    assert Matrices.model_validate({"one": typed, "series": typed}) == Matrices(one=rows, series=(rows,))


@pytest.mark.parametrize(
    ("typed", "rows"),
    [
        ("3", [[3]]),
        ("[3]", [[3]]),
        ("[1 2]", [[1, 2]]),
        ("[1; 2]", [[1], [2]]),
        ("2*np.array([[1, 3], [0, 2]])", [[2, 6], [0, 4]]),
        ("-[1 -2; 3 4]", [[-1, 2], [-3, -4]]),
        ("(1 + 2)·[1 2]", [[3, 6]]),
        ("[4 6] / 2", [[2, 3]]),
        (r"\begin{matrix}1\\2\end{matrix}", [[1], [2]]),
    ],
)
def test_rows_columns_and_numbers_as_texts(typed: str, rows: list[list[int]]) -> None:
    assert Matrices.model_validate({"one": typed}).one == exact(rows)


@pytest.mark.parametrize(
    ("typed", "says"),
    [
        ("[1 2; 3]", "row 2 has length 1, row 1 has 2"),
        ("[1 0,5; 0 1]", "'1 0' is not a number"),
        ("eye(2)", "'eye(2)' is not worked out here"),
    ],
)
def test_texts_that_are_no_matrix(typed: str, says: str) -> None:
    with pytest.raises(ValidationError, match=re.escape(says)):
        Matrices.model_validate({"one": typed})
