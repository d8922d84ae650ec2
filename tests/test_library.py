"""The library: what it offers, what it takes and refuses, and how a submission is graded."""

import subprocess
import sys
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

import rldrill
from rldrill import Exercise, Outcome, UserError
from rldrill.problems.catalogue import family

# R₁ = −2 + 1/2 · 4 + 1/4 · 1 = 1/4, then R₀ = 3 + 1/2 · 1/4 = 25/8.
RETURN = {"family": "return", "given": {"rewards": [3, -2, 4, 1], "gamma": "1/2", "time": 1}}
RACING_CAR = Path(__file__).parents[1] / "examples" / "racing-car.toml"


@pytest.fixture
def exercise() -> Exercise:
    return rldrill.read(RETURN)


def test_dir_shows_exactly_what_there_is() -> None:
    classes = [
        "Exercise",
        "FileError",
        "FileField",
        "Graded",
        "GradedPart",
        "Outcome",
        "UsageError",
        "UserError",
        "Verdict",
    ]
    offered = [*classes, "__version__", "draw", "families", "fields", "load", "read"]
    assert dir(rldrill) == offered
    assert all(hasattr(rldrill, name) for name in offered)
    with pytest.raises(AttributeError, match="no attribute 'solve'"):
        _ = rldrill.solve


def test_nothing_heavy_is_imported_before_it_is_used() -> None:
    heavy = "{'sympy', 'flint', 'numpy', 'rich', 'typst', 'prompt_toolkit'}"
    code = f"import rldrill, sys; rldrill.families(); print({heavy} & set(sys.modules))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "set()\n"


def test_families_are_names() -> None:
    assert "td-zero" in rldrill.families()
    assert all(rldrill.draw(name).problem.family.name == name for name in rldrill.families()[:5])


# --- answers ----------------------------------------------------------------------------------------------


def test_answers_are_fractions_where_they_are_rational(exercise: Exercise) -> None:
    assert exercise.answers() == {"a": Fraction(1, 4), "b": Fraction(25, 8)}


def test_answers_of_every_kind() -> None:
    # V2 = 7/2 and 5/2 as the lecture has them.
    racing_car = {"cool": Fraction(7, 2), "warm": Fraction(5, 2)}
    assert rldrill.load(RACING_CAR).answers() == {"a": racing_car, "b": {"cool": "fast", "warm": "slow"}}
    # L = −[−16 8]/17, see tests/test_verify.py.
    gain = {"A": [[-1, 0], [2, -1]], "B": [[0], [2]], "R": [[1]], "P": [[-3, 0], [0, -4]]}
    found = rldrill.read({"family": "lqr-gain", "given": gain}).answers()
    assert found == {"a": ((Fraction(16, 17), Fraction(-8, 17)),)}
    # exp(−1/2) to both centres, which are 1 away at σ = 1
    rbf = rldrill.read({"family": "rbf", "given": {"position": [1], "centres": [[0], [2]], "sigma": 1}})
    assert rbf.answers()["a"] == ("exp(-1/2)", "exp(-1/2)")


@pytest.mark.parametrize("name", rldrill.families())
def test_answers_are_right_as_they_are(name: str) -> None:
    for level in family(name).levels:
        exercise = rldrill.draw(name, level, 1)
        graded = exercise.grade(exercise.answers())
        assert graded.accepted
        assert graded.points == graded.of == sum(part.points for part in exercise.parts)


# --- checking ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("answer", ["1/4", 0.25, Fraction(1, 4), Decimal("0.25"), "25%"])
def test_a_number_may_be_text_or_a_number(exercise: Exercise, answer: object) -> None:
    assert exercise.check(answer).outcome is Outcome.RIGHT


def test_a_float_stands_for_its_shortest_decimal() -> None:
    # γ = 1/10 and rewards 0, 1: R₀ = 0.1, which as a binary fraction is no tenth.
    tenth = rldrill.read({"family": "return", "given": {"rewards": [0, 1], "gamma": "1/10", "time": 0}})
    assert tenth.check(0.1).read == "0.1"
    assert rldrill.read(RETURN).check(3).read == "3"


def test_lists_and_tables_are_answers() -> None:
    racing_car = rldrill.load(RACING_CAR)
    assert racing_car.check([3.5, 2.5]).accepted
    assert racing_car.check({"cool": Fraction(7, 2), "warm": 2.5}).accepted
    assert racing_car.check({"warm": "slow", "cool": "fast"}, "b").accepted


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda e: e.check(None), "The answer is missing"),
        (lambda e: e.check({1, 2}), "The answer is neither a text nor a number"),
        (lambda e: e.check(float("nan")), "The answer is neither a text nor a number"),
        (lambda e: e.check([[[1]]]), "The answer nests too deeply"),
        (lambda e: e.check("1", "z"), "There is no part 'z'; this problem has a, b."),
        (lambda e: e.check("1", 2), "There is no part '2'"),
        (lambda e: e.hint("z"), "There is no part 'z'"),
        (lambda e: e.working("z"), "There is no part 'z'"),
        (lambda e: e.grade({"z": 1}), "There is no part 'z'; this problem has a, b."),
        (lambda e: e.grade({"a": b"1"}), "The answer to (a) is neither"),
        (lambda e: e.grade("1/4"), "answers must be a dictionary"),
        (lambda _: rldrill.draw(7), "family must be the name of a family such as 'td-zero', not 7."),
        (lambda _: rldrill.draw("td-zer"), "did you mean 'td-zero'"),
        (lambda _: rldrill.draw("td-zero/2/7"), "rldrill.load('td-zero/2/7') gives that problem."),
        (lambda _: rldrill.draw("td-zero", level="2"), "level must be a whole number, not '2'."),
        (lambda _: rldrill.draw("td-zero", level=4), "td-zero has no level 4; it has 1, 2, 3."),
        (lambda _: rldrill.draw("td-zero", seed=-1), "The seed is out of range"),
        (lambda _: rldrill.draw("td-zero", seed=10**5000), "The seed is out of range"),
        (lambda _: rldrill.draw("td-zero", seed=1.5), "seed must be a whole number, not 1.5."),
        (lambda _: rldrill.draw("td-zero", seed=True), "seed must be a whole number, not True."),
        (lambda _: rldrill.load(None), "id_or_path must be"),
        (lambda _: rldrill.load("td-zero"), "'td-zero' is neither a problem ID"),
        (lambda _: rldrill.read(3), "the problem: 'family' is missing; a problem needs 'family' and 'given'"),
    ],
)
def test_what_is_refused_is_refused_in_one_sentence(
    exercise: Exercise, call: Callable[[Exercise], Any], says: str
) -> None:
    with pytest.raises(UserError) as caught:
        call(exercise)
    assert says in str(caught.value)
    assert "\n" not in str(caught.value)
    assert str(caught.value).endswith(".")


# --- grading ----------------------------------------------------------------------------------------------


def test_a_submission_is_graded_part_by_part(exercise: Exercise) -> None:
    graded = exercise.grade({"a": "1/4", "b": "25/8"})
    assert [(part.part, part.typed, part.outcome, part.points, part.of) for part in graded.parts] == [
        ("a", "1/4", Outcome.RIGHT, 1, 1),
        ("b", "25/8", Outcome.RIGHT, 1, 1),
    ]
    assert (graded.points, graded.of, graded.accepted) == (2, 2, True)


def test_a_later_part_may_go_on_from_an_earlier_answer(exercise: Exercise) -> None:
    # With R₁ = 10: R₀ = 3 + 1/2 · 10 = 8.
    graded = exercise.grade({"b": 8, "a": 10})
    assert [part.outcome for part in graded.parts] == [Outcome.WRONG, Outcome.FOLLOW_THROUGH]
    assert (graded.points, graded.accepted) == (1, False)
    assert exercise.grade({"b": 8})["b"].outcome is Outcome.WRONG


@pytest.mark.parametrize("blank", ["", "  ", None, []])
def test_what_is_blank_is_missing(exercise: Exercise, blank: object) -> None:
    for graded in (exercise.grade({"a": blank, "b": "25/8"}), exercise.grade({"b": "25/8"})):
        assert graded["a"].verdict is graded["a"].outcome is None
        assert (graded["a"].points, graded["b"].points) == (0, 1)


def test_every_right_entry_earns_its_share() -> None:
    graded = rldrill.load(RACING_CAR).grade({"a": "3.5, 7"})
    assert graded["a"].points == Fraction(graded["a"].of, 2)
    assert isinstance(graded.points, Fraction)


# --- showing ----------------------------------------------------------------------------------------------


def test_what_an_interpreter_shows_is_one_line(exercise: Exercise) -> None:
    assert repr(rldrill.draw("softmax-policy", 1, 7)).startswith("<Exercise softmax-policy/1/7@")
    assert repr(exercise) == "<Exercise of the family return: (a), (b)>"
    assert repr(exercise.check("1/4")) == "<Verdict right: Right.>"


def test_pages_are_readable_text(exercise: Exercise) -> None:
    assert "r₁ = 3, r₂ = −2, r₃ = 4, r₄ = 1" in str(exercise.question())
    assert str(exercise.working("a")).endswith("= 1/4")
    assert "go back in time." in str(exercise.hint())
    assert all(line == line.rstrip() for line in str(exercise.working()).splitlines())


def test_a_notebook_shows_question_and_parts_with_mathematics_in_latex() -> None:
    shown = rldrill.load(RACING_CAR)._repr_markdown_()
    assert shown.startswith("**Value iteration**\n\n")
    assert "| cool | fast | warm | $\\frac{1}{2}$ | $2$ |" in shown
    assert "(a) What is $V_{2}" in shown
    assert "is greedy for $V_{2}$ in every state?" in shown
    assert shown.count("$") % 2 == 0
    assert shown.count("```") == 2


def test_names_are_not_taken_for_markdown() -> None:
    trajectory = {"states": ["a_1_", "b_2_"], "actions": [], "rewards": [1]}
    given = {"trajectory": trajectory, "values": {"a_1_": 7, "b_2_": 5}, "alpha": "1/10", "gamma": 1}
    shown = rldrill.read({"family": "td-zero", "given": given})._repr_markdown_()
    assert r"| $s$ | a\_1\_ | b\_2\_ |" in shown
