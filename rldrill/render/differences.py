"""Two lines of mathematics that are nearly the same, and where they differ: as text, and as mathematics."""

import re
from difflib import SequenceMatcher
from itertools import zip_longest
from typing import Any, TypeAlias

from msgspec.structs import fields, replace

from rldrill.problems.document import Equation
from rldrill.problems.mathematics import Fence, Glyph, Marked, Math, Row, is_sign, row
from rldrill.render.mathematics.unicode import ABOVE, BELOW

#: A piece of a line, and whether the other line has another one there, or none.
Piece: TypeAlias = tuple[str, bool]

_SMALL = re.escape("".join((*BELOW.values(), *ABOVE.values(), "′")))
#: What is not torn apart: a letter with its mark, indices and powers, a number, a word.
_TOKEN = re.compile(rf"\s+|\d+(?:[./]\d+)*|(?:[A-Za-z]+|\w)[\u0300-\u036f]*[{_SMALL}]*|.", re.DOTALL)


def differences(one: str, two: str) -> tuple[tuple[Piece, ...], tuple[Piece, ...]]:
    """Both lines in pieces, those marked that the other one has not."""
    before, after = _TOKEN.findall(one), _TOKEN.findall(two)
    changes = SequenceMatcher(None, before, after, autojunk=False).get_opcodes()
    return (
        tuple(("".join(before[start:end]), tag != "equal") for tag, start, end, _, _ in changes if start < end),
        tuple(("".join(after[start:end]), tag != "equal") for tag, _, _, start, end in changes if start < end),
    )


def marked(wrong: Equation, right: Equation) -> Equation:
    """The wrong equation, marked where the right one differs; where something is missing, what it is missing from."""
    pairs = zip_longest(wrong.rights, right.rights[-len(wrong.rights) :], fillvalue=Row(()))
    return replace(wrong, rights=tuple(_marked(one, other) for one, other in pairs))


def _marked(wrong: Math, right: Math) -> Math:
    if wrong == right:
        return wrong
    if isinstance(wrong, Row) or isinstance(right, Row):
        return row(*_marked_items(_items(wrong), _items(right)))
    if type(wrong) is not type(right) or isinstance(wrong, Glyph):
        return Marked(wrong)
    inside = {field.name: (getattr(wrong, field.name), getattr(right, field.name)) for field in fields(wrong)}
    if not all(_alike(*pair) for pair in inside.values()):
        return Marked(wrong)
    return replace(wrong, **{name: _inside(*pair) for name, pair in inside.items()})


def _items(math: Math) -> tuple[Math, ...]:
    return math.items if isinstance(math, Row) else (math,)


def _alike(wrong: Any, right: Any) -> bool:
    """Whether two parts of the same kind of mathematics are both mathematics, or tables of one shape, or equal."""
    if isinstance(wrong, tuple) and isinstance(right, tuple):
        return len(wrong) == len(right) and all(map(_alike, wrong, right))
    return wrong == right or not (wrong is None or right is None or isinstance(wrong, str))


def _inside(wrong: Any, right: Any) -> Any:
    if isinstance(wrong, tuple):
        return tuple(map(_inside, wrong, right))
    return wrong if wrong == right else _marked(wrong, right)


def _marked_items(wrong: tuple[Math, ...], right: tuple[Math, ...]) -> list[Math]:
    result: list[Math] = []
    gap = False
    for tag, start, end, other, stop in SequenceMatcher(None, wrong, right, autojunk=False).get_opcodes():
        found = list(wrong[start:end])
        if tag == "replace":
            same = end - start == stop - other
            found = list(map(_marked, found, right[other:stop])) if same else _one(found)
        elif tag == "delete":
            found = _one(found)
        if gap and result and is_sign(found[0]):  # what is missing is missing from a term
            result[-1] = Marked(result[-1])
        elif gap:
            width = 1 + (len(found) > 1 and isinstance(found[1], Fence))
            found[:width] = [Marked(row(*found[:width]))]
        gap = tag == "insert"
        result += found
    if gap and result:
        result[-1] = Marked(result[-1])
    return result


def _one(items: list[Math]) -> list[Math]:
    """Things that are other than they should be, as one; the sign before a term stays as it is."""
    signs = 1 if len(items) > 1 and is_sign(items[0]) else 0
    return [*items[:signs], Marked(row(*items[signs:]))]
