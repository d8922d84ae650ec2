"""Somebody's own working, line by line, held against the right one."""

import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from enum import Enum
from itertools import pairwise, product, starmap
from math import prod
from typing import Any

from msgspec import Struct
from msgspec.structs import replace
from sympy import preorder_traversal

from rldrill.problems.notation import FUNCTIONS
from rldrill.solutions.answers.rule import is_close, is_right, is_short
from rldrill.solutions.answers.text import Reading, Unreadable, read_number
from rldrill.solutions.diagnosis.alternatives import LIKELY, at_one, numbers, of_numbers, plain, value_or_none
from rldrill.solutions.diagnosis.asked_for import asked_letters, called, numbers_of
from rldrill.solutions.diagnosis.causes import Cause
from rldrill.solutions.diagnosis.entries import Entries, Reader
from rldrill.solutions.diagnosis.meant_names import Names
from rldrill.solutions.diagnosis.on_the_way import Place, lines, places, worked_out
from rldrill.solutions.diagnosis.replay import UNDONE, Application, Change, Traced
from rldrill.solutions.diagnosis.saying import saying
from rldrill.solutions.diagnosis.search import Search
from rldrill.solutions.diagnosis.typed import approximate, near
from rldrill.solutions.diagnosis.written_line import (
    Numbers,
    apart,
    by_the_numbers,
    numbers_in,
    numbers_typed,
    put_in_otherwise,
    told_by,
)
from rldrill.solutions.diagnosis.written_names import (
    names,
    parts_with_letters,
    plain_name,
    spelled,
)
from rldrill.solutions.exact import NotReal, is_rational, parameters, value_where
from rldrill.solutions.formula.notation import Quantity
from rldrill.solutions.rational import generator, linear
from rldrill.solutions.work import Equality, Step, Work

#: Signs between the sides of a line.
_SIDES = re.compile(r"=|←|≈|:(?!\d)")
#: What leads from one value to the next, which need not be the same.
_NEXT = re.compile(r"[⇒→]")
#: Such signs as they may be typed.
_TYPED = {"<-": "←", "->": "→", ":=": "="}
#: What begins with a number, whatever sign or bracket it has, is no name.
_NUMERIC = re.compile(r"[-+−(√\s]*[\d.]")
#: What is said before a value: so 5/2, the answer is 5/2.
_SAID = re.compile(
    r"\A\s*(?:so|thus|hence|then|therefore|(?:the\s+)?(?:answer|result)(?: is\b|\s*[=:]))(?=\W)\s*", re.I
)
#: A sign of a working, which no name has; a star behind a letter is one of its own, and so is a stroke between words.
_OPERATED = re.compile(r"[+·×/]|(?<![^\W\d_])\*|\*(?=\s*\w)|(?<![^\W\d_])[-−]|[-−](?![^\W\d_])")
#: What stands in brackets or bars, of a name; and a derivative, a name with a stroke.
_BRACKETS, _DERIVATIVE = re.compile(r"\([^()]*\)|‖[^‖]*‖|\|[^|]*\|"), re.compile(r"[∂d]\S*\s*/\s*[∂d]\w")
#: A name among numbers: V(cool), V^π(cool), R_1, μ̄.
_NAME = re.compile(r"[^\W\d_][\w′'’\u0300-\u036f]*(?:\^\*|\^\([^()]*\)|\^\w+|\*(?=\())?(?:\([^()]*\))?")
_LAST_NAME = re.compile(rf"{_NAME.pattern}\Z")
#: A bracket behind a number is a factor.
_TIMES = re.compile(r"(?<=[\d)])\s*\(")
#: The letter of an error stands for nothing else.
_ERROR = "δ"
#: The probability of a measurement, at some time.
_OF_MEASUREMENT = re.compile(r"p\(([^()|,]+?)\d*\)")
#: A comparison is no equation.
_RELATION = re.compile(r"[<>≤≥≠]")
#: A side with names that may be worth more than this is not read.
_MOST_VALUES = 64
#: A line is worked out like another where at most one of so many numbers differs.
_FEW = 3
#: The number of a line before it.
_COUNTED = re.compile(r"\A\s*(?:\(\w\)|\[\w\])\.?(?:\s+|\Z)")
#: Between two equations on a line: V(cool) = 3, V(warm) = 4.
_NEXT_ONE = re.compile(r"(?<=[\w.)\]])(?:[,;]| and)\s+(?=[^\W\d][\w′']*(?:\^\w+)?(?:\([^()]*\))?\s*[=≈←])")
#: Four words, one after the other: what is said in a sentence need not be a step.
_SENTENCE = re.compile(r"(?<![^\W\d_])(?:[^\W\d_]{2,}+\s++){3}[^\W\d_]{2}")
#: What makes a value another one.
_CHANGED = re.compile(r"←|⇒|→")
#: What begins or ends so goes on with a line that is too long for the page, or is gone on with.
_MORE, _ENDS = ("+ ", "- ", "− "), ("+", "-", "−", "*", "·", "×", "/", "(", ",")
#: What stands before each item of a list.
_BULLETS = ("- ", "− ", "– ", "+ ", "* ", "• ")
#: What gives a value to a name has none of its own before it: "- V(cool) = 2" is an item of a list.
_ITEM = re.compile(r"[-+−] *[^\W\d][\w′']*(?:\([^()]*\))? *[=≈←:]")
#: A line to which others are joined is not longer.
_LONGEST = 1000
#: One row of a matrix that is written over several lines.
_ROW = re.compile("[⎡-⎦]")
#: The time or number of an update, which is told before it: t = 2.
_WHEN = re.compile(r"\A\s*[^\W\d_](?:_?\w)?\s*=\s*\d+\s*:(?=\s)")


class Standing(Enum):
    """How a line stands to the right working."""

    RIGHT = "right"
    FOLLOWS = "follows"  # from a line that departed
    SHORT = "short"  # rounded to too few digits
    MISCALCULATED = "miscalculated"  # its own sides are not equal
    DEPARTS = "departs"
    UNREAD = "unread"


_WRONG = (Standing.DEPARTS, Standing.MISCALCULATED)


class Line(Struct, frozen=True):
    """One line of somebody's working.

    Args:
        text: what was written.
        standing: how it stands to the right working.
        application: the step that it gives.
        causes: what it may come from, where it departs.
        sides: where it is miscalculated the first two of its sides' numbers that are not equal.
    """

    text: str
    standing: Standing
    application: Application | None = None
    causes: tuple[Cause, ...] = ()
    sides: tuple[Reading, ...] = ()


def follow(search: Search, texts: Sequence[str]) -> tuple[Line, ...]:
    """Each line of a working, held against the right one; behind one that departs, against what follows."""
    return tuple(_Follower(search).lines(texts))


def _goes_on(before: str, text: str) -> bool:
    """Whether a line belongs to the one before."""
    more = text.startswith(_MORE) and not _ITEM.match(text)
    return more or (before.endswith(_ENDS) and not text.startswith("="))


class _State(Struct, frozen=True):
    """What is expected at some place of a working: it changes with every line that departs.

    Args:
        values: what was found instead, by the numbers of the steps.
        expected: what every step gives.
        found: what stands in the answers, and in the equations of the working.
        answers: the answers of every part.
        sources: how every step is worked out: its right side, and what is known.
    """

    values: Mapping[int, Any]
    expected: Mapping[int, Sequence[Any]]
    found: Sequence[Sequence[Any]]
    answers: Mapping[str, Any]
    sources: Mapping[int, tuple[Any, Mapping[str, Any]]]


class _Follower:
    def __init__(self, search: Search) -> None:
        self.search = search
        self.reached = -1
        self.done: set[int] = set()
        #: Whether an equation went wrong that gives no value, so that nothing is known of what follows from it.
        self.lost = False
        self.asked = asked_letters(search)
        self.names = Names(search)
        self.letters: dict[str, list[Any]] = {}
        for found in search.work.letters:
            self.letters.setdefault(found.letter, []).append(found.value)
        for letter, value in self.asked.items():
            self.letters.setdefault(letter, [value])
        self.points = [dict(zip(self.letters, values, strict=True)) for values in product(*self.letters.values())]
        self.parameters = tuple({**dict.fromkeys(search.problem.parameters), **self.letters})
        answers = search.solution.answers
        right = (*answers.values(), *_in_equations(search.work), *self.asked.values())
        self.state = _State(
            {},
            {each.number: entries for each in search.applications if (entries := numbers(each.value)) is not None},
            [group for value in right for group in _groups(value)],
            answers,
            {each.number: (each.right, each.known) for each in search.applications},
        )
        #: What was expected before a line that may be no step at all: a bare number that nothing explains.
        self.before: _State | None = None
        long = [len(value) for value in answers.values() if isinstance(value, tuple | Mapping)]
        values = (each.value for each in search.applications)
        self.reader = Reader(self.parameters, values, (*long, *map(len, self.names.runs)))
        self._between: dict[int, tuple[Any, list[Any]]] = {}

    @property
    def values(self) -> Mapping[int, Any]:
        """What was found otherwise than it is, by the numbers of the steps."""
        return self.state.values

    @property
    def expected(self) -> Mapping[int, Sequence[Any]]:
        """The numbers that every step gives, with what was found so far."""
        return self.state.expected

    def lines(self, texts: Sequence[str]) -> Iterator[Line]:
        typed = [text for text in map(str.strip, texts) if text]
        listed = len(typed) > 1 and any(all(text.startswith(sign) for text in typed) for sign in _BULLETS)
        stripped = [text[1:].strip() for text in typed] if listed else typed
        goes_on = [False, *starmap(_goes_on, pairwise(stripped))]
        whole, line = "", Line("", Standing.UNREAD)
        for number, text in enumerate(stripped):
            if not goes_on[number]:
                before = f"{whole} " if text.startswith("=") and len(whole) < _LONGEST else ""
                end = next((later for later in range(number + 1, len(stripped)) if not goes_on[later]), len(stripped))
                whole = before + " ".join(stripped[number:end])
                line = self._line(whole)
            elif line.standing in _WRONG:
                line = replace(line, standing=Standing.FOLLOWS, causes=(), sides=())
            yield replace(line, text=typed[number])

    def _line(self, text: str) -> Line:
        """A line, by the first of its equations that goes wrong."""
        told = _SENTENCE.search(text) is not None
        lines = [self._equation(one, told) for one in _NEXT_ONE.split(text)]
        read_ = [line for line in lines if line.standing is not Standing.UNREAD] or lines
        return next((line for line in read_ if line.standing in _WRONG), read_[-1])

    def _equation(self, text: str, told: bool) -> Line:
        label, pieces = self._read(text)
        sides = [self.reader.read(piece) for piece in pieces]
        read_ = [side for side in sides if side is not None]
        for ones, twos in pairwise(sides):
            if ones is not None and twos is not None and len(ones) != len(twos):
                return Line(text, Standing.UNREAD)
            for one, two in zip(ones or (), twos or (), strict=False):
                if not self._equal(one, two) and not _is_rounded(two, one.value) and not self._kept_digits(one, two):
                    if self._holds_letter(one, two):
                        return self._untrue(text, one, two)
                    return self._miscalculated(text, label, (one, two), read_)
        named = [None if side is not None else self._in_names(piece) for piece, side in zip(pieces, sides, strict=True)]
        if any(named):
            return self._of_names(text, label, sides, named, told)
        if not read_ or (None in sides and not self._named(label)):
            return Line(text, Standing.UNREAD)
        return self._placed(text, label, sides, told)

    def _kept_digits(self, one: Reading, two: Reading) -> bool:
        """Whether a decimal stands on the way, and what it is worked out from is rounded: 0.9*0.627 = 0.565."""
        with suppress(*UNDONE):
            return one.decimal and two.decimal and is_close(one.value, two.value) and self._place((two,)) is not None
        return False

    def _read(self, text: str) -> tuple[str, list[str]]:
        """The name before the first sign, and the sides behind the last arrow that has one which is understood."""
        if _ROW.search(text):
            return "", []
        for typed, sign in _TYPED.items():
            text = text.replace(typed, sign)
        text = _SAID.sub("", _WHEN.sub("", _COUNTED.sub("", text)))
        steps = [list(map(str.strip, _SIDES.split(step))) for step in _NEXT.split(text)]
        labels = []
        while (len(steps) > 1 or len(steps[0]) > 1) and steps[0] and self._is_name(steps[0][0]):
            labels.append(steps[0].pop(0))
        said = [match[0] for label in labels if _SENTENCE.search(label) and (match := _LAST_NAME.search(label))]
        label = next((label for label in (*labels, *said) if self._named(label)), next(iter(labels), ""))
        read_ = (step for step in reversed(steps) if any(map(self.reader.read, step)))
        return label, next(read_, steps[-1])

    def _is_name(self, piece: str) -> bool:
        """Whether what stands before the first sign is a name, V(s) or ∂f/∂x, and not a side."""
        if _NUMERIC.match(piece) or not piece:
            return not piece
        entries = None if ":" in piece else self.reader.read(piece)
        if entries is not None:
            return piece.isalpha() and not self._holds_letter(*entries)
        if self._named(piece) or _DERIVATIVE.match(piece):
            return True
        return not _OPERATED.search(_BRACKETS.sub("", piece))

    def _in_names(self, piece: str) -> list[Entries] | None:
        """What a side is worth that holds names, with all that these are worth at some time; None if one is unknown."""
        written, values = _NAME.sub("{}", re.sub(r"[{}]", "", piece)), []
        for found in _NAME.finditer(piece):
            worth = self._worth(found[0])
            if not worth and self.reader.read(found[0]) is None and found[0] not in FUNCTIONS:
                return None
            before = piece[: found.start()].rstrip()[-1:]
            times = "*" if before and (before.isalnum() or before == ")") else ""
            values.append([f"{times}({each})" for each in worth] or [found[0]])
        if not values or len(piece) > _LONGEST or prod(map(len, values)) > _MOST_VALUES:
            return None
        if all(len(each) == 1 and not each[0].endswith(")") for each in values):
            return None
        readings: list[Entries] = []
        for each in product(*values):
            with suppress(Unreadable):
                piece = _TIMES.sub("*(", written.format(*each))
                readings.append((read_number(piece, self.parameters),))
        return readings or None

    def _worth(self, name: str) -> Sequence[Any]:
        """What a name is worth at some time: a step, something that is given, or a letter of the formulas."""
        found = [self.expected[number][0] for number in self._named(name, 1)]
        given = self.names.given(name)
        letter = self.names.scalar(name)
        return list({str(each): each for each in (*found, *given, *letter) if is_rational(each)}.values())

    def _of_names(
        self,
        text: str,
        label: str,
        sides: Sequence[Entries | None],
        named: Sequence[list[Entries] | None],
        told: bool,
    ) -> Line:
        """An equation with names in it, read with the values that solve it."""
        chain: list[list[Entries]] = []
        for given, side in zip(named, sides, strict=True):
            if given or side is not None:
                chain.append(given or [side or ()])
        worth: list[Entries] = [(self._reading(value),) for value in self._worth(label)] if label else []
        if worth:
            chain.insert(0, worth)
        last = chain[0]
        for worths in chain[1:]:
            last = [each for each in worths if any(self._alike(each, one) for one in last)]
        known = not label or bool(worth)
        whole = known and len(chain) == len(sides) + bool(worth)
        numbered = any(side is not None for side in sides)
        if last and len(chain) > 1:
            if numbered and label:
                return self._placed(text, label, sides, told)
            return Line(text, self._standing if whole else Standing.UNREAD)
        if len(chain) == 1 or not known or self.lost or self.values or told or _RELATION.search(text):
            return Line(text, Standing.UNREAD)
        line = self._placed(text, label, sides, told) if numbered and label else Line(text, Standing.RIGHT)
        if line.standing in _WRONG:
            return line
        self.lost = True
        meant = self._named(label, 1) or [number for name in _NAME.finditer(text) for number in self._named(name[0], 1)]
        return Line(text, Standing.DEPARTS, self.search.applications[meant[0]] if meant else None)

    def _reading(self, value: Any) -> Reading:
        return Reading(value, str(value), decimal=False)

    def _alike(self, one: Entries, other: Entries) -> bool:
        return len(one) == len(other) and all(map(self._equal, one, other))

    def _equal(self, one: Reading, other: Reading) -> bool:
        return self._same(other, one.value) or self._same(one, other.value)

    @property
    def _standing(self) -> Standing:
        """How a line stands that is as it should be."""
        return Standing.FOLLOWS if self.values or self.lost else Standing.RIGHT

    def _holds_letter(self, *readings: Reading) -> bool:
        """Whether a letter is in them that is found on the way."""
        return any(parameters(reading.value) & self.letters.keys() for reading in readings)

    def _untrue(self, text: str, one: Reading, two: Reading) -> Line:
        """An equation in a letter that does not hold; of one that the question does not ask for nothing is known."""
        solved = {each.letter for each in self.search.work.letters}
        found = solved - set(self.search.problem.given.left_open)
        holds = parameters(one.value) | parameters(two.value)
        asked = any(side.value == generator(letter) for letter in self.asked for side in (one, two))
        if self.values or self.lost or (holds & found and not asked):
            return Line(text, Standing.UNREAD)
        self.lost = True
        with suppress(*UNDONE):  # what the letter is then
            (letter,) = holds
            slope, constant = linear(one.value - two.value, letter)
            self.points = [{**point, letter: -constant / slope} for point in self.points]
        return Line(text, Standing.DEPARTS)

    def _placed(self, text: str, label: str, sides: Sequence[Entries | None], told: bool) -> Line:
        """A line that is true in itself, held against the steps; and as if a doubtful line before were none of them."""
        before, self.before = self.before, None
        line = self._judged(text, label, sides, told)
        if before is None or line.standing is not Standing.DEPARTS:
            self.before = before or self.before
            return line
        after = self.state, self.reached
        self.state = before
        again = self._judged(text, label, sides, told)
        if again.standing is Standing.RIGHT:
            self.before = None
            return again
        (self.state, self.reached), self.before = after, before
        return line

    def _judged(self, text: str, label: str, sides: Sequence[Entries | None], told: bool) -> Line:
        last = next(side for side in reversed(sides) if side is not None)
        named = self._named(label, len(last))
        alone = sides == [last] and not _CHANGED.search(text)
        if named and self._gives(named[0], last):
            return self._step(text, named[0], last)
        if alone and self._is_given(label, last) and not self._is_done_wrongly(named, last):
            return Line(text, self._standing)
        steps = named or ([] if label else self._order(len(last)))
        step = next((number for number in steps if self._gives(number, last)), None)
        if step is not None:
            return self._step(text, step, last)
        rounded = next((number for number in steps if _all_rounded(last, self.expected[number])), None)
        if rounded is not None and not told:
            return self._rounded_step(text, rounded, last)
        if named:
            if self._is_beside(label, last):
                return Line(text, self._standing)
            return Line(text, Standing.UNREAD) if told else self._departed(text, named, last, certain=True)
        a_number = alone and not is_rational(last[0].value)  # 5π/6 is worked out no further
        worked = _worked_with(text) if len(last) == 1 and not a_number else None
        if label:
            return self._of_own_name(text, label, last, worked, told)
        if any(side is not None and self._holds_letter(*side) for side in sides) and len(sides) > 1:
            return Line(text, self._standing)
        if any(self._all_same(last, values) for values in (*self.state.found, *self._together)):
            return Line(text, self._standing)
        if len(last) > 1 and alone and not told and self._order(len(last)):
            return self._departed(text, (), last, certain=False)
        if told or len(last) > 1 or self._holds_letter(*last):
            known = self._place(last) is not None
            return Line(text, self._standing if known else Standing.UNREAD)
        return self._worked(text, last, worked) if worked is not None else self._bare(text, last)

    def _step(self, text: str, number: int, last: Entries) -> Line:
        self.reached = max(self.reached, number)
        self.done.add(number)
        if not self._all_same(last, self.expected[number]):
            self._go_on(number, last)
        return Line(text, self._standing, self.search.applications[number])

    def _rounded_step(self, text: str, number: int, last: Entries) -> Line:
        """A step's value with too few digits: what comes next may go on from it, or from the value itself."""
        self.before = self.before or self.state
        self._go_on(number, last)
        return Line(text, Standing.SHORT, self.search.applications[number])

    def _gives(self, number: int, last: Entries) -> bool:
        """Whether a step gives it; or with what was found so far an equation of a system, or 1 minus the others."""
        if self._all_same(last, self.expected[number]):
            return True
        if not self.values or len(last) > 1:
            return False
        run = next((run for run in self.names.runs if number in run), ())
        others = [self.expected[each][0] for each in run if each != number]
        right = [self.search.applications[each].value for each in run]
        if run and all(map(is_rational, (*right, *others))) and sum(right) == 1:
            return self._all_same(last, [1 - sum(others)])
        step = self.search.applications[number]
        return step.equation and self._all_same(last, [self._again(step)])

    def _again(self, step: Application) -> Any:
        """What an equation gives with the values that were found for its other unknowns."""
        left = step.formula.left
        assert isinstance(left, Quantity)
        solution = dict(step.known[left.code])
        for other, value in self.values.items():
            each = self.search.applications[other]
            if self.names.letters[other] & self.names.letters[step.number]:
                key = tuple(map(str, each.step.left.args))
                solution.update({one: value for one in solution if (one if isinstance(one, tuple) else (one,)) == key})
        return value_or_none(step.right, {**step.known, left.code: solution})

    def _is_done_wrongly(self, named: Sequence[int], last: Entries) -> bool:
        """Whether the old value of what comes next is what somebody gets for it who errs."""
        return bool(named and self.done) and named[0] not in self.done and any(
            cause.kind != "kept" and cause.weight >= LIKELY for cause in self._causes(named[0], last, None)
        )  # fmt: skip

    def _of_own_name(self, text: str, label: str, last: Entries, worked: Numbers | None, told: bool) -> Line:
        """A line with a name that no step has: what is asked for, or else it is right where it is worked out so."""
        asked, parts = self._answer(label, len(last)), self._parts_called(label)
        measured = list(self._evidence(label))
        if any(self._all_same(last, values) for values in (*asked, *parts, *measured)):
            return Line(text, self._standing)
        if any(_all_rounded(last, values) for values in asked):
            return Line(text, Standing.SHORT)
        if self._are_shares(asked):
            return Line(text, Standing.UNREAD)  # before it is divided by the sum, it may be anything
        if asked or measured or (parts and spelled(label).startswith(_ERROR)):
            wrong = not (told or self.lost or self.values)
            return Line(text, Standing.DEPARTS if wrong else Standing.UNREAD)
        if any(self._all_same(last, [value]) for value in self.names.noted(label)):
            return Line(text, self._standing)
        if worked is None or self.names.is_of_another(label):
            return Line(text, Standing.UNREAD)
        place = self._place(last, worked)
        known = place is not None and place.apart(worked) * _FEW <= worked.total()
        known = known or any(
            self._gives(number, last) and self._apart(number, worked) * _FEW <= worked.total()
            for number in self._order(len(last))
        )
        return Line(text, self._standing if known else Standing.UNREAD)

    def _are_shares(self, asked: Sequence[Sequence[Any]]) -> bool:
        """Whether what is asked for is one of several numbers that sum to 1."""
        tables = [[*numbers_of(answer)] for answer in self.state.answers.values() if isinstance(answer, Mapping)]
        whole = [table for table in tables if all(map(is_rational, table)) and sum(table) == 1]
        return any(value in table for values in asked for value in values for table in whole)

    def _parts_called(self, label: str) -> Sequence[Sequence[Any]]:
        """What a part of a step is worth for which the sheet has a letter: δ, the TD error of an update."""
        found = []
        for number in self._order(None):
            right, known = self.state.sources[number]
            for letter, part in parts_with_letters(right):
                if letter != spelled(label).rstrip("0123456789") or letter in known:
                    continue
                if (value := value_or_none(part, known)) is not None:
                    found.append([value])
        return found

    def _evidence(self, label: str) -> Iterator[Sequence[Any]]:
        """What the probability of a measurement, p(z), is worth at some time: a belief is divided by it."""
        if (said := _OF_MEASUREMENT.fullmatch(spelled(label))) is None:
            return
        for number in self._order(None):
            right, known = self.state.sources[number]
            if said[1] not in (("z", spelled(str(known["z"]))) if "z" in known else ("D", "Dz")):
                continue
            for part in preorder_traversal(right):
                if part.is_Pow and part.exp == -1 and (value := value_or_none(part.base, known)) is not None:
                    yield [value]

    def _worked(self, text: str, last: Entries, worked: Numbers) -> Line:
        """A line with a working and without a name: wrong where its numbers are those of a step that went wrong."""
        place = self._place(last, worked)
        nearest = None if place is None else place.apart(worked)
        if not self.values and not self.lost:
            best: tuple[int, int, tuple[Cause, ...]] | None = None
            for number in self._order(len(last)):
                causes = [
                    cause for cause in self._causing(number, last, worked)
                    if cause.edit or cause.probe or cause.mistake
                ]  # fmt: skip
                found = told_by(self.search.applications[number], causes, worked)
                if (
                    found
                    and (worked.total() >= _FEW or (found[0] == 0 and place is None))
                    and (best is None or found[0] < best[0])
                ):
                    best = found[0], number, self._heaviest(found[1])
            if best is None and place is None:
                near_ = [(self._apart(number, worked), number) for number in self._order(len(last))]
                best = next(((far, number, ()) for far, number in near_ if far <= 1 and worked.total() > _FEW), None)
            if best is not None and (nearest is None or best[0] < nearest):
                return self._goes_wrong(text, best[1], best[2], last)
        return Line(text, Standing.UNREAD if place is None else self._standing)

    def _apart(self, number: int, worked: Numbers) -> int:
        """How many numbers stand in a line or in a step, and not in both."""
        right, known = self.state.sources[number]
        ways = ((numbers_in(line), worked_out(line)) for line in lines(right, known))
        return min((apart(way, worked) for both in ways for way in both), default=worked.total())

    def _bare(self, text: str, last: Entries) -> Line:
        """A number alone: what stands on the way, or else a step that went wrong."""
        place = self._place(last)
        if place is not None and place.whole:
            return Line(text, self._standing)
        if self.lost:
            return Line(text, Standing.UNREAD)
        return self._departed(text, (), last, certain=False)

    def _place(self, last: Entries, worked: Numbers | None = None) -> Place | None:
        """A number on the way that is the same: a whole one, or the one with the numbers of a line."""
        if len(last) != 1:
            return None
        size = approximate(last[0].value)
        found = []
        for number in self._order(None):
            if number in self.values and self._all_same(last, numbers(self.search.applications[number].value) or ()):
                continue
            for place in self._places_of(number):
                if near(place.size, size) and self._same(last[0], place.value):
                    found.append(place)
        if worked is not None:
            return min(found, key=lambda place: place.apart(worked), default=None)
        return next((place for place in found if place.whole), next(iter(found), None))

    def _places_of(self, number: int) -> list[Place]:
        right, known = source = self.state.sources[number]
        if number not in self._between or self._between[number][0] is not source:
            own = self.search.applications[number].step.own
            self._between[number] = source, places(right, known, own=own)
        return self._between[number][1]

    def _is_beside(self, label: str, last: Entries) -> bool:
        """Whether another step of that name gives it: one that the solver writes, of a run that is only supposed."""
        steps = (line for line in self.search.work.lines if isinstance(line, Step) and line.value is not None)
        same = (step for step in steps if self._all_same(last, numbers(step.value) or ()))
        return any(plain_name(label) in names(step) for step in same)

    def _is_given(self, label: str, last: Entries) -> bool:
        """Whether it says what was known before a step, r₁ = 3 or V(cave) = 8."""
        return any(self._all_same(last, [value]) for value in self.names.given(label))

    def _departed(self, text: str, named: Sequence[int], last: Entries, *, certain: bool) -> Line:
        """A line that gives no step: the step that it was meant for, and what it comes from."""
        order = self._order(len(last))
        meant = list(named) or [number for number in order if number > self.reached] or order
        if self.lost:
            return Line(text, Standing.UNREAD)
        line = _worked_with(text) if len(last) == 1 else None
        where = meant[0] if meant else None
        causes: tuple[Cause, ...] = ()
        if not self.values:
            for number in meant:
                found = self._causes(number, last, line)
                if found:
                    where, causes = number, found
                    break
        return self._goes_wrong(text, where, causes, last, certain=certain)

    def _goes_wrong(
        self, text: str, where: int | None, causes: tuple[Cause, ...], last: Entries, *, certain: bool = True
    ) -> Line:
        application = None if where is None else self.search.applications[where]
        if where is not None:
            if not certain and self.before is None:
                self.before = self.state
            self._go_on(where, last)
        return Line(text, Standing.DEPARTS, application, causes)

    def _miscalculated(self, text: str, label: str, differ: tuple[Reading, Reading], sides: Sequence[Entries]) -> Line:
        last = sides[-1]
        meant = self._named(label, len(last)) or [
            number
            for number in self._order(len(last))
            if any(self._all_same(side, self.expected[number]) for side in sides)
        ]
        where = meant[0] if meant else None
        if where is not None:
            self._go_on(where, last)
        else:
            self.lost = True
        application = None if where is None else self.search.applications[where]
        return Line(text, Standing.MISCALCULATED, application, (), differ)

    def _causes(self, number: int, typed: Entries, line: Numbers | None) -> tuple[Cause, ...]:
        """What one step's value may come from, if it is what was typed, with the numbers that stand in the line."""
        found = self._causing(number, typed, line)
        if line is not None:
            found = by_the_numbers(self.search.applications[number], found, line)
        return self._heaviest(found)

    def _causing(self, number: int, typed: Entries, line: Numbers | None) -> list[Cause]:
        application = self.search.applications[number]
        every = self.search.alternatives(application)
        if line is not None:
            every = [
                *every,
                *_of_an_equation(application, self.search.problem.given),
                *put_in_otherwise(application, line),
            ]
        return [
            cause
            for cause in every
            if _all_near(typed, became := numbers(cause.became) or ()) and self._all_same(typed, became)
        ]

    def _heaviest(self, found: Sequence[Cause]) -> tuple[Cause, ...]:
        """The likeliest, and another that is about as likely and says something else."""
        ranked = sorted(found, key=lambda cause: -cause.weight)
        several = [cause for cause in ranked if cause.weight >= ranked[0].weight / 2]
        said = {str(saying(cause, self.search.applications)): cause for cause in reversed(several)}
        return tuple(reversed(said.values()))[:2]

    def _all_same(self, entries: Entries, values: Sequence[Any]) -> bool:
        pairs = zip(entries, values, strict=False)
        return len(entries) == len(values) and all(self._same(one, value) for one, value in pairs)

    def _same(self, reading: Reading, value: Any) -> bool:
        """Whether they are the same, with what is found for the letters in their place."""
        for found in self.points:
            with suppress(NotReal, *UNDONE):
                one, other = (_where(each, found) for each in (reading.value, value))
                if is_right(one, other, rounded=reading.decimal):
                    return True
        return False

    def _go_on(self, number: int, entries: Entries) -> None:
        """What is expected from here on."""
        right = self.search.applications[number].value
        values = {**self.values, number: of_numbers(right, [entry.value for entry in entries])}
        self.reached = max(self.reached, number)
        trace: list[Traced] = []
        answers = self.search.replay(Change(values=values), trace) or {}
        given = {at: found for at, _, _, came in trace if at in self.expected and (found := numbers(came)) is not None}
        self.state = _State(
            values,
            {**self.expected, **given},
            list(_groups(answers)),
            answers,
            {**self.state.sources, **{at: (right, known) for at, right, known, _ in trace if at in self.state.sources}},
        )

    def _order(self, long: int | None = 1) -> list[int]:
        """The steps that a line of so many numbers can give, those that come next first."""
        steps = [number for number, entries in self.expected.items() if long is None or len(entries) == long]
        return [each for each in steps if each > self.reached] + [each for each in steps if each <= self.reached]

    def _named(self, label: str, long: int | None = None) -> list[int]:
        """The steps whose quantity has that name, those that come next first."""
        return self.names.among(self._order(long), label)

    @property
    def _together(self) -> Iterator[Sequence[Any]]:
        """What such steps give, as vectors."""
        for run in self.names.runs:
            if all(number in self.expected for number in run):
                yield [self.expected[number][0] for number in run]

    def _answer(self, label: str, long: int) -> Sequence[Sequence[Any]]:
        """What the quantity of a name that a part asks for, or that several steps give, is worth."""
        name, letter = plain_name(label), re.sub(r"\(.*", "", plain_name(label))
        found: list[Sequence[Any]] = []
        for part in self.search.problem.parts:
            values = list(numbers_of(self.state.answers.get(part.label)))
            names_ = [plain_name(each) for each in called(part)]
            if long == 1:
                found += [[value] for each, value in zip(names_, values, strict=False) if each == name]
            elif len(values) == long and letter and letter in {re.sub(r"\d*(?:\(.*)?\Z", "", each) for each in names_}:
                found.append(values)
        if long > 1:
            for run in self.names.runs:
                if len(run) == long and any(letter in map(str.lower, self.names.letters[each]) for each in run):
                    found.append([self.expected[number][0] for number in run])
        return found


def _worked_with(text: str) -> Numbers | None:
    """The numbers of the first side of a line that is worked out; None where every side is one number."""
    found = map(numbers_typed, _SIDES.split(text))
    return next((side for side in found if side is not None), None)


def _of_an_equation(application: Application, given: Any) -> Iterator[Cause]:
    """What can be done where the right side of an equation is worked out, with the values that solve the system."""
    if application.equation:
        for cause in at_one(replace(application, equation=False), given):
            yield replace(cause, application=application)


def _all_near(entries: Entries, values: Sequence[Any]) -> bool:
    return len(entries) == len(values) and all(
        near(approximate(value), approximate(one.value)) for one, value in zip(entries, values, strict=True)
    )


def _is_rounded(reading: Reading, value: Any) -> bool:
    """Whether a decimal is a value with too few digits."""
    with suppress(*UNDONE):
        return reading.decimal and is_close(reading.value, value) and is_short(reading.value, value)
    return False


def _all_rounded(entries: Entries, values: Sequence[Any]) -> bool:
    return len(entries) == len(values) and all(map(_is_rounded, entries, values))


def _where(value: Any, found: Mapping[str, Any]) -> Any:
    """The value with numbers for those of its letters that are found."""
    return (
        value_where(value, lambda name: found.get(name, generator(name))) if parameters(value) & found.keys() else value
    )


def _in_equations(work: Work) -> Iterator[Any]:
    """What stands on the sides of the equations that follow from the steps."""
    for line in work.lines:
        if isinstance(line, Equality):
            yield from (line.left, *line.rights)
    yield from (found.value for found in work.letters)


def _groups(value: Any) -> Iterator[Sequence[Any]]:
    """The numbers of a value as they may be written: one by one, and all of them together."""
    if isinstance(value, Mapping | tuple):
        inner = list(value.values() if isinstance(value, Mapping) else value)
        for each in inner:
            yield from _groups(each)
        if len(inner) > 1 and all(map(plain, inner)):
            yield inner
    elif together := numbers(value):
        yield together
        yield from ([each] for each in together)
