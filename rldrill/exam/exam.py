"""An exam as a thing: versions of one length and difficulty that share no problem."""

from collections.abc import Mapping
from fractions import Fraction

from msgspec import Struct

from rldrill.exam.choices import DecimalMark, Language, Paper, Partial, Solutions, Space
from rldrill.exercise import Exercise
from rldrill.problems.notations import LECTURE
from rldrill.solutions.effort import minutes, whole

DEFAULT_TITLE = "Reinforcement Learning: worksheet"


class Person(Struct, frozen=True):
    """Somebody on the roster."""

    name: str
    number: str


class Head(Struct, frozen=True):
    """What is said of the exam as a whole, all of it plain text.

    Args:
        title: the title.
        course: the course, or nothing.
        date: the day, as it is printed, or nothing.
        duration: the minutes that there are, or None.
        instructions: what is printed before the first problem, beside the rule for answers.
        language: of the fixed words.
        decimal_mark: the sign before the decimals.
    """

    title: str = DEFAULT_TITLE
    course: str = ""
    date: str = ""
    duration: int | None = None
    instructions: str = ""
    language: Language = "en"
    decimal_mark: DecimalMark = "."


class Layout(Struct, frozen=True):
    """How an exam is printed.

    Args:
        paper: the name of the paper.
        space: how much room there is for working.
        solutions: whether keys are written, and whether beside the exam or in it.
        ids: whether the problems' IDs and the seed are printed; an ID is its own key.
        duplex: whether every PDF has an even number of pages.
        notation: how quantities are written.
    """

    paper: Paper = "a4"
    space: Space = "normal"
    solutions: Solutions = "separate"
    ids: bool = False
    duplex: bool = False
    notation: str = LECTURE


class Version(Struct, frozen=True):
    """One version of an exam: what one person gets.

    Every exercise carries the points that its parts earn here (``exercise.parts[0].points``).

    Args:
        code: A, B, …
        exercises: the problems in the order in which they are printed.
        slots: for each of them its place in the blueprint, from 0, which versions have in common.
        person: whose it is, where there is a roster.
        partial: for every problem the rules for wrong entries of its parts, where they are others than the exam's.
    """

    code: str
    exercises: tuple[Exercise, ...]
    slots: tuple[int, ...]
    person: Person | None = None
    partial: tuple[Mapping[str, str], ...] = ()

    def rules(self, index: int) -> Mapping[str, str]:
        """The rules for wrong entries that parts of a problem have of their own; by its place, from 0."""
        return self.partial[index] if self.partial else {}

    @property
    def points(self) -> int:
        """What the whole version earns."""
        return sum(map(points_of, self.exercises))

    @property
    def minutes(self) -> int:
        """How many minutes the whole version takes by hand."""
        return whole(self.time)

    @property
    def time(self) -> Fraction:
        """The same, not rounded."""
        return sum((minutes(exercise.solution) for exercise in self.exercises), Fraction(0))


class Exam(Struct, frozen=True):
    """An exam in all its versions.

    Args:
        head: what is said of it.
        seed: what the choice of problems depends on.
        versions: all versions.
        partial: what wrong entries of a table or matrix cost: all of the part's points, or their share of them.
        layout: how it is printed.
        sealed: whether a secret was mixed into its draws.
        scale: as how many points reports tell the whole exam; None for its own.
    """

    head: Head
    seed: int
    versions: tuple[Version, ...]
    partial: Partial = "all"
    layout: Layout = Layout()
    sealed: bool = False
    scale: int | None = None

    def title_of(self, version: Version) -> str:
        """The title of a version: the exam's, with its code where there are several."""
        return self.head.title + (f" ({version.code})" if len(self.versions) > 1 else "")


def points_of(exercise: Exercise) -> int:
    """What a problem earns, all parts together."""
    return sum(part.points for part in exercise.parts)


def minutes_of(exercise: Exercise) -> int:
    """How many minutes a problem takes by hand, estimated from its steps."""
    return whole(minutes(exercise.solution))
