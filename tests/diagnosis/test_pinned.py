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
    exercise = drawn(family(name))
    mine = {
        key.removeprefix(f"{exercise.id} "): line for key, line in PINNED.items() if key.startswith(f"{exercise.id} ")
    }
    assert mine or not pinned(family(name)), f"run python tests/golden/write.py {name}"
    for typed, line in mine.items():
        part, _, text = typed.partition(": ")
        found = said(exercise, part, text)
        assert found["says"] == line["says"], typed
        assert [kind for kind, _ in found["sure"]] == [kind for kind, _ in line["sure"]], typed
        sure = [share for _, share in line["sure"]]
        assert [share for _, share in found["sure"]] == pytest.approx(sure, abs=0.011), typed
