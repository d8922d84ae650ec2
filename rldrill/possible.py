"""Which wrong answers are told in a list: none that the statement itself rules out, for nobody hands them in."""

import math
import re
from collections.abc import Iterator
from decimal import Decimal
from operator import le, lt
from typing import Any

from msgspec import Struct

from rldrill.exercise import Exercise
from rldrill.problems.document import Paragraph
from rldrill.problems.mathematics import Glyph, Math, Row
from rldrill.problems.parts import Part
from rldrill.render.mathematics.unicode import inline
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.exact import decimal, parameters

#: What a statement says of a letter: 0 < p < 1.
_BOUNDS = re.compile(r"(\d+) ([<≤]) (\w) ([<≤]) (\d+)")
#: The letter that is asked for, and what it is called: What is the discount γ?
_ASKED = re.compile(r"[Ww]hat is (?:the ([\w ]+) )?(\w)\?")
#: What is called so lies between 0 and 1, whether the statement says it or not.
_SHARES = frozenset({"discount", "exploration rate", "probability"})
#: The same, said before: The probability q is unknown.
_UNKNOWN = re.compile(rf"[Tt]he (?:{'|'.join(sorted(_SHARES))}) (\w) is (?:unknown|not known)")
_PROBABILITIES = frozenset({Glyph("p", "variable"), Glyph("π", "variable"), Glyph("Pr", "word")})
_SIGNS = {"<": lt, "≤": le}
_DIGITS = 12


class _Range(Struct, frozen=True):
    """Between which numbers another one must lie; the signs say whether it may be one of them."""

    low: Decimal = Decimal(0)
    high: Decimal = Decimal(1)
    below: str = "≤"
    above: str = "≤"

    def holds(self, value: Any) -> bool:
        """Whether a number lies there; an expression in a parameter may, and what is no number does."""
        if isinstance(value, str | tuple | bool) or parameters(value):
            return True
        number = Decimal(decimal(value, _DIGITS) or self.low)
        return _SIGNS[self.below](self.low, number) and _SIGNS[self.above](number, self.high)


#: What is not divided by its sum may exceed 1, but no probability is negative, however it is found.
_PROBABILITY = _Range(high=Decimal(math.inf))


def is_possible(exercise: Exercise, part: Part, value: Any) -> bool:
    """Whether the statement leaves room for an answer: no probability is negative, and 0 < p < 1 where it says so."""
    kind, ranges = answer_kind(part.kind), list(_ranges(exercise, part))
    cells, lines = list(kind.cells(value).values()), kind.lines(value)
    if len(lines) == len(cells) and any(_is_probability(left) for left, _ in lines):
        ranges.append(_PROBABILITY)
    return all(each.holds(cell) for cell in cells for each in ranges)


def _ranges(exercise: Exercise, part: Part) -> Iterator[_Range]:
    ask = inline(part.ask)
    asked = _ASKED.search(ask)
    if asked is None:
        return
    texts = (inline(block.text) for block in exercise.question() if isinstance(block, Paragraph))
    told = " ".join((*texts, ask))
    if asked[1] in _SHARES or asked[2] in _UNKNOWN.findall(told):
        yield _Range()
    for low, below, letter, above, high in _BOUNDS.findall(told):
        if letter == asked[2]:
            yield _Range(Decimal(low), Decimal(high), below, above)


def _is_probability(left: Math | None) -> bool:
    return isinstance(left, Row) and left.items[0] in _PROBABILITIES
