"""How long it takes by hand: the seconds of small workings, added up by hand."""

from fractions import Fraction
from types import SimpleNamespace
from typing import Any

import pytest
from flint import fmpq, fmpq_mat
from sympy import Expr, Pow, S, evaluate, exp, sqrt

from rldrill.problems.parts import Number, Part
from rldrill.solutions.effort import minutes, minutes_of, seconds_of, whole, whole_points
from rldrill.solutions.formula.formula import Formula
from rldrill.solutions.formula.notation import (
    ArgMaxOver,
    Clipped,
    Counting,
    Greatest,
    MaxOver,
    States,
    V,
    called,
    gamma,
    i,
    letter,
    quantity,
    s,
)
from rldrill.solutions.matrices import matrix
from rldrill.solutions.rational import generator
from rldrill.solutions.work import Work

x, y, z = letter("x"), letter("y"), letter("z")
A, B, C = (letter(name, matrix=True) for name in "ABC")
Start = quantity("start", called("c"))
After = quantity("after", called("n"))


def formula(right: Expr, left: Expr = x) -> Formula:
    return Formula("own", left, right, "Title", "Source", "Hint.")


def seconds(work: Work) -> Fraction:
    return seconds_of(work.lines)


def of(right: Expr, **known: Any) -> Fraction:
    """What there is to compute and to handle in one step; to write the step is 8 s."""
    work = Work()
    work.step(formula(right), **known)
    return seconds(work) - 8


def solution(*, parts: int) -> Any:
    """A solution in which nothing needs to be written."""
    asked = [Part("?", Number(), label=label) for label in "abcdefg"[:parts]]
    return SimpleNamespace(problem=SimpleNamespace(parts=asked), lines_of=lambda _: ())


def test_the_minutes_of_one_step() -> None:
    work = Work()
    with evaluate(False):
        work.step(formula(x + y * z), x=fmpq(12), y=fmpq(3, 4), z=fmpq(5))
    # 12 + 3/4·5: write the step (8 s), multiply and add (2·3 s), 5 digits (7.5 s).
    assert seconds(work) == 8 + 2 * 3 + 5 * Fraction(3, 2)
    work.say("A sentence takes no time.")
    assert seconds(work) == Fraction(43, 2)


@pytest.mark.parametrize(
    ("right", "operations", "digits"),
    [
        (x + y + z, 2, 4),
        (x * y * z, 2, 4),
        (x + S(100), 1, 5),
        (Greatest(x, y, z), 2, 4),
        (Clipped(x, y, z), 2, 4),
        (Pow(x, 3), 1, 3),
        (Pow(x, -1), 1, 3),
        (exp(x), 1, 2),
        (MaxOver(i * x, i, Counting(S(2), S(4))), 2 + 3, 3 * (1 + 2)),
    ],
)
def test_operations_and_digits(right: Expr, operations: int, digits: int) -> None:
    assert of(right, x=fmpq(25), y=fmpq(-3), z=fmpq(4)) == 3 * operations + digits * Fraction(3, 2)


def test_a_letter_that_is_left_open_is_as_much_as_nine_digits() -> None:
    assert of(x + y, x=generator("p"), y=fmpq(1, 3)) == 3 + (9 + 2) * Fraction(3, 2)


def test_a_larger_matrix_takes_longer() -> None:
    small, wide, long = (of(A, A=fmpq_mat(*shape)) for shape in ((1, 1, [1]), (1, 2, [1, 1]), (1, 2, [1, 11])))
    assert small < wide < long


def test_a_root_in_a_matrix_takes_longer_than_a_number() -> None:
    # √2 for 7: the root is drawn (3 s) from a number with the digits of 2 and of 1/2, and is looked up as two.
    root, seven = (of(A, A=matrix([[entry]])) for entry in (sqrt(2), fmpq(7)))
    assert root - seven == 3 + ((1 + 2) + 2 - (1 + 1)) * Fraction(3, 2)


def test_an_equation_that_is_solved_takes_time_for_every_line() -> None:
    work = Work()
    p = generator("p")
    work.equate("p", p * 3 + 1, fmpq(3))
    # 1 + 3p = 3 is written down (8 s); then 3p = 2 and p = 2/3 are made of it (8 s, 2·3 s and 4.5 s each).
    assert seconds(work) == 8 + 2 * (8 + 6 + Fraction(9, 2))


@pytest.mark.parametrize(
    ("right", "matrices", "operations", "digits"),
    [
        (A * B, 2, 2 * 8, 0),  # every entry of four: two products, each worked out and added or written
        (A * B * C, 3, 2 * 8 + 2 * 8, 0),
        (A + B, 2, 4, 0),
        (2 * A, 1, 4, 1),
        (Pow(A, -1), 1, 8, 1),
    ],
)
def test_matrices_are_worked_out_entry_by_entry(right: Expr, matrices: int, operations: int, digits: int) -> None:
    full = fmpq_mat(2, 2, [2, 3, 4, 5])
    written = matrices * of(A, A=full) + digits * Fraction(3, 2)
    assert of(right, A=full, B=full, C=full) == written + 3 * operations


def test_zeros_in_a_matrix_are_not_multiplied() -> None:
    matrices = (fmpq_mat(2, 2, entries) for entries in ([2, 3, 4, 5], [2, 0, 0, 5]))
    full, diagonal = (of(A * B, A=matrix, B=matrix) for matrix in matrices)
    # The same digits; 2·2 products instead of 8 in the diagonal one, each worked out and written.
    assert full - diagonal == 3 * 2 * (8 - 2)


def test_a_product_with_zero_is_seen_at_once() -> None:
    assert of(x * y * z, x=fmpq(123, 45), y=fmpq(0), z=fmpq(67)) == 3


def test_a_one_that_only_keeps_its_place_costs_nothing() -> None:
    with evaluate(False):
        right = x * y + x**2 * z
    # 1·7 + 1²·2: one sum (3 s) of two digits (1.5 s each).
    assert of(right, x=fmpq(1), y=fmpq(7), z=fmpq(2)) == 3 + 2 * Fraction(3, 2)
    assert of(right, x=fmpq(3), y=fmpq(7), z=fmpq(2)) > 3 + 2 * Fraction(3, 2)


def system(work: Work, discount: Any) -> None:
    """V(cool) = 1 + γ V(hot) and V(hot) = 3 + γ V(cool)."""
    with evaluate(False):
        bellman = formula(Start(s) + gamma * V(After(s)), V(s))
    start, after = {"cool": fmpq(1), "hot": fmpq(3)}, {"cool": "hot", "hot": "cool"}
    work.system(bellman, V, [{"s": "cool"}, {"s": "hot"}], start=start, after=after, gamma=discount)


def test_the_minutes_of_two_equations() -> None:
    work = Work()
    system(work, fmpq(1, 2))
    # 1 + 1/2·V(hot), twice: write it (8 s), add, multiply and look V up (3·3 s), 3 digits (4.5 s).
    # Two unknowns are (2³ + 3·2²)/3 operations, each written (2·3 s), on numbers of three digits (4.5 s).
    both = 2 * (8 + 9 + Fraction(9, 2)) + Fraction(20, 3) * (6 + Fraction(9, 2))
    assert seconds(work) == both == 113
    system(work, fmpq(1, 2))
    assert seconds(work) == 2 * both


def test_an_open_letter_makes_equations_longer() -> None:
    work = Work()
    system(work, generator("gamma"))
    assert seconds(work) == 2 * (8 + 9 + 15) + Fraction(20, 3) * (6 + 9 * Fraction(3, 2))


@pytest.mark.parametrize(
    ("time", "told"), [(Fraction(1, 10), 1), (Fraction(7, 5), 1), (Fraction(8, 5), 2), (Fraction(21), 21)]
)
def test_minutes_are_told_as_whole_ones(time: Fraction, told: int) -> None:
    assert whole(time) == told


def test_no_part_takes_less_than_a_minute() -> None:
    assert minutes_of(solution(parts=1), "a") == 1  # 40 s to read it
    assert minutes(solution(parts=3)) == 3


@pytest.mark.parametrize(
    ("seconds", "points_"), [(60, 1), (119, 1), (120, 2), (209, 2), (210, 3), (299, 3), (300, 4), (1200, 14)]
)
def test_a_point_for_a_minute_and_a_half(seconds: int, points_: int) -> None:
    """At two minutes a second point begins, and then one every minute and a half: a point is 1 to 2 minutes."""
    assert whole_points(Fraction(seconds, 60)) == points_
    assert 1 <= Fraction(seconds, 60) / points_ <= 2


def test_what_an_arg_max_runs_over_is_no_work() -> None:
    # Two values are looked up and written (2 · 1.5 s), and compared (3 s).
    known = {"states": ("a", "b"), "V": {"a": fmpq(3), "b": fmpq(5)}}
    assert of(ArgMaxOver(V(s), s, States), **known) == 6


def test_nobody_works_out_a_product_with_zero() -> None:
    with evaluate(False):
        product = x * y * z
        total = x + y * z
    assert of(product, x=fmpq(3, 4), y=fmpq(2, 3), z=fmpq(0)) == 3
    # 3 + 7·0: one addition (3 s), the digit 3 (1.5 s), and to see that the rest is 0 (3 s).
    assert of(total, x=fmpq(3), y=fmpq(7), z=fmpq(0)) == Fraction(15, 2)


def test_a_letter_is_little_trouble_where_nothing_is_added() -> None:
    with evaluate(False):
        product, total = x * y, x * y + z
    p = generator("p")
    # 1/4·p: a multiplication (3 s), two digits and the power of p (2 · 1.5 s each).
    assert of(product, x=fmpq(1, 4), y=p) == 9
    # 1/4·p + 3: one operation and one digit more, and p as good as nine digits.
    assert of(total, x=fmpq(1, 4), y=p, z=fmpq(3)) == 3 * 2 + Fraction(3, 2) * (2 + 9 + 1)
