"""Models as the arrays of pymdptoolbox: P of shape (A, S, S), and R of shape (S,), (S, A) or (A, S, S)."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

from rldrill.problems.readings import is_zero, several
from rldrill.problems.transition_tables import ALONE

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
    extra = set(data) - {"P", "R", "terminal", "story"}
    if extra:
        raise ValueError(f"{min(extra)!r} is not understood beside the arrays P and R; take it out")
    if "R" not in data:
        raise ValueError("R, the array of rewards, is missing beside P; add it")
    P, R, names = nested(data["P"]), nested(data["R"]), None
    if isinstance(P, Mapping):
        names = [str(name) for name in P]
        P, R = list(P.values()), _by_action(R, names)
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
    terminal = [str(state) for state in several(data.get("terminal", ()))]
    rows = [
        [
            str(s),
            ALONE if alone else names[a] if names else str(a),
            str(after),
            chance,
            R[s] if len(kind) == 1 else R[s][a] if len(kind) == 2 else R[a][s][after],
        ]
        for s in range(states)
        if str(s) not in terminal
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
            if not open_:
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


def _by_action(R: Any, names: Sequence[str]) -> Any:
    """Rewards by the names of the actions, as R[s][a] or R[a][s][s′]; others as they are."""
    if not isinstance(R, Mapping):
        return R
    if missing := [name for name in names if name not in map(str, R)]:
        raise ValueError(f"R: the rewards of {missing[0]!r} are missing; add them")
    rows = {str(name): row for name, row in R.items()}
    found = [rows[name] for name in names]
    return [list(row) for row in zip(*found, strict=True)] if len(_shape(found)) == 2 else found


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
