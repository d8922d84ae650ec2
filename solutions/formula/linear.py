"""Systems of linear equations, read off a formula itself: its right side is evaluated on unknowns."""

from collections.abc import Hashable, Mapping, Sequence
from typing import Any

from sympy import QQ
from sympy.polys.fields import FracElement
from sympy.polys.matrices import DomainMatrix
from sympy.polys.matrices.exceptions import DMNonInvertibleMatrixError

from rldrill.solutions.exact import ZERO, NoSolution, Value, simplest


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
    lines: dict[int, dict[int, Value]] = {index: {index: QQ.one} for index in range(size)}
    for index, side in enumerate(sides):
        for unknown, factor in side.factors.items():
            column = place[unknown]
            lines[index][column] = lines[index].get(column, QQ.zero) - factor
    constants = {index: {0: side.constant} for index, side in enumerate(sides) if side.constant}
    domain = _domain([*(value for line in lines.values() for value in line.values()),
                      *(side.constant for side in sides)])  # fmt: skip
    left = _matrix(lines, (size, size), domain)
    right = _matrix(constants, (size, 1), domain)
    try:
        solution = left.to_dense().lu_solve(right.to_dense()).to_list_flat()
    except DMNonInvertibleMatrixError:
        raise NoSolution("the equations have no unique solution") from None
    return {unknown: simplest(value) for unknown, value in zip(unknowns, solution, strict=True)}


def _domain(values: Sequence[Value]) -> Any:
    return next((value.field.to_domain() for value in values if isinstance(value, FracElement)), QQ)


def _matrix(lines: Mapping[int, Mapping[int, Value]], shape: tuple[int, int], domain: Any) -> DomainMatrix:
    cast = {
        row: {column: domain.convert(value) for column, value in line.items() if value}
        for row, line in lines.items()
    }
    return DomainMatrix({row: line for row, line in cast.items() if line}, shape, domain)
