"""The fixed words of a page on the web, in each language; problems themselves are in English."""

from dataclasses import dataclass

from rldrill.exam.choices import Language


@dataclass(frozen=True, slots=True)
class PageWords:
    """What stands on the page beside what print says; ``{}`` stands for what is put in."""

    check: str
    hint: str
    working: str
    score: str
    choose: str
    answer: str


_WORDS = {
    "en": PageWords("Check", "Hint", "Answer and working", "{} of {} parts right.", "choose …", "Answer"),
    "de": PageWords("Prüfen", "Hinweis", "Antwort und Rechenweg", "{} von {} Teilen richtig.", "wählen …", "Antwort"),
}


def page_words(language: Language) -> PageWords:
    """The words of a language."""
    return _WORDS[language]
