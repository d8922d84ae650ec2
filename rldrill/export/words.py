"""The fixed words of pages and of other programs, in each language; problems themselves are in English."""

from collections.abc import Mapping, Sequence
from typing import Literal

from msgspec import Struct

from rldrill.exam.choices import Language
from rldrill.exam.exam import Head
from rldrill.export.asked import Cell, Quantity, is_open


class PageWords(Struct, frozen=True):
    """What stands there beside what print says; ``{}`` stands for what is put in.

    ``note`` stands above boxes that are judged elsewhere, and ``by_hand`` above what nobody but a person can judge.
    ``point`` and ``language`` say with ``note`` how other programs read decimals where an exam has commas.
    ``verdicts`` are those of the page that judges, where they are others than its script says.
    """

    check: str
    hint: str
    working: str
    score: str
    choose: str
    right: str
    note: str
    by_hand: str
    point: str
    language: str
    verdicts: Mapping[str, str]


_WORDS = {
    "en": PageWords(
        check="Check",
        hint="Hint",
        working="Answer and working",
        score="{} of {} parts right.",
        choose="choose …",
        right="Right.",
        note="Type decimals that are right to three significant digits, such as {}; fractions are not read here.",
        by_hand="Answer in words and formulas; it is marked by hand.",
        point="{} with a point",
        language="{} (0.667 where this site is in English)",
        verdicts={},
    ),
    "de": PageWords(
        check="Prüfen",
        hint="Hinweis",
        working="Antwort und Rechenweg",
        score="{} von {} Teilen richtig.",
        choose="wählen …",
        right="Richtig.",
        note="Geben Sie Dezimalzahlen mit drei richtigen Ziffern ein, etwa {}; Brüche werden hier nicht gelesen.",
        by_hand="Antworten Sie in Worten und Formeln; die Antwort wird von Hand bewertet.",
        point="{} mit Punkt",
        language="{} (0.667, wenn diese Seite auf Englisch eingestellt ist)",
        verdicts={
            "right": "Richtig.",
            "close": "Fast; gesucht ist ein exakter Wert, oder drei richtige Ziffern.",
            "wrong": "Nicht richtig.",
            "some": "Nicht richtig bei {}; der Rest stimmt.",
            "choose": "Wählen Sie eine Antwort.",
        },
    ),
}


def page_words(language: Language) -> PageWords:
    """The words of a language."""
    return _WORDS[language]


def note(head: Head, asked: Sequence[Cell], *, reads: Literal["both", "point", "language"]) -> str:
    """What stands above the boxes of a problem in another program, as ``typing_note`` says it; nothing for words."""
    if any(map(is_open, asked)):
        return page_words(head.language).by_hand
    return typing_note(head, reads=reads) if any(isinstance(cell, Quantity) for cell in asked) else ""


def typing_note(head: Head, *, reads: Literal["both", "point", "language"]) -> str:
    """How numbers are typed into another program.

    Args:
        head: of the exam.
        reads: with which decimal marks the program reads numbers: with points and commas, with points alone, or with
            the one of the language that it is set to.
    """
    told = page_words(head.language)
    example = "0.667"
    if head.decimal_mark == ",":
        example = {"both": "0,667", "point": told.point.format(example), "language": told.language.format("0,667")}[
            reads
        ]
    return told.note.format(example)
