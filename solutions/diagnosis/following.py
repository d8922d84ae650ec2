"""Somebody's own working, line by line, held against the right one."""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from enum import Enum
from functools import cached_property, partial
from itertools import pairwise, product, starmap
from typing import Any, TypeAlias
from unicodedata import combining, normalize

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
from rldrill.solutions.exact import NotReal, parameters, value_where
from rldrill.solutions.formula.compiling import value_of
from rldrill.solutions.formula.edits import probes
from rldrill.solutions.formula.typesetting import typeset
from rldrill.solutions.matrices import is_matrix
from rldrill.solutions.rational import generator
from rldrill.solutions.vector import Vector
from rldrill.solutions.work import Equality, Step, Work

#: Signs between the sides of a line.
_SIDES = re.compile(r"=|←|≈|:(?!\d)")
#: What leads from one value to the next, which need not be the same.
_NEXT = re.compile(r"[⇒→]")
#: What begins with a number, whatever sign or bracket it has, is no name.
_NUMERIC = re.compile(r"[-+−(√\s]*[\d.]")
#: Signs of a working: with one of them what can be read is none, either.
_WORKED = re.compile(r"[-+−*·]")
#: The number of a line before it.
_COUNTED = re.compile(r"\A\s*(?:\(\w\)|\[\w\])\.?(?:\s+|\Z)")
#: Between two equations on a line: V(cool) = 3, V(warm) = 4.
_NEXT_ONE = re.compile(r"(?<=[\w.)\]])(?:[,;]| and)\s+(?=[^\W\d][\w′']*(?:\([^()]*\))?\s*[=≈←])")
#: Four words, one after the other: what is said in a sentence need not be a step.
_SENTENCE = re.compile(r"(?<![^\W\d_])(?:[^\W\d_]{2,}+\s++){3}[^\W\d_]{2}")
#: The brackets in which more than one sign is above or below a letter: V^(π₀)(cool).
_SCRIPT = re.compile(r"[_^][({]([^(){}]*)[)}]")
#: What stands behind a letter for a sign above it.
_MARKS = re.compile(r"[′'’]|(?:bar|hat|tilde)(?=\W|\d|\Z)")
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
#: What stands before a bracket, and is no function: a factor without a value, c(3 − 1), or a name.
_FACTOR = re.compile(r"\A[^\W\d_]\s*\(")
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


class _Follower:
    def __init__(self, search: Search) -> None:
        self.search = search
        self.values: dict[int, Any] = {}
        self.reached = -1
        self.letters: dict[str, list[Any]] = {}
        for found in search.work.letters:
            self.letters.setdefault(found.letter, []).append(found.value)
        self.points = [dict(zip(self.letters, values, strict=True)) for values in product(*self.letters.values())]
        self.parameters = tuple({**dict.fromkeys(search.problem.parameters), **self.letters})
        self.expected = {
            each.number: entries for each in search.applications if (entries := numbers(each.value)) is not None
        }
        self.shapes = dict.fromkeys(_shape(each.value) for each in search.applications if _is_array(each.value))
        right = (*search.solution.answers.values(), *_in_equations(search.work))
        self.found = [group for value in right for group in _groups(value)]
        self.between = {each.number: list(_inner(each)) for each in search.applications}

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
        label, sides = self._read(text)
        read_ = [side for side in sides if side is not None]
        if not read_:
            return Line(text, Standing.UNREAD)
        for ones, twos in pairwise(sides):
            for one, two in zip(ones or (), twos or (), strict=False):
                if not self._same(two, one.value) and not self._same(one, two.value):
                    if self._holds_letter(one, two):
                        return self._untrue(text, one, two)
                    return self._miscalculated(text, label, (one, two), read_)
        return self._placed(text, label, sides, told)

    def _read(self, text: str) -> tuple[str, list[Entries | None]]:
        """The name before the first sign, and the sides behind the last arrow; None for one that is not understood."""
        if _ROW.search(text):
            return "", []
        text = _WHEN.sub("", _COUNTED.sub("", text))
        steps = [list(map(str.strip, _SIDES.split(step))) for step in _NEXT.split(text)]
        labels = []
        while (len(steps) > 1 or len(steps[0]) > 1) and steps[0] and self._is_name(steps[0][0]):
            labels.append(steps[0].pop(0))
        label = next((label for label in labels if self._named(label)), next(iter(labels), ""))
        read_ = [[self._entries(piece) for piece in step] for step in steps]
        return label, next((sides for sides in reversed(read_) if any(sides)), [])

    def _is_name(self, piece: str) -> bool:
        """Whether what stands before the first sign is a name, V(s) or ∂f/∂x, and not a side."""
        if _NUMERIC.match(piece):
            return False
        entries = self._entries(piece)
        return entries is None or not (_WORKED.search(piece) or self._holds_letter(*entries))

    def _holds_letter(self, *readings: Reading) -> bool:
        """Whether a letter is in them that is found on the way."""
        return any(parameters(reading.value) & self.letters.keys() for reading in readings)

    def _untrue(self, text: str, *readings: Reading) -> Line:
        """An equation in a letter that does not hold; of one that the question does not ask for nothing is known."""
        found = self.letters.keys() - self.search.problem.given.left_open
        certain = not self.values and not any(parameters(reading.value) & found for reading in readings)
        return Line(text, Standing.DEPARTS if certain else Standing.UNREAD)

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
        if _FACTOR.match(piece):
            raise Unreadable("What the factor is worth is not known.")
        return (read_number(piece, self.parameters),)

    def _grid(self, piece: str, shape: tuple[int, int]) -> Entries:
        read_ = [entry for line in read_matrix(piece, shape, self.parameters) for entry in line]
        given = tuple(entry for entry in read_ if entry is not None)
        if len(given) < len(read_):
            raise Unreadable("Entries are left out; give them too.")
        return given

    def _placed(self, text: str, label: str, sides: Sequence[Entries | None], told: bool) -> Line:
        standing = Standing.FOLLOWS if self.values else Standing.RIGHT
        last = next(side for side in reversed(sides) if side is not None)
        if sides == [last] and not _CHANGED.search(text) and self._is_given(label, last):
            return Line(text, standing)
        named = self._named(label, len(last))
        for number in named or self._order(len(last)):
            if self._all_same(last, self.expected[number]):
                self.reached = max(self.reached, number)
                return Line(text, standing, self.search.applications[number])
        holds = any(side is not None and self._holds_letter(*side) for side in sides)
        if self._is_beside(label, last) if named else (holds and len(sides) > 1) or self._is_known(last):
            return Line(text, standing)
        if not told and (named or not (label or holds or None in sides)):
            return self._departed(text, named, last)
        return Line(text, Standing.UNREAD)

    def _is_beside(self, label: str, last: Entries) -> bool:
        """Whether another step of that name gives it: one that the solver writes, of a run that is only supposed."""
        steps = (line for line in self.search.work.lines if isinstance(line, Step) and line.value is not None)
        same = (step for step in steps if self._all_same(last, numbers(step.value) or ()))
        return any(_plain_name(label) in _names(step) for step in same)

    def _is_given(self, label: str, last: Entries) -> bool:
        """Whether it says what was known before a step, r₁ = 3 or V(cave) = 8."""
        return any(self._all_same(last, [value]) for value in self._givens.get(_spelled(label), ()))

    @cached_property
    def _givens(self) -> Mapping[str, Sequence[Any]]:
        tables = {id(table): (code, table) for each in self.search.applications for code, table in each.known.items()}
        found: dict[str, list[Any]] = {}
        for code, table in tables.values():
            for key, value in table.items() if isinstance(table, Mapping) else ():
                keys = list(map(str, key if isinstance(key, tuple) else (key,)))
                for name in (f"{code}({','.join(keys)})", *([f"{code}{key}"] if isinstance(key, int) else [])):
                    found.setdefault(_spelled(name), []).extend([value] if plain(value) else [])
        return found

    def _is_known(self, last: Entries) -> bool:
        """Whether it is worked out on the way, or found in the end."""
        inner = ([value] for number in self._order() for value in self.between[number])
        return any(self._all_same(last, values) for every in (inner, self.found) for values in every)

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
            number
            for number in self._order(len(last))
            if any(self._all_same(side, self.expected[number]) for side in sides)
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
            if _all_near(typed, became := numbers(cause.became) or ()) and self._all_same(typed, became)
        ]
        if line is not None:
            found = by_the_numbers(application, found, line)
        if not found:
            return ()
        found.sort(key=lambda cause: -cause.weight)
        best = found[0].weight
        return tuple(cause for cause in found if cause.weight >= best / 2)[:2]

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
        self.values[number] = of_numbers(right, [entry.value for entry in entries])
        self.reached = max(self.reached, number)
        trace: list[Traced] = []
        answers = self.search.replay(Change(values=dict(self.values)), trace)
        self.found = list(_groups(answers or {}))
        self.expected |= {
            at: found for at, _, _, came in trace if at in self.expected and (found := numbers(came)) is not None
        }
        for at, right, known, _ in trace:
            if at in self.between:
                self.between[at] = list(_places(right, known))

    def _order(self, long: int | None = 1) -> list[int]:
        """The steps that a line of so many numbers can give, those that come next first."""
        steps = [number for number, entries in self.expected.items() if long is None or len(entries) == long]
        return [each for each in steps if each > self.reached] + [each for each in steps if each <= self.reached]

    def _named(self, label: str, long: int | None = None) -> list[int]:
        """The steps whose quantity has that name, those that come next first."""
        wanted = _plain_name(label)
        if not wanted:
            return []
        named = [(each, _names(self.search.applications[each].step)) for each in self._order(long)]
        plainer = _plain_name(_SCRIPT.sub(r"\1", label)), _MARKS.sub("", wanted)  # V' may be the new V
        for name in (wanted, *plainer):
            if steps := [each for each, names in named if name in names]:
                return steps
        return []


def _is_array(value: Any) -> bool:
    return isinstance(value, Vector) or is_matrix(value)


def _shape(value: Any) -> tuple[int, int]:
    return (1, len(list(value))) if isinstance(value, Vector) else (value.nrows(), value.ncols())


def _of_an_equation(application: Application, given: Any) -> Iterator[Cause]:
    """What can be done where the right side of an equation is worked out, with the values that solve the system."""
    if application.equation:
        for cause in at_one(replace(application, equation=False), given):
            yield replace(cause, application=application)


def _all_near(entries: Entries, values: Sequence[Any]) -> bool:
    return len(entries) == len(values) and all(
        near(approximate(value), approximate(one.value)) for one, value in zip(entries, values, strict=True)
    )


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
    """The numbers of a value as they may be written: one by one, and those of a vector or matrix together."""
    if isinstance(value, Mapping | tuple):
        for inner in value.values() if isinstance(value, Mapping) else value:
            yield from _groups(inner)
    elif together := numbers(value):
        yield together
        yield from ([each] for each in together)


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


def _names(step: Step) -> set[str]:
    """The names under which somebody may write a step."""
    left = typeset(step.left)
    time = step.known.get("t")
    names = set()
    for written in {_plain_name(_signs(math)) for math in (left, *_without_scripts(left))}:
        head = re.sub(r"\(.*", "", written)
        names |= {written, re.sub(r"[(),]", "", written), head}
        if len(indices := {*re.findall(r"\d+", written.removeprefix(head))}) == 1:
            names.add(head + indices.pop())  # r1 for r(s_1)
        if isinstance(time, int):
            names |= {f"{head}{time}", re.sub("t(?![a-z])", str(time), written)}
    return names


def _without_scripts(left: Math) -> Iterator[Math]:
    """The name without what stands above its first sign, V(s) for V^π(s), and below it, where more comes."""
    match left:
        case Row((Script(body, _, _), *others)) if others:
            yield Row((body, *others))
            yield from (Row((first, *others)) for first in _without_scripts(left.items[0]))
        case Script(body, below, _):
            yield Script(body, below)


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
        case Fence(body, left, right):
            return f"{left}{_signs(body)}{right}"
        case Root(body) | Accent(body, _):
            return _signs(body)
        case Big(sign, _, _):
            return sign
        case _:
            return ""


def _plain_name(label: str) -> str:
    return _spelled(label).lower()


def _spelled(label: str) -> str:
    name = re.sub(r"[\s_{}^]|new", "", "".join(sign for sign in normalize("NFKD", label) if not combining(sign)))
    for spelled, letter in _WORDS.items():
        name = name.replace(spelled, letter)
    return name
