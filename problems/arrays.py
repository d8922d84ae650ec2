"""Models as the arrays of pymdptoolbox: P of shape (A, S, S), and R of shape (S,), (S, A) or (A, S, S)."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

from rldrill.problems.readings import is_zero, several
from rldrill.problems.transition_tables import ALONE

#: P[a][s][s′] has three pairs of brackets.
_DEEPEST = 3
_TOKEN = re.compile(r"[\[\]]|[^\[\],\s]+")
_CALL = re.compile(r"(?:\b(?:np|numpy|jnp)\.)?\barray\(|\)")
_SHAPES = "one number for every state, (S,); for every state and action, (S, A); or shaped like P, (A, S, S)"

#: What a file holds, as JSON Schema.
SCHEMA: dict[str, Any] = {
    "type": "object",
    "description": "The arrays of pymdptoolbox; states and actions are called 0, 1, 2, and so on.",
    "properties": {
        "P": {
            "type": ["array", "object", "string"],
            "title": "a list of a square of rows for every action, of shape (A, S, S)",
            "description": "The probability of every next state, by action and state.",
            "examples": [[[["1/2", "1/2"], [0, 1]]]],
        },
        "R": {
            "type": ["array", "object", "string"],
            "title": "a list of shape (S,), (S, A) or (A, S, S)",
            "description": "The rewards of states, of their actions, or of all that these lead to.",
            "examples": [[1, 0]],
        },
        **{
            each: {
                "type": "array",
                "default": [],
                "title": "a list, each a name",
                "description": f"The names of the {each}, in the order of the arrays; else they are numbers.",
                "examples": [example],
            }
            for each, example in (("states", ["low", "high"]), ("actions", ["wait"]))
        },
        "terminal": {
            "type": "array",
            "default": [],
            "title": "a list, each a name",
            "description": "The states in which an episode ends.",
            "examples": [[1]],
        },
        "story": {
            "type": "string",
            "default": "",
            "description": "A sentence that is printed first.",
            "examples": ["A robot cleans a corridor."],
        },
    },
    "required": ["P", "R"],
    "additionalProperties": False,
}


def read_arrays(data: Mapping[str, Any]) -> dict[str, Any]:
    """Arrays P[a][s][s′] and R as the transitions of a model; states and actions are called 0, 1, 2, …

    A process without actions has P[s][s′].

    Rewards of states, R[s], and of actions, R[s][a], are earned by what is done there. An array cannot say in which
    states an episode ends: they may be listed as ``terminal``, and are else states like the others.

    Raises:
        ValueError: the arrays do not fit each other.
    """
    extra = set(data) - {"P", "R", "states", "actions", "terminal", "story"}
    if extra:
        raise ValueError(f"{min(extra)!r} is not understood beside the arrays P and R; take it out")
    if "R" not in data:
        raise ValueError("R, the array of rewards, is missing beside P; add it")
    P, R = nested(data["P"]), nested(data["R"])
    state, action = ([str(name) for name in several(data.get(each, ()))] for each in ("states", "actions"))
    if isinstance(P, Mapping):
        P, action = _in_order({str(name): square for name, square in P.items()}, action)
    if isinstance(R, Mapping):
        if {*map(str, R)} == {*state} == {*action}:
            raise ValueError("R: its names are those of states and of actions; write it as a list R[state][action]")
        R = _by_name(R, state) if {*map(str, R)} == {*state} else _by_action(_by_name(R, action))
    shape = _shape(P)
    alone = len(shape) == 2 and shape[0] == shape[1]
    if alone:
        P, R, shape = [P], [R] if _shape(R) == shape else R, (1, *shape)
    if len(shape) != 3 or shape[1] != shape[2]:
        raise ValueError(f"P has the shape {_told(shape)}; it must be (A, S, S), a square of S states for each action")
    actions, states, _ = shape
    kind = _shape(R)
    if kind not in ((states,), (states, actions), shape):
        raise ValueError(f"R has the shape {_told(kind)}, which does not fit P's {_told(shape)}; give {_SHAPES}")
    terminal = [str(each) for each in several(data.get("terminal", ()))]
    state, action = _named(state, states, "states"), [ALONE] if alone else _named(action, actions, "actions")
    rows = [
        [
            state[s],
            action[a],
            state[after],
            chance,
            R[s] if len(kind) == 1 else R[s][a] if len(kind) == 2 else R[a][s][after],
        ]
        for s in range(states)
        if state[s] not in terminal
        for a in range(actions)
        for after, chance in enumerate(P[a][s])
        if not is_zero(chance)
    ]
    return {"transitions": rows, "terminal": terminal} | {key: data[key] for key in ("story",) if key in data}


def nested(array: Any) -> Any:
    """An array, or a table of arrays, in which a text such as ``[[1, 0], [0, 1]]`` is the lists that it shows.

    Raises:
        ValueError: its brackets do not fit.
    """
    if isinstance(array, Mapping):
        return {name: nested(each) for name, each in array.items()}
    if not isinstance(array, str):
        return array
    if ";" in array and array.count("[") < 2:  # [1 0; 0 1]
        return [_TOKEN.findall(row.strip(" []\n")) for row in array.split(";")]
    open_: list[list[Any]] = [[]]
    for token in _TOKEN.findall(_CALL.sub(" ", array)):
        if token == "[":
            open_.append([])
        elif token == "]":
            inner = open_.pop()
            if not open_ or len(open_) > _DEEPEST:
                break
            open_[-1].append(inner)
        else:
            open_[-1].append(token)
    if len(open_) != 1 or len(open_[0]) != 1:
        raise ValueError(f"the brackets of the array {array.strip()[:20]!r} do not fit; write [[1, 0], [0, 1]]")
    return open_[0][0]


def is_square(array: Any) -> bool:
    """Whether an array has two indices and as many rows as columns, so that nobody sees which are which."""
    try:
        shape = _shape(nested(array)) if isinstance(array, list | str) else ()
    except ValueError:
        return False
    return len(shape) == 2 and shape[0] == shape[1]


def _named(names: list[str], count: int, what: str) -> list[str]:
    """The names of states or actions; their numbers from 0 where none are given."""
    if names and (len(names) != count or len({*names}) != count):
        raise ValueError(f"{what}: {len(names)} names are given for {count} {what}; give each its own")
    return names or [str(number) for number in range(count)]


def _in_order(squares: Mapping[str, Any], names: list[str]) -> tuple[list[Any], list[str]]:
    """The squares of actions in the order of their names, which stand beside their numbers or are their own.

    Raises:
        ValueError: other names are given for them.
    """
    if not names or list(squares) == [str(number) for number in range(len(names))]:
        return [*squares.values()], names or [*squares]
    if {*squares} != {*names} or len(squares) != len(names):
        raise ValueError(f"actions: {', '.join(names)} are not those of P, {', '.join(squares)}; make them the same")
    return [squares[name] for name in names], names


def _by_name(R: Mapping[Any, Any], names: Sequence[str]) -> list[Any]:
    """Rewards in the order of the names."""
    rows = {str(name): row for name, row in R.items()}
    if unknown := [name for name in rows if name not in names]:
        raise ValueError(f"R: {unknown[0]!r} is the name of no state and of no action; give states and actions, too")
    if missing := [name for name in names if name not in rows]:
        raise ValueError(f"R: the rewards of {missing[0]!r} are missing; add them")
    return [rows[name] for name in names]


def _by_action(R: list[Any]) -> list[Any]:
    """Rewards R[a][s] as R[s][a]; R[a][s][s′] as they are."""
    return [list(row) for row in zip(*R, strict=True)] if len(_shape(R)) == 2 else R


def _shape(array: object) -> tuple[int, ...]:
    """The lengths of nested lists.

    Raises:
        ValueError: lists of one depth differ in length.
    """
    if not isinstance(array, Sequence) or isinstance(array, str):
        return ()
    shapes = {_shape(row) for row in array}
    if len(shapes) > 1:
        raise ValueError("an array has rows of different lengths; make them equal")
    return (len(array), *(shapes.pop() if shapes else ()))


def _told(shape: tuple[int, ...]) -> str:
    return f"({', '.join(map(str, shape))}{',' * (len(shape) == 1)})"
