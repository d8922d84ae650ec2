"""One value that is said to hold for everything that is asked for: ``slow everywhere``, ``0.2 for both``."""

import re
from collections.abc import Sequence

from rldrill.problems.spelling import Source
from rldrill.solutions.answers.names import Key

_TWO = "both|beide|beiden"
#: How many there are, where that is said: in all three states.
_COUNTS = {word: count for count, words in enumerate(("two zwei 2", "three drei 3", "four vier 4", "five fünf 5",
                                                      "six sechs 6"), 2) for word in words.split()}  # fmt: skip
_ALL = rf"(?:all|alle|allen)(?:\s+(?:the\s+)?(?:{'|'.join(_COUNTS)})\b)?"
_IN_ALL = rf"(?:in|for|für)\s+(?:{_ALL}|every|each|any|{_TWO})(?:\s+(?:states?|s|entries|pairs))?"
#: What says before a value that it is the same everywhere; a comma behind it alone would part two entries.
_BEFORE = re.compile(
    rf"(?:(?:always|everywhere|immer|überall|all|alle|{_TWO})(?=\s)|{_IN_ALL}\b\s*+[:,]?+)\s*+(?=\S)", re.IGNORECASE
)
#: The same behind it, and what says so in brackets alone.
_BEHIND = re.compile(rf"{_IN_ALL}|everywhere|always|immer|überall|each|je|∀\s*s?", re.IGNORECASE)
_IN_BRACKETS = re.compile(rf"\((?:all|each|alle|{_TWO})\)", re.IGNORECASE)
_PAIR = re.compile(rf"\b(?:{_TWO})\b", re.IGNORECASE)
#: So many words say it at the most.
_WORDS = 5


def for_all(source: Source, keys: Sequence[Key]) -> Source | None:
    """The one value that is typed for all keys; None where several are typed, or a key has such a word for a name."""
    if len(keys) < 2:
        return None
    begin, stop = _between(source.text)
    said = (source.text[:begin] + source.text[stop:]).casefold()
    names = {name.casefold() for key in keys for name in ([key] if isinstance(key, str) else key)}
    if {count for word, count in _COUNTS.items() if word in said.split()} - {len(keys)}:
        return None
    if not said or names & {*re.findall(r"\w+", said)} or (len(keys) > 2 and _PAIR.search(said)):
        return None
    value = source.part(begin, stop)
    return None if not value.text or value.has(",;|\n:=") else value


def _between(text: str) -> tuple[int, int]:
    """Where the value begins and where it stops: all of the text, if nothing is said before it or behind it."""
    if before := _BEFORE.match(text):
        return before.end(), len(text)
    words = list(re.finditer(r"\S+", text))
    for count in range(min(_WORDS, len(words) - 1), 0, -1):
        said = " ".join(word[0] for word in words[-count:]).removesuffix(".")
        if _IN_BRACKETS.fullmatch(said) or _BEHIND.fullmatch(said.strip("()")):
            return 0, len(text[: words[-count].start()].rstrip(" ,\t\n"))
    return 0, len(text)
