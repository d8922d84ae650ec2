r"""LaTeX in what a person typed, put as it is typed without: ``\frac14`` is ``((1)/(4))``, ``2\gamma`` is ``2γ``."""

import re
import unicodedata

from rldrill.problems.notation import FUNCTIONS
from rldrill.problems.spelling import Source, quoted, respelled

_DEPTH = 40
_QUOTIENTS = frozenset({"frac", "dfrac", "tfrac", "cfrac", "nicefrac", "sfrac"})
_SIGNS = dict.fromkeys(("cdot", "times", "ast", "bullet"), "*") | dict.fromkeys(("approx", "simeq", "sim"), "≈")
_SIGNS |= {
    "div": "/",
    "infty": "∞",
    "to": "→",
    "rightarrow": "→",
    "mapsto": "↦",
    "mid": "|",
    "prime": "'",
    "circ": "∘",
    "degree": "°",
}
_SIGNS |= dict.fromkeys(("quad", "qquad", ",", ";", ":", "!", " ", "displaystyle", "textstyle"), " ")
_SIGNS |= {sign: sign for sign in "%{}$#_"} | dict.fromkeys("()[]", "")
_SIZES = frozenset({"left", "right"} | {size + side for size in ("big", "Big", "bigg", "Bigg") for side in ("", *"lr")})
_SETTINGS = frozenset({"text", "mathrm", "mathbf", "mathit", "mathcal", "operatorname", "mbox", "boxed"})
_MARKS = {"overline": "\u0305", "bar": "\u0305", "dot": "\u0307"}
_COMMAND = re.compile(r"\\([A-Za-z]+|.)", re.DOTALL)
_WHOLE_BEFORE = re.compile(r"(?<![\w.^])[0-9]+\s*$")
_INDEX = re.compile(r"\s*\[\s*([0-9]+)\s*\]")
_PLAIN = re.compile(r"[0-9]+")


def typed(text: str, longest: int) -> Source:
    """A typed text in the one spelling and without LaTeX; matrices and rows, ``&`` and a double backslash, stay.

    Raises:
        Unreadable: it is longer than ``longest``, or holds characters that cannot be seen, or half a command.
    """
    source = respelled(text, longest)
    if source.text.count("$") % 2 == 0:  # one alone is a currency
        source = source.replaced(re.compile(r"(?<!\\)\$"), lambda _: "")
    source = source.part(0, len(source.text))
    return _Reader(source).all() if "\\" in source.text else source


class _Reader:
    """Copies a text character by character, with its commands put in plain signs."""

    def __init__(self, source: Source) -> None:
        self._source, self._text = source, source.text
        self._at = self._depth = 0
        self._written: list[tuple[str, int]] = []  # characters, and where each was typed

    def all(self) -> Source:
        while self._at < len(self._text):
            self._piece()
        text = "".join(character for character, _ in self._written)
        columns = (*(column for _, column in self._written), self._source.column(len(self._text)))
        return Source(text, columns=columns).part(0, len(text))

    def _write(self, text: str) -> None:
        column = self._source.column(min(self._at, len(self._text)))
        self._written += [(character, column) for character in text]

    def _last(self) -> str:
        return self._written[-1][0] if self._written else ""

    def _piece(self) -> None:
        """One character or command."""
        command = _COMMAND.match(self._text, self._at)
        if command is None:
            self._write(self._text[self._at])
            self._at += 1
        elif command[1] == "\\":
            self._write(command[0])
            self._at = command.end()
        else:
            self._command(command[1], command.end())

    def _command(self, name: str, end: int) -> None:
        if name in _QUOTIENTS:
            self._quotient(end)
        elif name == "sqrt":
            self._root(end)
        elif name in _MARKS:
            self._at = end
            for character, column in self._argument():
                self._written += [(character, column), *([(_MARKS[name], column)] if character.isdecimal() else [])]
        elif name in _SETTINGS:
            self._at = end
            self._written += self._argument()
        else:
            plain = _plain(name)
            self._apart(plain or "")
            self._write(self._text[self._at : end] if plain is None else plain)
            self._at = end

    def _apart(self, word: str) -> None:
        """A space, if a word would run into the letter before it."""
        if word[:1].isalpha() and word.isascii() and self._last().isalpha() and self._last().isascii():
            self._write(" ")

    def _quotient(self, end: int) -> None:
        r"""``\frac{a}{b}``; behind a whole number it may be added to it, or multiplied."""
        start, self._at = self._at, end
        above, below = self._argument(), self._argument()
        numbers = ["".join(character for character, _ in side) for side in (above, below)]
        before = _WHOLE_BEFORE.search("".join(character for character, _ in self._written[-50:]))
        if before and all(map(_PLAIN.fullmatch, numbers)):
            fraction = "/".join(numbers)
            readings = f"{before[0].strip()} + {fraction} or {before[0].strip()}*{fraction}"
            raise self._source.unreadable(f"It may be {readings}; write the one that is meant.", start)
        column = self._source.column(start)
        self._written += [("(", column), ("(", column), *above, (")", column), ("/", column), ("(", column)]
        self._written += [*below, (")", column), (")", column)]

    def _root(self, end: int) -> None:
        column = self._source.column(self._at)
        index = _INDEX.match(self._text, end)
        before, behind = ("((", f")^(1/{index[1]}))") if index else ("sqrt(", ")")
        self._apart(before)
        self._at = index.end() if index else end
        inner = self._argument()
        self._written += [*((sign, column) for sign in before), *inner, *((sign, column) for sign in behind)]

    def _argument(self) -> list[tuple[str, int]]:
        """What a command is applied to: what stands in braces, or one character or command."""
        start = self._at
        while self._at < len(self._text) and self._text[self._at].isspace():
            self._at += 1
        self._depth += 1
        if self._depth > _DEPTH:
            raise self._source.unreadable(f"It nests deeper than {_DEPTH} brackets; write it in a simpler form.", start)
        kept, self._written = self._written, []
        braces = self._text[self._at : self._at + 1] == "{"
        if braces:
            self._at += 1
            self._up_to_brace()
        elif self._at < len(self._text):
            self._piece()
        inner, self._written = self._written, kept
        self._depth -= 1
        if not inner:
            where = quoted(self._text[max(start - 6, 0) : start + 6])
            raise self._source.unreadable(f"The command at {where} is applied to nothing; complete it.", start - 1)
        return inner

    def _up_to_brace(self) -> None:
        start, open_ = self._at - 1, 1
        while self._at < len(self._text):
            character = self._text[self._at]
            open_ += (character == "{") - (character == "}")
            if open_ == 0:
                self._at += 1
                return
            self._piece()
        raise self._source.unreadable("The bracket '{' is not closed; close it.", start)


def _plain(name: str) -> str | None:
    """What stands for a command without an argument; None for one that is not known."""
    if name in _SIGNS:
        return _SIGNS[name]
    if name in _SIZES:
        return ""
    if name in FUNCTIONS:
        return name
    letter = (name.removeprefix("var") or name).replace("lambda", "lamda").replace("Lambda", "Lamda")
    size = "CAPITAL" if letter[0].isupper() else "SMALL"
    try:
        return unicodedata.lookup(f"GREEK {size} LETTER {letter.upper()}")
    except KeyError:
        return None
