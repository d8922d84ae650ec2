"""The forms in which people have models, beside the list of transitions: each becomes that list."""

from collections.abc import Mapping, Sequence
from typing import Any

from rldrill.problems import arrays, gymnasium
from rldrill.problems.exact import is_scalar, read_scalar
from rldrill.problems.grids import read_grid
from rldrill.problems.readings import Note, several
from rldrill.problems.row_texts import rows_of
from rldrill.problems.transition_tables import ALONE, read_markdown_table, read_records, read_transition_table

_ROW = "[state, action, next, probability, reward]"

_REWARDS_SCHEMA: dict[str, Any] = {
    "type": "object",
    "description": "Transitions without rewards, and beside them the rewards of states or of their actions.",
    "properties": {
        "transitions": {
            "type": ["array", "object", "string"],
            "title": "a list, each [state, action, next, probability], or [state, next, probability] without actions",
            "description": "The transitions; those of a state and action have probabilities that sum to 1.",
            "examples": [[["low", "wait", "low", 1]]],
        },
        "rewards": {
            "type": "object",
            "title": "a table, for every state a number, or a table of its actions with a number for each",
            "description": "What is earned in every state, or by every action there.",
            "examples": [{"low": 1}],
        },
        "rewards_on": {
            "enum": ["leaving", "entering"],
            "default": "leaving",
            "description": "Whether the reward of a state is earned by what is done there, or by coming there.",
        },
        "terminal": arrays.SCHEMA["properties"]["terminal"],
        "story": arrays.SCHEMA["properties"]["story"],
    },
    "required": ["transitions", "rewards"],
    "additionalProperties": False,
}
_ALONE_SCHEMA = {
    "type": "object",
    "description": "Transitions of a process without actions.",
    "properties": {
        "transitions": {
            "type": "array",
            "items": {
                "type": "array",
                "title": "a list [state, next, probability, reward]",
                "prefixItems": [{}, {}, {}, {}],
                "minItems": 4,
                "maxItems": 4,
            },
            "description": "The transitions; those of a state have probabilities that sum to 1.",
            "examples": [[["low", "high", "1/2", 1], ["low", "off", "1/2", 0], ["high", "low", 1, 2]]],
        },
        "terminal": arrays.SCHEMA["properties"]["terminal"] | {"examples": [["off"]]},
        "story": arrays.SCHEMA["properties"]["story"],
    },
    "required": ["transitions"],
    "additionalProperties": False,
}
_FILE_SCHEMA = {
    "type": "object",
    "description": "A file beside the problem file that holds the model; what stands beside it goes before.",
    "properties": {
        "file": {
            "type": "string",
            "title": "a text",
            "description": "Its name, seen from the folder of the problem file.",
            "examples": ["model.csv"],
        },
        "terminal": arrays.SCHEMA["properties"]["terminal"],
        "story": arrays.SCHEMA["properties"]["story"],
    },
    "required": ["file"],
}
#: The forms but for the list of transitions and the grid, as JSON Schema.
SCHEMAS = (_ALONE_SCHEMA, _REWARDS_SCHEMA, arrays.SCHEMA, gymnasium.TABLE_SCHEMA, gymnasium.SCHEMA, _FILE_SCHEMA)


def read_form(data: object, note: Note) -> Any:
    """The transitions of a model that is given in another form; anything else as it is.

    Args:
        data: the model, as a file holds it.
        note: told what is read otherwise than it is written.

    Raises:
        ValueError: the form is known, but does not fit.
    """
    data = read_dynamics(data)
    if not isinstance(data, dict):
        return data
    if "file" in data:
        raise ValueError("a file is read for problems that stand in a file themselves; give the transitions here")
    if "grid" in data:
        return read_grid(data, note)
    if "P" in data and "gymnasium" not in data:
        return _read_P(data, note)
    if "gymnasium" in data:
        return gymnasium.read_environment(data)
    if "rewards" in data:
        return _read_rewards(data)
    return _read_transitions(data, note) if "transitions" in data else data


def read_dynamics(data: object) -> object:
    """What is given of the transitions: rows or a table alone, tables inside tables by name; else as it is.

    Raises:
        ValueError: it is a table that does not fit.
    """
    if isinstance(data, list) or (isinstance(data, str) and "\n" in data.strip()):
        data = {"transitions": data}
    if not isinstance(data, dict):
        return data
    rows = data.get("transitions")
    if isinstance(rows, Mapping):
        return data | {"transitions": _opened(rows, several(data.get("terminal", ())))}
    if isinstance(rows, str) or (isinstance(rows, list) and rows and all(isinstance(row, Mapping) for row in rows)):
        read = _read_table(rows)
        return {name: field for name, field in read.items() if field or name == "transitions"} | {
            name: field for name, field in data.items() if name != "transitions"
        }
    return data


def _opened(table: Mapping[Any, Any], ends: Sequence[Any]) -> list[list[Any]]:
    """The rows of tables inside tables: by state, action and next state a probability, or it with the reward.

    Where an action leads for sure its next state is enough; where there are no actions the next states come first.
    """
    rows: list[list[Any]] = []
    sure = _leads_for_sure(table, {*map(str, table), *map(str, ends)})
    for state, inner in table.items():
        for name, leaf in inner.items() if isinstance(inner, Mapping) else [(None, inner)]:
            if isinstance(leaf, Mapping):
                rows += [[state, name, after, *_chance(each)] for after, each in leaf.items()]
            elif name is not None and (sure or (isinstance(leaf, str) and not is_scalar(leaf))):
                rows.append([state, name, leaf, 1])
            elif name is not None:
                rows.append([state, name, *_chance(leaf)])
            else:
                raise ValueError(f"transitions: {state!r} must have a table of its actions")
    return rows


def _leads_for_sure(table: Mapping[Any, Any], states: set[str]) -> bool:
    """Whether names that are numbers or letters can only be next states: of each action one, and not all are 1."""
    inner = [each for each in table.values() if isinstance(each, Mapping)]
    leaves = {str(leaf) for each in inner for leaf in each.values() if not isinstance(leaf, Mapping | list | tuple)}
    actions = {str(name) for each in inner for name in each}
    reached = all(leaf in states or not is_scalar(leaf) for leaf in leaves)
    return reached and bool(leaves - {"1"}) and not actions & states


def _chance(leaf: object) -> list[Any]:
    return list(leaf) if isinstance(leaf, list | tuple) else [leaf]


def _read_P(data: Mapping[str, Any], note: Note) -> dict[str, Any]:
    P = data["P"]
    if isinstance(P, Mapping) and not all(map(arrays.is_square, P.values())):
        if any(
            not isinstance(row, Mapping) or any(isinstance(leaf, list) for leaf in row.values()) for row in P.values()
        ):
            return gymnasium.read_table(data)
        rest = {("rewards" if name == "R" else name): field for name, field in data.items() if name != "P"}
        return read_form(rest | {"transitions": _opened(P, several(data.get("terminal", ())))}, note)
    model = arrays.read_arrays(data)
    P = arrays.nested(P)
    if isinstance(P, list | tuple) and isinstance(P[0][0], list | tuple) and len(P) == len(P[0]):
        R = " and R for R[state][action]" if arrays.is_square(data["R"]) else ""
        note(f"took P for P[action][state][next]{R}, as pymdptoolbox has it")  # the other order would fit, too
    return model


def _read_transitions(data: Mapping[str, Any], note: Note) -> dict[str, Any]:
    """Transitions as they are, or of a process without actions.

    The rows of such a process are ``[state, next, probability, reward]``.
    """
    rows = data["transitions"]
    given = dict(data)
    if not isinstance(rows, list | tuple) or not any(isinstance(row, list) and len(row) == 4 for row in rows):
        return given
    states = {str(row[0]) for row in rows if isinstance(row, list) and row} | {
        *map(str, several(data.get("terminal", ())))
    }
    for number, row in enumerate(rows, 1):
        if not isinstance(row, list) or len(row) != 4 or not is_scalar(row[2]) or str(row[1]) not in states:
            raise ValueError(
                f"transitions[{number}]: write {_ROW}; or [state, next, probability, reward] in every row of a "
                "process without actions, whose ends are listed as terminal"
            )
    if all(str(row[2]) in states for row in rows):  # [state, action, next, reward] would fit, too
        note("took rows of four for [state, next, probability, reward], without actions; with actions, write all five")
    given["transitions"] = [[state, ALONE, after, chance, reward] for state, after, chance, reward in rows]
    return given


def _read_table(rows: Any) -> dict[str, Any]:
    if isinstance(rows, str) and (bare := _bare(rows)):
        return {"transitions": bare}
    try:
        if not isinstance(rows, str):
            return read_records(rows)
        return read_markdown_table(rows) if rows.lstrip().startswith("|") else read_transition_table(rows.strip("\n"))
    except ValueError as error:
        raise ValueError(f"transitions: {error}") from None


def _bare(text: str) -> list[list[str]] | None:
    """Rows without a header: state, action, next state, probability, reward; or without the action."""
    for width in (5, 4):
        rows = rows_of(text, [""] * width)
        if rows and all(is_scalar(each) for row in rows for each in row[-2:]):
            return rows
    return None


def _read_rewards(data: Mapping[str, Any]) -> dict[str, Any]:
    """Transitions without rewards, and beside them the rewards of states, R(s), or of their actions, R(s, a).

    A reward of a state is earned by whatever is done there; or, with ``rewards_on = "entering"``, by coming there.

    Raises:
        ValueError: a reward is missing, is no number, or is given where it is never earned.
    """
    given = dict(data)
    rewards, on = given.pop("rewards"), given.pop("rewards_on", "leaving")
    if on not in ("leaving", "entering"):
        raise ValueError(f"rewards_on: {on!r} is not possible here; write 'leaving' or 'entering'")
    rows = given.get("transitions")
    if not isinstance(rewards, Mapping):
        raise ValueError("rewards: must be a table beside transitions, with a reward for every state")
    if not isinstance(rows, list | tuple):
        raise ValueError("transitions: beside rewards, write a list of rows [state, action, next, probability]")
    paid = {str(state): _checked(reward, state) for state, reward in rewards.items()}
    if on == "entering" and any(isinstance(reward, Mapping) for reward in paid.values()):
        raise ValueError("rewards: those of actions are earned by taking them; leave out rewards_on")
    whole = [_beside_rewards(row, number) for number, row in enumerate(rows, 1)]
    acting, reached = {str(row[0]) for row in whole}, {str(row[2]) for row in whole}
    for state in paid:
        if state not in acting | reached:
            raise ValueError(f"rewards: {state!r} does not occur in the transitions; correct its name")
        if (
            on == "leaving"
            and state not in acting
            and (isinstance(paid[state], Mapping) or read_scalar(paid[state]) != 0)
        ):
            raise ValueError(
                f"rewards: {state!r} is an end, which is never left, so its reward is never earned; set rewards_on = "
                "'entering', or add a transition from it to another end"
            )
    earned = [_earned(paid, str(row[0] if on == "leaving" else row[2]), str(row[1])) for row in whole]
    given["transitions"] = [[*row, reward] for row, reward in zip(whole, earned, strict=True)]
    return given


def _beside_rewards(row: object, number: int) -> list[Any]:
    match row:
        case [state, after, chance] if is_scalar(chance):
            return [state, ALONE, after, chance]
        case [_, _, _, _]:
            return list(row)
    raise ValueError(f"transitions[{number}]: beside rewards, write [state, action, next, probability]; not {_ROW}")


def _checked(reward: object, state: object) -> Any:
    if isinstance(reward, Mapping):
        return {str(action): _checked(each, f"{state}, {action}") for action, each in reward.items()}
    try:
        read_scalar(reward)
    except ValueError as error:
        raise ValueError(f"rewards: that of {state}: {error}") from None
    return str(reward)


def _earned(paid: Mapping[str, Any], state: str, action: str) -> Any:
    if state not in paid:
        raise ValueError(f"rewards: that of {state!r} is missing; write 0 if it is none")
    reward = paid[state]
    if not isinstance(reward, Mapping):
        return reward
    if action not in reward:
        raise ValueError(f"rewards: that of {action!r} in {state!r} is missing; write 0 if it is none")
    return reward[action]
