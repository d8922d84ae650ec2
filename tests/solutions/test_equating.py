"""An equation in one letter is solved in front of the reader."""

import pytest
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


@pytest.mark.parametrize(("left", "told"), [(gamma * gamma, "not linear in gamma"), (fmpq(3), "gamma falls out")])
def test_what_is_not_linear_is_refused(left: object, told: str) -> None:
    with pytest.raises(NoSolution, match=told):
        Work().equate("gamma", left, fmpq(4))
