"""Exact values: rationals, rational functions of one open parameter, and sympy's closed forms."""

from collections.abc import Iterable
from fractions import Fraction
from typing import Any, TypeAlias

import sympy
from flint import arb, ctx, fmpq

from rldrill.problems.exact import Logarithm, Parameter, Weight
from rldrill.solutions import surds
from rldrill.solutions.exponentials import lowest_terms, vanishes
from rldrill.solutions.rational import RationalFunction, generator

#: ``fmpq`` where it is rational, ``RationalFunction`` where a parameter is open, else a sympy expression.
Value: TypeAlias = Any


class NoSolution(ArithmeticError):
    """The values given have no answer: a singular matrix, a system without a solution."""


ZERO = fmpq(0)
ONE = fmpq(1)


def monomial(expression: sympy.Expr) -> Value:
    """A rational multiple of a power of one open parameter as a rational function; anything else stays as it is."""
    factor, power = expression.as_coeff_Mul()
    base, exponent = power.as_base_exp()
    if factor.is_Rational and base.is_Symbol and exponent.is_Integer:
        return simplest(factor) * generator(base.name) ** int(exponent)
    return expression


def exact(number: Weight | int) -> Value:
    """A given's number as a value to compute with."""
    if isinstance(number, Logarithm):
        return sympy.log(to_sympy(exact(number.of)))
    if isinstance(number, Parameter):
        open_ = generator(number.symbol)
        return 1 - open_ if number.complement else open_
    if isinstance(number, int):
        return fmpq(number)
    return fmpq(number.numerator, number.denominator)


def to_sympy(value: Value) -> sympy.Expr:
    """Any exact value as a sympy expression."""
    if isinstance(value, fmpq):
        return sympy.Rational(int(value.numerator), int(value.denominator))
    return value if isinstance(value, sympy.Expr) else sympy.sympify(value, strict=True)


def ordered(expression: sympy.Expr) -> sympy.Expr:
    """A computed sum with its terms as one writes them by hand: the constant, then rising powers."""
    if not expression.is_Add:
        return expression
    letters = tuple(expression.free_symbols)
    return sympy.Add(*sorted(expression.args, key=lambda term: _rank(term, letters)), evaluate=False)


def in_one_quotient(expression: sympy.Expr) -> sympy.Expr:
    """A computed expression in powers of e as one quotient in lowest terms: 2/(2 + e), not 1 − e/(2 + e)."""
    if not expression.has(sympy.exp, sympy.E):
        return expression
    reduced = None if expression.free_symbols else lowest_terms(expression)
    return reduced if reduced is not None else sympy.together(expression) if expression.is_Add else expression


def _rank(term: sympy.Expr, letters: tuple[sympy.Symbol, ...]) -> tuple[int, object]:
    """The degree in the letters that are left open; without any, in what stands in their place, such as e."""
    degree = sympy.total_degree(term, *letters) if term.is_polynomial(*(letters or term.free_symbols)) else 99
    return int(degree), sympy.default_sort_key(term)


def from_sympy(expression: sympy.Expr) -> Value:
    """A sympy expression as an exact value: rationals become flint's."""
    return fmpq(int(expression.p), int(expression.q)) if expression.is_Rational else expression


def simplest(value: Value) -> Value:
    """The same value, as a plain rational where no parameter is left in it; yes and no stay what they are."""
    if isinstance(value, int) and not isinstance(value, bool):
        return fmpq(value)
    if isinstance(value, Fraction):
        return fmpq(value.numerator, value.denominator)
    if isinstance(value, sympy.Expr) and value.is_Rational:
        return from_sympy(value)
    return value


def tidy(value: Value) -> Value:
    """A number of square roots (and π) as one writes it: multiplied out, no root below the line; others as they are."""
    if not isinstance(value, sympy.Expr) or value.is_Atom:
        return value
    surd = surds.read(value)
    return value if surd is None else surds.write(surd)


def parameters(value: Value) -> frozenset[str]:
    """The names of the parameters that are left open in a value."""
    if isinstance(value, fmpq):
        return frozenset()
    if isinstance(value, RationalFunction):
        return frozenset((value.parameter,))
    return frozenset(free.name for free in to_sympy(value).free_symbols)


def is_zero(value: Value) -> bool:
    """Whether the value is exactly zero."""
    return sign(value) == 0 if isinstance(value, sympy.Expr) and not value.free_symbols else value == 0


_ARB_FUNCTIONS = {sympy.exp: arb.exp, sympy.log: arb.log, sympy.sin: arb.sin, sympy.cos: arb.cos,
                  sympy.tan: arb.tan, sympy.atan: arb.atan, sympy.Abs: abs}  # fmt: skip


def enclosure(value: Value, at: fmpq | None = None) -> arb:
    """A ball that is certain to hold the value, at the working precision of ``flint.ctx``.

    Args:
        value: an exact value.
        at: what to put in for the open parameter.

    Raises:
        ValueError: the expression holds something that has no real value.
    """
    if isinstance(value, fmpq):
        return arb(value)
    if isinstance(value, RationalFunction) and at is not None:
        return arb(value(at))
    return _ball(to_sympy(value), at)


def _ball(expression: sympy.Expr, at: fmpq | None) -> arb:
    if expression.is_Rational:
        return arb(fmpq(int(expression.p), int(expression.q)))
    if expression.is_Symbol:
        if at is None:
            raise ValueError(f"{expression} is left open")
        return arb(at)
    if expression is sympy.E:
        return arb(1).exp()
    if expression is sympy.pi:
        return arb.pi()
    balls = [_ball(argument, at) for argument in expression.args]
    if expression.is_Add:
        return sum(balls[1:], balls[0])
    if expression.is_Mul:
        product = arb(1)
        for ball in balls:
            product *= ball
        return product
    if expression.is_Pow:
        exponent = expression.args[1]
        if exponent.is_Integer:
            return balls[0] ** int(exponent)
        return balls[0].sqrt() if exponent == sympy.S.Half else balls[0] ** balls[1]
    if expression.func in _ARB_FUNCTIONS:
        return _ARB_FUNCTIONS[expression.func](balls[0])
    if isinstance(expression, sympy.Max):
        largest = balls[0]
        for ball in balls[1:]:
            largest = largest.max(ball)
        return largest
    raise ValueError(f"{expression.func.__name__} has no real value here")


def magnitude(value: Value) -> int:
    """The power of ten at the first digit of a real value that is not zero; it may be off by one.

    Raises:
        ValueError: it has no real value, or one too close to zero to tell.
    """
    before = ctx.prec
    try:
        for precision in (64, 256, 1024):
            ctx.prec = precision
            ball = abs(enclosure(value))
            if ball.is_finite() and ball > 0:
                return int((ball.log() / arb(10).log()).mid().floor().unique_fmpz())
    finally:
        ctx.prec = before
    raise ValueError(f"{value} cannot be told from zero, or is no real number")


def sign(value: Value, at: fmpq | None = None) -> int:
    """−1, 0 or 1: the exact sign of a real value.

    Raises:
        ValueError: the value is not a real number.
    """
    if isinstance(value, fmpq):
        return (value > 0) - (value < 0)
    for precision in (64, 256, 1024):
        if found := clear_sign(value, at, precision):
            return found
    expression = to_sympy(value) if at is None else to_sympy(value).subs(
        {free: to_sympy(at) for free in to_sympy(value).free_symbols}
    )  # fmt: skip
    if vanishes(expression) or expression.equals(0):
        return 0
    raise ValueError(f"{expression} is not a real number that can be told from zero")


def clear_sign(value: Value, at: fmpq | None, precision: int) -> int:
    """−1 or 1 if a real value is that far from zero that so many bits show it, else 0.

    Raises:
        ValueError: the value is not a real number.
    """
    before = ctx.prec
    try:
        ctx.prec = precision
        ball = enclosure(value, at)
    finally:
        ctx.prec = before
    return int(ball > 0) - int(ball < 0) if ball.is_finite() else 0


def largest(values: Iterable[Value]) -> Value:
    """The greatest of some real values."""
    best, *rest = values
    for value in rest:
        try:
            if sign(value - best) > 0:
                best = value
        except ValueError:
            raise NoSolution("which is the greatest depends on what is left open") from None
    return best


def decimal(value: Value, digits: int = 6) -> str | None:
    """The value as a decimal of at most ``digits`` significant digits; None while a parameter is open."""
    if parameters(value):
        return None
    number = float(to_sympy(value).evalf(digits + 10))
    return f"{number:.{digits}g}"
