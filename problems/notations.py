"""Other courses' notations, and decimal commas: what is written is rewritten on its way to the page; IDs stay."""

import re
import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache, cached_property, lru_cache
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

from msgspec import Struct
from msgspec.structs import fields, replace

from rldrill.problems.errors import UsageError
from rldrill.problems.mathematics import Fence, Fraction, Glyph, Math, Name, Row, Script, mathematics, own, row, signs

#: The notation that everything is written in unless another one is asked for.
LECTURE = "lecture"
_ANYTHING = frozenset("①②③")
_NUMBERS = frozenset("ⓣⓝ")
#: What mathematics begins with that stays as the lecture writes it.
AS_IT_STANDS = "!"
_TIMES = re.compile(r"t|k|T|[0-9]+")
_INDEXED = re.compile(r"(?P<stem>[^\W\d_])(?P<index>[₀-₉]*[′']*)")

#: What is capital in Sutton & Barto's notation, or a return in the lecture's, and a matrix elsewhere.
_AMBIGUOUS = tuple(Glyph(letter, "variable") for letter in "Rsa")
_OF_LINEAR_SYSTEMS = tuple(Glyph(letter, "variable") for letter in "BL")
_REWARD, _STATE_AND_ACTION = Glyph("r", "variable"), mathematics("(s_ⓣ, a_ⓣ)")

_COMMA, _SEMICOLON = Glyph(",", "punctuation"), Glyph(";", "punctuation")
#: A number with decimals; no date, and no part of a name.
_DECIMALS = re.compile(r"(?<![\w.])([0-9]+)\.([0-9]+)(?![\w.]*\w)")


class Writing(NamedTuple):
    """How mathematics is written: the name of the notation, and the sign before the decimals."""

    notation: str = LECTURE
    mark: str = "."


#: How everything is written unless something else is asked for.
PLAIN = Writing()
_in_use: ContextVar[Writing] = ContextVar("writing", default=PLAIN)


class Notation(Struct, frozen=True, dict=True):
    """One notation.

    Args:
        about: what is different in it.
        lines: patterns, and what they become; a pattern may hold ①, ②, ③, ⓣ and ⓝ.
        letters: letters that are others everywhere.
    """

    about: str
    lines: tuple[tuple[Math, Math], ...]
    letters: Mapping[str, str]

    @cached_property
    def takes(self) -> Set[str]:
        """The letters that are others in it."""
        return {*self.letters} | _letters(left for left, _ in self.lines)

    @cached_property
    def gives(self) -> Set[str]:
        """The letters that it has for them."""
        return {*self.letters.values()} | _letters(right for _, right in self.lines)


def _letters(written: Iterable[Math]) -> set[str]:
    return {match["stem"] for math in written for sign in signs(math) if (match := _INDEXED.fullmatch(sign))}


@cache
def notations() -> Mapping[str, Notation]:
    """All notations beside the lecture's, by name."""
    data = tomllib.loads((Path(__file__).parent / "notations.toml").read_text(encoding="utf-8"))
    return {
        name: Notation(
            table["about"],
            tuple((mathematics(left), mathematics(right)) for left, right in table["lines"]),
            table["letters"],
        )
        for name, table in data.items()
    }


def in_use() -> Writing:
    """How mathematics is written now."""
    return _in_use.get()


def use(name: str) -> None:
    """Write in that notation from now on.

    Raises:
        UsageError: there is none of that name.
    """
    _in_use.set(Writing(known(name)))


@contextmanager
def used(name: str, mark: str = ".") -> Iterator[None]:
    """Write in that notation for a while, with that sign before the decimals.

    Raises:
        UsageError: there is none of that name.
    """
    token = _in_use.set(Writing(known(name), mark))
    try:
        yield
    finally:
        _in_use.reset(token)


def known(name: str) -> str:
    """The notation of that name, as it is spelled.

    Raises:
        UsageError: there is none.
    """
    wanted = name.strip().lower()
    if wanted != LECTURE and wanted not in notations():
        raise UsageError(f"There is no notation {name[:40]!r}; there are {LECTURE}, {', '.join(notations())}.")
    return wanted


def takes(letters: Set[str], written: Iterable[Math]) -> bool:
    """Whether the notation in use takes one of these letters, or has it for something else that is written."""
    name = _in_use.get().notation
    if name == LECTURE or letters.isdisjoint(notations()[name].takes | notations()[name].gives):
        return False
    given = (_letters((_translated(name, math, False),)) - _letters((math,)) for math in written)
    return not letters.isdisjoint(notations()[name].takes) or any(not letters.isdisjoint(each) for each in given)


def read_mathematics(text: str) -> Math:
    """Mathematics of a text; with ``!`` before it, it stays as the lecture writes it."""
    found = mathematics(text.removeprefix(AS_IT_STANDS))
    return as_it_stands(found) if text.startswith(AS_IT_STANDS) else found


def as_it_stands(math: Any) -> Any:
    """Mathematics without the letters of a notation: every one that some notation takes is the problem's own."""
    if isinstance(math, Glyph):
        match = _INDEXED.fullmatch(math.text) if math.style == "variable" else None
        return own(math.text) if match and match["stem"] in _taken() else math
    if isinstance(math, tuple):
        return tuple(map(as_it_stands, math))
    if not isinstance(math, Struct):
        return math
    return replace(math, **{field.name: as_it_stands(getattr(math, field.name)) for field in fields(math)})


@cache
def _taken() -> Set[str]:
    return {letter for notation in notations().values() for letter in notation.takes}


def in_notation(math: Math) -> Math:
    """Mathematics of the lecture, in the notation in use."""
    return all_in_notation((math,))[0]


def all_in_notation(together: Sequence[Math], *, linear: bool = False) -> tuple[Math, ...]:
    """Mathematics that stands together; it is of a linear system if that is said, or if any of it tells."""
    name, mark = _in_use.get()
    if name != LECTURE:
        linear = linear or any(map(is_linear, together))
        together = [_translated(name, math, linear) for math in together]
    return tuple(together if mark == "." else map(_with_commas, together))


def with_mark(text: str) -> str:
    """Text without mathematics, with the decimal mark in use in its numbers."""
    return text if _in_use.get().mark == "." else _DECIMALS.sub(r"\1,\2", text)


@lru_cache(maxsize=4096)
def _with_commas(math: Any) -> Any:
    """Mathematics with decimal commas; semicolons part what stands beside such a number."""
    if isinstance(math, Glyph):
        return replace(math, text=math.text.replace(".", ",")) if math.style == "number" else math
    if isinstance(math, tuple):
        inside = tuple(map(_with_commas, math))
        parted = any(isinstance(item, Glyph) and item.style == "number" and "," in item.text for item in inside)
        return tuple(_SEMICOLON if item == _COMMA else item for item in inside) if parted else inside
    if not isinstance(math, Struct):
        return math
    return replace(math, **{field.name: _with_commas(getattr(math, field.name)) for field in fields(math)})


@lru_cache(maxsize=4096)
def _translated(name: str, math: Math, linear: bool) -> Math:
    notation = notations()[name]
    lines = notation.lines
    if linear:  # A_t and R_t are matrices there
        lines = tuple(line for line in lines if not _may_be_matrix(line[0]))
    return _rewritten(replace(notation, lines=lines), math)


def _may_be_matrix(pattern: Math) -> bool:
    return isinstance(pattern, Script) and pattern.body in _AMBIGUOUS


@lru_cache(maxsize=4096)
def is_linear(math: Any) -> bool:
    """Whether something is of linear systems: it has a transpose, the matrix B, the gain L or the reward r(sₜ, aₜ)."""
    if isinstance(math, Script) and math.above == Glyph("T", "word"):
        return True
    items = math.items if isinstance(math, Row) else ()
    if any(left == _REWARD and _fits(_STATE_AND_ACTION, right, {}) for left, right in pairwise(items)):
        return True
    return math in _OF_LINEAR_SYSTEMS or any(map(is_linear, _children(math)))


def _children(math: Any) -> Iterator[Any]:
    for field in fields(math):
        value = getattr(math, field.name)
        yield from _within(value)


def _within(value: Any) -> Iterator[Any]:
    if isinstance(value, tuple):
        for item in value:
            yield from _within(item)
    elif isinstance(value, Struct):
        yield value


def _rewritten(notation: Notation, math: Any) -> Any:
    for pattern, becomes in notation.lines:
        found: dict[str, Math] = {}
        if _fits(pattern, math, found):
            return _filled(becomes, {sign: _rewritten(notation, part) for sign, part in found.items()})
    if isinstance(math, Glyph):
        return _relettered(notation, math)
    if isinstance(math, Row):  # what a line becomes may be several things side by side
        return row(*(_rewritten(notation, item) for item in math.items)) if math.items else math
    return replace(math, **{field.name: _inside(notation, getattr(math, field.name)) for field in fields(math)})


def _inside(notation: Notation, value: Any) -> Any:
    if isinstance(value, tuple):
        return tuple(_inside(notation, item) for item in value)
    return _rewritten(notation, value) if isinstance(value, Struct) else value


def _relettered(notation: Notation, glyph: Glyph) -> Glyph:
    match = _INDEXED.fullmatch(glyph.text) if glyph.style == "variable" and not isinstance(glyph, Name) else None
    if match is None or match["stem"] not in notation.letters:
        return glyph
    return Glyph(notation.letters[match["stem"]] + match["index"], "variable")


def _fits(pattern: Any, math: Any, found: dict[str, Math]) -> bool:
    """Whether mathematics has the form of a pattern; what its signs stand for is put into ``found``."""
    if isinstance(pattern, Glyph) and pattern.text in _ANYTHING | _NUMBERS:
        if not (_is_time(math) if pattern.text in _NUMBERS else _is_named(math)):
            return False
        return found.setdefault(pattern.text, math) == math
    if isinstance(pattern, tuple):
        return (
            isinstance(math, tuple)
            and len(pattern) == len(math)
            and all(_fits(one, other, found) for one, other in zip(pattern, math, strict=True))
        )
    if not isinstance(pattern, Struct):
        return bool(pattern == math)
    return type(pattern) is type(math) and all(
        _fits(getattr(pattern, field.name), getattr(math, field.name), found) for field in fields(pattern)
    )


def _is_time(math: Any) -> bool:
    first = math.items[0] if isinstance(math, Row) and math.items else math
    return isinstance(first, Glyph) and _TIMES.fullmatch(first.text) is not None


def _is_named(math: Any) -> bool:
    """Whether something is no number, no operator and not nothing."""
    if isinstance(math, Glyph):
        return math.style in ("variable", "word")
    return isinstance(math, Script | Row | Fence | Fraction)


def _filled(becomes: Any, found: Mapping[str, Math]) -> Any:
    if isinstance(becomes, Glyph):
        return found.get(becomes.text, becomes)
    if isinstance(becomes, Row):
        return row(*(_filled(item, found) for item in becomes.items))
    if isinstance(becomes, tuple):
        return tuple(_filled(item, found) for item in becomes)
    if not isinstance(becomes, Struct):
        return becomes
    return replace(becomes, **{f.name: _filled(getattr(becomes, f.name), found) for f in fields(becomes)})
