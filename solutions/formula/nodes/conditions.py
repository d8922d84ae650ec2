"""What depends on whether something holds."""

from typing import ClassVar

import sympy
from sympy import Expr

from rldrill.problems.mathematics import Fence, Glyph, Math, Tabular, listed, relation, row, word
from rldrill.solutions.formula.node import Node, Python, Typeset
from rldrill.solutions.formula.nodes.leaves import Slot
from rldrill.solutions.formula.putting_in import PutIn


class Condition(Node):
    """Something that holds or not, between its arguments two by two."""

    sign: ClassVar[str]

    def _typeset(self, typeset: Typeset) -> Math:
        sides = list(map(typeset, self.args))
        pairs = zip(sides[::2], sides[1::2], strict=True)
        return listed(row(left, relation(self.sign), right) for left, right in pairs)


class Indicator(Condition):
    """1 where two things are the same, else 0; of four things, where the first two are and the last two are."""

    sign = "="
    value = staticmethod(lambda *things: int(things[::2] == things[1::2]))

    def _typeset(self, typeset: Typeset) -> Math:
        return row(Glyph("1", "number"), Fence(super()._typeset(typeset)))

    def _put_in(self, put_in: PutIn) -> Expr:
        return sympy.Integer(put_in.value(self))


class Visited(Indicator):
    """An indicator that is a term of its own: its 0 or 1 keeps the place in the rule until the next line."""

    def _put_in(self, put_in: PutIn) -> Expr:
        return Slot(super()._put_in(put_in))


class Member(Condition):
    """Whether something belongs to a finite set; stands in ``Cases``."""

    sign = "∈"
    value = staticmethod(lambda element, domain: element in domain)


class Cases(Node):
    """One of two values: if the condition (an ``Indicator``, a ``Member``) holds, and otherwise."""

    def __new__(cls, condition: Condition, then: Expr, otherwise: Expr) -> "Cases":
        """Build it without evaluating anything."""
        return Expr.__new__(cls, condition, sympy.sympify(then, strict=True), sympy.sympify(otherwise, strict=True))

    def _typeset(self, typeset: Typeset) -> Math:
        condition, then, otherwise = self.args
        holds = row(word("if"), Condition._typeset(condition, typeset))
        return Tabular(((typeset(then), holds), (typeset(otherwise), word("otherwise"))), "{", "")

    def _compiled(self, python: Python) -> str:
        condition, then, otherwise = map(python, self.args)
        return f"(({then}) if {condition} else ({otherwise}))"  # only what holds has to have a value

    def _put_in(self, put_in: PutIn) -> Expr:
        condition, then, otherwise = self.args
        return put_in(then if put_in.value(condition) else otherwise)
