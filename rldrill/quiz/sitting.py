"""Sitting an exam: what was typed so far, kept as a file of answers that 'verify' grades; nothing is judged before."""

import json
import re
from collections.abc import Iterator, Sequence
from datetime import datetime, timedelta
from itertools import count
from pathlib import Path

from msgspec import Struct, field

from rldrill.exam.exam import Exam, Version
from rldrill.exercise import Exercise
from rldrill.files import decoded, parse, shown
from rldrill.grading.answers_file import WHO, Entry
from rldrill.grading.marking import Judging, Rules, label_of
from rldrill.grading.report import MarkedPart, Score, total
from rldrill.problems.errors import FileError, UsageError
from rldrill.problems.parts import Part
from rldrill.spreadsheet import meant
from rldrill.typed import typed
from rldrill.writing import alone, write_bytes_atomically

_BEGUN, _HANDED_IN = "# begun: ", "# handed in: "
_MOMENT = re.compile(rf"^(?:{_BEGUN}|{_HANDED_IN})(\S+)$", re.MULTILINE)


class Place(Struct, frozen=True):
    """A part of a problem: the index of the problem, and of the part in it."""

    problem: int
    part: int


class Sitting(Struct):
    """One version of an exam, and what somebody has typed.

    Args:
        exam: the exam.
        version: the version that is sat.
        path: the file of answers, to be written after every answer.
        begun: when it began.
        manifest: the exam as a file, by which the answers are graded; None where it is nowhere.
        answers: what was typed, by place.
        handed_in: when it was handed in, if it was.

    Who sits it is kept as the file says it, for ``verify``.
    """

    exam: Exam
    version: Version
    path: Path
    begun: datetime
    manifest: Path | None = None
    answers: dict[Place, str] = field(default_factory=dict)
    handed_in: datetime | None = None
    _who: dict[str, str] = field(default_factory=dict)
    _kept: str | None = None
    _changed: set[Place] = field(default_factory=set)

    @property
    def places(self) -> tuple[Place, ...]:
        """All parts of all problems, in order."""
        return tuple(
            Place(problem, part)
            for problem, exercise in enumerate(self.version.exercises)
            for part in range(len(exercise.parts))
        )

    def exercise(self, place: Place) -> Exercise:
        """The problem at a place."""
        return self.version.exercises[place.problem]

    def part(self, place: Place) -> Part:
        """The part at a place."""
        return self.exercise(place).parts[place.part]

    @property
    def end(self) -> datetime | None:
        """When time is up; None where the exam has no duration."""
        duration = self.exam.head.duration
        return None if duration is None else self.begun + timedelta(minutes=duration)

    def left(self, now: datetime) -> timedelta | None:
        """How much time there is still."""
        return None if self.end is None else max(timedelta(0), self.end - now)

    def answer(self, place: Place, text: str) -> None:
        """Take in what was typed; an empty text takes the answer back."""
        self._changed.add(place)
        if text.strip():
            # What no text holds (half a pair of surrogates, pasted) cannot be in the file, and must not count.
            self.answers[place] = text.encode("utf-8", "replace").decode("utf-8")
        else:
            self.answers.pop(place, None)

    def save(self) -> Path | None:
        """Write the file of answers, whole or not at all; what another terminal wrote there meanwhile stays.

        Returns:
            Where a copy lies of what somebody wrote there that cannot be read.

        Raises:
            OSError: it cannot be written.
        """
        with alone(self.path):
            aside = self._take_in_others()
            text = self._written()
            write_bytes_atomically(self.path, text.encode())
        self._kept = text
        self._changed.clear()
        return aside

    def _written(self) -> str:
        lines = [f"# {' '.join(self.exam.head.title.split())}, version {self.version.code}"]
        lines.append(f"{_BEGUN}{self.begun.isoformat()}")
        if self.handed_in is not None:
            lines.append(f"{_HANDED_IN}{self.handed_in.isoformat()}")
        lines += [f"{key} = {_quoted(name)}" for key, name in self._who.items()]
        for number, exercise in enumerate(self.version.exercises):
            lines.append(f"\n[{_quoted(self._name(number))}]")
            lines += [
                f"{part.label} = {_quoted(text)}"
                for index, part in enumerate(exercise.parts)
                if (text := self.answers.get(Place(number, index))) is not None
            ]
        return "\n".join(lines) + "\n"

    def _take_in_others(self) -> Path | None:
        """Take in what was written there since this one last did; of one part the later answer stays.

        Returns:
            Where a copy of it lies, if it cannot be read: nobody's answers may be lost over that.
        """
        if not self.path.exists():
            return None
        mine = {place: self.answers.get(place) for place in self._changed}
        try:
            if (text := self._text()) == self._kept:
                return None
            self._take_in(text)
        except FileError:
            names = (self.path.with_name(f"{self.path.name}.{number}") for number in count(1))
            aside = next(name for name in names if not name.exists())
            write_bytes_atomically(aside, self.path.read_bytes())
            return aside
        if self.handed_in is None:
            self.answers = {place: text for place, text in (self.answers | mine).items() if text is not None}
        return None

    def _name(self, problem: int) -> str:
        """What the file calls a problem: its ID, or its number where it has none that is its own."""
        name = self.version.exercises[problem].id
        is_alone = [exercise.id for exercise in self.version.exercises].count(name) == 1
        return name if name and is_alone else str(problem + 1)

    def resume(self) -> None:
        """Take in what the file holds already.

        Raises:
            FileError: it is not the file of a sitting of this version.
        """
        self._take_in(text := self._text())
        self._kept = text

    def _text(self) -> str:
        return decoded(self.path.read_bytes(), shown(self.path))

    def _no_sitting(self) -> FileError:
        return FileError(f"{self.path} is not the file of a sitting; name another with --answers.")

    def _take_in(self, text: str) -> None:
        moments = [_moment(found) for found in _MOMENT.findall(text)]
        if not moments or None in moments or not isinstance(data := parse(text, self.path), dict):
            raise self._no_sitting()
        fields = {key: field for key, field in zip(data, meant([*data]), strict=True) if field in WHO}
        for key in fields:
            name = data[key]
            if isinstance(name, bool) or not isinstance(name, str | int):
                raise FileError(f"{self.path}: '{key}' must be a text; write it in quotes.")
        numbers = {self._name(number): number for number in range(len(self.version.exercises))}
        numbers = {str(number + 1): number for number in numbers.values()} | numbers
        if not data.keys() - fields.keys() <= numbers.keys():
            raise FileError(f"{self.path} holds answers to other problems; name another file with --answers.")
        problems = [(numbers[name], parts) for name, parts in data.items() if name not in fields]
        answers = {place: text for number, parts in problems for place, text in self._found(number, parts)}
        self._who = {field: str(data[key]) for key, field in fields.items()}
        self.begun = moments[0] or self.begun
        self.handed_in = moments[1] if _HANDED_IN in text and len(moments) > 1 else None
        self.answers = answers

    def _found(self, problem: int, answers: object) -> Iterator[tuple[Place, str]]:
        """The answers to a problem that the file holds; somebody may have written them as ``verify`` reads them."""
        labels = [part.label for part in self.version.exercises[problem].parts]
        for part, answer in answers.items() if isinstance(answers, dict) else [("", answers)]:
            try:
                yield Place(problem, labels.index(label_of(part, labels))), typed(answer, part)
            except (ValueError, UsageError):
                raise self._no_sitting() from None

    def pointed(self, place: Place, text: str) -> str:
        """What was typed as it is read: with points for decimal commas, where the exam has these."""
        return self._judging(place.problem).pointed(self.part(place), text)

    def graded(self) -> tuple[tuple[MarkedPart, ...], ...]:
        """The judgement of every part, problem by problem, as ``rldrill verify`` gives it."""
        return tuple(self._graded(number) for number in range(len(self.version.exercises)))

    def _graded(self, number: int) -> tuple[MarkedPart, ...]:
        judging, name = self._judging(number), self._name(number)
        entries = {
            part.label: Entry("", name, part.label, text, None, self.path)
            for index, part in enumerate(judging.exercise.parts)
            if (text := self.answers.get(Place(number, index))) is not None
        }
        return tuple(
            MarkedPart(name, label, "" if entry is None else entry.text, judged)
            for label, entry, judged in judging.marks(entries)
        )

    def _judging(self, number: int) -> Judging:
        return Judging(self.version.exercises[number], Rules().of(self.exam), self.version.rules(number))


def version_of(exam: Exam, code: str | None) -> Version:
    """The version with a code; the first, if none is given.

    Raises:
        UsageError: there is none.
    """
    if code is None:
        return exam.versions[0]
    for version in exam.versions:
        if version.code.lower() == code.strip().lower():
            return version
    raise UsageError(
        f"The exam has no version {code[:20]!r}; it has {', '.join(version.code for version in exam.versions)[:100]}."
    )


def by_topic(sitting: Sitting, graded: Sequence[Sequence[MarkedPart]]) -> dict[str, Score]:
    """Points reached, and to be had, topic by topic."""
    found: dict[str, list[Score]] = {}
    for exercise, parts in zip(sitting.version.exercises, graded, strict=True):
        found.setdefault(exercise.problem.family.topic.replace("_", "-"), []).extend(part.score for part in parts)
    return {topic: total(scores) for topic, scores in found.items()}


def _quoted(text: str) -> str:
    """A text as TOML has it, which is as JSON has it but for one control character."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _moment(text: str) -> datetime | None:
    try:
        moment = datetime.fromisoformat(text)
    except ValueError:
        return None
    return moment if moment.tzinfo else None
