"""Matrices in formulas: transposed, and made of blocks."""

from collections.abc import Callable
from typing import Any, TypeVar

import sympy
from sympy import Expr

from rldrill.problems.mathematics import Fence, Math, Script, Tabular, word
from rldrill.solutions.formula.node import Look, Node, Typeset
from rldrill.solutions.formula.nodes.leaves import MatrixLeaf, computed
from rldrill.solutions.formula.putting_in import PutIn, evaluated
from rldrill.solutions.formula.typesetting import alone, closed, look
from rldrill.solutions.matrices import stacked

T = TypeVar("T")


class Transposed(Node):
    """The transpose of a matrix."""

    is_commutative = False
    value = staticmethod(lambda matrix: matrix.transpose())
    symbolic = staticmethod(lambda matrix: matrix.T)

    @property
    def look(self) -> Look:
        """A grid with a mark is a grid."""
        return Look.GRID if look(self.args[0]) is Look.GRID else Look.OTHER

    def _typeset(self, typeset: Typeset) -> Math:
        body = self.args[0]
        written = typeset(body) if closed(body) else Fence(typeset(body))
        if isinstance(written, Script) and written.above is None:
            return Script(written.body, written.below, word("T"))
        return Script(written, above=word("T"))

    def _put_in(self, put_in: PutIn) -> Expr:
        body = put_in(self.args[0])
        return body if getattr(body, "scalar", False) else Transposed(body)


class Blocks(Node):
    """A matrix of entries or blocks: how many rows of them there are, then all, row by row.

    Among matrices, 0 and 1 stand for as much of the zero or identity matrix as fits.
    """

    is_commutative = False
    look = Look.GRID
    value = staticmethod(stacked)

    def __new__(cls, rows: int, *blocks: Any) -> "Blocks":
        """Build it without evaluating anything."""
        return Expr.__new__(cls, *(sympy.sympify(part, strict=True) for part in (rows, *blocks)))

    def _lines(self, read: Callable[[Expr], T]) -> list[tuple[T, ...]]:
        rows, *blocks = self.args
        width = len(blocks) // int(rows)
        return [tuple(map(read, blocks[start : start + width])) for start in range(0, len(blocks), width)]

    def _typeset(self, _: object) -> Math:
        return Tabular(tuple(self._lines(alone)))

    def _put_in(self, put_in: PutIn) -> Expr:
        written = Blocks(*map(put_in, self.args))
        numbers = any(isinstance(block, MatrixLeaf) for block in written.args)
        return computed(evaluated(written)) if numbers else written  # blocks of numbers are one matrix at once

    def _plain(self, plain: Callable[[Expr], Expr]) -> Expr:
        rows, *blocks = self.args
        return Blocks(int(rows), *map(plain, blocks))

    def _evaluated(self, evaluated: Callable[[Expr], Any]) -> Any:
        lines = self._lines(evaluated)
        heights = [max(getattr(block, "rows", 1) for block in line) for line in lines]
        widths = [max(getattr(block, "cols", 1) for block in column) for column in zip(*lines, strict=True)]
        filled = [
            [_filled(block, height, across) for block, across in zip(line, widths, strict=True)]
            for line, height in zip(lines, heights, strict=True)
        ]
        return sympy.Matrix(filled)


def _filled(block: Any, height: int, across: int) -> Any:
    if isinstance(block, sympy.MatrixBase):
        return block
    return sympy.Matrix(height, across, lambda i, j: block if i == j else 0)
