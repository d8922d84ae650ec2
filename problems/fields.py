"""What the files of a family hold, field by field, from the models that read them."""

import json
from collections.abc import Iterator, Mapping
from typing import Any

from msgspec import Struct

from rldrill.problems.catalogue import family as family_of
from rldrill.problems.draws import Draws
from rldrill.problems.family import Family

Schema = Mapping[str, Any]

#: How many problems of every level are drawn to take examples from.
_DRAWN = 6


class FileField(Struct, frozen=True):
    """A field of a problem file.

    Args:
        path: where it stands, such as ``trajectory.rewards``; ``[i]`` is any entry of a list, ``NAME`` any name.
        takes: what its value is, in words.
        default: what it is where it is not given, as files write it; None where it must be given.
        means: what it means, in a sentence.
        example: a value that it may have, as files write it.
        form: of which form of its table it is, a sentence; empty where there is only one.
    """

    path: str
    takes: str
    default: str | None
    means: str
    example: str
    form: str = ""


def fields(family: str) -> tuple[FileField, ...]:
    """Every field of a family's files, those of tables within tables after these.

    Raises:
        UsageError: there is no such family.
    """
    found = family_of(family)
    schema = found.schema()
    return tuple(_Reader(schema.get("$defs", {})).fields(schema, "", tuple(_drawn(found))))


def _drawn(family: Family) -> Iterator[Any]:
    """Givens of some problems, as files have them: where examples come from."""
    for level in family.levels:
        for number in range(_DRAWN):
            given = family.draw(level, Draws(f"{family.name}/{level}/{number}"))
            yield given.model_dump(mode="json", exclude_defaults=True)


class _Reader(Struct, frozen=True):
    """Reads a JSON Schema, whose named parts are these."""

    parts: Mapping[str, Schema]

    def fields(self, schema: Schema, path: str, drawn: tuple[Any, ...], of: str = "") -> Iterator[FileField]:
        """The fields of a table, or of each of its forms, with the values that problems have there."""
        forms = self._forms(schema)
        for form in forms:
            known = form["properties"]
            needed = [*form.get("required", ()), *form.get("else", {}).get("required", ())]
            alike = [given for given in drawn if isinstance(given, dict) and set(given) <= set(known)]
            whole = [given for given in alike if self._has_shape(form, given)]
            values = {
                name: tuple(given[name] for given in whole if name in given)
                or tuple(inner.get("examples", ()))
                or tuple(given[name] for given in alike if name in given and self._fits(inner, given[name]))
                for name, inner in known.items()
            }
            place = path.rstrip(".") or "given"
            told = f"{place}, in this form: {_sentence(form)}" if len(forms) > 1 else of
            for name, inner in known.items():
                yield self._field(f"{path}{name}", inner, values[name], needed=name in needed, form=told)
            for name, inner in known.items():
                yield from self._within(f"{path}{name}", inner, values[name], told)

    def _field(self, path: str, schema: Schema, values: tuple[Any, ...], *, needed: bool, form: str) -> FileField:
        default = None if needed else _written(schema.get("default", {}))
        example = [*values, *self._made(schema), ""][0]
        return FileField(path, self.words(schema), default, schema.get("description", ""), _written(example), form)

    def _within(self, path: str, schema: Schema, values: tuple[Any, ...], of: str) -> Iterator[FileField]:
        """The fields of the tables that a field holds, alone, in a list or by names."""
        if self._forms(schema):
            yield from self.fields(schema, f"{path}.", values, of)
            return
        for each in self._alternatives(schema):
            if isinstance(each.get("items"), dict):
                yield from self._within(f"{path}[i]", each["items"], tuple(v for value in values for v in value), of)
            elif isinstance(each.get("additionalProperties"), dict):
                inner = tuple(v for value in values for v in value.values())
                yield from self._within(f"{path}.NAME", each["additionalProperties"], inner, of)

    def _made(self, schema: Schema) -> Iterator[Any]:
        """Values of a field that no problem has drawn: the other of two, or what its default is."""
        for each in self._alternatives(schema):
            if each.get("type") == "boolean":
                yield not schema.get("default", False)
            if "enum" in each:
                yield each["enum"][-1]
        if schema.get("default") is not None:
            yield schema["default"]

    def _fits(self, schema: Schema, value: Any) -> bool:
        """Whether a value, its tables and theirs have the fields that a schema knows, and lists where it has lists."""
        return value is None or any(self._has_shape(each, value) for each in self._alternatives(schema))

    def _has_shape(self, schema: Schema, value: Any) -> bool:
        if "anyOf" in schema:
            return self._fits(schema, value)
        kind = schema.get("type", "")
        if isinstance(value, dict):
            known, others = schema.get("properties", {}), schema.get("additionalProperties", True)
            held = [(known.get(name, others), each) for name, each in value.items()]
            return (
                "object" in kind
                and set(schema.get("required", ())) <= set(value)
                and all(self._fits(inner, each) if isinstance(inner, dict) else bool(inner) for inner, each in held)
            )
        if not isinstance(value, list):
            return kind not in ("array", "object")
        entries = schema.get("prefixItems")
        if entries is not None:
            return len(value) == len(entries)
        return "array" in kind and all("items" not in schema or self._fits(schema["items"], each) for each in value)

    def _resolved(self, schema: Schema) -> Schema:
        return self.parts[schema["$ref"].rpartition("/")[2]] if "$ref" in schema else schema

    def _alternatives(self, schema: Schema) -> list[Schema]:
        """What a value may be, other than nothing."""
        schema = self._resolved(schema)
        found = schema.get("anyOf") or schema.get("oneOf") or [schema]
        return [self._resolved(each) for each in found if each.get("type") != "null"]

    def _forms(self, schema: Schema) -> list[Schema]:
        """The forms of a table."""
        found = []
        for each in self._alternatives(schema):
            found += [each] if "anyOf" not in each else self._forms(each)
        return [each for each in found if "properties" in each]

    def words(self, schema: Schema) -> str:
        """What a value is, in words."""
        if "title" in schema and schema.get("type") != "null" and "properties" not in schema:
            return str(schema["title"])
        found = self._alternatives(schema)
        if len(found) > 1:
            told = list(dict.fromkeys(map(self.words, found)))
            return told[0] if len(told) == 1 else f"either {' or '.join(told)}"
        (each,) = found
        if each is not schema and "title" in each and "properties" not in each:
            return str(each["title"])
        if "const" in each:
            return _written(each["const"])
        if "enum" in each:
            return " or ".join(map(_written, each["enum"]))
        match each.get("type"):
            case "array":
                return self._list(each)
            case "object":
                return self._table(each)
            case "integer":
                return f"a whole number{_range(each, 'minimum', 'maximum')}"
            case "boolean":
                return "true or false"
            case "string":
                return f"a text{_range(each, 'minLength', 'maxLength', ' characters')}"
        return "a value"

    def _list(self, schema: Schema) -> str:
        if "prefixItems" in schema:
            entries = [entry.get("description") or self.words(entry) for entry in schema["prefixItems"]]
            return f"a list [{', '.join(entries)}]"
        return f"a list{_range(schema, 'minItems', 'maxItems', ' entries')}, each {self.words(schema['items'])}"

    def _table(self, schema: Schema) -> str:
        if "properties" in schema:
            return "a table"
        held = schema.get("additionalProperties")
        size = _range(schema, "minProperties", "maxProperties", " entries")
        return f"a table{size}, for every name {self.words(held)}" if isinstance(held, dict) else f"a table{size}"


def _range(schema: Schema, low: str, high: str, unit: str = "") -> str:
    """How small and how large, or how short and how long."""
    least, most = schema.get(low), schema.get(high)
    if least is not None and most is not None:
        of = "of" if unit else "from"
        return f" {of} {least}{unit}" if least == most else f" {of} {least} to {most}{unit}"
    if most is not None:
        return f" of at most {most}{unit}" if unit else f", at most {most}"
    if least == 1 and unit:
        return " that is not empty"
    if least:
        return f" of at least {least}{unit}" if unit else f", at least {least}"
    return ""


def _sentence(schema: Schema) -> str:
    """The first sentence of what is said of a table."""
    return str(schema.get("description", "")).partition("\n")[0]


def _written(value: Any) -> str:
    """A value as TOML and JSON have it."""
    return "nothing" if value is None else json.dumps(value, ensure_ascii=False)
