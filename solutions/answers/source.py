"""What a person typed, in one spelling: signs, digits and spaces made alike, with the columns kept."""

import re
import unicodedata
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache

LONGEST = 2000
_QUOTED = 40
_KEPT = frozenset("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻ᵀ")  # NFKC would lose that they stand above the line
_ALIKE = dict.fromkeys("−–—‐‑‒﹣", "-") | dict.fromkeys("×·⋅∙∗", "*") | dict.fromkeys("÷∕⁄", "/")
_ALIKE |= {"\t": " ", "\u1680": " ", "\r": "\n", "’": "'", "′": "'", "“": '"', "”": '"', "„": '"'}
_OPENING = {"(": ")", "[": "]", "{": "}", "⟨": "⟩"}
_CLOSING = frozenset(_OPENING.values())


class Unreadable(ValueError):
    """A typed answer, or a part of one, that cannot be read.

    Attributes:
        message: one sentence that says what was not understood and what to do.
        position: the column of the text where it stands, counted from 0, if there is one.
    """

    def __init__(self, message: str, position: int | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.position = position

    def within(self, place: str) -> "Unreadable":
        """The same complaint, with the entry it is about named first."""
        return Unreadable(f"{place}: {self.message}", self.position)


@dataclass(frozen=True, slots=True)
class Source:
    """A stretch of typed text in its one spelling, and the column where each character was typed."""

    text: str
    columns: tuple[int, ...]
    end: int

    def part(self, start: int, stop: int) -> "Source":
        """A stretch of it, without the spaces around."""
        while start < stop and self.text[start].isspace():
            start += 1
        while stop > start and self.text[stop - 1].isspace():
            stop -= 1
        return Source(self.text[start:stop], self.columns[start:stop], self.column(stop))

    def column(self, index: int) -> int:
        """Where a character of it was typed."""
        return self.columns[index] if index < len(self.columns) else self.end

    def unreadable(self, message: str, index: int = 0) -> Unreadable:
        """A complaint about a character of it."""
        return Unreadable(message, self.column(index))

    def outside(self) -> Iterator[tuple[int, str]]:
        """The characters that stand in no bracket, each with its index; brackets come with the outermost."""
        depth = 0
        for index, character in enumerate(self.text):
            depth -= character in _CLOSING and depth > 0
            if depth == 0:
                yield index, character
            depth += character in _OPENING

    def split(self, marks: str | Callable[[int, str], bool]) -> list["Source"]:
        """Its pieces between the marks that stand in no bracket."""
        is_mark = marks if callable(marks) else lambda _, character: character in marks
        pieces, start = [], 0
        for index, character in self.outside():
            if is_mark(index, character):
                pieces.append(self.part(start, index))
                start = index + 1
        return [*pieces, self.part(start, len(self.text))]

    def has(self, marks: str) -> bool:
        """Whether one of the marks stands in no bracket."""
        return any(character in marks for _, character in self.outside())

    def unwrapped(self, brackets: str = "([{⟨") -> "Source | None":
        """What stands in the one pair of brackets around it all, if there is one."""
        if len(self.text) < 2 or self.text[0] not in brackets or self.text[-1] != _OPENING[self.text[0]]:
            return None
        outermost = [index for index, _ in self.outside()]
        return self.part(1, len(self.text) - 1) if outermost == [0, len(self.text) - 1] else None


def clean(text: str) -> Source:
    """A typed text in its one spelling.

    Raises:
        Unreadable: it is empty, too long, or holds characters that cannot be seen.
    """
    if len(text) > LONGEST:
        raise Unreadable(f"The answer is longer than {LONGEST} characters; shorten it.", LONGEST)
    letters: list[str] = []
    columns: list[int] = []
    for column, character in enumerate(text):
        if character not in "\t\n\r" and unicodedata.category(character) in _UNSEEN:
            code = f"U+{ord(character):04X}"
            raise Unreadable(f"The answer holds an invisible character ({code}); type it anew.", column)
        spelled = _spelled(character)
        letters.append(spelled)
        columns += [column] * len(spelled)
    whole = Source("".join(letters), tuple(columns), len(text))
    source = _bare(whole.part(0, len(whole.text)))
    if not source.text:
        raise Unreadable("Nothing was typed.")
    return source


def _bare(source: Source) -> Source:
    """Without the signs that set mathematics off, and the sign for "about"."""
    while len(source.text) > 1 and source.text[0] == source.text[-1] == "$":
        source = source.part(1, len(source.text) - 1)
    return source.part(1, len(source.text)) if source.text[:1] in "≈~" else source


_UNSEEN = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})


@lru_cache(maxsize=4096)
def _spelled(character: str) -> str:
    if character in _KEPT:
        return character
    if character in _ALIKE:
        return _ALIKE[character]
    wide = unicodedata.normalize("NFKC", character)
    if re.fullmatch("[0-9]+⁄[0-9]+", wide):
        return " " + wide.replace("⁄", "/")  # 1½ is then a mixed number
    return _ALIKE.get(wide, wide) if len(wide) == 1 else character


def spelled(text: str) -> str:
    """A name or an option in the one spelling, in which it is compared with what was typed."""
    return " ".join("".join(map(_spelled, text)).split())


def quoted(text: str) -> str:
    """A piece of what was typed, short enough to be shown inside a sentence."""
    text = " ".join(text.split())
    return f"'{text}'" if len(text) <= _QUOTED else f"'{text[: _QUOTED - 1]}…'"
