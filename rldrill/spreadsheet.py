"""Reads tables as spreadsheets write them (CSV), whatever parts their columns and ends their lines; and names."""

import csv
import io
import re
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from rldrill.files import shown
from rldrill.problems.document import counted
from rldrill.problems.errors import FileError

#: What other programs call the columns, and the two halves of a name.
_ALSO = {
    "problem id": "problem", "id": "problem", "question": "problem", "problem part": "part", "response": "answer",
    "name": "student", "student name": "student", "full name": "student", "student id": "number", "sid": "number",
    "id number": "number", "student number": "number", "matriculation number": "number", "matrikelnummer": "number",
    "matriculation": "number", "matrikel": "number", "matrikelnr": "number",
    "aufgabe": "problem", "teil": "part", "antwort": "answer",
}  # fmt: skip
_FIRST = ("first name", "first", "firstname", "given name", "vorname")
_LAST = ("last name", "last", "lastname", "surname", "family name", "nachname")
_AS_TEXT = re.compile(r'\A="(.*)"\Z', re.DOTALL)  # so a spreadsheet keeps 0.25 from becoming a date
_MARKED = re.compile(r"\A'(?=[=+\-@\d.(\[])(?!.*'$)", re.DOTALL)  # and so, as our own reports do
#: A file has no more bytes, so neither has a field: an answer that is too long is judged, and costs only itself.
csv.field_size_limit(10**7)
_SEPARATED = re.compile(r"\s*\"?sep=([^\r\n\"])\"?[,;\t]*\r?\n", re.IGNORECASE)
#: What joins letters in Persian, Hindi and other scripts, and is not seen itself.
JOINERS = "\u200c\u200d"
#: Apostrophes and hyphens as word processors set them, and as they are typed.
_TYPED = str.maketrans(dict.fromkeys("‘’ʼ′`´", "'") | dict.fromkeys("‐‑‒–—−", "-"))
#: No name has more characters.
_LONGEST = 200
#: After so many rows with broken quotes the rest of a file is given up: its quotes mean nothing any more.
_MOST_BROKEN = 20


def table(
    text: str, path: Path, wanted: Sequence[str], needed: Sequence[str]
) -> tuple[str, Sequence[str], Iterator[tuple[int, dict[str, str]]]]:
    """What separates the columns of a CSV file, their names, and its rows with their lines.

    First and last name become the student. A row that cannot be read has what is wrong with it under ``says``.

    Args:
        text: what the file holds.
        path: the file, for complaints.
        wanted: the columns as they are told.
        needed: those of them that must be there.

    Raises:
        FileError: a needed column is missing, or one stands twice.
    """
    where = shown(path)
    separator, first, text = _separator(text, wanted)
    records = _numbered(text, separator, first, where)
    line, named = next(((line, fields) for line, fields in records if any(map(str.strip, fields))), (1, []))
    if isinstance(named, str):
        raise FileError(named)
    header = meant(named)
    while header and not header[-1]:
        del header[-1]
    there = {*header, "student"} if {*_FIRST, *_LAST} & {*header} else {*header}
    missing = [column for column in needed if _ALSO.get(column, column) not in there]
    if missing:
        raise FileError(
            f"{where}, line {line}: the column '{missing[0]}' is missing; "
            f"the first line names the columns: {','.join(wanted)}."
        )
    for column in {*_ALSO.values(), *wanted}:
        if header.count(column) > 1:
            raise FileError(f"{where}, line {line}: the column '{column}' stands twice; keep one of them.")
    rows = (
        (line, {"says": fields} if isinstance(fields, str) else _record(header, fields, f"{where}, line {line}"))
        for line, fields in records
        if isinstance(fields, str) or any(map(str.strip, fields))
    )
    return separator, header, rows


def _record(header: Sequence[str], fields: Sequence[str], where: str) -> dict[str, str]:
    """A line of a CSV file; spreadsheets leave blank fields at its end."""
    fields = list(fields)
    while len(fields) > len(header) and not fields[-1].strip():
        del fields[-1]
    named = zip(header, fields, strict=False)
    found = {
        name: _MARKED.sub("", _AS_TEXT.sub(r"\1", field.strip())) for name, field in named if name and name != "says"
    }
    whole = " ".join(filter(None, (_half(found, _FIRST), _half(found, _LAST))))
    found = {"student": whole} | found if whole else found
    if len(fields) != len(header):
        cure = "put an answer that holds the separator in double quotes"
        if len(fields) < len(header):
            cure = "an empty one needs its separator, too"
        found["says"] = f"{where}: {counted(len(fields), 'field')} where the first line names {len(header)}; {cure}."
    return found


def _half(found: Mapping[str, str], names: Sequence[str]) -> str:
    return next((found[name].strip() for name in names if name in found), "")


def _separator(text: str, wanted: Sequence[str]) -> tuple[str, int, str]:
    """What separates the columns, how many lines come before the header, and the text from there on.

    Spreadsheets may say it in a line of its own, ``sep=;``; else the header decides.
    """
    if told := _SEPARATED.match(text):
        return told[1], text.count("\n", 0, told.end()), text[told.end() :]
    first = text.lstrip("\r\n").partition("\n")[0]
    known = {*_ALSO, *_ALSO.values(), *_FIRST, *_LAST, *wanted}
    return max(",;\t", key=lambda sign: len(known & {*meant(first.split(sign))})), 0, text


def meant(names: Sequence[str]) -> list[str]:
    """What columns or fields hold that are called so, side by side: a ``name`` is no student where that is one, too."""
    spelled = [" ".join(re.sub('[_"-]', " ", name).lower().split()) for name in names]
    there = {None, *spelled}
    return [_ALSO[name] if _ALSO.get(name) not in there else name for name in spelled]


def _numbered(text: str, separator: str, before: int, where: str) -> Iterator[tuple[int, list[str] | str]]:
    """The records with the lines where they begin, or a sentence where the quotes of one are broken.

    Reading goes on in the line after that where such a record begins: an unclosed quote takes no other rows with it.
    """
    lines = io.StringIO(text, newline="").readlines()
    start = 0
    for _ in range(_MOST_BROKEN):
        reader = csv.reader(lines[start:], delimiter=separator, strict=True)
        begun = start
        try:
            for fields in reader:
                yield begun + before + 1, fields
                begun = start + reader.line_num
            return
        except csv.Error as error:
            line = begun + before + 1
            yield line, f"{where}, line {line}: its quotes are broken ({error}); fix them."
            start = begun + 1
    yield (
        start + before + 1,
        f"{where}, line {start + before + 1}: {_MOST_BROKEN} rows before have broken quotes; the rest is not read.",
    )


def name_of(text: str, what: str, place: str) -> str:
    """A name in one line and in one normal form.

    Args:
        text: the name as it is written.
        what: what complaints call it.
        place: where it stands, for complaints.

    Raises:
        FileError: it is too long, or holds what cannot be printed.
    """
    name = " ".join(text[: 10 * _LONGEST].split())  # normal forms of long texts take long
    name = unicodedata.normalize("NFC", name)
    if len(name) > _LONGEST:
        raise FileError(f"{place}: '{what}' has more than {_LONGEST} characters; shorten it.")
    if not all(sign.isprintable() or sign in JOINERS for sign in name):
        raise FileError(f"{place}: '{what}' holds a character that cannot be printed; retype it.")
    return name


def folded(name: str) -> str:
    """A name as names are compared: without regard to case, normal form, spaces and joiners that are not seen.

    Apostrophes and hyphens are those of a keyboard, whatever a word processor makes of them.
    """
    seen = "".join(sign for sign in name.translate(_TYPED) if sign not in JOINERS)
    return " ".join(unicodedata.normalize("NFC", unicodedata.normalize("NFKC", seen).casefold()).split())
