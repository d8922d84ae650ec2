"""Judges files of answers: the library under ``rldrill verify``."""

import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import Any

from rldrill.diagnosis import IN_A_FILE, Diagnosis
from rldrill.exercise import Exercise, load
from rldrill.files import shown
from rldrill.grading.answers_file import Entry, read_answers
from rldrill.problems.errors import FileError, NothingToGrade, UserError
from rldrill.problems.identity import looks_like_id
from rldrill.problems.parts import Part
from rldrill.solutions.answers.judging import Verdict
from rldrill.solutions.answers.kinds import Unreadable, answer_kind

#: The version of the JSON that ``Report.to_json`` gives.
FORMAT = 1
#: The verdict on a part that was not answered; all others are values of ``Outcome``.
MISSING = "missing"
_COMMA = re.compile(r"(?<![0-9.,])([0-9]+),([0-9]+)(?![0-9.]|,[0-9])")


@dataclass(frozen=True, slots=True)
class Score:
    """Points earned, of how many."""

    points: Fraction
    of: int

    def to_json(self) -> dict[str, Any]:
        """The score as JSON has it: the points exactly and as a decimal."""
        return {"exact": str(self.points), "decimal": f"{float(self.points):.6g}", "of": self.of}


@dataclass(frozen=True, slots=True)
class MarkedPart:
    """The judgement of one part of one problem.

    Args:
        problem: the problem's ID with its revision, or its file as the answers name it.
        part: the label of the part.
        typed: what was typed.
        read: how that was read; empty if it was not.
        verdict: a value of ``Outcome``, or ``missing``.
        accepted: whether the part is right, or follows rightly from an earlier answer.
        reason: one or two sentences to the person.
        score: what the answer earns, and what a right one would.
        key: the right answer, as it would be typed.
        diagnosis: what a wrong answer comes from; None where there is nothing to explain.
        line: the line of the file, where its format has one for every answer.
    """

    problem: str
    part: str
    typed: str
    read: str
    verdict: str
    accepted: bool
    reason: str
    score: Score
    key: str
    diagnosis: Diagnosis | None
    line: int | None

    def to_json(self, *, show_key: bool = False) -> dict[str, Any]:
        """The part as JSON has it."""
        data: dict[str, Any] = {"problem": self.problem, "part": self.part, "line": self.line}
        data |= {"typed": self.typed, "read": self.read, "verdict": self.verdict, "accepted": self.accepted}
        data |= {"reason": self.reason, "points": self.score.to_json()}
        data |= {"diagnosis": None if self.diagnosis is None else self.diagnosis.to_json()}
        return data | ({"key": self.key} if show_key else {})


@dataclass(frozen=True, slots=True)
class StudentReport:
    """The answers of one student in one file; the name is empty where the file gives none."""

    student: str
    parts: tuple[MarkedPart, ...]

    @property
    def score(self) -> Score:
        """The points of all parts."""
        return _total(part.score for part in self.parts)


@dataclass(frozen=True, slots=True)
class FileReport:
    """One file of answers."""

    path: str
    students: tuple[StudentReport, ...]

    @property
    def score(self) -> Score:
        """The points of all students."""
        return _total(student.score for student in self.students)


@dataclass(frozen=True, slots=True)
class Failure:
    """A file that could not be judged, the sentence that says why, and the exit code of that."""

    path: str
    says: str
    exit_code: int


@dataclass(frozen=True, slots=True)
class Report:
    """The judgement of some files.

    Args:
        files: those that could be judged.
        failures: those that could not.
        notes: by problem file, what was read in it otherwise than it is written, such as 0.3333333333333333 as 1/3.
    """

    files: tuple[FileReport, ...]
    failures: tuple[Failure, ...] = ()
    notes: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    @property
    def parts(self) -> tuple[MarkedPart, ...]:
        """The parts of all files."""
        return tuple(part for file in self.files for student in file.students for part in student.parts)

    @property
    def score(self) -> Score:
        """The points of all files."""
        return _total(file.score for file in self.files)

    @property
    def exit_code(self) -> int:
        """0 all right, 1 not all right, 3 a file was unreadable, 4 no file held an answer."""
        codes = {failure.exit_code for failure in self.failures}
        if FileError.exit_code in codes:
            return FileError.exit_code
        if not self.files:
            return NothingToGrade.exit_code
        return int(bool(codes) or not all(part.accepted for part in self.parts))

    def to_json(self, *, show_key: bool = False) -> dict[str, Any]:
        """The report as versioned JSON; the right answers are in it only if they are asked for."""
        return {
            "format": FORMAT,
            "files": [
                {
                    "file": file.path,
                    "students": [
                        {
                            "student": student.student,
                            "points": student.score.to_json(),
                            "answers": [part.to_json(show_key=show_key) for part in student.parts],
                        }
                        for student in file.students
                    ],
                    "points": file.score.to_json(),
                }
                for file in self.files
            ],
            "failures": [
                {"file": failure.path, "says": failure.says, "exit_code": failure.exit_code}
                for failure in self.failures
            ],
            "notes": {problem: list(notes) for problem, notes in self.notes.items()},
            "points": self.score.to_json(),
            "exit_code": self.exit_code,
        }


def verify(paths: Iterable[str | Path]) -> Report:
    """Judge files of answers; a file that cannot be judged becomes a failure and does not stop the others."""
    problems = _Problems()
    files: list[FileReport] = []
    failures: list[Failure] = []
    for path in paths:
        try:
            files.append(FileReport(shown(path), tuple(_students(read_answers(path), problems))))
        except (FileError, NothingToGrade) as error:
            failures.append(Failure(shown(path), str(error), error.exit_code))
    return Report(tuple(files), tuple(failures), problems.notes)


class _Problems:
    """The problems that answers name, each loaded once."""

    def __init__(self) -> None:
        self._loaded: dict[str, Exercise] = {}

    @property
    def notes(self) -> dict[str, tuple[str, ...]]:
        """By problem file, what was read otherwise than it is written."""
        return {shown(name): exercise.notes for name, exercise in self._loaded.items() if exercise.notes}

    def of(self, entry: Entry) -> Exercise:
        """The problem that an answer is for.

        Raises:
            FileError: it does not exist or is broken.
        """
        name = entry.problem if looks_like_id(entry.problem) else str(entry.path.parent / entry.problem)
        if name not in self._loaded:
            try:
                self._loaded[name] = load(name)
            except UserError as error:
                raise FileError(f"{entry.where}: {error}") from None
        return self._loaded[name]


@dataclass(slots=True)
class _Submission:
    """What one student answered to one problem."""

    exercise: Exercise
    name: str
    entries: dict[str, Entry] = field(default_factory=dict)

    def put(self, entry: Entry) -> None:
        """Take an answer in.

        Raises:
            FileError: the problem has no such part, or the part has been answered already.
        """
        label = self._label(entry)
        before = self.entries.setdefault(label, entry)
        if before is not entry:
            lines = "" if entry.line is None else f" (first in line {before.line})"
            whose = f" by {entry.student}" if entry.student else ""
            raise FileError(f"{entry.where}: {self.name} ({label}) is answered twice{whose}{lines}; keep one answer.")

    def _label(self, entry: Entry) -> str:
        labels = [part.label for part in self.exercise.parts]
        wanted = entry.part.strip(" ().").lower()
        if wanted in labels:
            return wanted
        if not wanted and len(labels) == 1:
            return labels[0]
        fault = f"there is no part {entry.part[:20]!r}" if wanted else "the part is missing"
        raise FileError(f"{entry.where}: {fault}; {self.name} has {', '.join(labels)}.")

    def parts(self) -> Iterator[MarkedPart]:
        """Every part, answered or not."""
        texts = {part.label: self._text(part) for part in self.exercise.parts if part.label in self.entries}
        graded = self.exercise.grade(texts)
        verdicts = {each.part: each.verdict for each in graded.parts}
        for part, given in zip(self.exercise.parts, graded.parts, strict=True):
            entry = self.entries.get(part.label)
            verdict = given.verdict
            diagnosis = None
            if verdict is not None and not given.accepted:
                found = self.exercise.diagnosed(part.label, texts[part.label], verdict, verdicts, IN_A_FILE)
                diagnosis = found if found.explains else None
            yield MarkedPart(
                problem=self.name,
                part=part.label,
                typed="" if entry is None else entry.text,
                read="" if verdict is None else verdict.read,
                verdict=MISSING if verdict is None else verdict.outcome.value,
                accepted=given.accepted,
                reason=_reason(verdict, diagnosis),
                score=Score(given.points, given.of),
                key=answer_kind(part.kind).write(self.exercise.solution.answers[part.label]),
                diagnosis=diagnosis,
                line=None if entry is None else entry.line,
            )

    def _text(self, part: Part) -> str:
        """What was typed for a part, with points for decimal commas where only so it can be read.

        The file has to allow it: its columns are parted by semicolons, and no answer in it has a decimal point.
        """
        entry = self.entries[part.label]
        pointed = _COMMA.sub(r"\1.\2", entry.text)
        if not entry.commas or pointed == entry.text or self._readable(part, entry.text):
            return entry.text
        return pointed if self._readable(part, pointed) else entry.text

    def _readable(self, part: Part, text: str) -> bool:
        problem = self.exercise.problem
        try:
            answer_kind(part.kind).read(text, problem.parameters, problem.given.terminal_states())
        except Unreadable:
            return False
        return True


def _reason(verdict: Verdict | None, diagnosis: Diagnosis | None) -> str:
    """What is said of an answer: what it comes from, where that is known."""
    if verdict is None:
        return "Not answered."
    return verdict.says if diagnosis is None else diagnosis.of(verdict)


def _students(entries: Sequence[Entry], problems: _Problems) -> Iterator[StudentReport]:
    students: dict[str, dict[str, _Submission]] = {}
    for entry in entries:
        exercise = problems.of(entry)
        name = exercise.id or os.path.normpath(entry.problem)
        submissions = students.setdefault(entry.student, {})
        submissions.setdefault(name, _Submission(exercise, name)).put(entry)
    for student, answered in students.items():
        yield StudentReport(student, tuple(part for submission in answered.values() for part in submission.parts()))


def _total(scores: Iterable[Score]) -> Score:
    every = tuple(scores)
    return Score(sum((score.points for score in every), Fraction(0)), sum(score.of for score in every))
