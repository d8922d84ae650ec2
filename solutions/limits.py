"""How long the numbers of a working may be: what is longer nobody writes, and it would take too long."""

from collections.abc import Iterable
from math import log2
from typing import Any, TypeVar

import sympy
from flint import fmpq

from rldrill.problems.grammar import WHOLE_DIGITS
from rldrill.solutions.exact import TooLong, length, terms
from rldrill.solutions.matrices import is_matrix
from rldrill.solutions.vector import Vector

Written = TypeVar("Written")

#: The most decimal digits of a whole number in a working. Python writes no more than 4300, and what is written of a
#: step may hold the products of two numbers.
MOST_DIGITS = WHOLE_DIGITS
_LONGEST = int(MOST_DIGITS * log2(10))
#: The most decimal digits of a number whose root is taken: squares in it are looked for by way of floats.
MOST_UNDER_A_ROOT = 300
#: The most terms of a polynomial in a parameter that is left open.
MOST_TERMS = 64


def bounded(value: Written) -> Written:
    """A value, alone or in a vector, matrix or table, that can be written down.

    Raises:
        TooLong: a number in it has more digits than anybody writes, and than Python turns into text; or a polynomial
            more terms.
    """
    if not isinstance(value, fmpq) or value.height_bits() > _LONGEST:
        _check((value,))
    return value


def rooted(value: Written) -> Written:
    """A value of which a root can be written down.

    Raises:
        TooLong: a number in it has too many digits for that.
    """
    if length(value) > MOST_UNDER_A_ROOT * log2(10):
        raise TooLong(
            f"its working takes the root of a number of more than {MOST_UNDER_A_ROOT} digits, the most of which one is "
            "written; give shorter numbers"
        )
    return value


def raised(exponent: sympy.Expr) -> sympy.Expr:
    """An exponent, the power of e of which can be written down: e^(k ln n) is nᵏ, a number as long as k is large.

    Raises:
        TooLong: a logarithm in it is multiplied by too large a number.
    """
    for term in sympy.Add.make_args(exponent):
        factor, rest = term.as_coeff_Mul()
        if isinstance(rest, sympy.log) and length(rest.args[0]) * abs(factor) > _LONGEST:
            raise _too_many_digits()
    return exponent


def _check(values: Iterable[Any]) -> None:
    for value in values:
        if type(value) is fmpq:
            if value.height_bits() > _LONGEST:
                raise _too_many_digits()
        elif isinstance(value, dict):
            _check(value.values())
        elif isinstance(value, str):
            continue
        elif isinstance(value, tuple | list | Vector):
            _check(value)
        elif is_matrix(value):
            _check(value.entries())
        elif length(value) > _LONGEST:
            raise _too_many_digits()
        elif terms(value) > MOST_TERMS:
            raise TooLong(
                f"with a parameter left open its working has polynomials of more than {MOST_TERMS} terms, the most "
                "that are written; give the parameter a value, or fewer steps, sweeps or rewards"
            )


def _too_many_digits() -> TooLong:
    return TooLong(
        f"its working has numbers of more than {MOST_DIGITS} digits, the most that are written; "
        "give shorter numbers, or fewer steps, sweeps or rewards"
    )
