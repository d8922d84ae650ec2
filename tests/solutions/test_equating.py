"""An equation in one letter is solved in front of the reader."""

import pytest
import sympy
from flint import fmpq

from rldrill.exercise import draw, read
from rldrill.render.unicode import unicode_text
from rldrill.solutions.diagnosis.replay import Change, Replay
from rldrill.solutions.exact import NoSolution, NotSolved
from rldrill.solutions.rational import generator
from rldrill.solutions.solution import solver
from rldrill.solutions.work import Equality, Note, Work

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
        (gamma * gamma, "no γ between 0 and 1 solves"),  # γ = ±2
        (4 + gamma * (1 - gamma), "more than one γ between 0 and 1"),  # 0 and 1
        (3 + 2 * gamma * gamma, "γ between 0 and 1 that solves the equation is no fraction"),  # √½
        (fmpq(3), "gamma falls out"),
        (sympy.sqrt(sympy.Symbol("gamma", positive=True)), "not linear, and is not solved"),
        (sympy.sqrt(2) / sympy.Symbol("gamma", positive=True) + 4, "no value of gamma"),
    ],
)
def test_what_has_no_answer_or_none_that_is_found_is_refused(left: object, told: str) -> None:
    with pytest.raises(NoSolution, match=told):
        Work().equate("gamma", left, fmpq(4))


def test_of_the_roots_of_a_higher_equation_the_one_in_range_is_taken() -> None:
    # 1 + γ + γ² = 7/4: γ² + γ − 3/4 = (γ − ½)(γ + 3/2).
    work = Work()
    assert work.equate("gamma", 1 + gamma + gamma * gamma, fmpq(7, 4)) == fmpq(1, 2)
    assert written(work) == ["1 + γ + γ² = 7/4", "−3 + 4γ + 4γ² = 0", "(−1 + 2γ)·(3 + 2γ) = 0", "γ = 1/2"]
    assert [line.text for line in work.lines if isinstance(line, Note)] == ["Only one $γ$ between 0 and 1 solves this:"]


def test_a_root_may_count_twice_and_others_be_no_fractions() -> None:
    # γ − γ² = ¼: (2γ − 1)² = 0. γ³ − ½γ² − 2γ + 1 = (γ − ½)(γ² − 2), whose other roots are ±√2.
    assert Work().equate("gamma", gamma - gamma * gamma, fmpq(1, 4)) == fmpq(1, 2)
    assert Work().equate("gamma", gamma**3 - fmpq(1, 2) * gamma**2, 2 * gamma - 1) == fmpq(1, 2)


def test_what_a_letter_is_not_by_its_name_is_known_to_whoever_asks() -> None:
    # w² = ¼: ±½; of a step size 0 is no value: α² = ½α.
    w, alpha = generator("w"), generator("alpha")
    assert Work().equate("w", w * w, fmpq(1, 4), positive=True) == fmpq(1, 2)
    assert Work().equate("alpha", alpha * alpha, fmpq(1, 2) * alpha) == fmpq(1, 2)
    with pytest.raises(NotSolved, match="more than one w solves"):
        Work().equate("w", w * w, fmpq(1, 4))
    assert Work().equate("w", w**3, fmpq(1, 8)) == fmpq(1, 2)


def test_mistakes_and_changes_lead_to_no_equation_of_a_higher_degree() -> None:
    mistaken = draw("return", 3, 1).solution.applicable[0]
    for work in (Work(misconception=mistaken), Replay(Change(), {}, 10)):
        with pytest.raises(NotSolved):
            work.equate("gamma", gamma * gamma, fmpq(1, 4))


@pytest.mark.parametrize(
    ("family", "given", "found"),
    [
        # 1 + γ + γ² = 7/4
        ("return", {"gamma": "gamma", "rewards": [1, 1, 1], "time": 0, "known": "7/4"}, fmpq(1, 2)),
        # 0, then α·1 = α, then α + α(1 − α) = 2α − α² = ¾
        (
            "sarsa",
            {
                "alpha": "alpha", "gamma": 0, "outcome": ["s", "go", "3/4"], "values": {"s": {"go": 0}},
                "transitions": [["s", "go", "s", 1, "go"], ["s", "go", "s", 1, "go"]],
            },
            fmpq(1, 2),
        ),
    ],
)  # fmt: skip
def test_the_independent_solver_finds_the_same_root(family: str, given: dict[str, object], found: fmpq) -> None:
    exercise = read({"family": family, "given": given})
    assert exercise.solution.answers["a"] == found
    (other,) = solver(exercise.problem.family).oracle(exercise.problem.given)
    assert other == pytest.approx(float(found))
