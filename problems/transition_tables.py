"""Tables of transitions, as CSV files, Markdown and data frames hold them, as models: a header, then every outcome."""

import csv
import re
from collections.abc import Iterable, Mapping
from itertools import dropwhile, takewhile
from typing import Any

from rldrill.problems.episodes import Outcome, model

#: The one action of a process without actions.
ALONE = "step"
#: What a column may be called, in small letters without blanks and underscores.
_COLUMNS = {
    "state": "state s from fromstate currentstate source start zustand von",
    "action": "action a act aktion",
    "next": "next nextstate s' s′ s2 sp sprime newstate successor to tostate target folgezustand nach",
    "probability": "probability prob p pr chance wahrscheinlichkeit transitionprobability t t(s,a,s') p(s'|s) "
    "p(s'|s,a)",
    "reward": "reward r rewards rew r(s,a,s') r(s,a) r(s) belohnung",
    "end": "end ends done terminal terminated isterminal",
}
_NAMED = {spelling: column for column, spellings in _COLUMNS.items() for spelling in spellings.split()}
_TRUE, _FALSE = ("1", "true", "yes", "1.0"), ("", "0", "false", "no", "0.0")
#: A decimal comma; 1,000 may be a thousand, and is left to be refused.
_COMMA = re.compile(r"[+−-]?(?![1-9]\d{0,2},\d{3}(?!\d))\d+,\d+\s*%?")
#: The columns of a table without a header, and a number that tells one.
_BARE = tuple(_COLUMNS)[:5]
_BARE_NUMBER = re.compile(r"\s*[+−-]?[\d./,]+\s*%?\s*")
#: What parts the cells of a Markdown table, what sets them off, and the line below its header.
_BAR, _MARKUP, _RULE = re.compile(r"(?<!\\)\|"), re.compile(r"[`*$\\]"), re.compile(r"\s*:?-+:?\s*")


def read_transition_table(text: str) -> dict[str, Any]:
    """A CSV or TSV text as the transitions of a model; the columns stand in any order, parted by ``,``, ``;`` or tabs.

    Raises:
        ValueError: a column is missing or unknown, or a line does not fit; the sentence names the line.
    """
    lines = text.splitlines()
    begin = next((number for number, line in enumerate(lines) if line.strip()), 0)
    if lines and re.fullmatch(r"sep=.", lines[begin].strip(), re.IGNORECASE):
        begin += 1
    while begin < len(lines) - 1 and lines[begin].lstrip()[:1] in ("", "#"):  # a remark, or numpy's header
        if len(cells := re.split("[,;\t]", lines[begin].lstrip(" #"))) > 2 and {*map(_plain, cells)} <= {*_NAMED}:
            lines[begin] = lines[begin].lstrip(" #")
            break
        begin += 1
    header = re.sub(r"\([^()]*\)", "", lines[begin]) if len(lines) > begin else ""  # R(s,a) is one column
    parted = max(",;\t|", key=header.count)
    rows = csv.reader(lines[begin:], delimiter=parted)
    try:
        numbered = ((begin + rows.line_num, row) for row in rows if not all(map(_RULE.fullmatch, row)))
        return _table(numbered, commas=parted != ",")
    except csv.Error as error:
        raise ValueError(f"it is not parted into cells ({error}); look for a quote that is not closed") from None


def read_markdown_table(text: str) -> dict[str, Any]:
    """The first table of a Markdown text, whose lines begin with a bar, as the transitions of a model.

    Raises:
        ValueError: there is no table, or it is wrong as a CSV text may be.
    """
    lines = [(number, line.strip()) for number, line in enumerate(text.splitlines(), 1)]
    found = list(takewhile(lambda each: each[1].startswith("|"), dropwhile(lambda each: each[1][:1] != "|", lines)))
    if not found:
        raise ValueError("there is no table; begin its lines with |, as in | state | action | next | reward |")
    rows = [(number, _BAR.split(line.removeprefix("|").removesuffix("|"))) for number, line in found]
    return _table(
        (
            (number, [_MARKUP.sub("", cell) for cell in row])
            for number, row in rows
            if not all(map(_RULE.fullmatch, row))
        ),
        commas=True,
    )


def _table(lines: Iterable[tuple[int, list[str]]], *, commas: bool) -> dict[str, Any]:
    """A header and its rows, each with the number of its line; where cells may hold decimal commas, these are read."""
    header, *rows = [(number, row) for number, row in lines if any(cell.strip() for cell in row)] or [(1, [])]
    if bare := _bare(header[1]):
        rows = [header, *rows]
    columns = bare or _columns(header[1])
    read = []
    above: dict[str, str] = {}
    for number, row in rows:
        if len(row) != len(header[1]):
            raise ValueError(f"line {number} has {len(row)} entries, the header has {len(header[1])}; make them equal")
        cells = {column: row[place].strip() for place, column in columns.items()}
        for column in ("state", "action"):  # cells that a spreadsheet joined, and emptied but for the first
            if cells.get(column) == "" and (column == "state" or cells["state"] == above.get("state")):
                cells[column] = above.get(column, "")
        above = cells
        for column in ("probability", "reward"):
            if commas and _COMMA.fullmatch(cells.get(column, "")):
                cells[column] = cells[column].replace(",", ".")
        read.append((f"line {number}", cells))
    return _model(read)


def read_records(records: Iterable[Mapping[str, Any]]) -> dict[str, Any]:
    """The same as a list of tables, one for every line, each with the names of the columns.

    Raises:
        ValueError: a column is missing or unknown, or a line does not fit; the sentence names the line.
    """
    read = []
    for number, record in enumerate(records, 1):
        keys = list(record)
        cells = {column: record[keys[place]] for place, column in _columns(keys).items()}
        read.append((f"entry {number}", {column: str(cell) for column, cell in cells.items()}))
    return _model(read)


def _plain(name: str) -> str:
    return re.sub(r"[\s_]", "", name).lower()


def _bare(row: list[str]) -> dict[int, str]:
    """The columns of a table without a header, which begins with numbers for probability and reward; else none."""
    if len(row) != len(_BARE) or {*map(_plain, row)} & {*_NAMED} or not all(map(_BARE_NUMBER.fullmatch, row[-2:])):
        return {}
    return dict(enumerate(_BARE))


def _columns(header: list[str]) -> dict[int, str]:
    """What every column holds, by its place; a column without a name is passed over, as data frames write one."""
    found: dict[int, str] = {}
    for place, name in enumerate(header):
        plain = _plain(name)
        if not plain and place == 0:
            continue
        if plain in ("cost", "costs", "kosten"):
            raise ValueError(
                f"the column {name[:40]!r} holds costs; turn their signs, and call it reward: -5 for a cost of 5"
            )
        if plain not in _NAMED:
            known = ", ".join(_COLUMNS)
            raise ValueError(f"the column {name[:40]!r} is not known; call the columns {known}, or leave it out")
        if _NAMED[plain] in found.values():
            raise ValueError(f"the column {name[:40]!r} is the second of its kind ({_NAMED[plain]}); leave one out")
        found[place] = _NAMED[plain]
    for needed in ("state", "next", "reward"):
        if needed not in found.values():
            raise ValueError(
                f"the column {needed!r} is missing; write a header such as state,action,next,probability,reward"
            )
    return found


def _model(lines: list[tuple[str, dict[str, str]]]) -> dict[str, Any]:
    if not lines:
        raise ValueError("there is no transition below the header; add one")
    rows = []
    for place, cells in lines:
        end = cells.get("end", "").lower()
        if end not in _TRUE + _FALSE:
            raise ValueError(f"{place}: whether the episode ends is {end[:40]!r}; write true or false")
        action, chance = cells.get("action", ALONE), cells.get("probability", "1")
        rows.append(Outcome(cells["state"], action, cells["next"], chance, cells["reward"], end in _TRUE))
    return model(rows)
