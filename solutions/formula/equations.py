"""Systems of linear equations, read off a formula itself: its right side is evaluated on unknowns."""

from collections.abc import Hashable, Mapping, Sequence
from typing import Any

from flint import fmpq_mat

from rldrill.solutions.exact import ONE, ZERO, NoSolution, Value, is_rational, simplest

_NO_UNIQUE = "the equations have no unique solution"


class Affine:
    """A constant plus multiples of unknowns; what a formula's right side becomes when V is not yet known."""

    __slots__ = ("constant", "factors")

    def __init__(self, factors: Mapping[Hashable, Value], constant: Value = ZERO) -> None:
        self.factors = factors
        self.constant = constant

    def __add__(self, other: Any) -> "Affine":
        if not isinstance(other, Affine):
            return Affine(self.factors, self.constant + other)
        factors = dict(self.factors)
        for unknown, factor in other.factors.items():
            factors[unknown] = factors[unknown] + factor if unknown in factors else factor
        return Affine(factors, self.constant + other.constant)

    __radd__ = __add__

    def __neg__(self) -> "Affine":
        return self * -1

    def __mul__(self, factor: Any) -> "Affine":
        if isinstance(factor, Affine):
            raise TypeError("the equations are not linear")
        return Affine({key: value * factor for key, value in self.factors.items()}, self.constant * factor)

    __rmul__ = __mul__


def solve_linear(equations: Mapping[Hashable, Any]) -> dict[Any, Value]:
    """Solve x = f(x) for affine right sides, exactly.

    Args:
        equations: for every unknown its right side, an ``Affine`` or a plain value.

    Raises:
        NoSolution: the system has no unique solution.
    """
    unknowns: Sequence[Hashable] = tuple(equations)
    place = {unknown: index for index, unknown in enumerate(unknowns)}
    sides = [side if isinstance(side, Affine) else Affine({}, side) for side in equations.values()]
    size = len(unknowns)
    lines: dict[int, dict[int, Value]] = {index: {index: ONE} for index in range(size)}
    for index, side in enumerate(sides):
        for unknown, factor in side.factors.items():
            column = place[unknown]
            lines[index][column] = lines[index].get(column, ZERO) - factor
    constants = {index: side.constant for index, side in enumerate(sides)}
    values = [*(value for line in lines.values() for value in line.values()), *constants.values()]
    if all(is_rational(value) for value in values):
        solution = _solve_rational(lines, constants)
    else:
        solution = _eliminate(lines, constants)
    return dict(zip(unknowns, solution, strict=True))


def _solve_rational(lines: Mapping[int, Mapping[int, Value]], constants: Mapping[int, Value]) -> Sequence[Value]:
    size = len(lines)
    left = fmpq_mat(size, size)
    for row, line in lines.items():
        for column, value in line.items():
            left[row, column] = value
    try:  # flint lifts the solution from a prime: three hundred equations take a tenth of a second
        solution = left.solve(fmpq_mat(size, 1, [constants[row] for row in range(size)]))
    except ZeroDivisionError:
        raise NoSolution(_NO_UNIQUE) from None
    return solution.entries()


def _eliminate(lines: Mapping[int, Mapping[int, Value]], constants: Mapping[int, Value]) -> Sequence[Value]:
    """Gauss and Jordan, for systems with an open parameter: they are small, but their numbers are functions."""
    size = len(lines)
    table = [[lines[row].get(column, ZERO) for column in range(size)] + [constants[row]] for row in range(size)]
    for pivot in range(size):
        found = next((row for row in range(pivot, size) if table[row][pivot] != 0), None)
        if found is None:
            raise NoSolution(_NO_UNIQUE)
        table[pivot], table[found] = table[found], table[pivot]
        table[pivot] = [value / table[pivot][pivot] for value in table[pivot]]
        for row in range(size):
            if row != pivot and (factor := table[row][pivot]) != 0:
                table[row] = [a - factor * b for a, b in zip(table[row], table[pivot], strict=True)]
    return [simplest(line[-1]) for line in table]
