"""Where in a TOML or JSON file a value stands: the libraries that read them do not tell.

The text was read by them before, so it is well formed; what is not found here merely has no place.
"""

import json
import re
import tomllib
from bisect import bisect_right
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TypeAlias

#: The keys that lead to a value.
Keys: TypeAlias = tuple[str, ...]
#: A line and a column of it, both counted from 1.
Place: TypeAlias = tuple[int, int]

#: Answers stand no deeper: ``answers``, the problem, the part.
_DEEPEST = 3
_BLANK = re.compile(r"[ \t\r\n]*")
_TOKEN = re.compile(
    r"(?P<blank>[ \t\r]+|#[^\n]*)|(?P<end>\n)"
    r'|(?P<text>"""(?:[^\\]|\\.)*?"{3,5}|\'\'\'.*?\'{3,5}|"(?:[^"\\\n]|\\.)*"|\'[^\'\n]*\')'
    r"|(?P<sign>[\[\]{}=,.])|(?P<bare>[^\s\[\]{}=,.\"'#]+)",
    re.DOTALL,
)


def places(text: str, path: Path) -> Mapping[Keys, Place]:
    """The place of every value that an answer may be, by the keys that lead to it."""
    try:
        found = dict(_toml(text) if path.suffix.lower() == ".toml" else _json(text, 0, ()))
    except (IndexError, ValueError):  # an answer without its place is graded all the same
        return {}
    lines = [0, *(end.end() for end in re.finditer("\n", text))]

    def place(at: int) -> Place:
        line = bisect_right(lines, at)
        return line, at - lines[line - 1] + 1

    return {keys: place(at) for keys, at in found.items()}


def _json(text: str, at: int, keys: Keys) -> Iterator[tuple[Keys, int]]:
    """The values of the object that begins there."""
    decoder = json.JSONDecoder(parse_int=str, parse_float=str)
    at = _after(text, at)
    if text[at : at + 1] != "{":
        return
    at = _after(text, at + 1)
    while text[at] != "}":
        key, at = decoder.raw_decode(text, at)
        at = _after(text, _after(text, at) + 1)  # the colon
        yield (*keys, key), at
        if text[at] == "{" and len(keys) + 1 < _DEEPEST:
            yield from _json(text, at, (*keys, key))
        at = _after(text, decoder.raw_decode(text, at)[1])
        at = _after(text, at + 1) if text[at] == "," else at


def _after(text: str, at: int) -> int:
    """Where the next sign stands that is not blank."""
    blank = _BLANK.match(text, at)
    return at if blank is None else blank.end()


class _Tokens:
    """What a TOML file is made of, one after the other, without blanks and comments."""

    def __init__(self, text: str) -> None:
        self._found = (each for each in _TOKEN.finditer(text) if each.lastgroup != "blank")
        self._next = next(self._found, None)

    @property
    def sign(self) -> str:
        """The next one, if it is a sign or a line's end; a blank for anything else, nothing at the end."""
        if self._next is None:
            return ""
        return self._next[0] if self._next.lastgroup in ("sign", "end") else " "

    @property
    def at(self) -> int:
        """Where the next one begins."""
        return self._token.start()

    def take(self) -> str:
        """The next one, and on to that after it."""
        token = self._token
        self._next = next(self._found, None)
        return token[0]

    @property
    def _token(self) -> re.Match[str]:
        if self._next is None:
            raise ValueError("the text ends too early")
        return self._next

    def key(self) -> Keys:
        """A key, with dots or without."""
        found = [_plain(self.take())]
        while self.sign == ".":
            self.take()
            found.append(_plain(self.take()))
        return tuple(found)


def _plain(key: str) -> str:
    """A key without its quotes."""
    return next(iter(tomllib.loads(f"{key} = 0"))) if key[:1] in ('"', "'") else key


def _toml(text: str) -> Iterator[tuple[Keys, int]]:
    tokens = _Tokens(text)
    table: Keys = ()
    while sign := tokens.sign:
        if sign == "[":
            begun = tokens.at
            while tokens.sign == "[":
                tokens.take()
            table = tokens.key()
            while tokens.sign == "]":
                tokens.take()
            yield table, begun
        elif sign == "\n":
            tokens.take()
        else:
            yield from _pair(tokens, table)


def _pair(tokens: _Tokens, table: Keys) -> Iterator[tuple[Keys, int]]:
    """A key and its value."""
    keys = table + tokens.key()
    tokens.take()  # the equals sign
    yield from _value(tokens, keys)


def _value(tokens: _Tokens, keys: Keys) -> Iterator[tuple[Keys, int]]:
    if len(keys) <= _DEEPEST:
        yield keys, tokens.at
    if tokens.sign == "{":
        tokens.take()
        while tokens.sign != "}":
            if tokens.sign in ("\n", ","):
                tokens.take()
            else:
                yield from _pair(tokens, keys)
        tokens.take()
    elif tokens.sign == "[":
        tokens.take()
        while tokens.sign != "]":
            if tokens.sign in ("\n", ","):
                tokens.take()
            else:
                yield from _value(tokens, (*keys, ""))
        tokens.take()
    else:
        tokens.take()
        while tokens.sign in (" ", "."):  # 3.50 is three of them
            tokens.take()
