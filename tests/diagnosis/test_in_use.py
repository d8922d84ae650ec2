"""The diagnosis where it is used: in the quiz, in generated problems; and with errors drawn from the error model."""

import importlib.util
import json
from io import StringIO
from pathlib import Path

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st
from rich.console import Console
from typer.testing import CliRunner

import rldrill
from rldrill.cli import app
from rldrill.diagnosis import _is_shorter
from rldrill.quiz.screen import Screen
from rldrill.quiz.session import Session
from rldrill.solutions.answers.text import read_number
from rldrill.solutions.drawing import draw

_SPEC = importlib.util.spec_from_file_location("error_model", Path(__file__).parent / "error_model.py")
error_model = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(error_model)

# t = 0: cave ← 8 + 1/4·(7 + 1/2·10 − 8) = 9;  t = 1: floor ← 10 + 1/4·(−3 + 1/2·9 − 10) = 63/8
RUN = {
    "family": "td-zero",
    "given": {
        "trajectory": {"states": ["cave", "floor", "cave"], "rewards": [7, -3]},
        "values": {"cave": 8, "floor": 10},
        "alpha": "1/4",
        "gamma": "1/2",
    },
}


def quiz(*typed: str) -> str:
    console = Console(file=StringIO(), width=100)
    lines = iter(typed)
    Screen(console, lambda *_: next(lines)).run([rldrill.read(RUN)], Session(1))
    return " ".join(console.file.getvalue().split())


def test_the_quiz_follows_a_working_of_ones_own() -> None:
    # without γ the second update gives 10 + 1/4·(−3 + 9 − 10) = 9
    shown = quiz("m", "V(cave) = 8 + 1/4*4 = 9", "V(floor) = 10 + 1/4*(-3 + 9 - 10) = 9", "", "q")
    assert "✓ V(cave) = 8 + 1/4*4 = 9" in shown
    assert "✗ V(floor) = 10 + 1/4*(-3 + 9 - 10) = 9" in shown
    assert "γ is missing in the second update (t = 1)" in shown


def test_an_empty_working_is_no_answer() -> None:
    assert "Nothing was answered" in quiz("m", "", "q")


def test_generated_problems_have_wrong_answers_with_their_causes() -> None:
    exercise = rldrill.read(RUN)
    (part,) = exercise.data(mistakes=5)["parts"]
    assert len(part["mistakes"]) == 5
    for mistake in part["mistakes"]:
        assert not exercise.check(mistake["answer"]).accepted
        assert mistake["sentence"].endswith(".")
    assert "mistakes" not in exercise.data()["parts"][0]


@pytest.mark.parametrize("feedback", ["reason", "key"])
def test_a_report_shows_the_step_as_it_should_be_where_keys_are_told(tmp_path: Path, feedback: str) -> None:
    (tmp_path / "mine.json").write_text(json.dumps(RUN))
    (tmp_path / "answers.csv").write_text('student,problem,part,answer\nAnn,mine.json,a,"cave: 9, floor: 9"\n')
    done = CliRunner().invoke(
        app, ["verify", str(tmp_path / "answers.csv"), "--allow-files", "--feedback", feedback, "--json"]
    )
    (answer,) = json.loads(done.stdout)["students"][0]["answers"]
    diagnosis = answer["diagnosis"]
    told = [diagnosis, *diagnosis["alternatives"]]
    assert any(each["right"] is not None for each in told) == (feedback == "key")
    if feedback == "key":
        # floor ← 10 + 1/4·(−3 + 1/2·9 − 10) = 63/8 is right; without γ it is 9
        lines = {(each["yours"]["line"].split(" = ")[-1], each["right"]["line"].split(" = ")[-1]) for each in told}
        assert ("9", "63/8") in lines


FAMILIES = st.sampled_from(["td-zero", "value-iteration", "bayes-rule", "lqr-gain", "return", "sarsa", "policy-value"])


@settings(max_examples=12, deadline=None, derandomize=True)
@given(FAMILIES, st.integers(1, 3), st.integers(0, 50))
def test_whatever_is_typed_is_answered_with_a_sentence(name: str, level: int, seed: int) -> None:
    exercise = rldrill.Exercise(draw(name, level, seed))
    for error in error_model.erroneous(exercise.solution, seed)[::7]:
        diagnosis = exercise.diagnose(error.text, error.part)
        assert diagnosis.sentence.endswith(".")
        assert diagnosis.kind != "right"
        assert 0 <= diagnosis.confidence <= 1
        assert len(diagnosis.alternatives) <= 1


@settings(max_examples=8, deadline=None, derandomize=True)
@given(FAMILIES, st.integers(1, 3), st.integers(0, 50))
def test_right_answers_are_never_accused(name: str, level: int, seed: int) -> None:
    exercise = rldrill.Exercise(draw(name, level, seed))
    for label, answer in exercise.answers().items():
        assert exercise.diagnose(answer, label).kind == "right"


@pytest.mark.parametrize(
    ("typed", "key", "shorter"),
    [
        ("0.67", fmpq(2, 3), True), ("0.66", fmpq(2, 3), True), ("0.7", fmpq(2, 3), True), ("0.6", fmpq(2, 3), True),
        ("1", fmpq(2, 3), False), ("0.65", fmpq(2, 3), False), ("0.68", fmpq(2, 3), False), ("-1", fmpq(2, 3), False),
        ("3/4", fmpq(2, 3), False), ("3/4", fmpq(7512, 10000), False), ("1/3", fmpq(333, 1000), False),
        ("√2", fmpq(141, 100), False), ("14", fmpq(29, 2), False), ("145", fmpq(1454, 10), True),
        ("144", fmpq(1454, 10), False),
    ],
)  # fmt: skip
def test_a_number_with_fewer_digits_is_the_key_rounded_or_cut_off(typed: str, key: fmpq, shorter: bool) -> None:
    # A whole number below 100, or a short fraction, means what it says.
    assert _is_shorter(read_number(typed), key) is shorter


def test_a_word_has_no_digits() -> None:
    assert not _is_shorter("yes", "yes")
