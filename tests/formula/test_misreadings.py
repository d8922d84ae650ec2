"""How formulas are misread: the line that somebody writes who makes the mistake, copied out by hand for every one."""

from pathlib import Path
from unicodedata import normalize

import pytest

from rldrill.render.unicode import unicode_text
from rldrill.solutions.sheet import SECTIONS, formulas, section

FOLDER = Path(__file__).parent / "misreadings"
#: One file for each section of the sheet; a line is the formula's key, the mistake's name, and what is written.
WRITTEN = {
    (key, name): line
    for file in sorted(FOLDER.glob("*.txt"))
    for text in file.read_text("utf-8").splitlines()
    if text
    for head, line in [text.split(": ", 1)]
    for key, name in [head.split(" / ")]
}
MISREAD = {
    (formula.key, mistake.name): reads for formula in formulas().values() for mistake, reads in formula.misread.items()
}


@pytest.mark.parametrize("place", MISREAD, ids=" / ".join)
def test_a_misreading_is_what_somebody_writes_who_makes_it(place: tuple[str, str]) -> None:
    assert place in WRITTEN, (
        f"write this misreading, as a student would, in tests/formula/misreadings/{_section(place)}"
    )
    key, _ = place
    written = unicode_text(formulas()[key].equation(MISREAD[place]))
    assert normalize("NFD", " ".join(written.split())) == normalize("NFD", WRITTEN[place])


def test_no_line_is_left_over() -> None:
    assert set(WRITTEN) <= set(MISREAD)


@pytest.mark.parametrize("place", MISREAD, ids=" / ".join)
def test_a_misreading_is_not_the_formula(place: tuple[str, str]) -> None:
    formula = formulas()[place[0]]
    assert unicode_text(formula.equation(MISREAD[place])) != unicode_text(formula.equation(formula.right))


def _section(place: tuple[str, str]) -> str:
    return next(f"{name}.txt" for name in SECTIONS if formulas()[place[0]] in section(name))
