"""What runs over a finite set: sums, products, means and maxima; the sets, and how large they are."""

from collections.abc import Callable, Sequence
from math import prod
from typing import ClassVar

import sympy
from sympy import Expr

from rldrill.problems.mathematics import Big, Fence, Math, Script, listed, operator, relation, row, variable, word
from rldrill.solutions.exact import ONE, ZERO, Value, largest
from rldrill.solutions.formula.compiling import Compiler, arg_max
from rldrill.solutions.formula.node import Look, Node
from rldrill.solutions.formula.nodes.choices import Greatest
from rldrill.solutions.formula.putting_in import PutIn, power_of, product_of, reduced, sum_of
from rldrill.solutions.formula.typesetting import alone


class Counting(Node):
    """The whole numbers from the first to the last; ``shown`` is the upper limit as the sheet prints it."""

    def __new__(cls, first: Expr, last: Expr, shown: Expr | None = None) -> "Counting":
        """Build it without evaluating anything."""
        last = sympy.sympify(last, strict=True)
        return Expr.__new__(cls, sympy.sympify(first, strict=True), last, last if shown is None else shown)

    @property
    def free_symbols(self) -> set[sympy.Symbol]:
        """The upper limit as printed is not computed with."""
        return self.args[0].free_symbols | self.args[1].free_symbols

    @staticmethod
    def value(first: Value, last: Value) -> range:
        """The last is among them."""
        return range(first, last + 1)

    def _compiled(self, compiler: Compiler) -> str:
        return compiler.call(self, *map(compiler, self.args[:2]))


class Size(Node):
    """How many elements a finite set has."""

    value = staticmethod(len)

    def _typeset(self, typeset: Callable[[Expr], Math]) -> Math:
        return Fence(typeset(self.args[0]), "|", "|")

    def _put_in(self, put_in: PutIn) -> Expr:
        return sympy.Integer(put_in.value(self))


class Over(Node):
    """Something that runs over a finite set: its body, its index and the set.

    The set is a quantity whose value is a collection, or a ``Counting``.
    """

    look = Look.OPEN
    sign: ClassVar[str]

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

    def _typeset(self, typeset: Callable[[Expr], Math]) -> Math:
        below: Math = typeset(self.index)
        above: Math | None = None
        if isinstance(self.domain, Counting):
            first, _, shown = self.domain.args
            below, above = row(below, relation("="), typeset(first)), typeset(shown)
        return row(Big(self.sign, below, above), self._written_body(typeset))

    def _written_body(self, typeset: Callable[[Expr], Math]) -> Math:
        return Fence(typeset(self.body)) if self.body.is_Add else typeset(self.body)

    def _compiled(self, compiler: Compiler) -> str:
        return compiler.call(self, self._values(compiler))

    def _values(self, compiler: Compiler) -> str:
        return f"[{compiler(self.body)} for {compiler(self.index)} in {compiler(self.domain)}]"

    def _put_in(self, put_in: PutIn) -> Expr:
        name = self.index.name
        return self._written_out([put_in.knowing(name, item)(self.body) for item in put_in.value(self.domain)])

    def _written_out(self, terms: list[Expr]) -> Expr:  # noqa: ARG002
        raise TypeError(f"{type(self).__name__} cannot be written out")


class SumOver(Over):
    """Σ over a finite set."""

    sign = "Σ"

    @staticmethod
    def value(values: Sequence[Value]) -> Value:
        """Nothing makes 0."""
        return sum(values[1:], values[0]) if values else ZERO  # matrices cannot be added to 0

    def _written_out(self, terms: list[Expr]) -> Expr:
        return sum_of(terms)


class ProductOver(Over):
    """Π over a finite set."""

    sign = "Π"

    @staticmethod
    def value(values: Sequence[Value]) -> Value:
        """Nothing makes 1."""
        return prod(values, start=ONE)

    def _written_out(self, terms: list[Expr]) -> Expr:
        return product_of(terms)


class MaxOf(Greatest):
    """The greatest of some values, in their order: a maximum over a set, written out."""

    def _typeset(self, _: object) -> Math:
        return row(word(self.name), self.braces())

    def braces(self) -> Math:
        """The values, as a set is written."""
        return Fence(listed(map(alone, self.args), ";"), "{", "}")

    def _inner(self, worked_out: Callable[[Expr], Expr]) -> Expr:
        return worked_out(self)


class MaxOver(Over):
    """The greatest value over a finite set."""

    sign = "max"
    value = staticmethod(largest)

    def _written_out(self, terms: list[Expr]) -> Expr:
        return MaxOf(*terms) if len(terms) > 1 else terms[0]


class ArgMaxOver(Over):
    """The elements of a finite set at which the body is greatest."""

    sign = "arg max"
    value = staticmethod(arg_max)

    def _typeset(self, typeset: Callable[[Expr], Math]) -> Math:
        if isinstance(self.body, MaxOf):
            return row(Big(self.sign, typeset(self.index)), self.body.braces())
        return super()._typeset(typeset)

    def _compiled(self, compiler: Compiler) -> str:
        return compiler.call(self, compiler(self.domain), self._values(compiler))

    def _written_out(self, terms: list[Expr]) -> Expr:
        return ArgMaxOver(MaxOf(*terms), self.index, self.domain)

    def _reduced(self, _: object) -> Expr:
        return ArgMaxOver(reduced(self.body), self.index, self.domain)


class MeanOver(Over):
    """The unweighted mean over a finite set; no formula of the sheet has it, but mistakes do."""

    sign = "mean"

    @staticmethod
    def value(values: Sequence[Value]) -> Value:
        """Their sum by their number."""
        return sum(values, ZERO) / len(values)

    def _written_out(self, terms: list[Expr]) -> Expr:
        return product_of([sum_of(terms), power_of(sympy.Integer(len(terms)), sympy.S.NegativeOne)])


class SampleMean(MeanOver):
    """𝔼 over cases that are equally probable; which case it runs over is not written."""

    look = Look.OTHER

    def _typeset(self, typeset: Callable[[Expr], Math]) -> Math:
        return row(operator("𝔼"), Fence(typeset(self.body), "[", "]"))


class IntegralOver(Over):
    """∫ over all values of a letter: only written, beside a closed form that is computed with."""

    look = Look.OTHER
    sign = "∫"

    def _typeset(self, typeset: Callable[[Expr], Math]) -> Math:
        return row(Big(self.sign), self._written_body(typeset), variable("d"), typeset(self.index))


class Expected(Node):
    """An expectation over runs of an agent; what it is worth is computed with one run in its place."""

    def _typeset(self, typeset: Callable[[Expr], Math]) -> Math:
        return row(Script(variable("𝔼"), variable("π")), Fence(typeset(self.args[0]), "[", "]"))

    def _compiled(self, compiler: Compiler) -> str:
        return compiler(self.args[0])

    def _put_in(self, put_in: PutIn) -> Expr:
        return put_in(self.args[0])
