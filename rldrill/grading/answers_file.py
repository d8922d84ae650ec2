"""Reads files of typed answers (TOML, JSON, CSV, JSON Lines) into one form: an entry for every answer.

What is wrong with one answer is refused with its line, and costs only that answer.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

from msgspec import Struct
from msgspec.structs import replace

from rldrill.files import DATA_SUFFIXES, parse, parse_line, read_text, shown
from rldrill.grading.places import places
from rldrill.problems.errors import FileError, NothingToGrade, UsageError
from rldrill.problems.identity import looks_like_id
from rldrill.spreadsheet import JOINERS, meant, name_of, table
from rldrill.typed import typed

#: What the names of files of answers end in.
SUFFIXES = (".toml", ".json", ".csv", ".jsonl", ".ndjson")
#: Whose answers a file holds stands among its first bytes.
_BEGINNING = 4096
#: What a file says of the person whose answers it holds.
WHO = ("student", "number")
_NAMED = (*WHO, "problem", "part")
_COLUMNS = ("student", "problem", "part", "answer")
_KNOWN = (*_NAMED, "answer")
_NEEDED = ("problem", "answer")
_POINT = re.compile(r"[0-9]\.[0-9]|(?<![0-9A-Za-z])\.[0-9]")
#: A table from problems to answers is one student's; it has no more characters.
_LARGEST = 10**6
#: A problem's number in an exam.
PLACE = re.compile(r"[1-9][0-9]{0,2}")
#: The same as people write it, perhaps with the part: Problem 5, #5, 5.0 of a spreadsheet, 4a, 4 (a).
_NUMBERED = re.compile(
    r"(?:(?:problem|question|exercise|task|aufgabe|p|q|#)\.?\s*)?([1-9][0-9]{0,2})(?:\.0?|\)|[.\s]*\(?([a-z])\)?)?",
    re.IGNORECASE,
)
_BARE_ID = re.compile(r"^[ \t]*+\[?[ \t]*+(?:answers\.)?[a-z-]+/[1-3]/\d", re.MULTILINE)


class Entry(Struct, frozen=True):
    """One answer, as it was typed.

    Args:
        student: who typed it; empty where the file does not say.
        problem: an ID, or the path of a problem file from the folder of the file of answers.
        part: the label of the part; empty where the file leaves it out.
        text: what was typed; blank for no answer.
        line: the line of the file where the answer stands.
        path: the file of answers.
        commas: whether commas may be decimal commas: semicolons part the file's columns, and no answer has a point.
        number: the student's matriculation number, where there is a column for it.
        column: where in the line it begins, counted from 1: which field it is in a spreadsheet, else which sign.
    """

    student: str
    problem: str
    part: str
    text: str
    line: int | None
    path: Path
    commas: bool = False
    number: str = ""
    column: int | None = None

    @property
    def where(self) -> str:
        """The place, as sentences name it."""
        return placed(shown(self.path), self.line, None if self.is_cell else self.column)

    @property
    def is_cell(self) -> bool:
        """Whether it is a cell of a spreadsheet."""
        return self.path.suffix.lower() == ".csv"


def placed(path: str, line: int | None, column: int | None) -> str:
    """A place in a file, as sentences name it."""
    return ", ".join(
        [path, *([] if line is None else [f"line {line}"]), *([] if column is None else [f"column {column}"])]
    )


class Refusal(Struct, frozen=True):
    """What could not be graded: a file, a row, or all that a student answered to a problem.

    Args:
        path: the file of answers, as it is shown.
        line: the line, where it is one.
        student: whose it is; empty where that is not known.
        says: the sentence with the place, the reason and what to do.
        exit_code: 3 for what is unreadable, 4 for a file without answers.
        problem: the problem, where it is known.
        number: the student's number, where it is known.
    """

    path: str
    line: int | None
    student: str
    says: str
    exit_code: int = FileError.exit_code
    problem: str = ""
    number: str = ""


class HandedIn(Struct, frozen=True):
    """What a file of answers holds: the answers, and what of it could not be read."""

    path: Path
    entries: tuple[Entry, ...]
    refused: tuple[Refusal, ...] = ()


#: An answer, or what is wrong with its line.
Row: TypeAlias = Entry | Refusal


def read_answers(path: str | Path) -> HandedIn:
    """Every answer in a file, in the file's order; what is wrong with single answers is told beside.

    Raises:
        FileError: the file cannot be read, or is not a file of answers.
        NothingToGrade: it holds no answers, or blank ones only that are nobody's.
    """
    path = Path(path)
    text = read_text(path, SUFFIXES)
    suffix = path.suffix.lower()
    if suffix in DATA_SUFFIXES and len(text) > _LARGEST:
        raise FileError(f"{shown(path)}: it is larger than {_LARGEST // 10**6} MB, and is one student's; shorten it.")
    if not text.strip():
        rows: tuple[Row, ...] = ()
    elif suffix == ".csv":
        rows = tuple(_csv(text, path))
    elif suffix in DATA_SUFFIXES:
        rows = tuple(_tables(text, path))
    else:
        rows = tuple(_json_lines(text, path))
    entries = tuple(row for row in rows if isinstance(row, Entry))
    refused = tuple(row for row in rows if isinstance(row, Refusal))
    if not refused and not any(entry.text.strip() or entry.student for entry in entries):
        raise NothingToGrade(f"{shown(path)}: there are no answers in it; write some, or leave it out.")
    return HandedIn(path, entries, refused)


#: Where a file of one student's answers says whose it is.
_WHOSE = re.compile(r"""^[\s{]*["']?(?:student|name|number)["']?\s*[=:]\s*["']?([^"'\n,}]+)""", re.MULTILINE)


def whose_file(path: str | Path) -> str:
    """Who seems to have written a file that cannot be read as one of answers; empty where that is not known."""
    try:
        if not Path(path).is_file():  # to open a pipe waits for whoever writes into it
            return ""
        with Path(path).open("rb") as file:
            begun = file.read(_BEGINNING).decode("utf-8", "replace")
    except OSError:
        return ""
    return _who_says(begun)


def _who_says(text: str) -> str:
    found = _WHOSE.search(text)
    return _in_one_line(found[1].strip()) if found else ""


def _row(fields: Mapping[str, object], line: int | None, column: int | None, path: Path) -> Row:
    """An entry from what a file holds, or why there is none."""
    try:
        return _entry(fields, line, column, path)
    except FileError as error:
        student, number = (_in_one_line(str(fields[name])) if isinstance(fields.get(name), str | int) else ""
                           for name in ("student", "number"))  # fmt: skip
        return Refusal(shown(path), line, student or number, str(error), number=number)


def _entry(fields: Mapping[str, object], line: int | None, column: int | None, path: Path) -> Entry:
    """An entry from what a file holds.

    Raises:
        FileError: a field is not what it should be.
    """
    place = Entry("", "", "", "", line, path, column=column).where
    student, number, problem, part = (_word(fields.get(name), name, place) for name in _NAMED)
    if numbered := _NUMBERED.fullmatch(problem):
        label = (numbered[2] or "").lower()
        if label and part.strip(" ().").lower() not in ("", label):
            raise FileError(f"{place}: {_quoted(problem)} and the part {_quoted(part)} stand there; keep one of them.")
        problem, part = numbered[1], part or label
    if (
        not looks_like_id(problem)
        and not PLACE.fullmatch(problem)
        and Path(problem).suffix.lower() not in DATA_SUFFIXES
    ):
        raise FileError(
            f"{place}: {_quoted(problem)} is neither a problem ID, such as value-iteration/2/7 "
            "(family/level 1-3/seed), nor a problem's number in an exam, nor a problem file."
        )
    try:
        text = typed(fields.get("answer"), f"{place}: the answer to {problem}")
    except UsageError as error:
        raise FileError(str(error)) from None
    return Entry(student or number, problem, part, text, line, path, number=number, column=column)


def _word(value: object, name: str, place: str) -> str:
    """A name in one line; whole numbers are taken too, for students are often numbered."""
    if value is None:
        return ""
    if isinstance(value, bool) or not isinstance(value, str | int):
        raise FileError(f"{place}: '{name}' must be a text; write it in quotes.")
    return name_of(str(value), name, place)


def _in_one_line(text: str) -> str:
    """A name that may hold anything, as it can be shown."""
    return "".join(sign if sign.isprintable() or sign in JOINERS else repr(sign)[1:-1] for sign in text.strip())[:80]


def _meanings(keys: Sequence[str], where: str) -> dict[str, str]:
    """What the fields that stand side by side mean.

    Raises:
        FileError: two of them are the student, or something else that there is once.
    """
    names = meant(keys)
    for name in _KNOWN:
        alike = [key for key, meaning in zip(keys, names, strict=True) if meaning == name]
        if len(alike) > 1:
            called = " and ".join(map(repr, alike))
            raise FileError(f"{where}: the fields {called} stand for the {name}; keep one of them.")
    return dict(zip(keys, names, strict=True))


def _tables(text: str, path: Path) -> Iterator[Row]:
    """TOML and JSON: problem → part → answer, or problem → answer where there is one part."""
    where = shown(path)
    try:
        data = parse(text, path)
    except FileError as error:
        hint = ' Problem IDs stand in quotes: ["td-zero/2/7"].'
        unquoted = path.suffix.lower() == ".toml" and _BARE_ID.search(text)
        raise FileError(f"{error}{hint if unquoted else ''}") from None
    found = places(text, path)
    if not isinstance(data, dict):
        raise FileError(f"{where}: a file of answers is a table from problem IDs to answers.")
    single = [key for key, value in data.items() if key == "student" or not isinstance(value, dict | list)]
    person = {name: data[key] for key, name in _meanings(single, where).items() if name in WHO}
    data = {key: value for key, value in data.items() if key not in single or meant([key])[0] not in WHO}
    above = ("answers",) if "answers" in data else ()
    answers = data.pop("answers", None) if above else data
    if answers is not data and data:
        raise FileError(f"{where}: {_quoted(next(iter(data)))} stands outside 'answers'; move it in there.")
    if not isinstance(answers, dict):
        raise FileError(f"{where}: 'answers' must be a table from problem IDs to answers.")
    for problem, parts in answers.items():
        for part, answer in parts.items() if isinstance(parts, dict) else [("", parts)]:
            fields = person | {"problem": problem, "part": part, "answer": answer}
            keys = (*above, problem, part) if isinstance(parts, dict) else (*above, problem)
            line, column = found.get(keys, (None, None))
            yield _row(fields, line, column, path)


def _json_lines(text: str, path: Path) -> Iterator[Row]:
    """One object a line, with the columns of the CSV as its fields."""
    for number, line in enumerate(text.split("\n"), 1):
        if not line.strip():
            continue
        try:
            data = _object(line, path, number)
        except FileError as error:
            yield Refusal(shown(path), number, _who_says(line), str(error))
        else:
            _, column = places(line, path).get(("answer",), (None, None))
            yield _row(data, number, column, path)


def _object(line: str, path: Path, number: int) -> dict[str, object]:
    data = parse_line(line, path, number)
    here = f"{shown(path)}, line {number}"
    if not isinstance(data, dict):
        raise FileError(f'{here}: a line is an object, as in {{"problem": "td-zero/2/7", "answer": "7/2"}}.')
    data = {name: data[key] for key, name in _meanings([*data], here).items()}
    for name in _NEEDED:
        if name not in data:
            raise FileError(f"{here}: the field '{name}' is missing; give it.")
    return data


def _csv(text: str, path: Path) -> Iterator[Row]:
    """A header line that names the columns, then one answer a line."""
    separator, header, records = table(text, path, _COLUMNS, _NEEDED)
    column = header.index("answer") + 1
    rows = [
        Refusal(shown(path), line, _whose(found), found["says"], number=_in_one_line(found.get("number", "")))
        if "says" in found
        else _row({name: found[name] for name in _KNOWN if name in found}, line, column, path)
        for line, found in records
    ]
    commas = separator == ";" and not any(isinstance(row, Entry) and _POINT.search(row.text) for row in rows)
    return iter([replace(row, commas=True) if commas and isinstance(row, Entry) else row for row in rows])


def _whose(found: Mapping[str, str]) -> str:
    return _in_one_line(found.get("student") or found.get("number") or "")


def _quoted(text: str) -> str:
    return repr(text if len(text) <= 40 else f"{text[:39]}…")
