"""What a person typed, in answers or in problem files, in one spelling: signs, digits and spaces made alike."""

import re
import unicodedata
from collections.abc import Callable, Iterator
from functools import lru_cache

from msgspec import Struct
from msgspec.structs import replace

_QUOTED = 40
#: One sign for a quotient of two numbers: ½ is a number of its own, and ½γ half of γ.
VULGAR = "¼½¾⅐⅑⅒⅓⅔⅕⅖⅗⅘⅙⅚⅛⅜⅝⅞"
_KEPT = frozenset("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻ᵀ" + VULGAR)  # NFKC would lose that they stand above the line
_ALIKE = {
    sign: alike
    for alike, signs in {
        "-": "−–—‐‑‒﹣", "*": "×·⋅∙∗•‧・⋆✕✖⨯⁎", "/": "÷∕⁄", "≈": "≃≅≐≒∼", "%": "٪﹪", "'": "’‘′٬", '"': "“”„«»",
        ".": "٫", ",": "،、", ";": "؛", " ": "\t\u1680", "\n": "\r",
    }.items()
    for sign in signs
}  # fmt: skip
_LOWERED = "₀₁₂₃₄₅₆₇₈₉"
_SMALL_QUOTIENT = re.compile(f"(?<![⁰¹²³⁴⁵⁶⁷⁸⁹])([⁰¹²³⁴⁵⁶⁷⁸⁹]++)[/⁄]([{_LOWERED}]+)")
#: A power whose exponent holds a letter: eᵞ, 2⁻ᵖ.
_RAISED_LETTERS = re.compile("(?<=[0-9eγ)])[⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹]*[ᵝᵞᵟᵠᵖ][⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹ᵝᵞᵟᵠᵖ]*")
_LOWERED_BEHIND = re.compile(rf"(?<![\w.])[\d.]*\d[{_LOWERED}]")
_ONE_NUMBER = re.compile(r"\d(?:[\d.٫٬]*\d)?")
_RAISED_POINT = re.compile(r"\s*[-+−]?0[·⋅∙•](\d+)\s*")
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


class Source(Struct, frozen=True):
    """A stretch of typed text in its one spelling, and where it was typed.

    Attributes:
        text: the stretch.
        start: the column where it begins.
        columns: of each character, and of the end, where they do not just follow each other.
    """

    text: str
    start: int = 0
    columns: tuple[int, ...] = ()

    def part(self, start: int, stop: int) -> "Source":
        """A stretch of it, without the spaces around."""
        stretch = self.text[start:stop].rstrip()
        bare = stretch.lstrip()
        first = start + len(stretch) - len(bare)
        return Source(bare, self.column(first), self.columns[first : first + len(bare) + 1])

    def behind(self, beginning: re.Pattern[str]) -> "Source":
        """What stands behind a beginning; all of it where it does not begin so."""
        found = beginning.match(self.text)
        return self.part(found.end(), len(self.text)) if found else self

    def before(self, ending: re.Pattern[str]) -> "Source":
        """What stands before an ending; all of it where there is none."""
        found = ending.search(self.text)
        return self.part(0, found.start()) if found else self

    def column(self, index: int) -> int:
        """Where a character of it was typed."""
        return self.columns[index] if self.columns else self.start + index

    def replaced(self, pattern: re.Pattern[str], by: Callable[[re.Match[str]], str]) -> "Source":
        """The same with something else for what a pattern finds, all of it in the column where that was typed."""
        if pattern.search(self.text) is None:
            return self
        text, columns, end = "", [], 0
        for match in pattern.finditer(self.text):
            kept, new = self.text[end : match.start()], by(match)
            columns += [*map(self.column, range(end, match.start())), *[self.column(match.start())] * len(new)]
            text, end = text + kept + new, match.end()
        columns += map(self.column, range(end, len(self.text) + 1))
        return Source(text + self.text[end:], self.start, tuple(columns))

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
        if not callable(marks) and not self._holds(marks):
            return [self.part(0, len(self.text))]
        is_mark = marks if callable(marks) else lambda _, character: character in marks
        pieces, start = [], 0
        for index, character in self.outside():
            if is_mark(index, character):
                pieces.append(self.part(start, index))
                start = index + 1
        return [*pieces, self.part(start, len(self.text))]

    def has(self, marks: str) -> bool:
        """Whether one of the marks stands in no bracket."""
        return self._holds(marks) and any(character in marks for _, character in self.outside())

    def _holds(self, marks: str) -> bool:
        return not set(marks).isdisjoint(self.text)

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
    _refuse_odd_digits(text)
    # ¹⁄₄ is a number of its own, as ¼ is.
    source = Source(text).replaced(_SMALL_QUOTIENT, lambda match: _on_the_line(match, text))
    source = source.replaced(_RAISED_LETTERS, lambda match: f"^({unicodedata.normalize('NFKC', match[0])})")
    return replace(source, text="".join(map(_spelled, source.text))).part(0, len(source.text))


def _refuse_odd_digits(text: str) -> None:
    """Complain about digits that would be read as other numbers in the one spelling."""
    for number in _ONE_NUMBER.finditer(text):
        if len({ord(digit) - unicodedata.decimal(digit) for digit in number[0] if digit.isdecimal()}) > 1:
            message = f"{quoted(number[0])} mixes the digits of two scripts; write it in one."
            raise Unreadable(message, number.start())
    if lowered := _LOWERED_BEHIND.search(text):
        message = f"{quoted(lowered[0])} has a lowered digit; write all digits of a number on one line."
        raise Unreadable(message, lowered.start())
    if point := _RAISED_POINT.fullmatch(text):
        digits = quoted(f"0.{point[1]}")
        raise Unreadable(f"{quoted(text)} may be {digits} or 0 times {quoted(point[1])}; write {digits} or 0.", 0)


def _on_the_line(match: re.Match[str], text: str) -> str:
    """A quotient of small digits, as it is written on the line."""
    above, below = (unicodedata.normalize("NFKC", digits) for digits in match.groups())
    if text[: match.start()].rstrip()[-1:].isalnum():
        message = f"Is {quoted(match[0])} added or a factor? Write + or * before {above}/{below}."
        raise Unreadable(message, match.start())
    return f"({above}/{below})"


@lru_cache(maxsize=4096)
def _spelled(character: str) -> str:
    """One character for one, so that columns are kept."""
    if character in _KEPT:
        return character
    if character in _ALIKE:
        return _ALIKE[character]
    if character.isdecimal():
        return str(unicodedata.decimal(character))  # of any script
    wide = unicodedata.normalize("NFKC", character)
    if len(wide) != 1 or (wide.isdecimal() and character not in _LOWERED):  # ① is no 1
        return character
    return _ALIKE.get(wide, wide)


def spelled(text: str) -> str:
    """A name or an option in the one spelling, in which it is compared with what was typed."""
    return " ".join("".join(map(_spelled, text)).split())


def quoted(text: str) -> str:
    """A piece of what was typed, short enough to be shown inside a sentence."""
    text = " ".join(text.split())
    return f"'{text}'" if len(text) <= _QUOTED else f"'{text[: _QUOTED - 1]}…'"
