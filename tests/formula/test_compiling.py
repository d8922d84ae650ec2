"""Only names reach the compiler; what it computes with has a real value, or is refused."""

from typing import Any

import pytest
import sympy
from flint import fmpq

from rldrill.solutions.exact import NoSolution
from rldrill.solutions.formula.compiling import value_of

X = sympy.Symbol("x")


@pytest.mark.parametrize("name", ["x: __import__('os')", "1", "lambda", "a b", ""])
def test_a_letter_that_is_no_name_is_refused(name: str) -> None:
    with pytest.raises(ValueError, match="not the name of a letter"):
        value_of(sympy.Symbol(name) + 1, {name: 1})


@pytest.mark.parametrize(
    ("expression", "x", "told"),
    [
        (1 / X, 0 * sympy.pi, "divide by zero"),
        (1 / X, sympy.sqrt(2) - sympy.sqrt(8) / 2, "divide by zero"),
        (sympy.sqrt(X), -sympy.pi, "no root of a negative number"),
        (X * sympy.nan, fmpq(1), "divides by 0, whatever"),
        (X ** sympy.Rational(1, 3), fmpq(8), "no power of 1/3"),
        (sympy.tan(X), sympy.pi / 2, "tangent of a right angle"),
    ],
)
def test_what_has_no_value_is_refused(expression: sympy.Expr, x: Any, told: str) -> None:
    with pytest.raises(NoSolution, match=told):
        value_of(expression, {"x": x})


def test_the_tangent_behind_a_right_angle_is_one_over_another() -> None:
    # tan(π/2 + 1) = −cot 1 = −1/tan 1
    assert value_of(sympy.tan(X), {"x": sympy.pi / 2 + 1}) == -1 / sympy.tan(1)


def test_a_root_of_a_root_and_e() -> None:
    assert value_of(X ** sympy.Rational(3, 4), {"x": fmpq(16)}) == 8
    assert value_of(sympy.E * X, {"x": fmpq(2)}) == 2 * sympy.E
