"""An equation with one unknown, solved wrongly."""

from collections.abc import Iterator
from typing import Any

from rldrill.solutions.diagnosis.replay import Equated
from rldrill.solutions.exact import is_rational, is_zero
from rldrill.solutions.rational import RationalFunction

#: The number before the unknown, and the one without it.
Side = tuple[Any, Any]


def missolved(equation: Equated) -> Iterator[tuple[str, Any]]:
    """What else comes out for the unknown of a·x + b = c·x + d by a slip on the way, and by which."""
    left, right = _side(equation.left, equation.letter), _side(equation.right, equation.letter)
    if left is None or right is None:
        return
    (a, b), (c, d) = left, right
    slope, number, sum_ = a - c, d - b, a + c
    if is_zero(slope):
        return
    if not is_zero(b) and not is_zero(d):
        if not is_zero(a):
            yield "number-moved", (d + b) / slope
        if not is_zero(c):
            yield "number-moved", (d + b) / (c - a)
    if not is_zero(a) and not is_zero(c) and not is_zero(sum_):
        yield "unknown-moved", number / sum_
        yield "unknown-moved", (b - d) / sum_
    yield "multiplied", number * slope


def _side(side: Any, letter: str) -> Side | None:
    """A side of an equation as a straight line; None where it is none."""
    if is_rational(side):
        return side - side, side
    if not isinstance(side, RationalFunction) or side.parameter != letter:
        return None
    if side.bottom.degree() > 0 or side.top.degree() > 1:
        return None
    return side.top[1] / side.bottom[0], side.top[0] / side.bottom[0]
