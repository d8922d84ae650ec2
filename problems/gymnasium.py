"""Tables of Gymnasium's toy-text environments as models: written out, or of an environment that is installed."""

import re
from collections.abc import Iterator, Mapping
from typing import Any
from warnings import catch_warnings

from rldrill.problems.episodes import Outcome, model

_ENTRY = "[probability, next state, reward, whether the episode ends]"


#: What a file holds, as JSON Schema.
SCHEMA: dict[str, Any] = {
    "type": "object",
    "description": "A toy-text environment of gymnasium, where gymnasium is installed.",
    "properties": {
        "gymnasium": {
            "type": "string",
            "description": "The ID of the environment.",
            "examples": ["FrozenLake-v1"],
        },
        "options": {
            "type": "object",
            "default": {},
            "title": "a table",
            "description": "What the environment is made with.",
            "examples": [{"is_slippery": True}],
        },
    },
    "required": ["gymnasium"],
    "additionalProperties": False,
}

#: The same of a table that is written out.
TABLE_SCHEMA: dict[str, Any] = {
    "type": "object",
    "description": "Gymnasium's table P, written out.",
    "properties": {
        "P": {
            "type": "object",
            "title": f"a table, for every state a table, for every action a list, each {_ENTRY}",
            "description": "What every action may lead to in every state.",
            "examples": [{"0": {"0": [["1/2", 0, 0, False], ["1/2", 1, 1, True]]}}],
        },
    },
    "required": ["P"],
    "additionalProperties": False,
}


def read_environment(data: Mapping[str, Any]) -> dict[str, Any]:
    """The table ``P`` of an environment as the transitions of a model.

    Args:
        data: ``gymnasium`` is the environment's ID, such as ``FrozenLake-v1``; ``options``, what it is made with.

    Raises:
        ValueError: gymnasium is not installed, there is no such environment, or it has no table.
    """
    extra = set(data) - {"gymnasium", "options"}
    if extra:
        raise ValueError(f"{min(extra)!r} is not understood beside 'gymnasium'; give 'options' only")
    if not re.fullmatch(r"[\w./-]+", str(data["gymnasium"])):  # before a colon it would name a module to import
        raise ValueError(
            f"{str(data['gymnasium'])[:40]!r} is not the ID of an environment; write one such as CliffWalking-v1"
        )
    try:
        import gymnasium
    except ImportError:
        raise ValueError("gymnasium is not installed; run 'pip install gymnasium'") from None
    try:
        with catch_warnings(action="ignore"):  # of versions that are out of date
            environment = gymnasium.make(str(data["gymnasium"]), **dict(data.get("options", {})))
    except Exception as error:  # gymnasium and the environments raise whatever they like
        raise ValueError(f"gymnasium cannot make {data['gymnasium']!r}: {error}".partition("\n")[0]) from None
    table = getattr(environment.unwrapped, "P", None)
    if not isinstance(table, Mapping):
        raise ValueError(f"{data['gymnasium']!r} has no table of transitions; toy-text environments have one")
    return from_table(table)


def read_table(data: Mapping[str, Any]) -> dict[str, Any]:
    """A table ``P`` that is written out.

    Raises:
        ValueError: it is no such table.
    """
    extra = set(data) - {"P"}
    if extra:
        raise ValueError(f"{min(extra)!r} is not understood beside Gymnasium's table P; take it out")
    return from_table(data["P"])


def from_table(table: Mapping[Any, Mapping[Any, Any]]) -> dict[str, Any]:
    """A table ``{state: {action: [(probability, next state, reward, ends), …]}}`` as a model's transitions.

    Raises:
        ValueError: an entry has another form.
    """
    read = model(list(_lines(table)))
    return read | {"terminal": sorted(read["terminal"], key=lambda name: (len(name), name))}


def _lines(table: Mapping[Any, Mapping[Any, Any]]) -> Iterator[Outcome]:
    for state, row in table.items():
        if not isinstance(row, Mapping):
            raise ValueError(f"P: {str(state)!r} must have a table of its actions, each with its list of {_ENTRY}")
        for action, outcomes in row.items():
            for number, outcome in enumerate(outcomes if isinstance(outcomes, list | tuple) else [outcomes], 1):
                match outcome:
                    case [probability, after, reward, bool(ends)]:
                        yield Outcome(str(state), str(action), str(after), probability, reward, ends)
                    case _:
                        raise ValueError(f"P: outcome {number} of {action} in {state} must be {_ENTRY}")
