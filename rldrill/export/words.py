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
    ``verdicts`` are those of the page that judges, and what it says of what it cannot read, where they are others than
    its script says.
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
            "short": "Fast; gesucht ist ein exakter Wert, oder drei richtige Ziffern.",
            "close": "Fast, aber nicht richtig: Suchen Sie einen Fehler, oder was unterwegs gerundet wurde.",
            "wrong": "Nicht richtig.",
            "some": "Nicht richtig bei {}; der Rest stimmt.",
            "choose": "Wählen Sie eine Antwort.",
            "A number in it is too large.": "Eine Zahl darin ist zu groß.",
            "A part of it is no real number.": "Ein Teil davon ist keine reelle Zahl.",
            "It divides by zero.": "Hier wird durch null geteilt.",
            "The exponent is too large.": "Der Exponent ist zu groß.",
            "A number has a comma in it; write a point before decimals, and nothing between thousands.": (
                "In einer Zahl steht ein Komma; schreiben Sie vor Dezimalen einen Punkt, zwischen Tausendern nichts."
            ),
            "“{}” is not understood; write a number such as 3/4.": (
                "„{}“ wird nicht verstanden; schreiben Sie eine Zahl wie 3/4."
            ),
            "“{}” may be several numbers; write a comma before decimals, and nothing between thousands.": (
                "„{}“ kann mehrere Zahlen bedeuten; schreiben Sie vor Dezimalen ein Komma, zwischen Tausendern nichts."
            ),
            "There is a comma that is not within a number; write one number.": (
                "Ein Komma steht nicht innerhalb einer Zahl; schreiben Sie eine einzige Zahl."
            ),
            "The number is too long.": "Die Zahl ist zu lang.",
            "Nothing was typed.": "Es wurde nichts eingegeben.",
            "“{}” is not expected there.": "„{}“ wird dort nicht erwartet.",
            "A sign is missing between two numbers.": "Zwischen zwei Zahlen fehlt ein Rechenzeichen.",
            "Put brackets around what stands below the line.": (
                "Setzen Sie Klammern um das, was unter dem Bruchstrich steht."
            ),
            "Put brackets around what the percent sign belongs to.": (
                "Setzen Sie Klammern um das, wozu das Prozentzeichen gehört."
            ),
            "Write powers of ten with ^: 10^-3.": "Schreiben Sie Zehnerpotenzen mit ^: 10^-3.",
            "Write powers of ten without spaces: 3e-2.": "Schreiben Sie Zehnerpotenzen ohne Leerzeichen: 3e-2.",
            "There are two signs before a number.": "Vor einer Zahl stehen zwei Vorzeichen.",
            "The exponent is not understood.": "Der Exponent wird nicht verstanden.",
            "Put brackets around the exponent.": "Setzen Sie Klammern um den Exponenten.",
            "The percent sign is not expected there.": "Das Prozentzeichen wird dort nicht erwartet.",
            "Something is missing at the end.": "Am Ende fehlt etwas.",
            "Write digits that repeat as a fraction.": "Schreiben Sie periodische Dezimalzahlen als Bruch.",
            "Put brackets around the mixed number.": "Setzen Sie Klammern um die gemischte Zahl.",
            "After a whole number the fraction must be below one, as in 1 3/4; write a sign between.": (
                "Nach einer ganzen Zahl muss der Bruch kleiner als eins sein, wie in 1 3/4; sonst fehlt ein Zeichen."
            ),
            "A bracket is not closed.": "Eine Klammer ist nicht geschlossen.",
            "“e” may be ε or the number e; write epsilon, or exp(1).": (
                "„e“ kann ε oder die Zahl e sein; schreiben Sie epsilon oder exp(1)."
            ),
            "“{}” is not something this answer may contain; write the number alone.": (
                "„{}“ kommt in dieser Antwort nicht vor; schreiben Sie nur die Zahl."
            ),
            "“{}” is not something this answer may contain; write numbers and {}.": (
                "„{}“ kommt in dieser Antwort nicht vor; schreiben Sie Zahlen und {}."
            ),
            "Put brackets behind {}.": "Setzen Sie Klammern hinter {}.",
            "It is too long.": "Das ist zu lang.",
            "A raised point may be a decimal point, or a sign for times; write another one.": (
                "Ein hochgestellter Punkt kann ein Dezimalzeichen oder ein Malzeichen sein; schreiben Sie ein anderes."
            ),
            "It says two numbers which differ; write one.": "Es sind zwei verschiedene Zahlen; schreiben Sie eine.",
            "What stands in brackets may be a factor, or the same number again; write one number.": (
                "Was in Klammern steht, kann ein Faktor sein oder dieselbe Zahl noch einmal; schreiben Sie eine Zahl."
            ),
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
