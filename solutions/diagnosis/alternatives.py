"""What may come out of one application of a formula instead of its value."""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache
from math import isclose
from typing import Any

import sympy
from flint import fmpq
from msgspec.structs import replace
from sympy import Basic, Expr

from rldrill.solutions.diagnosis import weights
from rldrill.solutions.diagnosis.arithmetic import slips
from rldrill.solutions.diagnosis.causes import Cause
from rldrill.solutions.diagnosis.replay import UNDONE, Application
from rldrill.solutions.diagnosis.typed import approximate
from rldrill.solutions.exact import is_rational, parameters
from rldrill.solutions.formula.compiling import value_of
from rldrill.solutions.formula.edits import IN_ONE_TERM, SCALE, SHIFT, Edit, Probe, edits, element, flat, probes
from rldrill.solutions.formula.formula import Misconception
from rldrill.solutions.formula.node import Node
from rldrill.solutions.formula.nodes.sets import Over
from rldrill.solutions.formula.notation import Quantity, SumOver, letter
from rldrill.solutions.matrices import is_matrix, matrix
from rldrill.solutions.rational import generator
from rldrill.solutions.vector import Vector

#: A place whose quantity has more values than this elsewhere is not tried with all of them.
_ELSEWHERE = 12
#: A sum of more terms than this is not edited term by term.
TERMS = 8
#: What is likely has at least this weight.
LIKELY = 1.5
#: A slip of arithmetic in a value that is read in a table is as likely as another line of it where it weighs so much.
SURER = 1.0
#: An edit of this weight says at one place better what was done than a mistake that is stated of the whole formula.
PLAIN = 6.0
#: Edits that take something for 1 minus itself.
_OF_SHARES = ("complement", "complement-of-value")
#: Stands for a matrix that somebody reads or works out wrongly.
_LETTER = letter("matrix_", "X", matrix=True)


def can_be_made(mistake: Misconception, given: Any) -> bool:
    """Whether a mistake that is stated beside a formula can be made here.

    Its condition may be written for the fields of the families that list it, and of a family without them it says
    nothing. In those that list it nothing is caught: there ``Solution.applicable`` asks it.
    """
    try:
        return mistake.applies(given)
    except AttributeError:
        return True


def at_one(application: Application, given: Any) -> Iterator[Cause]:
    """What can be done at one application, with the value that comes out."""
    formula, right, known, value = application.formula, application.right, application.known, application.value
    base = Cause("", 0.0, application, formula, was=value)
    for kind, other in slips(value):
        yield replace(base, kind=kind, weight=weights.VALUES[kind], became=other)
    if same_form(old := application.old(), value):
        yield replace(base, kind="kept", weight=weights.VALUES["kept"], became=old)
        yield from _of_table(application, base)
    if application.equation:
        return
    edited = set()
    for edit in edits(right):
        weight = weights.IDEAS[edit.kind] * weights.AT_ONE
        if edit.kind in IN_ONE_TERM:
            pass
        elif (
            is_sensible(edit)
            and is_made_of_shares(edit, (application,))
            and same_form(other := _outcome(edit.right, known), value)
        ):
            if weights.IDEAS[edit.kind] >= PLAIN:
                edited.add(hashable(other))
            yield replace(base, kind=edit.kind, weight=weight, edit=edit, became=other)
        if edit.once is not None:
            for term, at in single(edit, known)[:TERMS]:
                other = value_or_none(edit.once, {**known, **at})
                if same_form(other, value) and is_made_of_shares(edit, (application,), term):
                    in_term = weight * weights.IN_ONE_TERM
                    yield replace(base, kind=edit.kind, weight=in_term, edit=edit, term=term, became=other)
    for mistake, misread in formula.misread.items():
        if not can_be_made(mistake, given):
            continue
        other = _outcome(misread, known)
        if same_form(other, value) and hashable(other) not in edited:
            yield replace(base, kind="listed", weight=weights.STATED * weights.AT_ONE, mistake=mistake, became=other)
    if (crosswise := _crosswise(flat(right), known)) is not None:
        whole = Probe(right, right)
        yield replace(base, kind="crosswise", weight=weights.INSIDE["crosswise"], probe=whole, became=crosswise)
    yield from _other_matrices(application, base)
    yield from _inverses(application, base)
    for probe in probes(right):
        for cause, letters in at_place(application, probe):
            other = value_or_none(probe.right, {**known, **letters})
            if same_form(other, value):
                yield replace(cause, became=other)


def shares(applications: Sequence[Application]) -> set[int]:
    """The numbers of applications whose values sum to 1 with others of the same formula: shares of something."""
    found: set[int] = set()
    of_formula: dict[Expr, list[Application]] = defaultdict(list)
    for application in applications:
        of_formula[application.right].append(application)
    for alike in of_formula.values():
        some: list[int] = []
        total = 0.0
        for application in alike:
            size = approximate(application.value) if plain(application.value) else -1.0
            if not 0 <= size <= 1:
                break
            some.append(application.number)
            total += size
            if isclose(total, 1.0):
                found.update(some if len(some) > 1 else ())
                some, total = [], 0.0
    return found


def likely_share(value: Any) -> float:
    """How likely it is that somebody takes a value for a share of 1, with a slip in it."""
    return 1.0 if 0 <= approximate(value) <= 1 else weights.NO_SHARE


def _of_table(application: Application, base: Cause) -> Iterator[Cause]:
    """The same update once more, from the value that it gave; or from a table that has been updated since."""
    left, known = application.formula.left, application.known
    try:
        arguments = tuple(value_of(argument, known) for argument in left.args)
    except UNDONE:
        return
    key, code = arguments[0] if len(arguments) == 1 else arguments, left.func.code
    again = {**known, code: {**known[code], key: application.value}}
    if (other := value_or_none(application.right, again)) is not None:
        yield replace(base, kind="repeated", weight=weights.VALUES["repeated"], became=other)
    if application.first is not None and key in application.first:
        first, now = application.first, known[code]
        own = {**now, key: first[key]} if first[key] != 0 else now  # who takes 0 for a trace leaves it out
        for table in (first, {**first, key: now.get(key)}, own):
            if table != now and (other := value_or_none(application.right, {**known, code: table})) is not None:
                yield replace(base, kind="stale", weight=weights.VALUES["stale"], became=other)


def _other_matrices(application: Application, base: Cause) -> Iterator[Cause]:
    """Another given matrix of the same shape in the place of one, R for Q; or another line of the same table."""
    right, known = application.right, application.known
    for part in _of_matrices(right, sympy.Symbol, Quantity):
        name = part.code if isinstance(part, Quantity) else part.name
        was = value_or_none(part, known)
        if is_matrix(was):
            tables = {
                taken: table for taken, table in known.items() if taken != name and type(table) is type(known[name])
            }
            others = [("elsewhere", value_or_none(part, {**known, name: table})) for table in tables.values()]
        else:
            others = [("another-line", other) for other in _beside(part, known)]
        for kind, other in others:
            if same_form(other, was) and other != was:
                became = value_or_none(_with_letter(right, part), {**known, _LETTER.name: other})
                if same_form(became, application.value):
                    probe = Probe(part, right)
                    yield replace(
                        base, kind=kind, weight=weights.INSIDE[kind], probe=probe, was=was, other=other, became=became
                    )


def _beside(part: Expr, known: Mapping[str, Any]) -> list[Any]:
    """The vectors in the lines of a table that differ in one name from the line of a quantity: of another action."""
    table = known.get(part.code) if isinstance(part, Quantity) else None
    if not isinstance(table, Mapping) or len(part.args) < 2:
        return []
    own = tuple(value_or_none(argument, known) for argument in part.args)
    return [
        value
        for key, value in table.items()
        if isinstance(value, Vector) and sum(one != two for one, two in zip(key, own, strict=True)) == 1
    ]


def _inverses(application: Application, base: Cause) -> Iterator[Cause]:
    """The inverse of a 2×2 matrix by its rule, with one step of the rule forgotten."""
    right, known = application.right, application.known
    for part in _of_matrices(right, sympy.Pow):
        was = value_or_none(part, known) if part.args[1] == -1 else None
        if not is_matrix(was) or (was.nrows(), was.ncols()) != (2, 2):
            continue
        (a, b), (c, d) = was.tolist()
        determinant = 1 / (a * d - b * c)  # that of the matrix itself
        for kind, rows in (
            ("inverse-signs", [[a, -b], [-c, d]]),
            ("inverse-diagonal", [[d, b], [c, a]]),
            ("inverse-undivided", [[each * determinant for each in row] for row in ((a, b), (c, d))]),
        ):
            became = value_or_none(_with_letter(right, part), {**known, _LETTER.name: matrix(rows)})
            if same_form(became, application.value):
                probe = Probe(part.args[0], right)
                yield replace(base, kind=kind, weight=weights.INSIDE[kind], probe=probe, was=was, became=became)


@cache
def _of_matrices(right: Expr, *kinds: type[Expr]) -> Sequence[Expr]:
    """The parts of a right side of some kinds that are, or hold, matrices."""
    return sorted((each for each in right.atoms(*kinds) if each.is_commutative is False), key=str)


def _with_letter(right: Expr, part: Expr) -> Expr:
    """A right side in which a letter stands for one matrix, its factors in their order."""
    if right == part:
        return _LETTER
    if not right.args or isinstance(right, Quantity):
        return right
    arguments = [_with_letter(argument, part) for argument in right.args]
    return right.func(*arguments, **({} if isinstance(right, Node) else {"evaluate": False}))


def at_place(application: Application, probe: Probe) -> Iterator[tuple[Cause, dict[str, Any]]]:
    """What another value of one place in a formula could be."""
    known = application.known
    every = list(terms(probe.within, known)) if probe.within else [((), {})]
    for term, at in every:
        here = {**known, **dict(zip((over.index.name for over in probe.within), term, strict=True))}
        was = value_or_none(probe.part, here)
        if not plain(was) and not isinstance(was, int):
            continue
        for kind, other in (*_from_the_start(application, probe.part, was, here), *_others(probe.part, was, here)):
            weight = weights.INSIDE[kind] * (weights.IN_ONE_TERM if len(every) > 1 else 1)
            cause = Cause(kind, weight, application, application.formula, probe=probe, term=term, was=was, other=other)
            yield cause, {**at, SCALE.name: fmpq(0), SHIFT.name: other}


def _from_the_start(
    application: Application, part: Expr, was: Any, known: Mapping[str, Any]
) -> Iterator[tuple[str, Any]]:
    """What a quantity of the table that is updated was worth before the first update."""
    left, first = application.formula.left, application.first
    if first is None or not isinstance(part, Quantity) or part.code != left.func.code:
        return
    other = value_or_none(part, {**known, part.code: first})
    if plain(other) and str(other) != str(was):
        yield "stale", other


def _others(part: Expr, was: Any, known: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    leaf = isinstance(part, Quantity) or part.is_Symbol
    if (crosswise := _crosswise(part, known)) is not None:
        yield "crosswise", crosswise
    if isinstance(part, SumOver):
        return
    if part.is_Pow and is_rational(was) and 0 < was < 1 and was.q != 2:
        yield "complement", 1 - was
    lines = _lines(part, known)
    slipped = [(kind, other) for kind, other in slips(was) if weights.INSIDE[kind] >= SURER or str(other) not in lines]
    for kind, other in slipped:
        lost = kind == "sign" and leaf and is_rational(was) and was < 0
        yield "minus-lost" if lost else kind, other
    told = {str(other) for _, other in slipped} | {str(was)}
    for said, (other, keys) in lines.items():
        if said not in told:
            yield "another-line" if len(keys) == 1 else "elsewhere", other
    told |= set(lines)
    if leaf:
        yield from (("elsewhere", other) for other in _distinct(known.values()) if str(other) not in told)


def _lines(part: Expr, known: Mapping[str, Any]) -> dict[str, tuple[Any, list[Any]]]:
    """The values in the table that a quantity is read from, as they are written: each with the keys of its lines."""
    table = known.get(part.code) if isinstance(part, Quantity) else None
    lines: dict[str, tuple[Any, list[Any]]] = {}
    for key, value in table.items() if isinstance(table, Mapping) else ():
        if plain(value):
            lines.setdefault(str(value), (value, []))[1].append(key)
    return lines if len(lines) <= _ELSEWHERE else {}


def likely(right: Expr, known: Mapping[str, Any], value: Any) -> Iterator[tuple[str, float, Edit | None, Any]]:
    """The likeliest other values of an application in a changed working."""
    for kind, other in slips(value):
        if (weight := weights.VALUES[kind]) >= LIKELY:
            yield kind, weight, None, other
    for edit in edits(right):
        weight = weights.IDEAS[edit.kind] * weights.AT_ONE
        if weight >= LIKELY and edit.kind not in IN_ONE_TERM:
            other = value_or_none(edit.right, known)
            if other is not None and plain(other) and other != value:
                yield edit.kind, weight, edit, other


def _crosswise(part: Expr, known: Mapping[str, Any]) -> fmpq | None:
    """Two fractions added top to top and bottom to bottom."""
    values = []
    if part.is_Add and len(part.args) == 2:
        values = [value_or_none(term, known) for term in part.args]
    elif isinstance(part, SumOver):
        domain = value_or_none(part.domain, known)
        short = domain if isinstance(domain, Sequence) and len(domain) <= TERMS else ()
        values = [value_or_none(part.body, {**known, part.index.name: item}) for item in short]
        values = [value for value in values if value != 0]
    if len(values) != 2 or not all(map(is_rational, values)):
        return None
    one, two = values
    return None if 1 in (one.q, two.q) or one.q == two.q else fmpq(one.p + two.p, one.q + two.q)


def value_or_none(right: Expr, known: Mapping[str, Any]) -> Any:
    """What an expression is worth; None where it has no value."""
    try:
        return value_of(right, known)
    except UNDONE:
        return None


def _outcome(right: Expr, known: Mapping[str, Any]) -> Any:
    """What comes out of a right side that may be a whole number and nothing else: 0 without any choice."""
    value = value_or_none(right, known)
    return fmpq(value) if isinstance(value, int) else value


def terms(within: Sequence[Over], known: Mapping[str, Any]) -> Iterator[tuple[tuple[Any, ...], dict[str, Any]]]:
    """The terms of sums in one another: the values of their letters, and what says so to an edit."""
    found: list[tuple[Any, ...]] = [()]
    names = [over.index.name for over in within]
    try:
        for depth, over in enumerate(within):
            found = [
                (*term, item)
                for term in found
                for item in value_of(over.domain, {**known, **dict(zip(names[:depth], term, strict=True))})
            ]
    except UNDONE:
        return
    for term in found:
        yield term, {element(depth): item for depth, item in enumerate(term)}


def single(edit: Edit, known: Mapping[str, Any]) -> list[tuple[tuple[Any, ...], dict[str, Any]]]:
    """The terms of sums that an edit can be made in alone; where there is but one, it is made in the whole."""
    every = list(terms(edit.within, known))
    return every if len(every) > 1 or edit.kind in IN_ONE_TERM else []


def is_sensible(edit: Edit) -> bool:
    """Whether somebody could do that: nobody adds up the factors of −V."""
    return edit.kind != "added" or edit.part.args[0] != -1


def is_made_of_shares(edit: Edit, applications: Iterable[Application], term: tuple[Any, ...] | None = None) -> bool:
    """Whether an edit that takes something for 1 minus itself does so with shares of 1, in all terms or in one alone.

    Shares are from 0 to 1, and not all of them 0 or 1: who follows one action always has nothing to take 1 minus of.
    """
    if edit.kind not in _OF_SHARES:
        return True
    names = [over.index.name for over in edit.within]
    values = [
        value_or_none(edit.part, {**each.known, **dict(zip(names, one, strict=True))})
        for each in applications
        for one in ((one for one, _ in terms(edit.within, each.known)) if term is None else (term,))
    ]
    return all(map(may_be_share, values)) and not all(value in (0, 1) for value in values)


def may_be_share(value: Any) -> bool:
    """Whether a value is from 0 to 1, or a letter that stands for a share, or 1 minus it."""
    if value is None:
        return False
    if letters := parameters(value):
        return value in [each for letter in letters for each in (generator(letter), 1 - generator(letter))]
    return 0 <= approximate(value) <= 1


def plain(value: Any) -> bool:
    """Whether a value is one number, of any form."""
    return is_rational(value) or (
        not isinstance(value, str | int | tuple | Mapping | Vector)
        and not is_matrix(value)
        and hasattr(value, "__add__")
    )


def numbers(value: Any) -> list[Any] | None:
    """The numbers of a number, a vector or a matrix; None of anything else."""
    if is_matrix(value):
        return list(value.entries())
    if isinstance(value, Vector):
        return list(value)
    return [value] if plain(value) else None


def of_numbers(value: Any, others: Sequence[Any]) -> Any:
    """A value of the form of another, of these numbers."""
    if is_matrix(value):
        wide = value.ncols()
        return matrix([list(others[start : start + wide]) for start in range(0, len(others), wide)])
    return Vector(others) if isinstance(value, Vector) else others[0]


def _distinct(values: Iterable[Any]) -> list[Any]:
    """The numbers among some values, each once."""
    return list({str(value): value for value in values if plain(value)}.values())


def same_form(other: Any, value: Any) -> bool:
    """Whether one value can stand for another: numbers, vectors, matrices of a shape; none where there is no value."""
    if is_matrix(value):
        return is_matrix(other) and (other.nrows(), other.ncols()) == (value.nrows(), value.ncols())
    if isinstance(value, tuple):
        return isinstance(other, tuple)
    return isinstance(other, Vector) if isinstance(value, Vector) else plain(other)


def hashable(value: Any) -> Any:
    """A value as a key of a dictionary; what is not rational is long to write, and is one already."""
    if is_matrix(value):
        return tuple(map(hashable, value.entries()))
    return value if isinstance(value, Basic) else str(value)
