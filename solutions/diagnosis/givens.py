"""The givens misread: another problem that somebody solves who reads one thing wrongly."""

from collections.abc import Iterator, Sequence
from itertools import combinations, pairwise, permutations
from typing import Any

from msgspec import Struct
from pydantic import BaseModel, ValidationError

from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Model, Transition
from rldrill.problems.transition_tables import ALONE

#: At most so many values of a table are tried one by one.
_MOST = 24
#: Of a table of more rows than this none is tried in the place of another.
_FEW_ROWS = 3

#: What the entries of a list are called, where the name of its field says that of none of them.
_ENTRIES = {
    **{name: f"rows of {name}" for name in ("A", "B", "L", "P", "Q", "R")},
    "asked": "questions",
    "deviation": "entries of the deviation",
    "expert": "entries of the expert",
    "first": "first numbers",
    "gradient": "entries of the gradient",
    "mean": "entries of the mean",
    "model": "rows of the model",
    "mu": "feature expectations",
    "planned": "planned pairs",
    "point": "coordinates of the point",
    "position": "coordinates of the position",
    "repeated": "repeated rewards",
    "run": "steps of the run",
    "start": "entries of the start",
    "table": "rows of the table",
    "theta": "weights",
    "thetas": "values of θ",
    "velocity": "entries of the velocity",
    "w": "weights",
}

#: What a number is called, where it is not by the name of its field.
_CALLED = {
    "alpha": "α",
    "beta": "β",
    "epsilon": "ε",
    "gamma": "γ",
    "lam": "λ",
    "mean": "μ₀",
    "noise": "σ²",
    "theta": "θ",
    "variance": "σ₀²",
}
#: What one number of a table is called, where it is not by the name of its field.
_ONE_OF = {"logarithms": "logarithm of feature", "values": "value of"}
#: Lists of names that are gone through one after the other, each with the table of its own.
_IN_TURN = ("measurements", "actions")
#: What is done to the order of a list is done all along: who had the right answer to a part before did not do it.
OF_THE_ORDER = frozenset(("reversed", "entries-exchanged", "entry-left-out"))

#: Who takes one number for another does not notice that those which are stated no longer fit together.
_UNNOTICED = frozenset(("minus-lost", "rows-exchanged", "lines-exchanged", "end-unpaid"))
#: What a column of a table of transitions or the like is called, where the name of its field does not say that.
_COLUMNS = {"next": "next state"}


class Misread(Struct, frozen=True):
    """Givens in which one thing is read wrongly, and what was done: a name, and what is said of it."""

    kind: str
    given: Any
    what: str


def misread(given: BaseModel) -> Iterator[Misread]:
    """The givens with one thing read wrongly, those alone that make a problem."""
    for kind, changed, what in _model(given):
        yield Misread(kind, changed, what)


def led_elsewhere(given: BaseModel) -> Iterator[Misread]:
    """The givens with one transition that is taken to lead to another state, those alone that make a problem."""
    for name in type(given).model_fields:
        model = getattr(given, name)
        if not isinstance(model, Model):
            continue
        rows = model.transitions
        for place, row in enumerate(rows):
            for state in (*model.states, *model.terminal):
                if state != row.next:
                    other = (*rows[:place], row._replace(next=state), *rows[place + 1 :])
                    leaving = row.state if row.action == ALONE else f"{row.action} in {row.state}"
                    what = f"{leaving} is taken to lead to {state}, not to {row.next}"
                    for _, changed, _ in _again(model, {"transitions": other}, "", ""):
                        yield from (Misread(*each) for each in _again(given, {name: changed}, "led-elsewhere", what))


Changed = Iterator[tuple[str, Any, str]]


def _model(model: BaseModel) -> Changed:
    fields = {name: getattr(model, name) for name in type(model).model_fields}
    numbers = [name for name, value in fields.items() if _number(value)]
    for one, two in combinations(numbers, 2):
        if fields[one] != fields[two]:
            yield from _again(
                model, {one: fields[two], two: fields[one]}, "givens-exchanged", f"{_called(one)} and {_called(two)}"
            )
    if isinstance(model, Model) and (unpaid := _unpaid_at_the_end(model)) != model.transitions:
        yield from _again(model, {"transitions": unpaid}, "end-unpaid", "")
    for name, value in fields.items():
        if isinstance(value, bool):
            continue
        ambiguous = isinstance(value, BaseModel) and not fields.keys().isdisjoint(type(value).model_fields)
        for kind, changed, what in _inside(value, name):
            yield from _again(model, {name: changed}, kind, _at(what, f"of the {name}") if ambiguous else what)


def _unpaid_at_the_end(model: Model) -> tuple[Transition, ...]:
    """The transitions of somebody who takes all that leads to a terminal state for worthless, as that state is."""
    return tuple(
        row._replace(reward=Fraction(0)) if row.next in model.terminal and _number(row.reward) else row
        for row in model.transitions
    )


def _again(model: BaseModel, update: dict[str, Any], kind: str, what: str) -> Changed:
    fields = {name: getattr(model, name) for name in model.model_fields_set | set(update)}
    try:
        yield kind, type(model)(**{**fields, **update}), what
    except (ValidationError, ValueError, TypeError, ArithmeticError, LookupError):
        if kind in _UNNOTICED:
            every = {name: getattr(model, name) for name in type(model).model_fields}
            yield kind, type(model).model_construct(**{**every, **update}), what


def _called(name: str) -> str:
    return _CALLED.get(name, name.replace("_", " "))


def _number(value: object) -> bool:
    return isinstance(value, Fraction | int) and not isinstance(value, bool)


def _inside(value: Any, name: str) -> Changed:
    if isinstance(value, BaseModel):
        yield from _model(value)
    elif _number(value):
        yield from _of_number(value, name)
    elif isinstance(value, dict):
        yield from _of_table(value, name)
    elif isinstance(value, tuple) and not hasattr(value, "_fields"):
        if (turned := _turned(value)) != value:
            yield "rows-and-columns", turned, name
        yield from _of_list(value, name)


def _of_number(value: Any, name: str) -> Changed:
    if isinstance(value, int):
        yield "one-too-many", value + 1, name
        yield "one-too-few", value - 1, name
    elif value < 0:
        yield "minus-lost", -value, _called(name)
    if isinstance(value, Fraction) and 0 < value < 1:
        yield "complement", 1 - value, _called(name)


def _of_table(value: dict[Any, Any], name: str) -> Changed:
    keys = list(value)[:_MOST]
    if (turned := _turned_table(value)) != value:
        yield "rows-and-columns", turned, name
    of_shares = all(_number(number) and 0 <= number <= 1 for number in value.values())
    for key in keys:
        if _number(value[key]) and value[key] < 0:
            yield "minus-lost", {**value, key: -value[key]}, f"the {_ONE_OF.get(name, f'{name} of')} {_named(key)}"
        if of_shares and 0 < value[key] < 1:
            yield "complement", {**value, key: 1 - value[key]}, f"{name} of {_named(key)}"
    for one, two in list(combinations(keys, 2))[:_MOST]:
        if value[one] != value[two]:
            what = f"{name} of {_named(one)} and {_named(two)}"
            yield "rows-exchanged", {**value, one: value[two], two: value[one]}, what
    if len(keys) == 2 and all(isinstance(row, dict) for row in value.values()):
        yield from _of_columns(value, name)
    if 1 < len(keys) <= _FEW_ROWS and all(isinstance(row, dict) for row in value.values()):
        for one, two in permutations(keys, 2):
            if value[one].keys() == value[two].keys() and value[one] != value[two]:
                what = f"the row of {_named(two)} is read for that of {_named(one)} in {name}"
                yield "another-row", {**value, one: value[two]}, what
    for key in keys:
        if isinstance(value[key], BaseModel | dict):
            where = f"{'of' if isinstance(value[key], BaseModel) else 'at'} {_named(key)}"
            for kind, changed, what in _inside(value[key], name):
                yield kind, {**value, key: changed}, _at(what, where)
        elif isinstance(value[key], tuple) and all(map(_number, value[key])):
            for one, two in combinations(range(len(value[key])), 2):
                row = list(value[key])
                row[one], row[two] = row[two], row[one]
                if tuple(row) != value[key]:
                    what = f"{name} of {_named(key)}, {ordinal(one)} and {ordinal(two)}"
                    yield "rows-exchanged", {**value, key: tuple(row)}, what
    for here, there in pairwise(keys):
        for one, two in ((here, there), (there, here)):
            yield from _of_the_next_row(value, name, one, two)


def _of_the_next_row(value: dict[Any, Any], name: str, own: Any, other: Any) -> Changed:
    """One number of a row read in the row beside it."""
    row, beside = value[own], value[other]
    if not all(isinstance(each, tuple) and all(map(_number, each)) for each in (row, beside)):
        return
    for place, (number, instead) in enumerate(zip(row, beside, strict=False)):
        if number != instead:
            what = f"the {ordinal(place)} number of {_named(other)} is read for that of {_named(own)} in the {name}"
            yield "another-cell", {**value, own: (*row[:place], instead, *row[place + 1 :])}, what


def _of_list(value: tuple[Any, ...], name: str) -> Changed:
    if not 1 < len(value) <= _MOST:
        return
    name = _ENTRIES.get(name, name)
    yield "reversed", value[::-1], "states" if isinstance(value[0], Transition) else name
    for place in range(len(value)):
        yield "entry-left-out", (*value[:place], *value[place + 1 :]), f"{ordinal(place)} of the {name}"
        if place + 1 < len(value) and value[place] != value[place + 1]:
            swapped = (*value[:place], value[place + 1], value[place], *value[place + 2 :])
            if len(value) > 2 and not _same_order(value, swapped):  # the opposite order of two is an exchange
                yield "entries-exchanged", swapped, f"{name}, {ordinal(place)} and {ordinal(place + 1)}"
            for column, *pair in _lines_exchanged(value[place], value[place + 1]):
                where = f"{column} of the {ordinal(place)} and the {ordinal(place + 1)} of the {name}"
                yield "lines-exchanged", (*value[:place], *pair, *value[place + 2 :]), where
        if _number(value[place]) and value[place] < 0:
            yield (
                "minus-lost",
                (*value[:place], -value[place], *value[place + 1 :]),
                f"the {ordinal(place)} of the {name}",
            )
        if name in _IN_TURN and place and value[place] != value[place - 1]:
            again = (*value[:place], value[place - 1], *value[place + 1 :])
            yield "as-above", again, f"{ordinal(place)} of the {name}"
        if isinstance(value[place], tuple | BaseModel):
            above = _as_above(value, name, place) if place else ()
            for kind, changed, what in (*_row(value[place], name, place), *above):
                yield kind, (*value[:place], changed, *value[place + 1 :]), what


def _same_order(rows: tuple[Any, ...], swapped: tuple[Any, ...]) -> bool:
    """Whether two orders of lines say the same: a table of transitions, in which the states keep their places."""
    if not _is_way(rows[0]):
        return False
    return list(dict.fromkeys(row.state for row in rows)) == list(dict.fromkeys(row.state for row in swapped))


def _is_way(row: Any) -> bool:
    """Whether a line of a table leads from one state to the next."""
    return hasattr(row, "state") and hasattr(row, "next")


def _lines_exchanged(one: Any, two: Any) -> Iterator[tuple[str, Any, Any]]:
    """Two ways from state to state with the entries of one column exchanged: numbers, and where they lead to."""
    for column in one._fields if _is_way(one) else ():
        here, there = getattr(one, column), getattr(two, column)
        if here == there or not (column == "next" or (_number(here) and _number(there))):
            continue
        if column == "probability" and (one.state, one.action) != (two.state, two.action):
            continue
        if column == "next" and not hasattr(one, "action"):
            continue  # ways from one state: it is their rewards that are exchanged
        yield _COLUMNS.get(column, column), one._replace(**{column: there}), two._replace(**{column: here})


def _turned(value: Any) -> Any:
    """A square table, or each of several, with its rows as columns; anything else as it is."""
    if not isinstance(value, tuple) or not all(isinstance(row, tuple) and not hasattr(row, "_fields") for row in value):
        return value
    if all(len(row) == len(value) and all(map(_number, row)) for row in value):
        return tuple(zip(*value, strict=True))
    return tuple(map(_turned, value))


def _of_columns(value: dict[Any, Any], name: str) -> Changed:
    """Of two rows the numbers of one column exchanged: in it the other row is read."""
    (one, above), (two, below) = value.items()
    for column in above if above.keys() == below.keys() else ():
        if _number(above[column]) and _number(below[column]) and above[column] != below[column]:
            rows = {one: {**above, column: below[column]}, two: {**below, column: above[column]}}
            yield "rows-exchanged", rows, f"{name} of {_named(one)} and {_named(two)} at {_named(column)}"


def _turned_table(value: dict[Any, Any]) -> dict[Any, Any]:
    """A table with as many numbers in every row as it has rows, with its rows as columns; anything else as it is."""
    rows = list(value.values())
    if all(isinstance(row, tuple) and len(row) == len(rows) and all(map(_number, row)) for row in rows):
        return dict(zip(value, zip(*rows, strict=True), strict=True))
    if all(isinstance(row, dict) and list(row) == list(value) and all(map(_number, row.values())) for row in rows):
        return {one: {two: value[two][one] for two in value} for one in value}
    return value


def _as_above(value: tuple[Any, ...], name: str, place: int) -> Changed:
    """One entry of a row taken over from the row above it."""
    row, above = value[place], value[place - 1]
    for field in type(row).model_fields if isinstance(row, BaseModel) else ():
        other = getattr(above, field)
        if other not in (None, getattr(row, field)) and not isinstance(other, dict):
            yield from _again(row, {field: other}, "as-above", f"{field} of the {ordinal(place)} of the {name}")


def _row(row: Any, name: str, place: int) -> Changed:
    """One row of a table: a number in it without its minus, two of its numbers exchanged."""
    if isinstance(row, BaseModel):
        where = f"of the {ordinal(place)} of the {name}"
        for kind, other, what in _model(row):
            if (kind, what) == ("one-too-many", "times"):
                yield "counted-again", other, f"{ordinal(place)} of the {name}"
            else:
                yield kind, other, _at(what, where)
        return
    entries: Sequence[Any] = row
    make = row._replace if hasattr(row, "_fields") else None

    def changed(update: dict[int, Any]) -> Any:
        if make:
            return make(**{row._fields[column]: entry for column, entry in update.items()})
        return tuple(update.get(column, entry) for column, entry in enumerate(entries))

    where = f"{ordinal(place)} {'of' if name.startswith('rows of ') else 'row of'} the {name}"
    numbers = [column for column, entry in enumerate(entries) if _number(entry)]
    for column in numbers:
        if entries[column] < 0:
            yield "minus-lost", changed({column: -entries[column]}), f"the {where}"
    for one, two in combinations(numbers, 2):
        if entries[one] != entries[two]:
            update = {one: entries[two], two: entries[one]}
            yield "givens-exchanged", changed(update), where


def _at(what: str, where: str) -> str:
    """What is in one row of several, with the row: in none is it the same."""
    return f"{what}{',' if ', ' in what or ' at ' in what else ''} {where}" if what else ""


def _named(key: Any) -> str:
    return ", ".join(map(str, key)) if isinstance(key, tuple) else str(key)


_ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth")


def ordinal(place: int) -> str:
    """A place counted from 0, in words: first, second, …; 21st."""
    if place < len(_ORDINALS):
        return _ORDINALS[place]
    number = place + 1
    teens = number % 100 in (11, 12, 13)
    return f"{number}{'th' if teens else {1: 'st', 2: 'nd', 3: 'rd'}.get(number % 10, 'th')}"
