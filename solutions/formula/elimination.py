"""A system of linear equations solved in front of the reader: one unknown after the other is put into the rest."""

from collections.abc import Hashable, Iterator, Mapping
from typing import Any

import sympy
from sympy import Expr

from rldrill.solutions.exact import ONE, ZERO, Value, parameters, simplest, to_sympy
from rldrill.solutions.formula.equations import Affine

Sides = tuple[Expr, tuple[Expr, ...]]
#: Of more unknowns than this nobody wants to read the elimination.
MOST_UNKNOWNS = 6


def elimination(names: Mapping[Hashable, Expr], equations: Mapping[Hashable, Any]) -> Iterator[str | Sides]:
    """The lines of the elimination: sentences, and equations with their right sides.

    Args:
        names: how each unknown is written.
        equations: for every unknown its right side, an ``Affine`` or a plain value.
    """
    open_ = {key: _affine(side) for key, side in equations.items()}
    if any(side.factors for side in open_.values()):
        yield "Multiplied out:"
        for key, side in open_.items():
            yield names[key], (_written(side, names),)
    solved: dict[Hashable, Affine] = {}
    while open_:
        key = min(open_, key=lambda each: _trouble(each, open_[each]))
        side = open_.pop(key)
        own = side.factors.get(key, ZERO)
        if own != 0:
            rest = Affine({other: factor for other, factor in side.factors.items() if other != key}, side.constant)
            scale = simplest(ONE - own)
            side = _affine(rest * (ONE / scale))
            yield multiple(scale, names[key]), (_written(rest, names),)
            yield names[key], (_written(side, names),)
        solved[key] = side
        for other, entered in open_.items():
            if key in entered.factors:
                open_[other] = _affine(_substituted(entered, key, side))
                yield names[other], (_written(entered, names, {key: side}), _written(open_[other], names))
    values: dict[Hashable, Affine] = {}
    for key, side in reversed(solved.items()):
        value = side
        for other in side.factors:
            value = _affine(_substituted(value, other, values[other]))
        values[key] = value
        if side.factors:
            yield names[key], (_written(side, names, values), _written(value, names))


def _trouble(key: Hashable, side: Affine) -> tuple[int, int, bool]:
    """What makes an equation hard to go on from: other unknowns, open letters, its own unknown on the right."""
    letters = sum(bool(parameters(number)) for number in (side.constant, *side.factors.values()))
    return len(side.factors.keys() - {key}), letters, key in side.factors


def _affine(side: Any) -> Affine:
    """A right side without the unknowns that have dropped out of it, its numbers as simple as they get."""
    if not isinstance(side, Affine):
        return Affine({}, side)
    factors = {key: simplest(factor) for key, factor in side.factors.items()}
    return Affine({key: factor for key, factor in factors.items() if factor != 0}, simplest(side.constant))


def _substituted(side: Affine, key: Hashable, by: Affine) -> Affine:
    rest = {other: factor for other, factor in side.factors.items() if other != key}
    return Affine(rest, side.constant) + by * side.factors[key]


def _written(side: Affine, names: Mapping[Hashable, Expr], put: Mapping[Hashable, Affine] | None = None) -> Expr:
    """A right side as an expression; what is put in for an unknown keeps its brackets."""
    terms = [] if side.constant == 0 and side.factors else [to_sympy(side.constant)]
    for key, factor in side.factors.items():
        inner = names[key] if put is None or key not in put else _written(put[key], names)
        terms.append(multiple(factor, inner))
    return terms[0] if len(terms) == 1 else sympy.Add(*terms, evaluate=False)


def multiple(factor: Value, unknown: Expr) -> Expr:
    """So many times an unknown, as it is written."""
    if factor == 1:
        return unknown
    number = to_sympy(factor)
    if number.could_extract_minus_sign() and not number.is_Add:
        rest = () if number == -1 else (-number,)
        return sympy.Mul(sympy.S.NegativeOne, *rest, unknown, evaluate=False)
    return sympy.Mul(number, unknown, evaluate=False)
