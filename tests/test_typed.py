"""An answer that a program gives as data, as a person would type it."""

from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from flint import fmpq, fmpz

import rldrill
from rldrill.problems.errors import UsageError
from rldrill.solutions.rational import generator
from rldrill.typed import typed


class Loud(float):
    """A number that another program shows in its own way."""

    def __repr__(self) -> str:
        return f"loud({float(self)})"


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (None, ""),
        ("1/2", "1/2"),
        ("1, 2", "1, 2"),
        (3, "3"),
        (np.int64(3), "3"),
        (0.1, "0.1"),
        (np.float64(0.1), "0.1"),
        (Loud(2.5), "2.5"),
        (1e-7, "1e-07"),
        (Decimal("0.10"), "0.10"),
        (Fraction(1, 3), "1/3"),
        (True, "true"),
        (False, "false"),
        (fmpz(-3), "-3"),
        (1 / (2 - generator("gamma")), "1/(2 - gamma)"),
        ({("cool", "fast"): fmpq(1, 2)}, "(cool, fast): 1/2"),
        ([], ""),
        ([1, 2], "[1, 2]"),
        ((1, "1/2"), "[1, 1/2]"),
        ([[1, 2], [3, 4]], "[[1, 2], [3, 4]]"),
        (["1,5", "2"], "[(1,5), 2]"),
        (["1;5"], "[(1;5)]"),
        ([1, None], "[1, ?]"),
        ([None], ""),
        ([None, None], ""),
        ([[1, None], [3, 4]], "[[1, ?], [3, 4]]"),
        ({}, ""),
        ({"cool": 0.5, "warm": None}, "cool: 0.5, warm: "),
        ({"cool": ["fast", "slow"]}, "cool: [fast, slow]"),
        ({"cool": {"fast": 1, "slow": "1,5"}}, "(cool, fast): 1, (cool, slow): (1,5)"),
    ],
)
def test_data_as_it_would_be_typed(value: Any, text: str) -> None:
    assert typed(value, "a") == text


@pytest.mark.parametrize(
    "value", [[[[1]]], {"cool": {"fast": [1]}}, {"cool": [[1]]}, [{"a": 1}]], ids=["list", "pairs", "row", "table"]
)
def test_what_nests_too_deeply_is_refused(value: Any) -> None:
    with pytest.raises(UsageError, match="a nests too deeply; write numbers, a list, a list of rows or a table"):
        typed(value, "a")


@pytest.mark.parametrize("value", [float("nan"), float("inf"), Decimal("-Infinity"), 1j, object(), {1}, [b"1"]])
def test_what_is_no_number_is_refused(value: Any) -> None:
    with pytest.raises(UsageError, match="a is neither a text nor a number; write it in quotes"):
        typed(value, "a")


def test_true_is_yes_where_that_is_asked_and_named_as_it_stands_elsewhere() -> None:
    exercise = rldrill.draw("markov-property", 1, 1)
    (part,) = [part.label for part in exercise.parts if part.kind.name == "yes/no"]
    right = exercise.solve()[part]
    assert exercise.check(right, part).accepted
    assert not exercise.check(not right, part).accepted
    number = rldrill.draw("return", 1, 7).check(True)
    assert number.says.startswith("'true' is not something this answer may contain")
