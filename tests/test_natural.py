"""What one tries with an exercise in a notebook."""

import copy
import pickle
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import sympy
from flint import fmpq
from msgspec.structs import replace

import rldrill
from rldrill.problems.errors import UserError


@pytest.fixture
def exercise() -> rldrill.Exercise:
    """TD(0): worn is 21/4 after the run."""
    return rldrill.load("td-zero/1/62590")


def test_what_is_handed_out_to_calculate_with_is_not_the_key_itself(exercise: rldrill.Exercise) -> None:
    exercise.solve()["a"]["worn"] = fmpq(0)
    assert exercise.check("21/4").accepted
    assert not exercise.check("0").accepted


@pytest.mark.parametrize(
    "answer",
    [np.array([5.25]), np.float32(5.25), np.float64(5.25), np.array(5.25), fmpq(21, 4), sympy.Rational(21, 4),
     sympy.Float("5.25"), {"worn": fmpq(21, 4)}, {"worn": np.float32(5.25)}, Fraction(21, 4), 5.25],
    ids=repr,
)  # fmt: skip
def test_numbers_of_other_libraries_are_answers(exercise: rldrill.Exercise, answer: Any) -> None:
    assert exercise.check(answer).accepted


def test_roots_and_matrices_of_other_libraries_are_answers() -> None:
    gain = rldrill.draw("lqr-gain", 2, 3)
    (label, answer), *_ = gain.solve().items()
    assert gain.check(answer, label).accepted
    softmax = rldrill.read({"family": "return", "given": {"rewards": [3], "gamma": 1, "time": 0}})
    assert softmax.check(sympy.sqrt(9) + 0 * sympy.E).accepted


def test_a_graded_submission_is_gone_through_part_by_part() -> None:
    graded = rldrill.load("return/1/2166").grade({"a": "2", "b": "1"})
    assert [part.part for part in graded] == ["a", "b"]
    assert len(graded) == 2
    assert "a" in graded
    assert "c" not in graded
    assert graded["a"].accepted


def test_a_topic_is_no_family() -> None:
    with pytest.raises(UserError, match="'bellman' is a topic, not a family; name one of its families, such as"):
        rldrill.draw("bellman")


def test_a_working_that_is_none_is_told(exercise: rldrill.Exercise) -> None:
    with pytest.raises(UserError, match="The working is no text and no list of lines"):
        exercise.follow(3)  # type: ignore[arg-type]


def test_threads_share_an_exercise(exercise: rldrill.Exercise) -> None:
    with ThreadPoolExecutor(8) as pool:
        said = [*pool.map(lambda number: exercise.diagnose(f"{number}/7").sentence, range(40))]
    alone = rldrill.load("td-zero/1/62590")
    assert said == [alone.diagnose(f"{number}/7").sentence for number in range(40)]


def test_a_power_of_nothing_is_no_answer_of_a_mistake() -> None:
    given = {"start": {"A": 0}, "optimum": {"A": 1}, "gamma": 0, "sweeps": 1, "accuracy": 100}
    exercise = rldrill.read({"family": "contraction", "given": given})
    for part in exercise.parts:
        exercise.check("17", part.label)


@pytest.mark.parametrize("identity", ["td-zero/1/7", "policy-value/3/5", "lqr-backward/2/3", "max-margin/2/3"])
def test_exercises_and_what_they_say_go_to_another_process(identity: str) -> None:
    """A pool of graders draws in one process and tells in another."""
    exercise = rldrill.load(identity)
    again = pickle.loads(pickle.dumps(exercise))
    assert (again, hash(again), again != exercise) == (exercise, hash(exercise), False)
    assert again != replace(exercise, worth={part.label: 7 for part in exercise.parts})
    for part in exercise.data(mistakes=2)["parts"]:
        for wrong in part["mistakes"]:
            verdict = again.check(wrong["answer"], part=part["part"])
            assert pickle.loads(pickle.dumps(verdict)) == verdict
    graded = exercise.grade(exercise.answers())
    assert pickle.loads(pickle.dumps(graded)) == graded
    assert len({exercise, again, copy.deepcopy(exercise)}) == 1


def test_a_problem_of_ones_own_goes_to_another_process() -> None:
    exercise = rldrill.read({"family": "return", "given": {"rewards": ["0.3333333333333333", 1], "gamma": "1/2"}})
    assert exercise.notes
    again = pickle.loads(pickle.dumps(exercise))
    assert (again, again.notes, again.answers()) == (exercise, exercise.notes, exercise.answers())


@pytest.mark.parametrize("call", [
    lambda exercise: exercise.diagnose("6.9", earlier=3),
    lambda exercise: exercise.data(mistakes="x"),
    lambda exercise: exercise.data(mistakes=-1),
])  # fmt: skip
def test_what_a_call_cannot_use_is_refused(
    exercise: rldrill.Exercise, call: Callable[[rldrill.Exercise], object]
) -> None:
    with pytest.raises(rldrill.UserError, match="must be"):
        call(exercise)
