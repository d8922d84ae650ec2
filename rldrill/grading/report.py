"""What comes out of grading: points and verdicts for every student, and what could not be graded."""

from collections.abc import Iterable, Mapping
from fractions import Fraction
from functools import lru_cache
from typing import Any

from msgspec import Struct, field

from rldrill.diagnosis import Diagnosis
from rldrill.grading.answers_file import Refusal, placed
from rldrill.problems.errors import FileError, NothingToGrade

#: The version of the JSON that ``Report.to_json`` gives.
FORMAT = 2
#: The verdicts on a part that was not answered, and on one that could not be graded; all others are of ``Outcome``.
MISSING = "missing"
NOT_GRADED = "not graded"
#: What is said of somebody on the roster without any answers.
NOTHING = "handed in nothing"
EMPTY = "handed in, without an answer"
#: The same of those whose file could not be read; and where it is not known whose file that was.
UNREAD, PERHAPS = "handed in, could not be read", "nothing was read; perhaps one of the files that could not be read"
ELSEWHERE = "nothing was found under this name; perhaps it is under one that is not on the roster"
#: No number that is shown has as many digits.
_FLOAT = 16
#: How much of the judgement a report tells, the least first.
FEEDBACK = ("none", "verdict", "reason", "key")


class Score(Struct, frozen=True):
    """Points earned, of how many."""

    points: Fraction
    of: int

    def to_json(self) -> dict[str, Any]:
        """The score as JSON has it: the points exactly and as a decimal."""
        return {"exact": str(self.points), "decimal": f"{float(self.points):.6g}", "of": self.of}

    @property
    def share(self) -> Fraction:
        """The share of the points that was earned; all of nothing is nothing."""
        return self.points / self.of if self.of else Fraction(0)

    def percent(self, digits: int = 3) -> str:
        """The share in percent; with more digits where these would make a whole number of what is none.

        Who needs 60 % and has 59.97 % has not enough, and shall see it.
        """
        share, text = 100 * self.share, ""
        for number in range(digits, _FLOAT):
            text = f"{float(share):.{number}g}"
            if share.denominator == 1 or Fraction(text).denominator > 1:
                break
        return text

    def scaled(self, of: int) -> "Score":
        """The same share of another total."""
        return Score(self.share * of, of)


class Judged(Struct, frozen=True):
    """What is found out about one answer; the same answer to the same part is judged once.

    Args:
        read: how it was read; empty if it was not.
        verdict: a value of ``Outcome``, ``missing`` or ``not graded``.
        accepted: whether the part is right, or follows rightly from an earlier answer.
        reason: one or two sentences to the person.
        score: what the answer earns, and what a right one would.
        key: the right answer, as it would be typed; empty where nobody asks for it.
        diagnosis: what a wrong answer comes from; None where there is nothing to explain.
        mistake: what the class's report counts: the sentence of the mistake, or nothing.
    """

    read: str
    verdict: str
    accepted: bool
    reason: str
    score: Score
    key: str
    diagnosis: Diagnosis | None = None
    mistake: str = ""


@lru_cache(maxsize=1000)
def missing(of: int, key: str = "") -> Judged:
    """What is said of a part of so many points that was not answered."""
    return Judged("", MISSING, False, "Not answered.", Score(Fraction(0), of), key)


class MarkedPart(Struct, frozen=True):
    """The judgement of one part of one problem.

    Args:
        problem: the problem's ID with its revision, or its file as the answers name it.
        part: the label of the part.
        typed: what was typed.
        judged: what was found out about it.
        path: the file of answers; empty for what was not answered.
        line: the line of the file.
        column: the field of the line in a spreadsheet, else the sign where the answer begins.
        slot: the problem's place in the blueprint, which versions have in common, from 1; 0 without an exam.
    """

    problem: str
    part: str
    typed: str
    judged: Judged
    path: str = ""
    line: int | None = None
    column: int | None = None
    slot: int = 0

    @property
    def score(self) -> Score:
        """What it earns, of how much."""
        return self.judged.score

    @property
    def place(self) -> str:
        """Where the answer stands; empty for what was not answered."""
        return placed(self.path, self.line, self.column) if self.path else ""

    @property
    def name(self) -> str:
        """What the class calls it: the place in the exam, which versions share, or the problem."""
        return f"{self.slot or self.problem} ({self.part})"

    def to_json(self, feedback: str = "reason") -> dict[str, Any]:
        """The part as JSON has it."""
        judged = self.judged
        data: dict[str, Any] = {"problem": self.problem, "part": self.part, "slot": self.slot or None}
        data |= {"file": self.path or None, "line": self.line, "column": self.column, "typed": self.typed}
        data["points"] = judged.score.to_json()
        if feedback in FEEDBACK[1:]:
            data |= {"verdict": judged.verdict, "accepted": judged.accepted, "read": judged.read}
        if feedback in FEEDBACK[2:]:
            diagnosis = None if judged.diagnosis is None else judged.diagnosis.to_json()
            data |= {"reason": judged.reason, "diagnosis": diagnosis}
        return data | ({"key": judged.key} if feedback == FEEDBACK[3] else {})


class StudentReport(Struct, frozen=True):
    """The answers of one student; the name is empty where the files give none.

    Args:
        student: the name, or the matriculation number where there is no name.
        number: the matriculation number, where it is known.
        version: the version of the exam; empty without one.
        paths: the files that hold the answers, as they are shown; none for somebody who handed in nothing.
        parts: every part of every problem.
        extra: problems that were answered and are not in this student's exam, with why they earn nothing; and what else
            somebody should look at.
        others: their other hand-ins, which do not count.
        unread: where nothing was read of them, what is known of the reason.
    """

    student: str
    parts: tuple[MarkedPart, ...]
    number: str = ""
    version: str = ""
    paths: tuple[str, ...] = ()
    extra: tuple[str, ...] = ()
    others: tuple[str, ...] = ()
    unread: str = ""

    @property
    def remark(self) -> str:
        """What a list of students says beside the points: that somebody handed in nothing, or more than once."""
        if not self.paths:
            return self.unread or NOTHING
        return f"1 of {len(self.others) + 1} hand-ins" if self.others else ""

    @property
    def score(self) -> Score:
        """The points of all parts."""
        return total(part.score for part in self.parts)

    def to_json(self, feedback: str = "reason") -> dict[str, Any]:
        """The student as JSON has it."""
        return {
            "student": self.student,
            "number": self.number or None,
            "version": self.version or None,
            "files": list(self.paths),
            "other_files": list(self.others),
            "handed_in": bool(self.paths) or self.unread in (UNREAD, EMPTY),
            "points": self.score.to_json(),
            "answers": [part.to_json(feedback) for part in self.parts],
            "not_marked": list(self.extra),
        }


class Report(Struct, frozen=True):
    """The judgement of some files.

    Args:
        students: those who answered.
        refused: what could not be graded.
        notes: by problem file, what was read in it otherwise than it is written, such as 0.3333333333333333 as 1/3.
        title: of the exam; empty without one.
        needed: the share of the points that every student must reach; without it every part must be right.
        scale: as how many points the exam tells its whole; None for its own.
    """

    students: tuple[StudentReport, ...]
    refused: tuple[Refusal, ...] = ()
    notes: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    title: str = ""
    needed: Fraction | None = None
    scale: int | None = None

    @property
    def parts(self) -> tuple[MarkedPart, ...]:
        """The parts of all students."""
        return tuple(part for student in self.students for part in student.parts)

    @property
    def score(self) -> Score:
        """The points of all students."""
        return total(student.score for student in self.students)

    @property
    def exit_code(self) -> int:
        """0 all right, or enough of it; 1 not; 3 something could not be graded; 4 no file held an answer."""
        codes = {refusal.exit_code for refusal in self.refused}
        if FileError.exit_code in codes:
            return FileError.exit_code
        if not self.students:
            return NothingToGrade.exit_code
        return int(bool(codes) or not all(map(self.passed, self.students)))

    def passed(self, student: StudentReport) -> bool:
        """Whether a student has enough points, or all right that counts where nobody says how many are enough."""
        if self.needed is None:
            return all(part.judged.accepted for part in student.parts if part.score.of)
        return student.score.share >= self.needed

    def scaled(self, student: StudentReport) -> Score | None:
        """A student's points on the exam's scale, if it has one."""
        return None if self.scale is None else student.score.scaled(self.scale)

    def student_to_json(self, student: StudentReport, feedback: str = "reason") -> dict[str, Any]:
        """One student as JSON has it, with what the exam makes of the points."""
        scaled = self.scaled(student)
        more = {"scaled": scaled and scaled.to_json(), "passed": self.passed(student)}
        return student.to_json(feedback) | more

    def to_json(self, feedback: str = "reason") -> dict[str, Any]:
        """The report as versioned JSON; the right answers are in it only if they are asked for."""
        return self.frame() | {"students": [self.student_to_json(student, feedback) for student in self.students]}

    def frame(self) -> dict[str, Any]:
        """The same without the students."""
        return {
            "format": FORMAT,
            "title": self.title or None,
            "students": [],
            "refused": [
                {
                    "file": refusal.path,
                    "line": refusal.line,
                    "student": refusal.student or None,
                    "problem": refusal.problem or None,
                    "says": refusal.says,
                    "exit_code": refusal.exit_code,
                }
                for refusal in self.refused
            ],
            "notes": {problem: list(notes) for problem, notes in self.notes.items()},
            "points": self.score.to_json(),
            "exit_code": self.exit_code,
        }


def total(scores: Iterable[Score]) -> Score:
    """The sum of some scores."""
    every = tuple(scores)
    return Score(sum((score.points for score in every), Fraction(0)), sum(score.of for score in every))
