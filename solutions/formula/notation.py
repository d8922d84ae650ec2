"""The vocabulary of the formulas: letters, quantities such as V(s), and all kinds of nodes, by one name."""

from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import cache
from typing import Any, ClassVar

import sympy
from sympy import Expr

from rldrill.problems.mathematics import (
    Fence,
    Glyph,
    Math,
    Row,
    Script,
    listed,
    number,
    operator,
    punctuation,
    row,
    variable,
)
from rldrill.solutions.formula.letters import letter as letter
from rldrill.solutions.formula.node import Look, Node, Python, Typeset
from rldrill.solutions.formula.nodes.choices import Clipped as Clipped
from rldrill.solutions.formula.nodes.choices import Greatest as Greatest
from rldrill.solutions.formula.nodes.choices import Least as Least
from rldrill.solutions.formula.nodes.conditions import Cases as Cases
from rldrill.solutions.formula.nodes.conditions import Indicator as Indicator
from rldrill.solutions.formula.nodes.conditions import Member as Member
from rldrill.solutions.formula.nodes.conditions import Visited as Visited
from rldrill.solutions.formula.nodes.leaves import Negative as Negative
from rldrill.solutions.formula.nodes.leaves import leaf
from rldrill.solutions.formula.nodes.matrices import Blocks as Blocks
from rldrill.solutions.formula.nodes.matrices import Transposed as Transposed
from rldrill.solutions.formula.nodes.sets import ArgMaxOver as ArgMaxOver
from rldrill.solutions.formula.nodes.sets import Counting as Counting
from rldrill.solutions.formula.nodes.sets import Expected as Expected
from rldrill.solutions.formula.nodes.sets import IntegralOver as IntegralOver
from rldrill.solutions.formula.nodes.sets import MaxOver as MaxOver
from rldrill.solutions.formula.nodes.sets import MeanOver as MeanOver
from rldrill.solutions.formula.nodes.sets import ProductOver as ProductOver
from rldrill.solutions.formula.nodes.sets import SampleMean as SampleMean
from rldrill.solutions.formula.nodes.sets import Size as Size
from rldrill.solutions.formula.nodes.sets import SumOver as SumOver
from rldrill.solutions.formula.putting_in import PutIn, indexed
from rldrill.solutions.value import NotGiven


class Quantity(Node, sympy.Function):
    """Something that has a value for each of its arguments, and knows how it is written."""

    layout: ClassVar[Callable[..., Math]]
    look = Look.LETTER
    operations = 1  # to look it up

    def _typeset(self, typeset: Typeset) -> Math:
        return self.layout(*map(typeset, self.args))

    def _compiled(self, python: Python) -> str:
        return f"{self.code}[{', '.join(map(python, self.args))}]"

    def _put_in(self, put_in: PutIn) -> Expr:
        if self.code in put_in.known:
            with suppress(NotGiven):  # an unknown of a system, among values that are fixed
                value = put_in.value(self)
                return leaf(value) if self._is_there(put_in) else sympy.S.Zero
        return indexed(self, put_in.known)

    def _is_there(self, put_in: PutIn) -> bool:
        """Whether the table has an entry for these arguments; where it has none there is nothing to write."""
        table = put_in.known[self.code]
        place = tuple(map(put_in.value, self.args))
        return not isinstance(table, Mapping) or (place if len(place) > 1 else place[0]) in table


def quantity(code: str, layout: Callable[..., Math], *, matrix: bool = False) -> type[Quantity]:
    """A new quantity; ``layout`` takes its typeset arguments."""
    return type(code, (Quantity,), {"code": code, "layout": staticmethod(layout), "is_commutative": not matrix})


def called(head: str | Math) -> Callable[..., Math]:
    """Written V(s)."""
    glyph = variable(head) if isinstance(head, str) else head
    return lambda *arguments: row(glyph, Fence(listed(arguments)))


def conditioned(head: str | Math) -> Callable[..., Math]:
    """Written π(a|s): the first argument given the others."""
    glyph = variable(head) if isinstance(head, str) else head

    def layout(first: Math, *rest: Math) -> Math:
        return row(glyph, Fence(row(first, punctuation("|"), listed(rest)) if rest else first))

    return layout


def subscripted(head: str | Math, above: Callable[[Math], Math] | None = None) -> Callable[..., Math]:
    """Written rₜ; of two arguments the second is written above, through ``above``."""
    glyph = variable(head) if isinstance(head, str) else head

    def layout(below: Math, upper: Math | None = None) -> Math:
        raised = above(upper) if above and upper is not None else upper
        return Script(glyph, below, raised)

    return layout


def between_states(head: str) -> Callable[..., Math]:
    """Written as the sheet writes the model, with s, s′ below and a above."""
    return lambda state, action, after: Script(variable(head), beside(state, after), action)


def beside(first: Math, second: Math) -> Math:
    """Two indices: letters touch, names and numbers are parted by a comma."""
    short = all(isinstance(item, Glyph) and item.style == "variable" for item in (first, second))
    return row(first, second) if short else row(first, punctuation(","), second)


def _numbered(of: type[Quantity], count: int) -> type[Quantity]:
    """The quantity after ``count`` sweeps: V₂(s)."""

    def layout(*arguments: Math) -> Math:
        written = of.layout(*arguments)
        items = written.items if isinstance(written, Row) else (written,)
        return row(Script(items[0], number(count)), *items[1:])

    return quantity(of.code, layout)


#: Built once, so that equal quantities are the same class.
numbered: Any = cache(_numbered)


DOTS = letter("dots", "…")
INFINITY = letter("infinity", "∞")


# Letters ------------------------------------------------------------------------------------------
alpha = letter("alpha", "α")
gamma = letter("gamma", "γ")
lam = letter("lam", "λ")
epsilon = letter("epsilon", "ε")
s = letter("s")
a = letter("a")
s1 = letter("s1", "s′")
a1 = letter("a1", "a′")
b = letter("b")
t = letter("t")
n = letter("n")
i = letter("i")
T = letter("T")
h = letter("h")
h1 = letter("h1", "h′")
z = letter("z")

# Sets ---------------------------------------------------------------------------------------------
Actions = quantity("actions", called(variable("A")))
Successors = quantity("successors", called(variable("S")))
States = letter("states", "S")
Choices = letter("choices", "A")
Features = letter("features", "F")
Hypotheses = letter("hypotheses", "H")

# Quantities ---------------------------------------------------------------------------------------
V = quantity("V", called("V"))
Vpi = quantity("V", called(Script(variable("V"), above=variable("π"))))
Vstar = quantity("V", called(Script(variable("V"), above=operator("*"))))
Q = quantity("Q", called("Q"))
Qpi = quantity("Q", called(Script(variable("Q"), above=variable("π"))))
Qstar = quantity("Q", called(Script(variable("Q"), above=operator("*"))))
P = quantity("P", between_states("P"))
R = quantity("R", between_states("R"))
pi = quantity("pi", conditioned("π"))
S = quantity("S", subscripted("s"))
A = quantity("A", subscripted("a"))
r = quantity("r", subscripted("r"))
gammas = quantity("gammas", subscripted("γ"))
G = quantity("G", subscripted("R"))
Gn = quantity("Gn", subscripted("R", lambda upper: Fence(upper)))
