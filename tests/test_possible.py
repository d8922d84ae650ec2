"""A list of wrong answers tells none that the statement rules out; what recognises answers knows them all the same."""

from flint import fmpq

from rldrill import load
from rldrill.export.asked import listed, wrong_answers
from rldrill.print.possible import is_possible


def test_a_probability_that_is_asked_back_lies_where_the_statement_says() -> None:
    exercise = load("expected-return/3/3")  # 0 < p < 1
    part = exercise.parts[0]
    assert is_possible(exercise, part, exercise.solution.answers[part.label])
    assert [is_possible(exercise, part, fmpq(*each)) for each in ((1, 2), (0, 1), (1, 1), (11, 5), (-1, 3))] == [
        True, False, False, False, False,
    ]  # fmt: skip
    ruled_out = [
        answers["a"] for _, answers in exercise.solution.mistakes if not is_possible(exercise, part, answers["a"])
    ]
    assert fmpq(-23, 5) in ruled_out


def test_a_discount_lies_between_0_and_1_and_may_be_either() -> None:
    exercise = load("sarsa/3/3")
    (part,) = [part for part in exercise.parts if "discount" in part.ask]
    assert [is_possible(exercise, part, fmpq(*each)) for each in ((0, 1), (1, 1), (-2, 5), (9, 4))] == [
        True, True, False, False,
    ]  # fmt: skip


def test_a_probability_that_is_called_so_before_it_is_asked_for_lies_between_0_and_1() -> None:
    """“The probability q is unknown. … What is q?”"""
    exercise = load("bayes-filter/3/1")
    part = exercise.parts[0]
    assert [is_possible(exercise, part, fmpq(*each)) for each in ((2, 3), (85, 27), (-1, 3))] == [True, False, False]


def test_a_probability_may_exceed_1_where_somebody_does_not_divide_and_is_never_negative() -> None:
    exercise = load("softmax-policy/1/1")
    part = exercise.parts[1]
    sail, drift = exercise.solution.answers[part.label]
    assert is_possible(exercise, part, {sail: fmpq(6), drift: fmpq(1)})
    assert not is_possible(exercise, part, {sail: fmpq(-1, 4), drift: fmpq(5, 4)})


def test_what_is_not_listed_is_still_recognised() -> None:
    exercise = load("expected-return/3/3")
    part = exercise.parts[0]
    assert exercise.check("-23/5").misconceptions
    assert not any(each.value == fmpq(-23, 5) for each in listed(exercise, part))
    assert any(not is_possible(exercise, part, each.value) for each in wrong_answers(exercise, part))
