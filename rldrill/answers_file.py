"""Reads files of typed answers (TOML, JSON, CSV, JSON Lines) into one form: an entry for every answer."""

import csv
import io
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from rldrill.files import DATA_SUFFIXES, parse, parse_line, read_text, shown
from rldrill.problems.errors import FileError, NothingToGrade
from rldrill.problems.identity import looks_like_id

#: What the names of files of answers end in.
SUFFIXES = (".toml", ".json", ".csv", ".jsonl", ".ndjson")
_NAMED = ("student", "problem", "part")
_COLUMNS = (*_NAMED, "answer")
_NEEDED = ("problem", "answer")
_PARTING = re.compile(r"[,;\n]")
_BARE_ID = re.compile(r"^\s*\[?\s*(?:answers\.)?[a-z-]+/[1-3]/\d", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Entry:
    """One answer, as it was typed.

    Args:
        student: who typed it; empty where the file does not say.
        problem: an ID, or the path of a problem file from the folder of the file of answers.
        part: the label of the part; empty where the file leaves it out.
        text: what was typed; blank for no answer.
        line: the line of the file, where its format has one for every answer.
        path: the file of answers.
    """

    student: str
    problem: str
    part: str
    text: str
    line: int | None
    path: Path

    @property
    def where(self) -> str:
        """The place, as sentences name it."""
        return shown(self.path) if self.line is None else f"{shown(self.path)}, line {self.line}"


def read_answers(path: str | Path) -> tuple[Entry, ...]:
    """Every answer in a file, in the file's order.

    Raises:
        FileError: the file cannot be read, or is not a file of answers.
        NothingToGrade: it holds no answers, or blank ones only.
    """
    path = Path(path)
    text = read_text(path, SUFFIXES)
    suffix = path.suffix.lower()
    if not text.strip():
        entries: tuple[Entry, ...] = ()
    elif suffix == ".csv":
        entries = tuple(_csv(text, path))
    elif suffix in DATA_SUFFIXES:
        entries = tuple(_tables(text, path))
    else:
        entries = tuple(_json_lines(text, path))
    if not any(entry.text.strip() for entry in entries):
        raise NothingToGrade(f"{shown(path)}: there are no answers in it; write some, or leave it out.")
    return entries


def _entry(fields: Mapping[str, object], line: int | None, path: Path) -> Entry:
    """An entry from what a file holds.

    Raises:
        FileError: a field is not what it should be.
    """
    place = Entry("", "", "", "", line, path).where
    student, problem, part = (_word(fields.get(column), column, place) for column in _NAMED)
    if not looks_like_id(problem) and Path(problem).suffix.lower() not in DATA_SUFFIXES:
        raise FileError(
            f"{place}: {_quoted(problem)} is neither a problem ID nor a problem file; "
            "IDs look like value-iteration/2/7 (family/level 1-3/seed)."
        )
    text = _typed(fields.get("answer"), f"{place}: the answer to {problem}")
    return Entry(student, problem, part, text, line, path)


def _word(value: object, field: str, place: str) -> str:
    """A name in one line; whole numbers are taken too, for students are often numbered."""
    if value is None:
        return ""
    if isinstance(value, bool) or not isinstance(value, str | int):
        raise FileError(f"{place}: '{field}' must be a text; write it in quotes.")
    word = str(value).strip()
    if not word.isprintable():
        raise FileError(f"{place}: '{field}' holds a character that cannot be printed; retype it.")
    return word


def _typed(value: object, what: str) -> str:
    """An answer as a person would type it: numbers as written, lists and tables in brackets and colons."""
    if isinstance(value, dict):
        return ", ".join(_pairs(value, what))
    if isinstance(value, list):
        entries = ", ".join(_row(item, what) for item in value)
        return f"[{entries}]" if value else ""
    return value if isinstance(value, str) else _scalar(value, what)


def _pairs(table: Mapping[str, object], what: str) -> Iterator[str]:
    for state, value in table.items():
        if isinstance(value, dict):
            for action, number in value.items():
                yield f"({state}, {action}): {_scalar(number, what)}"
        else:
            yield f"{state}: {_scalar(value, what)}"


def _row(value: object, what: str) -> str:
    if isinstance(value, list):
        return f"[{', '.join(_scalar(item, what) for item in value)}]"
    return _scalar(value, what)


def _scalar(value: object, what: str) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, str):
        return f"({value})" if _PARTING.search(value) else value  # one entry must not be read as several
    if isinstance(value, list | dict):
        raise FileError(f"{what} nests too deeply; write numbers, a list, a list of rows or a table.")
    raise FileError(f"{what} is neither a text nor a number; write it in quotes.")


def _tables(text: str, path: Path) -> Iterator[Entry]:
    """TOML and JSON: problem → part → answer, or problem → answer where there is one part."""
    where = shown(path)
    try:
        data = parse(text, path)
    except FileError as error:
        hint = ' Problem IDs stand in quotes: ["td-zero/2/7"].'
        unquoted = path.suffix.lower() == ".toml" and _BARE_ID.search(text)
        raise FileError(f"{error}{hint if unquoted else ''}") from None
    if not isinstance(data, dict):
        raise FileError(f"{where}: a file of answers is a table from problem IDs to answers.")
    student = data.pop("student", None)
    answers = data.pop("answers", None) if "answers" in data else data
    if answers is not data and data:
        raise FileError(f"{where}: {_quoted(next(iter(data)))} stands outside 'answers'; move it in there.")
    if not isinstance(answers, dict):
        raise FileError(f"{where}: 'answers' must be a table from problem IDs to answers.")
    for problem, parts in answers.items():
        for part, answer in parts.items() if isinstance(parts, dict) else [("", parts)]:
            fields = {"student": student, "problem": problem, "part": part, "answer": answer}
            yield _entry(fields, None, path)


def _json_lines(text: str, path: Path) -> Iterator[Entry]:
    """One object a line, with the columns of the CSV as its fields."""
    for number, line in enumerate(text.split("\n"), 1):
        if not line.strip():
            continue
        data = parse_line(line, path, number)
        here = f"{shown(path)}, line {number}"
        if not isinstance(data, dict):
            raise FileError(f'{here}: a line is an object, as in {{"problem": "td-zero/2/7", "answer": "7/2"}}.')
        for field in _NEEDED:
            if field not in data:
                raise FileError(f"{here}: the field '{field}' is missing; give it.")
        yield _entry(data, number, path)


def _csv(text: str, path: Path) -> Iterator[Entry]:
    """A header line that names the columns, then one answer a line."""
    where = shown(path)
    header, records = _records(text, where)
    missing = [column for column in _NEEDED if column not in header]
    if missing:
        raise FileError(
            f"{where}, line 1: the column '{missing[0]}' is missing; "
            f"the first line names the columns: {','.join(_COLUMNS)}."
        )
    for column in _COLUMNS:
        if header.count(column) > 1:
            raise FileError(f"{where}, line 1: the column '{column}' stands twice; keep one of them.")
    for line, fields in records:
        if not any(field.strip() for field in fields):
            continue
        if len(fields) != len(header):
            raise FileError(
                f"{where}, line {line}: {len(fields)} fields where the first line names {len(header)}; "
                "put an answer that holds the separator in double quotes."
            )
        yield _entry(dict(zip(header, fields, strict=True)), line, path)


def _records(text: str, where: str) -> tuple[list[str], Iterator[tuple[int, list[str]]]]:
    """The names of the columns, and the records below; the first line decides what separates."""
    first = text.lstrip("\r\n").partition("\n")[0]
    separator = max(",;\t", key=lambda sign: len(set(_COLUMNS) & set(_names(first.split(sign)))))
    records = _numbered(text, separator, where)
    header = next((fields for _, fields in records if any(map(str.strip, fields))), [])
    return _names(header), records


def _names(fields: Sequence[str]) -> list[str]:
    return [field.strip().strip('"').strip().lower() for field in fields]


def _numbered(text: str, separator: str, where: str) -> Iterator[tuple[int, list[str]]]:
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
    line = 1
    try:
        for fields in reader:
            yield line, fields
            line = reader.line_num + 1
    except csv.Error as error:
        raise FileError(f"{where}, line {line}: its quotes are broken ({error}); mend them.") from None


def _quoted(text: str) -> str:
    return repr(text if len(text) <= 40 else f"{text[:39]}…")
