"""An inverse in a step, as it is worked out by hand: one over a number, the adjugate over the determinant."""

import sympy
from sympy import Expr, Mul

from rldrill.solutions.exact import is_zero, tidy, to_sympy
from rldrill.solutions.formula.nodes.leaves import MatrixLeaf, computed


def inverted(expression: Expr) -> Expr:
    """The expression with what is worked out in the place of the inverse of a number or of a 2×2 matrix."""
    if expression.is_Add:
        return expression.func(*map(inverted, expression.args), evaluate=False)
    factors = Mul.make_args(expression)
    if not any(map(_is_inverse, factors)):
        return expression
    number = sympy.S.One
    kept: list[Expr] = []
    for factor in factors:
        if _is_inverse(factor):
            matrix = factor.args[0].args[0]
            number = number / sympy.radsimp(_determinant(matrix))
            if matrix.rows == 2:
                (a, b), (c, d) = matrix.tolist()
                kept.append(MatrixLeaf([[d, -b], [-c, a]]))
        elif factor == -1:
            number = -number
        else:
            kept.append(factor)
    number = sympy.radsimp(number)
    return Mul._from_args([computed(number), *kept] if number != 1 else kept)


def _is_inverse(factor: Expr) -> bool:
    """Whether this is the inverse of a 1×1 or 2×2 matrix of numbers."""
    if not (factor.is_Pow and factor.args[1] == -1 and isinstance(factor.args[0], MatrixLeaf)):
        return False
    matrix = factor.args[0].args[0]
    return bool(matrix.shape in ((1, 1), (2, 2)) and not matrix.free_symbols and not is_zero(_determinant(matrix)))


def _determinant(matrix: sympy.ImmutableMatrix) -> Expr:
    """That of a 1×1 or 2×2 matrix; sympy's own looks long for what cancels in it."""
    if matrix.rows == 1:
        return matrix[0, 0]
    (a, b), (c, d) = matrix.tolist()
    return to_sympy(tidy(sympy.expand(a * d - b * c)))
