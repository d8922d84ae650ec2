"""The exact reading of a formula: compiled once into a Python function over exact values."""

import keyword
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from math import factorial, prod
from typing import Any

import sympy
from flint import fmpq
from sympy import Expr
from sympy.printing.precedence import PRECEDENCE
from sympy.printing.str import StrPrinter

from rldrill.solutions.exact import ONE, ZERO, NoSolution, Value, largest, monomial, sign, simplest
from rldrill.solutions.formula.notation import Counting, Over, Quantity
from rldrill.solutions.matrices import is_matrix, stacked


class _Code(StrPrinter):
    """Prints a formula as Python; every quantity is a lookup in what it is bound to."""

    def __init__(self) -> None:
        super().__init__({"order": "none"})

    def _print_Symbol(self, expression: Any) -> str:
        # The letters of dynamics in a problem file come here too: nothing but a name may reach the compiler.
        name = str(expression.name)
        if not name.isidentifier() or keyword.iskeyword(name):
            raise ValueError(f"{name!r} is not the name of a letter")
        return name

    def _print_Integer(self, expression: Any) -> str:
        return str(expression.p)

    def _print_Rational(self, expression: Any) -> str:
        return f"Rational({expression.p}, {expression.q})"

    def _print_Add(self, expression: Any, order: Any = None) -> str:  # noqa: ARG002
        return " + ".join(self.parenthesize(term, PRECEDENCE["Add"]) for term in expression.args)

    def _print_Mul(self, expression: Any) -> str:
        return "*".join(self.parenthesize(factor, PRECEDENCE["Mul"], strict=True) for factor in expression.args)

    def _print_Pow(self, expression: Any, rational: bool = False) -> str:  # noqa: ARG002
        base, exponent = expression.args
        if exponent == -1:
            return f"inverse({self._print(base)})"
        if exponent.is_Rational and exponent.q == 2:
            root = f"root({self._print(base)})**{abs(exponent.p)}"
            return f"inverse({root})" if exponent.is_negative else f"({root})"
        if exponent.is_Integer and exponent.is_negative:
            return f"inverse(({self._print(base)})**{-exponent})"
        return f"(({self._print(base)})**({self._print(exponent)}))"

    def _print_Quantity(self, expression: Any) -> str:
        return f"{expression.code}[{', '.join(map(self._print, expression.args))}]"

    _print_Function = _print_Quantity

    def _print_Abs(self, expression: Any) -> str:
        return f"abs({self._print(expression.args[0])})"

    def _circular(self, expression: Any) -> str:
        return f"{expression.func.__name__}({self._print(expression.args[0])})"

    _print_sin = _print_cos = _print_tan = _circular

    def _print_Pi(self, expression: Any) -> str:  # noqa: ARG002
        return "pi"

    def _print_exp(self, expression: Any) -> str:
        return f"exp({self._print(expression.args[0])})"

    def _print_log(self, expression: Any) -> str:
        return f"log({self._print(expression.args[0])})"

    def _print_factorial(self, expression: Any) -> str:
        return f"factorial({self._print(expression.args[0])})"

    def _over(self, expression: Over) -> str:
        return f"[{self._print(expression.body)} for {expression.index} in {self._print(expression.domain)}]"

    def _print_SumOver(self, expression: Over) -> str:
        return f"total({self._over(expression)})"

    def _print_ProductOver(self, expression: Over) -> str:
        return f"product({self._over(expression)})"

    def _print_MaxOver(self, expression: Over) -> str:
        return f"largest({self._over(expression)})"

    def _print_MeanOver(self, expression: Over) -> str:
        return f"mean({self._over(expression)})"

    def _print_ArgMaxOver(self, expression: Over) -> str:
        keys = self._print(expression.domain)
        return f"arg_max({keys}, {self._over(expression)})"

    def _listed(self, expression: Any) -> str:
        return f"[{', '.join(map(self._print, expression.args))}]"

    def _print_Greatest(self, expression: Any) -> str:
        return f"largest({self._listed(expression)})"

    def _print_Least(self, expression: Any) -> str:
        return f"least({self._listed(expression)})"

    def _print_Clipped(self, expression: Any) -> str:
        value, low, high = map(self._print, expression.args)
        return f"largest([{low}, least([{value}, {high}])])"

    def _print_Expected(self, expression: Any) -> str:
        return self._print(expression.args[0])

    def _print_Counting(self, expression: Counting) -> str:
        first, last, _ = expression.args
        return f"range({self._print(first)}, {self._print(last)} + 1)"

    def _print_Indicator(self, expression: Any) -> str:
        names = [self._print(argument) for argument in expression.args]
        same = [f"{left} == {right}" for left, right in zip(names[::2], names[1::2], strict=True)]
        return f"(1 if {' and '.join(same)} else 0)"

    def _print_Member(self, expression: Any) -> str:
        element, domain = map(self._print, expression.args)
        return f"({element} in {domain})"

    def _print_Cases(self, expression: Any) -> str:
        condition, then, otherwise = map(self._print, expression.args)
        return f"(({then}) if {condition} else ({otherwise}))"

    def _print_Size(self, expression: Any) -> str:
        return f"len({self._print(expression.args[0])})"

    def _print_Transposed(self, expression: Any) -> str:
        return f"({self._print(expression.args[0])}).transpose()"

    def _print_Blocks(self, expression: Any) -> str:
        return f"stacked({', '.join(map(self._print, expression.args))})"


def _total(values: Sequence[Value]) -> Value:
    return sum(values[1:], values[0]) if values else ZERO  # matrices cannot be added to 0


def _product(values: Sequence[Value]) -> Value:
    return prod(values, start=ONE)


def _mean(values: Sequence[Value]) -> Value:
    return sum(values, ZERO) / len(values)


class DivisionError(NoSolution):
    """A formula divides by zero, or inverts a singular matrix."""


def _inverse(value: Any) -> Any:
    try:
        return value.inv() if is_matrix(value) else ONE / value
    except ZeroDivisionError:
        raise DivisionError("it would divide by zero, or invert a singular matrix") from None


def _least(values: Sequence[Value]) -> Value:
    return -largest([-value for value in values])


def _root(value: Value) -> Value:
    if isinstance(value, fmpq) and value < 0:
        raise NoSolution("there is no root of a negative number")
    return simplest(sympy.sqrt(sympy.sympify(value, strict=True)))


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
def _sine(angle: Value) -> Value:
    return simplest(sympy.sin(sympy.sympify(angle, strict=True)))


@cache
def _cosine(angle: Value) -> Value:
    return simplest(sympy.cos(sympy.sympify(angle, strict=True)))


@cache
def _tangent(angle: Value) -> Value:
    value = simplest(sympy.tan(sympy.sympify(angle, strict=True)))
    if value is sympy.zoo:
        raise NoSolution("the tangent of a right angle does not exist")
    return value


def arg_max(keys: Sequence[Any], values: Sequence[Value]) -> tuple[Any, ...]:
    """All keys whose value is the greatest, in their order."""
    best = largest(values)
    return tuple(key for key, value in zip(keys, values, strict=True) if sign(best - value) == 0)


#: All that a compiled formula can call: Python's own functions are not among it, unless they are named here.
_NAMES = {
    "__builtins__": {},
    "abs": abs,
    "total": _total,
    "product": _product,
    "root": _root,
    "len": len,
    "mean": _mean,
    "largest": largest,
    "least": _least,
    "arg_max": arg_max,
    "inverse": _inverse,
    "factorial": _factorial,
    "exp": _exp,
    "log": _log,
    "sin": _sine,
    "cos": _cosine,
    "tan": _tangent,
    "pi": sympy.pi,
    "stacked": stacked,
    "Rational": fmpq,
    "range": range,
}


@cache
def needs(expression: Expr) -> tuple[str, ...]:
    """The names that values must be given for, sorted."""
    codes = {node.code for node in sympy.preorder_traversal(expression) if isinstance(node, Quantity)}
    return tuple(sorted(codes | {symbol.name for symbol in expression.free_symbols}))


@cache
def compiled(expression: Expr) -> Callable[..., Any]:
    """The expression as a Python function of the names that it needs, in their order.

    What is compiled is printed from a tree of our own node types. Of what a person types, only the letters of dynamics
    get here: they are names by ``problems.expressions.letter``, have a prefix of their own, are checked once more where
    they are printed, and are bound as arguments. Typed answers and the names of states never do.
    """
    source = f"lambda {', '.join(needs(expression))}: {_Code().doprint(expression)}"
    return eval(compile(source, f"<{expression.func.__name__}>", "eval"), dict(_NAMES))


def value_of(expression: Expr, known: Mapping[str, Any]) -> Any:
    """The exact value of an expression.

    Raises:
        TypeError: a value is missing.
        NoSolution: it has no value.
    """
    try:
        values = [known[name] for name in needs(expression)]
    except KeyError as error:
        raise TypeError(f"no value is given for {error.args[0]!r}, which the formula needs") from None
    return compiled(expression)(*values)
