"""How long the numbers of a working may be: what is longer nobody writes, and it would take too long."""

from collections.abc import Iterator
from math import log2
from typing import Any, TypeVar

from flint import fmpq

from rldrill.problems.grammar import WHOLE_DIGITS
from rldrill.solutions.exact import TooLong, length, terms
from rldrill.solutions.matrices import is_matrix
from rldrill.solutions.vector import Vector

Written = TypeVar("Written")

#: The most decimal digits of a whole number in a working. Python writes no more than 4300, and what is written of a
#: step may hold the products of two numbers.
MOST_DIGITS = WHOLE_DIGITS
_LONGEST = MOST_DIGITS * log2(10)
#: The most terms of a polynomial in a parameter that is left open.
MOST_TERMS = 64


def bounded(value: Written) -> Written:
    """A value, alone or in a vector, matrix or table, that can be written down.

    Raises:
        TooLong: a number in it has more digits than anybody writes, and than Python turns into text; or a polynomial
            more terms.
    """
    for number in (value,) if isinstance(value, fmpq) else _numbers(value):
        if (number.height_bits() if isinstance(number, fmpq) else length(number)) > _LONGEST:
            raise TooLong(
                f"its working has numbers of more than {MOST_DIGITS} digits, the most that are written; "
                "give shorter numbers, or fewer steps, sweeps or rewards"
            )
        if terms(number) > MOST_TERMS:
            raise TooLong(
                f"with a parameter left open its working has polynomials of more than {MOST_TERMS} terms, the most "
                "that are written; give the parameter a value, or fewer steps, sweeps or rewards"
            )
    return value


def _numbers(value: Any) -> Iterator[Any]:
    if type(value) is fmpq:
        yield value
    elif isinstance(value, dict):
        for item in value.values():
            yield from _numbers(item)
    elif isinstance(value, tuple | list | Vector):
        for item in value:
            yield from _numbers(item)
    elif is_matrix(value):
        yield from value.entries()
    else:
        yield value
