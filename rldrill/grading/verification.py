"""Judges files of answers: the library under ``rldrill verify``."""

import os
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

from msgspec import Struct, field
from msgspec.structs import replace

from rldrill.files import shown
from rldrill.grading.answers_file import PLACE, Entry, HandedIn, Refusal, read_answers, whose_file
from rldrill.grading.assignment import Assignment, Sitting, without_zeros
from rldrill.grading.isolation import Marker, marker
from rldrill.grading.marking import Ref, Rules, Task, refusal
from rldrill.grading.report import (
    ELSEWHERE,
    EMPTY,
    NOT_GRADED,
    PERHAPS,
    UNREAD,
    Judged,
    MarkedPart,
    Report,
    Score,
    StudentReport,
    missing,
)
from rldrill.problems.errors import FileError, NothingToGrade, UserError
from rldrill.problems.identity import looks_like_id, split_id
from rldrill.spreadsheet import folded

if TYPE_CHECKING:
    from rldrill.exam.manifest import Printed

#: How long the grading of one student may take, and that of a run, in seconds.
STUDENT = 30.0
RUN = 3600.0
#: So much of an answer is kept to be shown.
SHOWN = 1000
#: Which of several hand-ins of one student counts.
HAND_INS = ("last", "first", "best")


class Settings(Struct, frozen=True):
    """What is graded, and how.

    Args:
        assignment: the exam; None to grade whatever is answered.
        allow_files: whether problem files that answers name are opened, in the folder of the answers.
        hand_ins: which of several hand-ins counts; None, without an exam, grades every file for itself.
        strict: whether nothing is graded where something cannot be read.
        isolated: whether marking has a process of its own.
        needed: the share of the points that every student must reach.
        rules: how single answers are marked.
        student: how many seconds the grading of one student may take.
        absent: whether people on the roster who handed in nothing are reported, too.
    """

    assignment: Assignment | None = None
    allow_files: bool = False
    hand_ins: str | None = None
    strict: bool = False
    isolated: bool = False
    needed: Fraction | None = None
    rules: Rules = field(default_factory=Rules)
    student: float = STUDENT
    absent: bool = True


def verify(
    paths: Iterable[str | Path], settings: Settings | None = None, advance: Callable[[int, int], None] | None = None
) -> Report:
    """Judge files of answers; what cannot be graded is told, and does not stop the rest.

    Args:
        paths: the files; one that is named twice is read once.
        settings: what is graded, and how.
        advance: called with how many students are graded, and how many there are.
    """
    settings = settings or Settings()
    handed: list[HandedIn] = []
    refused: list[Refusal] = []
    files: dict[str, str | Path] = {}
    for path in paths:
        files.setdefault(_place(path), path)
    for path in files.values():
        try:
            handed.append(read_answers(path))
            refused += handed[-1].refused
        except (FileError, NothingToGrade) as error:
            refused.append(Refusal(shown(path), None, whose_file(path), str(error), error.exit_code))
    if settings.strict and any(each.exit_code == FileError.exit_code for each in refused):
        return Report((), tuple(refused))
    run = _Run(settings, refused)
    students = list(run.students(handed))
    manifest = None if settings.assignment is None else settings.assignment.manifest
    with marker(manifest, run.rules, isolated=settings.isolated) as desk:
        graded: dict[int, StudentReport | None] = {}
        for number in run.order(students):
            graded[number] = run.report(students[number], desk)
            if advance is not None:
                advance(len(graded), len(students))
    reports = [report for number in range(len(students)) if (report := graded[number]) is not None]
    if settings.strict and any(each.exit_code == FileError.exit_code for each in refused):
        reports = []
    exam = None if settings.assignment is None else settings.assignment.exam
    title, scale = ("", None) if exam is None else (exam.head.title, exam.scale)
    return Report(tuple(reports), tuple(refused), run.notes, title, settings.needed, scale)


def _place(path: str | Path) -> str:
    """Where a file is, whatever it is called."""
    try:
        return os.path.realpath(path)
    except ValueError:  # no name of a file
        return str(path)


class _Student(Struct):
    """One student's answers, one list for every file."""

    sitting: Sitting
    unread: str = ""
    hand_ins: dict[Path, list[Entry]] = field(default_factory=dict)
    said: dict[str, None] = field(default_factory=dict)


def _names(student: str, number: str) -> set[str]:
    return {without_zeros(name) for name in (student, number) if name}


class _Clock:
    """The time that one student has; solving the problems of an exam, which everybody has, is not counted."""

    def __init__(self, seconds: float, desk: Marker | None) -> None:
        self._seconds, self._desk, self._begun = seconds, desk, perf_counter()
        self._loaded = 0.0 if desk is None else desk.loading

    def left(self) -> float:
        """How many seconds are left."""
        loading = 0.0 if self._desk is None else self._desk.loading - self._loaded
        return self._seconds - (perf_counter() - self._begun - loading)


class _Run:
    """One run of grading; what cannot be graded is added to ``refused``."""

    def __init__(self, settings: Settings, refused: list[Refusal]) -> None:
        self._settings, self._refused = settings, refused
        self._assignment = settings.assignment
        self._hand_ins = settings.hand_ins or (HAND_INS[0] if settings.assignment else "")
        self._begun = perf_counter()
        self._unknown: set[str] = set()
        self.notes: dict[str, tuple[str, ...]] = {}

    @property
    def rules(self) -> Rules:
        """How single answers are marked: the exam's rule for parts of points goes before the usual one."""
        repeated = "" if self._settings.hand_ins in (None, "best") else self._settings.hand_ins
        rules = replace(self._settings.rules, repeated=repeated)
        exam = self._assignment
        return rules if exam is None else rules.of(exam.exam)

    def students(self, handed: Sequence[HandedIn]) -> Iterator[_Student]:
        """Who answered, in the order of the files; then who is on the roster and did not."""
        found: dict[tuple[str, ...], _Student] = {}
        for each in handed:
            for entry in each.entries:
                sitting = Sitting(entry.student, entry.number, None)
                if self._assignment is not None:
                    sitting = self._assignment.sitting(entry)
                    if sitting.version is None:
                        if entry.student not in self._unknown:
                            self._unknown.add(entry.student)
                            self._refused.append(refusal(entry, sitting.why, ""))
                        continue
                who = folded(sitting.number or sitting.student)
                key = (who,) if self._hand_ins and who else (who, str(entry.path))
                student = found.setdefault(key, _Student(sitting))
                student.hand_ins.setdefault(entry.path, []).append(entry)
                others = {folded(entry.student)} - {"", folded(entry.number), folded(sitting.student)}
                if entry.number and sitting.number and others:
                    whose = f"number {sitting.number} is {sitting.student}'s, and beside it stands {entry.student!r}"
                    student.said[f"{shown(entry.path)}: {whose}; it is marked as {sitting.student}'s."] = None
        yield from found.values()
        if self._assignment is not None and self._settings.absent:
            people = ((folded(each.number or each.student), each) for each in self._assignment.people)
            yield from (_Student(each, self._unread(each)) for who, each in people if (who,) not in found)

    def _unread(self, sitting: Sitting) -> str:
        """What is known of somebody of whom nothing was read: whether they handed in something all the same."""
        names = _names(sitting.student, sitting.number)
        if any(each.exit_code == NothingToGrade.exit_code and _names(each.student, each.number) & names
               for each in self._refused):  # fmt: skip
            return EMPTY
        unreadable = [each for each in self._refused if each.exit_code == FileError.exit_code]
        theirs = set().union(*(_names(each.student, each.number) for each in unreadable)) & names
        if any(self._shared[name] == 1 for name in theirs):
            return UNREAD
        if theirs or any(each.line is None and not each.student for each in unreadable):
            return PERHAPS
        return ELSEWHERE if any(without_zeros(name) not in self._shared for name in self._unknown) else ""

    @cached_property
    def _shared(self) -> Counter[str]:
        """How many on the roster have a name or number."""
        people = () if self._assignment is None else self._assignment.people
        return Counter(name for each in people for name in _names(each.student, each.number))

    def order(self, students: Sequence[_Student]) -> list[int]:
        """The numbers of the students, those of a version one after the other: only its problems are kept meanwhile."""
        codes = () if self._assignment is None else tuple(self._assignment.versions)
        places = {code: place for place, code in enumerate(codes)}

        def place(number: int) -> int:
            version = students[number].sitting.version
            return -1 if version is None else places[version.code]

        return sorted(range(len(students)), key=place)

    def report(self, student: _Student, desk: Marker) -> StudentReport | None:
        """One student's report; None where nothing of it could be graded."""
        chosen = list(student.hand_ins.values()) or [[]]
        if self._hand_ins == "last":
            chosen = chosen[-1:]
        elif self._hand_ins == "first":
            chosen = chosen[:1]
        clock = _Clock(self._settings.student, desk if self._assignment is not None else None)
        reports = [self._graded(student.sitting, entries, desk, clock) for entries in chosen]
        found = [report for report in reports if report is not None]
        best = max(found, key=lambda report: report.score.points, default=None)  # the first of the best
        if best is None:
            return None
        others = tuple(path for path in map(shown, student.hand_ins) if path not in best.paths)
        return replace(best, extra=(*best.extra, *student.said), others=others, unread=student.unread)

    def _graded(
        self, sitting: Sitting, entries: Sequence[Entry], desk: Marker, clock: "_Clock"
    ) -> StudentReport | None:
        tasks, extra = self._tasks(sitting, entries)
        parts: list[MarkedPart] = []
        for slot, task in tasks:
            parts += self._parts(slot, task, desk, clock, sitting.version)
        if not parts and not extra:
            return None
        version = "" if sitting.version is None else sitting.version.code
        paths = tuple(dict.fromkeys(shown(entry.path) for entry in entries))
        return StudentReport(sitting.student, tuple(parts), sitting.number, version, paths, extra)

    def _parts(
        self, slot: int, task: Task, desk: Marker, clock: "_Clock", version: "Printed | None"
    ) -> Iterator[MarkedPart]:
        if version is not None and not isinstance(task.ref, str) and not task.entries and not self.rules.keys:
            for label, of in version.worth[task.ref[1]].items():  # no problem is solved to say that it is missing
                yield MarkedPart(task.name, label, "", missing(of), slot=slot)
            return
        try:
            if perf_counter() - self._begun > RUN:
                raise FileError(f"the run took more than {RUN:g} seconds; grade the rest in another one.")
            if (left := clock.left()) <= 0:
                limit = self._settings.student
                raise FileError(f"grading this student took more than {limit:g} seconds; {task.name} is not graded.")
            marked = desk.mark(task, left)
        except UserError as error:
            whose = [refusal(entry, str(error), task.name) for entry in task.entries[:1]]
            self._refused += whose or [Refusal("", None, "", str(error), problem=task.name)]
            if version is not None and not isinstance(task.ref, str):  # what an exam asks counts, whatever happens
                for label, of in version.worth[task.ref[1]].items():
                    judged = Judged("", NOT_GRADED, False, str(error), Score(Fraction(0), of), "")
                    yield MarkedPart(task.name, label, "", judged, slot=slot)
            return
        self._refused += marked.refused
        if marked.notes:
            self.notes[task.ref if isinstance(task.ref, str) else task.name] = marked.notes
        for label, entry, judged in marked.parts:
            if entry is None:
                yield MarkedPart(task.name, label, "", judged, slot=slot)
            else:
                typed = entry.text if len(entry.text) <= SHOWN else f"{entry.text[:SHOWN]}…"
                yield MarkedPart(task.name, label, typed, judged, shown(entry.path), entry.line, entry.column, slot)

    def _tasks(self, sitting: Sitting, entries: Sequence[Entry]) -> tuple[list[tuple[int, Task]], tuple[str, ...]]:
        """What is to be marked, with its place in the exam; and what is not."""
        version = sitting.version
        if self._assignment is None or version is None:
            return self._named(entries), ()
        answered: dict[int, list[Entry]] = {place: [] for place in range(len(version.ids))}
        extra: dict[str, None] = {}
        guesses = self._assignment.guesses(entries, version)
        for entry in entries:
            place = self._assignment.place(entry, version)
            if guesses and looks_like_id(entry.problem):
                extra["So many IDs are guesses; the problems of this exam are called by their numbers."] = None
            elif isinstance(place, int):
                answered[place].append(entry)
            else:
                extra[f"{entry.where}: {place}; it is not marked."] = None
        tasks = [
            (
                version.slots[place] + 1,
                Task((version.code, place), self._assignment.called(version, place), tuple(found)),
            )
            for place, found in answered.items()
        ]
        return tasks, tuple(extra)

    def _named(self, entries: Sequence[Entry]) -> list[tuple[int, Task]]:
        """The problems that are answered, where no exam says which count."""
        answered: dict[tuple[Ref, str], list[Entry]] = {}
        for entry in entries:
            if looks_like_id(entry.problem):
                ref, name = self._identity(entry.problem), self._identity(entry.problem)
            elif PLACE.fullmatch(entry.problem):
                says = f"problem {entry.problem} of which exam? Name the exam, or give the problem's ID."
                self._refused.append(refusal(entry, says, ""))
                continue
            elif said := self._forbidden(entry):
                self._refused.append(refusal(entry, said, entry.problem))
                continue
            else:
                name = os.path.normpath(entry.problem)
                ref = str(entry.path.parent / name)
            answered.setdefault((ref, name), []).append(entry)
        return [(0, Task(ref, name, tuple(found))) for (ref, name), found in answered.items()]

    def _identity(self, name: str) -> str:
        """The ID with its revision, where its family exists."""
        from rldrill.problems.catalogue import family

        try:
            text, level, seed, revision = split_id(name)
            return f"{text}/{level}/{seed}@{family(text).revision if revision is None else revision}"
        except UserError:
            return name

    def _forbidden(self, entry: Entry) -> str:
        """Why a problem file that answers name is not opened; nothing if it is."""
        if not self._settings.allow_files:
            return (
                f"{entry.problem[:60]!r} names a problem file; --allow-files opens those that lie beside the answers."
            )
        folder = entry.path.parent.resolve()
        try:
            inside = (folder / entry.problem).resolve().is_relative_to(folder)
        except (OSError, RuntimeError, ValueError):
            inside = False
        return "" if inside else f"{entry.problem[:60]!r} is not in the folder of the answers; it is never opened."
