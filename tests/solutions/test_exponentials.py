"""What is decided about expressions with exponentials: identities hold, and near misses do not."""

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import E, Rational, cos, exp, log, pi, sqrt

from rldrill.solutions.exponentials import lowest_terms, vanishes

x, y = sympy.symbols("sigma tau")
NEAR = Rational(1, 10**40)


@pytest.mark.parametrize(
    "zero",
    [
        (exp(x) + 1) ** 2 - exp(2 * x) - 2 * exp(x) - 1,
        exp(-9 / x**2) / exp(-9 / (2 * x**2)) - exp(-9 / (2 * x**2)),
        1 / (1 + exp(-2 * x)) - exp(x) / (exp(x) + exp(-x)),
        sympy.Mul(exp(x + 1), exp(1 / x), evaluate=False) - E * exp(x) * exp(1 / x),
        (exp(1 / x) + exp(x)) ** 3 - (exp(2 / x) + 2 * exp(x + 1 / x) + exp(2 * x)) * (exp(1 / x) + exp(x)),
        exp(x / (1 - x)) * E - exp(1 / (1 - x)),  # x/(1 − x) + 1 = 1/(1 − x)
        E / (E + 1) - 1 / (1 + exp(-1)),
        (exp(Rational(1, 2)) + exp(Rational(1, 3))) * exp(Rational(1, 6)) - exp(Rational(2, 3)) - exp(Rational(1, 2)),
        (x**2 - 1) / (x - 1) - x - 1,
    ],
)
def test_identities_hold_and_near_misses_do_not(zero: sympy.Expr) -> None:
    assert vanishes(zero) is True
    assert vanishes(zero + NEAR) is False
    assert vanishes(zero + NEAR * exp(-x)) is False


@pytest.mark.parametrize(
    "unclear",
    [
        log(x**2) - 2 * log(x),
        sqrt(2) * sqrt(3) - sqrt(6) + exp(x) - exp(x) * cos(x),
        exp(pi * x) - exp(3 * x),
        exp(x + y) - exp(y) * exp(x) + exp(y) * x,
        exp(exp(x)) - exp(x),
    ],
)
def test_what_lies_outside_is_left_undecided(unclear: sympy.Expr) -> None:
    assert vanishes(unclear) is None


def test_what_grows_too_large_is_left_undecided() -> None:
    wide = sum((exp(x**n) for n in range(1, 9)), sympy.S.One)
    assert vanishes(wide**12 - wide**11 * (wide + 1)) is None


terms = st.lists(
    st.tuples(st.integers(-3, 3), st.integers(0, 2), st.integers(-3, 3), st.integers(-2, 2)), min_size=1, max_size=4
)


def expression(parts: list[tuple[int, int, int, int]]) -> sympy.Expr:
    return sum((c * x**p * exp(Rational(a, 2) * x + Rational(b, 3)) for c, p, a, b in parts), sympy.S.Zero)


@given(terms, terms, st.integers(-2, 2))
@settings(deadline=None, max_examples=60)
def test_products_multiplied_out_are_the_same(
    first: list[tuple[int, int, int, int]], second: list[tuple[int, int, int, int]], more: int
) -> None:
    a, b = expression(first), expression(second)
    product = sympy.Mul(a, b, evaluate=False)
    out = sympy.expand(a * b)
    assert vanishes(product - out) is True
    assert vanishes(product - out - more * exp(x)) is (more == 0)


@pytest.mark.parametrize(
    ("number", "reduced"),
    [
        (exp(2) / (exp(2) + exp(4)), 1 / (1 + exp(2))),
        (1 - E / (2 + E), 2 / (2 + E)),
        ((1 + E) / exp(3), exp(-3) + exp(-2)),
        ((2 * E + 2) / (4 * exp(2) - 4), 1 / (2 * E - 2)),
        (E - E, 0),
        (sympy.Mul(2, exp(3), exp(-3), evaluate=False), 2),
        (exp(Rational(-1, 8)), exp(Rational(-1, 8))),
    ],
)
def test_lowest_terms(number: sympy.Expr, reduced: sympy.Expr) -> None:
    found = lowest_terms(sympy.sympify(number))
    assert found is not None
    assert sympy.simplify(found - reduced) == 0
    assert sympy.count_ops(found) <= sympy.count_ops(reduced)


@pytest.mark.parametrize("number", [log(2) * E, exp(pi), exp(Rational(123456789, 10**9)) + E, exp(x) + 1])
def test_what_has_no_lowest_terms_here(number: sympy.Expr) -> None:
    assert lowest_terms(number) is None
