"""Reads what a person typed as an answer: a number, a vector, a matrix, a table, a policy or a choice."""

import re
import unicodedata
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple, TypeVar

from rldrill.problems.expressions import GREEK
from rldrill.problems.grammar import refuse_comma
from rldrill.problems.notation import FUNCTIONS
from rldrill.problems.spelling import Source, Unreadable, quoted, spelled
from rldrill.solutions.answers.arithmetic import Arithmetic
from rldrill.solutions.answers.numbers import Reading, number
from rldrill.solutions.answers.source import clean

__all__ = [
    "Reading",
    "Unreadable",
    "read_choice",
    "read_matrix",
    "read_number",
    "read_table",
    "read_vector",
    "read_words",
    "read_yes_no",
]

Key = TypeVar("Key", bound=str | tuple[str, str])

# x · V(s) · V^π(s) · R_0 · V_{k+1}(s) · Q̂(s, a) · ∂J/∂θ₁
_MARKS = "\u0300-\u036f"  # the hat, bar or tilde on a letter
_NAME = rf"(?:[∂d]\w*/[∂d])?[^\W\d_](?:[\w '^*⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⊤{_MARKS}]|\{{[^{{}}=]*\}}|\([^()=]*\)|\[[^\[\]=]*\])*"
_LEFT_SIDE = re.compile(rf"(?:{_NAME})?=(?!=)")
_LABEL = re.compile(rf"({_NAME})(?::|=(?!=))")
_TRANSPOSED = re.compile(r"(?<=[\])}⟩])\s*(?:\^\s*\{?[T⊤]\}?|ᵀ|\.T|')$")
_ARROW = re.compile(r"->|→|↦|:=|[:=]")
# V(cool), V^(π₀)(cool), ln p(cool), (cool, fast)
_OF = re.compile(rf"(?:[^\W\d_](?:[\^_][({{][^(){{}}]*[)}}]|[\w '^*⊤{_MARKS}])*)?[(\[](.*)[)\]]")
_BELOW = re.compile(rf"[^\W\d_][{_MARKS}]?_\{{?(.*?)\}}?")  # V_cool
_LETTER = re.compile(r"[^\W\d_]['′]*(?:_?\d+)?")  # s, s', s_0
_SPELLED_OUT = str.maketrans({glyph: name for name, glyph in GREEK.items()} | {"π": "pi", "∂": "d"})
_YES = frozenset({"yes", "y", "true", "t", "ja", "j"})
_NO = frozenset({"no", "n", "false", "f", "nein"})
_LISTED = 60
_ENTRIES = 200


def read_number(text: str, parameters: Sequence[str] = ()) -> Reading:
    """Read one number.

    Args:
        text: what was typed.
        parameters: the names of the open parameters that it may contain, as in ``PARAMETERS``.

    Raises:
        Unreadable: it is not one number.
    """
    source = _right_side(clean(text))
    return number(source.unwrapped("[") or source, parameters, Arithmetic())


def read_vector(
    text: str, length: int | None = None, parameters: Sequence[str] = (), names: Sequence[str] = ()
) -> tuple[Reading, ...]:
    """Read a vector: ``1, 2`` or ``[1 2]`` or ``(1; 2)``, or by name: ``mu: 1, Sigma: 2``.

    Args:
        text: what was typed.
        length: how many numbers are needed, if that is known.
        parameters: the names of the open parameters that it may contain.
        names: what the entries are, in mathematics; entries that are typed with these names may stand in any order.

    Raises:
        Unreadable: an entry is not a number, or is given twice, or there are too few or too many.
    """
    source = clean(text)
    entries = _vector(_untransposed(source), length)
    if len(entries) == 1 or not all(_LABEL.match(entry.text) for entry in entries[1:]):
        source = _right_side(source)  # R = 1, 2
        entries = _vector(_untransposed(source), length)
    entries = _unlabelled(entries, names)  # R_0 = 1, R_1 = 2
    readings = _numbers(entries, parameters, "entry {}".format if len(entries) != 1 else None)
    if length is not None and len(readings) != length:
        raise source.unreadable(
            f"{_count(len(readings))} read, {length} {_are(length)} needed.{_comma(source, len(readings), length)}"
        )
    return readings


def read_matrix(
    text: str, shape: tuple[int, int] | None = None, parameters: Sequence[str] = ()
) -> tuple[tuple[Reading, ...], ...]:
    """Read a matrix by its rows: ``[[1, 2], [3, 4]]`` or ``[1 2; 3 4]`` or one row on each line.

    Args:
        text: what was typed.
        shape: the rows and columns that are needed, if that is known; a single row or column may
            then be typed as a vector, and a single entry as a number.
        parameters: the names of the open parameters that it may contain.

    Raises:
        Unreadable: an entry is not a number, or the shape is another one.
    """
    source = _right_side(clean(text))
    body = _untransposed(source)
    rows = _nested_rows(body)
    plain = rows is None
    if rows is None:
        rows = _plain_rows(body)
    if len(rows) > _ENTRIES:
        raise source.unreadable(f"More than {_ENTRIES} rows were typed; leave out those that were not asked for.")
    arithmetic, alone = Arithmetic(), len(rows) == len(rows[0]) == 1
    matrix = [
        _numbers(row, parameters, None if alone else f"row {i}, entry {{}}".format, arithmetic)
        for i, row in enumerate(rows, 1)
    ]
    for i, row in enumerate(matrix, 1):
        if len(row) != len(matrix[0]):
            raise source.unreadable(f"Row {i} has length {len(row)}, row 1 has {len(matrix[0])}; make them equal.")
    if body is not source:
        matrix = list(zip(*matrix, strict=True))
    read = (len(matrix), len(matrix[0]))
    if shape is not None and read != shape:
        if not (plain and 1 in read and read == shape[::-1]):
            sizes = f"A {read[0]}×{read[1]} matrix was read, {shape[0]}×{shape[1]} is needed."
            raise source.unreadable(sizes + _comma(source, read[0] * read[1], shape[0] * shape[1]))
        matrix = list(zip(*matrix, strict=True))
    return tuple(matrix)


def read_table(text: str, keys: Sequence[Key], parameters: Sequence[str] = ()) -> dict[Key, Reading]:
    """Read a number for each key: ``cool: 3.5, warm: 2.5``, or the numbers alone in the keys' order.

    Args:
        text: what was typed.
        keys: the states, or the pairs of state and action, that each need a number.
        parameters: the names of the open parameters that the numbers may contain.

    Raises:
        Unreadable: a key is unknown, repeated or missing, or its number cannot be read.
    """
    source = clean(text)
    items = _items(source, keys)
    if items is None:
        try:
            readings = read_vector(text, len(keys), parameters)
        except Unreadable:
            readings = read_vector(text, None, parameters)
        if len(readings) != len(keys):
            needed = f"{len(keys)} {_are(len(keys))} needed: {_listed(map(_shown, keys))}."
            raise source.unreadable(f"{_count(len(readings))} read, {needed}{_comma(source, len(readings), len(keys))}")
        return dict(zip(keys, readings, strict=True))
    arithmetic = Arithmetic()
    found = {}
    for key, item in _by_key(items, keys).items():
        place = _shown(key)
        (found[key],) = _numbers([item], parameters, lambda _, place=place: place, arithmetic)
    return found


def read_words(text: str, keys: Sequence[str], options: Mapping[str, Sequence[str]]) -> dict[str, str]:
    """Read a policy: ``cool: fast, warm: slow``, or the actions alone in the keys' order.

    Args:
        text: what was typed.
        keys: the states.
        options: the actions that are allowed in each.

    Raises:
        Unreadable: a state is unknown, repeated or missing, or its action is not allowed.
    """
    source = clean(text)
    items = _items(source, keys)
    if items is None:
        body = _right_side(source)
        words = [word for word in (body.unwrapped() or body).split(",;\n") if word.text]
        if len(words) == 1 < len(keys):
            words = [word for word in words[0].split(" ") if word.text]
        if len(words) != len(keys):
            needed = f"{len(keys)} {_are(len(keys))} needed: {_listed(keys)}."
            raise source.unreadable(f"{_count(len(words), 'word')} read, {needed}")
        placed = dict(zip(keys, words, strict=True))
    else:
        placed = _by_key(items, keys)
    return {key: _option(word, key, options[key]) for key, word in placed.items()}


def read_choice(text: str, options: Mapping[str, str]) -> str:
    """Read which option was chosen, and give its letter.

    It may be typed as its letter, ``b`` or ``(b)``, its text, how its text begins, or words of it that no other has.

    Args:
        text: what was typed.
        options: the text of every option, by its letter.

    Raises:
        Unreadable: no option fits, or several do.
    """
    source = clean(text)
    spellings = [(told.replace("$", ""), letter) for letter, told in options.items()]
    typed = re.fullmatch(r"\(?([A-Za-z])[).:]?", source.text)
    lettered = [letter for letter in options if typed and letter.casefold() == typed[1].casefold()]
    marked = bool(lettered) and len(source.text) > 1  # (b) is no text
    named = [] if marked else _matches(source.text, spellings)
    hits = list(dict.fromkeys(lettered + named)) or _partly(source.text, spellings)
    if len(hits) == 1:
        return hits[0]
    fault = "fits more than one option" if hits else "is not one of the options"
    raise source.unreadable(f"{quoted(source.text)} {fault}; type a letter from {min(options)} to {max(options)}.")


def _partly(typed: str, spellings: Sequence[tuple[str, str]]) -> list[str]:
    """The one option that has the typed words; else those that begin as typed."""
    typed = typed.casefold().rstrip(". ")
    if not typed:
        return []
    told = [(spelled(spelling).casefold(), letter) for spelling, letter in spellings]
    words = re.compile(rf"(?<!\w){re.escape(typed)}(?!\w)")
    having = [letter for spelling, letter in told if words.search(spelling)]
    return having if len(having) == 1 else [letter for spelling, letter in told if spelling.startswith(typed)] or having


def read_yes_no(text: str) -> bool:
    """Read yes or no.

    Raises:
        Unreadable: it is neither.
    """
    source = clean(text)
    word = source.text.casefold().rstrip(".!")
    if word in _YES or word in _NO:
        return word in _YES
    raise source.unreadable(f"{quoted(source.text)} is neither yes nor no; type one of them.")


def _right_side(source: Source) -> Source:
    """What is typed after ``x =`` or ``V(s) =``."""
    left = _LEFT_SIDE.match(source.text)
    return source.part(left.end(), len(source.text)) if left else source


def _unlabelled(entries: list[Source], names: Sequence[str]) -> list[Source]:
    """The entries without the ``R_0 =`` or ``R_0:`` before each; in the order of the names, if all are known."""
    labels = [_LABEL.match(entry.text) for entry in entries]
    values = [
        entry.part(label.end(), len(entry.text)) if label else _right_side(entry)
        for entry, label in zip(entries, labels, strict=True)
    ]
    meant = [index for label in labels if label and (index := _entry(label[1], names)) is not None]
    if len(meant) < len(entries):
        return values
    placed: dict[int, Source] = {}
    for entry, value, index in zip(entries, values, meant, strict=True):
        if index in placed:
            raise entry.unreadable(f"Entry {index + 1} is given twice; give every entry once.")
        placed[index] = value
    return [placed[index] for index in sorted(placed)]


def _entry(label: str, names: Sequence[str]) -> int | None:
    """Which entry a label means; its index may be left out where no other entry has the same letter."""
    typed = _plain(label)
    for form in (_plain, lambda name: _plain(name).rstrip("0123456789")):
        hits = [index for index, name in enumerate(names) if form(name) == typed]
        if len(hits) == 1:
            return hits[0]
    return None


def _untransposed(source: Source) -> Source:
    """A bracket without the ``^T`` behind it; the source itself if there is none."""
    mark = _TRANSPOSED.search(source.text)
    return source.part(0, mark.start()) if mark else source


def _vector(source: Source, length: int | None) -> list[Source]:
    body, wrapped = _unwrapped(source)
    entries = _list(body, length != 1 and (wrapped or length is not None))
    columns = [entry.unwrapped("[") for entry in entries]  # [[1], [2]]
    whole = [column for column in columns if column]
    return whole if len(whole) == len(entries) else entries


def _unwrapped(source: Source) -> tuple[Source, bool]:
    """What stands in up to three pairs of brackets around it all, and whether there are any."""
    body = source
    for _ in range(3):
        body = body.unwrapped() or body
    return body, body is not source


def _list(source: Source, spaced: bool) -> list[Source]:
    """The entries between semicolons, else commas, else lines, else (if ``spaced``) spaces."""
    if source.has(";"):
        entries = source.split(";")
        for entry in entries:
            for index, character in entry.outside():
                if character == ",":
                    refuse_comma(entry, index)
                    raise entry.unreadable("Commas and semicolons are mixed; use one of them.", index)
    elif source.has(","):
        entries = source.split(",")
    elif source.has("\n"):
        entries = [source]
    else:
        return _filled(source.split(_gap(source))) if spaced else [source]
    if len(entries) > 1 and not entries[-1].text:
        del entries[-1]
    return [line for entry in entries for line in _filled(entry.split("\n"))]


def _filled(pieces: list[Source]) -> list[Source]:
    """The pieces that are not blank; a blank one if all are, to be complained about."""
    return [piece for piece in pieces if piece.text] or pieces[:1]


def _gap(source: Source) -> Callable[[int, str], bool]:
    """Whether a space parts two entries: ``[1 -2]`` are two, ``[1 - 2]`` is one."""

    def parts(index: int, character: str) -> bool:
        if not character.isspace():
            return False
        before, after = source.text[:index].rstrip(), source.text[index:].lstrip()
        word = re.search("[A-Za-z]+$", before[-5:])
        if before.endswith(tuple("+-*/^√")) or (word and word[0].lower() in FUNCTIONS):
            return False
        sign, behind = after[:1], after[1:2]
        return not (sign in "*/^%" or (sign in "+-" and behind.isspace()))

    return parts


def _nested_rows(source: Source) -> list[list[Source]] | None:
    """The entries of rows that each have brackets of their own; None if they have not."""
    for whole, fewest in ((source.unwrapped(), 1), (source, 2)):
        pieces = [piece for piece in whole.split(",;\n ") if piece.text] if whole else []
        rows = [piece.unwrapped("[{⟨") or piece.unwrapped("(") for piece in pieces]
        if len(rows) < fewest:
            continue
        found = [
            row for piece, row in zip(pieces, rows, strict=True) if row and (piece.text[0] != "(" or row.has(",;"))
        ]
        if len(found) == len(rows):
            return [_list(row, True) for row in found]
    return None


def _plain_rows(source: Source) -> list[list[Source]]:
    """The entries of rows that end with a semicolon or a line."""
    body, wrapped = _unwrapped(source)
    rows = _filled(body.split(";\n"))
    return [_list(row, wrapped or len(rows) > 1) for row in rows]


def _numbers(
    entries: Sequence[Source],
    parameters: Sequence[str],
    place: Callable[..., str] | None,
    arithmetic: Arithmetic | None = None,
) -> tuple[Reading, ...]:
    """Read some entries with one effort; ``place`` names an entry by its number, counted from 1."""
    if len(entries) > _ENTRIES:
        raise Unreadable(f"More than {_ENTRIES} numbers were typed; leave out those that were not asked for.")
    arithmetic = arithmetic or Arithmetic()
    readings = []
    for i, entry in enumerate(entries, 1):
        try:
            readings.append(number(entry, parameters, arithmetic))
        except Unreadable as complaint:
            raise (complaint.within(place(i)) if place else complaint) from None
    return tuple(readings)


class _Item(NamedTuple):
    """What is typed for a key: ``cool: 3.5``."""

    name: str
    value: Source
    whole: Source


def _items(source: Source, keys: Sequence[Key]) -> list[_Item] | None:
    """What is typed for each key; None if no keys are typed."""
    body = source.unwrapped() or source
    pieces = [piece for piece in body.split(",;\n") if piece.text]
    items = [_item(piece) for piece in pieces]
    named = [item for item in items if item]
    if not named:
        return None
    first, several = items[0], len(items) > 1 or named[0].value.unwrapped()
    if first and several and len(named) == 1 < len(keys) and not _keys(first.name, keys):
        return None  # V = 3.5, 2.5
    return _joined(pieces, items, keys)


def _joined(pieces: list[Source], items: list[_Item | None], keys: Sequence[Key]) -> list[_Item]:
    """The items, with the first half of a pair put before the second: ``cool, fast: 3.5``."""
    joined: list[_Item] = []
    half = ""
    for piece, item in zip(pieces, items, strict=True):
        if item:
            joined.append(item._replace(name=f"{half} {item.name}".strip()))
            half = ""
        elif half or isinstance(keys[0], str) or piece.text[0] in "0123456789":
            if joined and re.fullmatch("[0-9]+", piece.text) and joined[-1].value.text[-1:].isdigit():
                shown, point = (quoted(joined[-1].value.text + mark + piece.text) for mark in ",.")
                raise piece.unreadable(f"{shown} may have a decimal comma; write {point}.")
            raise piece.unreadable(f"{quoted(piece.text)} is not understood; write it as {_shown(keys[0])}: … .")
        else:
            half = piece.text
    if half:
        raise pieces[-1].unreadable(f"{quoted(half)} has no value; write one after a colon.")
    return joined


def _item(piece: Source) -> _Item | None:
    mark = _arrow(piece)
    if mark is None:
        return None
    value = piece.part(mark.end(), len(piece.text))
    if _arrow(value):
        raise value.unreadable(f"{quoted(piece.text)} holds two keys; put a comma between them.")
    return _Item(piece.part(0, mark.start()).text, value, piece)


def _arrow(piece: Source) -> re.Match[str] | None:
    """The colon, or what stands for one, behind a key."""
    marks = (_ARROW.match(piece.text, index) for index, _ in piece.outside())
    return next(filter(None, marks), None)


def _by_key(items: list[_Item], keys: Sequence[Key]) -> dict[Key, Source]:
    """What is typed for each key, in the keys' order."""
    found: dict[Key, Source] = {}
    for item in items:
        hits = _keys(item.name, keys)
        if len(hits) != 1:
            fault = f"may be any of {_listed(map(_shown, hits))}" if hits else "is not a key here"
            raise item.whole.unreadable(f"{quoted(item.name)} {fault}; the keys are {_listed(map(_shown, keys))}.")
        (key,) = hits
        if key in found:
            raise item.whole.unreadable(f"{_shown(key)} is given twice; give it once.")
        found[key] = item.value
    for key in keys:
        if key not in found:
            raise Unreadable(f"{_shown(key)} is missing; give it too.")
    return {key: found[key] for key in keys}


def _keys(name: str, keys: Sequence[Key]) -> list[Key]:
    """The keys that a name may mean: ``cool``, ``V(cool)``, ``V_cool``, ``p(cool|wet)``; ``Q(cool, fast)``."""
    spellings = _spellings(keys)
    inner = [match[1] for pattern in (_OF, _BELOW) if (match := pattern.fullmatch(name))]
    for candidate in (name, *inner):
        spread = candidate if not keys or isinstance(keys[0], str) else re.sub(r"[\s,/|;()]+", " ", candidate).strip()
        if hits := _matches(spread, spellings):
            return hits
    return list(dict.fromkeys(hit for candidate in inner for hit in _beside(candidate, spellings, keys)))


def _spellings(keys: Sequence[Key]) -> list[tuple[str, Key]]:
    """How each key is typed; of pairs that have one half in common, the other half is enough."""
    spellings = [(key if isinstance(key, str) else " ".join(key), key) for key in keys]
    pairs = [key for key in keys if not isinstance(key, str)]
    for half in (0, 1):
        if len({key[half] for key in pairs}) == 1:
            spellings += [(key[1 - half], key) for key in pairs]
    return spellings


def _beside(inner: str, spellings: Sequence[tuple[str, Key]], keys: Sequence[Key]) -> Iterator[Key]:
    """The keys that stand beside something else: ``cool|wet``, ``D|cool``, ``s, fast``.

    Behind or before a bar that may be anything where keys are single names; else it is a letter.
    """
    free = "|" in inner and isinstance(keys[0], str)
    pieces = [piece.strip() for piece in re.split(r"[|]" if free else r"[|,]", inner)]
    found = {piece: _matches(piece, spellings) for piece in pieces}
    if len(pieces) > 1 and all(hits or free or _LETTER.fullmatch(piece) for piece, hits in found.items()):
        for hits in found.values():
            yield from hits


def _option(word: Source, key: str, allowed: Sequence[str]) -> str:
    spellings = [(option, option) for option in allowed]
    hits = _matches(word.text, spellings) or _matches(word.text.rstrip("."), spellings)
    if len(hits) == 1:
        return hits[0]
    fault = "may be any of" if hits else "is not one of"
    raise word.unreadable(f"{quoted(word.text)} {fault} {_listed(allowed)}; type one of them.").within(key)


def _matches(typed: str, spellings: Iterable[tuple[str, Key]]) -> list[Key]:
    """What is spelled so; else if capitals do not count; else if ``_``, spaces and quotes do not; else its name."""
    pairs = list(spellings)
    for form in (_unquoted, lambda text: _unquoted(text).casefold(), _bare, _plain):
        if hits := [meant for spelling, meant in pairs if form(spelling) == form(typed)]:
            return hits
    return []


def _unquoted(text: str) -> str:
    text = spelled(text)
    return text[1:-1] if len(text) > 2 and text[0] == text[-1] and text[0] in "'\"" else text


def _bare(text: str) -> str:
    return re.sub("[_\\s{}'\"]", "", spelled(text).casefold())


def _plain(text: str) -> str:
    """The name in Latin letters and digits alone: ``pi1`` for π₁ and ``pi(1)``."""
    letters = unicodedata.normalize("NFD", re.sub("[()]", "", _bare(text)))
    return "".join(sign for sign in letters if not unicodedata.combining(sign)).translate(_SPELLED_OUT)


def _shown(key: str | tuple[str, str]) -> str:
    return key if isinstance(key, str) else f"({', '.join(key)})"


def _listed(names: Iterable[str]) -> str:
    text = ", ".join(names)
    return text if len(text) <= _LISTED else text[: _LISTED - 1] + "…"


def _count(count: int, noun: str = "number") -> str:
    return f"1 {noun} was" if count == 1 else f"{count} {noun}s were"


def _are(count: int) -> str:
    return "is" if count == 1 else "are"


def _comma(source: Source, read: int, needed: int) -> str:
    """A hint for those who may have meant decimal commas."""
    meant = read == 2 * needed and "." not in source.text and re.search("[0-9],[0-9]", source.text)
    return " Decimals are written with a point, as in 3.5." if meant else ""
