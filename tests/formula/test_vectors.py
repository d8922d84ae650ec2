"""Vectors, and what takes one of a few values as it is, in formulas: their values and how they are written."""

import pytest
import sympy
from flint import fmpq
from sympy import exp, sqrt

import rldrill
from rldrill.problems.mathematics import mathematics
from rldrill.render.mathematics.unicode import unicode
from rldrill.solutions.exact import in_one_quotient, monomial
from rldrill.solutions.formula.compiling import value_of
from rldrill.solutions.formula.notation import Clipped, Greatest, Least
from rldrill.solutions.formula.putting_in import put_in, reduced
from rldrill.solutions.formula.typesetting import typeset, typeset_value
from rldrill.solutions.rational import generator
from rldrill.solutions.sheet.policy_gradient import SCORE_FUNCTION
from rldrill.solutions.vector import Vector

X = generator("x")
HALF = fmpq(1, 2)


def test_vectors_are_added_and_scaled_whatever_their_entries_are() -> None:
    vector = Vector([fmpq(1), X])
    assert 0 + vector - HALF * vector == Vector([HALF, X / 2])
    assert sympy.sqrt(2) * Vector([fmpq(2)]) == Vector([2 * sqrt(2)])
    with pytest.raises(TypeError):
        vector * vector
    with pytest.raises(TypeError):
        vector + 1
    with pytest.raises(ValueError, match="shorter"):
        vector + Vector([fmpq(1)])


def test_a_step_of_the_score_function() -> None:
    known = {
        "s": "s", "a": "left", "choices": ("left", "right"), "pi": {("left", "s"): HALF, ("right", "s"): HALF},
        "f_vector": {("s", "left"): Vector([fmpq(2), fmpq(0)]), ("s", "right"): Vector([fmpq(-1), fmpq(1)])},
    }  # fmt: skip
    step = put_in(SCORE_FUNCTION.right, known)
    assert unicode(typeset(step)) == "(2, 0) − (1/2·(2, 0) + 1/2·(−1, 1))"
    assert unicode(typeset(reduced(step))) == "(2, 0) − (1/2, 1/2)"
    assert SCORE_FUNCTION.value(known) == Vector([fmpq(3, 2), -HALF])


@pytest.mark.parametrize(
    ("expression", "value", "written"),
    [
        (Greatest(sympy.S.Zero, sympy.Symbol("n") - 3), fmpq(0), "max(0, −3 + n)"),
        (Least(sympy.Symbol("n"), sympy.S.One), fmpq(1), "min(n, 1)"),
        (Clipped(sympy.Symbol("n"), sympy.S.Zero, sympy.S.One), fmpq(1), "clip(n, 0, 1)"),
    ],
)
def test_greatest_least_and_clipped(expression: sympy.Expr, value: fmpq, written: str) -> None:
    assert value_of(expression, {"n": fmpq(2)}) == value
    assert unicode(typeset(expression)) == written


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (1 - sympy.E / (2 + sympy.E), "2/(2 + e)"),
        (exp(2) / (exp(2) + exp(4)), "1/(1 + e²)"),
        (exp(-2) / (exp(-2) + 2 * exp(-1)), "1/(1 + 2·e)"),
        (1 + 2 * exp(-1), "1 + 2·e⁻¹"),
        (exp(-sympy.Rational(1, 8)), "exp(−1/8)"),
        (3 * exp(sympy.Rational(3, 2)) / (2 * exp(1) + 4 * exp(sympy.Rational(1, 2))), "(3·e)/(4 + 2·exp(1/2))"),
        (exp(-25 / (2 * sympy.Symbol("sigma", positive=True) ** 2)), "exp(−25/(2σ²))"),
        (sympy.log(2) - sympy.Rational(7, 5), "−7/5 + ln 2"),
    ],
)
def test_closed_forms_are_written_as_by_hand(value: sympy.Expr, text: str) -> None:
    assert unicode(typeset_value(value)) == text


def test_e_to_the_logarithm_of_what_is_left_open_is_rational() -> None:
    x = sympy.Symbol("x", positive=True)
    assert monomial(3 * x**2) == 3 * X**2
    assert monomial(x + 1) == x + 1
    assert in_one_quotient(x + 1 / x) == x + 1 / x


def test_hats_in_questions() -> None:
    assert unicode(mathematics("V̂(s_t)")) == "V̂(sₜ)"


def test_a_slip_in_the_returns_costs_once() -> None:
    # The person took G_0 for 5; from there on everything is right.
    exercise = rldrill.read({
        "family": "reinforce",
        "given": {
            "trajectory": {"states": ["s", "end"], "actions": ["x"], "rewards": [4], "terminal": ["end"]},
            "features": {"s": {"x": [1], "y": [0]}}, "theta": [0], "alpha": 1, "gamma": 1,
        },
    })  # fmt: skip
    assert exercise.solution.following({"a": (fmpq(5),)})["c"] == (fmpq(5, 2),)
