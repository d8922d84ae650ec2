"""The exact reading of a formula: compiled once into a Python function over exact values."""

import keyword
from collections.abc import Callable, Mapping, Sequence
from functools import cache, lru_cache, partial
from math import factorial
from typing import Any

import sympy
from flint import fmpq
from sympy import Expr

from rldrill.solutions.exact import (
    ONE,
    NoSolution,
    NotGiven,
    Value,
    equal,
    is_closed,
    is_zero,
    largest,
    monomial,
    parameters,
    sign,
    simplest,
)
from rldrill.solutions.formula.node import Node
from rldrill.solutions.limits import raised, rooted
from rldrill.solutions.matrices import is_matrix

#: So many expressions are kept: a problem of its own dynamics brings its own.
_REMEMBERED = 4096


@lru_cache(maxsize=_REMEMBERED)
def python(expression: Expr) -> str:
    """An expression as Python; nodes write themselves.

    It is kept: most parts of a formula are those of its misreadings, and of all that somebody may have made of it.
    """
    if isinstance(expression, Node):
        return expression._compiled(python)
    if expression.is_Symbol:
        return _checked(str(expression.name))
    if expression.is_Integer:
        return str(expression)
    if expression.is_Rational:
        return f"Rational({expression.p}, {expression.q})"
    if expression.is_Add:
        return " + ".join([_bracketed(term) if term.is_Add else python(term) for term in expression.args])
    if expression.is_Mul:
        return _product(expression.args)
    if expression.is_Pow:
        return _power(*expression.args)
    if expression in (sympy.nan, sympy.zoo, sympy.oo):
        raise NoSolution("an expression divides by 0, whatever numbers are put in")
    function = _CONSTANTS.get(expression) or expression.func.__name__
    if function not in _NAMES:
        raise TypeError(f"{function!r} is not a function that is computed with")
    return f"{function}({', '.join(map(python, expression.args))})" if expression.args else function


def _bracketed(expression: Expr) -> str:
    return f"({python(expression)})"


def _product(factors: Sequence[Expr]) -> str:
    minus = factors[0] is sympy.S.NegativeOne and len(factors) > 1
    written = [_bracketed(each) if each.is_Add or each.is_Mul else python(each) for each in factors[minus:]]
    return f"{'-' if minus else ''}{'*'.join(written)}"


def _power(base: Expr, exponent: Expr) -> str:
    if exponent is sympy.S.NegativeOne:
        return f"inverse({python(base)})"
    if exponent.is_Rational and exponent.q > 1:
        roots = int(exponent.q).bit_length() - 1
        if exponent.q != 2**roots:
            raise NoSolution(f"there are square roots, and no power of {exponent}")
        root = f"{'root(' * roots}{python(base)}{')' * roots}**{abs(exponent.p)}"
        return f"inverse({root})" if exponent.is_negative else f"({root})"
    if exponent.is_Integer and exponent.is_negative:
        return f"inverse(({python(base)})**{-exponent})"
    return f"(({python(base)})**({python(exponent)}))"


def _checked(name: str) -> str:
    # The letters of dynamics in a problem file come here too: nothing but a name may reach the compiler.
    if not name.isidentifier() or keyword.iskeyword(name):
        raise ValueError(f"{name!r} is not the name of a letter")
    return name


class DivisionError(NoSolution):
    """A formula divides by zero, or inverts a singular matrix."""


def _inverse(value: Any) -> Any:
    try:
        if type(value) is not fmpq and is_matrix(value):
            return value.inv()
        if is_closed(value) and not parameters(value) and is_zero(value):  # sympy's quotient has no value then
            raise ZeroDivisionError
        return ONE / value
    except ZeroDivisionError:
        raise DivisionError("it would divide by zero, or invert a singular matrix") from None


def _root(value: Value) -> Value:
    if not parameters(value) and sign(value) < 0:
        raise NoSolution("there is no root of a negative number")
    return simplest(sympy.sqrt(sympy.sympify(rooted(value), strict=True)))


def _factorial(value: Value) -> Value:
    number = fmpq(value)
    if number.denominator != 1 or number < 0:
        raise NoSolution("only whole numbers from 0 on have a factorial here")
    return fmpq(factorial(int(number.numerator)))


def _exp(value: Value) -> Value:
    power = simplest(sympy.exp(raised(sympy.sympify(value, strict=True))))
    return monomial(power) if isinstance(power, sympy.Expr) else power  # e^(ln x) is x


def _log(value: Value) -> Value:
    return sympy.log(sympy.sympify(value, strict=True))


@cache
def _circular(function: Callable[[Expr], Expr], angle: Value) -> Value:
    value = function(sympy.sympify(angle, strict=True))
    if value is sympy.zoo:
        raise NoSolution("the tangent of a right angle does not exist")
    return simplest(value.replace(sympy.cot, lambda rest: 1 / sympy.tan(rest)))


def arg_max(keys: Sequence[Any], values: Sequence[Value]) -> tuple[Any, ...]:
    """All keys whose value is the greatest, in their order."""
    best = largest(values)
    return tuple([key for key, value in zip(keys, values, strict=True) if equal(best, value)])


#: All that a compiled formula can call, besides the values of its nodes: nothing of Python's own is among it.
_NAMES = {
    "__builtins__": {},
    "Abs": abs,
    "root": _root,
    "inverse": _inverse,
    "factorial": _factorial,
    "exp": _exp,
    "log": _log,
    "sin": partial(_circular, sympy.sin),
    "cos": partial(_circular, sympy.cos),
    "tan": partial(_circular, sympy.tan),
    "pi": sympy.pi,
    "e": sympy.E,
    "Rational": fmpq,
}
_CONSTANTS = {sympy.pi: "pi", sympy.E: "e"}


def needs(expression: Expr) -> tuple[str, ...]:
    """The names that values must be given for, sorted."""
    return tuple(sorted(_needs(expression)))


@lru_cache(maxsize=_REMEMBERED)
def _needs(expression: Expr) -> frozenset[str]:
    if expression.is_Symbol:
        return frozenset((expression.name,))
    if isinstance(expression, Node):
        return expression._needs(_needs)
    return frozenset().union(*map(_needs, expression.args))


@lru_cache(maxsize=_REMEMBERED)
def _nodes(expression: Expr) -> frozenset[type[Node]]:
    """What kinds of nodes there are in it."""
    own = (type(expression),) if isinstance(expression, Node) else ()
    return frozenset(own).union(*map(_nodes, expression.args))


@lru_cache(maxsize=_REMEMBERED)
def compiled(expression: Expr) -> Callable[[Mapping[str, Any]], Any]:
    """The expression as a Python function of what is known.

    What is compiled is written from a tree of our own node types. Of what a person types, only the letters of dynamics
    get here: they are names by ``problems.expressions.letter``, have a prefix of their own, are checked once more where
    they are written, and are looked up in what is known. Typed answers and the names of states never do.
    """
    names = "".join([f"{_checked(name)} := known['{name}'], " for name in needs(expression)])
    source = f"lambda known: ({names}{python(expression)},)[-1]"
    called = {kind.__name__: kind.value for kind in _nodes(expression) if hasattr(kind, "value")}
    return eval(compile(source, f"<{expression.func.__name__}>", "eval"), _NAMES | called)


#: The functions of expressions by their identity: to look for an expression itself takes as long as many a formula.
_FUNCTIONS: dict[int, tuple[Expr, Callable[[Mapping[str, Any]], Any]]] = {}


def value_of(expression: Expr, known: Mapping[str, Any]) -> Any:
    """The exact value of an expression.

    Raises:
        NotGiven: a value is missing.
        NoSolution: it has no value.
    """
    try:
        found = _FUNCTIONS.get(id(expression))
        if found is None:
            if len(_FUNCTIONS) == _REMEMBERED:
                _FUNCTIONS.clear()
            found = _FUNCTIONS[id(expression)] = expression, compiled(expression)
        return found[1](known)
    except LookupError as error:
        raise NotGiven(f"no value is given for {error.args[0]!r}, which the formula needs") from None
    except ZeroDivisionError:  # 0 raised to a power below 0
        raise DivisionError("it would divide by zero") from None
