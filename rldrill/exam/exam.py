"""An exam as a thing: versions of one length and difficulty that share no problem."""

from dataclasses import dataclass

from rldrill.exercise import Exercise
from rldrill.solutions.effort import minutes, whole


@dataclass(frozen=True)
class Version:
    """One version of an exam: what one person gets."""

    title: str
    seed: int
    code: str
    exercises: tuple[Exercise, ...]

    @property
    def points(self) -> int:
        """What the whole version earns."""
        return sum(map(points_of, self.exercises))

    @property
    def minutes(self) -> int:
        """How many minutes the whole version takes by hand."""
        return sum(map(minutes_of, self.exercises))


@dataclass(frozen=True)
class Exam:
    """An exam in all its versions, and what it was planned from."""

    title: str
    seed: int
    names: tuple[str, ...]
    level: int | None
    versions: tuple[Version, ...]


def points_of(exercise: Exercise) -> int:
    """What a problem earns, all parts together."""
    return sum(part.points for part in exercise.parts)


def minutes_of(exercise: Exercise) -> int:
    """How many minutes a problem takes by hand, estimated from its steps."""
    return whole(minutes(exercise.solution))
