"""The manifest of an exam: what was printed, as JSON."""

import json
from pathlib import Path
from typing import Any

from rldrill import __version__
from rldrill.exam.exam import Exam, points_of
from rldrill.exercise import Exercise

#: The version of the manifest's form.
FORMAT = 1


def manifest(exam: Exam, paper: str) -> dict[str, Any]:
    """What was printed: enough to print the keys again or to grade, also after a family has changed."""
    return {
        "format": FORMAT,
        "rldrill": __version__,
        "title": exam.title,
        "seed": exam.seed,
        "level": exam.level,
        "names": list(exam.names),
        "paper": paper,
        "versions": [
            {
                "code": version.code,
                "points": version.points,
                "problems": [_entry(index, item) for index, item in enumerate(version.exercises, 1)],
            }
            for version in exam.versions
        ],
    }


def _entry(index: int, exercise: Exercise) -> dict[str, Any]:
    asked = [{"part": part.label, "kind": part.kind.name, "points": part.points} for part in exercise.parts]
    entry = {"number": index, "id": exercise.id, "points": points_of(exercise), "parts": asked}
    return entry | {"problem": exercise.problem.data()}


def is_manifest(path: Path) -> bool:
    """Whether a file is the manifest of an exam."""
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return False
    return isinstance(data, dict) and "rldrill" in data and "versions" in data
