"""The exact reading of a formula: compiled once into a Python function over exact values."""

import keyword
from collections.abc import Callable, Mapping, Sequence
from functools import cache, partial
from math import factorial
from typing import Any

import sympy
from flint import fmpq
from sympy import Expr
from sympy.printing.precedence import PRECEDENCE
from sympy.printing.str import StrPrinter

from rldrill.solutions.exact import ONE, NoSolution, NotGiven, Value, equal, largest, monomial, simplest
from rldrill.solutions.formula.node import Node
from rldrill.solutions.limits import rooted
from rldrill.solutions.matrices import is_matrix


class Compiler(StrPrinter):
    """Prints a formula as Python; nodes print themselves, and name the functions that they call."""

    printmethod = "_compiled"

    def __init__(self) -> None:
        super().__init__({"order": "none"})
        self.names: dict[str, Any] = {}

    def __call__(self, expression: Expr) -> str:
        """An expression as Python."""
        return self._print(expression)

    def call(self, node: Node, *arguments: str) -> str:
        """A call of a node's own function."""
        name = type(node).__name__
        self.names[name] = node.value
        return f"{name}({', '.join(arguments)})"

    def _print_Symbol(self, expression: Any) -> str:
        return _checked(str(expression.name))

    def _print_Rational(self, expression: Any) -> str:
        return f"Rational({expression.p}, {expression.q})"

    def _print_Add(self, expression: Any, order: Any = None) -> str:  # noqa: ARG002
        return " + ".join(self.parenthesize(term, PRECEDENCE["Add"]) for term in expression.args)

    def _print_Mul(self, expression: Any) -> str:
        first, *others = expression.args
        minus = first == -1 and len(others) > 0
        factors = others if minus else expression.args
        written = "*".join(self.parenthesize(factor, PRECEDENCE["Mul"], strict=True) for factor in factors)
        return f"-{written}" if minus else written

    def _print_Pow(self, expression: Any, rational: bool = False) -> str:  # noqa: ARG002
        base, exponent = expression.args
        if exponent == -1:
            return f"inverse({self(base)})"
        if exponent.is_Rational and exponent.q == 2:
            root = f"root({self(base)})**{abs(exponent.p)}"
            return f"inverse({root})" if exponent.is_negative else f"({root})"
        if exponent.is_Integer and exponent.is_negative:
            return f"inverse(({self(base)})**{-exponent})"
        return f"(({self(base)})**({self(exponent)}))"

    def _print_Function(self, expression: Any) -> str:
        function = expression.func.__name__
        if function not in _NAMES:
            raise TypeError(f"{function!r} is not a function that is computed with")
        return f"{function}({', '.join(map(self, expression.args))})"


def _checked(name: str) -> str:
    # The letters of dynamics in a problem file come here too: nothing but a name may reach the compiler.
    if not name.isidentifier() or keyword.iskeyword(name):
        raise ValueError(f"{name!r} is not the name of a letter")
    return name


class DivisionError(NoSolution):
    """A formula divides by zero, or inverts a singular matrix."""


def _inverse(value: Any) -> Any:
    try:
        return ONE / value if type(value) is fmpq or not is_matrix(value) else value.inv()
    except ZeroDivisionError:
        raise DivisionError("it would divide by zero, or invert a singular matrix") from None


def _root(value: Value) -> Value:
    if isinstance(value, fmpq) and value < 0:
        raise NoSolution("there is no root of a negative number")
    return simplest(sympy.sqrt(sympy.sympify(rooted(value), strict=True)))


def _factorial(value: Value) -> Value:
    number = fmpq(value)
    if number.denominator != 1 or number < 0:
        raise NoSolution("only whole numbers from 0 on have a factorial here")
    return fmpq(factorial(int(number.numerator)))


def _exp(value: Value) -> Value:
    power = simplest(sympy.exp(sympy.sympify(value, strict=True)))
    return monomial(power) if isinstance(power, sympy.Expr) else power  # e^(ln x) is x


def _log(value: Value) -> Value:
    return sympy.log(sympy.sympify(value, strict=True))


@cache
def _circular(function: Callable[[Expr], Expr], angle: Value) -> Value:
    value = simplest(function(sympy.sympify(angle, strict=True)))
    if value is sympy.zoo:
        raise NoSolution("the tangent of a right angle does not exist")
    return value


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
    "Rational": fmpq,
}


@cache
def needs(expression: Expr) -> tuple[str, ...]:
    """The names that values must be given for, sorted."""
    codes = {node.code for node in sympy.preorder_traversal(expression) if isinstance(node, Node) and node.code}
    return tuple(sorted(codes | {symbol.name for symbol in expression.free_symbols}))


@cache
def compiled(expression: Expr) -> Callable[[Mapping[str, Any]], Any]:
    """The expression as a Python function of what is known.

    What is compiled is printed from a tree of our own node types. Of what a person types, only the letters of dynamics
    get here: they are names by ``problems.expressions.letter``, have a prefix of their own, are checked once more where
    they are printed, and are looked up in what is known. Typed answers and the names of states never do.
    """
    compiler = Compiler()
    names = "".join([f"{_checked(name)} := known['{name}'], " for name in needs(expression)])
    source = f"lambda known: ({names}{compiler.doprint(expression)},)[-1]"
    return eval(compile(source, f"<{expression.func.__name__}>", "eval"), _NAMES | compiler.names)


#: The functions of expressions by their identity: to look for an expression itself takes as long as many a formula.
_REMEMBERED = 4096
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
            if len(_FUNCTIONS) == _REMEMBERED:  # a problem of its own dynamics brings its own expressions
                _FUNCTIONS.clear()
            found = _FUNCTIONS[id(expression)] = expression, compiled(expression)
        return found[1](known)
    except LookupError as error:
        raise NotGiven(f"no value is given for {error.args[0]!r}, which the formula needs") from None
