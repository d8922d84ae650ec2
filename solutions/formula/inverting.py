"""The inverse of a 2×2 matrix in a step, as it is worked out by hand: the adjugate over the determinant."""

import sympy
from sympy import Expr, Mul

from rldrill.solutions.formula.nodes.leaves import MatrixLeaf, computed


def inverted(expression: Expr) -> Expr:
    """The expression with the adjugate over the determinant in the place of the inverse of a 2×2 matrix."""
    if expression.is_Add:
        return expression.func(*map(inverted, expression.args), evaluate=False)
    factors = Mul.make_args(expression)
    if not any(map(_is_inverse, factors)):
        return expression
    number = sympy.S.One
    kept: list[Expr] = []
    for factor in factors:
        if _is_inverse(factor):
            (a, b), (c, d) = factor.args[0].args[0].tolist()
            number = number / sympy.radsimp(a * d - b * c)
            kept.append(MatrixLeaf([[d, -b], [-c, a]]))
        elif factor == -1:
            number = -number
        else:
            kept.append(factor)
    number = sympy.radsimp(number)
    return Mul._from_args([computed(number), *kept] if number != 1 else kept)


def _is_inverse(factor: Expr) -> bool:
    """Whether this is the inverse of a 2×2 matrix of numbers."""
    if not (factor.is_Pow and factor.args[1] == -1 and isinstance(factor.args[0], MatrixLeaf)):
        return False
    matrix = factor.args[0].args[0]
    return bool(matrix.shape == (2, 2) and not matrix.free_symbols and matrix.det() != 0)
