"""What is written of a problem: a line of JSON, made in whichever process draws it."""

import hashlib
import json
from collections.abc import Sequence
from enum import Enum
from typing import NamedTuple

from rldrill.exercise import draw
from rldrill.render.markdown import markdown

#: So many wrong answers are written for every part.
_MISTAKES = 8


class Extra(Enum):
    """What can be written besides the question and its parts."""

    ANSWERS = "answers"
    WORKING = "working"
    HINTS = "hints"
    LATEX = "latex"
    MISTAKES = "mistakes"


class Record(NamedTuple):
    """A problem as one line of JSON, and a digest of its givens: two problems with the same one are the same."""

    digest: bytes
    line: str


def record(family: str, level: int, seed: int, extras: Sequence[Extra]) -> Record:
    """Draw a problem and write it.

    Args:
        family: the family.
        level: its level.
        seed: the problem's own seed.
        extras: what is written besides; the working and the hints are Markdown with LaTeX if that is asked for.
    """
    exercise = draw(family, level, seed)
    wrong = _MISTAKES if Extra.MISTAKES in extras else 0
    latex = Extra.LATEX in extras
    data = exercise.data(answers=Extra.ANSWERS in extras, mistakes=wrong, latex=latex)
    written = markdown if latex else str
    for entry, part in zip(data["parts"], exercise.parts, strict=True):
        if Extra.HINTS in extras:
            entry["hint"] = written(exercise.hint(part.label))
        if Extra.WORKING in extras:
            entry["working"] = written(exercise.working(part.label))
    digest = hashlib.blake2b(json.dumps(data["given"], sort_keys=True).encode(), digest_size=12).digest()
    return Record(digest, json.dumps(data, ensure_ascii=False))


def block(family: str, level: int, first: int, count: int, extras: tuple[Extra, ...]) -> list[Record]:
    """The records of the seeds from ``first`` on: the piece of work that a process or a machine is given."""
    return [record(family, level, seed, extras) for seed in range(first, first + count)]
