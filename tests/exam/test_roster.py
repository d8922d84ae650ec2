"""Rosters: a name and a number on every line."""

from pathlib import Path

import pytest

from rldrill.exam.exam import Person
from rldrill.exam.roster import read_roster
from rldrill.problems.errors import FileError


def roster(folder: Path, text: str) -> Path:
    path = folder / "course.csv"
    path.write_text(text, encoding="utf-8")
    return path


def test_a_roster_with_the_line_ends_of_old_macintoshes(tmp_path: Path) -> None:
    assert read_roster(roster(tmp_path, "name,number\rAnn,1\r")) == (Person("Ann", "1"),)


def test_people_in_their_order(tmp_path: Path) -> None:
    people = (Person("Lee, Ann", "17"), Person("Jürgen", "04"))
    assert read_roster(roster(tmp_path, 'name,number\n"Lee, Ann",17\n\nJürgen, 04\n')) == people
    assert read_roster(roster(tmp_path, "Number;Name;mail\n17;Lee, Ann;a@b\n04;Jürgen;\n")) == people


def test_names_of_sixty_letters_and_numbers_of_thirty_still_fit_the_head_of_a_page(tmp_path: Path) -> None:
    person = Person("x" * 60, "9" * 30)
    assert read_roster(roster(tmp_path, f"name,number\n{person.name},{person.number}\n")) == (person,)


def test_what_grading_reads_of_spreadsheets_is_read_here_too(tmp_path: Path) -> None:
    people = (Person("Zoé Lee", "0012"),)
    assert read_roster(roster(tmp_path, 'sep=;\r\nname;number\r\nZoe\u0301  Lee;="0012"\r\n')) == people
    assert read_roster(roster(tmp_path, "Vorname,Nachname,Matrikelnummer\nZoé,Lee,0012\n")) == people
    assert read_roster(roster(tmp_path, "name,says,number\nZoé Lee,hello,0012\n")) == people
    (tmp_path / "unicode.csv").write_bytes("name\tnumber\nZoé Lee\t0012\n".encode("utf-16"))
    assert read_roster(tmp_path / "unicode.csv") == people


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("Ann,17\n", "line 1: the column 'name' is missing; the first line names the columns: name,number"),
        ("name,number\nAnn\n", "line 2: 1 field where the first line names 2; an empty one needs its separator, too."),
        ("name,number\nAnn,\n", "line 2: the name or the number is missing"),
        ("name,number\nAnn,1\nBob,1\n", "line 3: the number 1 stands there twice"),
        ("name,number\nAnn,é1\nBob,E\u03011\n", "line 3: the number É1 stands there twice"),
        ("name,number\n\x1b[31mAnn,1\n", "line 2: 'name' holds a character that cannot be printed"),
        ('name,number\n"Ann,1\nBob,2\n', "line 2: its quotes are broken"),
        (f"name,number\nAnn,{'9' * 20_000_000}\n", "the file is larger than 10 MB"),
        ("name,number\n", "there are 0 people on it"),
        (f"name,number\n{'x' * 61},1\n", "line 2: the name or the number is too long"),
        (f"name,number\nAnn,{'9' * 31}\n", "line 2: the name or the number is too long"),
    ],
)
def test_what_does_not_fit_is_said_with_the_line(text: str, sentence: str, tmp_path: Path) -> None:
    with pytest.raises(FileError) as caught:
        read_roster(roster(tmp_path, text))
    assert sentence in str(caught.value)
