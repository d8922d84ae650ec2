"""Powers of e: whether an expression of them is identically zero, decided and not guessed; and its lowest terms.

Exponentials of rational functions whose exponents have no linear relation with rational coefficients are
algebraically independent over the rational functions (Ax 1971; for the constants among them it is the theorem of
Lindemann and Weierstrass). So with one variable for each of them the expression is a quotient of polynomials, and it
vanishes exactly where the upper one is zero.
"""

from collections.abc import Callable, Iterable, Sequence
from functools import reduce
from math import lcm
from typing import Any, TypeAlias

import sympy
from flint import Ordering, fmpq, fmpq_mat, fmpq_mpoly_ctx, fmpq_poly

from rldrill.solutions.rational import RationalFunction, generator

#: The greatest number of products of terms that one multiplication may take.
_EFFORT = 20_000
#: The highest degree of a polynomial in a root of e that is written out.
_DEGREE = 1000

#: A quotient of polynomials in the parameter and in exponentials: above and below the line.
_Quotient: TypeAlias = tuple[Any, Any]


class _UndecidedError(Exception):
    """It holds what is neither rational nor an exponential, or grows too large."""


def vanishes(expression: sympy.Expr) -> bool | None:
    """Whether an expression is zero wherever it has a value; None where this does not decide it.

    Args:
        expression: sums, products, whole powers and exponentials in one parameter, or in none.
    """
    try:
        return _top(expression) == 0
    except (_UndecidedError, ZeroDivisionError):
        return None


def lowest_terms(expression: sympy.Expr) -> sympy.Expr | None:
    """A number made of rational powers of e as one quotient in lowest terms; None where it holds anything else.

    e²/(e² + e⁴) becomes 1/(1 + e²), and what stands over a single power of e becomes a sum.
    """
    finest = lcm(*(int(exponent.q) for exponent in _exponents(expression) if exponent.is_Rational), 1)

    def leaf(part: sympy.Expr) -> Any:
        if part.is_Rational:
            return _fraction(part)
        exponent = _exponent(part) * finest
        if not exponent.is_Integer or abs(exponent) > _DEGREE:
            raise _UndecidedError
        return generator("e") ** int(exponent)

    try:
        value = _folded(expression, leaf, lambda a, b: a + b, lambda a, b: a * b, lambda a: 1 / a)
    except (_UndecidedError, ZeroDivisionError):
        return None
    if not isinstance(value, RationalFunction):
        return sympy.Rational(int(value.p), int(value.q))
    scale = lcm(*(int(c.q) for poly in (value.top, value.bottom) for c in poly.coeffs()))
    below = [c * scale for c in value.bottom.coeffs()]
    shift = len(below) - 1 if not any(below[:-1]) else 0
    above = _powers([c * scale / (below[-1] if shift else 1) for c in value.top.coeffs()], shift, finest)
    return above if shift else above / _powers(below, 0, finest)


def _powers(coefficients: Sequence[fmpq], shift: int, finest: int) -> sympy.Expr:
    """The sum of these multiples of rising powers of e."""
    terms = (
        sympy.Rational(int(c.p), int(c.q)) * sympy.exp(sympy.Rational(power - shift, finest))
        for power, c in enumerate(coefficients)
    )
    return sympy.Add(*terms)


def _top(expression: sympy.Expr) -> Any:
    """The polynomial above the line."""
    exponents = tuple(_exponents(expression))
    monomials, size = _monomials([_rational(exponent) for exponent in exponents])
    names = tuple(sorted(symbol.name for symbol in expression.free_symbols))
    context = fmpq_mpoly_ctx.get((*(f"x{n}" for n in range(len(names))), *(f"e{n}" for n in range(size))), Ordering.lex)
    letters = dict(zip(names, context.gens(), strict=False))
    powers = dict(zip(exponents, monomials, strict=True))
    one = context.constant(1)

    def leaf(part: sympy.Expr) -> _Quotient:
        if part.is_Rational:
            return context.constant(_fraction(part)), one
        if part.is_Symbol:
            return letters[part.name], one
        above, below = one, one
        for variable, power in zip(context.gens()[len(names) :], powers[_exponent(part)], strict=True):
            above, below = (above * variable**power, below) if power > 0 else (above, below * variable**-power)
        return above, below

    top, bottom = _folded(expression, leaf, _sum, _product, _inverse)
    if bottom == 0:
        raise _UndecidedError
    return top


def _exponents(expression: sympy.Expr) -> Iterable[sympy.Expr]:
    """What e is raised to, each once."""
    found = (_exponent(part) for part in sympy.preorder_traversal(expression) if _is_power_of_e(part))
    return dict.fromkeys(found)


def _is_power_of_e(part: sympy.Expr) -> bool:
    return part is sympy.E or isinstance(part, sympy.exp)


def _exponent(part: sympy.Expr) -> sympy.Expr:
    if not _is_power_of_e(part):
        raise _UndecidedError
    return sympy.S.One if part is sympy.E else part.args[0]


def _rational(expression: sympy.Expr) -> RationalFunction | fmpq:
    """An exponent as a rational function of the parameter."""

    def leaf(part: sympy.Expr) -> Any:
        if part.is_Symbol:
            return generator(part.name)
        if not part.is_Rational:
            raise _UndecidedError
        return _fraction(part)

    value: RationalFunction | fmpq = _folded(expression, leaf, lambda a, b: a + b, lambda a, b: a * b, lambda a: 1 / a)
    return value


def _monomials(exponents: Sequence[RationalFunction | fmpq]) -> tuple[list[tuple[int, ...]], int]:
    """Every exponential as whole powers of independent ones, and how many of these there are."""
    if not exponents:
        return [], 0
    if len({value.parameter for value in exponents if isinstance(value, RationalFunction)}) > 1:
        raise _UndecidedError
    one = fmpq_poly([1])
    pairs = [(v.top, v.bottom) if isinstance(v, RationalFunction) else (fmpq_poly([v]), one) for v in exponents]
    below = reduce(lambda a, b: a * b // a.gcd(b), (bottom for _, bottom in pairs), one)
    tops = [top * (below // bottom) for top, bottom in pairs]
    height = max(int(top.degree()) for top in tops) + 1
    reduced, rank = fmpq_mat([[top[degree] for top in tops] for degree in range(height)]).rref()
    shares = [[reduced[line, column] for column in range(len(tops))] for line in range(rank)]
    scales = [lcm(*(int(share.q) for share in line)) for line in shares]
    return [
        tuple(int((line[column] * scale).p) for line, scale in zip(shares, scales, strict=True))
        for column in range(len(tops))
    ], rank


def _fraction(number: sympy.Expr) -> fmpq:
    return fmpq(int(number.p), int(number.q))


def _folded(
    expression: sympy.Expr,
    leaf: Callable[[sympy.Expr], Any],
    add: Callable[[Any, Any], Any],
    multiply: Callable[[Any, Any], Any],
    invert: Callable[[Any], Any],
) -> Any:
    """The value of sums, products and whole powers; everything else is a leaf."""

    def value(part: sympy.Expr) -> Any:
        if part.is_Add or part.is_Mul:
            return reduce(add if part.is_Add else multiply, map(value, part.args))
        if part.is_Pow and part.args[1].is_Integer:
            power = reduce(multiply, [value(part.args[0])] * abs(int(part.args[1])))
            return power if part.args[1] > 0 else invert(power)
        return leaf(part)

    return value(expression)


def _times(a: Any, b: Any) -> Any:
    if len(a) * len(b) > _EFFORT:
        raise _UndecidedError
    return a * b


def _sum(first: _Quotient, second: _Quotient) -> _Quotient:
    (a, b), (c, d) = first, second
    return (a + c, b) if b == d else (_times(a, d) + _times(c, b), _times(b, d))


def _product(first: _Quotient, second: _Quotient) -> _Quotient:
    return _times(first[0], second[0]), _times(first[1], second[1])


def _inverse(value: _Quotient) -> _Quotient:
    above, below = value
    if above == 0:
        raise _UndecidedError
    return below, above
