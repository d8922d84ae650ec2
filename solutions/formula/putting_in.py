"""The reading of a formula as a step: the givens put in, nothing evaluated, the textbook's order kept."""

from collections.abc import Iterable, Mapping
from typing import Any

import sympy
from sympy import Add, Expr, Mul, Pow

from rldrill.solutions.exact import ordered, to_sympy
from rldrill.solutions.formula.compiling import needs, value_of
from rldrill.solutions.formula.notation import (
    ArgMaxOver,
    Blocks,
    Cases,
    Clipped,
    Expected,
    Greatest,
    Indicator,
    Least,
    MatrixLeaf,
    MaxOf,
    MaxOver,
    MeanOver,
    Negative,
    Over,
    ProductOver,
    Quantity,
    Size,
    SumOver,
    Transposed,
    VectorLeaf,
    put_in_name,
)
from rldrill.solutions.matrices import is_matrix
from rldrill.solutions.vector import Vector

Known = Mapping[str, Any]


def put_in(expression: Expr, known: Known) -> Expr:
    """Put the known values into an expression, unevaluated.

    Sums and maxima are written out over their sets; terms that are zero are dropped. What is not known
    (the unknowns of a system) stays a quantity, with its indices put in.
    """
    if isinstance(expression, Quantity):
        return _quantity(expression, known)
    if isinstance(expression, Over):
        return _over(expression, known)
    if isinstance(expression, Expected):
        return put_in(expression.args[0], known)
    if isinstance(expression, Indicator | Size):
        return sympy.Integer(value_of(expression, known))
    if isinstance(expression, Cases):
        condition, then, otherwise = expression.args
        return put_in(then if value_of(condition, known) else otherwise, known)
    if expression.is_Symbol:
        return leaf(known[expression.name]) if expression.name in known else expression
    if not expression.args:
        return expression
    arguments = [put_in(argument, known) for argument in expression.args]
    if expression.is_Add:
        return _sum(arguments)
    if expression.is_Mul:
        return _product(arguments)
    if isinstance(expression, Transposed) and getattr(arguments[0], "scalar", False):
        return arguments[0]
    if isinstance(expression, Blocks) and any(isinstance(block, MatrixLeaf) for block in arguments):
        return computed(evaluated(Blocks(*arguments)))  # blocks of numbers are one matrix at once
    if expression.is_Pow:
        # An exponent counts steps; it is not part of the working.
        return _power(arguments[0], evaluated(arguments[1]))
    return expression.func(*arguments, evaluate=False) if expression.is_Function else expression.func(*arguments)


def indexed(expression: Expr, known: Known) -> Expr:
    """Put in the indices only: ``V(s_t)`` becomes ``V(cool)``."""
    if isinstance(expression, Quantity):
        return expression.func(*[_index(argument, known) for argument in expression.args])
    return expression


def leaf(value: Any) -> Expr:
    """An exact value, a matrix or a name as a leaf of an expression."""
    if isinstance(value, str):
        return put_in_name(value)
    if is_matrix(value):
        return MatrixLeaf([[to_sympy(entry) for entry in line] for line in value.tolist()])
    if isinstance(value, Vector):
        return VectorLeaf(value.matrix())
    return computed(ordered(to_sympy(value)))


def computed(value: Any) -> Expr:
    """A number or matrix that sympy computed, as a leaf."""
    if isinstance(value, sympy.MatrixBase):
        return MatrixLeaf(value)
    first = value.args[0] if value.is_Mul else value  # −ln 4 needs brackets as −4 does
    return Negative(value) if first.is_Number and first.is_negative and not value.free_symbols else value


def _index(expression: Expr, known: Known) -> Expr:
    if all(name in known for name in needs(expression)):
        try:
            return put_in_name(value_of(expression, known))
        except (KeyError, IndexError):
            return expression
    return expression


def _quantity(expression: Quantity, known: Known) -> Expr:
    if expression.code in known:
        try:
            return leaf(value_of(expression, known))
        except KeyError:  # an unknown of a system, among values that are fixed
            pass
    return indexed(expression, known)


def _over(expression: Over, known: Known) -> Expr:
    items = list(value_of(expression.domain, known))
    terms = [put_in(expression.body, {**known, expression.index.name: item}) for item in items]
    if isinstance(expression, SumOver):
        return _sum(terms)
    if isinstance(expression, ProductOver):
        return _product(terms)
    if isinstance(expression, MaxOver):
        return MaxOf(*terms) if len(terms) > 1 else terms[0]
    if isinstance(expression, MeanOver):
        return _product([_sum(terms), _power(sympy.Integer(len(terms)), sympy.S.NegativeOne)])
    if isinstance(expression, ArgMaxOver):
        return ArgMaxOver(MaxOf(*terms), expression.index, expression.domain)
    raise TypeError(f"{expression.func.__name__} cannot be written out")


def _flat(kind: type[Expr], arguments: Iterable[Expr]) -> list[Expr]:
    flat: list[Expr] = []
    for argument in arguments:
        flat += _flat(kind, argument.args) if argument.func is kind else [argument]
    return flat


def _sum(terms: list[Expr]) -> Expr:
    kept = [term for term in _flat(Add, terms) if not (term.is_Number and term.is_zero)]
    if not kept:
        return sympy.S.Zero
    if len(kept) == 1:  # what is left of 0 − 5 is −5, not (−1)·5; and of 0 − (−5) it is 5
        sign, *rest = kept[0].args if kept[0].is_Mul else (None,)
        if sign == -1 and len(rest) == 1 and isinstance(rest[0], Negative):
            return leaf(-rest[0].args[0])
        return Negative(-rest[0]) if sign == -1 and len(rest) == 1 and rest[0].is_Number else kept[0]
    return Add(*kept, evaluate=False)


def _product(factors: list[Expr]) -> Expr:
    flat = _flat(Mul, factors)
    if any(factor.is_Number and factor.is_zero for factor in flat):
        return sympy.S.Zero
    kept = [factor for factor in flat if factor != 1]
    if len(kept) > 1:
        kept = _without_ones(kept)
    if not kept:
        return sympy.S.One
    return kept[0] if len(kept) == 1 else Mul(*kept, evaluate=False)


def _without_ones(factors: list[Expr]) -> list[Expr]:
    """The factors without 1×1 matrices of 1; one stays where the product would be no matrix without it."""
    ones = [f for f in factors if isinstance(f, MatrixLeaf) and f.scalar and f.args[0][0] == 1]
    kept = [f for f in factors if not any(f is one for one in ones)]
    return kept if any(f.is_commutative is False for f in kept) else [*kept, *ones[:1]]


def _power(base: Expr, exponent: Expr) -> Expr:
    if 1 in (base, exponent):
        return base
    if exponent == 0 or base == 1:
        return sympy.S.One
    return Pow(base, exponent, evaluate=False)


def evaluated(expression: Expr) -> Expr:
    """The value of a step without unknowns, as sympy computes it."""
    if isinstance(expression, MaxOf | Greatest):
        return sympy.Max(*map(evaluated, expression.args))
    if isinstance(expression, Least):
        return sympy.Min(*map(evaluated, expression.args))
    if isinstance(expression, Clipped):
        value, low, high = map(evaluated, expression.args)
        return sympy.Max(low, sympy.Min(value, high))
    if isinstance(expression, MatrixLeaf | Negative):
        return expression.args[0]
    if not expression.args or expression.is_Symbol:
        return expression
    arguments = [evaluated(argument) for argument in expression.args]
    if expression.is_Mul:
        product = arguments[0]
        for factor in arguments[1:]:
            product = product * factor
        return product
    if expression.is_Add:
        total = arguments[0]
        for term in arguments[1:]:
            total = total + term
        return total
    if expression.is_Pow:
        return arguments[0] ** arguments[1]
    if isinstance(expression, Blocks):
        return _stacked(*arguments)
    return arguments[0].T if isinstance(expression, Transposed) else expression.func(*arguments)


def _stacked(rows: Expr, *blocks: Any) -> Any:
    width = len(blocks) // int(rows)
    lines = [blocks[start : start + width] for start in range(0, len(blocks), width)]
    heights = [max(getattr(block, "rows", 1) for block in line) for line in lines]
    widths = [max(getattr(line[j], "cols", 1) for line in lines) for j in range(width)]
    return sympy.Matrix.vstack(
        *(
            sympy.Matrix.hstack(*(_filled(block, height, across) for block, across in zip(line, widths, strict=True)))
            for line, height in zip(lines, heights, strict=True)
        )
    )


def _filled(block: Any, height: int, across: int) -> Any:
    if isinstance(block, sympy.MatrixBase):
        return block
    return sympy.Matrix(height, across, lambda i, j: block if i == j else 0)


def reduced(expression: Expr) -> Expr:
    """The step with its inner brackets worked out: what one writes between putting in and the result."""
    if isinstance(expression, _PICKED):
        return expression.func(*[_worked_out(argument) for argument in expression.args])
    if isinstance(expression, ArgMaxOver):
        return ArgMaxOver(reduced(expression.body), expression.index, expression.domain)
    if expression.is_Add:
        return Add(*[_inner(term) for term in expression.args], evaluate=False)
    return _inner(expression)


#: What takes one of its arguments as it is.
_PICKED = (MaxOf, Greatest, Least, Clipped)


def _inner(term: Expr) -> Expr:
    if isinstance(term, Greatest | Least | Clipped):
        return reduced(term)
    if term.is_Mul:
        return Mul(*_without_ones([_inner(factor) for factor in term.args]), evaluate=False)
    if term.is_Pow and term.args[1] in (-1, sympy.S.Half):
        return Pow(_worked_out(term.args[0]), term.args[1], evaluate=False)
    return _worked_out(term) if term.is_Add or isinstance(term, MaxOf) else term


def _worked_out(expression: Expr) -> Expr:
    value = evaluated(expression)
    # What holds exponentials or roots does not get simpler, only reordered.
    if expression.has(VectorLeaf):
        return VectorLeaf(value.applyfunc(sympy.cancel))
    plain = isinstance(value, sympy.MatrixBase) or value.is_rational_function(*value.free_symbols)
    return computed(ordered(value) if value.is_Add else value) if plain else expression
