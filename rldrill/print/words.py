"""The fixed words of a printed exam, in each language; problems themselves are in English."""

from msgspec import Struct

from rldrill.exam.choices import Language
from rldrill.solutions.answers.rule import RULE


class Words(Struct, frozen=True):
    """What is printed around the problems; ``{}`` stands for what is put in."""

    name: str
    number: str
    version: str
    key: str
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
        version="Version",
        key="Key",
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
        version="Version",
        key="Lösung",
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


def written_time(words: Words, duration: int | None, expected: int) -> str:
    """How many minutes there are, or where that is not said how many the work takes."""
    return words.expected.format(expected) if duration is None else words.duration.format(duration)
