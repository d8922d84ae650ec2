"""What is wrong with the givens of a problem file, as one plain sentence that names the field."""

import re
from collections.abc import Iterator, Mapping, Sequence
from difflib import get_close_matches
from typing import Any

from pydantic import ValidationError

from rldrill.problems.exact import called
from rldrill.problems.habits import ALSO

_LONGEST = 40
_PLACE = re.compile(r"([a-z_]+(?:\[\d+\])*): ", re.IGNORECASE)
_TABLE = "must be a table, in which every name has its value"
_NAMED = f"{_TABLE}: {{{{A = …, B = …}}}}"
_WHOLE = "{given} is not a whole number; write one, such as 3"
_TRUTH = "{given} is neither true nor false; write one of them"
_LIST = "must be a list; a single entry, too, stands in brackets: {listed}"
#: Between the entries of a list that was given as one text; a comma without a space may be a decimal one.
_BETWEEN = re.compile(r"\s*;\s*|,\s+")
_SPACED, _NUMBERS = re.compile(r"\s+"), re.compile(r"[-+−]?[\d./]+(?:\s+[-+−]?[\d./]+)+")
#: So many of them are shown.
_SHOWN = 5
#: So many fields are named.
_FIELDS = 14
#: What to say of the faults that pydantic finds, by its names for them.
_SAYS = {
    "missing": "is missing; add it",
    "missing_argument": "is missing; add it",
    "unexpected_positional_argument": "is one entry too many; take it out",
    "model_type": _TABLE,
    "dict_type": _NAMED,
    "tuple_type": _LIST,
    "list_type": _LIST,
    "named_tuple_type": "must be a list, with the entries of one {class_name}",
    "string_type": "must be a text; put it in quotes",
    "string_too_short": "is empty; write something",
    "string_too_long": "has {length} characters, {max_length} are the most; shorten it",
    "int_type": _WHOLE,
    "int_parsing": _WHOLE,
    "int_parsing_size": _WHOLE,
    "int_from_float": _WHOLE,
    "bool_type": _TRUTH,
    "bool_parsing": _TRUTH,
    "greater_than": "{given} is too small; it must be above {gt}",
    "greater_than_equal": "{given} is too small; it must be at least {ge}",
    "less_than": "{given} is too large; it must be below {lt}",
    "less_than_equal": "{given} is too large; it must be at most {le}",
    "literal_error": "{given} is not possible here; write {expected}",
}


Schema = Mapping[str, Any]


def sentence(error: ValidationError, schema: Schema, *, family: str, tagged: bool) -> str:
    """The first fault, and how many more there are; of a field that does not exist, also the nearest that does.

    Args:
        error: what pydantic says.
        schema: the JSON Schema of the givens.
        family: the name of their family.
        tagged: whether the givens are a union; then its places begin with a tag, which nobody has written.
    """
    # A field that does not exist explains why another is missing, so it comes first.
    first, *rest = sorted(error.errors(), key=lambda fault: fault["type"] != "extra_forbidden")
    place = list(first["loc"][tagged:])
    if place[-1:] == ["[key]"]:  # the fault is the name itself
        del place[-2:]
    path = "".join(f"[{step + 1}]" if isinstance(step, int) else f".{_brief(step)}" for step in place)
    more = f" (and {len(rest)} more fault{'s' * (len(rest) > 1)})" if rest else ""
    if first["type"] == "extra_forbidden":
        known = [name for name in _known(schema, place[:-1]) if name != place[-1]]
        all_of_them = f"rldrill.fields('{family}') and 'rldrill fields {family}' list them all"
        if 0 < len(known) <= _FIELDS:
            all_of_them = (
                f"the field{'s' * (len(known) > 1)} there {'are' if len(known) > 1 else 'is'} {', '.join(known)}"
            )
        return f"given{path} is not a field{_meant(schema, place, known)}; {all_of_them}{more}."
    told = says(first)
    if first["type"] == "model_type" and 0 < len(names := _known(schema, place)) <= _SHOWN:
        told = f"{told}: {', '.join(names)}"
    if first["type"] == "tuple_type" and isinstance(first["input"], Mapping):
        told = "must be a list in brackets, not a table"
    if first["type"] == "tuple_type" and (row := _row(schema, place)):
        told = f"must be a list {row}, in brackets of its own"
    elif first["type"] == "tuple_type" and (names := _known(schema, [*place, 0])):
        fields = ", ".join(f"{each} = …" for each in names)
        told = f"must be a list, in which each entry is a table of its own: {{{fields}}}"
    elif first["type"] == "tuple_type" and (row := _row(schema, [*place, 0])):
        told = f"must be a list, in which each entry is a list {row}"
    elif first["type"] == "named_tuple_type":
        told = f"must be a list, {_row(schema, place)}"
    elif place and isinstance(place[-1], int) and (row := _row(schema, place[:-1])).startswith("["):
        told = f"{told}; the row is {row}"
    if begun := _PLACE.match(told):  # what a whole model says of one of its fields
        path, told = f"{path}.{begun[1]}", told[begun.end() :]
    return f"given{path}: {told}{more}."


def nearest(name: str, known: Sequence[str]) -> str:
    """The one of these that a name was probably meant to be, in brackets; nothing where none is near."""
    meant = [each for each in (name.lower(), ALSO.get(name.lower())) if each in known]
    alike = [each for each in known if each[:1].lower() == name[:1].lower()]  # few slips are made in the first letter
    close = meant or get_close_matches(name.lower(), alike, n=1, cutoff=0.5)
    return f" (did you mean {close[0]}?)" if close else ""


def _meant(whole: Schema, place: Sequence[int | str], known: Sequence[str]) -> str:
    """Which field was probably meant: one of that name in a table that belongs there, or one of a name like it."""
    *around, name = place
    inside = [f"{table}.{name}" for table in known if name in _known(whole, [*around, table])]
    if inside:
        return f" (did you mean {inside[0]}?)"
    return nearest(str(name), known)


def _known(whole: Schema, place: Sequence[int | str]) -> list[str]:
    """The fields of the table at a place, in any form that it may have."""
    return list(dict.fromkeys(name for schema in _at(whole, whole, place) for name in schema.get("properties", ())))


def _row(whole: Schema, place: Sequence[int | str]) -> str:
    """A row that may stand at a place, ``[state, next, reward]`` or ``of 2 entries``; nothing where none may."""
    for form in _at(whole, whole, place):
        if "prefixItems" in form:
            entries = [entry.get("description", "") for entry in form["prefixItems"]]
            return f"[{', '.join(entries)}]" if all(entries) else f"of {len(entries)} entries"
    return ""


def _at(whole: Schema, schema: Schema, place: Sequence[int | str]) -> Iterator[Schema]:
    """What may stand at a place, in any form that what is around it may have."""
    if "$ref" in schema:
        schema = whole["$defs"][schema["$ref"].rpartition("/")[2]]
    if not place:
        yield schema
    for form in (*schema.get("anyOf", ()), *schema.get("oneOf", ())):
        yield from _at(whole, form, place)
    if place:
        step, *rest = place
        whose = schema.get("properties", {}).get(step, schema.get("additionalProperties"))
        inner = schema.get("items") if isinstance(step, int) else whose
        if isinstance(inner, dict):
            yield from _at(whole, inner, rest)


def says(fault: Mapping[str, Any]) -> str:
    """What is said of one of the faults that pydantic lists: what is wrong, and what to do."""
    kind, given, context = fault["type"], fault["input"], fault.get("ctx", {})
    if kind in ("too_short", "too_long") and not isinstance(given, str):
        return _counted(kind, len(given), context)
    if kind in ("too_short", "too_long"):
        kind = kind.replace("too", "string_too")
    if kind == "string_pattern_mismatch":
        signs = "neither $ nor a backslash" if "$" in context["pattern"].removesuffix("$") else "no backslash"
        return f"may hold {signs}; take them out"
    if kind == "int_type" and isinstance(given, str) and given.isdecimal():
        return f"{called(given)} is a text; write {given}, without quotes"
    if kind not in _SAYS:
        return str(fault["msg"]).removeprefix("Value error, ").removesuffix(".")
    listed = _as_list(given) if isinstance(given, str | int) else "[1, 2]"
    about = {key: str(value).lower() if key == "class_name" else value for key, value in context.items()}
    return _SAYS[kind].format(**about, given=called(given), listed=listed, length=len(str(given)))


def _as_list(given: str | int) -> str:
    """What was given without brackets, or with quotes around all of it, as the list that was meant."""
    entries = [given]
    if isinstance(given, str):
        inside = given.strip(" []()")
        entries = (_SPACED if _NUMBERS.fullmatch(inside) else _BETWEEN).split(inside)
    shown = [called(entry) for entry in entries[:_SHOWN]]
    return f"[{', '.join([*shown, '…'] if len(entries) > _SHOWN else shown)}]"


def _counted(kind: str, count: int, told: Mapping[str, Any]) -> str:
    """What to say of a list or table that has too few or too many entries."""
    bound = told["min_length" if kind == "too_short" else "max_length"]
    has = "is empty" if count == 0 else f"has {count} {_entries(count)}"
    if kind == "too_short":
        return f"{has}; it needs at least {bound} {_entries(bound)}"
    return f"{has}; it may have at most {bound} {_entries(bound)}"


def _entries(count: int) -> str:
    return "entry" if count == 1 else "entries"


def _brief(step: object) -> str:
    text = "".join(sign if sign.isprintable() else repr(sign)[1:-1] for sign in str(step))
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}…"
