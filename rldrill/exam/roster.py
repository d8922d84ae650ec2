"""Rosters: who sits an exam, from a CSV file with the columns name and number."""

import csv
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING

from rldrill.exam.blueprint import MOST_VERSIONS
from rldrill.exam.exam import Person
from rldrill.files import read_text, shown
from rldrill.problems.errors import FileError

if TYPE_CHECKING:
    from _csv import Reader

#: A longer name does not fit on the head of a page.
_LONGEST = 60


def read_roster(path: str | Path) -> tuple[Person, ...]:
    """The people of a roster, in its order.

    Raises:
        FileError: the file cannot be read, or a line of it does not fit.
    """
    where = shown(path)
    text = read_text(path, (".csv",))
    head = text.partition("\n")[0]
    lines = StringIO(text, newline=None)  # a line may end as it did on old Macintoshes
    rows = csv.reader(lines, delimiter=";" if head.count(";") > head.count(",") else ",")
    try:
        return _people(rows, where)
    except csv.Error as error:
        raise FileError(f"{where}, line {rows.line_num}: it is no line of a table ({error}); correct it.") from None


def _people(rows: "Reader", where: str) -> tuple[Person, ...]:
    names = [cell.strip().lower() for cell in next(rows, [])]
    if "name" not in names or "number" not in names:
        raise FileError(f"{where}, line 1: a roster begins with the line 'name,number'; write it there.")
    people: list[Person] = []
    for row in rows:
        cells = [cell.strip() for cell in row]
        if not any(cells):
            continue
        here = f"{where}, line {rows.line_num}"
        if len(cells) != len(names):
            raise FileError(f"{here}: there are {len(cells)} cells under {len(names)} names; put commas in quotes.")
        person = Person(cells[names.index("name")], cells[names.index("number")])
        if not person.name or not person.number:
            raise FileError(f"{here}: the name or the number is missing; write both.")
        if len(person.name) > _LONGEST or len(person.number) > _LONGEST // 2:
            raise FileError(f"{here}: the name or the number is too long for the head of a page; shorten it.")
        if any(other.number == person.number for other in people):
            raise FileError(f"{here}: the number {person.number} stands there twice; each person has one of their own.")
        people.append(person)
    if not people or len(people) > MOST_VERSIONS:
        raise FileError(f"{where}: there are {len(people)} people on it; a roster has from 1 to {MOST_VERSIONS}.")
    return tuple(people)
