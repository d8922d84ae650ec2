"""Sums with letters multiplied out, before what is alike in them is collected: 21 + 2p − 7p for 7(3 − p) + 2p."""

from collections.abc import Iterable, Iterator, Sequence
from functools import reduce
from itertools import chain

import sympy
from sympy import Add, Expr, Mul, Pow, Rational

from rldrill.solutions.formula.node import Node
from rldrill.solutions.formula.nodes.leaves import Leaf
from rldrill.solutions.formula.notation import Quantity
from rldrill.solutions.formula.putting_in import evaluated, is_below

#: A number, and the letters, logarithms of primes and unknowns that it is multiplied by.
_Term = tuple[Rational, tuple[Expr, ...]]
#: A line of more terms than this is longer than what it explains; larger powers are not multiplied out.
_MOST_TERMS, _MOST_FACTORS = 12, 4


class _OtherKindError(Exception):
    """Something that is no sum of products of numbers and letters."""


def collected_next(expression: Expr) -> Expr | None:
    """The terms that are collected in the line after this one, side by side; None where nothing is alike in them.

    Of a quotient, they are those above the line and below it.
    """
    above, below = _quotient(expression)
    if not below:
        return _side_by_side([above])
    top, bottom = _side_by_side([above]), _side_by_side(below)
    if top is None and bottom is None:
        return None
    whole = bottom if bottom is not None else below[0] if len(below) == 1 else Mul._from_args(below)
    return Mul._from_args([above if top is None else top, Pow(whole, -1, evaluate=False)])


def is_quotient(expression: Expr) -> bool:
    """Whether something stands below a line."""
    return bool(_quotient(expression)[1])


def _quotient(expression: Expr) -> tuple[Expr, list[Expr]]:
    """What stands above the line, and the factors below it."""
    below = [factor.args[0] for factor in Mul.make_args(expression) if is_below(factor)]
    if not below or isinstance(expression, Node):
        return expression, []
    above = [factor for factor in Mul.make_args(expression) if not is_below(factor)]
    return (Mul._from_args(above) if len(above) > 1 else above[0] if above else sympy.S.One), below


def _side_by_side(factors: Sequence[Expr]) -> Expr | None:
    try:
        terms = _product(map(_terms, factors))
    except _OtherKindError:
        return None
    kinds = {letters for _, letters in terms}
    if kinds <= {()} or len(kinds) == len(terms) or len(terms) > _MOST_TERMS:
        return None
    return Add._from_args([_written(*term) for term in terms])


def _terms(expression: Expr) -> list[_Term]:
    """The terms of an expression that is multiplied out, in the order in which they come."""
    if isinstance(expression, Leaf) and expression.args and isinstance(evaluated(expression), Expr):
        return _terms(evaluated(expression))
    if expression.is_Rational:
        return [(expression, ())] if expression else []
    if expression.is_Symbol or isinstance(expression, Quantity):
        return [(sympy.S.One, (expression,))]
    if isinstance(expression, Node):
        raise _OtherKindError
    if expression.is_Add:
        return list(chain.from_iterable(map(_terms, expression.args)))
    if expression.is_Mul:
        return _product(map(_terms, expression.args))
    return list(_terms_of_a_function(expression))


def _terms_of_a_function(expression: Expr) -> Iterable[_Term]:
    """Those of a power or a logarithm."""
    if expression.is_Pow and expression.args[1].is_Integer and 0 < expression.args[1] <= _MOST_FACTORS:
        return _product([_terms(expression.args[0])] * int(expression.args[1]))
    if isinstance(expression, sympy.log) and expression.args[0].is_Rational:
        return _of_primes(expression.args[0])
    raise _OtherKindError


def _of_primes(number: Rational) -> Iterator[_Term]:
    """The logarithm of a number as a sum of logarithms of primes."""
    for prime, times in sympy.factorrat(number).items():
        yield Rational(times), (sympy.log(prime),)


def _product(factors: Iterable[list[_Term]]) -> list[_Term]:
    def times(one: list[_Term], other: list[_Term]) -> list[_Term]:
        return [(a * b, tuple(sorted((*x, *y), key=_place))) for a, x in one for b, y in other]

    return reduce(times, factors, [(sympy.S.One, ())])


def _place(letter: Expr) -> tuple[bool, str]:
    """Letters before the unknown that they are factors of."""
    return isinstance(letter, Quantity), str(letter)


def _written(number: Rational, letters: Sequence[Expr]) -> Expr:
    """A term with its number first, and a minus before it where it is negative."""
    powers = Mul.make_args(Mul(*(letter for letter in letters if not isinstance(letter, Quantity))))
    unknown = [letter for letter in letters if isinstance(letter, Quantity)]
    factors = [factor for factor in (*powers, *unknown) if factor != 1]
    sign = [sympy.S.NegativeOne] if number < 0 else []
    size = [abs(number)] if abs(number) != 1 or not factors else []
    every = [*sign, *size, *factors]
    return Mul._from_args(every) if len(every) > 1 else every[0]
