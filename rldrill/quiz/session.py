"""What happened in a quiz, part by part: plain data, without a clock or a terminal."""

from dataclasses import dataclass, field
from enum import Enum
from fractions import Fraction
from itertools import takewhile

from rldrill.diagnosis import AT_THE_PROMPT, Diagnosis
from rldrill.exercise import Exercise
from rldrill.graded import GradedPart
from rldrill.problems.parts import Part
from rldrill.solutions.answers.judging import Outcome


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
    answers: list[GradedPart] = field(default_factory=list)
    hinted: bool = False

    @property
    def counted(self) -> list[GradedPart]:
        """The answers that count; what could not be read does not."""
        return [answer for answer in self.answers if answer.outcome not in (None, Outcome.UNREADABLE)]

    @property
    def tries(self) -> int:
        """How many answers counted."""
        return len(self.counted)

    @property
    def first_time(self) -> bool:
        """Whether it was right at the first try and without a hint."""
        return self.state is State.DONE and self.tries == 1 and not self.hinted

    @property
    def points(self) -> Fraction:
        """The points earned: of the answer that was given last."""
        return self.counted[-1].points if self.tries else Fraction(0)


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
        return any(record.state is not State.OPEN or record.answers for record in self.parts)

    def answer(self, current: PartRecord, text: str) -> GradedPart:
        """Grade an answer to a part, going on from what was answered last to the parts before, and keep it."""
        before = takewhile(lambda record: record is not current, self.parts)
        texts = {record.part.label: record.counted[-1].typed for record in before if record.tries}
        graded = self.exercise.grade({**texts, current.part.label: text})[current.part.label]
        current.answers.append(graded)
        if graded.accepted:
            current.state = State.DONE
        return graded

    def diagnosis(self, current: PartRecord) -> Diagnosis | None:
        """What the last answer to a part comes from, if it counts and is wrong."""
        answered = {record.part.label: record.counted[-1] for record in self.parts if record.tries}
        last = answered.get(current.part.label)
        if last is None or last.verdict is None or last.accepted or last is not current.answers[-1]:
            return None
        verdicts = {label: graded.verdict for label, graded in answered.items()}
        return self.exercise.diagnosed(last.part, last.typed, last.verdict, verdicts, AT_THE_PROMPT)


@dataclass
class Session:
    """A whole quiz."""

    total: int
    records: list[Record] = field(default_factory=list)

    @property
    def parts(self) -> list[PartRecord]:
        """The parts of all problems that were begun."""
        return [part for record in self.records if record.begun for part in record.parts]
