"""What the audit says of questions: givens that do not matter, what guessing earns, minutes a point, variety."""

from collections import Counter
from fractions import Fraction
from typing import Any

import pytest

from rldrill.audit.figures import Figures, largest, structure
from rldrill.audit.givens import idle
from rldrill.audit.guessing import Guesses
from rldrill.problems.catalogue import family
from rldrill.problems.family import Problem
from rldrill.solutions.drawing import draw
from rldrill.solutions.effort import points
from rldrill.solutions.solution import Solution, solve


def solution(name: str, **given: Any) -> Solution:
    known = family(name)
    return solve(Problem(known, known.read(given)))


def td(states: list[str], values: dict[str, int]) -> Solution:
    return solution(
        "td-zero",
        trajectory={"states": states, "rewards": [1] * (len(states) - 1)},
        values=values,
        alpha="1/2",
        gamma="1/2",
    )


def test_every_given_of_one_update_matters() -> None:
    assert idle(td(["a", "b"], {"a": 2, "b": 3})) == ()


def test_a_discount_of_what_is_worth_nothing_does_not() -> None:
    assert idle(td(["a", "b"], {"a": 2, "b": 0})) == ("gamma",)


def mdp(*rows: list[Any], terminal: tuple[str, ...] = ("end",)) -> Solution:
    return solution(
        "policy-value",
        mdp={"transitions": list(rows), "terminal": list(terminal)},
        policy={"a": {"go": 1}},
        gamma="1/2",
    )


def test_a_terminal_state_that_nothing_leads_to_is_found() -> None:
    rows = (["a", "go", "a", "1/2", 3], ["a", "go", "end", "1/2", 3])
    assert idle(mdp(*rows)) == ()
    assert idle(mdp(*rows, terminal=("end", "other"))) == ("mdp.terminal.1",)


def test_a_probability_whose_branches_are_worth_the_same_is_found() -> None:
    same = mdp(["a", "go", "end", "1/2", 3], ["a", "go", "out", "1/2", 3], terminal=("end", "out"))
    assert {"mdp.transitions.0.3", "mdp.transitions.1.3"} <= set(idle(same))
    other = mdp(["a", "go", "end", "1/2", 3], ["a", "go", "out", "1/2", 5], terminal=("end", "out"))
    assert idle(other) == ("gamma",)  # after one step all is over


def test_zeros_and_printed_values_are_guesses() -> None:
    # V(a) ← 2 + ½(1 + ½·2 − 2) = 2: the value that is printed, too.
    guesses = Guesses()
    guesses.add(td(["a", "b"], {"a": 2, "b": 2}))
    assert guesses.share == 1
    assert guesses.best == {"a": "as printed"}
    guesses.add(td(["a", "b"], {"a": 2, "b": 6}))
    assert guesses.share == 0.5


def test_a_guess_earns_the_points_of_the_parts_that_it_is_right_in() -> None:
    # R₁ = 4 − 4 + 1 − 1 + 1/4 − 1/4 = 0 and R₀ = 1 + 0, each by a guess; then R₁ = 3 and R₀ = 13/2, by none.
    long = solution("return", rewards=[1, 4, -8, 4, -8, 4, -8], gamma="1/2", time=1)
    assert points(long)["a"] > points(long)["b"] == 1
    guesses = Guesses()
    guesses.add(long)
    assert guesses.best == {"a": "0", "b": "1"}
    guesses.add(solution("return", rewards=[5, 3], gamma="1/2", time=1))
    right = sum(points(long).values())
    assert guesses.share == right / (right + 2)


def test_figures_of_sound_draws_bring_no_complaint_and_of_poor_ones_do() -> None:
    figures = Figures()
    figures.add(td(["a", "b"], {"a": 2, "b": 3}))
    assert list(figures.complaints(2)) == []
    figures.add(td(["a", "b"], {"a": 2, "b": 0}))
    assert list(figures.complaints(2)) == ["no answer depends on None: gamma"]
    assert figures.data()["different"] == 2


def test_the_largest_number_of_ninety_five_in_a_hundred_draws() -> None:
    figures = Figures(largest=list(range(100, 0, -1)), attempts=[1], rates=[1.0])
    # Of the numbers 1 to 100 the first 95 are below 96, and half are below 50.5.
    data = figures.data()
    assert (data["largest"], data["largest_of_95"]) == (50.5, 96)


def test_how_often_yes_is_right_is_a_share_of_the_questions() -> None:
    drawn = [draw("markov-property", 1, seed) for seed in range(4)]
    figures = Figures()
    for each in drawn:
        figures.add(each)
    consistent = sum(bool(each.answers["b"]) for each in drawn)
    assert 0 < consistent < 4
    assert figures.data()["yes"] == {"b": consistent / 4}


def test_the_largest_number_stands_anywhere_in_an_answer() -> None:
    # V(a) ← 2 + ½(1 + ½·40 − 2) = 23/2.
    assert largest(td(["a", "b"], {"a": 2, "b": 40})) == 23
    assert largest(td(["a", "b"], {"a": 2, "b": 3})) == 9  # 9/4


def test_a_structure_is_free_of_numbers_and_names() -> None:
    first = structure(td(["a", "b", "a"], {"a": 2, "b": 3}))
    assert first == structure(td(["x", "y", "x"], {"x": 7, "y": -3}))
    assert first != structure(td(["a", "b", "b"], {"a": 2, "b": 3}))


@pytest.mark.parametrize(("name", "level"), [("td-zero", 2), ("optimal-value", 3), ("lqr-gain", 1)])
def test_a_point_is_one_to_two_minutes(name: str, level: int) -> None:
    figures = Figures()
    for seed in range(3):
        figures.add(draw(name, level, seed))
    assert 1 <= min(figures.rates) <= max(figures.rates) <= 2


def test_points_follow_minutes() -> None:
    # One update: read (40 s), write (8 s), 4 operations and look-ups …: between one and two minutes, so one point.
    assert points(td(["a", "b"], {"a": 2, "b": 3})) == {"a": 1}
    long = td(["a", "b"] * 4, {"a": 2, "b": 3})
    assert points(long)["a"] > 4
    assert Fraction(points(long)["a"]).denominator == 1


def test_a_balance_is_judged_of_enough_answers() -> None:
    few, many = (sound(Figures(yes={"b": [3 * n, 4 * n]}, options={"c": Counter(A=n, B=19 * n)})) for n in (9, 100))
    assert few == []
    assert many == ["(b) is yes in 75%", "(c) is seldom A: {'A': 100, 'B': 1900}"]


def test_different_problems_are_counted_in_the_first_hundred() -> None:
    figures = Figures()
    for number in range(150):
        figures.add(td(["a", "b"], {"a": 2, "b": 3 + number % 120}))
    assert figures.data()["different"] == 100


def sound(figures: Figures) -> list[str]:
    """What is said of these figures at level 1 where all else is as it should be."""
    figures.rates, figures.attempts = [1.5] * 40, [1] * 40
    return list(figures.complaints(1))


def figures(**changed: Any) -> Figures:
    """Forty problems without a fault; then with what is changed."""
    sound: dict[str, Any] = {
        "largest": [9] * 40, "attempts": [3] * 40, "rates": [1.0, 2.0] * 20,
        "problems": {str(number) for number in range(36)}, "structures": set("abcd"),
        "yes": {"a": [80, 200]}, "options": {"b": Counter(A=50, B=150)},
    }  # fmt: skip
    return Figures(**sound | changed)


def test_the_limits_themselves_are_no_fault() -> None:
    assert list(figures().complaints(2)) == []
    assert list(figures(yes={"a": [120, 200]}).complaints(2)) == []


@pytest.mark.parametrize(
    ("changed", "level", "said"),
    [
        ({"idle": ["x/1/2: gamma"]}, 2, "no answer depends on x/1/2: gamma"),
        ({"rates": [0.75, 1.5]}, 2, "a point takes from 0.75 to 1.50 minutes"),
        ({"rates": [1.5, 2.25]}, 2, "a point takes from 1.50 to 2.25 minutes"),
        ({"attempts": [4] * 40}, 2, "half of the problems take more than 4 attempts"),
        ({"structures": set("abc")}, 2, "there are only 3 structures"),
        ({"structures": set("abc")}, 1, ""),
        ({"problems": {str(number) for number in range(35)}}, 3, "only 35 of 40 problems are different"),
        ({"problems": {str(number) for number in range(35)}}, 1, ""),
        ({"yes": {"a": [79, 200]}}, 2, "(a) is yes in 40%"),
        ({"yes": {"a": [121, 200]}}, 2, "(a) is yes in 60%"),
        ({"yes": {"a": [0, 199]}}, 2, ""),
        ({"options": {"b": Counter(A=49, B=151)}}, 2, "(b) is seldom A: {'A': 49, 'B': 151}"),
        ({"options": {"b": Counter(A=0, B=199)}}, 2, ""),
        ({"attempts": [3] * 39, "structures": set("a"), "yes": {"a": [0, 200]}}, 2, ""),
    ],
)
def test_what_lies_beyond_a_limit_is_said(changed: dict[str, Any], level: int, said: str) -> None:
    assert list(figures(**changed).complaints(level)) == [said][: bool(said)]


def test_guesses_may_earn_a_third_and_not_half() -> None:
    guesses = Guesses()
    guesses.add(td(["a", "b"], {"a": 2, "b": 2}))  # as printed
    guesses.add(td(["a", "b"], {"a": 2, "b": 6}))
    assert list(figures(guesses=guesses).complaints(2)) == ["constant answers earn 50%: {'a': 'as printed'}"]
    guesses.add(td(["a", "b"], {"a": 2, "b": 6}))
    assert list(figures(guesses=guesses).complaints(2)) == []
