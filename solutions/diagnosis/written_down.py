"""What goes wrong between the working and the answer."""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from math import isclose
from typing import Any

from sympy import Expr, sqrt

from rldrill.problems.parts import Matrix, Number, Numbers, Part
from rldrill.solutions.answers.text import Reading
from rldrill.solutions.diagnosis import weights
from rldrill.solutions.diagnosis.alternatives import hashable, likely_share, may_be_share, plain
from rldrill.solutions.diagnosis.arithmetic import beside_the_diagonal, slips
from rldrill.solutions.diagnosis.causes import Cause
from rldrill.solutions.diagnosis.replay import Application
from rldrill.solutions.diagnosis.typed import Typed, approximate, equal
from rldrill.solutions.exact import is_rational, simplest, to_sympy
from rldrill.solutions.formula.edits import Probe
from rldrill.solutions.formula.formula import Formula
from rldrill.solutions.formula.notation import Quantity

#: What was done, and the cells that come of it.
WrittenDown = Iterator[tuple[Cause, Mapping[str, Any]]]


def written_down(
    part: Part, key: Mapping[str, Any], applications: Sequence[Application], *, of_two: bool = False
) -> WrittenDown:
    """What can go wrong between the working and the answer to a part; ``of_two``: it asks for one of two shares."""
    if any(isinstance(value, str | tuple) for value in key.values()):
        return
    if len(key) > 1:
        yield from _other_quantities(key, applications)
        yield from _as_given(key, applications)
        for one, two in combinations(key, 2):
            yield _cause("exchanged-cells", f"{one} and {two}"), {**key, one: key[two], two: key[one]}
        yield _cause("all-signs"), {name: -value for name, value in key.items()}
        if isinstance(part.kind, Numbers) and len(key) > 3:  # the opposite order of three is an exchange of two
            yield _cause("answer-reversed"), dict(zip(key, reversed(list(key.values())), strict=True))
    of_shares = len(key) > 1 and all(0 <= approximate(value) <= 1 for value in key.values())
    of_shares = of_shares and isclose(sum(map(approximate, key.values())), 1.0)
    for name, value in key.items():
        for slip, other in slips(value):
            likely = likely_share(other) if of_shares and slip in weights.SLIPS else 1.0
            yield _cause(slip, name if len(key) > 1 else "", likely), {**key, name: other}
    for called, (name, value) in zip(getattr(part.kind, "called", ()), key.items(), strict=False):
        if called == "variance" and is_rational(value) and value > 0:
            yield _cause("standard-deviation"), {**key, name: simplest(sqrt(to_sympy(value)))}
    if len(key) == 1:
        ((name, value),) = key.items()
        if of_two or (may_be_share(value) and value not in (0, 1)):
            yield _cause("one-minus", likely=weights.OF_TWO if of_two else 1.0), {name: 1 - value}
        yield _cause("percent"), {name: value * 100}
        asked = _asked(key, applications)
        for application in applications:
            if plain(application.value) and application.step.left not in asked:
                weight = weights.ANSWERS["another-quantity"]
                yield Cause("another-quantity", weight, application, on_paper=True), {name: application.value}
        yield from _other_sides(name, value, applications)
    shape = part.kind
    if isinstance(shape, Matrix) and shape.rows == shape.columns > 1:
        places = range(1, shape.rows + 1)
        names = [[f"row {row}, column {column}" for column in places] for row in places]
        yield (
            _cause("answer-transposed"),
            {names[row][column]: key[names[column][row]] for row in range(shape.rows) for column in range(shape.rows)},
        )
        for row, column in beside_the_diagonal([[key[name] for name in line] for line in names]):
            one, two = names[row][column], names[column][row]
            yield _cause("sign", f"{one} and {two}"), {**key, one: -key[one], two: -key[two]}


def _other_sides(name: str, value: Any, applications: Sequence[Application]) -> WrittenDown:
    """The other one of two numbers that one given leaves open, where another given denies it."""
    rightly = [each for each in applications if plain(each.value) and equal(each.value, value)]
    for application in applications:
        formula = application.formula
        beside = [each.formula for each in rightly if each.known == application.known]
        if any(each.key == formula.key and each is not formula for each in beside) and application.value != value:
            cause = Cause(
                "other-side", weights.ANSWERS["other-side"], application, became=application.value, on_paper=True
            )
            yield cause, {name: application.value}


def _other_quantities(key: Mapping[str, Any], applications: Sequence[Application]) -> WrittenDown:
    """What was found for the same names on the way: a belief before the measurement, the values of an earlier sweep."""
    by_formula: dict[Formula, list[Application]] = defaultdict(list)
    for application in applications:
        if application.formula.sign == "=":  # an update's values are those of a table that is asked for in the end
            by_formula[application.formula].append(application)
    asked = _asked(key, applications)
    for alike in by_formula.values():
        for start in range(0, len(alike) - len(key) + 1, len(key)):
            several = alike[start : start + len(key)]
            if {each.step.left for each in several} <= asked:
                continue
            if all(plain(each.value) and _is_of(each, name) for each, name in zip(several, key, strict=True)):
                cause = Cause(
                    "another-quantity", weights.ANSWERS["another-quantity"], several[0], what="…", on_paper=True
                )
                yield cause, {name: each.value for name, each in zip(key, several, strict=True)}


def _asked(key: Mapping[str, Any], applications: Sequence[Application]) -> set[Expr]:
    """What the answer is called in the working: who gives an earlier value of that gives nothing else."""
    values = set(map(hashable, key.values()))
    return {each.step.left for each in applications if plain(each.value) and hashable(each.value) in values}


def _as_given(key: Mapping[str, Any], applications: Sequence[Application]) -> WrittenDown:
    """A table with the same names that was put in: the prior for the posterior, the old values for the new ones."""
    told = set()
    for application in applications:
        for quantity in sorted(application.right.atoms(Quantity), key=str):
            table = application.known.get(quantity.code)
            if quantity.code in told or not isinstance(table, Mapping):
                continue
            named = {_name(line): value for line, value in table.items()}
            if all(name in named and plain(named[name]) for name in key):
                told.add(quantity.code)
                cause = Cause(
                    "as-given", weights.ANSWERS["as-given"], application, probe=Probe(quantity, quantity), on_paper=True
                )
                yield cause, {name: named[name] for name in key}


def _name(line: Any) -> str:
    """What a cell of a line in a table is called."""
    return f"({', '.join(map(str, line))})" if isinstance(line, tuple) else str(line)


def _is_of(application: Application, name: str) -> bool:
    """Whether an application gives a quantity of the state, or of the state and action, of a cell's name."""
    told = {str(argument) for argument in application.step.left.args}
    return all(part in told for part in name.strip("()").split(", "))


def _cause(kind: str, what: str = "", likely: float = 1.0) -> Cause:
    return Cause(kind, weights.ANSWERS[kind] * likely, what=what, on_paper=True)


def as_a_whole(typed: Typed) -> WrittenDown:
    """What can be said of the typed numbers only when they are all there."""
    yield from _scaled(typed)
    yield from _rearranged(typed)


def _rearranged(typed: Typed) -> WrittenDown:
    """The right numbers in another order, more than two of them elsewhere than they belong."""
    read = {name: cell.value for name, cell in typed.cells.items() if isinstance(cell, Reading)}
    if len(typed.wrong) > 2 and sorted(map(str, read.values())) == sorted(map(str, typed.key.values())):
        yield _cause("answer-rearranged"), read


def _scaled(typed: Typed) -> WrittenDown:
    """All entries by the same factor too large: not normalised."""
    key = typed.key
    if isinstance(typed.part.kind, Number) or len(key) < 3 or len(typed.sizes) < len(key):
        return
    if not all(is_rational(value) and value != 0 for value in key.values()):
        return
    ratios = {cell.value / key[name] for name, cell in typed.cells.items() if isinstance(cell, Reading)}
    if len(ratios) == 1 and is_rational(factor := next(iter(ratios))) and factor != 0:
        cells = {name: value * factor for name, value in key.items()}
        yield Cause("answer-scaled", weights.ANSWERS["answer-scaled"], was=factor, on_paper=True), cells
