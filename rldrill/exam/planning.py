"""Planning an exam: choosing its families, and drawing a problem for every place of every version."""

import json
from collections.abc import Callable, Iterator, Sequence
from itertools import islice

from rldrill.exam.exam import Exam, Version, points_of
from rldrill.exam.selection import sequence
from rldrill.exercise import Exercise, draw
from rldrill.problems.errors import UsageError
from rldrill.problems.family import Family

DEFAULT_TITLE = "Reinforcement Learning: worksheet"
_LONGEST_TITLE = 120
#: How many problems are drawn for one place of an exam before the family counts as used up.
_ATTEMPTS = 400


def plan(
    names: Sequence[str],
    count: int,
    level: int | None,
    seed: int,
    versions: int,
    *,
    title: str = DEFAULT_TITLE,
    advance: Callable[[], None] | None = None,
) -> Exam:
    """Choose and draw the problems; the same arguments give the same exam.

    Args:
        names: topics and families; all, if there are none.
        count: how many problems a version has.
        level: 1 to 3, or None for a mixture.
        seed: what the choice depends on.
        versions: how many versions; they share families and levels, and no problem.
        title: what is printed at the head.
        advance: called after each version.

    Raises:
        UsageError: a name does not exist, the title is too long, or there are too few different problems.
    """
    if len(title) > _LONGEST_TITLE:
        raise UsageError(f"The title has {len(title)} characters; give one of at most {_LONGEST_TITLE}.")
    slots = [(family, wanted) for family, wanted, _ in islice(sequence(names, level, seed), count)]
    used: set[str] = set()
    result: list[Version] = []
    for index in range(versions):
        seeds = (drawn for _, _, drawn in sequence(names, level, seed, index))
        first = result[0].exercises if result else (None,) * len(slots)
        exercises = tuple(
            _new_problem(family, wanted, seeds, used, like) for (family, wanted), like in zip(slots, first, strict=True)
        )
        result.append(Version(title, seed, version_code(index), exercises))
        if advance is not None:
            advance()
    return Exam(title, seed, tuple(names), level, tuple(result))


def version_code(index: int) -> str:
    """A, B, …, Z, AA, AB, …"""
    head, last = divmod(index, 26)
    return (version_code(head - 1) if head else "") + chr(ord("A") + last)


def _new_problem(
    family: Family, level: int, seeds: Iterator[int], used: set[str], like: Exercise | None = None
) -> Exercise:
    """A problem that no version has yet; in later versions it earns what the first one's does in its place."""
    for seed in islice(seeds, _ATTEMPTS):
        exercise = draw(family.name, level, seed)
        content = json.dumps(exercise.problem.data(), sort_keys=True)
        if content not in used and (like is None or points_of(exercise) == points_of(like)):
            used.add(content)
            return exercise
    raise UsageError(
        f"{family.name} has too few different problems at level {level} for this worksheet; "
        "ask for fewer versions or problems, or for more families."
    )
