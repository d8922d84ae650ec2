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

LEVEL, SEED, EACH = 2, 0, 4
#: What takes longer is left to ``measure.py``; in milliseconds.
_QUICK = 40


def pinned(family: Family) -> dict[str, Any]:
    """What is said of a few wrong answers to a problem of a family."""
    exercise = drawn(family)
    wrong = _wrong(exercise)
    return {f"{exercise.id} {part}: {text}": {"made": made, **said(exercise, part, text)} for made, part, text in wrong}


def drawn(family: Family) -> Exercise:
    """The problem whose wrong answers are pinned."""
    return draw(family.name, LEVEL, SEED)


def said(exercise: Exercise, part: str, text: str) -> dict[str, Any]:
    """What is said of a wrong answer with all the time there is, and how sure each of it is."""
    first = exercise.diagnose(text, part)
    every = (first, *first.alternatives)
    return {"says": first.sentence, "sure": [[each.kind, each.confidence] for each in every]}


def _wrong(exercise: Exercise) -> Iterator[tuple[str, str, str]]:
    measured = Measured(exercise.solution, None)
    errors = erroneous(exercise.solution, SEED)
    random.Random(str(exercise.id)).shuffle(errors)
    kinds: set[str] = set()
    for error in errors:
        if len(kinds) < EACH and error.kind not in kinds and (found := measured.causes(error.part, error.text)):
            causes, milliseconds = found
            if milliseconds < _QUICK and measured.verdict(error, causes) == "right":
                kinds.add(error.kind)
                yield error.kind, error.part, error.text
    for part in exercise.parts:
        text = random_wrong(exercise.solution, part.label, SEED) if numeric(exercise.solution, part.label) else None
        found = None if text is None else measured.causes(part.label, text)
        if text is not None and found is not None and not found[0] and found[1] < _QUICK:
            yield "nothing", part.label, text
            return
