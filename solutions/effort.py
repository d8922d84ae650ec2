"""How long a problem takes by hand: estimated from its own steps, from operations and from digits."""

from fractions import Fraction

import sympy
from sympy import Expr

from rldrill.solutions.exact import parameters
from rldrill.solutions.formula.node import Node
from rldrill.solutions.solution import Solution
from rldrill.solutions.work import Result, Step

#: Seconds, as for somebody who knows the formula: to read a part, to write down a step, to do an
#: operation, and to handle one digit of a number in it.
PART, STEP, OPERATION, DIGIT = 30, 6, 3, Fraction(3, 2)
#: A letter left open is as much trouble as this many digits: its terms must be kept apart and collected.
LETTER = 9


def minutes(solution: Solution) -> Fraction:
    """The time that a problem takes by hand, in minutes."""
    seconds = Fraction(PART * len(solution.problem.parts))
    unknowns = 0
    for line in solution.lines:
        if isinstance(line, Step):
            seconds += STEP + _seconds(line.put_in)
            unknowns += line.value is None
        elif isinstance(line, Result):
            # Elimination: about n³/3 operations, on numbers that grow to three or four digits.
            size = LETTER if any(map(parameters, line.values)) else 3
            seconds += (OPERATION + size * DIGIT) * Fraction(unknowns**3 + 3 * unknowns**2, 3)
            unknowns = 0
    return seconds / 60


def whole(time: Fraction) -> int:
    """Minutes as they are told: whole, and at least 1."""
    return max(1, round(time))


def _seconds(expression: Expr) -> Fraction:
    operations = digits = 0
    for node in sympy.preorder_traversal(expression):
        if isinstance(node, Node):
            operations += node.operations
            digits += sum(map(_digits, node.numbers))
        elif node.is_Rational:
            digits += _digits(node)
        elif node.is_Symbol:
            digits += LETTER
        elif node.is_Add or node.is_Mul:
            operations += len(node.args) - 1
        elif node.is_Function or node.is_Pow:
            operations += 1
    return OPERATION * operations + DIGIT * digits


def _digits(number: Expr) -> int:
    if not number.is_Rational:
        return 2
    return len(str(abs(number.p))) + (len(str(number.q)) if number.q != 1 else 0)
