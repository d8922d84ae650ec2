"""Gymnasium's toy-text environments as models, where gymnasium is installed."""

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

_FINEST = 1000


#: What a file holds, as JSON Schema.
SCHEMA = {
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
        environment = gymnasium.make(str(data["gymnasium"]), **dict(data.get("options", {})))
    except Exception as error:  # gymnasium and the environments raise whatever they like
        raise ValueError(f"gymnasium cannot make {data['gymnasium']!r}: {error}".partition("\n")[0]) from None
    table = getattr(environment.unwrapped, "P", None)
    if not isinstance(table, Mapping):
        raise ValueError(f"{data['gymnasium']!r} has no table of transitions; toy-text environments have one")
    return from_table(table)


def from_table(table: Mapping[Any, Mapping[Any, Any]]) -> dict[str, Any]:
    """A table ``{state: {action: [(probability, next state, reward, ends), …]}}`` as a model's transitions.

    A state that is entered where the episode ends is terminal, whatever the table says of it. Probabilities
    are read as the simplest fractions that they round.
    """
    terminal = {after for row in table.values() for outcomes in row.values() for _, after, _, ends in outcomes if ends}
    transitions: list[list[Any]] = []
    for state, row in table.items():
        if state in terminal:
            continue
        for action, outcomes in row.items():
            merged: dict[Any, tuple[Fraction, Fraction]] = {}
            for probability, after, reward, _ in outcomes:
                chance = Fraction(probability).limit_denominator(_FINEST)
                total, worth = merged.get(after, (Fraction(0), Fraction(0)))
                merged[after] = total + chance, worth + chance * Fraction(str(reward))
            transitions += [
                [str(state), str(action), str(after), total, worth / total]
                for after, (total, worth) in merged.items()
                if total
            ]
    return {"transitions": transitions, "terminal": [str(state) for state in sorted(terminal)]}
