"""Exact arithmetic that refuses, before it begins, whatever would take long."""

import operator
from collections.abc import Callable, Sequence
from typing import Any

import sympy
from flint import arb, fmpq

from rldrill.problems.spelling import Unreadable
from rldrill.solutions.closed_forms import Point, folded
from rldrill.solutions.closed_forms import exponent as exponent_of
from rldrill.solutions.exact import (
    ONE,
    Value,
    bits,
    degree,
    enclosure,
    is_closed,
    is_rational,
    monomial,
    parameters,
    simplest,
    to_sympy,
)
from rldrill.solutions.rational import generator
from rldrill.solutions.value import NotReal

_EFFORT = 3000  # in hundredths of a millisecond, as measured
_ENTRIES = 2, 16  # so many share that effort, and so many have as much each
_CONVERSION = 30
_BITS = 4000
_RATIONAL_BITS = 14_000  # of a quotient of the longest whole numbers
_DEGREE = 24
# degree, levels and bits of what a function is taken of, with a parameter in it and without
_OPEN, _CLOSED = (4, 2, 100), (0, 4, 400)
_EXPONENT, _RATIONAL_EXPONENT = 64, 1000
_GROWTH = 100  # of the exponent of e
_ROOT = 12  # the highest root
_RADICAND = 40  # the digits of what it is taken of
_ANGLE = 1000
_TURNS = frozenset({1, 2, 3, 4, 6, 12})  # pi over these has a sine that is short to write
_LARGE = "A number in it grows too large; write it in a simpler form."
_DEEP = "Functions stand too deep in one another; write it in a simpler form."


class Arithmetic:
    """Sums, products, powers and functions of exact numbers, until a fixed effort is used up.

    Args:
        entries: how many numbers are read with it.
    """

    def __init__(self, entries: int = 1) -> None:
        together, most = _ENTRIES
        self._left = _EFFORT * max(together, min(entries, most)) // together

    def parameter(self, name: str) -> Value:
        """An open parameter, by its name in files."""
        return generator(name)

    def add(self, a: Value, b: Value) -> Value:
        """The sum of two numbers."""
        return self._bounded(operator.add, a, b)

    def negate(self, a: Value) -> Value:
        """The number with the other sign."""
        return self._bounded(operator.neg, a)

    def multiply(self, a: Value, b: Value) -> Value:
        """The product of two numbers."""
        return self._bounded(operator.mul, a, b)

    def divide(self, a: Value, b: Value) -> Value:
        """The quotient of two numbers."""
        if b == 0:
            raise Unreadable("It divides by zero.")
        if is_closed(b) and not parameters(b) and _ball(b).contains(0):
            raise Unreadable("It divides by what cannot be told from zero; write it in a simpler form.")
        return self._bounded(operator.truediv, a, b)

    def power(self, base: Value, exponent: Value) -> Value:
        """A number raised to an exponent: a whole number, a small fraction, or anything over e."""
        if base == sympy.E:
            return self._exp(exponent)
        if not is_rational(exponent):
            raise Unreadable("Only e is raised to such an exponent; write a whole number or a fraction there.")
        above, below = int(exponent.p), int(exponent.q)
        if (raised := exponent_of(base)) is not None:
            return self._exp(self.multiply(self._lift(raised), exponent))
        if below > _ROOT:
            raise Unreadable(f"Exponents are whole numbers or fractions down to 1/{_ROOT}; use exp and ln for others.")
        largest = _RATIONAL_EXPONENT if is_rational(base) and below == 1 else _EXPONENT
        if abs(above) > largest:
            raise Unreadable(f"The exponent is too large; {largest} is the largest that is read.")
        return self._whole_power(base if below == 1 else self._root(base, below), above)

    def call(self, name: str, arguments: Sequence[Value]) -> Value:
        """A function of some numbers, by its name in ``notation.FUNCTIONS``."""
        first = arguments[0]
        if name == "sqrt":
            return self._root(first, 2)
        if name == "exp":
            return self._exp(first)
        if name in ("ln", "log"):
            return self._log(first)
        if name == "abs":
            return self.negate(first) if self._clear_sign(first) < 0 else first
        if name in ("max", "min"):
            wanted = 1 if name == "max" else -1
            for other in arguments[1:]:
                if self._clear_sign(self.add(other, self.negate(first))) == wanted:
                    first = other
            return first
        return self._circular(name, first)

    def finish(self, number: Value) -> Value:
        """A number as the simplest kind of exact value that holds it."""
        number = self._lift(number)
        if is_closed(number) and not parameters(number):
            _ball(number)
        return number

    def _spend(self, effort: int) -> None:
        self._left -= effort
        if self._left < 0:
            raise Unreadable("It would take too long to work out; write it in a simpler form.")

    def _bounded(self, operation: Callable[..., Value], *numbers: Value) -> Value:
        """What an operation gives, if it is small and a real number."""
        closed = any(map(is_closed, numbers))
        if closed and sum(map(bits, numbers)) > _BITS:
            raise Unreadable(_LARGE)
        self._spend((_CONVERSION if closed else 4) * sum(map(degree, numbers)))
        return self._settled(operation(*numbers))

    def _settled(self, number: Any) -> Value:
        size = bits(number)
        if size > (_RATIONAL_BITS if is_rational(number) else _BITS) or degree(number) > _DEGREE:
            raise Unreadable(_LARGE)
        if not is_closed(number):
            return number
        if number.has(sympy.nan, sympy.zoo, sympy.oo, -sympy.oo, sympy.I):
            raise Unreadable("A part of it is not a real number.")
        self._spend((80 if number.free_symbols else 40) + size // 2)
        return simplest(number)

    def _whole_power(self, base: Value, exponent: int) -> Value:
        if bits(base) * abs(exponent) > _BITS or degree(base) * abs(exponent) > _DEGREE:
            raise Unreadable(_LARGE)
        if exponent < 0:
            return self.divide(ONE, self._whole_power(base, -exponent))
        return self._bounded(lambda number: number**exponent, base)

    def _root(self, number: Value, index: int) -> Value:
        if (raised := exponent_of(number)) is not None:
            return self._exp(self.multiply(self._lift(raised), fmpq(1, index)))
        if self._sign(number) < 0:
            raise Unreadable("A root of a negative number is not a real number.")
        if is_rational(number):
            largest = max(int(number.p), int(number.q))
            if largest > 10**_RADICAND:
                raise Unreadable(f"A root is read of numbers of at most {_RADICAND} digits; write a decimal.")
            self._spend(100 if largest < 10**6 else 400 if largest < 10**12 else 1200)
        elif index != 2:
            raise Unreadable("Only square roots are read of such a number; write a decimal.")
        nested = self._nested(number)
        return self._settled(sympy.Pow(nested, sympy.Rational(1, index), evaluate=_is_plain(nested)))

    def _exp(self, exponent: Value) -> Value:
        if abs(_ball(exponent, lambda _: fmpq(1, 2))) > _GROWTH:
            raise Unreadable(f"The exponent is too large; with e, {_GROWTH} is the largest that is read.")
        nested = self._nested(exponent)
        return self._settled(sympy.exp(nested, evaluate=_is_plain(nested)))

    def _log(self, number: Value) -> Value:
        if self._sign(number, unknown=1) <= 0:
            raise Unreadable("Only a number above zero has a logarithm.")
        self._spend(100)
        if (raised := exponent_of(number)) is not None:
            return self._lift(raised)
        nested = self._nested(number)
        return self._settled(sympy.log(nested, evaluate=_is_plain(nested)))

    def _circular(self, name: str, angle: Value) -> Value:
        self._spend(200)
        expression = self._nested(angle)
        if expression.free_symbols:
            raise Unreadable(f"{name} is read of numbers only; write the answer without it.")
        if abs(_ball(expression)) > _ANGLE:
            raise Unreadable(f"{name} is read of angles up to {_ANGLE}; write a smaller angle.")
        turns = expression / sympy.pi
        short = not turns.is_Rational or int(turns.q) in _TURNS
        return self._settled(getattr(sympy, name)(expression, evaluate=short))

    def _nested(self, number: Value) -> Any:
        """The argument of a function, for which sympy's time doubles with each function within."""
        self._spend(_CONVERSION * degree(number))
        expression = to_sympy(number)
        highest, levels, size = _OPEN if parameters(number) else _CLOSED
        if _levels(expression) >= levels:
            raise Unreadable(_DEEP)
        if degree(number) > highest or bits(number) > size:
            raise Unreadable(_LARGE)
        if is_closed(number) and not parameters(number) and _ball(number).contains(0):
            raise Unreadable("A part of it cannot be told from zero; write it in a simpler form.")
        return expression

    def _sign(self, number: Value, unknown: int = 0) -> int:
        """The sign of a number; ``unknown`` where it depends on a parameter, 0 where it is too close to zero."""
        if parameters(number):
            return unknown
        ball = _ball(number)
        return int(ball > 0) - int(ball < 0)

    def _clear_sign(self, number: Value) -> int:
        sign = self._sign(number)
        if sign == 0 and number != 0:
            raise Unreadable("abs, max and min are read of numbers that differ clearly; write out which it is.")
        return sign

    def _lift(self, number: Value) -> Value:
        """An expression in which the irrational parts have gone, as a rational function or a rational number."""
        if not is_closed(number) or len(parameters(number)) > 1 or not _is_ratio(number):
            return number
        return folded(number, monomial, self.add, self.multiply, self._whole_power)


def _levels(expression: sympy.Expr) -> int:
    """How deep functions, roots and quotients stand in one another."""
    deepest = max((_levels(argument) for argument in expression.args), default=0)
    power = expression.is_Pow and expression.args[1].is_Integer and expression.args[1].is_positive
    return deepest if not expression.args or expression.is_Add or expression.is_Mul or power else deepest + 1


def _is_ratio(expression: sympy.Expr) -> bool:
    return all(
        part.is_Add or part.is_Mul or part.is_Symbol or part.is_Rational or (part.is_Pow and part.args[1].is_Integer)
        for part in sympy.preorder_traversal(expression)
    )


def _is_plain(argument: sympy.Expr) -> bool:
    """Whether sympy knows at once what a function of it is, and does not search for its sign."""
    factors = sympy.Mul.make_args(argument)
    return not argument.free_symbols or all(
        factor.is_Rational or factor.is_Function or factor.as_base_exp()[0].is_Symbol for factor in factors
    )


def _ball(number: Value, at: Point | None = None) -> arb:
    """A ball around a number; with ``at`` given, a form that has no value there counts as zero."""
    try:
        ball = enclosure(number, at)
    except NotReal:
        ball = arb("nan")
    if ball.is_finite():
        return ball
    if at is not None and parameters(number):
        return arb(0)
    raise Unreadable("A part of it is not a real number of moderate size.")
