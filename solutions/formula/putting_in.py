"""The reading of a formula as a step: the givens put in, nothing evaluated, the textbook's order kept."""

from collections.abc import Iterable, Mapping
from functools import reduce
from operator import add, mul
from typing import Any

import sympy
from sympy import Add, Expr, Mul, Pow

from rldrill.solutions.exact import NotGiven, ordered
from rldrill.solutions.formula.compiling import needs, value_of
from rldrill.solutions.formula.node import Node
from rldrill.solutions.formula.nodes.leaves import (
    Factor,
    Leaf,
    MatrixLeaf,
    Negative,
    Slot,
    VectorLeaf,
    computed,
    leaf,
    put_in_name,
)

Known = Mapping[str, Any]
ANGULAR = (sympy.sin, sympy.cos, sympy.tan)


class PutIn:
    """Puts what is known into an expression, unevaluated.

    Sums and maxima are written out over their sets. A 0 or 1 that is given keeps its place in the rule; terms that
    are zero because nothing is there (a transition that does not exist) are dropped. What is not known (the unknowns
    of a system) stays a quantity, with its indices put in.
    """

    def __init__(self, known: Known) -> None:
        self.known = known

    def __call__(self, expression: Expr) -> Expr:
        """The expression with the values put in."""
        if isinstance(expression, Node):
            return expression._put_in(self)
        if expression.is_Symbol:
            return leaf(self.known[expression.name]) if expression.name in self.known else expression
        if not expression.args:
            return expression
        arguments = map(self, expression.args)
        if expression.is_Add:
            return sum_of(arguments)
        if expression.is_Mul:
            return product_of(arguments)
        if expression.is_Pow:
            base, exponent = arguments
            return _raised(base, evaluated(exponent))  # an exponent counts steps; it is not part of the working
        return expression.func(*arguments, evaluate=False) if expression.is_Function else expression.func(*arguments)

    def knowing(self, name: str, value: Any) -> "PutIn":
        """The same, with one value more."""
        return PutIn({**self.known, name: value})

    def value(self, expression: Expr) -> Any:
        """What an expression is worth here."""
        return value_of(expression, self.known)


def put_in(expression: Expr, known: Known) -> Expr:
    """The known values put into an expression, unevaluated."""
    return PutIn(known)(expression)


def indexed(expression: Expr, known: Known) -> Expr:
    """Put in the indices only: ``V(s_t)`` becomes ``V(cool)``."""
    if isinstance(expression, Node) and expression.code:
        return expression.func(*[_index(argument, known) for argument in expression.args])
    if expression.is_Mul or expression.is_Pow:  # a quotient of quantities
        return expression.func(*[indexed(argument, known) for argument in expression.args], evaluate=False)
    return expression


def _index(expression: Expr, known: Known) -> Expr:
    if all(name in known for name in needs(expression)):
        try:
            return put_in_name(value_of(expression, known))
        except NotGiven:
            return expression
    return expression


def _flat(kind: type[Expr], arguments: Iterable[Expr]) -> list[Expr]:
    flat: list[Expr] = []
    for argument in arguments:
        flat += _flat(kind, argument.args) if argument.func is kind else [argument]
    return flat


def sum_of(terms: Iterable[Expr]) -> Expr:
    """A sum, unevaluated: without terms that are zero."""
    kept = [term for term in _flat(Add, terms) if term is not sympy.S.Zero]
    if not kept:
        return sympy.S.Zero
    if len(kept) == 1:  # what is left of 0 − 5 is −5, not (−1)·5; and of 0 − (−5) it is 5
        sign, *rest = kept[0].args if kept[0].is_Mul else (None,)
        if sign == -1 and len(rest) == 1 and isinstance(rest[0], Negative):
            return leaf(-rest[0].args[0])
        return Negative(-rest[0]) if sign == -1 and len(rest) == 1 and rest[0].is_Number else kept[0]
    return Add._from_args(kept)


def _is_nothing(term: Expr) -> bool:
    """Whether a term is a multiple of a matrix of zeros, which keeps its place in the first line only."""
    matrices = (f for f in Mul.make_args(term) if isinstance(f, MatrixLeaf) and not isinstance(f, VectorLeaf))
    return any(not f.scalar and f.args[0].is_zero_matrix for f in matrices)


def product_of(factors: Iterable[Expr]) -> Expr:
    """A product, unevaluated: without factors that are 1."""
    flat = _flat(Mul, factors)
    if any(factor is sympy.S.Zero for factor in flat):
        return sympy.S.Zero
    kept = [factor for factor in flat if factor is not sympy.S.One]
    if not kept:
        return sympy.S.One
    return Mul._from_args(kept)


def _without_ones(factors: list[Expr]) -> list[Expr]:
    """The factors without 1×1 matrices of 1; one stays where the product would be no matrix without it."""
    ones = [f for f in factors if isinstance(f, MatrixLeaf) and f.scalar and f.args[0][0] == 1]
    kept = [f for f in factors if not any(f is one for one in ones)]
    return kept if any(f.is_commutative is False for f in kept) else [*kept, *ones[:1]]


def _raised(base: Expr, exponent: Expr) -> Expr:
    """A power with what was put in: an exponent of 0 or 1 keeps its place in the rule, as other zeros and ones do."""
    return Pow(base, Slot(exponent) if exponent in (0, 1) else exponent, evaluate=False)


def power_of(base: Expr, exponent: Expr) -> Expr:
    """A power, unevaluated, unless it is plain."""
    if exponent == 0 or base == 1:
        return sympy.S.One
    if exponent == 1 or (base == 0 and exponent.is_positive):
        return base
    return Pow(base, exponent, evaluate=False)


def evaluated(expression: Expr) -> Any:
    """The value of a step without unknowns, as sympy computes it."""
    if isinstance(expression, Node):
        return expression._evaluated(evaluated)
    if not expression.args:
        return expression
    arguments = map(evaluated, expression.args)
    if expression.is_Add:
        return reduce(add, arguments)
    if expression.is_Mul:
        return reduce(mul, arguments)
    return pow(*arguments) if expression.is_Pow else expression.func(*arguments)


def without_slots(expression: Expr) -> Expr:
    """The step without the zeros and ones that only keep a place."""
    if isinstance(expression, Slot):
        return expression.args[0]
    if isinstance(expression, Leaf) or not expression.has(Slot):
        return expression
    if expression.is_Mul:
        return _without_minus_one(product_of(map(_bracket, expression.args)))
    arguments = map(without_slots, expression.args)
    if expression.is_Add and not isinstance(expression, Node):
        return sum_of(arguments)
    if expression.is_Pow:
        return power_of(*arguments)
    plain = expression.is_Function and not isinstance(expression, Node)
    return expression.func(*arguments, evaluate=False) if plain else expression.func(*arguments)


def _without_minus_one(product: Expr) -> Expr:
    """The product with a minus before it for the factors −1 that were put in: they fill the line as factors 1 do."""
    factors = Mul.make_args(product)
    kept = [factor for factor in factors if not (isinstance(factor, Negative) and factor.args[0] == -1)]
    others = [factor for factor in kept if factor != -1]
    if len(kept) == len(factors) or not others or any(factor.is_commutative is False for factor in others):
        return product
    odd = (len(factors) - len(others)) % 2
    return Mul._from_args([sympy.S.NegativeOne, *others]) if odd else product_of(others)


def _bracket(factor: Expr) -> Expr:
    """A factor without its zeros and ones; a bracket in which a product of numbers is left is worked out."""
    kept = without_slots(factor)
    return computed(evaluated(kept)) if factor.is_Add and kept.is_Mul and kept.is_number else kept


def reduced(expression: Expr) -> Expr:
    """The step with its inner brackets worked out: what one writes between putting in and the result.

    Where powers of e or sines are plain numbers, such as exp(ln 3) and cos(π/3), that is all that is worked out.
    """
    written = without_slots(expression)
    plain = _plain_powers(written)
    result = numbers_first(_reduced(written)) if plain == written else plain
    return result if result == expression else _subtracted(result)


def _subtracted(expression: Expr) -> Expr:
    """A sum with its negative numbers subtracted: 4 − 1, where the line before has 1·4 + 1·(−1)."""
    if not expression.is_Add or isinstance(expression, Node):
        return expression
    return Add._from_args(list(map(_minus_first, expression.args)))


def _minus_first(term: Expr) -> Expr:
    """A negative number, or a quotient of one, with its minus in front."""
    if isinstance(term, Negative):
        return term.args[0]
    above = [factor for factor in Mul.make_args(term) if not (factor.is_Pow and factor.args[1] == -1)]
    if len(above) != 1 or not isinstance(above[0], Negative):
        return term
    below = [factor for factor in term.args if factor is not above[0]]
    return Mul._from_args([sympy.S.NegativeOne, -above[0].args[0], *below])


def term_by_term(expression: Expr) -> Expr:
    """The step with every term of a sum worked out that is a number without a root: 16 + 1 + 2 for 2²·4 + 1 + 4·1/2."""
    if not expression.is_Add:
        return expression
    values = [(term, evaluated(term)) for term in expression.args]
    return Add._from_args([_with_sign(value) if value.is_Rational else term for term, value in values])


def long_sum(expression: Expr) -> Expr:
    """A sum of three products of numbers or more term by term, so that nobody adds them up in one go."""
    if not expression.is_Add or sum(map(_is_product, expression.args)) < _MANY_PRODUCTS:
        return expression
    return term_by_term(expression)


#: So many products are not worked out and added up at once.
_MANY_PRODUCTS = 3
#: Factors that make no product. They are compared as they are: the size of a long polynomial is no quick question.
_UNITS = (sympy.S.One, sympy.S.NegativeOne)


def _is_product(term: Expr) -> bool:
    return len([factor for factor in Mul.make_args(term) if factor not in _UNITS]) > 1 and evaluated(term).is_Rational


def _with_sign(number: Expr) -> Expr:
    """A number as a term of a sum: a negative one is taken away."""
    return Mul(-1, -number, evaluate=False) if number.is_negative else number


def numbers_first(expression: Expr) -> Expr:
    """The step with the numbers of its products before the letters left open: 8γ, not γ·8."""
    if isinstance(expression, Node):
        return expression
    if expression.is_Add:
        return Add(*map(numbers_first, expression.args), evaluate=False)
    if not expression.is_Mul:
        return expression
    in_brackets = (factor.args[0] if isinstance(factor, Negative) else factor for factor in expression.args)
    all_factors = _flat(Mul, in_brackets)  # α·5α is 5α²
    numbers = [factor for factor in all_factors if factor.is_number]
    letters = [factor for factor in all_factors if _is_letter(factor.args[0] if factor.is_Pow else factor)]
    if not numbers or not letters or len(numbers) + len(letters) < len(all_factors):
        return expression
    value = evaluated(Mul(*numbers, evaluate=False))
    together = Mul.make_args(Mul(*letters))  # λ·λ² is λ³
    factors = [*([-1] if value.is_negative else []), *([abs(value)] if abs(value) != 1 else []), *together]
    return Mul(*factors, evaluate=False) if len(factors) > 1 else factors[0]


def _is_letter(factor: Expr) -> bool:
    return bool(factor.is_Symbol) and not isinstance(factor, Node)


def _plain_powers(expression: Expr) -> Expr:
    """The step with numbers in the place of powers of e, sines, cosines and tangents that are plain."""
    if isinstance(expression, sympy.exp):
        value = evaluated(expression)
        return computed(value) if value.is_rational_function(*value.free_symbols) else expression
    if isinstance(expression, ANGULAR):
        value = evaluated(expression)
        if not value.is_algebraic:
            return expression
        return Factor(value) if value.is_Mul and not value.could_extract_minus_sign() else computed(value)
    if isinstance(expression, Node):
        return expression._plain(_plain_powers)
    if not expression.has(sympy.exp, *ANGULAR):
        return expression
    arguments = map(_plain_powers, expression.args)
    if expression.is_Add:
        return sum_of(arguments)
    if expression.is_Mul:
        return product_of(arguments)
    return power_of(*arguments) if expression.is_Pow else expression


def with_vanishing_sines(expression: Expr) -> Expr | None:
    """The step with numbers for its sines and cosines, if one of them is 0, and a slot for each; else None."""
    if isinstance(expression, Node) or not any(evaluated(angular) == 0 for angular in expression.atoms(*ANGULAR)):
        return None
    return _in_slots(expression)


def _in_slots(expression: Expr) -> Expr:
    if isinstance(expression, Node) or not expression.args:
        return expression
    if isinstance(expression, ANGULAR):
        return _plain_powers(expression)
    arguments = list(map(_in_slots, expression.args))
    return expression._from_args(arguments) if expression.is_Add or expression.is_Mul else expression


def _reduced(expression: Expr) -> Expr:
    if isinstance(expression, Node):
        return expression._reduced(_worked_out)
    if expression.is_Add:
        kept = [_term(term) for term in expression.args if not (_is_zero_number(term) or _is_nothing(term))]
        return Add._from_args(kept) if len(kept) > 1 else _inner(expression)
    return _inner(expression)


def _is_zero_number(term: Expr) -> bool:
    """Whether a term is a multiple of a 1×1 matrix of zero."""
    return any(isinstance(f, MatrixLeaf) and f.scalar and f.args[0][0] == 0 for f in Mul.make_args(term))


def _term(term: Expr) -> Expr:
    """A term of a sum; a product of matrices is multiplied out."""
    factors = [factor for factor in Mul.make_args(term) if factor != -1]
    if not _of_matrices(term) or any(factor.is_Add for factor in factors):
        return _inner(term)
    value = evaluated(Mul(*factors, evaluate=False))
    if not isinstance(value, sympy.MatrixBase):
        return _inner(term)
    value = value.applyfunc(sympy.expand)
    product = computed(ordered(value[0, 0]) if value.shape == (1, 1) else value)
    return product if len(factors) == len(Mul.make_args(term)) else Mul(-1, product, evaluate=False)


def _of_matrices(term: Expr) -> bool:
    """Whether a term is a product of several matrices."""
    factors = Mul.make_args(term)
    return sum(factor.is_commutative is False and not getattr(factor, "scalar", False) for factor in factors) > 1


def _inner(term: Expr) -> Expr:
    if isinstance(term, Node):
        return term._inner(_worked_out)
    if term.is_Mul:
        sign, *rest = term.args
        if sign == -1 and len(rest) == 1 and rest[0].is_Add and any(map(_of_matrices, rest[0].args)):
            terms = [_term(part) if _of_matrices(part) else _worked_out(part) for part in rest[0].args]
            return Mul(-1, Add(*terms, evaluate=False), evaluate=False)
        worked_out = [(factor, _inner(factor)) for factor in term.args]
        kept = [new for old, new in worked_out if not (new == 1 and is_below(old))]
        factors = _without_ones(_worked_out_above(kept) if kept != list(term.args) else kept)
        if len(factors) == 2 and factors[0] == -1 and evaluated(factors[1]) == 0:  # there is no −0
            return factors[1]
        return Mul._from_args(factors)
    if term.is_Pow and term.args[1] == -1 and term.args[0].is_Mul and term.args[0].has(sympy.factorial):
        return Pow(_inner(term.args[0]), -1, evaluate=False)
    if term.is_Pow and term.args[1] == sympy.S.Half and term.args[0].has(sympy.log):  # nothing gets simpler under it
        return term
    if term.is_Pow and (term.args[1] in (-1, sympy.S.Half) or (term.args[0].is_Add and term.args[1].is_Integer)):
        base = _worked_out(term.args[0])
        return base if base == 1 else Pow(base, term.args[1], evaluate=False)
    return _worked_out(term) if term.is_Add or isinstance(term, sympy.factorial) else term


def _worked_out_above(factors: list[Expr]) -> list[Expr]:
    """The factors of a quotient of numbers; where what is below the line is worked out, so is the product above it."""
    below = [factor for factor in factors if is_below(factor)]
    above = [factor for factor in factors if factor != -1 and not is_below(factor)]
    if not below or len(above) < 2 or not all(_is_rational(factor) for factor in factors):
        return factors
    return [*factors[: factors[0] == -1], computed(evaluated(Mul(*above, evaluate=False))), *below]


def _is_rational(factor: Expr) -> bool:
    return factor.is_commutative is not False and bool(evaluated(factor).is_Rational)


def is_below(factor: Expr) -> bool:
    """Whether a factor stands below the line, or is an inverse."""
    return bool(factor.is_Pow and factor.args[1] == -1)


def _worked_out(expression: Expr) -> Expr:
    value = evaluated(expression)
    if isinstance(value, Expr) and value.is_polynomial(*value.free_symbols):
        value = sympy.expand(value, log=False)
    # What holds exponentials or roots does not get simpler, only reordered.
    if expression.has(VectorLeaf):
        return VectorLeaf(value.applyfunc(sympy.cancel))
    plain = isinstance(value, sympy.MatrixBase) or value.is_rational_function(*value.free_symbols)
    return computed(ordered(value) if value.is_Add else value) if plain else expression
