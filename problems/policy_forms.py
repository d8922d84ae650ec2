"""The forms in which people have policies, beside the table by states: each becomes that table."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

from rldrill.problems.exact import is_scalar
from rldrill.problems.readings import Note

_PARTED = re.compile(r"[,;\n](?![^()\n]*\))")
#: An action behind its state: A: left, A -> left, π(A) = left.
_PAIR = re.compile(
    r"\s*(?:(?:π|pi)\((?P<inside>[^()]*)\)|(?P<state>(?:[^:=→>-]|-(?!>))+?))\s*(?::|=|->|→)\s*(?P<action>\S.*?)\s*"
)


def by_states(policy: object, actions: Mapping[str, Sequence[str]], note: Note) -> object:
    """A policy as a table by states; anything that is in no form that is known, as it is.

    Args:
        policy: what a file holds, such as ``"A: left, B: right"``, ``[["A", "left"], ["B", "right"]]``, an action for
            every state in their order, or a row of probabilities for every state.
        actions: the actions of every state, in their order.
        note: told where the order of the states was taken for granted.

    Raises:
        ValueError: an action has two probabilities in a state.
    """
    rows = _rows(policy)
    if rows is None:
        return policy
    named, ordered = _named(rows, actions), _ordered(rows, actions)
    if ordered is not None and named is None:
        each = ", ".join(dict.fromkeys(action for row in actions.values() for action in row))
        note(f"took the policy in the order of the states {', '.join(actions)} and of the actions {each}")
        return ordered
    return policy if named is None or ordered is not None else named  # [[1, 0], [0, 1]] may be either


def _ordered(rows: Sequence[Sequence[Any]], actions: Mapping[str, Sequence[str]]) -> dict[str, Any] | None:
    """What is done in every state, where that is told in their order: an action, or a row of probabilities."""
    if len(rows) != len(actions):
        return None
    found = dict(zip(actions, rows, strict=True))
    if all(len(row) == 1 and str(row[0]) in actions[state] for state, row in found.items()):
        return {state: row[0] for state, row in found.items()}
    if all(len(row) == len(actions[state]) > 1 and all(map(is_scalar, row)) for state, row in found.items()):
        return {state: dict(zip(actions[state], row, strict=True)) for state, row in found.items()}
    return None


def _rows(policy: object) -> list[list[Any]] | None:
    """The policy row by row: a state and what is done there, or only what is done; None if it is something else."""
    if isinstance(policy, str):
        pairs = [_PAIR.fullmatch(piece) for piece in _PARTED.split(policy.strip(" ,;\n"))]
        return [[pair["state"] or pair["inside"], pair["action"]] for pair in pairs if pair] if all(pairs) else None
    if not isinstance(policy, list | tuple) or not policy:
        return None
    return [list(row) if isinstance(row, list | tuple) else [row] for row in policy]


def _named(rows: Sequence[Sequence[Any]], actions: Mapping[str, Sequence[str]]) -> dict[str, Any] | None:
    """What is done in every state, by rows of a state and its action, or of these and a probability."""
    found: dict[str, Any] = {}
    for state, *said in rows:
        if str(state) not in actions or len(said) != len(rows[0]) - 1:
            return None
        if len(said) == 2:
            if str(said[0]) in found.get(str(state), ()):
                raise ValueError(f"{said[0]!r} stands twice in {state!r}; keep one of them")
            found.setdefault(str(state), {})[str(said[0])] = said[1]
        elif len(said) == 1 and str(state) not in found:
            found[str(state)] = said[0]
        else:
            return None
    return found
