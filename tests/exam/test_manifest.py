"""Manifests: all that was printed, so that the exam is made again from the givens alone."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from rldrill.exam.blueprint import Blueprint, Entry
from rldrill.exam.exam import Exam, Person
from rldrill.exam.manifest import codes, is_manifest, manifest, read_exam, read_manifest, typst_of, written
from rldrill.exam.planning import plan
from rldrill.files import LARGEST
from rldrill.problems.errors import FileError


@pytest.fixture(scope="module")
def exam() -> Exam:
    entries = (Entry(id="td-zero/1/7"), Entry(topic=("return", "epsilon-greedy"), count=2, level=1))
    blueprint = Blueprint(
        problems=entries, seed=4, title="$5", date="May", points=30, partial="entries", order="shuffled", space="wide",
        notation="sutton-barto",
    )  # fmt: skip
    return plan(blueprint, roster=(Person("Ann", "17"), Person("Bob", "4")))


@pytest.fixture
def path(exam: Exam, tmp_path: Path) -> Path:
    path = tmp_path / "exam.json"
    path.write_bytes(written(manifest(exam, "0.15")))
    return path


def changed(path: Path, change: Callable[[dict[str, Any]], object]) -> Path:
    data = json.loads(path.read_text())
    change(data)
    path.write_text(json.dumps(data))
    return path


def test_the_exam_that_is_read_is_the_one_that_was_written(exam: Exam, path: Path) -> None:
    again = read_manifest(path)
    assert manifest(again, "0.15") == manifest(exam, "0.15")
    assert again.versions[1].person == Person("Bob", "4")
    assert again.versions[0].points == 30
    assert again.layout.notation == "sutton-barto"
    assert again.partial == "entries"
    assert (codes(path), typst_of(path), is_manifest(path)) == (("A", "B"), "0.15", True)
    without, makes = read_exam(path)
    assert not without.versions
    assert makes[1]().code == "B"


def test_the_manifest_of_many_versions_is_larger_than_what_students_hand_in(path: Path) -> None:
    path.write_bytes(path.read_bytes() + b" " * LARGEST)
    assert codes(path) == ("A", "B")


def test_an_older_revision_is_made_from_its_givens(exam: Exam, path: Path) -> None:
    def older(data: dict[str, Any]) -> None:
        for problem in data["versions"][0]["problems"]:
            problem["id"] = f"{problem['family']}/1/5@0"

    again = read_manifest(changed(path, older)).versions[0]
    assert {item.id.partition("@")[2] for item in again.exercises if item.id} == {"0"}
    assert [item.solve() for item in again.exercises] == [item.solve() for item in exam.versions[0].exercises]


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda data: data.update(format=3), "its format is 3, and this release reads format 2"),
        (
            lambda data: data.update(versions=[]),
            "the manifest is damaged at versions (is empty; it needs at least 1 entry); take it from a backup",
        ),
        (
            lambda data: data["versions"][0].update(code="../x"),
            "damaged at versions.1.code (must be 1 to 8 capital letters or digits); take it from a backup",
        ),
        (lambda data: data.update(title=None), "damaged at title (must be a text; put it in quotes); take it from"),
        (
            lambda data: data["versions"][0]["problems"][1].update(id="kalman-filter/1/7@4"),
            "version A, problem 2: its ID, family and problem are of ",
        ),
        (
            lambda data: data["versions"][0]["problems"][1].update(family="kalman-filter"),
            "version A, problem 2: its ID, family and problem are of ",
        ),
        (
            lambda data: data["versions"][1]["problems"][0]["problem"].update(family=True),
            "version B, problem 1: 'family' must be the name of a family in quotes",
        ),
        (lambda data: data.pop("versions"), "this is no manifest of an exam"),
        (lambda data: data.update(seed="x"), "the manifest is damaged at seed"),
        (lambda data: data["versions"][1].update(code="A"), "version A stands there twice"),
        (
            lambda data: data["versions"][1]["problems"][0].update(
                id=None, family="nothing", problem={"family": "nothing", "given": {}}
            ),
            "version B, problem 1: There is no family 'nothing'",
        ),
        (lambda data: data["versions"][0]["problems"][1]["problem"].update(given={}), "version A, problem 2: given"),
        (
            lambda data: data["versions"][0]["problems"][0]["parts"].append({"part": "z", "points": 1}),
            "version A, problem 1: the manifest has points for",
        ),
    ],
)
def test_a_damaged_manifest_is_one_sentence(
    change: Callable[[dict[str, Any]], object], sentence: str, path: Path
) -> None:
    with pytest.raises(FileError) as caught:
        read_manifest(changed(path, change))
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)
    assert caught.value.exit_code == 3
