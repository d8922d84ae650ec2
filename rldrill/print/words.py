"""The fixed words of a printed exam, in each language; problems themselves are in English."""

from msgspec import Struct

from rldrill.exam.choices import Language
from rldrill.solutions.answers.rule import RULE


class Words(Struct, frozen=True):
    """What is printed around the problems; ``{}`` stands for what is put in."""

    name: str
    number: str
    date: str
    version: str
    key: str
    solutions: str
    problem: str
    points: str
    point: str
    reached: str
    total: str
    answer: str
    yes: str
    no: str
    minutes: str
    rule: str
    show: str
    duration: str
    expected: str
    mistakes: str
    empty: str
    right: str


WORDS = {
    "en": Words(
        name="Name",
        number="Number",
        date="Date",
        version="Version",
        key="Key",
        solutions="Solutions",
        problem="Problem",
        points="points",
        point="point",
        reached="Reached",
        total="Total",
        answer="Answer",
        yes="yes",
        no="no",
        minutes="about {} min",
        rule=f"Answer with {RULE}.",
        show="Show your working.",
        duration="You have {} minutes.",
        expected="Expect to work for about {} min.",
        mistakes="Typical wrong answers",
        empty="This page is left empty.",
        right=f"Right is {RULE}.",
    ),
    "de": Words(
        name="Name",
        number="Matrikelnummer",
        date="Datum",
        version="Version",
        key="Lösung",
        solutions="Lösungen",
        problem="Aufgabe",
        points="Punkte",
        point="Punkt",
        reached="Erreicht",
        total="Summe",
        answer="Antwort",
        yes="ja",
        no="nein",
        minutes="etwa {} min",
        rule="Antworten Sie mit einem exakten Wert oder einer Dezimalzahl mit 3 richtigen Ziffern.",
        show="Der Rechenweg muss erkennbar sein.",
        duration="Sie haben {} Minuten Zeit.",
        expected="Rechnen Sie mit etwa {} min.",
        mistakes="Typische falsche Antworten",
        empty="Diese Seite bleibt leer.",
        right="Richtig ist ein exakter Wert oder eine Dezimalzahl mit 3 richtigen Ziffern.",
    ),
}


def words(language: Language) -> Words:
    """The words of a language."""
    return WORDS[language]


def written_points(words: Words, points: int) -> str:
    """Points in words."""
    return f"{points} {words.point if points == 1 else words.points}"
