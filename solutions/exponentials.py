"""Powers of e: whether an expression of them is identically zero, decided and not guessed; and its lowest terms.

Exponentials of rational functions whose exponents have no linear relation with rational coefficients are
algebraically independent over the rational functions (Ax 1971; for the constants among them it is the theorem of
Lindemann and Weierstrass). So with one variable for each of them the expression is a quotient of polynomials, and it
vanishes exactly where the upper one is zero.
"""

from collections.abc import Sequence
from functools import reduce
from math import lcm
from typing import NamedTuple

import sympy
from flint import Ordering, fmpq, fmpq_mat, fmpq_mpoly, fmpq_mpoly_ctx

from rldrill.solutions.closed_forms import exponent, folded, fraction, rational
from rldrill.solutions.rational import RationalFunction, generator, lifted
from rldrill.solutions.value import Value

#: The greatest number of products of terms that one multiplication may take.
_EFFORT = 20_000
#: The highest degree of a polynomial in a root of e that is written out.
_DEGREE = 1000


class _UndecidedError(Exception):
    """It holds what is neither rational nor an exponential, or grows too large."""


def vanishes(expression: sympy.Expr) -> bool | None:
    """Whether an expression is zero wherever it has a value; None where this does not decide it.

    Args:
        expression: sums, products, whole powers and exponentials in one parameter, or in none.
    """
    try:
        return bool(_quotient(expression).above == 0)
    except _UndecidedError:
        return None


def lowest_terms(expression: sympy.Expr) -> sympy.Expr | None:
    """A number made of rational powers of e as one quotient in lowest terms; None where it holds anything else.

    e²/(e² + e⁴) becomes 1/(1 + e²), and what stands over a single power of e becomes a sum.
    """
    finest = lcm(*(int(raised.q) for raised in _exponents(expression) if raised.is_Rational), 1)

    def leaf(part: sympy.Expr) -> Value:
        if part.is_Rational:
            return fraction(part)
        raised = exponent(part)
        if raised is None or not (raised * finest).is_Integer or abs(raised * finest) > _DEGREE:
            raise _UndecidedError
        return generator("e") ** int(raised * finest)

    try:
        value = lifted(folded(expression, leaf, power=_power))
    except _UndecidedError:
        return None
    scale = lcm(*(int(c.q) for poly in (value.top, value.bottom) for c in poly.coeffs()))
    below = [c * scale for c in value.bottom.coeffs()]
    shift = len(below) - 1 if not any(below[:-1]) else 0
    above = _powers([c * scale / (below[-1] if shift else 1) for c in value.top.coeffs()], shift, finest)
    return above if shift else above / _powers(below, 0, finest)


def _powers(coefficients: Sequence[fmpq], shift: int, finest: int) -> sympy.Expr:
    """The sum of these multiples of rising powers of e."""
    terms = (rational(c) * sympy.exp(sympy.Rational(power - shift, finest)) for power, c in enumerate(coefficients))
    return sympy.Add(*terms)


class _Quotient(NamedTuple):
    """Polynomials in the parameter and in exponentials, above and below the line."""

    above: fmpq_mpoly
    below: fmpq_mpoly

    def plus(self, other: "_Quotient") -> "_Quotient":
        (a, b), (c, d) = self, other
        return _Quotient(a + c, b) if b == d else _Quotient(_times(a, d) + _times(c, b), _times(b, d))

    def times(self, other: "_Quotient") -> "_Quotient":
        return _Quotient(_times(self.above, other.above), _times(self.below, other.below))

    def power(self, exponent: int) -> "_Quotient":
        above, below = reduce(_Quotient.times, [self] * abs(exponent))
        if exponent > 0:
            return _Quotient(above, below)
        if above == 0:
            raise _UndecidedError
        return _Quotient(below, above)


def _quotient(expression: sympy.Expr) -> _Quotient:
    """The expression with a variable for every independent exponential."""
    exponents = _exponents(expression)
    if len({letter for raised in exponents for letter in raised.free_symbols}) > 1:
        raise _UndecidedError
    monomials, size = _monomials([_rational(raised) for raised in exponents])
    names = tuple(sorted(symbol.name for symbol in expression.free_symbols))
    context = fmpq_mpoly_ctx.get((*(f"x{n}" for n in range(len(names))), *(f"e{n}" for n in range(size))), Ordering.lex)
    letters = dict(zip(names, context.gens(), strict=False))
    powers = dict(zip(exponents, monomials, strict=True))
    one = context.constant(1)

    def leaf(part: sympy.Expr) -> _Quotient:
        if part.is_Rational:
            return _Quotient(context.constant(fraction(part)), one)
        if part.is_Symbol:
            return _Quotient(letters[part.name], one)
        raised = exponent(part)
        if raised is None:
            raise _UndecidedError
        above, below = one, one
        for variable, power in zip(context.gens()[len(names) :], powers[raised], strict=True):
            above, below = (above * variable**power, below) if power > 0 else (above, below * variable**-power)
        return _Quotient(above, below)

    return folded(expression, leaf, _Quotient.plus, _Quotient.times, _Quotient.power)


def _times(a: fmpq_mpoly, b: fmpq_mpoly) -> fmpq_mpoly:
    if len(a) * len(b) > _EFFORT:
        raise _UndecidedError
    return a * b


def _exponents(expression: sympy.Expr) -> Sequence[sympy.Expr]:
    """What e is raised to, each once."""
    found = (exponent(part) for part in sympy.preorder_traversal(expression))
    return tuple(dict.fromkeys(raised for raised in found if raised is not None))


def _rational(expression: sympy.Expr) -> RationalFunction:
    def leaf(part: sympy.Expr) -> Value:
        if part.is_Symbol:
            return generator(part.name)
        if not part.is_Rational:
            raise _UndecidedError
        return fraction(part)

    return lifted(folded(expression, leaf, power=_power))


def _power(base: Value, exponent: int) -> Value:
    if base == 0 and exponent < 0:
        raise _UndecidedError
    return base**exponent


def _monomials(exponents: Sequence[RationalFunction]) -> tuple[list[tuple[int, ...]], int]:
    """Every exponential as whole powers of independent ones, and how many of these there are."""
    if not exponents:
        return [], 0
    below = reduce(lambda a, b: a * b // a.gcd(b), (raised.bottom for raised in exponents))
    tops = [raised.top * (below // raised.bottom) for raised in exponents]
    height = max(int(top.degree()) for top in tops) + 1
    reduced, rank = fmpq_mat([[top[degree] for top in tops] for degree in range(height)]).rref()
    shares = [[reduced[line, column] for column in range(len(tops))] for line in range(rank)]
    scales = [lcm(*(int(share.q) for share in line)) for line in shares]
    return [
        tuple(int((line[column] * scale).p) for line, scale in zip(shares, scales, strict=True))
        for column in range(len(tops))
    ], rank
