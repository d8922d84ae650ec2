"""What happened in a quiz, part by part: plain data, without a clock or a terminal."""

from dataclasses import dataclass, field
from enum import Enum
from fractions import Fraction
from typing import Any

from rldrill.exercise import Exercise
from rldrill.problems.parts import Part
from rldrill.solutions.answers.judging import Outcome, Verdict


class State(Enum):
    """How a part stands."""

    OPEN = "open"
    DONE = "right"
    SKIPPED = "skipped"
    SHOWN = "working shown"


@dataclass
class PartRecord:
    """One part: what was tried, and how it ended."""

    part: Part
    state: State = State.OPEN
    verdicts: list[Verdict] = field(default_factory=list)
    hinted: bool = False

    @property
    def tries(self) -> int:
        """How many answers counted; what could not be read did not."""
        return sum(verdict.outcome is not Outcome.UNREADABLE for verdict in self.verdicts)

    @property
    def first_time(self) -> bool:
        """Whether it was right at the first try and without a hint."""
        return self.state is State.DONE and self.tries == 1 and not self.hinted

    @property
    def points(self) -> Fraction:
        """The points earned: of the answer that was given last."""
        counted = [verdict for verdict in self.verdicts if verdict.outcome is not Outcome.UNREADABLE]
        return self.part.points * counted[-1].credit if counted else Fraction(0)


@dataclass
class Record:
    """One problem of a session."""

    exercise: Exercise
    parts: list[PartRecord]

    @classmethod
    def of(cls, exercise: Exercise) -> "Record":
        """A fresh record of an exercise."""
        return cls(exercise, [PartRecord(part) for part in exercise.parts])

    @property
    def begun(self) -> bool:
        """Whether anything was answered, skipped or looked up."""
        return any(record.state is not State.OPEN or record.verdicts for record in self.parts)

    def answer(self, current: PartRecord, text: str) -> Verdict:
        """Judge an answer to a part, going on from what was answered before, and keep the verdict."""
        earlier: dict[str, Any] = {}
        for record in self.parts:
            if record is current:
                break
            values = [verdict.value for verdict in record.verdicts if verdict.value is not None]
            if values:
                earlier[record.part.label] = values[-1]
        verdict = self.exercise.check(text, current.part.label, earlier)
        current.verdicts.append(verdict)
        if verdict.accepted:
            current.state = State.DONE
        return verdict


@dataclass
class Session:
    """A whole quiz."""

    total: int
    records: list[Record] = field(default_factory=list)

    @property
    def parts(self) -> list[PartRecord]:
        """The parts of all problems that were begun."""
        return [part for record in self.records if record.begun for part in record.parts]
