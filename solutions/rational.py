"""Rational functions of one open parameter, over flint's polynomials."""

from dataclasses import dataclass
from functools import cache
from math import gcd, lcm
from typing import Any

import sympy
from flint import fmpq, fmpq_poly


@dataclass(frozen=True, slots=True)
class RationalFunction:
    """A quotient of polynomials in one parameter, in lowest terms, the lower one monic.

    Made by ``quotient``, so that what does not depend on the parameter is a plain ``fmpq``. It costs a
    tenth of what sympy's own fields do.
    """

    parameter: str
    top: fmpq_poly
    bottom: fmpq_poly

    def __add__(self, other: Any) -> Any:
        other = _lifted(self.parameter, other)
        if not isinstance(other, RationalFunction):
            return sympy.sympify(self, strict=True) + other if isinstance(other, sympy.Expr) else NotImplemented
        if self.bottom == other.bottom:
            return quotient(self.parameter, self.top + other.top, self.bottom)
        return quotient(self.parameter, self.top * other.bottom + other.top * self.bottom, self.bottom * other.bottom)

    __radd__ = __add__

    def __neg__(self) -> "RationalFunction":
        return RationalFunction(self.parameter, -self.top, self.bottom)

    def __sub__(self, other: Any) -> Any:
        return self + -other

    def __rsub__(self, other: Any) -> Any:
        return -self + other

    def __mul__(self, other: Any) -> Any:
        other = _lifted(self.parameter, other)
        if not isinstance(other, RationalFunction):
            return sympy.sympify(self, strict=True) * other if isinstance(other, sympy.Expr) else NotImplemented
        return quotient(self.parameter, self.top * other.top, self.bottom * other.bottom)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Any:
        other = _lifted(self.parameter, other)
        if not isinstance(other, RationalFunction):
            return sympy.sympify(self, strict=True) / other if isinstance(other, sympy.Expr) else NotImplemented
        return quotient(self.parameter, self.top * other.bottom, self.bottom * other.top)

    def __rtruediv__(self, other: Any) -> Any:
        return _inverse(self) * other

    def __pow__(self, exponent: int) -> Any:
        if exponent < 0:
            return _inverse(self) ** -exponent
        return quotient(self.parameter, self.top**exponent, self.bottom**exponent)

    def __call__(self, point: fmpq) -> fmpq:
        """The value at a point.

        Raises:
            ZeroDivisionError: there is none.
        """
        return self.top(point) / self.bottom(point)

    @property
    def coefficients(self) -> tuple[fmpq, ...]:
        """All coefficients that are not zero, as they are written: whole numbers if there is a quotient."""
        top, bottom = self._written()
        return tuple(c for poly in (top, bottom) for c in poly.coeffs() if c)

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


def quotient(parameter: str, top: fmpq_poly, bottom: fmpq_poly) -> Any:
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


def _inverse(value: RationalFunction) -> Any:
    return quotient(value.parameter, value.bottom, value.top)


def _lifted(parameter: str, value: Any) -> Any:
    """A rational as a function that does not depend on the parameter; what is neither stays as it is."""
    if isinstance(value, int | fmpq):
        return RationalFunction(parameter, fmpq_poly([value]), fmpq_poly([1]))
    if isinstance(value, RationalFunction) and value.parameter != parameter:
        return sympy.sympify(value, strict=True)
    return value


def _polynomial(parameter: str, poly: fmpq_poly) -> sympy.Expr:
    letter = sympy.Symbol(parameter, positive=True)
    return sympy.Add(
        *(sympy.Rational(int(c.p), int(c.q)) * letter**power for power, c in enumerate(poly.coeffs()) if c)
    )


@cache
def generator(parameter: str) -> RationalFunction:
    """The open parameter itself, as a rational function."""
    return RationalFunction(parameter, fmpq_poly([0, 1]), fmpq_poly([1]))
