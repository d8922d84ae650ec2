"""Somebody's own working, line by line, held against the right one."""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from enum import Enum
from functools import partial
from itertools import pairwise
from typing import Any, TypeAlias
from unicodedata import normalize

from msgspec import Struct
from msgspec.structs import replace

from rldrill.problems.mathematics import Accent, Big, Fence, Fraction, Glyph, Math, Root, Row, Script
from rldrill.solutions.answers.rule import is_right
from rldrill.solutions.answers.text import Reading, Unreadable, read_matrix, read_number
from rldrill.solutions.diagnosis.alternatives import at_one, numbers, of_numbers, plain
from rldrill.solutions.diagnosis.causes import Cause
from rldrill.solutions.diagnosis.replay import UNDONE, Application, Change, Traced
from rldrill.solutions.diagnosis.search import Search
from rldrill.solutions.diagnosis.typed import approximate, near
from rldrill.solutions.diagnosis.written_line import Numbers, by_the_numbers, numbers_typed, put_in_otherwise
from rldrill.solutions.exact import NotReal
from rldrill.solutions.formula.compiling import value_of
from rldrill.solutions.formula.edits import probes
from rldrill.solutions.formula.typesetting import typeset
from rldrill.solutions.matrices import is_matrix
from rldrill.solutions.vector import Vector

#: Signs between the sides of a line.
_SIDES = re.compile(r"=|←|≈|:(?!\d)")
#: What leads from one value to the next, which need not be the same.
_NEXT = re.compile(r"[⇒→]")
#: What begins with a number, whatever sign or bracket it has, is no name.
_NUMERIC = re.compile(r"[-+−(√\s]*[\d.]")
#: Signs of a working: with one of them what can be read is none, either.
_WORKED = re.compile(r"[-+−*·]")
#: The number of a line before it.
_COUNTED = re.compile(r"\A\s*(?:\(\w\)|\[\w\])\s+")
#: The time or number of an update, which is told before it: t = 2.
_WHEN = re.compile(r"\A\s*[^\W\d_](?:_?\w)?\s*=\s*\d+\s*:(?=\s)")
_WORDS = {"gamma": "γ", "alpha": "α", "delta": "δ", "lambda": "λ", "epsilon": "ε", "theta": "θ", "pi": "π", "rho": "ρ"}


#: The numbers of one side of a line: one, or those of a vector or matrix, row by row.
Entries: TypeAlias = tuple[Reading, ...]


class Standing(Enum):
    """How a line stands to the right working."""

    RIGHT = "right"
    FOLLOWS = "follows"  # from a line that departed
    MISCALCULATED = "miscalculated"  # its own sides are not equal
    DEPARTS = "departs"
    UNREAD = "unread"


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


class _Follower:
    def __init__(self, search: Search) -> None:
        self.search = search
        self.values: dict[int, Any] = {}
        self.reached = -1
        self.expected = {
            each.number: entries for each in search.applications if (entries := numbers(each.value)) is not None
        }
        self.shapes = dict.fromkeys(_shape(each.value) for each in search.applications if _is_array(each.value))
        self.between = {each.number: list(_inner(each)) for each in search.applications}

    def lines(self, texts: Sequence[str]) -> Iterator[Line]:
        for text in texts:
            if text.strip():
                yield self._line(text.strip())

    def _line(self, text: str) -> Line:
        label, sides = self._read(text)
        if not sides:
            return Line(text, Standing.UNREAD)
        for ones, twos in pairwise(sides):
            for one, two in zip(ones, twos, strict=False):
                if not _same(two, one.value) and not _same(one, two.value):
                    return self._miscalculated(text, label, (one, two), sides)
        return self._placed(text, label, sides[-1])

    def _read(self, text: str) -> tuple[str, list[Entries]]:
        """The name before the first sign, and the sides behind the last arrow that are numbers, vectors or matrices."""
        text = _WHEN.sub("", _COUNTED.sub("", text))
        steps = [list(map(str.strip, _SIDES.split(step))) for step in _NEXT.split(text)]
        label = ""
        if sum(map(len, steps)) > 1 and self._is_name(steps[0][0]):
            label = steps[0].pop(0)
        read_ = [[entries for piece in step if (entries := self._entries(piece)) is not None] for step in steps]
        return label, next(filter(None, reversed(read_)), [])

    def _is_name(self, piece: str) -> bool:
        """Whether what stands before the first sign is a name, V(s) or ∂f/∂x, and not a side."""
        return not _NUMERIC.match(piece) and (not _WORKED.search(piece) or self._entries(piece) is None)

    def _entries(self, piece: str) -> Entries | None:
        readings: list[Callable[[], Entries]] = [
            partial(self._number, piece),
            *(partial(self._grid, piece, shape) for shape in self.shapes),
        ]
        for read_ in reversed(readings) if {"[", "("} & set(piece) else readings:  # [−10 −12] is no difference
            with suppress(Unreadable):
                return read_()
        return None

    def _number(self, piece: str) -> Entries:
        return (read_number(piece, self.search.problem.parameters),)

    def _grid(self, piece: str, shape: tuple[int, int]) -> Entries:
        read_ = [entry for line in read_matrix(piece, shape, self.search.problem.parameters) for entry in line]
        given = tuple(entry for entry in read_ if entry is not None)
        if len(given) < len(read_):
            raise Unreadable("Entries are left out; give them too.")
        return given

    def _placed(self, text: str, label: str, last: Entries) -> Line:
        standing = Standing.FOLLOWS if self.values else Standing.RIGHT
        named = self._named(label, len(last))
        for number in named or self._order(len(last)):
            if _all_same(last, self.expected[number]):
                self.reached = max(self.reached, number)
                return Line(text, standing, self.search.applications[number])
        if not named and len(last) == 1:
            inner = (value for number in self._order() for value in self.between[number])
            if any(_same(last[0], value) for value in inner):
                return Line(text, standing, None)
        return self._departed(text, named, last)

    def _departed(self, text: str, named: Sequence[int], last: Entries) -> Line:
        """A line that gives no step: the step that it was meant for, and what it comes from."""
        order = self._order(len(last))
        meant = list(named) or [number for number in order if number > self.reached] or order
        first_time = not self.values
        line = next(filter(None, map(numbers_typed, _SIDES.split(text))), None) if len(last) == 1 else None
        where = meant[0] if meant else None
        causes: tuple[Cause, ...] = ()
        if first_time:
            for number in meant:
                found = self._causes(number, last, line)
                if found:
                    where, causes = number, found
                    break
        application = None if where is None else self.search.applications[where]
        if where is not None:
            self._go_on(where, last)
        return Line(text, Standing.DEPARTS, application, causes)

    def _miscalculated(self, text: str, label: str, differ: tuple[Reading, Reading], sides: Sequence[Entries]) -> Line:
        last = sides[-1]
        meant = self._named(label, len(last)) or [
            number for number in self._order(len(last)) if any(_all_same(side, self.expected[number]) for side in sides)
        ]
        where = meant[0] if meant else None
        if where is not None:
            self._go_on(where, last)
        application = None if where is None else self.search.applications[where]
        return Line(text, Standing.MISCALCULATED, application, (), differ)

    def _causes(self, number: int, typed: Entries, line: Numbers | None) -> tuple[Cause, ...]:
        """What one step's value may come from, if it is what was typed, with the numbers that stand in the line."""
        application = self.search.applications[number]
        every = self.search.alternatives(application)
        if line is not None:
            every = [
                *every,
                *_of_an_equation(application, self.search.problem.given),
                *put_in_otherwise(application, line),
            ]
        found = [
            cause
            for cause in every
            if _all_near(typed, became := numbers(cause.became) or ()) and _all_same(typed, became)
        ]
        if line is not None:
            found = by_the_numbers(application, found, line)
        if not found:
            return ()
        found.sort(key=lambda cause: -cause.weight)
        best = found[0].weight
        return tuple(cause for cause in found if cause.weight >= best / 2)[:2]

    def _go_on(self, number: int, entries: Entries) -> None:
        """What is expected from here on."""
        right = self.search.applications[number].value
        self.values[number] = of_numbers(right, [entry.value for entry in entries])
        self.reached = max(self.reached, number)
        trace: list[Traced] = []
        self.search.replay(Change(values=dict(self.values)), trace)
        self.expected |= {
            at: found for at, _, _, came in trace if at in self.expected and (found := numbers(came)) is not None
        }
        for at, right, known, _ in trace:
            if at in self.between:
                self.between[at] = list(_places(right, known))

    def _order(self, long: int = 1) -> list[int]:
        """The steps that a line of so many numbers can give, those that come next first."""
        steps = [number for number, entries in self.expected.items() if len(entries) == long]
        return [each for each in steps if each > self.reached] + [each for each in steps if each <= self.reached]

    def _named(self, label: str, long: int) -> list[int]:
        """The steps whose quantity has that name, those that come next first."""
        wanted = _plain_name(label)
        if not wanted:
            return []
        return [each for each in self._order(long) if wanted in _names(self.search.applications[each])]


def _is_array(value: Any) -> bool:
    return isinstance(value, Vector) or is_matrix(value)


def _shape(value: Any) -> tuple[int, int]:
    return (1, len(list(value))) if isinstance(value, Vector) else (value.nrows(), value.ncols())


def _of_an_equation(application: Application, given: Any) -> Iterator[Cause]:
    """What can be done where the right side of an equation is worked out, with the values that solve the system."""
    if application.equation:
        for cause in at_one(replace(application, equation=False), given):
            yield replace(cause, application=application)


def _all_same(entries: Entries, values: Sequence[Any]) -> bool:
    return len(entries) == len(values) and all(_same(one, value) for one, value in zip(entries, values, strict=True))


def _all_near(entries: Entries, values: Sequence[Any]) -> bool:
    return len(entries) == len(values) and all(
        near(approximate(value), approximate(one.value)) for one, value in zip(entries, values, strict=True)
    )


def _same(reading: Reading, value: Any) -> bool:
    try:
        return is_right(reading.value, value, rounded=reading.decimal)
    except (NotReal, *UNDONE):
        return False


def _inner(application: Application) -> Iterator[Any]:
    yield from _places(application.right, application.known)


def _places(right: Any, known: Mapping[str, Any]) -> Iterator[Any]:
    """What the places of a formula are worth: what somebody works out on the way."""
    for probe in probes(right):
        if not probe.within:
            try:
                value = value_of(probe.part, known)
            except UNDONE:
                continue
            if plain(value):
                yield value


def _names(application: Application) -> set[str]:
    """The names under which somebody may write a step."""
    written = _plain_name(_signs(typeset(application.step.left)))
    head = re.sub(r"\(.*", "", written)
    time = application.known.get("t")
    names = {written, re.sub(r"[(),]", "", written), head}
    if len(indices := {*re.findall(r"\d+", written.removeprefix(head))}) == 1:
        names.add(head + indices.pop())  # r1 for r(s_1)
    if isinstance(time, int):
        names |= {f"{head}{time}", re.sub("t(?![a-z])", str(time), written)}
    return names


def _signs(math: Math) -> str:
    """Mathematics as bare signs, one after the other."""
    match math:
        case Glyph(text, _):
            return text
        case Row(items):
            return "".join(map(_signs, items))
        case Fraction(above, below):
            return f"{_signs(above)}/{_signs(below)}"
        case Script(body, below, above):
            return _signs(body) + "".join(_signs(each) for each in (below, above) if each is not None)
        case Fence(body, _, _):
            return f"({_signs(body)})"
        case Root(body) | Accent(body, _):
            return _signs(body)
        case Big(sign, _, _):
            return sign
        case _:
            return ""


def _plain_name(label: str) -> str:
    name = re.sub(r"[\s_{}^]|new", "", normalize("NFKC", label)).lower()
    for spelled, letter in _WORDS.items():
        name = name.replace(spelled, letter)
    return name
