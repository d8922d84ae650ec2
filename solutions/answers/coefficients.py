"""What stands before the powers of letters in an expression, above the line and below it."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice
from typing import NamedTuple

import sympy
from flint import fmpq, fmpq_poly

from rldrill.solutions.exact import Value, is_rational, simplest, to_sympy
from rldrill.solutions.rational import RationalFunction

_MOST_PARTS, _MOST_POWER = 60, 4


class Place(NamedTuple):
    """Powers of the letters in their order, in what stands above the line or in what stands below."""

    powers: tuple[int, ...]
    below: bool


def coefficients(value: Value, letters: Sequence[str]) -> Mapping[Place, Value] | None:
    """The numbers, none of them 0, of a quotient of polynomials in lowest terms.

    None if the value is no such quotient, or a long one of numbers that are no fractions, as nobody types.

    Args:
        value: the value.
        letters: all letters that are in it, and perhaps others.
    """
    if is_rational(value):
        above = [((0,) * len(letters), value)]
        below: Iterable[tuple[tuple[int, ...], Value]] = [((0,) * len(letters), fmpq(1))]
    elif isinstance(value, RationalFunction):
        one = tuple(letter == value.parameter for letter in letters)
        above, below = list(_terms(value.top, one)), _terms(value.bottom, one)
    else:
        expression, symbols = to_sympy(value), [sympy.Symbol(letter, positive=True) for letter in letters]
        if not expression.is_rational_function(*symbols) or not _is_short(expression):
            return None
        above, below = (
            [(powers, simplest(number)) for powers, number in sympy.Poly(part, *symbols).terms()]
            for part in sympy.fraction(sympy.cancel(expression, *symbols))
        )
    numbers = {
        Place(powers, under): number for under, terms in ((False, above), (True, below)) for powers, number in terms
    }
    return {place: number for place, number in numbers.items() if number != 0}


def _is_short(expression: sympy.Expr) -> bool:
    """Whether an expression is multiplied out in no time."""
    parts = list(islice(sympy.preorder_traversal(expression), _MOST_PARTS + 1))
    powers = [part.exp for part in parts if part.is_Pow and part.exp.is_Integer]
    return len(parts) <= _MOST_PARTS and all(abs(power) <= _MOST_POWER for power in powers)


def _terms(poly: fmpq_poly, one: Sequence[bool]) -> Iterator[tuple[tuple[int, ...], Value]]:
    for power, number in enumerate(poly.coeffs()):
        yield tuple([power * each for each in one]), number
