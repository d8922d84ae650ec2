"""Exact arithmetic that refuses, before it begins, whatever would take long."""

from collections.abc import Sequence
from typing import Any, TypeAlias

import sympy
from flint import arb, fmpq, fmpq_poly

from rldrill.solutions.answers.source import Unreadable
from rldrill.solutions.exact import Value, enclosure, simplest, to_sympy
from rldrill.solutions.rational import RationalFunction, generator, quotient

#: ``fmpq`` where it is rational, ``RationalFunction`` where it is rational in a parameter, else a sympy expression.
Number: TypeAlias = Any

#: The names of functions, with the least and the most arguments they take.
FUNCTIONS = {"sqrt": (1, 1), "exp": (1, 1), "ln": (1, 1), "log": (1, 1), "sin": (1, 1), "cos": (1, 1),
             "tan": (1, 1), "abs": (1, 1), "max": (1, 20), "min": (1, 20)}  # fmt: skip

_EFFORT = 3000  # in hundredths of a millisecond, as measured
_BITS = 4000
_DEGREE = 24
# degree, levels and bits of what a function is taken of, with a parameter in it and without
_OPEN, _CLOSED = (4, 2, 100), (0, 4, 400)
_EXPONENT = 64
_GROWTH = 100  # of the exponent of e
_LEVELS = 5  # of functions in functions
_ROOT = 12  # the highest root, and the digits of what it is taken of
_ANGLE = 1000
_TURNS = frozenset({1, 2, 3, 4, 6, 12})  # pi over these has a sine that is short to write
_LARGE = "A number in it grows too large; write it in a simpler form."
_DEEP = "Functions stand too deep in one another; write it in a simpler form."
_ZERO = "It divides by zero."


class Arithmetic:
    """Sums, products, powers and functions of exact numbers, until a fixed effort is used up."""

    def __init__(self) -> None:
        self._left = _EFFORT

    def parameter(self, name: str) -> Number:
        """An open parameter, by its name in files."""
        return generator(name)

    def add(self, a: Number, b: Number) -> Number:
        """The sum of two numbers."""
        if _rational(a, b):
            return _small(a + b)
        if pair := _ratios(a, b):
            a, b = pair
            return self._ratio(a.parameter, a.top * b.bottom + b.top * a.bottom, a.bottom * b.bottom)
        return self._expression(self._sympy(a) + self._sympy(b))

    def negate(self, a: Number) -> Number:
        """The number with the other sign."""
        return self.multiply(fmpq(-1), a)

    def multiply(self, a: Number, b: Number) -> Number:
        """The product of two numbers."""
        if _rational(a, b):
            return _small(a * b)
        if pair := _ratios(a, b):
            a, b = pair
            return self._ratio(a.parameter, a.top * b.top, a.bottom * b.bottom)
        if not (_size(a) + _size(b) <= _BITS):
            raise Unreadable(_LARGE)
        return self._expression(self._sympy(a) * self._sympy(b))

    def divide(self, a: Number, b: Number) -> Number:
        """The quotient of two numbers."""
        if isinstance(b, fmpq):
            if b == 0:
                raise Unreadable(_ZERO)
            return self.multiply(a, 1 / b)
        if isinstance(b, RationalFunction):
            return self.multiply(a, self._ratio(b.parameter, b.bottom, b.top))
        if not b.free_symbols and _ball(b).contains(0):
            raise Unreadable("It divides by what cannot be told from zero; write it in a simpler form.")
        return self.multiply(a, self._expression(1 / b))

    def power(self, base: Number, exponent: Number) -> Number:
        """A number raised to an exponent: a whole number, a small fraction, or anything over e."""
        if isinstance(base, sympy.Expr) and base is sympy.E:
            return self._exp(exponent)
        if not isinstance(exponent, fmpq):
            raise Unreadable("Only e is raised to such an exponent; write a whole number or a fraction there.")
        if isinstance(base, sympy.exp):
            return self._exp(self.multiply(self._exponent(base), exponent))
        if exponent.q > _ROOT:
            raise Unreadable(f"Exponents are whole numbers or fractions down to 1/{_ROOT}; use exp and ln for others.")
        if abs(exponent.p) > _EXPONENT:
            raise Unreadable(f"The exponent is too large; {_EXPONENT} is the largest that is read.")
        if exponent.q == 1:
            return self._whole_power(base, int(exponent.p))
        return self._whole_power(self._root(base, int(exponent.q)), int(exponent.p))

    def call(self, name: str, arguments: Sequence[Number]) -> Number:
        """A function of some numbers, by its name in ``FUNCTIONS``."""
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

    def finish(self, number: Number) -> Value:
        """A number as the simplest kind of exact value that holds it."""
        if isinstance(number, sympy.Expr):
            number = self._lift(number)
        if isinstance(number, sympy.Expr) and not number.free_symbols:
            _ball(number)
        return number

    def _spend(self, effort: int) -> None:
        self._left -= effort
        if self._left < 0:
            raise Unreadable("It would take too long to work out; write it in a simpler form.")

    def _ratio(self, parameter: str, top: fmpq_poly, bottom: fmpq_poly) -> Number:
        if not bottom:
            raise Unreadable(_ZERO)
        self._spend(3 + 2 * (int(top.degree()) + int(bottom.degree())))
        ratio = quotient(parameter, top, bottom)
        if isinstance(ratio, fmpq):
            return _small(ratio)
        if _degree(ratio) > _DEGREE or _size(ratio) > _BITS:
            raise Unreadable(_LARGE)
        return ratio

    def _expression(self, expression: Any) -> Number:
        """What sympy made of it, if it is small and is a real number."""
        if expression.has(sympy.nan, sympy.zoo, sympy.oo, -sympy.oo, sympy.I):
            raise Unreadable("A part of it is not a real number.")
        size = _size(expression)
        if size > _BITS or _levels(expression) > _LEVELS:
            raise Unreadable(_LARGE)
        self._spend((80 if expression.free_symbols else 40) + size // 2)
        return simplest(expression)

    def _sympy(self, number: Number) -> Any:
        if isinstance(number, fmpq):
            return sympy.Rational(int(number.p), int(number.q))
        if isinstance(number, RationalFunction):
            self._spend(30)
            return to_sympy(number)
        return number

    def _whole_power(self, base: Number, exponent: int) -> Number:
        if _size(base) * abs(exponent) > _BITS or _degree(base) * abs(exponent) > _DEGREE:
            raise Unreadable(_LARGE)
        if exponent < 0:
            return self.divide(fmpq(1), self._whole_power(base, -exponent))
        if isinstance(base, fmpq):
            return base**exponent
        if isinstance(base, RationalFunction):
            return self._ratio(base.parameter, base.top**exponent, base.bottom**exponent)
        return self._expression(base**exponent)

    def _root(self, number: Number, index: int) -> Number:
        if isinstance(number, sympy.exp):
            return self._exp(self.multiply(self._exponent(number), fmpq(1, index)))
        if self._sign(number) < 0:
            raise Unreadable("A root of a negative number is not a real number.")
        if isinstance(number, fmpq):
            largest = max(int(number.p), int(number.q))
            if largest > 10**_ROOT:
                raise Unreadable(f"A root is read of numbers of at most {_ROOT} digits; write a decimal.")
            self._spend(100 if largest < 10**6 else 400)
        elif index != 2:
            raise Unreadable("Only square roots are read of such a number; write a decimal.")
        nested = self._nested(number)
        return self._expression(sympy.Pow(nested, sympy.Rational(1, index), evaluate=_is_plain(nested)))

    def _exponent(self, power: Any) -> Number:
        """What e is raised to in a power of e."""
        return self._lift(power.args[0]) if power.args[0].free_symbols else simplest(power.args[0])

    def _exp(self, exponent: Number) -> Number:
        size: Number = exponent
        if not isinstance(exponent, fmpq):
            size = _ball(self._sympy(exponent), fmpq(1, 2))
        if abs(size) > _GROWTH:
            raise Unreadable(f"The exponent is too large; with e, {_GROWTH} is the largest that is read.")
        nested = self._nested(exponent)
        return self._expression(sympy.exp(nested, evaluate=_is_plain(nested)))

    def _log(self, number: Number) -> Number:
        if self._sign(number, unknown=1) <= 0:
            raise Unreadable("Only a number above zero has a logarithm.")
        self._spend(100)
        if isinstance(number, sympy.exp):
            return self._exponent(number)
        nested = self._nested(number)
        return self._expression(sympy.log(nested, evaluate=_is_plain(nested)))

    def _circular(self, name: str, angle: Number) -> Number:
        self._spend(200)
        expression = self._nested(angle)
        if expression.free_symbols:
            raise Unreadable(f"{name} is read of numbers only; write the answer without it.")
        if abs(_ball(expression)) > _ANGLE:
            raise Unreadable(f"{name} is read of angles up to {_ANGLE}; write a smaller angle.")
        turns = expression / sympy.pi
        short = not turns.is_Rational or int(turns.q) in _TURNS
        return self._expression(getattr(sympy, name)(expression, evaluate=short))

    def _nested(self, number: Number) -> Any:
        """The argument of a function, for which sympy's time doubles with each function within."""
        expression = self._sympy(number)
        degree, levels, bits = _OPEN if expression.free_symbols else _CLOSED
        if _levels(expression) >= levels:
            raise Unreadable(_DEEP)
        if _degree(number) > degree or _size(number) > bits:
            raise Unreadable(_LARGE)
        if isinstance(number, sympy.Expr) and not expression.free_symbols and _ball(expression).contains(0):
            raise Unreadable("A part of it cannot be told from zero; write it in a simpler form.")
        return expression

    def _sign(self, number: Number, unknown: int = 0) -> int:
        """The sign of a number; ``unknown`` where it depends on a parameter or is too close to zero."""
        if isinstance(number, fmpq):
            return int(number > 0) - int(number < 0)
        if isinstance(number, RationalFunction) or number.free_symbols:
            return unknown
        ball = _ball(number)
        return 1 if ball > 0 else -1 if ball < 0 else 0

    def _clear_sign(self, number: Number) -> int:
        sign = self._sign(number)
        if sign == 0 and number != 0:
            raise Unreadable("abs, max and min are read of numbers that differ clearly; write out which it is.")
        return sign

    def _lift(self, expression: Any) -> Number:
        """An expression in which the irrational parts have gone, as a rational function."""
        if len(expression.free_symbols) != 1 or not _is_ratio(expression):
            return expression
        if expression.is_Symbol:
            return self.parameter(expression.name)
        if expression.is_Pow:
            return self._whole_power(self._lift(expression.base), int(expression.exp))
        combine = self.add if expression.is_Add else self.multiply
        first, *rest = (self._lift(simplest(part)) if part.free_symbols else simplest(part)
                        for part in expression.args)  # fmt: skip
        for part in rest:
            first = combine(first, part)
        return first


def _rational(a: Number, b: Number) -> bool:
    return isinstance(a, fmpq) and isinstance(b, fmpq)


def _ratios(a: Number, b: Number) -> tuple[RationalFunction, RationalFunction] | None:
    """Both as rational functions of the same parameter, if they are."""
    names = {number.parameter for number in (a, b) if isinstance(number, RationalFunction)}
    if len(names) != 1 or isinstance(a, sympy.Expr) or isinstance(b, sympy.Expr):
        return None
    (name,) = names
    first, second = (
        number if isinstance(number, RationalFunction) else RationalFunction(name, fmpq_poly([number]), fmpq_poly([1]))
        for number in (a, b)
    )
    return first, second


def _small(number: fmpq) -> fmpq:
    if _size(number) > _BITS:
        raise Unreadable(_LARGE)
    return number


def _degree(number: Number) -> int:
    if not isinstance(number, RationalFunction):
        return 0
    return int(max(number.top.degree(), number.bottom.degree()))


def _size(number: Number) -> int:
    """How many bits it takes to write the number out, or would with its powers multiplied out."""
    if isinstance(number, fmpq):
        return int(number.p).bit_length() + int(number.q).bit_length() - 1
    if isinstance(number, RationalFunction):
        return sum(_size(c) for poly in (number.top, number.bottom) for c in poly.coeffs())
    if number.is_Rational:
        return int(number.p).bit_length() + int(number.q).bit_length() - 1
    if isinstance(number, sympy.exp) and number.args[0].is_Rational:
        return 2 + int(abs(number.args[0]) * 3 / 2)
    if number.is_Pow and number.args[1].is_Integer:
        return _size(number.args[0]) * abs(int(number.args[1]))
    return 1 + sum(_size(argument) for argument in number.args)


def _levels(expression: Any) -> int:
    """How deep functions, roots and quotients stand in one another."""
    deepest = max((_levels(argument) for argument in expression.args), default=0)
    power = expression.is_Pow and expression.args[1].is_Integer and expression.args[1].is_positive
    return deepest if not expression.args or expression.is_Add or expression.is_Mul or power else deepest + 1


def _is_ratio(expression: Any) -> bool:
    if expression.is_Pow:
        return expression.args[1].is_Integer and _is_ratio(expression.args[0])
    if expression.is_Add or expression.is_Mul:
        return all(map(_is_ratio, expression.args))
    return bool(expression.is_Rational or expression.is_Symbol)


def _is_plain(argument: Any) -> bool:
    """Whether sympy knows at once what a function of it is, and does not search for its sign."""
    factors = sympy.Mul.make_args(argument)
    return not argument.free_symbols or all(
        factor.is_Rational or factor.is_Function or factor.as_base_exp()[0].is_Symbol for factor in factors
    )


def _ball(expression: Any, at: fmpq | None = None) -> arb:
    """A ball around a closed form; with ``at`` given, a form that has no value there counts as zero."""
    try:
        ball = enclosure(expression, at)
    except ValueError:
        ball = arb("nan")
    if ball.is_finite():
        return ball
    if at is not None and expression.free_symbols:
        return arb(0)
    raise Unreadable("A part of it is not a real number of moderate size.")
