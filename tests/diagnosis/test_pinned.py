"""What is said of wrong answers of every family stays what was found to be right, and as sure."""

import json
import sys
from pathlib import Path

import pytest

from rldrill.problems.catalogue import families, family

sys.path.insert(0, str(Path(__file__).parent))
from pinned import drawn, pinned, said

PINNED = json.loads((Path(__file__).parents[1] / "golden" / "diagnoses.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", families())
def test_wrong_answers_are_put_down_to_what_they_were_made_by(name: str) -> None:
    exercises = {exercise.id: exercise for exercise in drawn(family(name))}
    mine = {key: line for key, line in PINNED.items() if key.partition(" ")[0] in exercises}
    assert mine or not pinned(family(name)), f"run python tests/golden/write.py {name}"
    for key, line in mine.items():
        exercise, typed = key.split(" ", 1)
        part, text = typed.split(": ", 1)
        found = said(exercises[exercise], part, text)
        assert found["says"] == line["says"], key
        assert [kind for kind, _ in found["sure"]] == [kind for kind, _ in line["sure"]], key
        sure = [share for _, share in line["sure"]]
        assert [share for _, share in found["sure"]] == pytest.approx(sure, abs=0.011), key
