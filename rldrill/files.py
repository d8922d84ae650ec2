"""Reads files of text, TOML and JSON: every fault in one sentence, every number as it was written."""

import json
import re
import stat
import tomllib
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

from rldrill.problems.errors import FileError
from rldrill.problems.expressions import GREEK

#: What the names of files that hold data end in, and of those that hold a model.
DATA_SUFFIXES = (".toml", ".json")
MODEL_SUFFIXES = (".csv", ".tsv", ".md", ".json", ".toml", ".npz", ".pomdp", ".mdp")
#: No file that somebody hands in has more bytes.
LARGEST = 10 * 10**6
_DEEPEST = 32  # levels of brackets; a problem file needs six
_DIGITS = 40
_TOO_DEEP = f"it nests deeper than {_DEEPEST} brackets; write it flatter."
_TOO_LONG = f"a whole number has more than {_DIGITS} digits; shorten it."
_TOML_PLACE = re.compile(r" \((?:at line (\d+), column (\d+)|at end of document)\)$")
#: A key with more dots than there may be brackets: reading it takes time and memory by the square of them.
_KEY = r"(?:[\w-]++|\"(?:[^\"\\\n]|\\.)*+\"|'[^'\n]*+')[ \t]*+"
_DOTTED = re.compile(rf"(?<![^\s.\[{{,])(?:{_KEY}\.[ \t]*+){{{_DEEPEST}}}", re.ASCII)
#: A fraction, a decimal without a digit before its point and a word that are no texts, and what is one; a line of YAML.
_BARE_FRACTION = re.compile(r"(?<![\w./-])-?\d+/\d+(?![\w./-])")
_BARE_DECIMAL = re.compile(r"(?<![\w.)])([-+]?)(\.[0-9]+)\b")
_BARE_WORD = re.compile(r"^[^=#]*=\s*(?!(?:true|false|nan|inf)\b)([A-Za-z][\w-]*)\s*(?:#.*)?$")
_QUOTED = re.compile(r"\"[^\"\n]*\"|'[^'\n]*'")
_QUOTE = re.compile("[\"']")
_YAML = re.compile(r"\s*(?:- )?[\w-]+:(?:\s|$)")
_SPELLED = {glyph: name for name, glyph in GREEK.items()}
_GREEK_NAME = re.compile(rf"[\w-]*[{''.join(GREEK.values())}][\w-]*")
_KEY_SHOWN = 40


def read_data(path: str | Path, largest: int = LARGEST) -> object:
    """What a TOML or JSON file of at most so many bytes holds; what has a point or an exponent comes as exact text.

    Raises:
        FileError: the file cannot be read, is empty, or its syntax is broken.
    """
    text = read_text(path, DATA_SUFFIXES, largest)
    if not text.strip():
        raise FileError(f"{shown(path)}: the file is empty; write something into it, or name another.")
    return parse(text, path)


def read_text(path: str | Path, suffixes: Sequence[str], largest: int = LARGEST) -> str:
    """The text of a file whose name ends as one of the suffixes says.

    Raises:
        FileError: it does not exist, cannot be read, ends otherwise, is too large or is not text.
    """
    return decoded(read_bytes(path, suffixes, largest), shown(path))


def read_bytes(path: str | Path, suffixes: Sequence[str], largest: int = LARGEST) -> bytes:
    """What a file holds whose name ends as one of the suffixes says.

    Raises:
        FileError: it does not exist, cannot be read, ends otherwise or is too large.
    """
    path, where = Path(path), shown(path)
    try:
        if path.is_dir():
            raise FileError(f"{where}: this is a directory; name a file in it.")
        if not stat.S_ISREG(path.stat().st_mode):
            raise FileError(f"{where}: this is no file but a pipe or device; save what it gives to a file.")
        if path.suffix.lower() not in suffixes:
            *others, last = suffixes
            endings = f"{', '.join(others)} or {last}"
            raise FileError(f"{where}: the name must end in {endings}; rename or convert the file.")
        with path.open("rb") as file:
            content = file.read(largest + 1)
    except (FileNotFoundError, NotADirectoryError):
        raise FileError(f"{where}: there is no such file; check its name and folder.") from None
    except PermissionError:
        raise FileError(f"{where}: reading it is not permitted; change its permissions.") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise FileError(f"{where}: it cannot be read ({reason.lower()}); name another file.") from None
    if len(content) > largest:
        raise FileError(f"{where}: the file is larger than {largest // 10**6} MB; split it.")
    return content


def decoded(content: bytes, where: str) -> str:
    """What bytes say that are UTF-8, or begin with the mark of UTF-16; ``where`` is what complaints call their place.

    Raises:
        FileError: they are no text.
    """
    if content.startswith((BOM_UTF16_LE, BOM_UTF16_BE)):  # what spreadsheets call Unicode text
        try:
            return _without_nulls(content.decode("utf-16"), where)
        except UnicodeDecodeError:
            raise FileError(f"{where}: it begins as UTF-16 and is not; save the file as UTF-8.") from None
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise FileError(f"{where}, line {line}: this is not UTF-8 text; save the file as UTF-8.") from None
    return _without_nulls(text, where)


def _without_nulls(text: str, where: str) -> str:
    if "\0" in text:
        line = text.count("\n", 0, text.index("\0")) + 1
        raise FileError(f"{where}, line {line}: there is a null byte, so this is not text; save the file as UTF-8.")
    return text


def parse(text: str, path: str | Path) -> object:
    """What the text of a TOML or JSON file holds, by the suffix of its name.

    Raises:
        FileError: its syntax is broken, or a value in it is of no use.
    """
    read = _toml if Path(path).suffix.lower() == ".toml" else _json
    return _parsed(read, text, shown(path), None)


def parse_line(text: str, path: str | Path, line: int) -> object:
    """What one line of a JSON Lines file holds; ``line`` is its number, for complaints.

    Raises:
        FileError: its syntax is broken, or a value in it is of no use.
    """
    return _parsed(_json, text, shown(path), line)


class _BrokenError(ValueError):
    """Broken syntax at a line and column of the text, or at its end, and what to do about it."""

    def __init__(self, reason: str, line: int | None, column: int | None, cure: str = "fix it there") -> None:
        super().__init__(reason)
        self.line, self.column, self.cure = line, column, cure


class _RefusedError(ValueError):
    """A value that is well written but of no use; the message says why and what to do."""


def _parsed(read: Callable[[str], object], text: str, where: str, line: int | None) -> object:
    here = where if line is None else f"{where}, line {line}"
    try:
        data = read(text)
        _check(data)
    except _BrokenError as error:
        if error.line is None:
            place = f"{where}, at its end"
        else:
            place = f"{where}, line {error.line + (line or 1) - 1}, column {error.column}"
        raise FileError(f"{place}: the syntax is broken ({error}); {error.cure}.") from None
    except RecursionError:
        raise FileError(f"{here}: {_TOO_DEEP}") from None
    except _RefusedError as error:
        raise FileError(f"{here}: {error}") from None
    except ValueError:  # Python converts no whole numbers of more than 4300 digits
        raise FileError(f"{here}: {_TOO_LONG}") from None
    return data


def _toml(text: str) -> object:
    if _DOTTED.search(text):
        raise _RefusedError(_TOO_DEEP)
    try:
        return tomllib.loads(text, parse_float=_number)
    except tomllib.TOMLDecodeError as error:
        message = str(error)
        place = _TOML_PLACE.search(message)
        line, column = (int(place[1]), int(place[2])) if place and place[1] else (None, None)
        cure = _cure(message, text.split("\n")[line - 1 if line else -1])
        raise _BrokenError(_begun_small(_TOML_PLACE.sub("", message)), line, column, cure) from None


def _cure(message: str, line: str) -> str:
    """What to do about a line of TOML that cannot be read, by the most usual slips."""
    key = line.partition("=")[0].strip()
    if r"'\n'" in message and len(_QUOTE.findall(line)) % 2:
        return "a quote that begins there is not closed; close it"
    if "overwrite" in message:
        return f"{key[:_KEY_SHOWN]} stands twice; keep one of them"
    if found := _BARE_FRACTION.search(_QUOTED.sub("", line)):
        return f'a fraction stands in quotes: "{found[0]}"'
    if found := _BARE_DECIMAL.search(_QUOTED.sub("", line)):
        return f"a number begins with a digit: {found[1]}0{found[2]}"
    if found := _BARE_WORD.search(_QUOTED.sub('""', line)):
        return f'a text stands in quotes: "{found[1][:_KEY_SHOWN]}"'
    if found := _GREEK_NAME.search(_QUOTED.sub("", line)):
        name = "".join(_SPELLED.get(sign, sign) for sign in found[0][:_KEY_SHOWN])
        return f"a Greek name stands in quotes there, or is spelled out: {name}"
    if _YAML.match(line):
        return "write name = value, as TOML has it; YAML is not read"
    return "fix it there"


def _json(text: str) -> object:
    try:
        return json.loads(text, parse_float=str, parse_constant=str, object_pairs_hook=_distinct)
    except json.JSONDecodeError as error:
        raise _BrokenError(_begun_small(error.msg), error.lineno, error.colno) from None


def _number(literal: str) -> str:
    return literal.replace("_", "")


def _distinct(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    result: dict[str, Any] = {}
    for key, value in pairs:
        if key in result:
            raise _RefusedError(f"the key {brief(key)} stands twice in one object; keep one of them.")
        result[key] = value
    return result


def _check(data: object) -> None:
    """Refuse what no later step could handle: deep nesting, endless numbers, halves of characters."""
    level, layer = 0, [data]
    while layer:
        for item in layer:
            _check_item(item)
        layer = [child for item in layer for child in _children(item)]
        level += 1
        if level > _DEEPEST:
            raise _RefusedError(_TOO_DEEP)


def _check_item(item: object) -> None:
    if isinstance(item, int) and abs(item) >= 10**_DIGITS:
        raise _RefusedError(_TOO_LONG)
    if isinstance(item, str) and not item.isascii():
        try:
            item.encode()
        except UnicodeEncodeError:
            raise _RefusedError(f"{brief(item)} holds half a character; retype it.") from None


def _children(item: object) -> Iterator[object]:
    if isinstance(item, dict):
        yield from item
        yield from item.values()
    elif isinstance(item, list):
        yield from item


def _begun_small(message: str) -> str:
    return message[:1].lower() + message[1:]


def shown(path: str | Path) -> str:
    """A path as it is written in sentences and tables: what a terminal cannot print is escaped."""
    return "".join(sign if sign.isprintable() else repr(sign)[1:-1] for sign in str(path))


def brief(value: object) -> str:
    """A scalar as it is quoted in a sentence."""
    text = repr(value) if isinstance(value, str | int | float) else kind_of(value)
    return text if len(text) <= 40 else f"{text[:39]}…"


def kind_of(value: object) -> str:
    """What a value is called in a sentence."""
    return {dict: "a table", list: "a list", str: "a text", type(None): "nothing"}.get(type(value), "a single value")
