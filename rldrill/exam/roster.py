"""Rosters: who sits an exam, from a CSV file with the columns name and number."""

from collections.abc import Mapping
from pathlib import Path

from rldrill.exam.blueprint import MOST_VERSIONS
from rldrill.exam.exam import Person
from rldrill.files import read_text, shown
from rldrill.problems.errors import FileError
from rldrill.spreadsheet import folded, name_of, table

#: A longer name does not fit on the head of a page.
_LONGEST = 60
_COLUMNS = ("name", "number")


def read_roster(path: str | Path) -> tuple[Person, ...]:
    """The people of a roster, in its order.

    Raises:
        FileError: the file cannot be read, or a line of it does not fit.
    """
    where = shown(path)
    people: dict[str, Person] = {}
    for line, row in table(read_text(path, (".csv",)), Path(path), _COLUMNS, _COLUMNS)[2]:
        here = f"{where}, line {line}"
        person = _person(row, here)
        if people.setdefault(folded(person.number), person) is not person:
            raise FileError(f"{here}: the number {person.number} stands there twice; each person has one of their own.")
    if not people or len(people) > MOST_VERSIONS:
        raise FileError(f"{where}: there are {len(people)} people on it; a roster has from 1 to {MOST_VERSIONS}.")
    return tuple(people.values())


def _person(row: Mapping[str, str], here: str) -> Person:
    if "says" in row:
        raise FileError(row["says"])
    person = Person(name_of(row.get("student", ""), "name", here), name_of(row.get("number", ""), "number", here))
    if not person.name or not person.number:
        raise FileError(f"{here}: the name or the number is missing; write both.")
    if len(person.name) > _LONGEST or len(person.number) > _LONGEST // 2:
        raise FileError(f"{here}: the name or the number is too long for the head of a page; shorten it.")
    return person
