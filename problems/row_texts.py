"""Rows that are written as one text, as one types or pastes a table, or as a table for each of them."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

#: What may part the cells of a line, the strongest first; else blanks do.
_MARKS = "|\t;,"
_NUMBER = re.compile(r"[-+−]?\.?[0-9]")
_REWARD = re.compile(r"[-+−]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:/[0-9]+)?")
_STEP = re.compile(r"\s*(?:→|->|[,;])\s*|\s+")
_RULE = re.compile(r"(?=[^-]*-)[\s|:+=-]+")
#: What the entries of rows are called elsewhere.
_ALSO = {
    "s": "state", "from": "state", "a": "action", "s'": "next", "s′": "next", "next_state": "next", "to": "next",
    "r": "reward", "p": "probability", "prob": "probability", "θ": "theta", "α": "alpha",
}  # fmt: skip


def rows_of(text: str, names: Sequence[str]) -> list[list[str]] | None:
    """The rows of a text, whose entries stand in the order of the names, or of its first line; else None.

    Raises:
        ValueError: a row has more or fewer entries than the first line has names.
    """
    lines = _lines(text)
    if lines and len(head := called(lines[0], names)) == len(names) > 0:
        for number, row in enumerate(lines[1:], 2):
            if len(row) != len(head):
                raise ValueError(f"row {number} has {len(row)} entries, the header has {len(head)}; make them equal")
        return [[row[head.index(name)] for name in names] for row in lines[1:]] or None
    headed = [not any(map(_NUMBER.match, row)) for row in lines] == [True] + [False] * (len(lines) - 1)
    return lines if lines and not headed and all(len(row) == len(names) for row in lines) else None


def tables_of(text: str, names: Sequence[str]) -> list[dict[str, str]] | None:
    """The same as a table for every line below the first, which has the names of what is given; None if it has not."""
    head, *lines = _lines(text) or [[]]
    known = called(head, names)
    if len(known) != len(head) or not lines or any(len(row) != len(head) for row in lines):
        return None
    return [dict(zip(known, row, strict=True)) for row in lines]


def row_of(table: Mapping[str, Any], names: Sequence[str]) -> list[Any] | None:
    """A row that is written as a table, by the names of its entries; None if they are others."""
    known = called(list(table), names)
    if sorted(known) != sorted(names) or len(table) != len(names):
        return None
    return [list(table.values())[known.index(name)] for name in names]


def run_of(text: str) -> dict[str, list[str]] | None:
    """A run that is written in the order of time, ``A, 0, B, 1`` or ``A left 0 B``; None if it is anything else.

    Names and numbers must take turns, or two names and a number: states that are called by numbers are not told apart.
    """
    words = [word for word in _STEP.split(text.strip(" .\n")) if word]
    kinds = "".join("r" if _REWARD.fullmatch(word) else "n" for word in words)
    names = [word for word, kind in zip(words, kinds, strict=True) if kind == "n"]
    rewards = [word for word, kind in zip(words, kinds, strict=True) if kind == "r"]
    if re.fullmatch("(?:nr)+n?", kinds):
        return {"states": names, "rewards": rewards}
    if re.fullmatch("(?:nnr)+n?n?", kinds):
        return {"states": names[::2], "actions": names[1::2], "rewards": rewards}
    return None


def called(cells: Sequence[str], names: Sequence[str]) -> list[str]:
    """Which of the names each cell is, each once; nothing if one is none."""
    meant = [
        cell if cell in names else _ALSO.get(str(cell).strip().lower(), str(cell).strip().lower()) for cell in cells
    ]
    return meant if set(meant) <= {*names} and len({*meant}) == len(meant) else []


def _lines(text: str) -> list[list[str]]:
    """The cells of the lines; of one line alone semicolons part the rows."""
    lines = [line.strip().strip("|").strip() for line in text.split("\n")]
    lines = [line for line in lines if line and not _RULE.fullmatch(line)]
    if len(lines) == 1 and ";" in lines[0]:
        lines = [line.strip() for line in lines[0].split(";") if line.strip()]
    mark = next((mark for mark in _MARKS if all(mark in line for line in lines)), None)
    return [[cell.strip().strip("'\"") for cell in (line.split(mark) if mark else line.split())] for line in lines]
