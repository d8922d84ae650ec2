"""A sum with every term multiplied out, as it stands before its terms are collected."""

from collections.abc import Iterable

import sympy
from sympy import Expr

from rldrill.solutions.exact import Value, to_sympy
from rldrill.solutions.formula.nodes.leaves import leaf


def side_by_side(terms: Iterable[Value]) -> Expr:
    """The sum of these values, side by side; one that is a sum itself keeps its terms."""
    return sympy.Add(*(leaf(term) if to_sympy(term).is_Add else to_sympy(term) for term in terms), evaluate=False)
