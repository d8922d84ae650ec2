"""What happened in a quiz, part by part: plain data, without a clock or a terminal."""

import secrets
from collections.abc import Callable, Iterator
from enum import Enum
from fractions import Fraction
from itertools import takewhile
from typing import TYPE_CHECKING

from msgspec import Struct, field

from rldrill.exercise import Exercise
from rldrill.graded import GradedPart
from rldrill.misreading import said
from rldrill.problems.parts import Part, YesNo
from rldrill.quiz.mistakes import called

if TYPE_CHECKING:
    from rldrill.diagnosis import Diagnosis

#: What a wrong answer before, or a hint, takes from what the right answer earns, and what it leaves at least.
COSTS, LEAVES = Fraction(1, 4), Fraction(1, 4)


class State(Enum):
    """How a part stands."""

    OPEN = "open"
    DONE = "right"
    MISSED = "wrong"
    SKIPPED = "skipped"
    SHOWN = "working shown"


class Mistake(Struct, frozen=True):
    """What a wrong answer comes from: its name in the history, and words for it."""

    name: str
    says: str


class PartRecord(Struct):
    """One part: what was tried, and how it ended.

    ``made`` holds the mistakes that every answer comes from; ``before`` counts the tries before the problem was begun
    again; ``given_up`` says that its answer was seen then.
    """

    part: Part
    state: State = State.OPEN
    answers: list[GradedPart] = field(default_factory=list)
    hints: int = 0
    before: int = 0
    given_up: bool = False
    made: list[tuple[Mistake, ...]] = field(default_factory=list)

    @property
    def counted(self) -> list[GradedPart]:
        """The answers that count; what could not be read, or leaves entries out, does not."""
        return [answer for answer in self.answers if answer.verdict is not None and answer.verdict.counts]

    @property
    def tries(self) -> int:
        """How many answers counted."""
        return self.before + len(self.counted)

    @property
    def begun(self) -> bool:
        """Whether anything was answered, so that it counts, or skipped or looked up."""
        return self.state is not State.OPEN or bool(self.counted)

    @property
    def first_time(self) -> bool:
        """Whether it was right at the first try and without a hint."""
        return self.state is State.DONE and self.tries == 1 and not self.hints and not self.given_up

    @property
    def share(self) -> Fraction:
        """What an answer counts: a quarter less for each wrong one before and for each hint, but at least a quarter."""
        if self.given_up or self.state in (State.SKIPPED, State.SHOWN):
            return Fraction(0)
        return max(LEAVES, 1 - COSTS * (max(0, self.tries - 1) + self.hints))

    @property
    def points(self) -> Fraction:
        """The points earned: of the answer that was given last."""
        return self.counted[-1].points * self.share if self.counted else Fraction(0)

    def again(self) -> "PartRecord":
        """The part from its beginning; what was tried and seen is not forgotten."""
        seen = self.given_up or self.state not in (State.OPEN, State.DONE)
        return PartRecord(self.part, hints=self.hints, before=self.tries, given_up=seen)


class Record(Struct):
    """One problem of a session; ``sitting`` is its name in the history."""

    exercise: Exercise
    parts: list[PartRecord]
    sitting: str = field(default_factory=lambda: secrets.token_hex(8))

    @classmethod
    def of(cls, exercise: Exercise) -> "Record":
        """A fresh record of an exercise."""
        return cls(exercise, [PartRecord(part) for part in exercise.parts])

    def again(self) -> "Record":
        """The problem from its beginning."""
        return Record(self.exercise, [part.again() for part in self.parts], self.sitting)

    @property
    def begun(self) -> bool:
        """Whether anything was answered, skipped or looked up, now or before the problem was begun again."""
        return any(part.begun or part.before or part.given_up for part in self.parts)

    def answer(self, current: PartRecord, text: str) -> GradedPart:
        """Grade an answer to a part, going on from what was answered last to the parts before, and keep it."""
        before = takewhile(lambda record: record is not current, self.parts)
        texts = {record.part.label: record.counted[-1].typed for record in before if record.counted}
        graded = self.exercise.grade({**texts, current.part.label: text})[current.part.label]
        current.answers.append(graded)
        current.made.append(self._mistakes(current, graded))
        if graded.accepted:
            current.state = State.DONE
        elif isinstance(current.part.kind, YesNo) and current.counted[-1:] == [graded]:
            current.state = State.MISSED  # there is only one other answer
        return graded

    def _mistakes(self, current: PartRecord, graded: GradedPart) -> tuple[Mistake, ...]:
        """The typical mistakes that give the answer; else the kind of cause that is found for it."""
        if graded.verdict is None or graded.accepted:
            return ()
        if graded.verdict.told:
            solution = self.exercise.solution
            return tuple(Mistake(mistake.name, said(solution, mistake)) for mistake in graded.verdict.told)
        found = self.diagnosis(current)
        if found is None or not found.explains:
            return ()
        if found.mistake is not None:
            return (Mistake(found.mistake, found.sentence),)
        title = self.exercise.problem.family.title
        return (Mistake(found.kind, f"{title}: {called(found.kind)}."),)

    def diagnosis(self, current: PartRecord) -> "Diagnosis | None":
        """What the last answer to a part comes from, if it counts and is wrong."""
        from rldrill import diagnosis

        answered = {record.part.label: record.counted[-1] for record in self.parts if record.counted}
        last = answered.get(current.part.label)
        if last is None or last.verdict is None or last.accepted or last is not current.answers[-1]:
            return None
        verdicts = {label: graded.verdict for label, graded in answered.items()}
        return self.exercise.diagnosed(last.part, last.typed, last.verdict, verdicts, diagnosis.AT_THE_PROMPT)


class Session(Struct):
    """A whole quiz.

    Args:
        total: how many problems there will be; None if the time decides.
        records: the problems so far.
        minutes: how long it lasts, where the time decides.
        again: the command for another day.
        drilled: the mistake that is drilled, if one is.
        more: more problems of the same, where they are not those of the weakest skill.
    """

    total: int | None
    records: list[Record] = field(default_factory=list)
    minutes: int | None = None
    again: str = "rldrill quiz"
    drilled: str = ""
    more: Callable[[], Iterator[Exercise]] | None = None

    @property
    def parts(self) -> list[PartRecord]:
        """The parts of all problems that were begun."""
        return [part for record in self.records if record.begun for part in record.parts]
