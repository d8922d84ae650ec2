"""What somebody writes down between a formula and its value: the parts of its lines, and some of them together."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import combinations
from typing import Any

from msgspec import Struct
from sympy import Add, Expr, Mul

from rldrill.solutions.diagnosis.alternatives import value_or_none
from rldrill.solutions.diagnosis.replay import UNDONE
from rldrill.solutions.diagnosis.typed import approximate
from rldrill.solutions.diagnosis.written_line import Numbers, apart, numbers_in
from rldrill.solutions.exact import simplest, tidy
from rldrill.solutions.formula.edits import probes
from rldrill.solutions.formula.lines import lines_between
from rldrill.solutions.formula.nodes.leaves import Leaf, MatrixLeaf
from rldrill.solutions.formula.notation import SumOver
from rldrill.solutions.formula.putting_in import put_in
from rldrill.solutions.rational import generator

#: Of more terms or factors than this no neighbours are taken together.
_TOGETHER = 8


class Place(Struct, frozen=True):
    """A number that is worked out on the way.

    Args:
        worth: the number, as sympy has it.
        parts: what it is the value of; several terms or factors where they are neighbours of others.
    """

    worth: Expr
    parts: tuple[Expr, ...]

    @property
    def whole(self) -> bool:
        """Whether it has brackets, or a place in a sum, of its own."""
        return len(self.parts) == 1

    @property
    def value(self) -> Any:
        """The number; with a letter in it, a fraction of polynomials."""
        if not self.worth.free_symbols:
            return simplest(tidy(self.worth))
        letters = {str(symbol): generator(str(symbol)) for symbol in self.worth.free_symbols}
        return simplest(value_or_none(self.worth, letters))

    @property
    def size(self) -> float:
        """What it is worth, roughly."""
        return approximate(self.value)

    def apart(self, line: Numbers) -> int:
        """How many numbers stand in a line or in what this is the value of, and not in both."""
        written = sum((numbers_in(part) for part in self.parts), Numbers())
        return min(apart(written, line), apart(worked_out(*self.parts), line))


def worked_out(*parts: Expr) -> Numbers:
    """The numbers of a sum or product of parts, when each term or factor of it is worked out."""
    inner = parts if len(parts) > 1 else (parts[0].args if parts[0].is_Add or parts[0].is_Mul else parts)
    worths = [worth for part in inner if part != -1 and (worth := _worth(part)) is not None]
    return sum(map(numbers_in, worths), Numbers())


def lines(right: Expr, known: Mapping[str, Any], *, own: bool = False) -> Sequence[Expr]:
    """The lines of a step from the numbers put in to the last before its value."""
    try:
        first = put_in(right, known)
        return list(dict.fromkeys((first, *lines_between(first, own=own))))
    except UNDONE:
        return []


def places(right: Expr, known: Mapping[str, Any], *, own: bool = False) -> list[Place]:
    """Every number that is worked out between a formula and its value, in every way in which it is written."""
    written = [*lines(right, known, own=own), *_parts(right, known)]
    return list({(place.worth, place.parts): place for line in written for place in _in(line)}.values())


def _parts(right: Expr, known: Mapping[str, Any]) -> Iterator[Expr]:
    """The parts of the formula itself that stand in no sum, with the numbers put in: a sum among other terms."""
    for probe in probes(right):
        if not probe.within and (probe.part.is_Add or isinstance(probe.part, SumOver)):
            with suppress(*UNDONE):
                yield put_in(probe.part, known)


def _in(part: Expr) -> Iterator[Place]:
    worth = _worth(part)
    if worth is not None and not isinstance(part, Leaf) and not part.is_Number:
        yield Place(worth, (part,))
    if isinstance(part, Leaf):
        return
    inner = part.args[:1] if part.is_Pow else part.args
    for each in inner:
        if isinstance(each, Expr):
            yield from _in(each)
    if part.is_Mul and inner[0] == -1:  # the bracket of −(a + b) opened
        for each in inner:
            opened = zip(each.args, map(_worth, each.args), strict=True) if each.is_Add else ()
            yield from (Place(-value, (term,)) for term, value in opened if value is not None)
    if part.is_Add or part.is_Mul:
        kept = [each for each in inner if each != -1]
        worths = [_worth(each) for each in kept]
        if len(kept) <= _TOGETHER:
            for first, last in combinations(range(len(kept) + 1), 2):
                some = worths[first:last]
                if 1 < len(some) < len(inner) and None not in some:
                    worth = (Add if part.is_Add else Mul)(*some)
                    yield Place(worth, tuple(kept[first:last]))
                    if part.is_Add and all(each is not None and each.is_negative for each in some):  # 6 + 3 in −6 − 3
                        yield Place(-worth, tuple(kept[first:last]))


def _worth(part: Expr) -> Expr | None:
    """The value of what is put in; None where it is no number."""
    if isinstance(part, MatrixLeaf):
        return part.args[0][0] if part.scalar else None
    if isinstance(part, Leaf):
        return part.args[0] if part.args else None
    if not part.args:
        return part
    worths = [_worth(each) if isinstance(each, Expr) else None for each in part.args]
    if None in worths:
        return None
    symbolic = getattr(part, "symbolic", part.func)
    try:
        worth = symbolic(*worths)
    except ValueError:  # of an own number the logarithm need not be real, and then there is no greatest
        return None
    return worth if isinstance(worth, Expr) and worth.is_finite is not False else None
