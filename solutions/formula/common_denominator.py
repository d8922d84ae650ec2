"""Quotients in a letter left open, brought to a common denominator before they are added."""

from functools import reduce
from operator import add, mul

import sympy
from flint import fmpq
from sympy import Add, Expr, Mul, Pow

from rldrill.solutions.exact import is_rational, ordered, simplest, to_sympy
from rldrill.solutions.formula.node import Node
from rldrill.solutions.formula.nodes.leaves import MatrixLeaf
from rldrill.solutions.formula.putting_in import evaluated
from rldrill.solutions.rational import common_denominator, generator
from rldrill.solutions.value import Value


def in_one_fraction(expression: Expr) -> Expr | None:
    """A sum of quotients in one letter as one fraction, whose numerator is still to be added up; None if it is none."""
    if not expression.is_Add or len(expression.free_symbols) != 1 or any(map(_is_open, expression.atoms(Node))):
        return None
    values = [_value(evaluated(term)) for term in expression.args]
    known = [value for value in values if value is not None]
    below = _below(known) if len(known) == len(values) else None
    if below is None or is_rational(below):
        return None
    return _over([_in_order(value * below) for value in known], below)


def _below(values: list[Value]) -> Value | None:
    """The common denominator, with whole coefficients."""
    shared = common_denominator(values)
    whole = None if shared is None else common_denominator([shared])
    return None if shared is None or whole is None else shared * whole


def brackets_in_one_fraction(expression: Expr) -> Expr:
    """A sum of products, with one fraction in place of every bracket that adds quotients in a letter."""
    if expression.is_Add:
        return Add(*(_with_brackets_added(term) for term in expression.args), evaluate=False)
    numbers = _in_numbers(expression)
    added = _with_brackets_added(numbers)
    return _multiplied(expression) or (expression if added == numbers else added)


def _in_numbers(product: Expr) -> Expr:
    """A product with numbers in the place of its 1×1 matrices, if all of its matrices are so small."""
    matrices = product.atoms(MatrixLeaf)
    if not all(matrix.scalar for matrix in matrices):
        return product
    numbers = {matrix: matrix.args[0][0] for matrix in matrices}
    return Mul._from_args([factor.xreplace(numbers) for factor in Mul.make_args(product)])


def _multiplied(quotient: Expr) -> Expr | None:
    """A quotient below whose line stands another, both sides of the line multiplied; None where that is not so."""
    above, below = sympy.fraction(quotient, exact=True)
    if not below.is_Add or below.is_polynomial() or in_one_fraction(below) is None:
        return None
    values = [_value(evaluated(part)) for part in (above, *below.args)]
    factor = _below([value for value in values[1:] if value is not None])
    if factor is None:
        return None
    top, *bottom = (_in_order(value * factor) for value in values if value is not None)
    return Mul(top, Pow(Add(*bottom, evaluate=False), -1, evaluate=False), evaluate=False)


def _with_brackets_added(term: Expr) -> Expr:
    if not term.is_Mul or not any(in_one_fraction(factor) for factor in term.args):
        return term
    factors = [_added(factor) if in_one_fraction(factor) else factor for factor in term.args]
    return Mul(*sorted(factors, key=lambda factor: not factor.is_Rational), evaluate=False)


def _added(bracket: Expr) -> Expr:
    """The value of a bracket, as one fraction."""
    value = _value(evaluated(bracket))
    below = None if value is None else _below([value])
    return bracket if value is None or below is None else _over([_in_order(value * below)], below)


def _over(above: list[Expr], below: Value) -> Expr:
    top = Add(*above, evaluate=False) if len(above) > 1 else above[0]
    return Mul(top, Pow(_in_order(below), -1, evaluate=False), evaluate=False)


def _in_order(value: Value) -> Expr:
    return ordered(to_sympy(simplest(value)))


def _value(expression: Expr) -> Value | None:
    """An expression of numbers and one letter as a value; None where there is something else in it, such as a root."""
    if expression.is_Rational:
        return fmpq(int(expression.p), int(expression.q))
    if expression.is_Symbol:
        return generator(expression.name)
    if expression.is_Pow and expression.exp.is_Integer:
        base = _value(expression.base)
        return None if base is None else base ** int(expression.exp)
    if not (expression.is_Add or expression.is_Mul):
        return None
    values = [_value(argument) for argument in expression.args]
    known = [value for value in values if value is not None]
    return reduce(add if expression.is_Add else mul, known) if len(known) == len(values) else None


def _is_open(node: Node) -> bool:
    """Whether a node holds something that is not worked out."""
    return not node.args or not all(getattr(argument, "is_number", True) for argument in node.args)
