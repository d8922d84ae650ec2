"""What stands before the powers of letters in an expression, above the line and below it."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice
from typing import NamedTuple

import sympy
from flint import fmpq, fmpq_poly

from rldrill.solutions.exact import Value, is_rational, simplest, to_sympy
from rldrill.solutions.rational import RationalFunction

#: An expression of more parts than this, and of more powers together, is not multiplied out.
_MOST_PARTS, _MOST_POWERS = 60, 6


class Place(NamedTuple):
    """Powers of the letters in their order, in what stands above the line or in what stands below."""

    powers: tuple[int, ...]
    below: bool


def coefficients(value: Value, letters: Sequence[str]) -> Mapping[Place, Value] | None:
    """The numbers, none of them 0, of a quotient of polynomials in lowest terms, in letters and their logarithms.

    None if the value is no such quotient, or a long one of numbers that are no fractions, as nobody types.

    Args:
        value: the value.
        letters: all letters that are in it, and perhaps others.
    """
    none = (0,) * (2 * len(letters))
    if is_rational(value):
        above = [(none, value)]
        below: Iterable[tuple[tuple[int, ...], Value]] = [(none, fmpq(1))]
    elif isinstance(value, RationalFunction):
        one = (*(letter == value.parameter for letter in letters), *[False] * len(letters))
        above, below = list(_terms(value.top, one)), _terms(value.bottom, one)
    else:
        symbols = [sympy.Symbol(letter, positive=True) for letter in letters]
        logarithms = [sympy.Symbol(f"ln {letter}") for letter in letters]
        expression = to_sympy(value)
        if any(log.free_symbols for log in expression.atoms(sympy.log)):  # ln(2x) is ln 2 + ln x
            named = dict(zip(map(sympy.log, symbols), logarithms, strict=True))
            expression = sympy.expand_log(expression).xreplace(named)
        symbols += logarithms
        if not expression.is_rational_function(*symbols) or not _is_short(expression):
            return None
        if not expression.has(sympy.Function, sympy.NumberSymbol) and not any(
            map(_is_root, expression.atoms(sympy.Pow))
        ):
            parts = sympy.fraction(sympy.cancel(expression, *symbols))
        elif expression.is_polynomial(*symbols):
            parts = expression, sympy.S.One
        else:
            return None  # among roots and logarithms to look for what is common takes long
        above, below = (
            [(powers, simplest(number)) for powers, number in sympy.Poly(part, *symbols).terms()] for part in parts
        )
    numbers = {
        Place(powers, under): number for under, terms in ((False, above), (True, below)) for powers, number in terms
    }
    return {place: number for place, number in numbers.items() if number != 0}


def _is_short(expression: sympy.Expr) -> bool:
    """Whether an expression is multiplied out in no time."""
    parts = list(islice(sympy.preorder_traversal(expression), _MOST_PARTS + 1))
    powers = [part.exp for part in parts if part.is_Pow and part.exp.is_Integer]
    return len(parts) <= _MOST_PARTS and sum(map(abs, powers)) <= _MOST_POWERS


def _is_root(power: sympy.Pow) -> bool:
    return not power.exp.is_Integer


def _terms(poly: fmpq_poly, one: Sequence[bool]) -> Iterator[tuple[tuple[int, ...], Value]]:
    for power, number in enumerate(poly.coeffs()):
        yield tuple([power * each for each in one]), number
