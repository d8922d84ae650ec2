"""Exact numbers of every form: they mix, and what is asked of one does not depend on its form."""

import operator
from collections.abc import Callable
from fractions import Fraction
from itertools import permutations
from pathlib import Path

import pytest
import sympy
from flint import ctx, fmpq, fmpq_mat
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import E, Rational, exp, log, pi, sqrt

from rldrill.problems.exact import Logarithm, Parameter
from rldrill.solutions import surds
from rldrill.solutions.answers.kinds import text_of
from rldrill.solutions.answers.rule import equivalent
from rldrill.solutions.answers.text import read_number
from rldrill.solutions.exact import (
    NoSolution,
    Value,
    absolute,
    bits,
    decimal,
    degree,
    digits,
    enclosure,
    equal,
    equals,
    exact,
    is_whole,
    is_zero,
    largest,
    magnitude,
    monomial,
    order,
    ordered,
    parameters,
    sign,
    simplest,
    tidy,
    to_sympy,
    value_at,
)
from rldrill.solutions.matrices import matrix, stacked
from rldrill.solutions.rational import RationalFunction, generator
from rldrill.solutions.value import NotReal
from rldrill.solutions.vector import Vector

GAMMA = sympy.Symbol("gamma", positive=True)
gamma = generator("gamma")
POINT = Rational(2, 7)

#: A number, and what it is by sympy alone.
Pair = tuple[Value, sympy.Expr]
small = st.integers(-5, 5)
fractions = st.builds(Fraction, st.integers(-30, 30), st.integers(1, 12))


def rational(number: Fraction) -> Pair:
    return fmpq(number.numerator, number.denominator), Rational(number.numerator, number.denominator)


def function(a: int, b: int, c: int, d: int) -> Pair:
    """A quotient of linear functions; what is below is odd at 2/7, and so not zero."""
    below = (7 * d, 2 * c + 1)
    return (a + b * gamma) / (below[0] * gamma + below[1]), (a + b * GAMMA) / (below[0] * GAMMA + below[1])


def root(a: int, b: int) -> Pair:
    return (number := a + b * sqrt(2)), number


def power_of_e(a: int, b: int) -> Pair:
    return (number := a + exp(Rational(b, 3))), number


def logarithm(a: int) -> Pair:
    return (number := log(abs(a) + 2) - pi), number


def bump(a: int) -> Pair:
    return (number := exp(-a / GAMMA**2)), number


numbers = st.one_of(
    st.builds(rational, fractions),
    st.builds(root, small, small.filter(bool)),
    st.builds(power_of_e, small, small.filter(bool)),
    st.builds(logarithm, small),
)
pairs = st.one_of(
    numbers, st.builds(function, small, small.filter(bool), small, small), st.builds(bump, small.filter(bool))
)


def at_the_point(expression: sympy.Expr) -> sympy.Expr:
    return sympy.sympify(expression).subs(GAMMA, POINT).evalf(70, maxn=2000)


def close(a: sympy.Expr, b: sympy.Expr) -> bool:
    """Whether two numbers are the same at the point, to sixty digits."""
    first, second = at_the_point(a), at_the_point(b)
    return bool(abs(first - second) <= Rational(1, 10**60) * (1 + abs(second)))


@given(pairs, pairs, st.sampled_from([operator.add, operator.sub, operator.mul]))
@settings(deadline=None, max_examples=150)
def test_numbers_of_any_two_forms_can_be_added_and_multiplied(
    first: Pair, second: Pair, operation: Callable[..., sympy.Expr]
) -> None:
    assert close(to_sympy(operation(first[0], second[0])), operation(first[1], second[1]))


@given(pairs, pairs.filter(lambda pair: abs(at_the_point(pair[1])) > Rational(1, 1000)))
@settings(deadline=None, max_examples=80)
def test_numbers_of_any_two_forms_can_be_divided(first: Pair, second: Pair) -> None:
    assert close(to_sympy(first[0] / second[0]), first[1] / second[1])
    assert close(to_sympy(second[0] ** -2), second[1] ** -2)
    assert close(to_sympy(3 - first[0]), 3 - first[1])
    assert close(to_sympy(3 / second[0]), 3 / second[1])


@given(pairs, pairs)
@settings(deadline=None, max_examples=80)
def test_numbers_of_any_two_forms_are_compared_exactly(first: Pair, second: Pair) -> None:
    here = [value_at(value, fmpq(2, 7)) for value, _ in (first, second)]
    gap = at_the_point(first[1] - second[1])
    assert sign(here[0] - here[1]) == (0 if abs(gap) < Rational(1, 10**60) else sympy.sign(gap))
    assert is_zero(here[0] - here[1]) == (sign(here[0] - here[1]) == 0)


@given(numbers, numbers)
@settings(deadline=None, max_examples=80)
def test_signs_are_those_of_a_ball(first: Pair, second: Pair) -> None:
    value = first[0] * second[0]
    with ctx.workprec(300):
        ball = enclosure(value)
        assert {1: ball > 0, -1: ball < 0, 0: ball.contains(0)}[sign(value)]
        assert is_zero(value) == bool(ball.contains(0))
    assert sign(-value) == -sign(value)
    assert sign(absolute(value)) == abs(sign(value))


@given(pairs)
@settings(deadline=None, max_examples=80)
def test_a_number_is_read_as_it_is_written(pair: Pair) -> None:
    value = simplest(pair[0])
    read = read_number(text_of(value), ["gamma"]).value
    assert equivalent(read, value) or (sign(read - value) == 0 and not parameters(value))


@given(pairs)
@settings(deadline=None, max_examples=40)
def test_letters_are_open_until_a_number_is_put_in(pair: Pair) -> None:
    value = simplest(pair[0])
    assert parameters(value) == {symbol.name for symbol in sympy.simplify(pair[1]).free_symbols}
    assert not parameters(value_at(value, fmpq(2, 7)))
    assert (decimal(value) is None) == bool(parameters(value))


def test_what_is_put_in_for_a_letter_may_be_a_root() -> None:
    assert equivalent(value_at(gamma**2 + 1 / (1 + gamma), sqrt(2)), 1 + sqrt(2))  # 2 + (√2 − 1)
    with pytest.raises(NotReal, match="pole"):
        value_at(1 / (1 - 2 * gamma**2), sqrt(2) / 2)
    with pytest.raises(NotReal, match="pole"):
        value_at(1 / (1 - gamma), fmpq(1))


@pytest.mark.parametrize(
    ("value", "count"),
    [
        (fmpq(7), 1), (fmpq(-120), 3), (fmpq(4, 115), 4), (fmpq(0), 1),
        (gamma / 2, 4),  # two coefficients, with the 1 below the line; 1/2 has two digits
        ((1 - gamma) / (2 + 3 * gamma), 5),  # four coefficients with one digit each
        ((fmpq(1, 2) - gamma) / (1 + gamma), 5),  # written (1 − 2γ)/(2 + 2γ)
        (12 * sqrt(7) + exp(Rational(1, 345)), 4), (log(3), 1), (pi, 0),
    ],
)  # fmt: skip
def test_digits_to_write(value: Value, count: int) -> None:
    assert digits(value) == count


@pytest.mark.parametrize(
    ("value", "count"),
    [
        (fmpq(5, 8), 6),  # 101 and 1000, of which the last 1 is free
        (fmpq(-4), 3), (fmpq(0), 0), (Rational(5, 8), 6),
        (1 + 2 * gamma, 4),  # 1 and 10 above the line, 1 below
        (exp(Rational(-5, 2)), 5),  # e^2.5 has 2.5 · 1.44 bits: 3, and 2 to be sure
        (sympy.Pow(1 + sqrt(3), 5, evaluate=False), 35),  # five times 1 + 1 + (1 + 2 + 2)
        (pi, 1), (exp(pi), 2),
    ],
)  # fmt: skip
def test_bits_to_write(value: Value, count: int) -> None:
    assert bits(value) == count


def test_degrees() -> None:
    assert degree((1 + gamma**3) / (2 + gamma)) == 3
    assert degree(1 / (2 + gamma**4)) == 4
    assert degree(fmpq(7)) == degree(sqrt(2) * GAMMA**2) == 0


@pytest.mark.parametrize(("value", "whole"), [(fmpq(3), True), (fmpq(0), True), (fmpq(-3), True), (fmpq(7, 2), False),
                                              (gamma, False), (sqrt(2), False)])  # fmt: skip
def test_whole_numbers(value: Value, whole: bool) -> None:
    assert is_whole(value) is whole


@pytest.mark.parametrize(
    ("given_", "plain"),
    [(3, fmpq(3)), (Fraction(-3, 6), fmpq(-1, 2)), (Rational(2, 4), fmpq(1, 2)), (sympy.Integer(0), fmpq(0))],
)
def test_the_simplest_form_of_a_rational_is_flints(given_: object, plain: fmpq) -> None:
    assert type(simplest(given_)) is fmpq
    assert simplest(given_) == plain


def test_what_is_no_rational_stays_what_it_is() -> None:
    for value in (True, "left", sqrt(2), gamma, ("a",)):
        assert simplest(value) is value
        assert tidy(value) is value or value == sqrt(2)


def test_givens() -> None:
    assert exact(Parameter("gamma")) == gamma
    assert exact(Parameter("1-gamma")) == 1 - gamma
    assert exact(Logarithm(Fraction(3, 2))) == log(Rational(3, 2))
    assert exact(Fraction(3, 2)) == fmpq(3, 2)


def test_roots_are_multiplied_out_and_not_left_below_the_line() -> None:
    assert tidy(1 / (1 + sqrt(2))) == sqrt(2) - 1
    assert tidy((1 + sqrt(2)) * (1 - sqrt(2))) == -1
    assert type(tidy((1 + sqrt(2)) * (1 - sqrt(2)))) is fmpq
    assert tidy(exp(2) + sqrt(8)) == exp(2) + 2 * sqrt(2)
    assert tidy(pi * (1 + pi)) == pi + pi**2


@pytest.mark.parametrize(
    ("number", "surd"),
    [
        (sqrt(8), {(2, 0): 2}), (1 / sqrt(12), {(3, 0): fmpq(1, 6)}), (Rational(2, 3) ** Rational(3, 2),
        {(6, 0): fmpq(2, 9)}), (2 / pi, {(1, -1): 2}), (E, None), (1 / (1 + pi), None), (sqrt(2) ** 3, {(2, 0): 2}),
        (sympy.Integer(0), {}), (sqrt(1 + sqrt(2)), None), (2 ** Rational(1, 3), None),
        (sympy.Pow(1 + sqrt(2), 17), None), (GAMMA, None), (sympy.sqrt(-2), None),
    ],
)  # fmt: skip
def test_sums_of_square_roots(number: sympy.Expr, surd: surds.Surd | None) -> None:
    assert surds.read(number) == surd


def test_the_highest_power_of_a_sum_of_roots_that_is_multiplied_out() -> None:
    high = surds.read(sympy.Pow(1 + sqrt(2), 16))  # (1 + √2)ⁿ = a + b√2, where (a, b) goes on to (a + 2b, a + b)
    a, b = 1, 0
    for _ in range(16):
        a, b = a + 2 * b, a + b
    assert high == {(1, 0): a, (2, 0): b}


def test_what_is_no_real_number_has_no_sign() -> None:
    for value in (sympy.sqrt(-2), gamma, GAMMA, sympy.zoo):
        with pytest.raises(NotReal):
            sign(value)
    with pytest.raises(NotReal):
        value_at(1 / (1 - 2 * gamma), fmpq(1, 2))
    with pytest.raises(NotReal):
        magnitude(sqrt(2) - sqrt(2))


def test_zero_in_disguise_is_zero() -> None:
    nested = sqrt(5 + 2 * sqrt(6)) - sqrt(2) - sqrt(3)
    assert is_zero(nested)
    assert not is_zero(nested + exp(-300))
    assert sign(nested + exp(-300)) == 1
    assert is_zero(E / (E + 1) - 1 / (1 + exp(-1)))
    assert not is_zero(gamma)
    assert not is_zero(GAMMA)


def test_the_greatest() -> None:
    assert largest([fmpq(1), sqrt(2), fmpq(7, 5)]) == sqrt(2)  # 1.4142… is above 1.4
    assert largest([fmpq(2), fmpq(2)]) == 2
    with pytest.raises(NoSolution, match="which is the greatest depends"):
        largest([fmpq(1), gamma])
    assert largest([gamma, gamma + 1]) == gamma + 1


@given(st.integers(-6, 6), st.integers(1000, 9999))
def test_the_power_of_ten_of_a_rational(power: int, number: int) -> None:
    assert magnitude(fmpq(number, 1000) * fmpq(10) ** power) == power
    assert magnitude(-fmpq(number, 1000) * fmpq(10) ** power) == power


@pytest.mark.parametrize(
    ("value", "power"),
    [(fmpq(1), 0), (fmpq(1, 1000), -3), (100 + exp(-200), 2), (100 - exp(-200), 1), (-100 - exp(-200), 2),
     (sqrt(1000), 1), (sqrt(10), 0), (exp(-200), -87), (log(2), -1)],  # 200/ln 10 = 86.86
)  # fmt: skip
def test_the_power_of_ten_close_to_one(value: Value, power: int) -> None:
    assert magnitude(value) == power


def test_two_letters_make_an_expression_and_none_a_rational() -> None:
    other = generator("lambda")
    mixed = gamma + other
    assert parameters(mixed) == {"gamma", "lambda"}
    assert parameters(gamma * other) == {"gamma", "lambda"}
    assert type(gamma - gamma) is type(gamma / gamma) is fmpq
    assert gamma - gamma == 0
    assert (1 - gamma**2) / (1 - gamma) == 1 + gamma
    with pytest.raises(ZeroDivisionError):
        gamma / (gamma - gamma)
    with pytest.raises(TypeError):
        gamma + "x"


def test_a_power_of_one_letter_is_a_rational_function() -> None:
    assert monomial(3 * GAMMA**-2) == 3 / gamma**2
    assert monomial(Rational(3, 2)) == fmpq(3, 2)
    assert monomial(sqrt(GAMMA)) == sqrt(GAMMA)


def test_vectors_keep_the_form_of_their_entries() -> None:
    halved = Vector([fmpq(1), gamma]) * gamma - Vector([gamma, fmpq(1)])
    assert halved.entries == (fmpq(0), gamma**2 - 1)
    assert isinstance(halved.entries[1], RationalFunction)
    assert 0 + halved == halved
    with pytest.raises(TypeError):
        1 + halved


def test_matrices_of_any_numbers() -> None:
    roots = matrix([[sqrt(2), 1], [0, sqrt(3)]])
    assert roots * roots.inv() == fmpq_mat(2, 2, [1, 0, 0, 1])
    assert roots + roots == 2 * roots
    assert roots - roots == fmpq_mat(2, 2)
    assert fmpq_mat(2, 2, [1, 0, 0, 1]) - roots == -roots + fmpq_mat(2, 2, [1, 0, 0, 1])
    assert (roots.transpose() * roots).entries() == [2, sqrt(2), sqrt(2), 4]
    assert matrix([[gamma, 1]]) * matrix([[1], [gamma]]) == matrix([[2 * gamma]])
    assert matrix([[0, gamma], [1, 0]]).inv() == matrix([[0, 1], [1 / gamma, 0]])
    with pytest.raises(ZeroDivisionError):
        matrix([[sqrt(2), 2], [1, sqrt(2)]]).inv()
    with pytest.raises(ValueError, match="argument"):
        matrix([[gamma, 1]]) * matrix([[gamma, 1]])


def test_blocks_side_by_side() -> None:
    block = matrix([[1, 2], [3, 4]])
    # A 0 fills its place with zeros, any other number stands on the diagonal.
    assert stacked(2, block, 0, 0, fmpq(5)) == fmpq_mat(3, 3, [1, 2, 0, 3, 4, 0, 0, 0, 5])
    assert stacked(1, block, fmpq(7)) == fmpq_mat(2, 3, [1, 2, 7, 3, 4, 0])


def test_closed_forms_are_ordered_without_being_subtracted() -> None:
    # √2 ≈ 1.41, √3 ≈ 1.73, e ≈ 2.72; ln 4 is 2 ln 2.
    assert order(sympy.sqrt(2), sympy.sqrt(3)) == -1
    assert order(sympy.E, fmpq(2)) == 1
    assert order(sympy.log(4), 2 * sympy.log(2)) == 0


def test_sums_begin_with_the_constant_and_end_with_what_is_no_polynomial() -> None:
    x, y, z = sympy.symbols("x y z")
    terms = (sympy.Integer(7), z, 3 * y**2, x * y * z, 1 / x)  # of degrees 0, 1, 2, 3 and none
    for mixed in permutations(terms):
        assert ordered(sympy.Add(*mixed, evaluate=False)).args == terms


def test_a_letter_may_fall_out_of_what_is_ordered() -> None:
    x = to_sympy(generator("x"))
    assert order(x + sympy.sqrt(2), x + 1) == 1
    with pytest.raises(NotReal):
        order(x + sympy.sqrt(2), fmpq(1))


def test_values_of_other_forms_may_be_equal() -> None:
    assert equal(sympy.log(4), 2 * sympy.log(2))
    assert not equal(sympy.sqrt(2), fmpq(1414, 1000))
    assert not equal(fmpq(1, 3), fmpq(1, 2))


def test_a_product_of_sums_of_numbers_comes_last_and_is_not_multiplied_out() -> None:
    long = (1 + sympy.pi) ** 40 * (2 + sympy.E) ** 40  # some 1,600 terms
    assert ordered(long + sympy.pi**2 + 3).args == (3, sympy.pi**2, long)


def test_a_rounded_number_in_a_sentence_equals_nothing() -> None:
    assert (equals(fmpq(-3, 4)), equals(-sqrt(2))) == ("= −3/4", "≈ −1.41421")
    solvers = Path(__file__).parents[2].joinpath("solutions").rglob("*.py")
    assert not [path for path in solvers if "= {told(" in path.read_text(encoding="utf-8")]
