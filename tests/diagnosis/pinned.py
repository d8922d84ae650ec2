"""Wrong answers whose making is known, and what is said of them: what ``tests/golden/diagnoses.json`` holds.

An error of the error model is pinned only where the diagnosis names its kind and its place, which ``measure.py``
judges by how the error was made; a number from nowhere only where nothing is said of it.
"""

import random
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parent))

from error_model import erroneous, numeric, random_wrong
from measure import Measured

from rldrill.exercise import Exercise, draw
from rldrill.problems.family import Family

LEVELS, SEED = (2, 3), 0
#: So many kinds of error to a problem.
MOST = 4


def pinned(family: Family) -> dict[str, Any]:
    """What is said of a few wrong answers to problems of a family."""
    return {
        f"{exercise.id} {part}: {text}": {"made": made, **said(exercise, part, text)}
        for exercise in drawn(family)
        for made, part, text in _wrong(exercise)
    }


def drawn(family: Family) -> list[Exercise]:
    """The problems whose wrong answers are pinned."""
    return [draw(family.name, level, SEED) for level in LEVELS if level in family.levels]


def said(exercise: Exercise, part: str, text: str) -> dict[str, Any]:
    """What is said of a wrong answer with all the time there is, and how sure each of it is."""
    first = exercise.diagnose(text, part)
    every = (first, *first.alternatives)
    return {"says": first.sentence, "sure": [[each.kind, each.confidence] for each in every]}


def _wrong(exercise: Exercise) -> Iterator[tuple[str, str, str]]:
    """Wrong answers of a few kinds of error, each put down to what it was made by; and a number from nowhere."""
    measured = Measured(exercise.solution, None)
    errors = erroneous(exercise.solution, SEED)
    random.Random(str(exercise.id)).shuffle(errors)
    kinds: set[str] = set()
    for error in errors:
        if len(kinds) == MOST:
            break
        found = None if error.kind in kinds else measured.causes(error.part, error.text)
        if found is not None and measured.verdict(error, found[0]) == "right":
            kinds.add(error.kind)
            yield error.kind, error.part, error.text
    for part in exercise.parts:
        text = random_wrong(exercise.solution, part.label, SEED) if numeric(exercise.solution, part.label) else None
        found = None if text is None else measured.causes(part.label, text)
        if text is not None and found is not None and not found[0]:
            yield "nothing", part.label, text
            return
