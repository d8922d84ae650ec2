"""What IDs stand for, in so few letters that many of them can be pinned."""

import hashlib
import json

from rldrill.exercise import draw
from rldrill.problems.family import Family
from rldrill.render.markdown import markdown

SEEDS = range(10)


def digests(family: Family) -> dict[str, str]:
    """Of each level the givens and the printed questions of many seeds, as a number that is another one if they are."""
    found = {}
    for level in family.levels:
        printed = hashlib.sha256()
        for seed in SEEDS:
            exercise = draw(family.name, level, seed)
            parts = [(part.ask, part.points) for part in exercise.parts]
            printed.update(json.dumps([exercise.data()["given"], markdown(exercise.question()), parts]).encode())
        found[f"{family.name}/{level}@{family.revision}"] = printed.hexdigest()[:16]
    return found
