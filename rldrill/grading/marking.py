"""Marks what one student answered to one problem; the same answer to the same part is judged once."""

import re
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import cached_property, lru_cache
from pathlib import Path
from time import process_time
from typing import TYPE_CHECKING, Any, TypeAlias

from msgspec import Struct
from msgspec.structs import replace

from rldrill.diagnosis import Diagnosis
from rldrill.entries import by_name
from rldrill.exercise import Exercise, draw, load
from rldrill.files import shown
from rldrill.grading.answers_file import Entry, Refusal
from rldrill.grading.report import Judged, Score, missing
from rldrill.problems.notations import LECTURE, used
from rldrill.problems.parts import Part, Policy
from rldrill.solutions.answers.judging import Outcome, Verdict, credit, judge, read_answer
from rldrill.solutions.answers.kinds import Unreadable, answer_kind

if TYPE_CHECKING:
    from rldrill.exam.choices import Partial
    from rldrill.exam.exam import Exam

#: A problem: its ID, the path of its file, or the code of a version of the exam and a number in it, from 0.
Ref: TypeAlias = str | tuple[str, int]
#: The label of a part, what was typed, and the earlier answers that it may go on from.
_Typed: TypeAlias = tuple[str, str, tuple[tuple[str, str], ...]]
#: So many seconds of the processor are spent in all on what can be done wrongly in one problem, and in a whole run;
#: what is found by then is looked up. In four times as long hardly more of what students do is found.
SEARCH, ALL_SEARCHES = 1.0, 300.0
#: So many judgements are kept.
_KEPT = 50_000
#: So many problems that somebody names are kept, solved.
_PROBLEMS = 200
#: Entries that are the same in so many other draws are the same in every draw: of what varies, an entry may be so in
#: every second draw.
_OTHER_DRAWS = 16
_COMMA = re.compile(r"(?<![0-9.,])([0-9]+),([0-9]+)(?![0-9.]|,[0-9])")
_MONTH = (
    "(?:jan(?:uary?)?|feb(?:ruary?)?|m(?:[aä]r(?:ch|z)?|rz)|apr(?:il)?|ma[iy]|jun[ei]?|jul[iy]?|aug(?:ust)?|sep(?:t|tember)?|"
    "o[ck]t(?:ober)?|nov(?:ember)?|de[cz](?:ember)?)"
)
#: What a spreadsheet makes of 3/4: 3-Apr, 4-Mar, Apr-03, 03. Apr, 2024-04-03, 03.04.2024, 3/4/2024.
_DATE = re.compile(
    rf"\d{{1,2}}(?:\. ?|[- ]){_MONTH}(?:[- ]\d{{2,4}})?|{_MONTH}[- ]\d{{1,2}}|"
    r"(?:19|20)\d\d-\d\d-\d\d(?:[ T]00:00(?::00)?)?|\d{1,2}\.\d{1,2}\.(?:19|20)\d\d|\d{1,2}/\d{1,2}/(?:19|20)\d\d",
    re.IGNORECASE,
)
#: A word in it, such as the name of a month.
_WORD = re.compile(r"[^\W\d_]{3}")


class Rules(Struct, frozen=True):
    """How answers are marked.

    Args:
        partial: what wrong entries of a table or matrix cost: all of the part's points, or their share of them.
        repeated: which of several answers of a student to one part counts; "" refuses the later ones.
        causes: whether it is searched for what wrong answers come from.
        keys: whether the right answers are written.
        commas: whether the exam was written with decimal commas, so that answers may have them.
        notation: how its quantities are written, so that answers name them.
    """

    partial: str = "entries"
    repeated: str = ""
    causes: bool = True
    keys: bool = False
    commas: bool = False
    notation: str = LECTURE

    def of(self, exam: "Exam") -> "Rules":
        """The same with what an exam says itself."""
        commas = exam.head.decimal_mark == ","
        return replace(self, partial=exam.partial, commas=commas, notation=exam.layout.notation)


class Task(Struct, frozen=True):
    """What one student answered to one problem.

    Args:
        ref: the problem.
        name: what reports call it.
        entries: the answers.
    """

    ref: Ref
    name: str
    entries: tuple[Entry, ...]


class Marked(Struct, frozen=True):
    """The marks for a task: for every part its label, which entry answers it, and the judgement."""

    parts: tuple[tuple[str, Entry | None, Judged], ...]
    refused: tuple[Refusal, ...] = ()
    notes: tuple[str, ...] = ()


class Desk:
    """Where answers are marked: the problems, each loaded once, and what was judged.

    Args:
        manifest: of the exam; None without one.
        rules: how is marked.
    """

    def __init__(self, manifest: Path | None, rules: Rules) -> None:
        self._manifest, self._rules = manifest, rules
        self._problems: dict[Ref, Judging] = {}
        self._version = ""
        self._searches = _Time(ALL_SEARCHES)

    def problem(self, ref: Ref) -> "Judging":
        """A problem, solved.

        Raises:
            UserError: it does not exist or is broken.
        """
        if ref not in self._problems:
            self._make_room(ref)
            rules: Mapping[str, str] = {}
            if isinstance(ref, str):
                exercise = load(ref)
            else:
                code, number = ref
                exercise, rules = self._makes[code][number]()
            self._problems[ref] = Judging(exercise, self._rules, rules, self._searches)
        return self._problems[ref]

    def _make_room(self, ref: Ref) -> None:
        """Whose versions are marked one after the other, the last one's problems are not needed any more."""
        version = "" if isinstance(ref, str) else ref[0]
        if version != self._version or len(self._problems) >= _PROBLEMS:
            self._problems.clear()
        self._version = version

    @cached_property
    def _makes(self) -> "Mapping[str, tuple[Callable[[], tuple[Exercise, Mapping[str, Partial]]], ...]]":
        from rldrill.exam.manifest import read_problems

        assert self._manifest is not None, "a number in a version needs an exam"
        return read_problems(self._manifest)

    def mark(self, task: Task) -> Marked:
        """Mark every part of a problem, answered or not.

        Raises:
            UserError: the problem does not exist or is broken.
        """
        problem = self.problem(task.ref)
        taken: dict[str, Entry] = {}
        refused: list[Refusal] = []
        for entry in task.entries:
            says = self._take(entry, taken, problem, task.name)
            if says:
                refused.append(refusal(entry, says, task.name))
        with used(self._rules.notation):
            marks = tuple(problem.marks(taken))
        return Marked(marks, tuple(refused), problem.exercise.notes)

    def _take(self, entry: Entry, taken: dict[str, Entry], problem: "Judging", name: str) -> str:
        """Take an answer in; a sentence if it cannot be."""
        labels = [part.label for part in problem.exercise.parts]
        label = label_of(entry.part, labels)
        if label not in labels:
            fault = f"there is no part {entry.part[:20]!r}" if label else "the part is missing"
            return f"{fault}; {name} has {', '.join(labels)}."
        before = taken.get(label)
        if before is not None and not entry.text.strip():
            return ""
        if before is None or not before.text.strip() or self._rules.repeated == "last":
            taken[label] = entry
        elif not self._rules.repeated:
            whose = f" by {entry.student}" if entry.student else ""
            lines = "" if before.line is None else f" (first in line {before.line})"
            return f"{name} ({label}) is answered twice{whose}{lines}; the first answer counts, take out the other."
        return ""


def label_of(part: str, labels: Sequence[str]) -> str:
    """The label of a part as somebody wrote it; a part alone needs none."""
    label = part.strip(" ().").lower()
    return labels[0] if not label and len(labels) == 1 else label


def refusal(entry: Entry, says: str, problem: str) -> Refusal:
    """That an answer could not be graded, and why."""
    return Refusal(shown(entry.path), entry.line, entry.student, f"{entry.where}: {says}", problem=problem)


class _Time(Struct):
    """Seconds that are left."""

    left: float

    def spend(self, seconds: float) -> None:
        self.left = max(0.0, self.left - seconds)


class Judging:
    """A problem and the answers to it that were judged.

    Args:
        exercise: the problem.
        rules: how is marked.
        partial: for parts with a rule of their own for wrong entries, that rule.
        searches: the seconds that there are for all that is searched in a run.
    """

    def __init__(
        self, exercise: Exercise, rules: Rules, partial: Mapping[str, str], searches: _Time | None = None
    ) -> None:
        self.exercise, self._rules, self._partial = exercise, rules, partial
        self._verdicts: dict[_Typed, Verdict] = {}
        self._judged: dict[_Typed, Judged] = {}
        self._keys: dict[str, str] = {}
        self._times = (_Time(SEARCH), searches or _Time(ALL_SEARCHES))
        self._same: dict[str, frozenset[str]] = {}

    def marks(self, entries: Mapping[str, Entry]) -> list[tuple[str, Entry | None, Judged]]:
        """The judgement of every part."""
        result: list[tuple[str, Entry | None, Judged]] = []
        given: dict[str, tuple[str, Verdict]] = {}
        for part in self.exercise.parts:
            entry = entries.get(part.label)
            text = "" if entry is None else self.pointed(part, entry.text, commas=entry.commas)
            if entry is None or not text.strip():
                result.append((part.label, entry, missing(part.points, self._key(part))))
            elif entry.is_cell and self._is_date(part, text.strip()):
                result.append((part.label, entry, self._date(part, text)))
            else:
                verdict, judged = self._answer(part, text, given)
                result.append((part.label, entry, judged))
                if verdict.value is not None:  # the key is the key, however it was typed
                    given[part.label] = ("" if self._is_key(part.label, verdict.value) else text, verdict)
        return result

    def _answer(self, part: Part, text: str, carried: Mapping[str, tuple[str, Verdict]]) -> tuple[Verdict, Judged]:
        """The judgement of one answer, going on from those before."""
        if len(self._judged) > _KEPT:
            self._judged.clear()
            self._verdicts.clear()
        for earlier in ({}, carried):
            key = (part.label, text, tuple((label, typed) for label, (typed, _) in earlier.items()))
            if key not in self._verdicts:
                self._verdicts[key] = self._verdict(part.label, text, earlier)
            verdict = self._verdicts[key]
            if earlier is carried or verdict.outcome in (Outcome.RIGHT, Outcome.UNREADABLE):
                if key not in self._judged:
                    before = {label: each for label, (_, each) in earlier.items()}
                    self._judged[key] = self._told(part, text, verdict, before)
                break
        return verdict, self._judged[key]

    def _verdict(self, label: str, text: str, carried: Mapping[str, tuple[str, Verdict]]) -> Verdict:
        earlier = {other: verdict.value for other, (_, verdict) in carried.items()}
        verdict = judge(self.exercise.solution, label, text, earlier)
        verdicts = {other: each for other, (_, each) in carried.items()}
        return self.exercise.unmasked(label, text, {**verdicts, label: verdict})

    def _is_key(self, label: str, value: Any) -> bool:
        """Whether what somebody goes on from is the key itself, to the last digit: then nothing else follows."""
        try:
            return bool(value == self.exercise.solution.answers[label])
        except (TypeError, ValueError):
            return False

    def _told(self, part: Part, text: str, verdict: Verdict, before: Mapping[str, Verdict]) -> Judged:
        diagnosis = None
        if self._rules.causes and not verdict.accepted:
            found = self._diagnosed(part.label, text, verdict, before)
            diagnosis = found if found.explains else None
        reason = by_name(verdict.says if diagnosis is None else diagnosis.of(verdict), part.kind)
        mistake = "" if verdict.accepted or diagnosis is None else by_name(diagnosis.sentence, part.kind)
        score = Score(part.points * self._credit(part, verdict), part.points)
        outcome = verdict.outcome.value
        read = by_name(verdict.read, part.kind)
        return Judged(read, outcome, verdict.accepted, reason, score, self._key(part), diagnosis, mistake)

    def _diagnosed(self, label: str, text: str, verdict: Verdict, before: Mapping[str, Verdict]) -> Diagnosis:
        """What an answer comes from; with the step as it was taken and as it should be where keys are told, too."""
        begun = process_time()
        left = min(time.left for time in self._times)
        found = self.exercise.diagnosed(label, text, verdict, before, left)
        for time in self._times:
            time.spend(process_time() - begun)
        return found if self._rules.keys else found.without_lines()

    def _credit(self, part: Part, verdict: Verdict) -> Fraction:
        """The share of the points; an entry that is the same in every draw earns nothing."""
        if verdict.accepted or not verdict.credit:
            return verdict.credit
        if self._partial.get(part.label, self._rules.partial) == "all":
            return Fraction(0)
        same = self._same_everywhere(part)
        if not same:
            return verdict.credit
        cells = answer_kind(part.kind).cells(self.exercise.solution.answers[part.label])
        counted = [name for name in cells if name not in same or name in verdict.wrong_cells]
        kind = part.kind
        if isinstance(kind, Policy):
            kind = replace(kind, actions={name: kind.actions[name] for name in counted})
        return credit(kind, len(counted), len(verdict.wrong_cells))

    def _same_everywhere(self, part: Part) -> frozenset[str]:
        """The entries of a part whose right answer is the same in other draws: whoever knows the family knows them."""
        identity = self.exercise.problem.identity
        if identity is None:
            return frozenset()
        if part.label not in self._same:
            same = answer_kind(part.kind).cells(self.exercise.solution.answers[part.label])
            for seed in range(_OTHER_DRAWS):
                other = _drawn(identity.family, identity.level, seed).get(part.label, {})
                same = {name: content for name, content in same.items() if name in other and other[name] == content}
                if not same:
                    break
            self._same[part.label] = frozenset(same)
        return self._same[part.label]

    def _key(self, part: Part) -> str:
        if not self._rules.keys:
            return ""
        if part.label not in self._keys:
            self._keys[part.label] = answer_kind(part.kind).write(self.exercise.solution.answers[part.label])
        return self._keys[part.label]

    def _is_date(self, part: Part, text: str) -> bool:
        """Whether it is a date; a month may also be the name of a state, and then it can be read."""
        return bool(_DATE.fullmatch(text)) and not (_WORD.search(text) and self._readable(part, text))

    def _date(self, part: Part, text: str) -> Judged:
        says = (
            f"{text.strip()!r} is a date: a spreadsheet makes one of a fraction such as 3/4. "
            'Format the column as text, or type ="3/4".'
        )
        return self._nothing(part, Outcome.UNREADABLE.value, says)

    def _nothing(self, part: Part, verdict: str, reason: str) -> Judged:
        key = (part.label, reason, ((verdict, ""),))
        if key not in self._judged:
            self._judged[key] = Judged("", verdict, False, reason, Score(Fraction(0), part.points), self._key(part))
        return self._judged[key]

    def pointed(self, part: Part, text: str, *, commas: bool = False) -> str:
        """What was typed for a part, with points for decimal commas unless it can be read without.

        The exam has to be written with them, or the file has to allow it: its columns are parted by semicolons, and
        no answer in it has a decimal point.
        """
        if not (commas or self._rules.commas):
            return text
        pointed = _COMMA.sub(r"\1.\2", text)
        if pointed == text or self._readable(part, text):
            return text
        return pointed  # if it cannot be read so either, something else is to blame than the commas

    def _readable(self, part: Part, text: str) -> bool:
        try:
            read_answer(self.exercise.solution, part, text)
        except Unreadable:
            return False
        return True


@lru_cache(maxsize=20 * _OTHER_DRAWS)
def _drawn(family: str, level: int, seed: int) -> dict[str, dict[str, Any]]:
    """The entries of the right answer to every part of a draw."""
    exercise = draw(family, level, seed)
    answers = exercise.solution.answers
    return {part.label: answer_kind(part.kind).cells(answers[part.label]) for part in exercise.parts}
