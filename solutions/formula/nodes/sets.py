"""What runs over a finite set: sums, products, means and maxima; the sets, and how large they are."""

from collections.abc import Callable
from math import prod
from typing import Any, ClassVar

import sympy
from sympy import Expr, Integer

from rldrill.problems.mathematics import Big, Fence, Math, Script, listed, operator, relation, row, variable, word
from rldrill.solutions.exact import ONE, ZERO, NotGiven, is_rational, largest, to_sympy
from rldrill.solutions.formula.compiling import arg_max
from rldrill.solutions.formula.node import Look, Needs, Node, Python, Typeset
from rldrill.solutions.formula.nodes.choices import Greatest
from rldrill.solutions.formula.nodes.leaves import PutInName, computed
from rldrill.solutions.formula.putting_in import PutIn, power_of, product_of, reduced, sum_of
from rldrill.solutions.formula.typesetting import alone


class Counting(Node):
    """The whole numbers from the first to the last; ``shown`` is the upper limit as the sheet prints it."""

    value = staticmethod(lambda first, last: range(first, last + 1))

    def __new__(cls, first: Expr, last: Expr, shown: Expr | None = None) -> "Counting":
        """Build it without evaluating anything."""
        last = sympy.sympify(last, strict=True)
        return Expr.__new__(cls, sympy.sympify(first, strict=True), last, last if shown is None else shown)

    @property
    def free_symbols(self) -> set[sympy.Symbol]:
        """The upper limit as printed is not computed with."""
        return self.args[0].free_symbols | self.args[1].free_symbols

    def _compiled(self, python: Python) -> str:
        return self._called(*map(python, self.args[:2]))

    def _needs(self, needs: Needs) -> frozenset[str]:
        return needs(self.args[0]) | needs(self.args[1])


class Size(Node):
    """How many elements a finite set has."""

    value = staticmethod(len)

    def _typeset(self, typeset: Typeset) -> Math:
        return Fence(typeset(self.args[0]), "|", "|")

    def _put_in(self, put_in: PutIn) -> Expr:
        return Integer(put_in.value(self))


class Over(Node):
    """Something that runs over a finite set: its body, its index and the set.

    The set is a quantity whose value is a collection, or a ``Counting``.
    """

    look = Look.OPEN
    sign: ClassVar[str]
    #: What becomes of it when its values are put in one by one.
    written_out: ClassVar[Any]

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
    def free_symbols(self) -> set[sympy.Symbol]:
        """The letters that a value must be given for."""
        return (self.body.free_symbols - {self.index}) | self.domain.free_symbols

    def _typeset(self, typeset: Typeset) -> Math:
        below: Math = typeset(self.index)
        above: Math | None = None
        if isinstance(self.domain, Counting):
            first, _, shown = self.domain.args
            below, above = row(below, relation("="), typeset(first)), typeset(shown)
        return row(Big(self.sign, below, above), self._written_body(typeset))

    def _written_body(self, typeset: Typeset) -> Math:
        return Fence(typeset(self.body)) if self.body.is_Add else typeset(self.body)

    def _compiled(self, python: Python) -> str:
        return self._called(self._values(python))

    def _needs(self, needs: Needs) -> frozenset[str]:
        return (needs(self.body) - {self.index.name}) | needs(self.domain)

    def _values(self, python: Python) -> str:
        return f"[{python(self.body)} for {python(self.index)} in {python(self.domain)}]"

    def _put_in(self, put_in: PutIn) -> Expr:
        return self.written_out(self._terms(put_in))

    def _terms(self, put_in: PutIn) -> list[Expr]:
        return [put_in.knowing(self.index.name, item)(self.body) for item in put_in.value(self.domain)]


#: A sum of more terms than this is written with its first terms and its last.
LONG = 24
_FIRST = 3


class LongSum(Node):
    """A sum of many numbers, put in: its value, how many terms it has, and those of them that are written."""

    is_Add = True  # it needs the brackets of a sum

    def _typeset(self, typeset: Typeset) -> Math:
        *first, last = self.args[2:]
        return typeset(sympy.Add(*first, PutInName("…"), last, evaluate=False))

    @property
    def operations(self) -> int:
        """A product and an addition for every term."""
        return 2 * int(self.args[1])

    def _evaluated(self, _: object) -> Any:
        return self.args[0]

    def _reduced(self, _: object) -> Expr:
        return computed(self.args[0])


class SumOver(Over):
    """Σ over a finite set."""

    sign = "Σ"
    value = staticmethod(lambda values: sum(values[1:], values[0]) if values else ZERO)  # 0 + matrix is an error
    written_out = staticmethod(sum_of)

    def _put_in(self, put_in: PutIn) -> Expr:
        if len(put_in.value(self.domain)) <= LONG or (summed := self._long(put_in)) is None:
            return super()._put_in(put_in)
        return summed

    def _long(self, put_in: PutIn) -> Expr | None:
        """The sum without its zeros, and shortened where it is still long; None where not all terms are numbers."""
        here = {item: put_in.knowing(self.index.name, item) for item in put_in.value(self.domain)}
        try:
            values = {item: inside.value(self.body) for item, inside in here.items()}
        except NotGiven:  # the unknowns of a system
            return None
        if not all(map(is_rational, values.values())):
            return None
        kept = [inside for item, inside in here.items() if values[item] != 0]
        written = [inside(self.body) for inside in (kept if len(kept) <= LONG else (*kept[:_FIRST], kept[-1]))]
        if len(kept) <= LONG:
            return sum_of(written)
        return LongSum(to_sympy(sum(values.values(), ZERO)), Integer(len(kept)), *written)


class ProductOver(Over):
    """Π over a finite set."""

    sign = "Π"
    value = staticmethod(lambda values: prod(values, start=ONE))
    written_out = staticmethod(product_of)


class MaxOf(Greatest):
    """The greatest of some values, in their order: a maximum over a set, written out."""

    def _typeset(self, _: object) -> Math:
        return row(word(self.name), self.braces())

    def braces(self) -> Math:
        """The values, as a set is written."""
        return Fence(listed(map(alone, self.args), ";"), "{", "}")

    def _inner(self, worked_out: Callable[[Expr], Expr]) -> Expr:
        values = self.func(*map(worked_out, self.args))
        return worked_out(self) if values == self else values


class MaxOver(Over):
    """The greatest value over a finite set."""

    sign = "max"
    value = staticmethod(largest)
    written_out = staticmethod(lambda terms: MaxOf(*terms) if len(terms) > 1 else terms[0])


class ArgMaxOver(Over):
    """The elements of a finite set at which the body is greatest."""

    sign = "arg max"
    value = staticmethod(arg_max)

    def _typeset(self, typeset: Typeset) -> Math:
        if isinstance(self.body, MaxOf):
            return row(Big(self.sign, typeset(self.index)), self.body.braces())
        return super()._typeset(typeset)

    def _compiled(self, python: Python) -> str:
        return self._called(python(self.domain), self._values(python))

    def _put_in(self, put_in: PutIn) -> Expr:
        return ArgMaxOver(MaxOf(*self._terms(put_in)), self.index, self.domain)

    def _reduced(self, _: object) -> Expr:
        return ArgMaxOver(reduced(self.body), self.index, self.domain)


class MeanOver(Over):
    """The unweighted mean over a finite set; no formula of the sheet has it, but mistakes do."""

    sign = "mean"
    value = staticmethod(lambda values: sum(values, ZERO) / len(values))
    written_out = staticmethod(lambda terms: product_of([sum_of(terms), power_of(Integer(len(terms)), Integer(-1))]))


class SampleMean(MeanOver):
    """𝔼 over cases that are equally probable; which case it runs over is not written."""

    look = Look.OTHER

    def _typeset(self, typeset: Typeset) -> Math:
        return row(operator("𝔼"), Fence(typeset(self.body), "[", "]"))


class IntegralOver(Over):
    """∫ over all values of a letter: only written, beside a closed form that is computed with."""

    look = Look.OTHER
    sign = "∫"

    def _typeset(self, typeset: Typeset) -> Math:
        return row(Big(self.sign), self._written_body(typeset), variable("d"), typeset(self.index))


class Expected(Node):
    """An expectation over runs of an agent; what it is worth is computed with one run in its place."""

    value = staticmethod(lambda value: value)

    def _typeset(self, typeset: Typeset) -> Math:
        return row(Script(variable("𝔼"), variable("π")), Fence(typeset(self.args[0]), "[", "]"))

    def _put_in(self, put_in: PutIn) -> Expr:
        return put_in(self.args[0])
