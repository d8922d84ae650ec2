"""Rational functions of one open parameter, over flint's polynomials."""

import operator
from collections.abc import Callable, Sequence
from functools import cache
from math import gcd, lcm
from typing import Any, TypeAlias

import sympy
from flint import fmpq, fmpq_poly
from msgspec import Struct

from rldrill.solutions.closed_forms import rational
from rldrill.solutions.value import NoSolution, NotReal, NotSolved, Value

_ONE = fmpq_poly([1])
_Operation: TypeAlias = Callable[["RationalFunction", "RationalFunction"], Value]


class RationalFunction(Struct, frozen=True):
    """A quotient of polynomials in one parameter, in lowest terms, the lower one monic.

    Made by ``quotient``, so that what does not depend on the parameter is a plain ``fmpq``. It costs a
    tenth of what sympy's own fields do.
    """

    parameter: str
    top: fmpq_poly
    bottom: fmpq_poly

    def __add__(self, other: Value | int) -> Value:
        if isinstance(other, fmpq):
            return RationalFunction(self.parameter, self.top + self.bottom * other, self.bottom)
        return self._with(other, operator.add, _sum)

    __radd__ = __add__

    def __neg__(self) -> "RationalFunction":
        return RationalFunction(self.parameter, -self.top, self.bottom)

    def __sub__(self, other: Value | int) -> Value:
        return self + -other

    def __rsub__(self, other: Value | int) -> Value:
        return -self + other

    def __mul__(self, other: Value | int) -> Value:
        if isinstance(other, fmpq):
            return RationalFunction(self.parameter, self.top * other, self.bottom) if other else other
        return self._with(other, operator.mul, _product)

    __rmul__ = __mul__

    def __truediv__(self, other: Value | int) -> Value:
        return self * (fmpq(1) / other)

    def __rtruediv__(self, other: Value | int) -> Value:
        return self**-1 * other

    def __pow__(self, exponent: int) -> Value:
        above, below = (self.top, self.bottom) if exponent >= 0 else (self.bottom, self.top)
        return quotient(self.parameter, above ** abs(exponent), below ** abs(exponent))

    def _with(self, other: Value | int, of_closed: Callable[[Any, Any], Value], of_functions: _Operation) -> Value:
        """An operation with any value: what holds another parameter as well, or a root, becomes an expression."""
        if isinstance(other, int | fmpq):
            other = lifted(other, self.parameter)
        if isinstance(other, RationalFunction) and other.parameter == self.parameter:
            return of_functions(self, other)
        if isinstance(other, RationalFunction | sympy.Expr):
            return of_closed(sympy.sympify(self, strict=True), sympy.sympify(other, strict=True))
        return NotImplemented

    def __call__(self, point: fmpq | None) -> fmpq:
        """The value at a point.

        Raises:
            NotReal: no point is given, or it is a pole.
        """
        if point is None:
            raise NotReal(f"{self.parameter} is left open")
        below = self.bottom(point)
        if below == 0:
            raise NotReal(f"there is a pole at {point}")
        return self.top(point) / below

    @property
    def coefficients(self) -> tuple[fmpq, ...]:
        """All coefficients that are not zero, as they are written: whole numbers if there is a quotient."""
        top, bottom = self._written()
        return tuple(c for poly in (top, bottom) for c in poly.coeffs() if c)

    def bits(self) -> int:
        """How many binary digits the longest whole number of its polynomials has."""
        every = (self.top, self.bottom)
        return max(*(poly.numer().height_bits() for poly in every), *(int(poly.denom()).bit_length() for poly in every))

    def _written(self) -> tuple[fmpq_poly, fmpq_poly]:
        """Top and bottom with whole coefficients, unless the bottom is 1; what is below begins with a plus."""
        if self.bottom.degree() == 0:
            return self.top, self.bottom
        every = [c for poly in (self.top, self.bottom) for c in poly.coeffs() if c]
        scale = fmpq(lcm(*(int(c.q) for c in every)))
        shared = gcd(*(int((c * scale).p) for c in every))
        if next(c for c in self.bottom.coeffs() if c) < 0:  # 1 − γ, not −1 + γ
            shared = -shared
        return self.top * scale / shared, self.bottom * scale / shared

    def _sympy_(self) -> sympy.Expr:
        top, bottom = (_polynomial(self.parameter, poly) for poly in self._written())
        return top / bottom


def quotient(parameter: str, top: fmpq_poly, bottom: fmpq_poly) -> Value:
    """A quotient of polynomials in lowest terms; a plain ``fmpq`` where the parameter drops out.

    Raises:
        ZeroDivisionError: the lower polynomial is zero.
    """
    if bottom.degree() > 0:
        common = top.gcd(bottom)
        if common.degree() > 0:
            top, bottom = top // common, bottom // common
    if not bottom:
        raise ZeroDivisionError("a quotient of polynomials with 0 below")
    leading = bottom[bottom.degree()]
    if leading != 1:
        top, bottom = top / leading, bottom / leading
    if top.degree() <= 0 and bottom.degree() == 0:
        return top[0]
    return RationalFunction(parameter, top, bottom)


def lifted(value: Value | int, parameter: str = "") -> RationalFunction:
    """A rational as a function that does not depend on the parameter; what is a function already stays as it is."""
    return value if isinstance(value, RationalFunction) else RationalFunction(parameter, fmpq_poly([value]), _ONE)


def _sum(a: RationalFunction, b: RationalFunction) -> Value:
    if a.bottom == b.bottom:
        return quotient(a.parameter, a.top + b.top, a.bottom)
    return quotient(a.parameter, a.top * b.bottom + b.top * a.bottom, a.bottom * b.bottom)


def _product(a: RationalFunction, b: RationalFunction) -> Value:
    return quotient(a.parameter, a.top * b.top, a.bottom * b.bottom)


def _polynomial(parameter: str, poly: fmpq_poly) -> sympy.Expr:
    letter = sympy.Symbol(parameter, positive=True)
    return sympy.Add(*(rational(c) * letter**power for power, c in enumerate(poly.coeffs()) if c))


@cache
def generator(parameter: str) -> RationalFunction:
    """The open parameter itself, as a rational function."""
    return RationalFunction(parameter, fmpq_poly([0, 1]), _ONE)


def with_found(value: Value, found: Value) -> Value:
    """A value with what was found for its parameter put in.

    Raises:
        NoSolution: no rational number was found, or the value has a pole there.
    """
    if not isinstance(value, RationalFunction):
        return value
    if not isinstance(found, fmpq):
        raise NoSolution(f"no rational number was found for {value.parameter}")
    return value(found)


def linear(value: Value, parameter: str) -> tuple[Value, Value]:
    """The a and b for which a·x + b = 0 where the value, a function of the parameter x, is zero.

    Raises:
        NoSolution: the value does not depend on the parameter.
        NotSolved: it does so, but not linearly.
    """
    coefficients = _coefficients(value, parameter)
    if coefficients is None:
        raise NoSolution(f"{parameter} falls out of the equation that it is to be found from; change what is given")
    if len(coefficients) == 1:
        raise NoSolution(f"no value of {parameter} solves the equation; change the numbers that are given")
    if len(coefficients) != 2:
        raise NotSolved(f"the equation for {parameter} is not linear, and is not solved; change what is given")
    constant, slope = coefficients
    return slope, constant


def _coefficients(value: Value, parameter: str) -> Sequence[Value] | None:
    """The coefficients of what is above the line, the constant first; None where the parameter is nowhere."""
    if isinstance(value, RationalFunction):
        return value.top.coeffs() if value.parameter == parameter else None
    letter = sympy.Symbol(parameter, positive=True)
    if not isinstance(value, sympy.Expr) or letter not in value.free_symbols:
        return None
    above = sympy.numer(sympy.together(value))
    poly = sympy.Poly(above, letter) if above.is_polynomial(letter) else None
    return () if poly is None else poly.all_coeffs()[::-1]


def without_quotients(left: Value, right: Value, parameter: str) -> tuple[Value, Value] | None:
    """Both sides of an equation multiplied by their common denominator, in whole numbers; equal numerators dropped.

    None, where the parameter is in no denominator, or where the sides are then not linear in it.
    """
    if not all(isinstance(side, fmpq | RationalFunction) for side in (left, right)):
        return None
    if all(lifted(side, parameter).bottom.degree() == 0 for side in (left, right)):
        return None
    below = [common_denominator((side,)) for side in (left, right)]
    if below[0] is not None and below[1] is not None and left * below[0] == right * below[1] != 0:
        return below[0], below[1]  # a/x = a/7 where x = 7
    factor = common_denominator((left, right))
    if factor is None:
        return None
    tops = [lifted(side * factor, parameter).top for side in (left, right)]
    if max(top.degree() for top in tops) > 1:
        return None
    return left * factor, right * factor


def common_denominator(values: Sequence[Value]) -> Value | None:
    """What values are multiplied by to have no denominators; None where a root or a second letter is among them."""
    letters = {value.parameter for value in values if isinstance(value, RationalFunction)}
    if len(letters) > 1 or not all(isinstance(value, fmpq | RationalFunction) for value in values):
        return None
    parameter = next(iter(letters), "")
    functions = [lifted(value, parameter) for value in values]
    below = _ONE
    for function in functions:
        below = below * function.bottom // below.gcd(function.bottom)
    scale = lcm(*(int((function.top * (below // function.bottom)).denom()) for function in functions))
    if next(c for c in below.coeffs() if c) < 0:  # 1 − γ, not −1 + γ
        scale = -scale
    return quotient(parameter, below * scale, _ONE)
