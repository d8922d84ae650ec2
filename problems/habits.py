"""What people write in problem files otherwise than models have it, where only one thing can be meant."""

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from rldrill.problems.exact import is_scalar
from rldrill.problems.expressions import GREEK
from rldrill.problems.row_texts import row_of, rows_of, run_of, tables_of

Schema = Mapping[str, Any]

#: What fields are called elsewhere.
ALSO = {
    "discount": "gamma", "discount_factor": "gamma", "step_size": "alpha", "learning_rate": "alpha", "lambda": "lam",
    "λ": "lam", "lambda_": "lam", "behavior": "behaviour", "centers": "centres", "discretization": "discretisation",
    "Qf": "Q_T", "Q_f": "Q_T", "QT": "Q_T", "Q_N": "Q_T", "noise": "slip", "observation": "measurement",
    "iterations": "sweeps", "k": "sweeps", "V": "values", "Q": "values", "V0": "start", "episode": "trajectory",
    "S": "P", "x0": "start", "loglik": "log_likelihood", "logL": "log_likelihood", "log_lik": "log_likelihood",
} | {glyph: name for name, glyph in GREEK.items() if name != "lambda"}  # fmt: skip
#: What stands between the entries of a list that is given as one text; such a text is none of its entries.
_PARTED = re.compile(r"[\s,;]")
#: Brackets around the whole of such a text, and what stands between its numbers for certain.
_AROUND = re.compile(r"^\[([^\[\]]*)\]$")
_BETWEEN, _WHOLE = re.compile(r"\s*;\s*|\s*,\s+"), re.compile(r"\s*[+-]?[0-9]{1,9}\s*")
#: What a schema only says, or gives as values.
_SAID = ("title", "description", "default", "examples", "enum", "const")
#: The fields of a run, which may be written in the order of time.
_RUN = {"states", "rewards"}
#: What the schema of an entry has inside which something may have to be settled.
_INNER = {"properties", "additionalProperties", "enum"}


def settled(given: Any, schema: Schema) -> Any:
    """Givens as the models have them: fields by their names, lists of one entry in brackets, words in their own case.

    Args:
        given: what a file holds.
        schema: the JSON Schema of the givens.

    Raises:
        ValueError: rows that are one text are not equally long; the sentence names the field.
    """
    return _settled(given, [schema], schema.get("$defs", {}))


def written(schema: Schema) -> dict[str, Any]:
    """The JSON Schema of what files may hold as ``settled`` reads it: an entry for a list of one, a text for rows.

    Fields have their own names in it; those of ``ALSO`` are read, and an editor need not offer them.
    """
    return _written(schema, schema.get("$defs", {}))


def _written(schema: Any, parts: Mapping[str, Schema]) -> Any:
    if isinstance(schema, list):
        return [_written(each, parts) for each in schema]
    if not isinstance(schema, dict):
        return schema
    whole = {}
    for key, value in schema.items():
        if key in ("properties", "$defs"):
            whole[key] = {name: _written(each, parts) for name, each in value.items()}
        else:
            whole[key] = value if key in _SAID else _written(value, parts)
    about = {key: whole.pop(key) for key in _SAID if key in whole}
    if schema.get("required") == ["transitions"]:
        rows = whole["properties"]["transitions"]
        tables = {"properties": whole["properties"] | {"transitions": {"anyOf": [rows, {"type": "object"}]}}}
        return about | {"anyOf": [whole | tables, rows]}
    if {*schema.get("properties", ())} >= _RUN:
        return about | {"anyOf": [whole, {"type": "string"}]}
    entries = _entries([schema], parts) if schema.get("type") == "array" else []
    if not entries:
        return whole | about
    rows = any("prefixItems" in entry or "properties" in entry for entry in entries)
    alone = [] if any(entry.get("type") == "array" for entry in entries) else [whole["items"]]
    if any("prefixItems" in entry for entry in entries):
        whole["items"] = {"anyOf": [whole["items"], {"type": "object"}]}
    return about | {"anyOf": [whole, *alone, *([{"type": "string"}] if rows else [])]}


def _settled(value: Any, schemas: Sequence[Schema], parts: Mapping[str, Schema]) -> Any:
    forms = [form for schema in schemas for form in _forms(schema, parts)]
    if not forms:
        return value
    if all(form.get("type") == "array" for form in forms):
        value = _rows(value, _entries(forms, parts))
    if all(form.get("type") == "array" for form in forms) and not isinstance(value, list | tuple):
        entries = _entries(forms, parts)
        value = [value] if _may_be_an_entry(value, entries) else _listed(value, entries)
    if isinstance(value, str) and all({*form.get("properties", ())} >= _RUN for form in forms):
        value = run_of(value) or value
    if isinstance(value, dict):
        return _table(value, forms, parts)
    if isinstance(value, list):
        return _list(value, _entries(forms, parts), parts)
    words = [word for form in forms for word in form.get("enum", ()) if isinstance(word, str)]
    if isinstance(value, str) and all("enum" in form for form in forms):
        return next((word for word in words if word.lower() == value.lower()), value)
    return value


def _forms(schema: Schema, parts: Mapping[str, Schema]) -> Iterator[Schema]:
    """What a value may be, other than nothing."""
    if "$ref" in schema:
        schema = parts[schema["$ref"].rpartition("/")[2]]
    inner = [*schema.get("anyOf", ()), *schema.get("oneOf", ())]
    for each in inner:
        yield from _forms(each, parts)
    if not inner and schema.get("type") != "null":
        yield schema


def _rows(value: Any, entries: Sequence[Schema]) -> Any:
    """The rows, or the tables, of a list that is given as one text; and rows that are given as tables."""
    for entry in entries:
        row = [each.get("description", "") for each in entry.get("prefixItems", ())]
        if isinstance(value, str) and {*entry.get("properties", ())} >= _RUN:
            found: Any = [run_of(line) for line in value.split("\n") if line.strip()]
        elif isinstance(value, str):
            found = rows_of(value, row) if row else tables_of(value, list(entry.get("properties", ())))
        elif row and isinstance(value, list) and all(isinstance(each, dict) for each in value):
            found = [row_of(each, row) for each in value]
        else:
            continue
        if found and all(found):
            return found
    return value


def _entries(forms: Sequence[Schema], parts: Mapping[str, Schema]) -> list[Schema]:
    """What the entries of a list may be."""
    return [entry for form in forms if isinstance(form.get("items"), dict) for entry in _forms(form["items"], parts)]


def _may_be_an_entry(value: Any, entries: Sequence[Schema]) -> bool:
    """Whether a value that is no list can be the one entry of a list; of a list of lists it could be half an entry."""
    if isinstance(value, dict):
        return bool(entries) and all("properties" in entry for entry in entries)
    if isinstance(value, bool) or not isinstance(value, str | int | float) or _PARTED.search(str(value)):
        return False
    return bool(entries) and not any("properties" in entry or entry.get("type") == "array" for entry in entries)


def _listed(value: Any, entries: Sequence[Schema]) -> Any:
    """The entries of a list of names or numbers that is given as one text; what may be a decimal comma parts none."""
    kinds = {_kind(entry) for entry in entries}
    if not isinstance(value, str) or len(kinds) != 1 or "" in kinds:
        return value
    bare = _AROUND.sub(r"\1", " ".join(value.split()))
    if kinds == {"name"} and not re.search(r"[,;]", bare):  # one name of two words, or two names
        return value
    if kinds == {"name"}:
        found = re.split(r"[,;]", bare)
    elif _BETWEEN.search(bare):
        found = _BETWEEN.split(bare)
    elif bare.count(",") > 1 or not re.search(r"[,/]", bare):  # 2 1/2 is a number
        found = re.split(r",|\s+", bare)
    else:
        return value
    whole = kinds == {"integer"} and all(map(_WHOLE.fullmatch, found))
    return [int(entry) if whole else entry.strip() for entry in found]


def _kind(entry: Schema) -> str:
    """Whether the entry of a list is a name, a whole number or any number; nothing for anything else."""
    if entry.get("title") == "a name" or entry.get("type") == "integer":
        return "integer" if entry.get("type") == "integer" else "name"
    return "number" if "number" in entry.get("type", ()) else ""


def _table(value: Mapping[str, Any], forms: Sequence[Schema], parts: Mapping[str, Schema]) -> dict[str, Any]:
    fields = {name for form in forms for name in form.get("properties", ())}
    found: dict[str, Any] = {}
    for key, inner in value.items():
        meant = ALSO.get(str(key), key)
        name = meant if meant in fields and meant not in {*value, *found} and key not in fields else key
        known = [form.get("properties", {}).get(name, form.get("additionalProperties")) for form in forms]
        try:
            found[name] = _settled(inner, [each for each in known if isinstance(each, dict)], parts)
        except ValueError as error:
            raise ValueError(f"{key}: {error}") from None
    return found


def _list(value: list[Any], entries: Sequence[Schema], parts: Mapping[str, Schema]) -> list[Any]:
    rows = [entry["prefixItems"] for entry in entries if "prefixItems" in entry]
    if rows:
        # Numbers alone may be several rows.
        named = any(isinstance(each, str) and not is_scalar(each) for each in value)
        alone = named and len(value) in map(len, rows) and not any(isinstance(each, list | dict) for each in value)
        return [value] if alone else value
    deeper = any(_INNER & entry.keys() or _has_numbers(entry, parts) for entry in entries)
    return [_settled(each, entries, parts) for each in value] if deeper else value


def _has_numbers(entry: Schema, parts: Mapping[str, Schema]) -> bool:
    """Whether an entry is a list of numbers; a name alone may be one of those of a single list of names."""
    return any("number" in inner.get("type", ()) for inner in _entries([entry], parts))
