"""An equation of higher degree in one letter, solved where one root alone can be what the letter stands for."""

from collections.abc import Iterator

import sympy
from flint import fmpq, fmpq_poly, fmpz_poly

from rldrill.problems.exact import ALWAYS_SHARES, PARAMETERS
from rldrill.solutions.exact import to_sympy
from rldrill.solutions.rational import RationalFunction, quotient
from rldrill.solutions.value import NoSolution, NotSolved, Value

#: A step size is not 0.
_NOT_0 = "alpha"


def degree(value: Value, letter: str) -> int:
    """The highest power of a letter in a value, as a rational function of it; 0 where it is none."""
    return value.top.degree() if isinstance(value, RationalFunction) and value.parameter == letter else 0


def only_root(value: RationalFunction, *, share: bool, positive: bool) -> tuple[fmpq, str]:
    """The one number that a letter can be where a function of it is zero, and where such a letter lies.

    Args:
        value: the function.
        share: whether the letter lies between 0 and 1, whatever it is called.
        positive: whether it is above 0.

    Raises:
        NoSolution: it can be no number.
        NotSolved: it can be several numbers, or one that is no fraction.
    """
    share = share or value.parameter in ALWAYS_SHARES
    positive = positive or value.parameter == _NOT_0
    where = " between 0 and 1" if share else " above 0" if positive else ""
    found = [
        root
        for root in _real_roots(value.top.numer())
        if not ((share and not 0 <= root <= 1) or (positive and root <= 0))
    ]
    named = f"{PARAMETERS.get(value.parameter, value.parameter)}{where}"
    if not found:
        raise NoSolution(f"no {named} solves the equation; change the numbers that are given")
    if len(found) > 1:
        raise NotSolved(f"more than one {named} solves the equation; change the numbers that are given")
    if not isinstance(found[0], fmpq):
        raise NotSolved(
            f"the {named} that solves the equation is no fraction, and of an equation of higher degree only fractions "
            "are found; change the numbers that are given"
        )
    return found[0], where


def _real_roots(poly: fmpz_poly) -> Iterator[fmpq]:
    """Every real root once, as a fraction or an enclosure."""
    for factor, _ in poly.factor()[1]:
        if factor.degree() == 1:
            yield fmpq(-factor[0], factor[1])
        else:
            yield from (root.real for root, _ in factor.complex_roots() if root.imag == 0)


def as_zeros(value: RationalFunction) -> tuple[Value, sympy.Expr]:
    """What is zero where a function is: a polynomial in the smallest whole numbers, and the product that it is."""
    above, factors = value.top.numer(), value.top.numer().factor()[1]
    smallest = above // (above.content() * (1 if above[above.degree()] > 0 else -1))
    written = [(to_sympy(_function(value.parameter, factor)), power) for factor, power in factors]
    powers = [factor if power == 1 else sympy.Pow(factor, power, evaluate=False) for factor, power in written]
    return _function(value.parameter, smallest), sympy.Mul(*powers, evaluate=False)


def _function(letter: str, poly: fmpz_poly) -> Value:
    return quotient(letter, fmpq_poly(poly), fmpq_poly([1]))
