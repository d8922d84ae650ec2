"""The typeset reading of an expression: sympy to mathematics, in the order in which it was written."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import lru_cache
from math import lcm
from typing import Any

import sympy
from flint import fmpq
from sympy import Expr
from sympy.printing.printer import Printer

from rldrill.problems.exact import PARAMETERS
from rldrill.problems.mathematics import (
    Fence,
    Fraction,
    Glyph,
    Math,
    Root,
    Row,
    Script,
    Tabular,
    listed,
    number,
    operator,
    punctuation,
    row,
    variable,
    word,
)
from rldrill.solutions import surds
from rldrill.solutions.exact import Value, in_one_quotient, ordered, to_sympy
from rldrill.solutions.formula.letters import GLYPHS
from rldrill.solutions.formula.node import Look, Node

_MINUS = operator("−")
_PLUS = operator("+")
_TIMES = operator("·")
_LONG = 10**6
#: From here on a number of a working is written as a decimal that is cut off, with so many of its digits.
_UNREADABLE, _DIGITS = 10**40, 12


class _Typesetter(Printer):
    """Writes an expression as mathematics; nodes write themselves."""

    printmethod = "_typeset"

    def __call__(self, expression: Expr) -> Math:
        """An expression as mathematics; the same parts stand in the steps of a working again and again."""
        return _written(expression)

    def _print_Symbol(self, expression: Any) -> Math:
        return GLYPHS.get(expression) or variable(PARAMETERS.get(expression.name, expression.name))

    def _print_Rational(self, expression: Expr) -> Math:
        """A fraction, unless it is a decimal that is long but ends, or longer than anybody reads."""
        places = 0
        if max(abs(expression.p), expression.q) > _UNREADABLE:
            return _cut_off(int(expression.p), int(expression.q))
        if expression.q > _LONG:
            places = next((places for places in range(7, 15) if 10**places % expression.q == 0), 0)
        if not places:
            return number(expression.p if expression.q == 1 else f"{expression.p}/{expression.q}")
        digits = str(abs(expression.p) * 10**places // expression.q).rjust(places + 1, "0")
        return number(f"{'-' if expression.p < 0 else ''}{digits[:-places]}.{digits[-places:]}")

    def _print_Add(self, expression: Expr) -> Math:
        return _sum(expression.args)

    def _print_Mul(self, expression: Expr) -> Math:
        return typeset_value(expression) if _is_angle(expression) else _product(expression.args)

    def _print_Pow(self, expression: Expr) -> Math:
        return _power(*expression.args)

    def _print_NumberSymbol(self, expression: Expr) -> Math:
        return variable("e" if expression is sympy.E else "π")

    def _print_Abs(self, expression: Expr) -> Math:
        return Fence(typeset(expression.args[0]), "|", "|")

    def _print_exp(self, expression: Expr) -> Math:
        return _power_of_e(alone(expression.args[0]))

    def _print_log(self, expression: Expr) -> Math:
        argument = expression.args[0]
        plain = argument.is_Integer or argument.is_Symbol
        return row(word("ln"), typeset(argument) if plain else Fence(typeset(argument)))

    def _print_factorial(self, expression: Expr) -> Math:
        argument = expression.args[0]
        return row(typeset(argument) if closed(argument) else Fence(typeset(argument)), punctuation("!"))

    def _print_Function(self, expression: Expr) -> Math:
        return row(word(expression.func.__name__), Fence(listed(map(alone, expression.args))))

    def emptyPrinter(self, expression: Expr) -> Math:
        raise TypeError(f"{expression.func.__name__} has no typesetting")


def _cut_off(above: int, below: int) -> Math:
    """The first digits of a quotient, the rest left out: 3.14159265358…"""
    size = (abs(above).bit_length() - below.bit_length()) * 3 // 10
    shift = _DIGITS + 2 - size
    scaled = abs(above) * 10**shift // below if shift >= 0 else abs(above) // (below * 10**-shift)
    digits = str(scaled)
    exponent = len(digits) - 1 - shift
    digits = digits[:_DIGITS]
    if -5 <= exponent < 0:
        written: Math = Glyph(f"0.{'0' * (-exponent - 1)}{digits}…", "number")
    elif 0 <= exponent < _DIGITS - 1:
        written = Glyph(f"{digits[: exponent + 1]}.{digits[exponent + 1 :]}…", "number")
    else:
        power = Script(number(10), above=number(exponent))
        written = row(Glyph(f"{digits[0]}.{digits[1:]}…", "number"), _TIMES, power)
    return row(_MINUS, written) if above < 0 else written


_TYPESETTER = _Typesetter()


@lru_cache(maxsize=4096, typed=True)
def _written(expression: Expr) -> Math:
    return expression._typeset(_TYPESETTER) if isinstance(expression, Node) else _TYPESETTER._print(expression)


def typeset(expression: Expr) -> Math:
    """An expression as mathematics."""
    return _TYPESETTER(expression)


def alone(expression: Expr) -> Math:
    """An expression that stands alone, as between commas: a put-in negative number needs no brackets there."""
    if expression.is_Mul and not isinstance(expression, Node) and not _is_angle(expression):
        return _product(expression.args, leads=True)
    return expression._alone(typeset) if isinstance(expression, Node) else typeset(expression)


def _is_angle(expression: Expr) -> bool:
    """Whether it is a fraction of π."""
    head, *rest = expression.args
    return bool(rest == [sympy.pi] and head.is_Rational and not head.is_Integer)


def look(expression: Expr) -> Look:
    """What an expression looks like among others."""
    if isinstance(expression, Node):
        return expression.look
    if expression.is_Symbol:
        return Look.LETTER
    if expression.is_Number:
        return Look.NUMBER
    return Look.OPEN if isinstance(expression, sympy.log) else Look.OTHER


def closed(expression: Expr) -> bool:
    """Whether something small may stand behind it, as an exponent, without brackets around it."""
    if expression.is_Number:
        return bool(expression.is_Integer and expression >= 0)
    return look(expression) not in (Look.OPEN, Look.OTHER)


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


def typeset_answer(value: Value) -> Math:
    """An answer as mathematics: as a value, but a rational number is written out, however long it is."""
    if isinstance(value, fmpq) and max(abs(value.p), value.q) > _UNREADABLE:
        return number(value)
    return typeset_value(value)


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
            items += [_PLUS, _addend(term)] if position else [_first(term)]
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


def _first(term: Expr) -> Math:
    """What begins a sum; a negative number that was put in needs no brackets there."""
    leads = look(term) is Look.NUMBER or (term.is_Mul and not _negative(term))
    return alone(term) if leads else _addend(term)


def _product(factors: Sequence[Expr], *, leads: bool = False) -> Math:
    """Factors side by side; where they lead, nothing stands before a negative number, which needs no brackets then."""
    flat = [part for factor in factors for part in _parts(factor, sympy.Mul)]
    if flat[0] is sympy.S.NegativeOne and len(flat) > 1:
        return row(_MINUS, _product(flat[1:]))
    scalars = [factor for factor in flat if factor.is_commutative is not False]
    if len(scalars) < len(flat) and any(map(_reciprocal, scalars)):
        rest = [factor for factor in flat if factor.is_commutative is False]
        dot = [_TIMES] if look(rest[0]) is Look.LINE else []
        return row(_product(scalars), *dot, _product(rest))
    if flat[0].is_Number and flat[0].is_negative and len(flat) > 1:
        return row(_MINUS, _product([-flat[0], *flat[1:]]))
    if (together := _under_one_root(flat)) is not None:
        return typeset(together)
    if _is_half_root(flat):  # 3√2/2, not 3/2·√2
        head, *roots = flat
        above = roots if head.p == 1 else [sympy.Integer(head.p), *roots]
        return Fraction(_product(above) if len(above) > 1 else typeset(above[0]), number(head.q))
    below = [factor.args[0] for factor in flat if _reciprocal(factor)]
    if below and all(factor.is_commutative is not False for factor in flat):
        above = [factor for factor in flat if not _reciprocal(factor)]
        numerator = _product(above, leads=True) if len(above) > 1 else alone(above[0]) if above else number(1)
        return Fraction(numerator, _product(below) if len(below) > 1 else typeset(below[0]))
    items: list[Math] = []
    for position, factor in enumerate(flat):
        first = leads and position == 0 and look(factor) is Look.NUMBER and not (len(flat) > 1 and _holds_sum(factor))
        written = alone(factor) if first else _factor(factor, last=position == len(flat) - 1)
        if position and _needs_dot(flat[position - 1], factor):
            items.append(_TIMES)
        items.append(written)
    return row(*items)


def _holds_sum(factor: Expr) -> bool:
    return isinstance(factor, Node) and factor.holds_sum


def _is_half_root(factors: Sequence[Expr]) -> bool:
    """Whether they are a fraction and square roots."""
    head, *rest = factors
    return bool(
        rest
        and head.is_Rational
        and not head.is_Integer
        and all(factor.is_Pow and factor.args[1] == sympy.S.Half for factor in rest)
    )


def _under_one_root(factors: Sequence[Expr]) -> Expr | None:
    """The roots of a whole number and of a logarithm as one: √((ln 7)/2) for 1/2·√2·√(ln 7)."""
    match factors:
        case [*heads, sympy.Pow(args=(under, sympy.S.Half)), sympy.Pow(args=(sympy.log() as log, sympy.S.Half))]:
            pass
        case _:
            return None
    if not under.is_Integer or len(heads) > 1 or not all(head.is_Rational for head in heads):
        return None
    head = sympy.Mul(*heads)
    if head.q % under == 0:
        head, radicand = head * under, sympy.Mul(log, sympy.Pow(under, -1, evaluate=False), evaluate=False)
    else:
        radicand = sympy.Mul(under, log, evaluate=False)
    root = sympy.Pow(radicand, sympy.S.Half, evaluate=False)
    return root if head == 1 else sympy.Mul(head, root, evaluate=False)


def _reciprocal(factor: Expr) -> bool:
    return bool(factor.is_Pow and factor.args[1] is sympy.S.NegativeOne and factor.is_commutative is not False)


def _base(factor: Expr) -> Look:
    return look(factor.args[0] if factor.is_Pow else factor)


def _needs_dot(before: Expr, factor: Expr) -> bool:
    """Numbers are kept apart by a dot; letters stand side by side, as the sheet prints them."""
    first, second = _base(before), _base(factor)
    if Look.GRID in (first, second):
        return first is Look.GRID and second in (Look.NUMBER, Look.SLOT)
    if Look.SLOT in (first, second):
        return True
    if Look.LINE in (first, second):
        return True
    if before.is_Rational and not before.is_Integer:
        return True  # or the letter would seem to stand below the line
    closes = factor is sympy.pi or (factor.is_Pow and factor.args[1] == sympy.S.Half)
    if closes and (before.is_Integer or before is sympy.pi):
        return False
    if second is Look.NUMBER or (before == factor and first is Look.LETTER):
        return True
    if first is Look.NUMBER:
        return second is not Look.LETTER or (isinstance(before, Node) and bool(before.is_commutative))
    return bool(factor.is_Add and before.is_Add)


def _factor(factor: Expr, *, last: bool) -> Math:
    if factor.is_Add or (factor.is_Number and factor.is_negative):
        return Fence(typeset(factor))
    return Fence(typeset(factor)) if look(factor) is Look.OPEN and not last else typeset(factor)


def _power(base: Expr, exponent: Expr) -> Math:
    if exponent == sympy.S.Half:
        return Root(typeset(base))
    if exponent.is_Rational and exponent.is_negative and base.is_commutative is not False:
        rest = base if exponent == -1 else sympy.Pow(base, -exponent, evaluate=False)
        return Fraction(number(1), typeset(rest))
    if isinstance(base, sympy.sin | sympy.cos | sympy.tan) and exponent.is_Integer:
        written = word(base.func.__name__)
        return row(Script(written, above=typeset(exponent)), Fence(alone(base.args[0])))
    return Script(typeset(base) if closed(base) else Fence(typeset(base)), above=typeset(exponent))


def vector(entries: Iterable[Value]) -> Math:
    """A vector of values as mathematics, on one line."""
    return Fence(listed(map(typeset_value, entries)))


def tabular(lines: Sequence[Sequence[Value]], write: Callable[[Value], Math] = typeset_value) -> Tabular:
    """A matrix of values as mathematics."""
    return Tabular(tuple(tuple(map(write, line)) for line in lines))


def _power_of_e(exponent: Math) -> Math:
    if _has_tall_fraction(exponent):  # too small to read as an exponent
        return row(word("exp"), Fence(exponent))
    return Script(variable("e"), above=exponent)


def _has_tall_fraction(math: Math) -> bool:
    if isinstance(math, Fraction):
        return not (isinstance(math.numerator, Glyph) and isinstance(math.denominator, Glyph))
    return isinstance(math, Row) and any(map(_has_tall_fraction, math.items))
