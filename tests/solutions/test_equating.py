"""An equation in one letter is solved in front of the reader."""

import pytest
import sympy
from flint import fmpq

from rldrill.render.unicode import unicode_text
from rldrill.solutions.exact import NoSolution
from rldrill.solutions.rational import generator
from rldrill.solutions.work import Equality, Work

gamma = generator("gamma")


def written(work: Work) -> list[str]:
    return [unicode_text(line.equation()) for line in work.lines if isinstance(line, Equality)]


def test_the_discount_of_a_return() -> None:
    # 4 + 6γ = 7 for γ = ½.
    work = Work()
    assert work.equate("gamma", 4 + 6 * gamma, fmpq(7)) == fmpq(1, 2)
    assert written(work) == ["4 + 6γ = 7", "6γ = 3", "γ = 1/2"]


def test_where_two_lines_cross() -> None:
    # 1 + γ = 3 − γ for γ = 1.
    work = Work()
    assert work.equate("gamma", 1 + gamma, 3 - gamma) == 1
    assert written(work) == ["1 + γ = 3 − γ", "2γ = 2", "γ = 1"]


def test_a_quotient_is_multiplied_out() -> None:
    # 2/(1 − γ) = 8 for γ = ¾.
    work = Work()
    assert work.equate("gamma", fmpq(2) / (1 - gamma), fmpq(8)) == fmpq(3, 4)
    assert written(work)[1:] == ["2 = 8 − 8γ", "8γ = 6", "γ = 3/4"]


def test_quotients_on_both_sides_are_cleared_first() -> None:
    # 4γ/(1 + 3γ) = 6/7: 28γ = 6 + 18γ, so γ = 3/5.
    work = Work()
    assert work.equate("gamma", 4 * gamma / (1 + 3 * gamma), fmpq(6, 7)) == fmpq(3, 5)
    assert written(work)[1:] == ["28γ = 6 + 18γ", "10γ = 6", "γ = 3/5"]


def test_what_is_solved_is_said_once() -> None:
    work = Work()
    assert work.equate("gamma", gamma, fmpq(1, 2)) == fmpq(1, 2)
    assert written(work) == ["γ = 1/2"]


def test_a_root_may_stand_before_the_letter() -> None:
    # √2/2 + √2/2·w = 2: w = 4/√2 − 1 = 2√2 − 1.
    work = Work()
    half = sympy.sqrt(2) / 2
    assert work.equate("w", half + half * generator("w"), fmpq(2)) == 2 * sympy.sqrt(2) - 1
    assert written(work)[-2:] == ["w·√2 = 4 − √2", "w = −1 + 2√2"]


def test_a_letter_below_the_line_beside_a_closed_form() -> None:
    # e/x = 4: x = e/4.
    x = sympy.Symbol("x", positive=True)
    assert Work().equate("x", sympy.E / x, fmpq(4)) == sympy.E / 4


def test_a_closed_form_that_the_letter_cannot_be_is_told_as_a_decimal() -> None:
    # √2 w = 1 − 2√2: w = √2/2 − 2 = −1.2929.
    with pytest.raises(NoSolution, match="w would have to be ≈ −1"):
        Work().equate("w", sympy.sqrt(2) * generator("w"), 1 - 2 * sympy.sqrt(2), positive=True)


@pytest.mark.parametrize(
    ("left", "told"),
    [
        (gamma * gamma, "not linear in gamma"),
        (fmpq(3), "gamma falls out"),
        (sympy.sqrt(sympy.Symbol("gamma", positive=True)), "not linear in gamma"),
        (sympy.sqrt(2) / sympy.Symbol("gamma", positive=True) + 4, "no value of gamma"),
    ],
)
def test_what_is_not_linear_is_refused(left: object, told: str) -> None:
    with pytest.raises(NoSolution, match=told):
        Work().equate("gamma", left, fmpq(4))
