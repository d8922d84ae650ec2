"""The vocabulary of the formulas: letters, quantities such as V(s), sums and maxima over finite sets."""

from collections.abc import Callable
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

GLYPHS: dict[sympy.Symbol, Math] = {}


def letter(code: str, glyph: str | Math | None = None, *, matrix: bool = False) -> sympy.Symbol:
    """A letter of a formula: ``code`` names it when values are put in, ``glyph`` is how it is written.

    Raises:
        ValueError: the code is that of another letter, which is written otherwise.
    """
    symbol = sympy.Symbol(code, commutative=not matrix)
    written = variable(glyph or code) if glyph is None or isinstance(glyph, str) else glyph
    if GLYPHS.setdefault(symbol, written) != written:
        raise ValueError(f"{code!r} is written in two ways: {GLYPHS[symbol]} and {written}")
    return symbol


class PutInName(sympy.Symbol):
    """The name of a state, action or hypothesis standing where an index stood."""


def put_in_name(text: object) -> Expr:
    """A put-in index as a leaf: a whole number, or a name."""
    return sympy.Integer(text) if isinstance(text, int) else PutInName(str(text))


class Quantity(sympy.Function):
    """Something that has a value for each of its arguments, and knows how it is written."""

    code: ClassVar[str]
    layout: ClassVar[Callable[..., Math]]


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


class Over(Expr):
    """Something that runs over a finite set: its body, its index and the set.

    The set is a quantity whose value is a collection, or a ``Counting``.
    """

    def __new__(cls, body: Expr, index: sympy.Symbol, domain: Expr) -> "Over":
        """Build it without evaluating anything."""
        return Expr.__new__(cls, sympy.sympify(body, strict=True), index, domain)

    @property
    def body(self) -> Expr:
        """What is added or compared."""
        return self.args[0]

    @property
    def index(self) -> sympy.Symbol:
        """The letter that runs."""
        return self.args[1]

    @property
    def domain(self) -> Expr:
        """What it runs over."""
        return self.args[2]

    @property
    def bound_symbols(self) -> list[sympy.Symbol]:
        """The letter that runs is not free."""
        return [self.index]

    @property
    def free_symbols(self) -> set[sympy.Symbol]:
        """The letters that a value must be given for."""
        return (self.body.free_symbols - {self.index}) | self.domain.free_symbols


class SumOver(Over):
    """Σ over a finite set."""


class ProductOver(Over):
    """Π over a finite set."""


class MaxOver(Over):
    """The greatest value over a finite set."""


class MeanOver(Over):
    """The unweighted mean over a finite set; no formula of the sheet has it, but mistakes do."""


class SampleMean(MeanOver):
    """𝔼 over cases that are equally probable; which case it runs over is not written."""


class IntegralOver(Over):
    """∫ over all values of a letter: only written, beside a closed form that is computed with."""


class ArgMaxOver(Over):
    """The elements of a finite set at which the body is greatest."""


class Counting(Expr):
    """The whole numbers from the first to the last; ``shown`` is the upper limit as the sheet prints it."""

    def __new__(cls, first: Expr, last: Expr, shown: Expr | None = None) -> "Counting":
        """Build it without evaluating anything."""
        last = sympy.sympify(last, strict=True)
        return Expr.__new__(cls, sympy.sympify(first, strict=True), last, last if shown is None else shown)

    @property
    def free_symbols(self) -> set[sympy.Symbol]:
        """The upper limit as printed is not computed with."""
        return self.args[0].free_symbols | self.args[1].free_symbols


class Size(Expr):
    """How many elements a finite set has."""


class Indicator(Expr):
    """1 where two things are the same, else 0; of four things, where the first two are and the last two are."""


class Member(Expr):
    """Whether something belongs to a finite set; stands in ``Cases``."""


class Cases(Expr):
    """One of two values: if the condition (an ``Indicator``, a ``Member``) holds, and otherwise."""

    def __new__(cls, condition: Expr, then: Expr, otherwise: Expr) -> "Cases":
        """Build it without evaluating anything."""
        return Expr.__new__(cls, condition, sympy.sympify(then, strict=True), sympy.sympify(otherwise, strict=True))


class Transposed(Expr):
    """The transpose of a matrix."""

    is_commutative = False


class Blocks(Expr):
    """A matrix of entries or blocks: how many rows of them there are, then all, row by row.

    Among matrices, 0 and 1 stand for as much of the zero or identity matrix as fits.
    """

    is_commutative = False

    def __new__(cls, rows: int, *blocks: Any) -> "Blocks":
        """Build it without evaluating anything."""
        return Expr.__new__(cls, *(sympy.sympify(part, strict=True) for part in (rows, *blocks)))


class MaxOf(Expr):
    """The greatest of some values, in their order."""


class Greatest(Expr):
    """The greatest of a few values that a formula names one by one, written max(x, y)."""


class Least(Expr):
    """The least of a few values that a formula names one by one, written min(x, y)."""


class Clipped(Expr):
    """A value brought between a lower and an upper bound, written clip(x, low, high)."""


class Expected(Expr):
    """An expectation over runs of an agent; what it is worth is computed with one run in its place."""


class MatrixLeaf(Expr):
    """A matrix of numbers, put into a formula."""

    is_commutative = False

    def __new__(cls, matrix: Any) -> "MatrixLeaf":
        """Keep the matrix as it is."""
        return Expr.__new__(cls, sympy.ImmutableMatrix(matrix))

    @property
    def scalar(self) -> bool:
        """Whether it is 1×1, and so written as a number."""
        return bool(self.args[0].shape == (1, 1))


class VectorLeaf(MatrixLeaf):
    """A vector of numbers, put into a formula: written on one line, (1, 0)."""


class Negative(Expr):
    """A negative number that was put in: it keeps its brackets."""


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
G = quantity("G", subscripted("R"))
Gn = quantity("Gn", subscripted("R", lambda upper: Fence(upper)))
