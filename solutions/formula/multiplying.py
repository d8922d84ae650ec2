"""Products of matrices and multiples of vectors in a step, as they are worked out by hand: one thing on a line."""

from collections.abc import Iterator

import sympy
from sympy import Add, Expr, Mul

from rldrill.solutions.formula.node import Node
from rldrill.solutions.formula.nodes.leaves import Factor, MatrixLeaf, Negative, VectorLeaf, leaf
from rldrill.solutions.formula.nodes.matrices import Blocks, Transposed
from rldrill.solutions.formula.putting_in import evaluated, product_of, sum_of

#: Sums of matrices are written out entry by entry for so many entries; of products so many fit into a line.
_ENTRIES, _PRODUCTS = 4, 6


def multiplied_out(expression: Expr) -> Iterator[Expr]:
    """The lines between a product of matrices and its value: two factors at a time, then the sums of products."""
    while (following := _next(expression)) != expression:
        yield following
        expression = following


def _next(expression: Expr) -> Expr:
    if isinstance(expression, Node):
        return expression
    if expression.is_Add:
        terms = list(map(_next, expression.args))
        if terms == list(expression.args):
            terms = _multiples(terms)
        if terms == list(expression.args):
            terms = _products_of_numbers(terms)
        return expression if terms == list(expression.args) else sum_of(terms)
    if not expression.is_Mul:
        return expression
    factors = expression.args
    if any(factor.is_Add for factor in factors):
        inner = [_next(factor) if factor.is_Add else factor for factor in factors]
        return expression if inner == list(factors) else Mul._from_args(inner)
    grids = [factor for factor in factors if _is_grid(factor)]
    numbers = [factor for factor in factors if not _is_grid(factor)]
    if len(grids) < 2 or not all(number.is_commutative or getattr(number, "scalar", False) for number in numbers):
        return expression
    if len(grids) > 2:
        start = len(grids) - 2 if _matrix(grids[-1]).cols == 1 else 0
        pair = _matrix(grids[start]) * _matrix(grids[start + 1])
        return Mul._from_args([*numbers, *grids[:start], MatrixLeaf(pair), *grids[start + 2 :]])
    sums = _sums(*map(_matrix, grids))
    return expression if sums is None else product_of([*numbers, sums])


def _is_grid(factor: Expr) -> bool:
    """Whether it is a matrix of numbers that is written as one, perhaps transposed."""
    body = factor.args[0] if isinstance(factor, Transposed) else factor
    return isinstance(body, MatrixLeaf) and not isinstance(body, VectorLeaf) and not body.scalar


def _matrix(factor: Expr) -> sympy.ImmutableMatrix:
    return factor.args[0].args[0].T if isinstance(factor, Transposed) else factor.args[0]


def _sums(left: sympy.ImmutableMatrix, right: sympy.ImmutableMatrix) -> Expr | None:
    """Every entry of a product as the sum that it is; nothing where no entry is one, or where it is too much."""
    rows, columns = left.rows, right.cols
    if rows > 1 and columns > 1 and any(entry.is_Add for entry in (*left, *right)):
        return None
    entries = [
        [
            Mul._from_args([_put_in(a), _put_in(b)])
            for a, b in zip(left.row(i), right.col(j), strict=True)
            if a != 0 != b
        ]
        for i in range(rows)
        for j in range(columns)
    ]
    if columns * max(map(len, entries)) > _PRODUCTS:
        return None
    trivial = max(map(len, entries)) < 2 and all(entry.is_Rational for entry in (*left, *right))
    if trivial and len(entries) > 1:
        return None
    summed = [Add._from_args(terms) if len(terms) > 1 else sum_of(terms) for terms in entries]
    return summed[0] if rows == columns == 1 else Blocks(rows, *summed)


def _put_in(entry: Expr) -> Expr:
    """An entry as a factor; a multiple of π stays together, as one of a root does."""
    together = entry.is_Mul and entry.is_number and not entry.could_extract_minus_sign()
    return Factor(entry) if together else leaf(entry)


def _products_of_numbers(terms: list[Expr]) -> list[Expr]:
    """The terms of a sum of numbers that were matrices, such as (−1)·(−3)·2·(−3/8), where one has many factors."""
    factors = [Mul.make_args(term) for term in terms]
    matrices = any(isinstance(factor, MatrixLeaf) for each in factors for factor in each)
    long = matrices and any(sum(map(_is_number, each)) > 2 for each in factors)
    return [_product_of_numbers(term) for term in terms] if long else terms


def _product_of_numbers(term: Expr) -> Expr:
    factors = [factor for factor in Mul.make_args(term) if factor != -1]
    if len(factors) < 2 or not all(map(_is_number, factors)):
        return term
    value = leaf(sympy.Mul(*[factor.args[0][0] if isinstance(factor, MatrixLeaf) else factor for factor in factors]))
    return value if len(factors) == len(Mul.make_args(term)) else Mul._from_args([sympy.S.NegativeOne, value])


def _is_number(factor: Expr) -> bool:
    """Whether it is a matrix of one rational number, or such a number itself."""
    if isinstance(factor, MatrixLeaf):
        return bool(factor.scalar and factor.args[0][0].is_Rational)
    return bool(factor.is_Rational and factor != -1)


def entry_by_entry(expression: Expr) -> Expr | None:
    """A sum of matrices with a letter in them, its entries as sums that are still to be added up; else None."""
    grids, signs = [], []
    for term in Add.make_args(expression):
        factors = [factor for factor in Mul.make_args(term) if factor != -1]
        if len(factors) != 1 or not _is_grid(factors[0]):
            return None
        grids.append(_matrix(factors[0]))
        signs.append(1 if len(factors) == len(Mul.make_args(term)) else -1)
    rows, columns = grids[0].shape
    if len(grids) < 2 or rows * columns > _ENTRIES or not any(grid.free_symbols for grid in grids):
        return None
    entries = [
        [sign * grid[i, j] for sign, grid in zip(signs, grids, strict=True) if grid[i, j] != 0] or [sympy.S.Zero]
        for i in range(rows)
        for j in range(columns)
    ]
    if max(map(len, entries)) < 2:
        return None
    return Blocks(rows, *(sum_of([leaf(first), *map(_further, others)]) for first, *others in entries))


def _further(entry: Expr) -> Expr:
    """A term of a sum behind its first, with its sign before it."""
    negative = isinstance(leaf(entry), Negative)
    return Mul._from_args([sympy.S.NegativeOne, leaf(-entry)]) if negative else leaf(entry)


def _multiples(terms: list[Expr]) -> list[Expr]:
    """The terms of a sum of vectors, each multiplied by what stands before it."""
    return list(map(_multiple, terms))


def _multiple(term: Expr) -> Expr:
    factors = [factor for factor in Mul.make_args(term) if factor != -1]
    if len(factors) < 2 or sum(isinstance(factor, VectorLeaf) for factor in factors) != 1:
        return term
    value = evaluated(term)
    if not isinstance(value, sympy.MatrixBase) or not all(entry.is_rational_function() for entry in value):
        return term
    return VectorLeaf(value.applyfunc(lambda entry: sympy.expand(sympy.cancel(entry))))
