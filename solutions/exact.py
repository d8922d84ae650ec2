"""Exact values, and all that is asked of them, whatever their form: the one place where forms are told apart."""

from collections.abc import Callable, Iterable
from contextlib import suppress
from decimal import ROUND_HALF_UP, Decimal, localcontext
from functools import lru_cache, singledispatch
from math import isfinite
from numbers import Rational
from typing import Any, TypeGuard

import sympy
from flint import arb, ctx, fmpq
from sympy.core.sympify import converter

from rldrill.problems.exact import Logarithm, Parameter, Root, Weight, needed
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.solutions import surds
from rldrill.solutions.closed_forms import PRECISELY, Point, ball, fraction, rational
from rldrill.solutions.exponentials import lowest_terms, vanishes
from rldrill.solutions.rational import RationalFunction, generator
from rldrill.solutions.value import NoSolution as NoSolution
from rldrill.solutions.value import NotGiven as NotGiven
from rldrill.solutions.value import NotReal as NotReal
from rldrill.solutions.value import NotSolved as NotSolved
from rldrill.solutions.value import TooLong as TooLong
from rldrill.solutions.value import Value as Value

# What sympy does not know of it would read as a decimal.
converter[Fraction] = lambda number: sympy.Rational(number.numerator, number.denominator)

ZERO = fmpq(0)
ONE = fmpq(1)
_HALF = arb(1) / 2
#: A power of e with a larger exponent is as long as that exponent, not as what is written of it.
_FARTHEST = 10**6
_PRECISIONS = (64, 256, 1024)  # in bits


def exact(number: Weight | int) -> Value:
    """A given's number as a value to compute with."""
    if type(number) is Fraction:
        return _rational(number)
    if isinstance(number, Logarithm):
        return sympy.log(to_sympy(exact(number.of)))
    if isinstance(number, Root):
        return sympy.sqrt(sympy.Rational(number.of.numerator, number.of.denominator))
    if isinstance(number, Parameter):
        open_ = generator(number.symbol)
        return 1 - open_ if number.complement else open_
    return simplest(number)


@lru_cache(maxsize=4096)  # the same numbers are given again and again
def _rational(number: Fraction) -> fmpq:
    return fmpq(*number.as_integer_ratio())


#: The most digits of a number that is taken apart into primes.
_MOST_FACTORED = 20


def simplest(value: Any) -> Any:
    """The same value, as a plain rational where no parameter is left in it; what is no number stays what it is."""
    return value if type(value) in _SIMPLE else _simplest(value)


#: Of what is of these types, nothing can be simpler.
_SIMPLE = frozenset({fmpq, RationalFunction, tuple, str, bool})


@singledispatch
def _simplest(value: Any) -> Any:
    return value


_simplest.register(int, fmpq)
_simplest.register(Rational, lambda value: fmpq(value.numerator, value.denominator))
_simplest.register(sympy.Rational, fraction)


def tidy(value: Any) -> Any:
    """A number as one writes it: square roots (and π) multiplied out, no root below the line; logarithms of primes.

    A logarithm under a root stays as it is: √(ln 8) does not get simpler.
    """
    return _tidied(value) if isinstance(value, sympy.Expr) else value


@lru_cache(maxsize=4096)  # the right way and its mistakes have most numbers in common
def _tidied(value: sympy.Expr) -> Value:
    surd = surds.read(value)
    if surd is not None:
        return surds.write(surd)
    numbers = [each.args[0] for each in value.atoms(sympy.log)]
    rooted = any(each.exp.is_Rational and each.base.has(sympy.log) for each in value.atoms(sympy.Pow))
    if not numbers or rooted or value.free_symbols or digits(value) > _MOST_FACTORED:
        return value
    prime = all(number.is_Integer and sympy.isprime(number) for number in numbers)
    return value if prime else sympy.expand_log(value, factor=True)


@singledispatch
def to_sympy(value: Value | int) -> sympy.Expr:
    """Any exact value as a sympy expression."""
    return sympy.sympify(value, strict=True)


to_sympy.register(fmpq, rational)
to_sympy.register(sympy.Expr, lambda value: value)


@singledispatch
def parameters(value: Value) -> frozenset[str]:
    """The names of the parameters that are left open in a value."""
    return frozenset(free.name for free in to_sympy(value).free_symbols)


parameters.register(fmpq, lambda _: frozenset())
parameters.register(RationalFunction, lambda value: frozenset((value.parameter,)))


def value_at(value: Value, point: Value) -> Value:
    """The value with a number in place of the open parameter.

    Raises:
        NotReal: there is none.
    """
    return value_where(value, lambda _: point)


@singledispatch
def value_where(value: Value, at: Callable[[str], Value]) -> Value:
    """The value with a number in place of every open parameter, by its name.

    Raises:
        NotReal: there is none.
    """
    expression = to_sympy(value)
    put_in = simplest(expression.subs({free: to_sympy(at(free.name)) for free in expression.free_symbols}))
    if isinstance(put_in, sympy.Expr) and put_in.has(sympy.zoo, sympy.nan):
        raise NotReal(f"{expression} has a pole there")
    return put_in


@value_where.register
def _(value: RationalFunction, at: Callable[[str], Value]) -> Value:
    point = at(value.parameter)
    return value(point) if type(point) is fmpq else value_where(to_sympy(value), at)


@singledispatch
def enclosure(value: Value, at: Point | None = None) -> arb:
    """A ball that is certain to hold the value, at the working precision of ``flint.ctx``.

    Args:
        value: an exact value.
        at: what to put in for each open parameter.

    Raises:
        NotReal: the value holds something that has no real value.
    """
    return ball(to_sympy(value), at)


enclosure.register(fmpq, lambda value, _=None: arb(value))
enclosure.register(RationalFunction, lambda value, at=None: arb(value(at and at(value.parameter))))


@singledispatch
def length(_value: Any) -> int:
    """How many binary digits the longest whole number has that stands in a value; 0 for what is no number."""
    return 0


length.register(fmpq, fmpq.height_bits)
length.register(RationalFunction, RationalFunction.bits)


@length.register(sympy.Expr)
@lru_cache(maxsize=4096)  # what is added to a value is looked at, and then the sum
def _(value: sympy.Expr) -> int:
    if value.is_Rational:
        return fraction(value).height_bits()
    if isinstance(value, sympy.exp) and value.args[0].is_Rational and abs(value.args[0]) > _FARTHEST:
        return int(abs(value.args[0]))
    return max(map(length, value.args), default=0)


def terms(value: Any) -> int:
    """About how many terms the longer polynomial has of a quotient in what is left open; 0 where nothing is."""
    if isinstance(value, RationalFunction):
        return max(sum(coefficient != 0 for coefficient in poly.coeffs()) for poly in (value.top, value.bottom))
    letters = value.free_symbols if is_closed(value) else ()
    if len(letters) < 2:
        return 0
    return sum(part.is_Symbol for part in sympy.preorder_traversal(value)) // len(letters)


def told(value: Value) -> str:
    """A number as mathematics, for a sentence; a closed form as a decimal."""
    return str(f"≈ {decimal(value)}" if is_closed(value) else value).replace("-", "−")


def equals(value: Value) -> str:
    """The same with the relation to it: = 3/4, but ≈ 0.7071."""
    return "= " * (not is_closed(value)) + told(value)


def digits(value: Value) -> int:
    """How many digits a person must write for a number; closed forms count the longest that stands in them."""
    if isinstance(value, fmpq):
        above, below = len(str(abs(value.p))), value.q  # flint's text, which has no limit
        return above if below == 1 else above + len(str(below))
    if isinstance(value, RationalFunction):
        return max(map(digits, value.coefficients)) + len(value.coefficients)
    return max((digits(fraction(number)) for number in to_sympy(value).atoms(sympy.Rational)), default=0)


@singledispatch
def bits(value: Value) -> int:
    """How many bits it takes to write a value out, or would with its powers multiplied out."""
    return 1 + sum(map(bits, to_sympy(value).args))


@bits.register(fmpq)
@bits.register(sympy.Rational)
def _(value: Any) -> int:
    return int(value.p).bit_length() + int(value.q).bit_length() - 1


bits.register(RationalFunction, lambda value: sum(map(bits, (*value.top.coeffs(), *value.bottom.coeffs()))))


@bits.register(sympy.exp)
def _(value: sympy.exp) -> int:
    raised = value.args[0]
    return 2 + int(abs(raised) * 3 / 2) if raised.is_Rational else 1 + bits(raised)


@bits.register(sympy.Pow)
def _(value: sympy.Pow) -> int:
    base, exponent = value.args
    return bits(base) * abs(int(exponent)) if exponent.is_Integer else 1 + bits(base) + bits(exponent)


def degree(value: Value) -> int:
    """The greatest power of the open parameter in a rational function; 0 in any other form."""
    return int(max(value.top.degree(), value.bottom.degree())) if isinstance(value, RationalFunction) else 0


def is_rational(value: object) -> TypeGuard[fmpq]:
    """Whether a value is a rational number."""
    return isinstance(value, fmpq)


def is_closed(value: object) -> TypeGuard[sympy.Expr]:
    """Whether a value is a closed form: neither rational nor a rational function."""
    return isinstance(value, sympy.Expr)


def is_whole(value: Value) -> bool:
    """Whether a value is a whole number."""
    return isinstance(value, fmpq) and value.q == 1


def is_zero(value: Value) -> bool:
    """Whether the value is exactly zero."""
    return sign(value) == 0 if is_closed(value) and not parameters(value) else value == 0


def monomial(expression: sympy.Expr) -> Value:
    """A rational multiple of a power of one open parameter as a rational function; others as they are."""
    factor, power = expression.as_coeff_Mul()
    base, exponent = power.as_base_exp()
    if factor.is_Rational and base.is_Symbol and exponent.is_Integer:
        return simplest(factor) * generator(base.name) ** int(exponent)
    return simplest(expression)


#: What is no polynomial comes last.
_LAST = 99


def ordered(expression: sympy.Expr) -> sympy.Expr:
    """A computed sum with its terms as one writes them by hand: the constant, then rising powers."""
    if not expression.is_Add:
        return expression
    letters = tuple(expression.free_symbols)
    return sympy.Add(*sorted(expression.args, key=lambda term: _rank(term, letters)), evaluate=False)


def _rank(term: sympy.Expr, letters: tuple[sympy.Symbol, ...]) -> tuple[int, object]:
    """The degree in the letters that are left open; without any, in what stands in their place, such as e."""
    base, exponent = term.as_coeff_Mul()[1].as_base_exp()
    if base in letters and exponent.is_Integer and exponent > 0:  # a term of a polynomial, of which there may be many
        return int(exponent), sympy.default_sort_key(term)
    if not letters and term.has(sympy.Add):  # a product of sums, which nobody multiplies out for an order
        return _LAST, sympy.default_sort_key(term)
    try:
        degree = sympy.total_degree(term, *letters) if term.is_polynomial(*(letters or term.free_symbols)) else _LAST
    except sympy.polys.polyerrors.GeneratorsNeeded:  # a quotient in which what stands in their place cancels
        degree = 0
    return int(degree), sympy.default_sort_key(term)


def in_one_quotient(expression: sympy.Expr) -> sympy.Expr:
    """A computed expression in powers of e as one quotient in lowest terms: 2/(2 + e), not 1 − e/(2 + e)."""
    if not expression.has(sympy.exp, sympy.E):
        return expression
    reduced = None if expression.free_symbols else lowest_terms(expression)
    return reduced if reduced is not None else sympy.together(expression) if expression.is_Add else expression


def absolute(value: Value) -> Value:
    """The absolute value of a number; sympy's own would search for its sign symbolically."""
    return value if sign(value) >= 0 else -value


def magnitude(value: Value) -> int:
    """The power of ten at the first digit of a real value that is not zero.

    Raises:
        NotReal: it has no real value, or one too close to zero to tell.
    """
    if isinstance(value, fmpq) and value:
        above = len(str(abs(value.p))) - len(str(value.q))  # flint's text, which has no limit
        return above if abs(value) >= fmpq(10) ** above else above - 1
    for precision in _PRECISIONS:
        with PRECISELY, ctx.workprec(precision):
            size = abs(enclosure(value))
            exponent = size.log() / arb(10).log()
            below, nearest = exponent.floor().unique_fmpz(), (exponent + _HALF).floor().unique_fmpz()
        if below is not None:
            return int(below)
        if nearest is not None:  # the ball holds a power of ten
            return int(nearest) - int(sign(absolute(value) - fmpq(10) ** int(nearest)) < 0)
    raise NotReal(f"{value} cannot be told from zero, or is no real number")


def sign(value: Value) -> int:
    """−1, 0 or 1: the exact sign of a real value.

    Raises:
        NotReal: the value is not a real number, or cannot be told from zero.
    """
    if isinstance(value, fmpq):
        return (1 if value.p > 0 else -1) if value else 0
    for precision in _PRECISIONS:
        if found := clear_sign(value, None, precision):
            return found
    expression = to_sympy(value)
    if vanishes(expression) or expression.equals(0):
        return 0
    raise NotReal(f"{expression} is not a real number that can be told from zero")


def clear_sign(value: Value, at: Point | None, precision: int) -> int | None:
    """−1 or 1 if so many bits show that a value is not zero, else 0; None where they show no real value.

    Raises:
        NotReal: the value is not a real number.
    """
    with PRECISELY, ctx.workprec(precision):
        ball = enclosure(value, at)
        return int(ball > 0) - int(ball < 0) if ball.is_finite() else None


@lru_cache(maxsize=4096)
def _near(value: Value) -> arb:
    with PRECISELY, ctx.workprec(_PRECISIONS[0]):
        return enclosure(value)


def difference(first: Value, second: Value) -> arb:
    """A ball that holds the difference of two values, which are not subtracted: for closed forms that takes long.

    Raises:
        NotReal: one of them has no real value, or holds a parameter.
    """
    with PRECISELY, ctx.workprec(_PRECISIONS[0]):
        return _near(first) - _near(second)


def order(first: Value, second: Value) -> int:
    """−1, 0 or 1: the sign of the first value less the second.

    Raises:
        NotReal: the difference is not a real number, or cannot be told from zero.
    """
    if is_closed(first) or is_closed(second):
        with suppress(NotReal):  # a parameter may fall out of the difference
            ball = difference(first, second)
            if found := int(ball > 0) - int(ball < 0):
                return found
    return sign(first - second)


def equal(first: Value, second: Value) -> bool:
    """Whether two values are the same number, or the same function of what is left open."""
    if first == second:
        return True
    if type(first) is type(second) is fmpq:
        return False
    if is_closed(first) or is_closed(second):
        with suppress(NotReal):
            if difference(first, second) != 0:
                return False
    return is_zero(first - second)


def largest(values: Iterable[Value]) -> Value:
    """The greatest of some real values.

    Raises:
        NoSolution: which it is depends on what is left open.
    """
    every: list[Any] = list(values)
    if {*map(type, every)} == {fmpq}:
        return max(every)
    best, *rest = every
    for value in rest:
        try:
            if order(value, best) > 0:
                best = value
        except NotReal:
            raise NoSolution("which is the greatest depends on what is left open") from None
    return best


def decimal(value: Value, digits: int = 6) -> str | None:
    """The value as a decimal of at most ``digits`` significant digits; None while a parameter is open.

    A fraction that lies in the middle is rounded up, as in school: 17/16 is 1.063 in four digits, not 1.062.
    """
    if parameters(value):
        return None
    if is_rational(value):
        with localcontext(prec=digits, rounding=ROUND_HALF_UP):
            close = Decimal(int(value.p)) / int(value.q)
    else:
        close = to_sympy(value).evalf(digits + 10)
    number = float(close)
    return f"{number:.{digits}g}" if isfinite(number) else f"{close:.{digits}g}"


def near(value: Value, digits: int) -> str:
    """The value as a decimal with the relation to it, in mathematics: = 0.125, but ≈ 0.3333."""
    written = needed(decimal(value, digits))
    return f"{'=' if value == exact(fraction_of(written)) else '≈'} {written}"
