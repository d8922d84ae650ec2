"""How long a problem takes by hand, estimated from its own steps, operations and digits; and the points that follow."""

from collections.abc import Iterable

import sympy
from sympy import Expr

from rldrill.problems.fractions import Fraction
from rldrill.solutions.exact import parameters
from rldrill.solutions.formula.node import Node
from rldrill.solutions.formula.nodes.leaves import Slot
from rldrill.solutions.formula.nodes.sets import Over
from rldrill.solutions.formula.putting_in import without_slots
from rldrill.solutions.solution import Solution
from rldrill.solutions.work import Elimination, Line, Result, Step

#: Seconds, as for somebody who knows the formula: to read a part, to write down a step, to do an
#: operation, and to handle one digit of a number in it.
PART, STEP, OPERATION, DIGIT = 40, 8, 3, Fraction(3, 2)
#: Nobody reads, answers and checks a part in less than this.
LEAST = Fraction(1)
#: A letter left open is as much trouble as this many digits: its terms must be kept apart and collected.
LETTER = 9
#: Where nothing is added to it, only its power is counted.
LONE_LETTER = 2


def minutes(solution: Solution) -> Fraction:
    """The time that a problem takes by hand, in minutes."""
    return sum((minutes_of(solution, part.label) for part in solution.problem.parts), Fraction(0))


def minutes_of(solution: Solution, label: str) -> Fraction:
    """The time that one part takes by hand, in minutes: what is written for it, and at least one minute."""
    return max(LEAST, (PART + seconds_of(solution.lines_of(label))) / Fraction(60))


def points(solution: Solution) -> dict[str, int]:
    """What every part earns: a point for a minute and a half, so that a point is never less than 1 or more than 2."""
    return {part.label: whole_points(minutes_of(solution, part.label)) for part in solution.problem.parts}


def whole_points(time: Fraction) -> int:
    """The points for minutes, at least one: one up to two minutes, one more for every minute and a half then."""
    return int((time + 1) * 2 / 3)


def seconds_of(lines: Iterable[Line]) -> Fraction:
    """The seconds that lines of a working take to be worked out and written."""
    seconds = Fraction(0)
    unknowns = 0
    for line in lines:
        if isinstance(line, Step):
            seconds += STEP + _seconds(line.put_in)
            unknowns += line.value is None
        elif isinstance(line, Result | Elimination) and unknowns:
            # Elimination: about n³/3 operations, each written down, on numbers that grow to three or four digits.
            size = LETTER if any(map(parameters, line.values)) else 3
            seconds += (2 * OPERATION + size * DIGIT) * Fraction(unknowns**3 + 3 * unknowns**2, 3)
            unknowns = 0
    return seconds


def whole(time: Fraction) -> int:
    """Minutes as they are told: whole, and at least 1."""
    return max(1, round(time))


def _seconds(expression: Expr) -> Fraction:
    letter = LETTER if without_slots(expression).has(sympy.Add) else LONE_LETTER
    operations = digits = 0
    plain = Fraction(0)
    nodes = sympy.preorder_traversal(expression)
    for node in nodes:
        if node.is_Pow and isinstance(node.args[1], Slot):  # nobody works out the power 0 or 1
            nodes.skip()
            plain += _seconds(node.args[0]) if node.args[1].args[0] == 1 else 0
        elif node.is_Mul and any(isinstance(factor, Slot) and factor.args[0] == 0 for factor in node.args):
            nodes.skip()  # nor a product with 0
            operations += 1
        elif isinstance(node, Over):  # what it runs over is no work
            nodes.skip()
            plain += _seconds(node.body)
        elif isinstance(node, Node):
            operations += node.operations
            digits += sum(map(_digits, node.numbers))
        elif node.is_Rational:
            digits += _digits(node)
        elif node.is_Symbol:
            digits += letter
        elif node.is_Add or node.is_Mul:
            operations += len(node.args) - 1
        elif node.is_Function or node.is_Pow:
            operations += 1
    return plain + OPERATION * operations + DIGIT * digits


def _digits(number: Expr) -> int:
    if not number.is_Rational:
        return 2
    return len(str(abs(number.p))) + (len(str(number.q)) if number.q != 1 else 0)
