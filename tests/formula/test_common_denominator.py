"""Quotients in a letter, added in front of the reader."""

import re
from itertools import pairwise

import pytest
import sympy

import rldrill
from rldrill.render.mathematics.unicode import unicode
from rldrill.solutions.formula.common_denominator import brackets_in_one_fraction, in_one_fraction
from rldrill.solutions.formula.typesetting import typeset

P, HALF = sympy.Symbol("p"), sympy.Rational(1, 2)


def over(above: sympy.Expr, below: sympy.Expr) -> sympy.Expr:
    return sympy.Mul(above, sympy.Pow(below, -1, evaluate=False), evaluate=False)


def total(*terms: sympy.Expr) -> sympy.Expr:
    return sympy.Add(*terms, evaluate=False)


def nested() -> sympy.Expr:
    """1/2·(1 + (9 − 4p)/(3 + p)) + 1/2·(−3 + (1 − 2p)/(3 + p))"""
    brackets = total(1, over(9 - 4 * P, 3 + P)), total(-3, over(1 - 2 * P, 3 + P))
    return total(*(sympy.Mul(HALF, bracket, evaluate=False) for bracket in brackets))


def test_brackets_are_added_first() -> None:
    # 1 + (9 − 4p)/(3 + p) = (12 − 3p)/(3 + p), and −3 + (1 − 2p)/(3 + p) = (−8 − 5p)/(3 + p).
    shown = unicode(typeset(brackets_in_one_fraction(nested())))
    assert shown == "(1/2·(12 − 3p))/(3 + p) + (1/2·(−8 − 5p))/(3 + p)"


def test_then_what_stands_above_the_common_denominator() -> None:
    together = in_one_fraction(nested())
    assert together is not None
    assert unicode(typeset(together)) == "(12 − 3p − 8 − 5p)/(6 + 2p)"


def test_the_denominator_has_whole_coefficients() -> None:
    # 6 + (−54 + 132p)/(3 + 2p) = (18 + 12p − 54 + 132p)/(3 + 2p)
    together = in_one_fraction(total(sympy.Integer(6), over(-54 + 132 * P, 3 + 2 * P)))
    assert together is not None
    assert unicode(typeset(together)) == "(18 + 12p − 54 + 132p)/(3 + 2p)"


@pytest.mark.parametrize("expression", [total(P, HALF), total(over(P, sympy.Integer(2)), 1), over(P, 3 + P)])
def test_where_no_letter_is_below_there_is_nothing_to_bring_together(expression: sympy.Expr) -> None:
    assert in_one_fraction(expression) is None


@pytest.mark.parametrize("family", ["policy-action-value", "policy-value", "batch-td-and-mc"])
def test_a_line_with_a_quotient_in_a_bracket_is_not_the_last_but_one(family: str) -> None:
    for seed in range(12):
        lines = [line.strip() for line in str(rldrill.draw(family, 3, seed).working()).splitlines()]
        for here, after in pairwise(lines):
            if re.search(r"\d/\d·\((?!0 )[^()]+ [+−] \([^()]+(\([^()]+\))?\)/\(", here) and after.startswith("="):
                assert after.count(")/(") > 1 or "·(" in after, (here, after)
