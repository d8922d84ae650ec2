"""Tables of Gymnasium's toy-text environments as models: written out, or of an environment that is installed."""

from collections.abc import Iterator, Mapping
from typing import Any
from warnings import catch_warnings

from rldrill.problems.grids import OVER
from rldrill.problems.readings import is_zero

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

    A state that is entered where the episode ends is terminal, whatever the table says of it; but where the episode
    also goes on from there, or ends there for who stays only, it ends in a state of its own.

    Raises:
        ValueError: an entry has another form.
    """
    lines = list(_lines(table))
    ended = {after for state, *_, after, _, ends in lines if ends and after != state}
    lived_in = {after for state, *_, after, _, ends in lines if not ends and state not in ended}
    lived_in |= {state for state, *_ in lines if state not in ended}
    lines = [(*line[:3], OVER if line[-1] and line[3] in lived_in else line[3], *line[4:]) for line in lines]
    terminal = {after for *_, after, _, ends in lines if ends}
    return {
        "transitions": [
            [state, action, after, probability, reward]
            for state, action, probability, after, reward, _ in lines
            if state not in terminal and not is_zero(probability)
        ],
        "terminal": sorted(terminal, key=lambda name: (len(name), name)),
    }


def _lines(table: Mapping[Any, Mapping[Any, Any]]) -> Iterator[tuple[str, str, Any, str, Any, bool]]:
    for state, row in table.items():
        if not isinstance(row, Mapping):
            raise ValueError(f"P: {str(state)!r} must have a table of its actions, each with its list of {_ENTRY}")
        for action, outcomes in row.items():
            for number, outcome in enumerate(outcomes if isinstance(outcomes, list | tuple) else [outcomes], 1):
                match outcome:
                    case [probability, after, reward, bool(ends)]:
                        yield str(state), str(action), probability, str(after), reward, ends
                    case _:
                        raise ValueError(f"P: outcome {number} of {action} in {state} must be {_ENTRY}")
