"""Reads files of typed answers (TOML, JSON, CSV, JSON Lines) into one form: an entry for every answer."""

import csv
import io
import re
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from rldrill.files import DATA_SUFFIXES, parse, parse_line, read_text, shown
from rldrill.problems.errors import FileError, NothingToGrade, UsageError
from rldrill.problems.identity import looks_like_id
from rldrill.typed import typed

#: What the names of files of answers end in.
SUFFIXES = (".toml", ".json", ".csv", ".jsonl", ".ndjson")
_NAMED = ("student", "problem", "part")
_COLUMNS = (*_NAMED, "answer")
_NEEDED = ("problem", "answer")
#: What other programs call the columns, and the two halves of a name.
_ALSO = {
    "problem id": "problem", "id": "problem", "question": "problem", "problem part": "part", "response": "answer",
    "name": "student", "student name": "student", "full name": "student", "student id": "student",
}  # fmt: skip
_FIRST = ("first name", "firstname", "given name", "vorname")
_LAST = ("last name", "lastname", "surname", "family name", "nachname")
_AS_TEXT = re.compile(r'="(.*)"', re.DOTALL)  # so a spreadsheet keeps 0.25 from becoming a date
_SEPARATED = re.compile(r"\s*\"?sep=(.)\"?[,;\t]*\r?\n", re.IGNORECASE)
_POINT = re.compile(r"[0-9]\.[0-9]|(?<![0-9A-Za-z])\.[0-9]")
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
        commas: whether commas may be decimal commas: semicolons part the file's columns, and no answer has a point.
    """

    student: str
    problem: str
    part: str
    text: str
    line: int | None
    path: Path
    commas: bool = False

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
    try:
        text = typed(fields.get("answer"), f"{place}: the answer to {problem}")
    except UsageError as error:
        raise FileError(str(error)) from None
    return Entry(student, problem, part, text, line, path)


def _word(value: object, field: str, place: str) -> str:
    """A name in one line; whole numbers are taken too, for students are often numbered."""
    if value is None:
        return ""
    if isinstance(value, bool) or not isinstance(value, str | int):
        raise FileError(f"{place}: '{field}' must be a text; write it in quotes.")
    word = unicodedata.normalize("NFC", str(value).strip())
    if not word.isprintable():
        raise FileError(f"{place}: '{field}' holds a character that cannot be printed; retype it.")
    return word


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
    separator, first, text = _separator(text)
    records = ((line + first, fields) for line, fields in _numbered(text, separator, where))
    line, named = next(((line, fields) for line, fields in records if any(map(str.strip, fields))), (1, []))
    header = _names(named)
    while header and not header[-1]:
        del header[-1]
    missing = [column for column in _NEEDED if column not in header]
    if missing:
        raise FileError(
            f"{where}, line {line}: the column '{missing[0]}' is missing; "
            f"the first line names the columns: {','.join(_COLUMNS)}."
        )
    for column in _COLUMNS:
        if header.count(column) > 1:
            raise FileError(f"{where}, line {line}: the column '{column}' stands twice; keep one of them.")
    entries = [_record(header, fields, line, path) for line, fields in records if any(map(str.strip, fields))]
    commas = separator == ";" and not any(_POINT.search(entry.text) for entry in entries)
    return (replace(entry, commas=commas) for entry in entries)


def _record(header: Sequence[str], fields: Sequence[str], line: int, path: Path) -> Entry:
    """An answer in a line of a CSV file; spreadsheets leave blank fields at its end."""
    fields = list(fields)
    while len(fields) > len(header) and not fields[-1].strip():
        del fields[-1]
    if len(fields) != len(header):
        raise FileError(
            f"{shown(path)}, line {line}: {len(fields)} fields where the first line names {len(header)}; "
            "put an answer that holds the separator in double quotes."
        )
    found = {name: _AS_TEXT.sub(r"\1", field.strip()) for name, field in zip(header, fields, strict=True) if name}
    whole = " ".join(filter(None, (_half(found, _FIRST), _half(found, _LAST))))
    return _entry({"student": whole} | found if whole else found, line, path)


def _half(found: Mapping[str, str], names: Sequence[str]) -> str:
    return next((found[name].strip() for name in names if name in found), "")


def _separator(text: str) -> tuple[str, int, str]:
    """What separates the columns, how many lines come before the header, and the text from there on.

    Spreadsheets may say it in a line of its own, ``sep=;``; else the header decides.
    """
    if told := _SEPARATED.match(text):
        return told[1], text.count("\n", 0, told.end()), text[told.end() :]
    first = text.lstrip("\r\n").partition("\n")[0]
    return max(",;\t", key=lambda sign: len(set(_COLUMNS) & set(_names(first.split(sign))))), 0, text


def _names(fields: Sequence[str]) -> list[str]:
    names = [" ".join(field.replace("_", " ").replace('"', " ").lower().split()) for field in fields]
    return [_ALSO[name] if _ALSO.get(name) not in (None, *names) else name for name in names]


def _numbered(text: str, separator: str, where: str) -> Iterator[tuple[int, list[str]]]:
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
    line = 1
    try:
        for fields in reader:
            yield line, fields
            line = reader.line_num + 1
    except csv.Error as error:
        raise FileError(f"{where}, line {line}: its quotes are broken ({error}); fix them.") from None


def _quoted(text: str) -> str:
    return repr(text if len(text) <= 40 else f"{text[:39]}…")
