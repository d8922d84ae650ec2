"""A system of linear equations solved in front of the reader: one unknown after the other is put into the rest."""

from collections import Counter
from collections.abc import Callable, Generator, Hashable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any

import sympy
from msgspec import Struct
from msgspec.structs import replace
from sympy import Expr

from rldrill.solutions.closed_forms import rational
from rldrill.solutions.exact import ONE, Value, digits, is_rational, ordered, parameters, simplest, to_sympy
from rldrill.solutions.formula.collecting import collected_next
from rldrill.solutions.formula.common_denominator import in_one_fraction
from rldrill.solutions.formula.equations import Affine
from rldrill.solutions.formula.typesetting import typeset
from rldrill.solutions.rational import common_denominator

Sides = tuple[Expr, tuple[Expr, ...]]
#: An equation: so many times an unknown on the left, and its right side.
_Multiple = tuple[Value, Affine]
#: Of more unknowns than this nobody wants to read the elimination.
MOST_UNKNOWNS = 6


def elimination(
    names: Mapping[Hashable, Expr],
    equations: Mapping[Hashable, Any],
    terms: Mapping[Hashable, Sequence[Expr]] = MappingProxyType({}),
) -> Iterator[str | Sides]:
    """The lines of the elimination: sentences, and equations with their right sides.

    Args:
        names: how each unknown is written.
        equations: for every unknown its right side, an ``Affine`` or a plain value.
        terms: right sides that are multiplied out, but not collected yet, where there is such a line.
    """
    return _eliminated(_Pen(names, _times, _sum, _added), equations, terms)


def largest(equations: Mapping[Hashable, Any]) -> int:
    """The largest whole number in the lines of the elimination, above a line or below it; they are not written."""
    lines = _eliminated(_Pen(dict.fromkeys(equations, 0), _largest_factor, _largest_term, _both), equations)
    return max((max(line[0], *line[1]) for line in lines if not isinstance(line, str)), default=0)


class _Pen(Struct, frozen=True):
    """How unknowns, products, sums, and right sides with their values are written; or what is noted of them instead."""

    names: Mapping[Hashable, Any]
    times: Callable[..., Any]
    sum: Callable[..., Any]
    added: Callable[[Any, Any], tuple[Any, ...]]


def _eliminated(
    pen: _Pen, equations: Mapping[Hashable, Any], terms: Mapping[Hashable, Sequence[Expr]] = MappingProxyType({})
) -> Iterator[Any]:
    open_ = {key: (ONE, _affine(side)) for key, side in equations.items()}
    if any(side.factors for _, side in open_.values()):
        yield "Multiplied out:"
        for key, (_, side) in open_.items():
            yield pen.names[key], (*terms.get(key, ()), _written(side, pen))
        for key, equation in open_.items():
            if key in equation[1].factors and _others(key, equation):
                open_[key] = yield from _collected(key, equation, pen)
    solved: dict[Hashable, _Multiple] = {}
    values: dict[Hashable, Affine] = {}
    while open_:
        key = _easiest(open_)
        if _others(key, open_[key]):  # nothing is known by itself any more
            for each, equation in open_.items():
                open_[each] = yield from _collected(each, equation, pen)
            key = _easiest(open_)
        solved[key] = yield from _collected(key, open_.pop(key), pen)
        if not _others(key, solved[key]):
            values[key] = yield from _divided(key, solved[key], pen)
        by = (ONE, values[key]) if key in values else solved[key]
        for other, equation in open_.items():
            if key in equation[1].factors:
                open_[other] = yield from _put_in(other, equation, key, by, pen)
    for key, (scale, side) in reversed(solved.items()):
        if key not in values:
            value = side
            for other in side.factors:
                value = _affine(_without(value, other) + values[other] * value.factors[other])
            yield pen.times(pen.names[key], scale), pen.added(_written(side, pen, values), _written(value, pen))
            values[key] = yield from _divided(key, (scale, value), pen)


def _collected(key: Hashable, equation: _Multiple, pen: _Pen) -> Generator[Sides, None, _Multiple]:
    """An equation with its own unknown on the left alone; no denominators, but where it can be divided at once."""
    scale, side = equation
    if key in side.factors:
        scale, side = simplest(scale - side.factors[key]), _without(side, key)
        yield pen.times(pen.names[key], scale), (_written(side, pen),)
    lasts = bool(side.factors) or not is_rational(scale)
    factor = common_denominator((scale, side.constant, *side.factors.values())) if lasts else None
    if factor is not None and factor != 1:
        scale, side = simplest(scale * factor), _affine(side * factor)
        yield pen.times(pen.names[key], scale), (_written(side, pen),)
    return scale, side


def _put_in(
    key: Hashable, equation: _Multiple, known: Hashable, by: _Multiple, pen: _Pen
) -> Generator[Sides, None, _Multiple]:
    """An equation into which another is put, multiplied first so that the other's left side stands in it."""
    (scale, side), (each, instead) = equation, by
    share = simplest(side.factors[known] / each)
    factor = ONE if each == 1 else common_denominator((share,)) or each
    share = simplest(share * factor)
    rest = _without(side, known)
    after = _affine(rest * factor + instead * share)
    others = tuple(_terms(rest, pen, factor))
    multiplied = (pen.sum(*others, pen.times(pen.names[known], share, each)),) if factor != 1 else ()
    put_in = pen.sum(*others, pen.times(_written(instead, pen), share))
    yield pen.times(pen.names[key], scale, factor), (*multiplied, *pen.added(put_in, _written(after, pen)))
    equation = simplest(scale * factor), after
    return (yield from _collected(key, equation, pen)) if key in after.factors else equation


def _added(put_in: Expr, value: Expr) -> tuple[Expr, ...]:
    """A right side and its value; between them what is collected, or quotients in a letter over one denominator."""
    together = in_one_fraction(put_in)
    between = collected_next(put_in) if together is None else together
    if between is None or typeset(between) in map(typeset, (put_in, value)):
        return put_in, value
    return put_in, between, value


def _divided(key: Hashable, equation: _Multiple, pen: _Pen) -> Generator[Sides, None, Affine]:
    """The value of an unknown of which a multiple is known; a factor with a letter that cancels is taken out first."""
    scale, side = equation
    if scale == 1:
        return side
    value = _affine(side * (ONE / scale))
    if not is_rational(scale) and common_denominator((side.constant,)) == common_denominator((value.constant,)):
        yield pen.times(pen.names[key], scale), (pen.times(None, scale, value.constant),)
    yield pen.names[key], (_written(value, pen),)
    return value


def _easiest(equations: Mapping[Hashable, _Multiple]) -> Hashable:
    return min(equations, key=lambda key: _trouble(key, equations[key]))


def _trouble(key: Hashable, equation: _Multiple) -> tuple[int, int, int]:
    """What makes an equation hard to go on from: other unknowns, open letters, a long multiple on the left."""
    scale, side = equation
    letters = sum(bool(parameters(number)) for number in (scale, side.constant, *side.factors.values()))
    return len(_others(key, equation)), letters, digits(scale) if scale != 1 else 0


def _others(key: Hashable, equation: _Multiple) -> set[Hashable]:
    return equation[1].factors.keys() - {key}


def _affine(side: Any) -> Affine:
    """A right side without the unknowns that have dropped out of it, its numbers as simple as they get."""
    if not isinstance(side, Affine):
        return Affine({}, side)
    factors = {key: simplest(factor) for key, factor in side.factors.items()}
    return Affine({key: factor for key, factor in factors.items() if factor != 0}, simplest(side.constant))


def _without(side: Affine, key: Hashable) -> Affine:
    return Affine({other: factor for other, factor in side.factors.items() if other != key}, side.constant)


def _written(side: Affine, pen: _Pen, put: Mapping[Hashable, Affine] | None = None) -> Any:
    """A right side as it is written, with values in place of the unknowns if they are known."""
    values = {key: _written(value, pen) for key, value in (put or {}).items()}
    return pen.sum(*_terms(side, replace(pen, names={**pen.names, **values}) if values else pen))


def _terms(side: Affine, pen: _Pen, factor: Value = ONE) -> Iterator[Any]:
    """The terms of so many times a right side."""
    if side.constant != 0:
        yield pen.times(None, side.constant, factor)
    for key, number in side.factors.items():
        yield pen.times(pen.names[key], number, factor)


def _sum(*terms: Expr) -> Expr:
    return sympy.Add(*terms, evaluate=False) if len(terms) > 1 else terms[0] if terms else sympy.S.Zero


def multiple(factor: Value, unknown: Expr) -> Expr:
    """So many times an unknown, as it is written."""
    return _times(unknown, factor)


def _times(unknown: Expr | None, *factors: Value) -> Expr:
    """A product as it is written: rational numbers are multiplied, what else there is stays side by side."""
    number, others = ONE, Counter[Expr]()
    for factor in factors:
        if is_rational(factor):
            number *= factor
            continue
        expression = to_sympy(factor)
        if expression.could_extract_minus_sign() and not expression.is_Add:
            number, expression = -number, -expression
        others[_in_order(expression)] += 1
    parts = [each if times == 1 else sympy.Pow(each, times, evaluate=False) for each, times in others.items()]
    if unknown is not None:
        parts.append(unknown)
    if not parts or number == 0:
        return rational(number)
    if abs(number) != 1:
        parts.insert(0, rational(abs(number)))
    if number < 0:
        parts.insert(0, sympy.S.NegativeOne)
    return parts[0] if len(parts) == 1 else sympy.Mul(*parts, evaluate=False)


def _in_order(expression: Expr) -> Expr:
    """A sum, or a quotient of sums, in the order of rising powers."""
    above, below = map(ordered, sympy.fraction(expression))
    if not below.free_symbols:
        return ordered(expression)
    return sympy.Mul(above, sympy.Pow(below, -1, evaluate=False), evaluate=False)


def _largest_factor(unknown: int | None, *factors: Value) -> int:
    number, found = ONE, unknown or 0
    for factor in factors:
        if is_rational(factor):
            number *= factor
        else:
            found = max(found, *(max(abs(each.p), each.q) for each in to_sympy(factor).atoms(sympy.Rational)))
    return max(found, abs(int(number.p)), int(number.q))


def _largest_term(*terms: int) -> int:
    return max(terms, default=0)


def _both(put_in: int, value: int) -> tuple[int, int]:
    return put_in, value
