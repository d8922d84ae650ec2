"""The typeset reading of an expression: sympy to mathematics, in the order in which it was written."""

from collections.abc import Iterable, Iterator, Sequence
from math import lcm
from typing import Any

import sympy
from sympy import Expr

from rldrill.problems.exact import PARAMETERS
from rldrill.problems.mathematics import (
    Big,
    Fence,
    Fraction,
    Glyph,
    Math,
    Root,
    Row,
    Script,
    Tabular,
    listed,
    name,
    number,
    operator,
    punctuation,
    relation,
    row,
    variable,
    word,
)
from rldrill.solutions import surds
from rldrill.solutions.exact import Value, in_one_quotient, ordered, to_sympy
from rldrill.solutions.formula.notation import (
    GLYPHS,
    ArgMaxOver,
    Blocks,
    Cases,
    Clipped,
    Counting,
    Expected,
    Greatest,
    Indicator,
    IntegralOver,
    Least,
    MatrixLeaf,
    MaxOf,
    MaxOver,
    MeanOver,
    Member,
    Negative,
    Over,
    ProductOver,
    PutInName,
    Quantity,
    SampleMean,
    Size,
    SumOver,
    Transposed,
    VectorLeaf,
)

_MINUS = operator("−")
_PLUS = operator("+")
_TIMES = operator("·")
_LONG = 10**6


def typeset(expression: Expr) -> Math:
    """An expression as mathematics."""
    if isinstance(expression, Quantity):
        return expression.layout(*map(typeset, expression.args))
    if isinstance(expression, PutInName):
        return name(expression.name)
    if expression.is_Symbol:
        return GLYPHS.get(expression) or variable(PARAMETERS.get(expression.name, expression.name))
    if expression.is_Rational:
        return _rational(expression)
    if expression.is_Add:
        return _sum(expression.args)
    if expression.is_Mul:
        head, *rest = expression.args
        return (
            typeset_value(expression)
            if rest == [sympy.pi] and head.is_Rational and not head.is_Integer
            else _product(expression.args)
        )
    if expression.is_Pow:
        return _power(*expression.args)
    for kind, writer in _WRITERS.items():
        if isinstance(expression, kind):
            return writer(expression)
    if expression is sympy.E:
        return variable("e")
    if expression is sympy.pi:
        return variable("π")
    if expression.is_Function:
        return row(
            word(expression.func.__name__), Fence(listed(typeset(_bare(argument)) for argument in expression.args))
        )
    raise TypeError(f"{expression.func.__name__} has no typesetting")


def _rational(value: Expr) -> Math:
    """A fraction, unless it is a decimal that is long but ends."""
    places = 0
    if value.q > _LONG:
        places = next((places for places in range(7, 15) if 10**places % value.q == 0), 0)
    if not places:
        return number(value)
    digits = str(abs(value.p) * 10**places // value.q).rjust(places + 1, "0")
    return number(f"{'-' if value.p < 0 else ''}{digits[:-places]}.{digits[-places:]}")


def typeset_value(value: Value) -> Math:
    """A computed value as mathematics: sympy's own order, since it is a result and not a formula."""
    surd = surds.read(value) if isinstance(value, sympy.Expr) and not value.is_Rational else None
    if surd:
        return _surd(surd)
    expression = ordered(in_one_quotient(to_sympy(value)))
    if expression.is_Add:
        return _sum(expression.args)
    if isinstance(expression, sympy.exp):
        return _power_of_e(typeset_value(expression.args[0]))
    numerator, denominator = _quotient(expression)
    if numerator.is_Rational and denominator != 1:  # −25/(2σ²), no fraction above the line
        numerator, denominator = sympy.Integer(numerator.p), numerator.q * denominator
    if denominator != 1 and not expression.is_Rational:
        if _negative(first_term(denominator)):  # (9 − 3p)/(1 − p), not (−9 + 3p)/(−1 + p)
            numerator, denominator = sympy.expand(-numerator), sympy.expand(-denominator)
        minus = _negative(first_term(numerator)) and not numerator.is_Add
        quotient = Fraction(typeset_value(-numerator if minus else numerator), typeset_value(denominator))
        return row(_MINUS, quotient) if minus else quotient
    return typeset(expression)


def _surd(surd: surds.Surd) -> Math:
    """A sum of roots over one common denominator: (1 + √5)/2."""
    below = lcm(*(int(coefficient.q) for coefficient in surd.values()))
    minus = max(surd.values()) < 0 and (below > 1 or len(surd) == 1)
    scale = -below if minus else below
    above = ordered(to_sympy(surds.write({term: coefficient * scale for term, coefficient in surd.items()})))
    written = _product(above.args) if above.is_Mul else typeset(above)
    if below > 1:
        written = Fraction(written, number(below))
    return row(_MINUS, written) if minus else written


def _quotient(expression: Expr) -> tuple[Expr, Expr]:
    """What stands above and below the line; a small power of e stays above: e^(−3/4), not 1/e^(3/4)."""
    below = [f for f in sympy.Mul.make_args(expression) if f.is_Pow and f.base is not sympy.E and f.exp.is_negative]
    denominator = sympy.Mul(*(1 / factor for factor in below))
    return expression * denominator, denominator


def first_term(expression: Expr) -> Expr:
    """The term that is written first."""
    written = ordered(expression)
    return written.args[0] if written.is_Add else written


def _negative(term: Expr) -> bool:
    """Whether a term is subtracted: −1 times something, or a number below zero."""
    first = term.args[0] if term.is_Mul else term
    return bool(first.is_Number and first.is_negative)


def _opposite(term: Expr) -> Expr:
    if term.is_Number:
        return -term
    first, *rest = term.args
    factors = rest if first == -1 else [-first, *rest]
    return factors[0] if len(factors) == 1 else sympy.Mul(*factors, evaluate=False)


def _sum(terms: Sequence[Expr]) -> Math:
    items: list[Math] = []
    flat = [part for term in terms for part in _parts(term, sympy.Add)]
    for position, term in enumerate(flat):
        if _negative(term):
            items += [_MINUS, _addend(_opposite(term))]
        else:
            items += [_PLUS, _addend(term)] if position else [_addend(term)]
    return row(*items)


def _parts(expression: Expr, kind: type[Expr]) -> Iterator[Expr]:
    """The terms of a sum or the factors of a product; what is nested to the left needs no brackets."""
    if expression.func is kind:
        for argument in expression.args:
            yield from _parts(argument, kind)
    else:
        yield expression


def _addend(term: Expr) -> Math:
    return Fence(typeset(term)) if term.is_Add or _negative(term) else typeset(term)


def _product(factors: Sequence[Expr]) -> Math:
    flat = [part for factor in factors for part in _parts(factor, sympy.Mul)]
    if flat[0] == -1 and len(flat) > 1:
        return row(_MINUS, _product(flat[1:]))
    scalars = [factor for factor in flat if factor.is_commutative is not False]
    if len(scalars) < len(flat) and any(map(_reciprocal, scalars)):
        rest = [factor for factor in flat if factor.is_commutative is False]
        dot = [_TIMES] if isinstance(rest[0], VectorLeaf) else []
        return row(_product(scalars), *dot, _product(rest))
    if flat[0].is_Number and flat[0].is_negative and len(flat) > 1:
        return row(_MINUS, _product([-flat[0], *flat[1:]]))
    below = [factor.args[0] for factor in flat if _reciprocal(factor)]
    if below and all(factor.is_commutative is not False for factor in flat):
        above = [factor for factor in flat if not _reciprocal(factor)]
        numerator = _product(above) if len(above) > 1 else typeset(above[0]) if above else number(1)
        return Fraction(numerator, _product(below) if len(below) > 1 else typeset(below[0]))
    items: list[Math] = []
    for position, factor in enumerate(flat):
        written = _factor(factor, last=position == len(flat) - 1)
        if position and _needs_dot(flat[position - 1], factor):
            items.append(_TIMES)
        items.append(written)
    return row(*items)


def _reciprocal(factor: Expr) -> bool:
    return bool(factor.is_Pow and factor.args[1] == -1 and factor.is_commutative is not False)


def _numeric(factor: Expr) -> bool:
    base = factor.args[0] if factor.is_Pow else factor
    return bool(base.is_Number or isinstance(base, Negative) or (isinstance(base, MatrixLeaf) and base.scalar))


def _is_grid(factor: Expr) -> bool:
    base = factor.args[0] if factor.is_Pow or isinstance(factor, Transposed) else factor
    return isinstance(base, MatrixLeaf) and not isinstance(base, VectorLeaf) and not base.scalar


def _needs_dot(before: Expr, factor: Expr) -> bool:
    """Numbers are kept apart by a dot; letters stand side by side, as the sheet prints them."""
    if _is_grid(before) or _is_grid(factor):
        return _is_grid(before) and _numeric(factor)
    if isinstance(before, VectorLeaf) or isinstance(factor, VectorLeaf):
        return True
    if before.is_Rational and not before.is_Integer:
        return True  # or the letter would seem to stand below the line
    closed = factor is sympy.pi or (factor.is_Pow and factor.args[1] == sympy.S.Half)
    if closed and (before.is_Integer or before is sympy.pi):
        return False
    plain = bool(before.is_Symbol or isinstance(before, Quantity))
    if _numeric(factor):
        return True
    if _numeric(before):
        letter = factor.args[0] if factor.is_Pow else factor
        return not (letter.is_Symbol or isinstance(letter, Quantity))
    return not plain and factor.is_Add and before.is_Add


def _factor(factor: Expr, *, last: bool) -> Math:
    if factor.is_Add or (factor.is_Number and factor.is_negative):
        return Fence(typeset(factor))
    if isinstance(factor, SumOver | ProductOver | MaxOver | sympy.log) and not last:
        return Fence(typeset(factor))
    return typeset(factor)


def _power(base: Expr, exponent: Expr) -> Math:
    if exponent == sympy.S.Half:
        return Root(typeset(base))
    if exponent.is_Rational and exponent.is_negative and base.is_commutative is not False:
        rest = base if exponent == -1 else sympy.Pow(base, -exponent, evaluate=False)
        return Fraction(number(1), typeset(rest))
    if isinstance(base, sympy.sin | sympy.cos | sympy.tan) and exponent.is_Integer:
        written = word(base.func.__name__)
        return row(Script(written, above=typeset(exponent)), Fence(typeset(_bare(base.args[0]))))
    simple = base.is_Symbol or isinstance(base, Quantity | MatrixLeaf | Negative) or (base.is_Integer and base >= 0)
    return Script(typeset(base) if simple else Fence(typeset(base)), above=typeset(exponent))


def _limits(expression: Over) -> tuple[Math, Math | None]:
    if isinstance(expression.domain, Counting):
        first, _, shown = expression.domain.args
        return row(typeset(expression.index), relation("="), typeset(first)), typeset(shown)
    return typeset(expression.index), None


def _body(expression: Expr) -> Math:
    return Fence(typeset(expression)) if expression.is_Add else typeset(expression)


def _over(expression: Over) -> Math:
    signs = {SumOver: "Σ", ProductOver: "Π", MaxOver: "max", ArgMaxOver: "arg max", MeanOver: "mean"}
    body = expression.body
    if isinstance(expression, SampleMean):
        return row(operator("𝔼"), Fence(typeset(body), "[", "]"))
    if isinstance(expression, IntegralOver):
        return row(Big("∫"), _body(body), variable("d"), typeset(expression.index))
    if isinstance(expression, ArgMaxOver) and isinstance(body, MaxOf):
        return row(Big("arg max", typeset(expression.index)), _braces(body.args))
    below, above = _limits(expression)
    return row(Big(signs[expression.func], below, above), _body(body))


def _braces(values: Sequence[Expr]) -> Math:
    return Fence(listed((typeset(_bare(value)) for value in values), ";"), "{", "}")


def _bare(expression: Expr) -> Expr:
    """A put-in negative number that stands alone needs no brackets."""
    return expression.args[0] if isinstance(expression, Negative) else expression


def _max_of(expression: MaxOf) -> Math:
    return row(word("max"), _braces(expression.args))


def _indicator(expression: Indicator) -> Math:
    return row(Glyph("1", "number"), Fence(_condition(expression)))


def _condition(expression: Expr) -> Math:
    sign = relation("∈" if isinstance(expression, Member) else "=")
    sides = [typeset(argument) for argument in expression.args]
    return listed(row(left, sign, right) for left, right in zip(sides[::2], sides[1::2], strict=True))


def _cases(expression: Cases) -> Math:
    condition, then, otherwise = expression.args
    lines = (typeset(then), row(word("if"), _condition(condition))), (typeset(otherwise), word("otherwise"))
    return Tabular(lines, "{", "")


def _size(expression: Size) -> Math:
    return Fence(typeset(expression.args[0]), "|", "|")


def _transposed(expression: Transposed) -> Math:
    body = expression.args[0]
    simple = body.is_Symbol or isinstance(body, Quantity | MatrixLeaf)
    written = typeset(body) if simple else Fence(typeset(body))
    if isinstance(written, Script) and written.above is None:
        return Script(written.body, written.below, word("T"))
    return Script(written, above=word("T"))


def _matrix(expression: MatrixLeaf) -> Math:
    matrix = expression.args[0]
    if expression.scalar:
        entry = matrix[0]
        return Fence(typeset_value(entry)) if entry.is_negative or entry.is_Add else typeset_value(entry)
    return tabular([[matrix[line, column] for column in range(matrix.cols)] for line in range(matrix.rows)])


def _blocks(expression: Blocks) -> Math:
    rows, *blocks = expression.args
    width = len(blocks) // int(rows)
    written = [
        typeset_value(block.args[0][0]) if isinstance(block, MatrixLeaf) and block.scalar else typeset(_bare(block))
        for block in blocks
    ]
    return Tabular(tuple(tuple(written[start : start + width]) for start in range(0, len(written), width)))


def vector(entries: Iterable[Value]) -> Math:
    """A vector of values as mathematics, on one line."""
    return Fence(listed(map(typeset_value, entries)))


def tabular(lines: Sequence[Sequence[Value]]) -> Tabular:
    """A matrix of values as mathematics."""
    return Tabular(tuple(tuple(typeset_value(value) for value in line) for line in lines))


def _exponential(expression: Any) -> Math:
    return _power_of_e(typeset(_bare(expression.args[0])))


def _power_of_e(exponent: Math) -> Math:
    if _has_tall_fraction(exponent):  # too small to read as an exponent
        return row(word("exp"), Fence(exponent))
    return Script(variable("e"), above=exponent)


def _has_tall_fraction(math: Math) -> bool:
    if isinstance(math, Fraction):
        return not (isinstance(math.numerator, Glyph) and isinstance(math.denominator, Glyph))
    return isinstance(math, Row) and any(map(_has_tall_fraction, math.items))


def _logarithm(expression: Any) -> Math:
    argument = expression.args[0]
    if argument.is_Integer or argument.is_Symbol:
        return row(word("ln"), typeset(argument))
    return row(word("ln"), Fence(typeset(argument)))


def _picked(expression: Expr) -> Math:
    name_ = {Greatest: "max", Least: "min", Clipped: "clip"}[expression.func]
    return row(word(name_), Fence(listed(typeset(_bare(argument)) for argument in expression.args)))


def _expected(expression: Expected) -> Math:
    return row(Script(variable("𝔼"), variable("π")), Fence(typeset(expression.args[0]), "[", "]"))


def _factorial(expression: Any) -> Math:
    argument = expression.args[0]
    plain = argument.is_Symbol or (argument.is_Integer and argument >= 0)
    written = typeset(argument)
    return row(written if plain else Fence(written), punctuation("!"))


_WRITERS: dict[type, Any] = {
    Over: _over,
    MaxOf: _max_of,
    Greatest: _picked,
    Least: _picked,
    Clipped: _picked,
    Expected: _expected,
    Indicator: _indicator,
    Member: _condition,
    Cases: _cases,
    Size: _size,
    Transposed: _transposed,
    VectorLeaf: lambda expression: vector(expression.args[0]),
    MatrixLeaf: _matrix,
    Blocks: _blocks,
    Negative: lambda expression: Fence(typeset_value(expression.args[0])),
    sympy.Abs: lambda expression: Fence(typeset(expression.args[0]), "|", "|"),
    sympy.exp: _exponential,
    sympy.log: _logarithm,
    sympy.factorial: _factorial,
}
