"""Somebody's own working, line by line, held against the right one."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from itertools import pairwise
from typing import Any
from unicodedata import normalize

from rldrill.problems.mathematics import Accent, Big, Fence, Fraction, Glyph, Math, Root, Row, Script
from rldrill.solutions.answers.rule import is_right
from rldrill.solutions.answers.text import Reading, Unreadable, read_number
from rldrill.solutions.diagnosis.alternatives import at_one
from rldrill.solutions.diagnosis.causes import Cause
from rldrill.solutions.diagnosis.replay import UNDONE, Application, Change, Traced
from rldrill.solutions.diagnosis.search import Search
from rldrill.solutions.diagnosis.typed import approximate, near
from rldrill.solutions.diagnosis.written_line import Numbers, by_the_numbers, numbers_typed, put_in_otherwise
from rldrill.solutions.exact import NotReal, is_rational
from rldrill.solutions.formula.compiling import value_of
from rldrill.solutions.formula.edits import probes
from rldrill.solutions.formula.typesetting import typeset
from rldrill.solutions.matrices import is_matrix
from rldrill.solutions.vector import Vector

#: Signs between the sides of a line.
_SIDES = re.compile(r"=|←|≈|:(?!\d)|⇒|→")
_WORDS = {"gamma": "γ", "alpha": "α", "delta": "δ", "lambda": "λ", "epsilon": "ε", "theta": "θ", "pi": "π", "rho": "ρ"}


class Standing(Enum):
    """How a line stands to the right working."""

    RIGHT = "right"
    FOLLOWS = "follows"  # from a line that departed
    MISCALCULATED = "miscalculated"  # its own sides are not equal
    DEPARTS = "departs"
    UNREAD = "unread"


@dataclass(frozen=True)
class Line:
    """One line of somebody's working.

    Args:
        text: what was written.
        standing: how it stands to the right working.
        application: the step that it gives.
        causes: what it may come from, where it departs.
        sides: the values of its sides; where it is miscalculated the first two that are not equal.
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
        self.expected = {each.number: each.value for each in search.applications if _number(each.value)}
        self.between = {each.number: list(_inner(each)) for each in search.applications}

    def lines(self, texts: Sequence[str]) -> Iterator[Line]:
        for text in texts:
            if text.strip():
                yield self._line(text.strip())

    def _line(self, text: str) -> Line:
        label, sides = self._read(text)
        if not sides:
            return Line(text, Standing.UNREAD)
        for one, two in pairwise(sides):
            if not _same(two, one.value) and not _same(one, two.value):
                return self._miscalculated(text, label, (one, two), sides[-1])
        return self._placed(text, label, sides)

    def _read(self, text: str) -> tuple[str, list[Reading]]:
        """The name before the first sign, and the sides that are numbers."""
        pieces = [piece.strip() for piece in _SIDES.split(text)]
        parameters = self.search.problem.parameters
        sides = []
        label = ""
        for place, piece in enumerate(pieces):
            if place == 0 and len(pieces) > 1 and not piece[:1].isdigit():
                label = piece
                continue
            try:
                sides.append(read_number(piece, parameters))
            except Unreadable:
                continue
        return label, sides

    def _placed(self, text: str, label: str, sides: list[Reading]) -> Line:
        standing = Standing.FOLLOWS if self.values else Standing.RIGHT
        last = sides[-1]
        named = self._named(label)
        for number in named or self._order():
            if _same(last, self.expected[number]):
                self.reached = max(self.reached, number)
                return Line(text, standing, self.search.applications[number], sides=tuple(sides))
        if not named:
            inner = (value for number in self._order() for value in self.between[number])
            if any(_same(last, value) for value in inner):
                return Line(text, standing, None, sides=tuple(sides))
        return self._departed(text, named, sides)

    def _departed(self, text: str, named: Sequence[int], sides: list[Reading]) -> Line:
        """A line that gives no step: the step that it was meant for, and what it comes from."""
        last = sides[-1]
        numbers = list(named) or [number for number in self._order() if number > self.reached] or list(self._order())
        first_time = not self.values
        line = next(filter(None, map(numbers_typed, _SIDES.split(text))), None)
        where = numbers[0] if numbers else None
        causes: tuple[Cause, ...] = ()
        if first_time:
            for number in numbers:
                found = self._causes(number, last, line)
                if found:
                    where, causes = number, found
                    break
        application = None if where is None else self.search.applications[where]
        if where is not None:
            self._go_on(where, last.value)
        return Line(text, Standing.DEPARTS, application, causes, tuple(sides))

    def _miscalculated(self, text: str, label: str, sides: tuple[Reading, Reading], last: Reading) -> Line:
        named = self._named(label)
        numbers = list(named) or [number for number in self._order() if _same(sides[0], self.expected[number])]
        where = numbers[0] if numbers else None
        if where is not None:
            self._go_on(where, last.value)
        application = None if where is None else self.search.applications[where]
        return Line(text, Standing.MISCALCULATED, application, (), sides)

    def _causes(self, number: int, typed: Reading, line: Numbers | None) -> tuple[Cause, ...]:
        """What one step's value may come from, if it is what was typed, with the numbers that stand in the line."""
        application = self.search.applications[number]
        about = approximate(typed.value)
        every = self.search.alternatives(application)
        if line is not None:
            every = [*every, *_of_an_equation(application), *put_in_otherwise(application, line)]
        found = [cause for cause in every if near(approximate(cause.became), about) and _same(typed, cause.became)]
        if line is not None:
            found = by_the_numbers(application, found, line)
        if not found:
            return ()
        found.sort(key=lambda cause: -cause.weight)
        best = found[0].weight
        return tuple(cause for cause in found if cause.weight >= best / 2)[:2]

    def _go_on(self, number: int, value: Any) -> None:
        """What is expected from here on."""
        self.values[number] = value
        self.reached = max(self.reached, number)
        trace: list[Traced] = []
        self.search.replay(Change(values=dict(self.values)), trace)
        self.expected |= {at: came for at, _, _, came in trace if _number(came) and at in self.expected}
        for at, right, known, _ in trace:
            if at in self.between:
                self.between[at] = list(_places(right, known))

    def _order(self) -> list[int]:
        """The steps that a line can give, those that come next first."""
        numbers = list(self.expected)
        return [each for each in numbers if each > self.reached] + [each for each in numbers if each <= self.reached]

    def _named(self, label: str) -> list[int]:
        """The steps whose quantity has that name, those that come next first."""
        wanted = _plain_name(label)
        if not wanted:
            return []
        return [each for each in self._order() if wanted in _names(self.search.applications[each])]


def _of_an_equation(application: Application) -> Iterator[Cause]:
    """What can be done where the right side of an equation is worked out, with the values that solve the system."""
    if application.equation:
        for cause in at_one(replace(application, equation=False)):
            yield replace(cause, application=application)


def _number(value: Any) -> bool:
    return not isinstance(value, str | tuple | Mapping | Vector) and not is_matrix(value)


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
            if is_rational(value) or (_number(value) and hasattr(value, "__add__")):
                yield value


def _names(application: Application) -> set[str]:
    """The names under which somebody may write a step."""
    written = _plain_name(_signs(typeset(application.step.left)))
    head = re.sub(r"\(.*", "", written)
    time = application.known.get("t")
    names = {written, re.sub(r"[(),]", "", written), head}
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
