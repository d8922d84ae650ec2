"""What takes one of a few values as it is: max, min, clip."""

from collections.abc import Callable
from typing import ClassVar

import sympy
from sympy import Expr

from rldrill.problems.mathematics import Fence, Math, listed, row, word
from rldrill.solutions.exact import largest
from rldrill.solutions.formula.node import Node
from rldrill.solutions.formula.typesetting import alone


class Choice(Node):
    """Something that takes one of a few values as it is."""

    name: ClassVar[str]

    @property
    def operations(self) -> int:
        """The greatest of n values takes n − 1 comparisons."""
        return len(self.args) - 1

    def _typeset(self, _: object) -> Math:
        return row(word(self.name), Fence(listed(map(alone, self.args))))

    def _reduced(self, worked_out: Callable[[Expr], Expr]) -> Expr:
        return self.func(*map(worked_out, self.args))


class Greatest(Choice):
    """The greatest of a few values that a formula names one by one, written max(x, y)."""

    name = "max"
    value = staticmethod(lambda *values: largest(values))
    symbolic = sympy.Max


class Least(Choice):
    """The least of a few values that a formula names one by one, written min(x, y)."""

    name = "min"
    value = staticmethod(lambda *values: -largest([-value for value in values]))
    symbolic = sympy.Min


class Clipped(Choice):
    """A value brought between a lower and an upper bound, written clip(x, low, high)."""

    name = "clip"
    value = staticmethod(lambda value, low, high: Greatest.value(low, Least.value(value, high)))
    symbolic = staticmethod(lambda value, low, high: sympy.Max(low, sympy.Min(value, high)))
