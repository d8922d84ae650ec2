"""Why an answer is wrong, in a sentence, and where in the working it went wrong."""

from collections.abc import Mapping, Sequence, Set
from contextlib import suppress
from functools import partial
from threading import Event, RLock, Thread
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from rldrill.background import in_background
from rldrill.misreading import misread_lines
from rldrill.possible import is_possible
from rldrill.problems.document import Equation
from rldrill.problems.notations import in_notation
from rldrill.render.differences import differences, marked
from rldrill.render.mathematics.unicode import unicode
from rldrill.render.sentences import in_letters
from rldrill.solutions.answers.judging import Outcome, Verdict, part_of, read_answer
from rldrill.solutions.answers.kinds import Cell, answer_kind
from rldrill.solutions.answers.rule import tolerance, within
from rldrill.solutions.answers.text import Reading
from rldrill.solutions.diagnosis.causes import Cause
from rldrill.solutions.diagnosis.clock import Clock
from rldrill.solutions.diagnosis.explaining import SURE_ENOUGH, Explained, explained
from rldrill.solutions.diagnosis.following import Line, Standing, follow
from rldrill.solutions.diagnosis.outcomes import Outcomes
from rldrill.solutions.diagnosis.replay import UNDONE, Application
from rldrill.solutions.diagnosis.saying import Words, place, saying
from rldrill.solutions.diagnosis.search import Search
from rldrill.solutions.diagnosis.typed import Typed, approximate, may_mean
from rldrill.solutions.exact import is_rational, parameters
from rldrill.solutions.formula.compiling import value_of
from rldrill.solutions.solution import Solution
from rldrill.solutions.work import Step

#: The time that there is for one answer at a prompt, in seconds.
AT_THE_PROMPT = 0.15
#: Before anything is searched ahead the prompt is shown, for which there are so many seconds.
_SHOWN = 0.05
#: What is close to the key is wrong where it is so sure that something likely was done, and no slip of arithmetic.
_SURE = 0.6
#: What is said whatever time there is (a verdict, lists of wrong answers) takes a search without a clock. In a working
#: of more applications than are drawn nobody waits for its end: what is close is close there, and only stated mistakes
#: are listed.
_LARGEST = 46
#: What is not written in a step: one that was left out or taken twice, a minimum, a quantity that was not asked for.
_NOT_WRITTEN = ("kept", "repeated", "min-for-max", "smallest", "another-quantity")
#: A decimal of more places than this is no rounded one.
_PLACES = 8


class Place(Struct, frozen=True):
    """Where in the working it went wrong.

    Args:
        formula: the key of the formula.
        step: the number of the step among all steps of the working, from 0; None where it is every one by that formula.
    """

    formula: str
    step: int | None


class Diagnosis(Struct, frozen=True):
    """What an answer comes from.

    Args:
        kind: ``right``, ``unreadable`` or ``unexplained``; ``listed`` for a typical mistake; else the
            name of what was done, such as ``factor-left-out``.
        sentence: one sentence to the person.
        place: where it was done; None where it was no step.
        alternatives: what else gives the same answer, as likely.
        confidence: how sure this is, 0 to 1; what it shares with the alternatives is how sure it is one of them.
        wrong: the step as it was taken, or the formula as it was read everywhere; ``right`` as it should be. What
            differs between the two is what ``rldrill.render.differences`` finds.
        mistake: the name of a typical mistake, ``forgot-gamma``; None for all else.
    """

    kind: str
    sentence: str
    place: Place | None = None
    alternatives: tuple["Diagnosis", ...] = ()
    confidence: float = 0.0
    wrong: Equation | None = None
    right: Equation | None = None
    mistake: str | None = None

    def __repr__(self) -> str:
        return f"<Diagnosis {self.kind}: {self.sentence}>"

    @property
    def explains(self) -> bool:
        """Whether it says anything that the verdict does not."""
        return self.kind not in ("right", "unreadable", "unexplained")

    def of(self, verdict: Verdict) -> str:
        """What is said of an answer that was judged so: which entries are wrong, and what they come from."""
        if self.sentence == verdict.says or verdict.outcome is Outcome.CLOSE or not verdict.wrong_cells:
            return self.sentence
        return f"{verdict.says} {self.sentence}"

    def without_lines(self) -> "Diagnosis":
        """The same without the step as it should be, which may hold the key."""
        return replace(
            self, wrong=None, right=None, alternatives=tuple(each.without_lines() for each in self.alternatives)
        )

    def to_json(self) -> dict[str, Any]:
        """The diagnosis as JSON has it."""
        where = None if self.place is None else {"formula": self.place.formula, "step": self.place.step}
        return {
            "kind": self.kind,
            "mistake": self.mistake,
            "sentence": self.sentence,
            "place": where,
            "confidence": self.confidence,
            "alternatives": [other.to_json() for other in self.alternatives],
        } | self._lines()

    def _lines(self) -> dict[str, Any]:
        """What was written and what is right, on a line each, and what differs in them."""
        if self.wrong is None or self.right is None:
            return {"yours": None, "right": None}
        found = differences(_line(self.wrong), _line(self.right))
        yours, right = (
            {
                "line": "".join(piece for piece, _ in pieces),
                "differs": [text for piece, differs in pieces if differs and (text := piece.strip())],
            }
            for pieces in found
        )
        return {"yours": yours, "right": right}


class WrongAnswer(Struct, frozen=True):
    """A wrong answer to a part, as it is typed, and what it comes from.

    ``lines`` is the step or formula as it was taken, and as it should be, where there is one; ``possible`` says whether
    the statement leaves room for the answer, and for those that come before it.
    """

    part: str
    answer: str
    kind: str
    sentence: str
    lines: tuple[Equation, Equation] | None = None
    possible: bool = True

    def __repr__(self) -> str:
        return f"<WrongAnswer ({self.part}) {self.answer}: {self.sentence}>"

    @property
    def read(self) -> Equation | None:
        """What was read otherwise, marked where it differs."""
        return None if self.lines is None else marked(*self.lines)


class Diagnosing:
    """Diagnoses the wrong answers to one problem; what is found out about the problem is kept."""

    def __init__(self, solution: Solution) -> None:
        self.solution = solution
        self._searches: dict[str, Search] = {}
        self._outcomes: dict[tuple[str, str], Outcomes] = {}
        self._stop = Event()
        self._thread: Thread | None = None
        self._one = RLock()  # of several threads that share an exercise one searches at a time

    def search(self, earlier: Mapping[str, Any]) -> Search:
        """The search that goes on from a person's own earlier answers."""
        key = _as_text(earlier)
        if key not in self._searches:
            self._searches[key] = Search(self.solution, earlier)
        return self._searches[key]

    def outcomes(self, label: str, earlier: Mapping[str, Any]) -> Outcomes:
        """What causes make of the answer to a part, for somebody who went on from own earlier answers."""
        search = self.search(earlier)
        key = label, _as_text(earlier)
        if key not in self._outcomes:
            part = part_of(self.solution, label)
            self._outcomes[key] = Outcomes(search, part, answer_kind(part.kind).cells(self.solution.answers[label]))
        return self._outcomes[key]

    def begin(self) -> None:
        """Search ahead, while the person types."""
        if self._thread is not None and self._thread.is_alive():
            return
        self._stop.clear()
        self._thread = in_background(self._ahead)

    def _ahead(self) -> None:
        if self._stop.wait(_SHOWN):
            return
        clock = Clock(stop=self._stop)
        every = [self.outcomes(part.label, {}) for part in self.solution.problem.parts]
        for outcomes in every:
            outcomes.grow(clock)
        for outcomes in every:
            outcomes.grow_pairs(clock)

    def finish(self) -> None:
        """Whatever was searched ahead is enough now."""
        if self._thread is not None:
            self._stop.set()
            self._thread.join()
            self._thread = None

    def unmasked(self, label: str, text: str, verdict: Verdict, settled: Mapping[str, Any] | None = None) -> Verdict:
        """The verdict itself; but what is close to the key by accident, since something is missing, is wrong."""
        if verdict.outcome is not Outcome.CLOSE or self._is_large() or self._rounded(label, text):
            return verdict
        self.finish()
        clock = Clock()  # a verdict depends on none
        with self._one:
            found = explained(self.outcomes(label, {}), self._typed(label, text), clock, settled)
        pairs = zip(found.causes, found.shares, strict=True)
        if sum(share for cause, share in pairs if cause.weight >= SURE_ENOUGH and not cause.anew) < _SURE:
            return verdict
        said = self.solution.problem.written(lambda: _told(found, self.search({}).applications))
        return replace(verdict, outcome=Outcome.WRONG, says=said.sentence)

    def _is_large(self) -> bool:
        """Whether the working is larger than any that is drawn; of a system of equations the square counts."""
        values = self.solution.work.values
        return len(values) + sum(len(value) ** 2 for value in values if isinstance(value, dict)) > _LARGEST

    def _nearly_rounded(self, label: str, text: str) -> bool:
        """Whether the wrong numbers are rounded ones whose last digit is one off, or that have too few digits."""
        typed = self._typed(label, text)
        return self._rounded(label, text) or all(
            _is_one_off(typed.cells[name], typed.key[name]) for name in typed.wrong
        )

    def _rounded(self, label: str, text: str) -> bool:
        """Whether the wrong numbers are right ones with fewer digits than are asked for."""
        typed = self._typed(label, text)
        return all(_is_shorter(typed.cells[name], typed.key[name]) for name in typed.wrong)

    def _typed(self, label: str, text: str) -> Typed:
        part = part_of(self.solution, label)
        key = answer_kind(part.kind).cells(self.solution.answers[label])
        return Typed(part, read_answer(self.solution, part, text), key)

    def wrong_answers(self, label: str, number: int) -> tuple["WrongAnswer", ...]:
        """Wrong answers to a part, the likeliest first, each with what it comes from.

        Of a working larger than any that is drawn only those that stated mistakes give: to find all takes too long.
        """
        with self._one:
            return self.solution.problem.written(lambda: self._wrong_answers(label, number))

    def _wrong_answers(self, label: str, number: int) -> tuple["WrongAnswer", ...]:
        search, outcomes = self.search({}), self.outcomes(label, {})
        kind, allowed = answer_kind(outcomes.part.kind), set(self.solution.problem.parameters)
        found: dict[str, WrongAnswer] = {}
        every = search.stated() if self._is_large() else search.whole(Clock())
        for candidate in sorted(every, key=lambda each: -each.cause.weight):
            if len(found) == number:
                break
            with suppress(*UNDONE):
                cells = outcomes.cells_of(candidate.answers)
                if _can_be_typed(cells, allowed) and self.solution.tells_apart({label: candidate.answers[label]}):
                    said = _diagnosis(candidate.cause, search.applications, 1.0)
                    text = kind.write(candidate.answers[label])
                    lines = self._lines(candidate.cause, said)
                    possible = is_possible(self.solution, label, candidate.answers)
                    found.setdefault(text, WrongAnswer(label, text, said.kind, said.sentence, lines, possible))
        return tuple(found.values())

    def _lines(self, cause: Cause, said: Diagnosis) -> tuple[Equation, Equation] | None:
        """The formula as it was read, and as it is."""
        if cause.mistake is not None:
            return misread_lines(self.solution, cause.mistake)
        return None if said.wrong is None or said.right is None else (said.wrong, said.right)

    def diagnose(
        self,
        label: str,
        text: str,
        verdict: Verdict,
        earlier: Mapping[str, Any] | None = None,
        seconds: float | None = None,
        settled: Mapping[str, Any] | None = None,
    ) -> Diagnosis:
        """What the answer to a part comes from.

        Args:
            label: the part.
            text: what was typed.
            verdict: how it was judged.
            earlier: the person's own wrong answers to earlier parts.
            seconds: the time to search; without end if None.
            settled: the earlier answers that were right, and so deny whatever would have spoilt them.
        """
        if verdict.outcome is Outcome.UNREADABLE:
            return Diagnosis("unreadable", verdict.says)
        if verdict.missing:
            return Diagnosis("unexplained", verdict.says)
        if verdict.accepted:
            return Diagnosis("right", verdict.says, confidence=1.0)
        if verdict.told and not earlier:
            return _listed(self.solution, verdict)
        if verdict.outcome is Outcome.CLOSE and self._nearly_rounded(label, text):
            return Diagnosis("unexplained", verdict.says)
        self.finish()
        typed = self._typed(label, text)
        clock = Clock(seconds)
        gone_on: list[dict[str, Any]] = [{}]
        if earlier and len(self.solution.following(earlier)) == len(self.solution.answers):  # from some not all follows
            gone_on.append(dict(earlier))
        for carried in gone_on:
            with self._one:
                found = explained(self.outcomes(label, carried), typed, clock, settled, None if carried else earlier)
            if found.made_before or (found.causes and not verdict.told):
                applications = self.search(carried).applications
                return self.solution.problem.written(partial(_told, found, applications))
        return _listed(self.solution, verdict) if verdict.told else Diagnosis("unexplained", verdict.says)


def _can_be_typed(cells: Mapping[str, Any] | None, allowed: Set[str]) -> bool:
    """Whether an answer has no letter in it but those that an answer may contain: not one that was to be found."""
    values = [] if cells is None else [value for value in cells.values() if not isinstance(value, str | tuple)]
    return bool(cells) and all(parameters(value) <= allowed for value in values)


def _as_text(earlier: Mapping[str, Any]) -> str:
    return str(sorted(earlier.items(), key=lambda item: item[0]))


def _is_shorter(cell: Cell, key: Any) -> bool:
    """Whether a number is the key, rounded or cut off where its own digits end."""
    if not isinstance(cell, Reading) or not is_rational(cell.value) or not may_mean(cell, key):
        return False
    places = next((places for places in range(_PLACES) if 10**places % int(cell.value.q) == 0), None)
    return places is not None and abs(approximate(cell.value) - approximate(key)) < 10.0**-places


def _is_one_off(cell: Cell, key: Any) -> bool:
    """Whether a decimal is the key, rounded to three digits, but for 1 in the last one."""
    if not isinstance(cell, Reading) or not cell.decimal or not is_rational(cell.value):
        return False
    unit = 2 * tolerance(key)
    return (cell.value / unit).q == 1 and within(cell.value, key, 3 * unit / 2)


def _listed(solution: Solution, verdict: Verdict) -> Diagnosis:
    first = verdict.told[0]
    formula = solution.misread(first)
    where = None if formula is None else Place(formula.key, None)
    wrong, right = misread_lines(solution, first) or (None, None)
    confidence = 1.0 if len(verdict.told) == 1 else 0.5
    return Diagnosis("listed", verdict.says, where, (), confidence, wrong, right, first.name)


def _told(found: Explained, applications: Sequence[Application]) -> Diagnosis:
    causes = found.causes
    first, *others = (
        _diagnosis(cause, applications, round(share, 2)) for cause, share in zip(causes, found.shares, strict=True)
    )
    said = _causes_told(causes, applications)
    said = f"It{said[2:]}" if causes[0].mistake is None else said  # α and γ stay small
    if left := causes[0].anew:
        said = f"This does not seem to go on from your answer to ({left}), which is right. {said}"
    return replace(first, sentence=said, alternatives=tuple(others))


def _causes_told(causes: Sequence[Cause], applications: Sequence[Application]) -> str:
    """What was done, or might have been: mistakes by what is right instead, all else by what it looks like."""
    looks = [_sentence(saying(cause, applications)) for cause in causes if cause.mistake is None]
    if looks and all(cause.application and cause.application.equation for cause in causes if cause.mistake is None):
        looks.append("there is a slip in solving the equations")
    told = [_stated(cause, applications) for cause in causes if cause.mistake is not None]
    if looks:
        told.insert(0 if causes[0].mistake is None else len(told), f"it looks as if {', or '.join(looks)}.")
    return " Or: ".join(told)


def _stated(cause: Cause, applications: Sequence[Application]) -> str:
    """What is said of a mistake, and where it was made, if it was made in one step alone of several."""
    assert cause.mistake is not None
    says = in_letters(cause.mistake.says)
    alike = [each for each in applications if each.formula is cause.formula]
    if cause.application is None or len(alike) < 2:
        return says
    return f"{says} It seems to have gone wrong{_sentence(place(cause.application, applications))}."


def _diagnosis(cause: Cause, applications: Sequence[Application], confidence: float) -> Diagnosis:
    if cause.mistake is not None:
        said = _stated(cause, applications)
        return Diagnosis("listed", said, _place(cause), confidence=confidence, mistake=cause.mistake.name)
    said = f"It looks as if {_sentence(saying(cause, applications))}."
    wrong, right = _compared(cause) or (None, None)
    return Diagnosis(cause.kind, said, _place(cause), (), confidence, wrong, right)


def _compared(cause: Cause) -> tuple[Equation, Equation] | None:
    """What was written and what is right: the step, where it was one, else the formula."""
    if cause.probe is not None or cause.term or cause.nth is not None or cause.kind in _NOT_WRITTEN:
        return None
    if cause.application is not None:
        step, known = cause.application.step, cause.application.known
        right = step.right if cause.edit is None else cause.edit.right
        with suppress(*UNDONE):
            value = value_of(right, known) if cause.became is None else cause.became
            return _short(step._replace(right=right, value=value)), _short(step)
    if cause.edit is not None and cause.formula is not None:
        return cause.formula.equation(cause.edit.right), cause.formula.equation(cause.formula.right)
    return None


def _short(step: Step) -> Equation:
    """A step with the numbers put in and its value, nothing between."""
    whole = step.equation()
    rights = whole.rights[:1] if len(whole.rights) == 1 else (whole.rights[0], whole.rights[-1])
    return replace(whole, rights=rights, signs=(whole.signs[0], "=")[: len(rights)])


def _line(equation: Equation) -> str:
    sides = zip(equation.signs, equation.rights, strict=True)
    return unicode(equation.left).strip() + "".join(f" {sign} {unicode(side).strip()}" for sign, side in sides)


def _place(cause: Cause) -> Place | None:
    if cause.application is not None:
        return Place(cause.application.formula.key, cause.application.nth)
    return None if cause.formula is None else Place(cause.formula.key, None)


def _sentence(words: Words) -> str:
    return "".join(word if isinstance(word, str) else unicode(in_notation(word)) for word in words)


class FollowedLine(Struct, frozen=True):
    """One line of somebody's own working.

    Args:
        text: what was written.
        standing: ``right``; ``follows`` from a line that departed; ``miscalculated`` where its own sides are not equal;
            ``departs`` from the working; ``short`` of digits; ``unread``.
        sentence: what is said of it; empty where all is well.
        step: the number of the step that it gives, among all steps of the working, from 0.
        kind: what it comes from, where it departs and that is known.
    """

    text: str
    standing: str
    sentence: str = ""
    step: int | None = None
    kind: str = ""


class Followed(Struct, frozen=True):
    """Somebody's own working, held against the right one; ``first`` is the number of the first line that departs."""

    lines: tuple[FollowedLine, ...]

    @property
    def first(self) -> int | None:
        """The number of the first line that goes wrong, from 0; None where none does."""
        wrong = (Standing.DEPARTS.value, Standing.MISCALCULATED.value)
        return next((number for number, line in enumerate(self.lines) if line.standing in wrong), None)

    @property
    def sentence(self) -> str:
        """What is said of the whole."""
        if self.first is not None:
            return self.lines[self.first].sentence
        if all(line.standing == Standing.UNREAD.value for line in self.lines):
            return "No line of this could be read; write lines such as “V1 = 8 + 1/2*4 = 10”."
        short = next((line.sentence for line in self.lines if line.standing == Standing.SHORT.value), "")
        unread = sum(line.standing == Standing.UNREAD.value for line in self.lines)
        if unread:
            were = "one line was" if unread == 1 else f"{unread} lines were"
            return f"{short} {were.capitalize()} not judged." if short else f"The rest is right; {were} not judged."
        return short or "All of this is right as far as it goes."


def followed(search: Search, texts: Sequence[str]) -> Followed:
    """Each line of a working, held against the right one."""
    return Followed(tuple(_followed(line, search.applications) for line in follow(search, texts)))


def _followed(line: Line, applications: Sequence[Application]) -> FollowedLine:
    step = None if line.application is None else line.application.nth
    where = "" if line.application is None else _sentence(place(line.application, applications))
    said, kind = "", ""
    if line.standing is Standing.SHORT:
        said = f"Right, but with too few digits{where}: go on with an exact value, or with three digits."
    elif line.standing is Standing.UNREAD:
        said = "This line was not understood, and is passed over."
    elif line.standing is Standing.MISCALCULATED:
        one, two = line.sides
        said, kind = f"{one.echo} is not {two.echo}: a slip of arithmetic{where}.", "arithmetic"
    elif line.standing is Standing.DEPARTS:
        said = f"Here the working goes wrong{where}."
        if line.causes:
            said, kind = f"Here it goes wrong: {_causes_told(line.causes, applications)}", line.causes[0].kind
    return FollowedLine(line.text, line.standing.value, said, step, kind)
