"""Pin problems with their answers, pages, limits of fields, what is said of wrong answers; minutes, variety; screens.

Of the families named, or of all:

    python tests/golden/write.py [FAMILY …]

After adding a family, or raising a REVISION. Every problem is a line; lines of other families stay as they are. An
answer that the family's independent solver does not confirm is not written. Review the diff.
"""

import json
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from statistics import median
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1] / "shared"))
sys.path.insert(0, str(Path(__file__).parents[1] / "diagnosis"))
import pinned as diagnoses

from handed_out import FILES, fingerprint
from limits import limits
from printing import SAID, page
from rldrill.audit.checking import agrees
from rldrill.exam.expected import COUNTED, VARIETY
from rldrill.exam.expected import FILE as MINUTES
from rldrill.exam.pool import variety
from rldrill.exercise import Exercise, draw
from rldrill.problems.catalogue import families, family
from rldrill.solutions.effort import minutes, whole
from rldrill.solutions.solution import solver
from screens import WIDTHS, transcript

PAGES = Path(__file__).with_name("pages")
SCREENS = Path(__file__).with_name("screens")
PROBLEMS = Path(__file__).with_name("problems.json")
FIELDS = Path(__file__).with_name("fields.json")
DIAGNOSES = Path(__file__).with_name("diagnoses.json")
HANDED_OUT = Path(__file__).with_name("handed_out.json")
PINNED = range(2)
MEASURED = range(15)


def pinned(exercise: Exercise) -> dict[str, Any]:
    """What is pinned of a problem: its givens and its exact answers."""
    expected = solver(exercise.problem.family).oracle(exercise.problem.given)
    for part, other in zip(exercise.parts, expected, strict=True):
        answer = exercise.solution.answers[part.label]
        if not agrees(part, answer, other):
            sys.exit(f"{exercise.id} ({part.label}): {answer} is not {other}, which the oracle has.")
    data = exercise.data()
    return {"given": data["given"], "answers": {part["part"]: part["answer"]["exact"] for part in data["parts"]}}


def rewrite(path: Path, names: Iterable[str], new: Mapping[str, Any]) -> None:
    """Put the new lines in the place of all lines of these families."""
    kept = json.loads(path.read_text(encoding="utf-8"))
    lines = {key: value for key, value in kept.items() if key.partition("/")[0] not in names} | dict(new)
    keys = [key for name in families() for key in lines if key.partition("/")[0] == name]
    text = ",\n".join(f" {json.dumps(key)}: {json.dumps(lines[key], ensure_ascii=False)}" for key in keys)
    path.write_text(f"{{\n{text}\n}}\n", encoding="utf-8")


chosen = [family(name) for name in sys.argv[1:] or families()]
wanted = {known.name for known in chosen}
drawn = [(known.name, level, seed) for known in chosen for level in known.levels for seed in range(SAID)]
times = {
    known.name: [
        whole(median(minutes(draw(known.name, level, seed).solution) for seed in MEASURED)) for level in known.levels
    ]
    for known in chosen
}
varieties = {known.name: [variety(known.name, level, COUNTED) for level in known.levels] for known in chosen}
confirmed = [(seed, exercise.id, pinned(exercise)) for *level, seed in drawn for exercise in [draw(*level, seed)]]
rewrite(PROBLEMS, wanted, {key: line for seed, key, line in confirmed if seed in PINNED})
rewrite(MINUTES, wanted, times)
rewrite(VARIETY, wanted, varieties)
rewrite(DIAGNOSES, wanted, {key: line for known in chosen for key, line in diagnoses.pinned(known).items()})
rewrite(FIELDS, wanted, {known.name: limits(known) for known in chosen})
pins = {name: fingerprint(make()) for name, make in FILES.items()}
HANDED_OUT.write_text(json.dumps(pins, indent=1) + "\n", encoding="utf-8")
for kind in WIDTHS:
    (SCREENS / f"{kind}.txt").write_text(transcript(kind), encoding="utf-8")
for known in chosen:
    (PAGES / f"{known.name}.txt").write_text(page(known), encoding="utf-8")
