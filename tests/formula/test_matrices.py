"""Matrices keep their order in a product, letters and quantities of numbers do not; each is declared as what it is."""

from collections.abc import Iterator, Mapping
from typing import Any

import pytest
from sympy import Symbol

from rldrill.problems.catalogue import chosen
from rldrill.problems.catalogue import family as family_of
from rldrill.solutions.drawing import draw
from rldrill.solutions.formula.letters import letter
from rldrill.solutions.formula.notation import Quantity, called, quantity
from rldrill.solutions.matrices import is_matrix
from rldrill.solutions.work import Step

FAMILIES = [*chosen(("linear-methods",)), "kalman-filter", "denavit-hartenberg", "jacobian"]


def test_matrices_keep_their_order_in_a_product() -> None:
    t = Symbol("t")
    first, second = (quantity(code, called("F"), matrix=True)(t) for code in ("FirstM", "SecondM"))
    one, two = (quantity(code, called("f"))(t) for code in ("first", "second"))
    assert first * second != second * first
    assert one * two == two * one
    assert letter("FirstL", "F", matrix=True) * first != first * letter("FirstL", "F", matrix=True)
    assert letter("firstl", "f") * first == first * letter("firstl", "f")


def put_in(step: Step) -> Iterator[tuple[str, bool, Any]]:
    """What a formula mentions: whether it keeps its order, and what it is here, or at each time."""
    for symbol in step.right.free_symbols:
        if symbol.name in step.known:
            yield symbol.name, symbol.is_commutative is False, step.known[symbol.name]
    for found in step.right.atoms(Quantity):
        values = step.known.get(found.code)
        for value in values.values() if isinstance(values, Mapping) else [values]:
            yield found.code, found.is_commutative is False, value


@pytest.mark.parametrize("name", FAMILIES)
def test_what_is_a_matrix_is_declared_as_one(name: str) -> None:
    for level in family_of(name).levels:
        for line in (line for seed in range(4) for line in draw(name, level, seed).lines if isinstance(line, Step)):
            for code, keeps_its_order, value in put_in(line):
                if is_matrix(value) and (value.nrows(), value.ncols()) != (1, 1):
                    assert keeps_its_order, f"{code} in {line.formula.key}"
