"""Vectors of exact values: gradients, weights, features."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import sympy

from rldrill.solutions.exact import Value, to_sympy


@dataclass(frozen=True, slots=True, init=False)
class Vector:
    """A vector of exact values of any kind; it can be added, and multiplied with or divided by a number.

    flint's matrices hold rationals only; weights and features may also hold what is left open, or e.
    """

    entries: tuple[Value, ...]

    def __init__(self, entries: Iterable[Value]) -> None:
        object.__setattr__(self, "entries", tuple(entries))

    def __iter__(self) -> Iterator[Value]:
        return iter(self.entries)

    def __add__(self, other: object) -> "Vector":
        if not isinstance(other, Vector):
            # A sum over a set begins with 0; no other number can be added to a vector.
            return self if other == 0 else NotImplemented
        return Vector(mine + theirs for mine, theirs in zip(self, other, strict=True))

    __radd__ = __add__

    def __neg__(self) -> "Vector":
        return self * -1

    def __sub__(self, other: "Vector") -> "Vector":
        return self + -other

    def __mul__(self, factor: "Vector | Value | int") -> "Vector":
        return NotImplemented if isinstance(factor, Vector) else Vector(entry * factor for entry in self)

    __rmul__ = __mul__

    def matrix(self) -> sympy.MatrixBase:
        """The vector as a column of sympy's; not done by itself, or sympy's numbers would swallow vectors."""
        return sympy.ImmutableMatrix([to_sympy(entry) for entry in self])
