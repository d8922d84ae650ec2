"""What formulas have and sympy has not: a node says itself how it is read, whatever the reading."""

from collections.abc import Callable, Iterable
from enum import Enum, auto
from typing import TYPE_CHECKING, Any, ClassVar, TypeAlias

from sympy import Expr

from rldrill.problems.mathematics import Math

if TYPE_CHECKING:
    from rldrill.solutions.formula.putting_in import PutIn

Typeset: TypeAlias = Callable[[Expr], Math]
Python: TypeAlias = Callable[[Expr], str]
Needs: TypeAlias = Callable[[Expr], frozenset[str]]


class Look(Enum):
    """What a part of a formula looks like: brackets around it and dots beside it depend on that."""

    LETTER = auto()
    NUMBER = auto()
    SLOT = auto()  # a 0 or 1 that keeps a place, and is set apart by dots
    GRID = auto()
    LINE = auto()  # of numbers in brackets
    OPEN = auto()  # what follows it would seem to belong to it
    OTHER = auto()


class Node(Expr):
    """A kind of part that formulas have and sympy has not.

    To add one, write a class; nothing else needs to know of it. It says how it is typeset, and by which
    functions it is computed from the values of its arguments; the rest may stay as it is here.
    """

    #: What computes it: compiled formulas can call nothing else, but for a few functions of numbers.
    value: ClassVar[Callable[..., Any]]
    #: What its values are looked up under, if they are given.
    code: ClassVar[str] = ""

    @property
    def symbolic(self) -> Callable[..., Any]:
        """What computes it from the values of a step, which are sympy's; without it, it stays what it is."""
        return self.func

    @property
    def look(self) -> Look:
        """What it looks like among others."""
        return Look.OTHER

    @property
    def holds_sum(self) -> bool:
        """Whether what it is written as is a sum, which needs brackets even where it begins a product."""
        return False

    @property
    def operations(self) -> int:
        """How many operations of arithmetic it costs, besides those of its arguments."""
        return 0

    @property
    def numbers(self) -> Iterable[Expr]:
        """The numbers in it whose digits count, besides those of its arguments."""
        return ()

    def _typeset(self, typeset: Typeset) -> Math:  # noqa: ARG002
        raise TypeError(f"{type(self).__name__} has no typesetting")

    def _alone(self, typeset: Typeset) -> Math:
        """How it is written between commas or brackets of something else."""
        return typeset(self)

    def _compiled(self, python: Python) -> str:
        return self._called(*map(python, self.args))

    def _called(self, *arguments: str) -> str:
        """A call of what computes it."""
        if not hasattr(self, "value"):
            raise TypeError(f"{type(self).__name__} has no value")
        return f"{type(self).__name__}({', '.join(arguments)})"

    def _needs(self, needs: Needs) -> frozenset[str]:
        """The names that values must be given for."""
        own = (self.code,) if self.code else ()
        return frozenset(own).union(*map(needs, self.args))

    def _put_in(self, put_in: "PutIn") -> Expr:
        return self.func(*map(put_in, self.args))

    def _evaluated(self, evaluated: Callable[[Expr], Any]) -> Any:
        return self.symbolic(*map(evaluated, self.args))

    def _plain(self, plain: Callable[[Expr], Expr]) -> Expr:  # noqa: ARG002
        """The step with numbers in place of the sines and powers of e that are plain."""
        return self

    def _reduced(self, worked_out: Callable[[Expr], Expr]) -> Expr:  # noqa: ARG002
        """The step with inner brackets worked out."""
        return self

    def _inner(self, worked_out: Callable[[Expr], Expr]) -> Expr:
        """What becomes of it among the terms and factors of a step whose inner brackets are worked out."""
        return self._reduced(worked_out)
