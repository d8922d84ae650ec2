"""What is written between the numbers that are put in and the result, worked out by hand."""

import pytest
import sympy
from flint import fmpq
from sympy import Add, Expr, Mul, Pow, Rational, sqrt

from rldrill.render.mathematics.unicode import unicode
from rldrill.solutions.formula.collecting import collected_next
from rldrill.solutions.formula.finding import with_number
from rldrill.solutions.formula.inverting import inverted
from rldrill.solutions.formula.lines import lines_between
from rldrill.solutions.formula.nested import choices_first, inner_brackets_first
from rldrill.solutions.formula.nodes.choices import Greatest
from rldrill.solutions.formula.nodes.leaves import MatrixLeaf, Slot, leaf
from rldrill.solutions.formula.nodes.matrices import Blocks
from rldrill.solutions.formula.nodes.sets import MaxOf
from rldrill.solutions.formula.typesetting import alone
from rldrill.solutions.rational import generator, without_quotients

P = sympy.Symbol("p")
HALF = Rational(1, 2)


def total(*terms: Expr | int) -> Expr:
    return Add._from_args(list(map(sympy.sympify, terms)))


def times(*factors: Expr | int) -> Expr:
    return Mul._from_args(list(map(sympy.sympify, factors)))


def power(base: Expr | int, exponent: Expr | int) -> Expr:
    return Pow(base, exponent, evaluate=False)


def minus(one: int, other: int) -> Expr:
    return total(one, times(-1, other)) if other >= 0 else total(one, times(-1, leaf(other)))


def shown(line: Expr | None) -> str:
    return "" if line is None else unicode(alone(line))


SQUARES = total(power(minus(5, 3), 2), power(minus(1, 3), 2))
MEAN = total(times(HALF, total(-3, times(HALF, 8))), times(HALF, total(1, times(HALF, 10))))


@pytest.mark.parametrize(
    ("step", "line"),
    [
        (times(SQUARES, power(2, -1)), "(2² + (−2)²)/2"),
        (power(SQUARES, HALF), "√(2² + (−2)²)"),
        (power(SQUARES, -1), "1/(2² + (−2)²)"),
        (times(HALF, MEAN), "1/2·(1/2·1 + 1/2·6)"),
        (total(7, times(HALF, MEAN)), "7 + 1/2·(1/2·1 + 1/2·6)"),
        (Greatest(sympy.S.Zero, MaxOf(total(21, 4, -9), total(13, 5, -9))), "max(0, max{16; 9})"),
    ],
)
def test_inner_brackets_come_first(step: Expr, line: str) -> None:
    assert [shown(each) for each in inner_brackets_first(step)] == [line]


@pytest.mark.parametrize(
    "step",
    [
        MEAN,  # its two brackets are worked out in one line: nothing stands around them
        times(HALF, total(1, times(HALF, total(4, 2)))),  # one bracket in another
        power(total(1, power(3, 2)), HALF),
        times(total(1, times(P, total(1, 2))), total(P, times(P, total(4, 2)))),
    ],
)
def test_where_a_bracket_does_not_hold_several_there_is_no_such_line(step: Expr) -> None:
    assert list(inner_brackets_first(step)) == []


@pytest.mark.parametrize(
    ("step", "line"),
    [
        # (1 − p)(21 + 5p) + 5p² = 21 + 5p − 21p − 5p² + 5p²
        (
            total(times(total(1, times(-1, P)), total(21, times(5, P))), times(5, power(P, 2))),
            "21 + 5p − 21p − 5p² + 5p²",
        ),
        # ((2 − 2p)·4 − 21p)/2 = (8 − 8p − 21p)/2
        (
            times(total(times(total(2, times(-2, P)), 4), times(-21, P)), power(2, -1)),
            "(8 − 8p − 21p)/2",
        ),
        # p/(p/2 + 3(1 − p)) = p/(p/2 + 3 − 3p)
        (
            times(P, power(total(times(HALF, P), times(3, total(1, times(-1, P)))), -1)),
            "p/(1/2·p + 3 − 3p)",
        ),
        # ln 18 = ln 2 + 2 ln 3
        (
            total(times(40, sympy.log(2)), times(-6, sympy.log(3)), times(3, sympy.log(18, evaluate=False))),
            "40·ln 2 − 6·ln 3 + 3·ln 2 + 6·ln 3",
        ),
        (total(power(total(1, P), 2), times(-1, P)), "1 + p + p + p² − p"),
        (total(times(3, leaf(-2 * P)), P), "−6p + p"),
    ],
)
def test_terms_stand_side_by_side_before_they_are_collected(step: Expr, line: str) -> None:
    assert shown(collected_next(step)) == line


@pytest.mark.parametrize(
    "step",
    [
        total(2, times(3, 4)),  # numbers alone
        total(2, times(3, P)),  # nothing is alike
        total(P, power(P, -1), P),  # quotients have lines of their own
        total(sqrt(2), P, P),
        times(*(total(1, P) for _ in range(4))),  # sixteen terms
        power(total(1, P), 5),
    ],
)
def test_where_nothing_is_collected_there_is_no_such_line(step: Expr) -> None:
    assert collected_next(step) is None


def test_sines_in_a_matrix_are_numbers_before_they_are_multiplied() -> None:
    sine, cosine = (function(leaf(sympy.pi / 3), evaluate=False) for function in (sympy.sin, sympy.cos))
    step = Blocks(1, times(-1, sine, cosine), times(2, cosine))
    assert shown(next(iter(lines_between(step, own=False)))) == "[−√3/2·1/2  2·1/2]"


def test_a_product_of_larger_matrices_shows_its_sums() -> None:
    left, right = [[1, 2, 0], [0, 1, 0], [0, 0, 1]], [[3, 4, 0], [-4, 3, 0], [0, 0, 5]]
    lines = list(map(shown, lines_between(times(MatrixLeaf(left), MatrixLeaf(right)), own=False)))
    assert "[1·3 + 2·(−4)  1·4 + 2·3  0 ; 1·(−4)  1·3  0 ; 0  0  1·5]" in lines


def test_a_quotient_in_a_quotient_is_multiplied_above_and_below() -> None:
    # 10/(10 + 4/p) = 10p/(10p + 4)
    step = times(10, power(total(10, times(4, power(P, -1))), -1))
    assert "10p/(10p + 4)" in map(shown, lines_between(step, own=False))


def test_one_over_one_is_no_factor() -> None:
    step = times(5, power(total(leaf(1)), -1))
    assert "5·1" not in map(shown, lines_between(step, own=False))


def test_above_the_line_a_product_is_worked_out_where_below_it_a_sum_is() -> None:
    # 1/4·7/8 = 7/32, 1/4·7/8 + 1/2·1/8 = 9/32
    quarter, share = Rational(1, 4), Rational(7, 8)
    evidence = total(times(quarter, share), times(HALF, Rational(1, 8)))
    step = times(quarter, share, power(evidence, -1))
    assert "(7/32)/(9/32)" in map(shown, lines_between(step, own=False))
    assert "−40/8" in map(shown, lines_between(times(-1, total(16, 24), power(times(2, 4), -1)), own=False))


def test_a_number_that_was_found_is_put_in_where_its_letter_stands() -> None:
    q = generator("q")
    assert shown(with_number([[fmpq(1, 4) * q]], "q", fmpq(3, 4))) == "1/4·3/4"
    assert shown(with_number([[fmpq(12) / (12 + q)]], "q", fmpq(4))) == "12/(12 + 4)"


def test_of_quotients_with_one_numerator_the_denominators_are_equal() -> None:
    rho = generator("rho")
    assert without_quotients(fmpq(-26) / (5 + rho), fmpq(-26, 7), "rho") == (5 + rho, 7)
    assert without_quotients(fmpq(2) / (2 + 3 * rho), fmpq(4, 5), "rho") == (10, 8 + 12 * rho)


def test_the_greatest_number_is_chosen_before_the_bracket_around_it_is_worked_out() -> None:
    step = total(12, times(HALF, total(4, times(P, MaxOf(leaf(4), leaf(-6))), times(-1, 12))))
    lines = [shown(line) for line in lines_between(step, own=False)]
    assert lines[0] == "12 + 1/2·(4 + 4p − 12)"


def test_a_maximum_of_sums_is_not_chosen_before_they_are_worked_out() -> None:
    assert shown(choices_first(times(HALF, MaxOf(total(1, 2), leaf(4))))) == "1/2·max{1 + 2; 4}"
    assert shown(choices_first(MaxOf(leaf(4), leaf(2)))) == "max{4; 2}"


def test_a_bracket_that_comes_to_minus_one_above_the_line_turns_the_sign() -> None:
    # −(2·3·(0 − 1))/(1 + 2)² = 6/9
    step = times(-1, 2, 3, total(Slot(sympy.S.Zero), -1), power(power(total(1, 2), 2), -1))
    assert "6/9" in map(shown, lines_between(step, own=False))
    assert "−6/9" not in map(shown, lines_between(step, own=False))


def test_the_determinant_of_an_inverse_may_lose_its_roots() -> None:
    # √2·√8 − 1·1 = 3
    root = sympy.sqrt(2)
    matrix = MatrixLeaf([[root, 1], [1, 2 * root]])
    assert "1/3" in shown(inverted(times(power(matrix, -1), MatrixLeaf([[1], [0]]))))
