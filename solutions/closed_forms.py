"""Sympy's expressions as exact numbers: taken apart, and enclosed in balls."""

import operator
from collections.abc import Callable
from functools import reduce
from threading import RLock
from typing import TypeVar

import sympy
from flint import arb, fmpq

from rldrill.solutions.value import NotReal

T = TypeVar("T")
#: The precision of flint's balls is one for all threads: whoever sets it holds this until the work is done.
PRECISELY = RLock()
#: What is put in for each letter, by its name.
Point = Callable[[str], fmpq]

_FUNCTIONS = {sympy.exp: arb.exp, sympy.log: arb.log, sympy.sin: arb.sin, sympy.cos: arb.cos,
              sympy.tan: arb.tan, sympy.atan: arb.atan, sympy.Abs: abs}  # fmt: skip


def fraction(number: sympy.Rational) -> fmpq:
    """A rational number of sympy's as one of flint's."""
    return fmpq(int(number.p), int(number.q))


def rational(number: fmpq) -> sympy.Rational:
    """A rational number of flint's as one of sympy's."""
    return sympy.Rational(int(number.p), int(number.q))


def folded(
    expression: sympy.Expr,
    leaf: Callable[[sympy.Expr], T],
    add: Callable[[T, T], T] = operator.add,
    multiply: Callable[[T, T], T] = operator.mul,
    power: Callable[[T, int], T] = operator.pow,
) -> T:
    """What sums, products and whole powers make of the leaves; everything else is a leaf."""

    def value(part: sympy.Expr) -> T:
        if part.is_Add or part.is_Mul:
            return reduce(add if part.is_Add else multiply, map(value, part.args))
        if part.is_Pow and part.args[1].is_Integer:
            return power(value(part.args[0]), int(part.args[1]))
        return leaf(part)

    return value(expression)


def exponent(expression: sympy.Expr) -> sympy.Expr | None:
    """What e is raised to, if the expression is a power of e."""
    if expression is sympy.E:
        return sympy.S.One
    return expression.args[0] if isinstance(expression, sympy.exp) else None


def ball(expression: sympy.Expr, at: Point | None = None) -> arb:
    """A ball that is certain to hold the number, with what ``at`` says in place of every letter.

    Raises:
        NotReal: the expression holds something that has no real value.
    """

    def leaf(part: sympy.Expr) -> arb:
        if part.is_Rational:
            return arb(fraction(part))
        if part.is_Symbol and at is not None:
            return arb(at(part.name))
        if part is sympy.E:
            return arb(1).exp()
        if part is sympy.pi:
            return arb.pi()
        balls = [folded(argument, leaf) for argument in part.args]
        if part.is_Pow:
            return balls[0].sqrt() if part.args[1] == sympy.S.Half else balls[0] ** balls[1]
        if part.func in _FUNCTIONS:
            return _FUNCTIONS[part.func](balls[0])
        if isinstance(part, sympy.Max):
            return reduce(arb.max, balls)
        raise NotReal(f"{part} has no real value here")

    return folded(expression, leaf)
