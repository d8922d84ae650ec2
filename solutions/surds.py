"""Sums of rational multiples of square roots (and of powers of π), faster than sympy has them.

A sum is a mapping from (what stands under the root, squarefree; the power of π) to its coefficient.
"""

from functools import lru_cache, reduce, singledispatch
from math import gcd
from typing import TypeAlias

import sympy
from flint import fmpq, fmpz

from rldrill.solutions.closed_forms import folded, fraction, rational
from rldrill.solutions.value import Value

Term: TypeAlias = tuple[int, int]
Surd: TypeAlias = dict[Term, fmpq]

_LARGEST = 10**12  # what stands under a root is factored
_POWER = 16  # the highest that is multiplied out
_ONE: Term = (1, 0)


class _OtherError(Exception):
    """It is no such sum."""


def add(a: Surd, b: Surd) -> Surd:
    """The sum."""
    total = dict(a)
    for term, coefficient in b.items():
        total[term] = total.get(term, fmpq(0)) + coefficient
    return {term: coefficient for term, coefficient in total.items() if coefficient}


def multiply(a: Surd, b: Surd) -> Surd:
    """The product, multiplied out."""
    total: Surd = {}
    for (under, power), first in a.items():
        for (beneath, exponent), second in b.items():
            common = gcd(under, beneath)
            term = (under // common * (beneath // common), power + exponent)
            total[term] = total.get(term, fmpq(0)) + first * second * common
    return {term: coefficient for term, coefficient in total.items() if coefficient}


def inverse(a: Surd) -> Surd | None:
    """One over it, without a root below the line; None where π keeps it from being such a sum.

    Raises:
        ZeroDivisionError: it is zero.
    """
    if not a:
        raise ZeroDivisionError("one over zero")
    if len(a) == 1:
        (((under, power), coefficient),) = a.items()
        return {(under, -power): 1 / (coefficient * under)}
    if any(power for _, power in a):
        return None
    prime = int(fmpz(max(under for under, _ in a)).factor()[0][0])
    conjugate = {(under, power): -c if under % prime == 0 else c for (under, power), c in a.items()}
    norm = inverse(multiply(a, conjugate))  # the prime has gone from it
    return None if norm is None else multiply(conjugate, norm)


@singledispatch
def read(value: object) -> Surd | None:  # noqa: ARG001
    """An exact value as such a sum; None, if it is none."""
    return None


@read.register(fmpq)
def _(value: fmpq) -> Surd:
    return {_ONE: value} if value else {}


@read.register(sympy.Expr)
@lru_cache(maxsize=4096)
def _(value: sympy.Expr) -> Surd | None:
    try:
        return folded(value, _leaf, add, multiply, _power)
    except _OtherError:
        return None


def _leaf(part: sympy.Expr) -> Surd:
    if part.is_Rational:
        return {_ONE: fraction(part)} if part else {}
    if part is sympy.pi:
        return {(1, 1): fmpq(1)}
    base, exponent = part.args if part.is_Pow else (part, part)
    if base.is_Rational and exponent.is_Rational and exponent.q == 2 and 0 < base.p * base.q < _LARGEST:
        root = {term: coefficient / int(base.q) for term, coefficient in _root(int(base.p * base.q)).items()}
        return multiply(root, _power(_leaf(base), (int(exponent.p) - 1) // 2))
    raise _OtherError


def _power(a: Surd, exponent: int) -> Surd:
    base = a if exponent >= 0 else inverse(a)
    if base is None or abs(exponent) > _POWER:
        raise _OtherError
    return reduce(multiply, [base] * abs(exponent), {_ONE: fmpq(1)})


@lru_cache(maxsize=4096)
def _root(number: int) -> Surd:
    outside = under = 1
    for prime, count in fmpz(number).factor():
        outside *= int(prime) ** (int(count) // 2)
        under *= int(prime) ** (int(count) % 2)
    return {(under, 0): fmpq(outside)}


def write(surd: Surd) -> Value:
    """Such a sum as an exact value: a plain rational, where no root is left."""
    return _written(tuple(sorted(surd.items()))) if surd.keys() - {_ONE} else surd.get(_ONE, fmpq(0))


@lru_cache(maxsize=4096)
def _written(items: tuple[tuple[Term, fmpq], ...]) -> sympy.Expr:
    return sympy.Add(
        *(rational(coefficient) * sympy.sqrt(under) * sympy.pi**power for (under, power), coefficient in items)
    )
