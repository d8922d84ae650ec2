"""Texts for terminals, pipes and files whose encoding lacks signs: ASCII spellings, never question marks.

What has another spelling is told apart from what is spelled so itself: where γ is written ``gamma``, a state that is
called gamma is written ``"gamma"``, with its quotes.
"""

import re
from collections.abc import Callable
from functools import partial
from typing import Any
from unicodedata import name, normalize

from msgspec import Struct
from msgspec.structs import fields, replace

from rldrill.problems.mathematics import Math
from rldrill.problems.pictures import Picture
from rldrill.render.mathematics.stacked import stacked
from rldrill.render.mathematics.unicode import ABOVE, BELOW, GLUE, inline, unicode

#: What pictures and tables are drawn with: one sign for one.
_DRAWN = str.maketrans(
    "─━│┊┃┌┐└┘├┤┬┴┼╭╮╰╯╴╶╵╷╸╺╹╻═║╔╗╚╝╠╣╦╩╬○●□▶█▉▊▋▌▍▎▏⎡⎢⎣⎤⎥⎦⎛⎜⎝⎞⎟⎠⎧⎨⎩",
    "--|||+++++++++++++--||--||-|+++++++++o*#>####||||[[[]]]((()))" + "{{{",
)
_SPELLED = {
    "−": "-", "–": "-", "—": "-", "‐": "-", "‑": "-", "‒": "-", "′": "'", "″": "''", "…": "...", "’": "'", "‘": "'",
    "“": '"', "”": '"', "„": '"', "·": "*", "⋅": "*", "∙": "*", "∗": "*", "×": "x", "÷": "/", "∕": "/", "⁄": "/",
    "≤": "<=", "≥": ">=", "≠": "!=", "≈": "~", "∼": "~", "±": "+-", "←": "<-", "→": "->", "↦": "|->", "∞": "inf",
    "√": "sqrt", "‖": "||", "⟨": "<", "⟩": ">", "∈": "in", "∇": "grad", "∫": "int", "∑": "sum", "∏": "prod", "∂": "d",
    "∀": "for all", "𝔼": "E", "⊤": "T", "°": " deg", "✓": "+", "✗": "x", "\u00a0": " ",
    "\u0302": "_hat", "\u0303": "_tilde", "\u0304": "_bar", "ϕ": "phi", "ϵ": "epsilon", "ϑ": "theta", "ς": "sigma",
}  # fmt: skip
_GREEK = re.compile(r"[Α-Ωα-ωϕϵϑ]+")
#: What is spelled like something else, and stands in the text as it is.
_ALIKE = re.compile(
    r"(?<![\w\"])(?:[Aa]lpha|[Bb]eta|[Gg]amma|[Dd]elta|[Ee]psilon|[Zz]eta|[Ee]ta|[Tt]heta|[Ii]ota|[Kk]appa|[Ll]ambda"
    r"|[Mm]u|[Nn]u|[Xx]i|[Oo]micron|[Pp]i|[Rr]ho|[Ss]igma|[Tt]au|[Uu]psilon|[Pp]hi|[Cc]hi|[Pp]si|[Oo]mega"
    r"|[A-Za-z]+_\d+)(?![\w\"])",
    re.ASCII,
)
_SHIFTED = {
    "^": {small: plain for plain, small in ABOVE.items()},
    "_": {small: plain for plain, small in BELOW.items()},
}
_RUNS = {mark: re.compile(f"[{''.join(signs)}]+(′*)") for mark, signs in _SHIFTED.items()}


def shows_all(encoding: str) -> bool:
    """Whether an encoding has every sign."""
    return encoding.lower().replace("_", "-").startswith("utf")


class Spelling(Struct, frozen=True):
    """How texts, mathematics and pictures are written where the encoding is this one."""

    encoding: str = "utf-8"

    def plain(self, text: str) -> str:
        """A text without mathematics between ``$`` signs."""
        return text if shows_all(self.encoding) else _spelled(_apart(text), self._lacks)

    def inline(self, text: str, *, glued: bool = False) -> str:
        """A text with its mathematics on the same line; ``glued`` where short formulas stay in one piece."""
        written = inline(text, glued=glued)
        return written if shows_all(self.encoding) else _spelled(_quoted(written), self._lacks)

    def stacked(self, math: Math) -> list[str]:
        """Mathematics on as many lines as its matrices need."""
        return [self._drawn(line) for line in stacked(math, self._unicode)]

    def _unicode(self, math: Math) -> str:
        return unicode(math) if shows_all(self.encoding) else _spelled(_quoted(unicode(math)), self._lacks)

    def lines(self, picture: Picture, width: int = 100) -> list[str]:
        """A picture as lines of signs, its labels spelled before they are placed."""
        from rldrill.render.pictures.text import lines

        if shows_all(self.encoding):
            return lines(picture, width)
        return [self._drawn(line) for line in lines(_relabelled(picture, self.inline), width)]

    def _drawn(self, line: str) -> str:
        return "".join(_sign(char) if self._lacks(char) else char for char in line)

    def _lacks(self, text: str) -> bool:
        try:
            text.replace(GLUE, " ").encode(self.encoding)
        except UnicodeEncodeError:
            return True
        return False


#: The spelling that leaves everything as it is.
UNICODE = Spelling()


def _relabelled(value: Any, write: Callable[[str], str]) -> Any:
    """A picture whose texts are written already; the kinds of its nodes are no texts."""
    if isinstance(value, str):
        return write(value)
    if isinstance(value, tuple):
        return tuple(_relabelled(item, write) for item in value)
    if isinstance(value, Struct):
        labelled = [field.name for field in fields(value) if field.name not in ("kind", "shape")]
        return replace(value, **{label: _relabelled(getattr(value, label), write) for label in labelled})
    return value


def _quoted(text: str) -> str:
    """A text in which all that is spelled like something else stands in quotes."""
    return _ALIKE.sub(r'"\g<0>"', text)


def _apart(text: str) -> str:
    """The same where something else may stand in the text."""
    return _quoted(text) if _GREEK.search(text) or _RUNS["_"].search(text) else text


def _spelled(text: str, lacks: Callable[[str], bool]) -> str:
    text = re.sub(r" · ", lambda dot: "; " if lacks(dot[0]) else dot[0], text)
    text = re.sub(r"√(\d+|[^\W\d])", lambda root: f"sqrt({root[1]})" if lacks("√") else root[0], text)
    for mark, run in _RUNS.items():
        text = run.sub(partial(_shifted, mark, lacks), text)
    text = _GREEK.sub(lambda found: _letters(found) if lacks(found[0]) else found[0], text)
    return "".join(_sign(char) if lacks(char) else char for char in text)


def _shifted(mark: str, lacks: Callable[[str], bool], found: re.Match[str]) -> str:
    """A subscript or superscript after its mark, in brackets where it would not be seen where it ends."""
    if not lacks(found[0]):
        return found[0]
    signs = _SHIFTED[mark]
    stem = "".join(signs.get(char, char) for char in found[0].rstrip("′")).replace("−", "-")
    if not re.fullmatch(r"-?\w+|\(.*\)", stem):
        stem = f"({stem})"
    return f"{mark}{stem}{found[1]}{_room(found)}"


def _letters(found: re.Match[str]) -> str:
    """Greek letters as words, with room to the letters and numbers beside them."""
    before = found.string[: found.start()][-1:]
    sums = found[0] == "Σ" and found.string[found.end() : found.end() + 1] == "_"
    words = "sum" if sums else " ".join(map(_sign, found[0]))
    return f"{' ' if before.isalnum() else ''}{words}{_room(found)}"


def _room(found: re.Match[str]) -> str:
    return " " if found.string[found.end() : found.end() + 1].isalnum() else ""


def _sign(char: str) -> str:
    """One sign, spelled in ASCII; a sign that nobody spells is written as Python escapes it."""
    if char in _SPELLED:
        return _SPELLED[char]
    if ord(char) in _DRAWN:
        return char.translate(_DRAWN)
    if "\u2800" <= char <= "\u28ff":
        return _dots(ord(char) - 0x2800)
    for mark, signs in _SHIFTED.items():
        if char in signs:
            return mark + signs[char]
    if _GREEK.fullmatch(char):
        letter = name(char).split()[-1].lower().replace("lamda", "lambda")
        return letter if char.islower() else letter.capitalize()
    compatible = normalize("NFKC", char).replace("\u2044", "/")
    if compatible != char and compatible.isascii() and not char.isalpha():
        return compatible
    return char if char.isascii() else char.encode("ascii", "backslashreplace").decode()


def _dots(bits: int) -> str:
    """The dots of a sign in Braille: above, below or both."""
    above, below = bits & 0b00011011, bits & 0b11100100
    return ":" if above and below else "'" if above else "." if below else " "


def replaced(error: UnicodeError) -> tuple[str, int]:
    """The spelling of signs that a stream lacks, as the error handlers of streams give it."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    spelled = "".join(map(_sign, error.object[error.start : error.end]))
    return spelled.encode("ascii", "backslashreplace").decode(), error.end
