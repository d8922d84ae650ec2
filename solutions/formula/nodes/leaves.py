"""What is put into a formula: names, negative numbers, matrices and vectors."""

from collections.abc import Iterable
from typing import Any

import sympy
from sympy import Expr

from rldrill.problems.mathematics import Fence, Math, name, number
from rldrill.solutions.exact import ordered, to_sympy
from rldrill.solutions.formula.node import Look, Node, Typeset
from rldrill.solutions.formula.typesetting import tabular, typeset_value, vector
from rldrill.solutions.matrices import is_matrix
from rldrill.solutions.vector import Vector


class Leaf(Node):
    """Something that is put in; it is worth what it holds."""

    is_commutative = True  # sympy would deduce it anew for every one

    def _put_in(self, _: object) -> Expr:
        return self

    def _evaluated(self, _: object) -> Any:
        return self.args[0] if self.args else self


class PutInName(Leaf, sympy.Symbol):
    """The name of a state, action or hypothesis standing where an index stood."""

    look = Look.LETTER

    def _typeset(self, _: object) -> Math:
        return name(self.name)


class Slot(Leaf):
    """A 0 or 1 that was put in: it keeps its place in the rule until the next line."""

    look = Look.SLOT

    def _typeset(self, _: object) -> Math:
        return number(self.args[0])


class Negative(Leaf):
    """A negative number that was put in: it keeps its brackets."""

    look = Look.NUMBER

    def _typeset(self, _: object) -> Math:
        return Fence(typeset_value(self.args[0]))

    def _alone(self, typeset: Typeset) -> Math:
        return typeset(self.args[0])


class Factor(Leaf):
    """A number that is a product, such as √3/2, and stays together among other factors."""

    look = Look.NUMBER

    def _typeset(self, _: object) -> Math:
        return typeset_value(self.args[0])


class MatrixLeaf(Leaf):
    """A matrix of numbers, put into a formula."""

    is_commutative = False

    def __new__(cls, matrix: Any) -> "MatrixLeaf":
        """Keep the matrix as it is."""
        return Expr.__new__(cls, sympy.ImmutableMatrix(matrix))

    @property
    def scalar(self) -> bool:
        """Whether it is 1×1, and so written as a number."""
        return bool(self.args[0].shape == (1, 1))

    @property
    def look(self) -> Look:
        """A 1×1 matrix looks like a number."""
        return Look.NUMBER if self.scalar else Look.GRID

    @property
    def holds_sum(self) -> bool:
        """Whether it is 1×1, and its entry a sum."""
        return self.scalar and bool(self.args[0][0].is_Add)

    @property
    def numbers(self) -> Iterable[Expr]:
        """Its entries, though they are in its arguments: what is written down is first looked up."""
        return self.args[0]

    def _typeset(self, typeset: Typeset) -> Math:
        entry, written = self.args[0][0], self._alone(typeset)
        return Fence(written) if self.holds_sum or (self.scalar and entry.is_negative) else written

    def _alone(self, _: object) -> Math:
        return typeset_value(self.args[0][0]) if self.scalar else tabular(self.args[0].tolist())


class VectorLeaf(MatrixLeaf):
    """A vector of numbers, put into a formula: written on one line, (1, 0)."""

    look = Look.LINE

    def _typeset(self, _: object) -> Math:
        return vector(self.args[0])

    _alone = _typeset


def put_in_name(text: object) -> Expr:
    """A put-in index as a leaf: a whole number, or a name."""
    return sympy.Integer(text) if isinstance(text, int) else PutInName(str(text))


def leaf(value: Any) -> Expr:
    """An exact value, a matrix or a name as a leaf of an expression."""
    if isinstance(value, str):
        return put_in_name(value)
    if is_matrix(value):
        return MatrixLeaf([[to_sympy(entry) for entry in line] for line in value.tolist()])
    if isinstance(value, Vector):
        return VectorLeaf(value.matrix())
    number_ = to_sympy(value)
    if number_.is_Mul and number_.is_algebraic and not number_.could_extract_minus_sign():
        return Factor(number_)
    return Slot(number_) if number_ in (0, 1) else computed(ordered(number_))


def computed(value: Any) -> Expr:
    """A number or matrix that sympy computed, as a leaf."""
    if isinstance(value, sympy.MatrixBase):
        return MatrixLeaf(value)
    first = value.args[0] if value.is_Mul else value  # −ln 4 needs brackets as −4 does
    return Negative(value) if first.is_Number and first.is_negative else value
