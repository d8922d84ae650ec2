"""Sums of rational multiples of square roots (and of powers of π), faster than sympy has them.

A sum is a mapping from (what stands under the root, squarefree; the power of π) to its coefficient.
"""

from functools import lru_cache
from math import gcd
from typing import Any, TypeAlias

import sympy
from flint import fmpq, fmpz

Term: TypeAlias = tuple[int, int]
Surd: TypeAlias = dict[Term, fmpq]

_LARGEST = 10**12  # what stands under a root is factored


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


@lru_cache(maxsize=4096)
def _read(expression: Any) -> Surd | None:
    if expression.is_Rational:
        return {(1, 0): fmpq(int(expression.p), int(expression.q))} if expression else {}
    if expression is sympy.pi:
        return {(1, 1): fmpq(1)}
    if expression.is_Pow:
        return _power(*expression.args)
    if not expression.is_Add and not expression.is_Mul:
        return None
    combine = add if expression.is_Add else multiply
    total: Surd = {} if expression.is_Add else {(1, 0): fmpq(1)}
    for argument in expression.args:
        part = _read(argument)
        if part is None:
            return None
        total = combine(total, part)
    return total


def _power(base: Any, exponent: Any) -> Surd | None:
    if exponent.is_Integer and abs(exponent) <= 16:
        part = _read(base)
        if part is not None and exponent < 0:
            part = inverse(part)
        if part is None:
            return None
        total: Surd = {(1, 0): fmpq(1)}
        for _ in range(abs(int(exponent))):
            total = multiply(total, part)
        return total
    if exponent.is_Rational and exponent.q == 2 and base.is_Rational and 0 < base.p * base.q < _LARGEST:
        root = _root(int(base.p * base.q))
        root = {term: coefficient / int(base.q) for term, coefficient in root.items()}
        half = _power(base, sympy.Integer((int(exponent.p) - 1) // 2))
        return None if half is None else multiply(root, half)
    return None


@lru_cache(maxsize=4096)
def _root(number: int) -> Surd:
    outside = under = 1
    for prime, count in fmpz(number).factor():
        outside *= int(prime) ** (int(count) // 2)
        under *= int(prime) ** (int(count) % 2)
    return {(under, 0): fmpq(outside)}


def read(value: Any) -> Surd | None:
    """An exact value as such a sum; None, if it is none."""
    if isinstance(value, fmpq):
        return {(1, 0): value} if value else {}
    return _read(value) if isinstance(value, sympy.Expr) else None


def write(surd: Surd) -> Any:
    """Such a sum as an exact value: a plain rational, where no root is left."""
    if not surd:
        return fmpq(0)
    if len(surd) == 1 and (1, 0) in surd:
        return surd[1, 0]
    return _written(tuple(sorted(surd.items())))


@lru_cache(maxsize=4096)
def _written(items: tuple[tuple[Term, fmpq], ...]) -> Any:
    return sympy.Add(
        *(
            sympy.Rational(int(coefficient.p), int(coefficient.q)) * sympy.sqrt(under) * sympy.pi**power
            for (under, power), coefficient in items
        )
    )
