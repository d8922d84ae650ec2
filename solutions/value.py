"""What an exact number is, whatever it is made of; what can be asked of it is in ``exact``."""

import copyreg
from typing import Any, Protocol

from flint import fmpq_mat, fmpq_poly


class Value(Protocol):
    """An exact number, with the arithmetic of fractions.

    There are three forms: flint's ``fmpq`` where it is rational, ``RationalFunction`` where a parameter is open, and
    an expression of sympy's where it is neither.
    """

    def __add__(self, other: "Value | int", /) -> "Value": ...
    def __radd__(self, other: "Value | int", /) -> "Value": ...
    def __sub__(self, other: "Value | int", /) -> "Value": ...
    def __rsub__(self, other: "Value | int", /) -> "Value": ...
    def __mul__(self, other: "Value | int", /) -> "Value": ...
    def __rmul__(self, other: "Value | int", /) -> "Value": ...
    def __truediv__(self, other: "Value | int", /) -> "Value": ...
    def __rtruediv__(self, other: "Value | int", /) -> "Value": ...
    def __pow__(self, exponent: int, /) -> "Value": ...
    def __neg__(self) -> "Value": ...
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...


class NoSolution(ArithmeticError):
    """The values given have no answer: a singular matrix, a system without a solution."""


class NotSolved(NoSolution):
    """What is asked for may well have an answer, but not one that is found here."""


class NotGiven(LookupError):
    """A formula asks for something that the problem does not give."""


class TooLong(NoSolution):
    """A number of the working is longer than anybody writes, though the values given may well have an answer."""


class NotReal(NoSolution):
    """It is no real number, or one too close to zero to tell from it."""


def _put_away(polynomial: fmpq_poly) -> tuple[Any, ...]:
    return fmpq_poly, (polynomial.coeffs(),)


def _put_away_matrix(matrix: fmpq_mat) -> tuple[Any, ...]:
    return fmpq_mat, (matrix.nrows(), matrix.ncols(), matrix.entries())


# Flint does not say how these are put away, for another process.
copyreg.pickle(fmpq_poly, _put_away)
copyreg.pickle(fmpq_mat, _put_away_matrix)
