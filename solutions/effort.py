"""How long a problem takes by hand, estimated from its own steps, operations and digits; and the points that follow."""

from collections.abc import Iterable
from functools import reduce
from typing import TypeAlias

import sympy
from sympy import Expr

from rldrill.problems.fractions import Fraction
from rldrill.solutions.exact import parameters
from rldrill.solutions.formula.node import Node
from rldrill.solutions.formula.nodes.leaves import MatrixLeaf, Slot
from rldrill.solutions.formula.nodes.matrices import Transposed
from rldrill.solutions.formula.nodes.sets import Over
from rldrill.solutions.formula.putting_in import without_slots
from rldrill.solutions.solution import Solution
from rldrill.solutions.work import Elimination, Equality, Line, Result, Step

#: Seconds, as for somebody who knows the formula: to read a part, to write down a step, to do an
#: operation, and to handle one digit of a number in it.
PART, STEP, OPERATION, DIGIT = 40, 8, 3, Fraction(3, 2)
#: An equation is written once more with the same done to both sides, on numbers of three digits.
REARRANGED = STEP + 2 * OPERATION + 3 * DIGIT
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
    before: Line | None = None
    for line in lines:
        if isinstance(line, Step):
            seconds += STEP + _seconds(line.put_in)
            unknowns += line.value is None
        elif isinstance(line, Result | Elimination) and unknowns:
            # Elimination: about n³/3 operations, each written down, on numbers that grow to three or four digits.
            size = LETTER if any(map(parameters, line.values)) else 3
            seconds += (2 * OPERATION + size * DIGIT) * Fraction(unknowns**3 + 3 * unknowns**2, 3)
            unknowns = 0
        elif isinstance(line, Equality):
            seconds += REARRANGED if isinstance(before, Equality) else STEP
        before = line
    return seconds


def whole(time: Fraction) -> int:
    """Minutes as they are told: whole, and at least 1."""
    return max(1, round(time))


def _seconds(expression: Expr, letter: int | None = None) -> Fraction:
    if letter is None:
        letter = LETTER if without_slots(expression).has(sympy.Add) else LONE_LETTER
    operations = digits = 0
    plain = Fraction(0)
    nodes = sympy.preorder_traversal(expression)
    for node in nodes:
        if node.is_Pow and isinstance(node.args[1], Slot):  # nobody works out the power 0 or 1
            nodes.skip()
            plain += _seconds(node.args[0], letter) if node.args[1].args[0] == 1 else 0
        elif node.is_Mul and any(isinstance(factor, Slot) and factor.args[0] == 0 for factor in node.args):
            nodes.skip()  # nor a product with 0
            operations += 1
        elif node.is_Mul and (others := [factor for factor in node.args if not _is_one(factor)]) != list(node.args):
            nodes.skip()  # nor one with 1
            operations += max(0, len(others) - 1)
            plain += sum((_seconds(factor, letter) for factor in others), Fraction(0))
        elif isinstance(node, Over):  # what it runs over is no work
            nodes.skip()
            plain += _seconds(node.body, letter)
        elif isinstance(node, Node):
            operations += node.operations
            digits += sum(map(_digits, node.numbers))
        elif node.is_Rational:
            digits += _digits(node)
        elif node.is_Symbol:
            digits += letter
        elif node.is_Add or node.is_Mul or node.is_Function or node.is_Pow:
            operations += _operations(node)
    return plain + OPERATION * operations + DIGIT * digits


def _is_one(factor: Expr) -> bool:
    """Whether it is a 1, or a power of 1, that only keeps its place."""
    base = factor.args[0] if factor.is_Pow else factor
    return isinstance(base, Slot) and base.args[0] == 1


def _digits(number: Expr) -> int:
    if not number.is_Rational:
        return 2
    return len(str(abs(number.p))) + (len(str(number.q)) if number.q != 1 else 0)


def _operations(node: Expr) -> int:
    """The operations of arithmetic of one sum, product, power or function, once its arguments are worked out."""
    grids = [grid for argument in node.args if (grid := _filled(argument))]
    if not grids:
        return len(node.args) - 1 if node.is_Add or node.is_Mul else 1
    if node.is_Pow:  # determinant and adjugate, or elimination
        return len(grids[0]) ** 3
    if node.is_Add:
        return (len(node.args) - 1) * max(map(_entries, grids))
    factors = sum(argument != -1 for argument in node.args) - len(grids)
    operations = factors * min(map(_entries, grids))
    product = grids[0]
    for grid in grids[1:]:
        operations += 2 * sum(map(sum, _terms(product, grid)))  # multiplied, and added or written down
        product = _product(product, grid)
    return operations


#: Which entries of a matrix are not zero.
Grid: TypeAlias = tuple[tuple[bool, ...], ...]


def _filled(expression: Expr) -> Grid | None:
    """Which entries of a matrix are not zero, as far as its terms and factors tell; None for a number."""
    if isinstance(expression, MatrixLeaf):
        return None if expression.scalar else _grid(expression.args[0].tolist())
    if isinstance(expression, Node) and not isinstance(expression, Transposed):
        return None
    grids = [grid for argument in expression.args if (grid := _filled(argument))]
    if not grids:
        return None
    if isinstance(expression, Transposed):
        return tuple(zip(*grids[0], strict=True))
    if expression.is_Mul:
        return reduce(_product, grids)
    return _grid([any(entries) for entries in zip(*lines, strict=True)] for lines in zip(*grids, strict=True))


def _grid(lines: Iterable[Iterable[object]]) -> Grid:
    return tuple(tuple(map(bool, line)) for line in lines)


def _entries(grid: Grid) -> int:
    return sum(map(sum, grid))


def _terms(left: Grid, right: Grid) -> list[list[int]]:
    """How many products are added up in every entry of a product of two matrices."""
    columns = list(zip(*right, strict=True))
    return [[sum(a and b for a, b in zip(line, column, strict=True)) for column in columns] for line in left]


def _product(left: Grid, right: Grid) -> Grid:
    return _grid(_terms(left, right))
