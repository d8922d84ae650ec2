"""What a family's problem file may hold, in numbers: the limits, defaults and choices of every field."""

from collections.abc import Iterator
from typing import Any

from rldrill.problems.family import Family

_SAYS = (
    "default", "enum", "const", "minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum", "minItems", "maxItems",
    "minProperties", "maxProperties", "minLength", "maxLength", "pattern", "title",
)  # fmt: skip


def limits(family: Family) -> dict[str, dict[str, Any]]:
    """For every place of the family's JSON Schema that limits something: what it says."""
    return {place: {word: said[word] for word in _SAYS if word in said} for place, said in _places(family.schema(), "")}


def _places(schema: Any, place: str) -> Iterator[tuple[str, dict[str, Any]]]:
    if isinstance(schema, list):
        for index, item in enumerate(schema):
            yield from _places(item, f"{place}/{index}")
    if not isinstance(schema, dict):
        return
    if "type" in schema and "properties" not in schema and any(word in schema for word in _SAYS):
        yield place, schema
    for name, below in schema.items():
        if name not in ("default", "examples", "enum"):
            yield from _places(below, f"{place}/{name}".replace("/properties/", ".").replace("/$defs/", ""))
