"""A list of wrong answers tells none that the statement rules out; what recognises answers knows them all the same."""

from collections.abc import Sequence

import pytest
from flint import fmpq

import rldrill
from rldrill import Exercise, load
from rldrill.export.asked import listed, wrong_answers
from rldrill.possible import is_possible


def rooms(exercise: Exercise, label: str, values: Sequence[str]) -> list[bool]:
    return [is_possible(exercise.solution, label, {label: fmpq(*map(int, each.split("/")))}) for each in values]


def test_a_probability_that_is_asked_back_lies_where_the_statement_says() -> None:
    exercise = load("expected-return/3/28")  # 0 < p < 1
    assert is_possible(exercise.solution, "a", exercise.solution.answers)
    assert rooms(exercise, "a", ["1/2", "0", "1", "11/5", "-1/3"]) == [True, False, False, False, False]
    ruled_out = [
        answers["a"] for _, answers in exercise.solution.mistakes if not is_possible(exercise.solution, "a", answers)
    ]
    assert fmpq(-3, 2) in ruled_out  # without γ: p·(−5 + 27/4) + (1 − p)·1 = −1/8


def test_a_probability_that_is_called_so_before_it_is_asked_for_lies_between_0_and_1() -> None:
    """“The probability q is unknown. … What is q?”"""
    assert rooms(load("bayes-filter/3/1"), "a", ["2/3", "85/27", "-1/3"]) == [True, False, False]


UPDATE = {"transitions": [["s", "go", "t", 2, "go"]], "values": {"s": {"go": 1}, "t": {"go": 4}}}
CASES = {
    "discount": ("sarsa", UPDATE | {"alpha": "1/2", "gamma": "gamma", "outcome": ["s", "go", "5/2"]}, "gamma"),
    "step size": ("sarsa", UPDATE | {"alpha": "alpha", "gamma": "1/2", "outcome": ["s", "go", "5/2"]}, "alpha"),
    "length": ("forward-kinematics", {"lengths": ["w", 1], "angles": [0, "pi/2"], "x": 3}, "positive"),
}


@pytest.mark.parametrize("case", CASES)
def test_a_letter_has_the_values_that_what_it_stands_for_can_have(case: str) -> None:
    family, given, kind = CASES[case]
    exercise = rldrill.read({"family": family, "given": given})
    expected = {
        "gamma": [False, True, True, True, False],
        "alpha": [False, False, True, True, False],
        "positive": [False, False, True, True, True],
    }
    assert rooms(exercise, "a", ["-1/2", "0", "1/2", "1", "3/2"]) == expected[kind]


def test_a_probability_may_exceed_1_where_somebody_does_not_divide_and_is_never_negative() -> None:
    exercise = load("softmax-policy/1/1")
    sail, drift = exercise.solution.answers["b"]
    assert is_possible(exercise.solution, "b", {"b": {sail: fmpq(6), drift: fmpq(1)}})
    assert not is_possible(exercise.solution, "b", {"b": {sail: fmpq(-1, 4), drift: fmpq(5, 4)}})


def test_what_follows_from_an_answer_that_is_ruled_out_is_so_too() -> None:
    exercise = load("bayes-filter/3/1")
    belief = exercise.solution.answers["b"]
    assert is_possible(exercise.solution, "b", {"a": fmpq(2, 3), "b": belief})
    assert not is_possible(exercise.solution, "b", {"a": fmpq(5, 3), "b": belief})


def test_what_is_not_listed_is_still_recognised() -> None:
    exercise = load("expected-return/3/28")
    part = exercise.parts[0]
    assert exercise.check("-3/2").misconceptions
    assert not any(each.value == fmpq(-3, 2) for each in listed(exercise, part))
    assert any(not each.possible for each in wrong_answers(exercise, part))
