"""Quotients in a letter left open, brought to a common denominator before they are added."""

from functools import reduce

import sympy
from sympy import Add, Expr, Mul, Pow

from rldrill.solutions.exact import ordered
from rldrill.solutions.formula.node import Node
from rldrill.solutions.formula.putting_in import evaluated


def in_one_fraction(expression: Expr) -> Expr | None:
    """A sum of quotients in one letter as one fraction, whose numerator is still to be added up; None if it is none."""
    letters = expression.free_symbols
    if not expression.is_Add or (expression.has(Node) and any(_is_open(node) for node in expression.atoms(Node))):
        return None
    if len(letters) != 1:
        return None
    values = [evaluated(term) for term in expression.args]
    if not all(isinstance(value, Expr) and value.is_rational_function(*letters) for value in values):
        return None
    quotients = [sympy.fraction(sympy.cancel(value)) for value in values]
    below = [denominator for _, denominator in quotients]
    shared = reduce(sympy.lcm, below)
    if not shared.free_symbols or len({denominator for denominator in below if denominator.free_symbols}) == len(
        {shared}
    ) == len(set(below)):
        return None
    shared = sympy.expand(shared)
    if ordered(shared).args[0].could_extract_minus_sign():  # 1 − γ, not −1 + γ
        shared = sympy.expand(-shared)
    above = [ordered(sympy.expand(sympy.cancel(value * shared))) for value in values]
    return Mul(Add(*above, evaluate=False), Pow(ordered(shared), -1, evaluate=False), evaluate=False)


def _is_open(node: Node) -> bool:
    """Whether a node holds something that is not worked out."""
    return not node.args or not all(getattr(argument, "is_number", True) for argument in node.args)
