"""The edited reading of a formula: one thing in it changed, as somebody changes it who errs.

Edits know no formula: they are found in the expression itself, so that every formula has its own. An edit that stands
inside of a sum or maximum can also be made for one of its terms only: it then depends on what the letters ``at_1``,
``at_2`` … are, the element of the outermost set first.
"""

from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from itertools import combinations, pairwise, product

import sympy
from msgspec import Struct
from sympy import Add, Expr, Mul, Pow

from rldrill.solutions.formula.node import Node
from rldrill.solutions.formula.nodes.conditions import Condition
from rldrill.solutions.formula.nodes.sets import ArgMaxOver, Over, ProductOver, Size
from rldrill.solutions.formula.notation import (
    Cases,
    Clipped,
    Counting,
    Greatest,
    Indicator,
    Least,
    MaxOver,
    MeanOver,
    Quantity,
    SampleMean,
    SumOver,
    Transposed,
)

#: Letters that count, so that they can be one off.
COUNTING = frozenset("tnkiTj")
#: Letters that are easily taken for one another.
TWINS = {"s": "s1", "s1": "s", "a": "a1", "a1": "a", "h": "h1", "h1": "h"}
#: Edits that are made in one term of a sum, or for one element of a set, or not at all.
IN_ONE_TERM = frozenset(("other-taken", "summand-left-out", "summand-sign", "factor-for-one", "factor-for-all"))
#: What a place is multiplied with, and what is added to it, when its value is another one.
SCALE, SHIFT = sympy.Symbol("scale_"), sympy.Symbol("shift_")


class Edit(Struct, frozen=True):
    """One thing changed in a formula.

    Args:
        kind: what was done, a name such as ``term-left-out``.
        right: the right side that comes out.
        part: what was changed.
        instead: what stands in its place, where anything does.
        within: the sums and maxima that it stands in, the outermost first.
        once: the right side that has the change in one of their terms only; None where it stands in none.
    """

    kind: str
    right: Expr
    part: Expr
    instead: Expr | None = None
    within: tuple[Over, ...] = ()
    once: Expr | None = None


class Probe(Struct, frozen=True):
    """A place of a formula whose value can be another one: ``right`` depends on ``scale_`` and ``shift_``."""

    part: Expr
    right: Expr
    within: tuple[Over, ...] = ()


Change = tuple[str, Expr, Expr, Expr | None]  # kind, the new part, what was changed, what stands there


def element(depth: int) -> str:
    """The letter for the term of the sum, counted from the outermost, that an edit is made in."""
    return f"at_{depth + 1}"


@cache
def edits(right: Expr) -> tuple[Edit, ...]:
    """All edits of a right side, each of them once."""
    found: dict[Expr, Edit] = {}
    right = flat(right)
    for path, part, within in _places(right):
        for kind, over, new in _in_one_term(part, sympy.Symbol(element(len(within)))):
            once = _replaced(right, path, Cases(_here(within), new, part) if within else new)
            found[once] = Edit(kind, right, part, None, (*within, over), once)
        for kind, new, changed, instead in _changes(part):
            edited = _replaced(right, path, new)
            if edited in found:
                continue
            once = _replaced(right, path, Cases(_here(within), new, part)) if within else None
            found[edited] = Edit(kind, edited, changed, instead, within, once)
    for kind, edited, changed, instead in _exchanged(right):
        if edited not in found:
            found[edited] = Edit(kind, edited, changed, instead)
    return tuple(found.values())


def _in_one_term(part: Expr, at: sympy.Symbol) -> Iterator[tuple[str, Over, Expr]]:
    """What is done to one element of a set alone, and the part that comes out: which one depends on the application."""
    if isinstance(part, MaxOver):  # not the greatest is taken, but that of a certain element
        yield "other-taken", part, _with(part.body, {part.index: at})
    elif isinstance(part, SumOver):
        body = part.body
        yield "summand-left-out", part, _but_one(part, at, Mul(sympy.S.Zero, body, evaluate=False))
        yield "summand-sign", part, _but_one(part, at, _opposite(body))
        if body.is_Mul and all(factor.is_commutative is not False for factor in body.args):
            for last in range(1, len(body.args)):
                factors = [_with(factor, {part.index: at}) for factor in body.args[:last]]
                yield "factor-for-all", part, _product([*factors, _but_one(part, at, _product(body.args[last:]))])
    elif part.is_Mul:
        for place, over in enumerate(part.args):
            if isinstance(over, SumOver):
                before, behind = part.args[:place], part.args[place + 1 :]
                yield "factor-for-one", over, _but_one(over, at, _product([*before, over.body, *behind]))


def _but_one(over: Over, at: sympy.Symbol, instead: Expr) -> Over:
    """A sum with another term for one of its elements."""
    return over.func(Cases(Indicator(over.index, at), instead, over.body), over.index, over.domain)


@cache
def probes(right: Expr) -> tuple[Probe, ...]:
    """All places of a right side whose value can be another one, the whole left out."""
    found = []
    right = flat(right)
    for path, part, within in _places(right):
        if not path or part.is_commutative is False or part.is_Number:
            continue
        if isinstance(part, Over | Condition) and not isinstance(part, SumOver):
            continue
        other = Add(Mul(part, SCALE, evaluate=False), SHIFT, evaluate=False)
        changed = Cases(_here(within), other, part) if within else other
        found.append(Probe(part, _replaced(right, path, changed), within))
    return tuple(found)


def flat(expression: Expr) -> Expr:
    """The same, sums and products that begin with one of their kind as one: what needs no brackets on paper."""
    if not expression.args or isinstance(expression, Quantity | Counting):
        return expression
    arguments = [flat(argument) for argument in expression.args]
    if (expression.is_Add or expression.is_Mul) and arguments[0].func is expression.func:
        arguments = [*arguments[0].args, *arguments[1:]]
    return _like(expression, arguments)


def _here(within: Sequence[Over]) -> Indicator:
    pairs = ((over.index, sympy.Symbol(element(depth))) for depth, over in enumerate(within))
    return Indicator(*(side for pair in pairs for side in pair))


def _places(
    expression: Expr, path: tuple[int, ...] = (), within: tuple[Over, ...] = ()
) -> Iterator[tuple[tuple[int, ...], Expr, tuple[Over, ...]]]:
    """Every part of an expression, the whole first: the way to it, the part, the sums that it stands in."""
    yield path, expression, within
    if isinstance(expression, Condition | Size | Counting | Quantity):
        return
    inside = (*within, expression) if isinstance(expression, Over) else within
    for number, argument in enumerate(expression.args):
        if expression.is_Pow and number == 1:
            continue
        if isinstance(expression, Over) and number > 0:
            if isinstance(argument, Counting):
                yield (*path, number), argument, within
            continue
        yield from _places(argument, (*path, number), inside)


def _replaced(expression: Expr, path: Sequence[int], new: Expr) -> Expr:
    if not path:
        return new
    arguments = list(expression.args)
    arguments[path[0]] = _replaced(arguments[path[0]], path[1:], new)
    return _like(expression, arguments)


def _like(expression: Expr, arguments: Sequence[Expr]) -> Expr:
    if isinstance(expression, Node):
        return expression.func(*arguments)
    return expression.func(*arguments, evaluate=False)


def _sum(terms: Sequence[Expr]) -> Expr:
    return terms[0] if len(terms) == 1 else Add(*terms, evaluate=False)


def _product(factors: Sequence[Expr]) -> Expr:
    return factors[0] if len(factors) == 1 else Mul(*factors, evaluate=False)


def _opposite(term: Expr) -> Expr:
    """A term with the other sign; a leading −1 is taken away."""
    if term.is_Number:
        return -term
    if term.is_Mul and term.args[0] == -1:
        return _product(term.args[1:])
    return Mul(sympy.S.NegativeOne, term, evaluate=False)


def _unsigned(term: Expr) -> Expr:
    return _product(term.args[1:]) if term.is_Mul and term.args[0] == -1 else term


def _others(items: Sequence[Expr], place: int) -> list[Expr]:
    return [*items[:place], *items[place + 1 :]]


def _changes(part: Expr) -> Iterator[Change]:
    """What can be done to one part of a formula."""
    if part.is_Add:
        yield from _of_sum(part)
    elif part.is_Mul:
        yield from _of_product(part)
    elif part.is_Pow:
        yield from _of_power(part)
    elif isinstance(part, Quantity):
        yield from _of_quantity(part)
    elif isinstance(part, Over):
        yield from _of_set(part)
    elif isinstance(part, Counting):
        first, last, _ = part.args
        yield "range", Counting(first, Add(last, 1, evaluate=False)), part, None
        yield "range", Counting(first, Add(last, -1, evaluate=False)), part, None
        yield "range", Counting(Add(first, 1, evaluate=False), last), part, None
    elif isinstance(part, Transposed):
        yield "transposed", part.args[0], part, part.args[0]
    elif isinstance(part, Cases):
        _, then, otherwise = part.args
        yield "case", then, part, then
        yield "case", otherwise, part, otherwise
    elif isinstance(part, Indicator):
        yield "case", sympy.S.One, part, sympy.S.One
        yield "case", sympy.S.Zero, part, sympy.S.Zero
    elif isinstance(part, Clipped | Greatest | Least):
        yield from _of_choice(part)
    elif isinstance(part, sympy.exp | sympy.log | sympy.Abs):
        yield "function", part.args[0], part, part.args[0]
    elif isinstance(part, sympy.sin | sympy.cos):
        other = (sympy.cos if isinstance(part, sympy.sin) else sympy.sin)(part.args[0], evaluate=False)
        yield "function", other, part, other


def _of_sum(part: Expr) -> Iterator[Change]:
    terms = part.args
    for place, term in enumerate(terms):
        rest = _others(terms, place)
        yield "term-left-out", _sum(rest), _unsigned(term), None
        yield "sign", _sum([*terms[:place], _opposite(term), *terms[place + 1 :]]), _unsigned(term), None
        yield "twice", _sum([*terms, term]), term, None
    if len(terms) == 2:
        yield "difference", _opposite(part), part, None
        if terms[0] == 1 and terms[1].is_Mul and terms[1].args[0] == -1:
            yield "complement", _unsigned(terms[1]), part, _unsigned(terms[1])
        if (whole := _power_of_sum(*terms)) is not None:
            yield "power-of-sum", whole, part, whole
    yield from _of_two_terms(terms)
    for place, term in enumerate(terms):
        factors = term.args
        if not term.is_Mul or factors[0] == -1:
            continue
        # r + γV read as γ(r + V): the bracket begins too early
        for last, factor in enumerate(factors[:-1]):
            before, behind = factors[: last + 1], factors[last + 1 :]
            if factor.is_commutative is False:
                break
            for other, neighbour in enumerate(terms):
                if other == place:
                    continue
                rest = [each for number, each in enumerate(terms) if number not in (place, other)]
                inside = Mul(*before, Add(neighbour, _product(behind), evaluate=False), evaluate=False)
                yield "bracket", _sum([*rest, inside]), part, None
            if len(terms) > 2:
                whole = Mul(*before, Add(*_others(terms, place), _product(behind), evaluate=False), evaluate=False)
                yield "bracket", whole, part, None


def _of_two_terms(terms: Sequence[Expr]) -> Iterator[Change]:
    """Two terms of a sum that are taken for one another: the factor of one stands at the other; or two arguments do."""
    for place, (one, two) in enumerate(pairwise(terms)):
        for first, second in ((one, two), (two, one)):
            for factor, rest in _factors(second):
                if isinstance(first, Quantity | Over) and _is_plain(rest):
                    pair = _product([factor, first]), rest
                    instead = _sum(pair if first is one else pair[::-1])
                    was = _sum([one, two])
                    yield "factor-moved", _sum([*terms[:place], *instead.args, *terms[place + 2 :]]), was, instead
    for one, two in combinations(range(len(terms)), 2):
        for here, there in product(_quantities(terms[one]), _quantities(terms[two])):
            if here.func is not there.func or here.args == there.args:
                continue
            changed = list(terms)
            changed[one], changed[two] = _with(terms[one], {here: there}), _with(terms[two], {there: here})
            yield "arguments-exchanged", _sum(changed), here, there
            for place, (mine, its) in enumerate(zip(here.args, there.args, strict=True)):
                if len(here.args) > 1 and mine != its and mine.is_Symbol and its.is_Symbol:
                    for number, part, argument in ((one, here, its), (two, there, mine)):
                        twin = _with_argument(part, place, argument)
                        other = _with(terms[number], {part: twin})
                        yield "other-table", _sum([*terms[:number], other, *terms[number + 1 :]]), part, twin


def _factors(term: Expr) -> Iterator[tuple[Expr, Expr]]:
    """The letters that multiply a term, and the term without each; of a power the letter moves, and the power goes."""
    for place, factor in enumerate(term.args if term.is_Mul else ()):
        letter = factor.args[0] if factor.is_Pow else factor
        if letter.is_Symbol and letter.is_commutative:
            yield letter, _product(_others(term.args, place))


def _is_plain(term: Expr) -> bool:
    """Whether a term is added, and no bracket."""
    return term.is_commutative and not any(factor.is_Add or factor.is_Number for factor in Mul.make_args(term))


def _quantities(term: Expr) -> list[Quantity]:
    """The quantities that a term is the product of."""
    return [factor for factor in Mul.make_args(term) if isinstance(factor, Quantity)]


def _power_of_sum(one: Expr, other: Expr) -> Expr | None:
    """(1 − γ)ⁿ for 1 − γⁿ, or (a + b)² for a² + b²; None of what are no two such powers."""
    bare = _unsigned(other)
    if not bare.is_Pow or bare.args[1] == -1 or not bare.is_commutative:
        return None
    base, exponent = bare.args
    if one != 1 and not (one.is_Pow and one.args[1] == exponent):
        return None
    first = one if one == 1 else one.args[0]
    return Pow(_sum([first, base if bare is other else _opposite(base)]), exponent, evaluate=False)


def _of_product(part: Expr) -> Iterator[Change]:
    factors = part.args
    scalar = [factor.is_commutative is not False for factor in factors]
    for place, factor in enumerate(factors):
        if factor == -1:
            yield "sign", _product(_others(factors, place)), _unsigned(part), None
            continue
        kind = "bracket-left-out" if factor.is_Add or isinstance(factor, Over) else "factor-left-out"
        if factors[0] == -1 and len(factors) == 2:
            kind = "only-factor-left-out"  # −V read as −1
        yield kind, _product(_others(factors, place)), factor, None
        if scalar[place]:
            if not factor.is_Pow and not factor.is_Add:
                kind = "squared" if factor.is_Symbol else "squared-value"
                yield kind, _product([*factors, factor]), factor, None
            if factor.is_Symbol or isinstance(factor, Quantity):
                other = Add(sympy.S.One, Mul(sympy.S.NegativeOne, factor, evaluate=False), evaluate=False)
                changed = _product([*factors[:place], other, *factors[place + 1 :]])
                yield "complement" if factor.is_Symbol else "complement-of-value", changed, factor, other
            if factor.is_Symbol or isinstance(factor, Quantity):
                added = Add(factor, _product(_others(factors, place)), evaluate=False)
                yield "added", added, part, None
            if factor.is_Symbol and len(factors) > 1:  # divided instead of multiplied
                inverse = Pow(factor, sympy.S.NegativeOne, evaluate=False)
                yield "divided", _product([*factors[:place], inverse, *factors[place + 1 :]]), factor, None
        if factor.is_Add:
            outside = _others(factors, place)
            for last in range(1, len(factor.args)):
                inner, outer = factor.args[:last], factor.args[last:]
                yield "bracket", _sum([_product([*outside, _sum(inner)]), *outer]), part, None
            if len(factor.args) > 2:
                for inner in factor.args[1:]:
                    rest = [each for each in factor.args if each is not inner]
                    yield "bracket", _sum([_product([*outside, _sum(rest)]), inner]), part, None
        if isinstance(factor, SumOver) and factor.body.is_Mul and all(scalar):  # π Σ P(r + γV) as Σ (πPr + γV)
            for inside, bracket in enumerate(factor.body.args):
                if bracket.is_Add:
                    others = [*_others(factors, place), *_others(factor.body.args, inside)]
                    first, *rest = bracket.args
                    body = _sum([_product([*others, first]), *rest])
                    yield "bracket", factor.func(body, factor.index, factor.domain), part, None
    if any(factor.is_Pow and factor.args[1] == -1 for factor in factors) and all(scalar):
        yield "upside-down", Pow(part, sympy.S.NegativeOne, evaluate=False), part, None
    for place in range(len(factors) - 1):
        if not scalar[place] and not scalar[place + 1]:
            swapped = [*factors[:place], factors[place + 1], factors[place], *factors[place + 2 :]]
            yield "order-of-factors", _product(swapped), part, None


def _of_power(part: Expr) -> Iterator[Change]:
    base, exponent = part.args
    if exponent == -1:
        yield "inverse", base, part, base
        return
    if base.is_Add and len(base.args) == 2 and base.is_commutative:
        one, other = base.args
        powers = [each if each == 1 else Pow(each, exponent, evaluate=False) for each in (one, _unsigned(other))]
        second = powers[1] if _unsigned(other) is other else _opposite(powers[1])
        split = _sum([powers[0], second])
        yield "power-of-terms", split, part, split
    if exponent == sympy.S.Half:
        yield "root", base, part, base
        return
    yield "power", Pow(base, Add(exponent, 1, evaluate=False), evaluate=False), part, None
    yield "power", Pow(base, Add(exponent, -1, evaluate=False), evaluate=False), part, None
    yield "power", base, part, base
    yield "power-as-product", Mul(base, exponent, evaluate=False), part, None
    if exponent != 2:
        yield "power", Pow(base, sympy.Integer(2), evaluate=False), part, None


def _of_quantity(part: Quantity) -> Iterator[Change]:
    for place, argument in enumerate(part.args):
        letters = {symbol.name for symbol in argument.free_symbols}
        if letters and letters <= COUNTING and not isinstance(argument, Node):
            for step in (1, -1):
                index = _counted(argument, step)
                other = _with_argument(part, place, index)
                yield "index", other, part, other
        if argument.is_Symbol and argument.name in TWINS:
            twin = sympy.Symbol(TWINS[argument.name])
            if twin not in part.args:  # nobody reads P for going from a state to itself
                other = _with_argument(part, place, twin)
                yield "twin", other, part, other
        if isinstance(argument, Quantity):
            for kind, inner, _, _ in _of_quantity(argument):
                other = _with_argument(part, place, inner)
                yield kind, other, part, other


def _with_argument(part: Quantity, place: int, argument: Expr) -> Expr:
    return part.func(*part.args[:place], argument, *part.args[place + 1 :])


def _counted(index: Expr, step: int) -> Expr:
    """An index one further or one back, its letters in their order: t + 2, n − 1."""
    terms = [inner for term in Add.make_args(index) for inner in Add.make_args(term)]
    letters = [term for term in terms if not term.is_Number]
    number = sum(term for term in terms if term.is_Number) + step
    return _sum([*letters, sympy.Integer(number)] if number else letters)


def _of_set(part: Over) -> Iterator[Change]:
    smallest = _opposite(MaxOver(_opposite(part.body), part.index, part.domain))
    others: Mapping[str, Expr] = {
        "max": MaxOver(*part.args),
        "min": smallest,
        "mean": MeanOver(*part.args),
        "sum": SumOver(*part.args),
    }
    if isinstance(part, ArgMaxOver):
        yield "smallest", ArgMaxOver(_opposite(part.body), part.index, part.domain), part, None
        return
    mine = {MaxOver: "max", MeanOver: "mean", SampleMean: "mean", SumOver: "sum", ProductOver: "product"}
    for name, other in others.items():
        if name != mine.get(type(part)):
            yield f"{name}-for-{mine.get(type(part), 'sum')}", other, part, other


def _of_choice(part: Node) -> Iterator[Change]:
    for argument in part.args if not isinstance(part, Clipped) else part.args[:1]:
        yield "choice", argument, part, argument
    if isinstance(part, Greatest | Least):
        other = (Least if isinstance(part, Greatest) else Greatest)(*part.args)
        yield "choice", other, part, other


def _exchanged(right: Expr) -> Iterator[Change]:
    """Two letters in each other's place, or one in the place of another; the sine and the cosine of an angle."""
    letters = sorted(
        (symbol for symbol in right.free_symbols if symbol.name not in COUNTING and symbol.name not in TWINS),
        key=str,
    )
    used = [letter for letter in letters if letter.is_commutative and _is_number(right, letter)]
    for place, one in enumerate(used):
        for two in used[place + 1 :]:
            yield "exchanged", _with(right, {one: two, two: one}), one, two
            yield "confused", _with(right, {one: two}), one, two
            yield "confused", _with(right, {two: one}), two, one
    for sine in sorted(right.atoms(sympy.sin), key=str):
        cosine = sympy.cos(sine.args[0], evaluate=False)
        if right.has(cosine):
            yield "exchanged", _with(right, {sine: cosine, cosine: sine}), sine, cosine


def _with(expression: Expr, letters: Mapping[Expr, Expr]) -> Expr:
    """An expression with other letters, in its own order."""
    if expression in letters:
        return letters[expression]
    if not expression.args or isinstance(expression, Counting):
        return expression
    return _like(expression, [_with(argument, letters) for argument in expression.args])


def _is_number(right: Expr, letter: sympy.Symbol) -> bool:
    """Whether a letter is a number, going by where it stands: in no index and no set."""
    for node in sympy.preorder_traversal(right):
        if isinstance(node, Quantity) and letter in node.free_symbols:
            return False
        if isinstance(node, Over) and letter in node.domain.free_symbols:
            return False
    return True
