"""What a person typed, in answers or in problem files, in one spelling: signs, digits and spaces made alike."""

import unicodedata
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache

_QUOTED = 40
#: One sign for a quotient of two numbers: ½ is a number of its own, and ½γ half of γ.
VULGAR = "¼½¾⅐⅑⅒⅓⅔⅕⅖⅗⅘⅙⅚⅛⅜⅝⅞"
_KEPT = frozenset("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻ᵀ" + VULGAR)  # NFKC would lose that they stand above the line
_ALIKE = dict.fromkeys("−–—‐‑‒﹣", "-") | dict.fromkeys("×·⋅∙∗", "*") | dict.fromkeys("÷∕⁄", "/")
_ALIKE |= {"\t": " ", "\u1680": " ", "\r": "\n", "’": "'", "′": "'", "“": '"', "”": '"', "„": '"'}
_UNSEEN = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})  # kinds of characters
_OPENING = {"(": ")", "[": "]", "{": "}", "⟨": "⟩"}
_CLOSING = frozenset(_OPENING.values())


class Unreadable(ValueError):
    """A typed text, or a part of one, that cannot be read.

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
    """A stretch of typed text in its one spelling, and the column where it begins."""

    text: str
    start: int = 0

    def part(self, start: int, stop: int) -> "Source":
        """A stretch of it, without the spaces around."""
        stretch = self.text[start:stop].rstrip()
        bare = stretch.lstrip()
        return Source(bare, self.column(start + len(stretch) - len(bare)))

    def column(self, index: int) -> int:
        """Where a character of it was typed."""
        return self.start + index

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


def respelled(text: str, longest: int) -> Source:
    """A typed text in the one spelling, without the spaces around.

    Raises:
        Unreadable: it is longer than ``longest``, or holds characters that cannot be seen.
    """
    if len(text) > longest:
        raise Unreadable(f"It is longer than {longest} characters; shorten it.", longest)
    for column, character in enumerate(text):
        if character not in "\t\n\r" and unicodedata.category(character) in _UNSEEN:
            raise Unreadable(f"It holds an invisible character (U+{ord(character):04X}); retype it.", column)
    return Source("".join(map(_spelled, text))).part(0, len(text))


@lru_cache(maxsize=4096)
def _spelled(character: str) -> str:
    """One character for one, so that columns are kept."""
    if character in _KEPT:
        return character
    if character in _ALIKE:
        return _ALIKE[character]
    wide = unicodedata.normalize("NFKC", character)
    return _ALIKE.get(wide, wide) if len(wide) == 1 else character


def spelled(text: str) -> str:
    """A name or an option in the one spelling, in which it is compared with what was typed."""
    return " ".join("".join(map(_spelled, text)).split())


def quoted(text: str) -> str:
    """A piece of what was typed, short enough to be shown inside a sentence."""
    text = " ".join(text.split())
    return f"'{text}'" if len(text) <= _QUOTED else f"'{text[: _QUOTED - 1]}…'"
