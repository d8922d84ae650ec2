"""A number that was found, put in for its letter in what was worked out before."""

from collections.abc import Sequence

import sympy
from sympy import Expr, Mul, Pow

from rldrill.solutions.exact import ordered, to_sympy
from rldrill.solutions.formula.nodes.matrices import Blocks
from rldrill.solutions.formula.putting_in import put_in
from rldrill.solutions.value import Value


def with_number(lines: Sequence[Sequence[Value]], letter: str, number: Value) -> Expr:
    """A matrix with a number in the place of a letter, nothing worked out; of one entry, the entry alone."""
    entries = [_entry(to_sympy(entry), letter, number) for line in lines for entry in line]
    return entries[0] if len(entries) == 1 else Blocks(len(lines), *entries)


def _entry(value: Expr, letter: str, number: Value) -> Expr:
    parts = (value,) if sympy.fraction(value)[1].is_number else sympy.fraction(value)
    above, *below = (put_in(ordered(sympy.expand(part)), {letter: number}) for part in parts)
    return Mul(above, Pow(*below, -1, evaluate=False), evaluate=False) if below else above
