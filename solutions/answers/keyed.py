"""What is typed for each state, or for each pair of state and action: by name, as a table, or in their order."""

import re
from collections.abc import Callable, Iterator, Sequence
from typing import Generic

from msgspec import Struct
from msgspec.structs import replace

from rldrill.problems.grammar import refuse_comma
from rldrill.problems.spelling import Source, quoted
from rldrill.solutions.answers.lists import ended, filled, unwrapped
from rldrill.solutions.answers.names import Key, is_end, is_known, keys_named, listed, matches, shown, the_key

_ARROW = re.compile(r"->|→|↦|:=|<-(?=\s)|[:=←]")
_CELL = re.compile(r"r(\d+)c(\d+)")
_LETTER = re.compile(r"[^\W\d_]['*]?\s*=")
_ZERO = re.compile(r"[-+]?(?:0+\.?0*|\.0+)")
_NOTHING = re.compile(r"[-–—.·*_#xX/]*|none|null|nan|n/?a|end|terminal|exit|goal", re.IGNORECASE)
_NUMERIC = re.compile(r"[-+]?[\d.]")
_QUOTES = "'\""
#: What parts an item from the next one, beside a comma: cool: fast and warm: slow.
_AND = re.compile(r"(?:\s+(?:and|und)|\s*&)\s*$")
_HEAD = re.compile(r"([^:=()\[\]{}]+?)\s*(?:(?::|=|->|→|↦)\s*|(?=[(\[{]))(?=\S)")
#: A working in numbers, before what comes out of it, is no name: 4 + 1/2*(0 - 2) = 3.
_WORKED = re.compile(r"[=\s]*[-+(]*[0-9.]+(?=[\s)]*[-+*/^·×÷])[-0-9.\s+*/^()·×÷%√]*")
#: Values behind commas that are no decimal commas, having a blank behind them.
_ROW = re.compile(r"[^,:=\[\](){}]+(?:,\s[^,:=\[\](){}]+)+")
#: A number behind one of these is part of a working, not the name of what is typed next.
_OPERATORS = tuple("+-*/^(·=")
#: All keys that were not named before: drift: 2/3, others: 1/6.
_REST = re.compile(
    r"(?:all\s+)?(?:the\s+)?(?:others?|rest|remaining)|(?:everything|all)\s+else|else|otherwise", re.IGNORECASE
)
_MOST = 200
_FORMS = 30


class Asked(Generic[Key], Struct, frozen=True):
    """What must be typed.

    Args:
        keys: what needs a value.
        ends: the terminal states, which may be typed too where they are worth nothing.
        goes_on: whether a piece without a key is more of what is typed for the key before: a tied action.
    """

    keys: Sequence[Key]
    ends: Sequence[str]
    goes_on: Callable[[str, Key], bool] | None = None

    @property
    def numbers(self) -> bool:
        """Whether numbers are asked for."""
        return self.goes_on is None

    @property
    def most(self) -> int:
        """So many keys, lines or values are read at most."""
        return max(_MOST, len(self.keys) + len(self.ends) + 1)

    def means_nothing(self, value: Source) -> bool:
        """Whether it is what a terminal state is given: 0, or a sign for no action."""
        text = value.text.strip("'\"")
        return bool(_NOTHING.fullmatch(text) or _ZERO.fullmatch(text))


class _Item(Struct, frozen=True):
    """What is typed for a key: ``cool: 3.5``."""

    name: str
    value: Source
    whole: Source
    #: Whether another key was named before the value was: it may be a form of it, V₂(cool) = V₁(warm) = 3.
    shared: bool = False


def by_name(source: Source, asked: Asked[Key]) -> dict[Key, Source] | None:
    """What is typed for each key, in the keys' order; None if no keys are typed. Some keys may be missing.

    Raises:
        Unreadable: a key is unknown or repeated, or a terminal state is given a value.
    """
    body = _bracketed(unwrapped(source)[0], asked)
    items = _nested(body, asked) or _marked(body, asked)
    if items is not None:
        return _by_key(items, asked)
    found = _tabled(body, asked) or _spaced(body, asked)
    return {key: found[key] for key in asked.keys if key in found} if found else None


def _nested(body: Source, asked: Asked[Key]) -> list[_Item] | None:
    """The items under their states: ``cool: fast 3.5, slow 2.5; warm: slow 1``; or under their actions; else None."""
    pairs = [key for key in asked.keys if not isinstance(key, str)]
    pieces = [piece for piece in body.split(",;\n|") if piece.text] if pairs else []
    if len(pieces) > asked.most:
        return None
    for outer in (0, 1):
        inner: dict[str, list[str]] = {}
        for key in pairs:
            inner.setdefault(key[outer], []).append(key[1 - outer])
        if listed_under := _rows_under_heads(body, inner, outer):
            return listed_under
        found = list(_under_heads(pieces, inner, outer))
        whole = [item for item in found if item]
        if whole and len(whole) == len(found):
            return whole
    return None


def _rows_under_heads(body: Source, inner: dict[str, list[str]], outer: int) -> list[_Item] | None:
    """The items of rows that have a head each, and as many values as belong to it: ``cool: -2, 3; warm: 4, 6``."""
    found: list[_Item] = []
    for row in filled(body.split(";\n")) if inner and body.has(",") else []:
        begun = _HEAD.match(row.text)
        hits = matches(begun[1], [(each, each) for each in inner]) if begun else []
        values = row.part(begun.end(), len(row.text)) if begun else row
        entries = values.split(",") if _ROW.fullmatch(values.text) else []
        if not hits or len(entries) != len(inner[hits[0]]):
            return None
        if any(_under(hits[0], entry, inner[hits[0]], outer) for entry in entries):
            return None  # high: search 8, recharge 10
        halves = [(hits[0], name) if outer == 0 else (name, hits[0]) for name in inner[hits[0]]]
        found += [_Item(" ".join(key), entry, row) for key, entry in zip(halves, entries, strict=True)]
    return found


def _under_heads(pieces: Sequence[Source], inner: dict[str, list[str]], outer: int) -> Iterator[_Item | None]:
    """The items of pieces, as far as they are those of a head: None is the last of them where one is none."""
    head = ""
    for piece in pieces:
        rest = piece
        begun = _HEAD.match(piece.text)
        if begun and (hits := matches(begun[1], [(each, each) for each in inner])):
            head, rest = hits[0], piece.part(begun.end(), len(piece.text))
        inside = rest.unwrapped() if begun else None
        for each in inside.split(",;\n|") if inside else [rest]:
            item = _under(head, each, inner.get(head, ()), outer)
            yield item
            if item is None:
                return


def _under(head: str, piece: Source, names: Sequence[str], outer: int) -> _Item | None:
    """An item whose key has one half before a value and the other one, the head, before it all."""
    words = _words(piece)[:3]
    for count in range(len(words), 0, -1):
        length = words[count - 1].start + len(words[count - 1].text) - piece.start
        typed, rest = piece.text[:length], piece.text[length:]
        if (mark := _ARROW.search(typed)) and mark.start():
            typed, rest, length = typed[: mark.start()], piece.text[mark.end() :], mark.end()
        hits = matches(typed.strip(), [(name, name) for name in names])
        if hits and rest.strip() and not re.match(r"\s*-\s", rest):
            gap = re.match(rf"\s*(?:{_ARROW.pattern})?\s*", rest)
            value = piece.part(length + (gap.end() if gap else 0), len(piece.text))
            key = (head, hits[0]) if outer == 0 else (hits[0], head)
            return _Item(" ".join(key), value, piece) if value.text else None
    return None


def _bracketed(body: Source, asked: Asked[Key]) -> Source:
    """Names with a comma in them in brackets, in quotes or not: ``0,1: 3`` would else be two entries."""
    for name in (*asked.keys, *asked.ends):
        if isinstance(name, str) and "," in name and not name.startswith("("):
            typed = rf"(?<![\w,.(])(['\"]?){re.escape(name)}\1(?=\s*(?:{_ARROW.pattern}))"
            body = body.replaced(re.compile(typed), lambda found: f"({found[0].strip(_QUOTES)})")
    return body


def _marked(body: Source, asked: Asked[Key]) -> list[_Item] | None:
    """The items whose keys stand before colons, equal signs or arrows."""
    pieces = [piece for piece in body.split(",;\n|") if piece.text]
    if sum(map(_marks, pieces)) > asked.most:
        raise body.unreadable(f"More than {asked.most} keys were typed; leave out those that were not asked for.")
    items = [list(_items(piece, asked)) for piece in pieces]
    named = [item for found in items for item in found]
    if not named:
        return None
    if len(named) == 1 and items[0] and not keys_named(named[0].name, asked.keys):
        inside = named[0].value.unwrapped()
        if inside and any(map(_marks, inside.split(",;\n|"))):
            return _marked(inside, asked)  # V = {cool: 3.5, warm: 2.5}
        whole = len(asked.keys) > 1 and (len(items) > 1 or inside or named[0].value.has(" "))
        if whole or (len(items) == 1 and _LETTER.match(body.text)):
            return None  # V = 3.5, 2.5
    return [deep for item in _joined(pieces, items, asked) for deep in _opened(item, asked)]


def _marks(piece: Source) -> int:
    return sum(1 for index, _ in piece.outside() if _ARROW.match(piece.text, index))


def _items(piece: Source, asked: Asked[Key]) -> Iterator[_Item]:
    """The items of a piece; a second key in it must be known: ``cool=3.5 warm=2.5``."""
    start, name, begun, forms = 0, "", 0, 0
    alike: list[str] = []  # up = down = 3/8
    for index, _ in piece.outside():
        mark = _ARROW.match(piece.text, index)
        if mark is None or index < begun or (mark[0] in ("←", "<-") and not asked.numbers):
            continue
        before = piece.text[begun:index].rstrip()
        named = re.search(r"\w", before) or (before.strip() and _known(before.strip(), asked))
        if not named or (mark[0] in ("→", "->") and not piece.text[mark.end() :].strip()):
            continue  # an arrow that is an action
        if not name and mark[0] == "=" and _WORKED.fullmatch(before) and not _known(before.strip("= "), asked):
            continue
        if not name:
            start, name, begun = 0, before.strip(), mark.end()
            continue
        split, other = _last_key(before, asked), before.strip()
        if split is None and mark[0] == "=" and not _NUMERIC.match(other) and len(keys_named(other, asked.keys)) == 1:
            if keys_named(other, asked.keys) != keys_named(name, asked.keys):  # V(cool) = R(cool) = 3.5 is one value
                alike.append(name)
                name = other
            begun = mark.end()
            continue
        forms = forms + 1 if split is None else 0
        if forms > _FORMS:
            raise piece.unreadable("It holds too many equal signs; write each value alone, once.")
        if split is not None:
            stop = begun + split
            last = stop if (parted := _AND.search(piece.text[begun:stop])) is None else begun + parted.start()
            for each in (*alike, name):
                yield _Item(each, piece.part(begun, last), piece.part(start, last), each is name and bool(alike))
            alike = []
            start, name, begun = stop, piece.text[stop:index].strip(), mark.end()
        elif mark[0] != "=" or (piece.text[begun - 1] in ":>→↦" and re.fullmatch(r"\s*[^\W\d]\w*", before)):
            raise piece.unreadable(f"{quoted(piece.text[start:])} holds two keys; put a comma between them.", begun)
    end = len(piece.text)
    for each in (*alike, name) if name else ():
        yield _Item(each, piece.part(begun, end), piece.part(start, end), each is name and bool(alike))


def _last_key(text: str, asked: Asked[Key]) -> int | None:
    """Where a key begins that a text ends in, with something before it."""
    words = _words(Source(text))
    starts = [word.start for word in words[1:] if text[: word.start].rstrip()[-1:] not in _OPERATORS][-4:]
    names = [key if isinstance(key, str) else " ".join(key) for key in asked.keys]
    for start in starts:
        if matches(text[start:], [(name, name) for name in (*names, *asked.ends)]):
            return start  # very cool, of which cool may be a key too
    for start in reversed(starts):
        if is_known(text[start:], asked.keys, asked.ends):
            return min(early for early in (start, *starts) if text[early:start].strip() in ("", "ln", "log"))
    return None


def _known(name: str, asked: Asked[Key]) -> bool:
    return len(keys_named(name, asked.keys)) == 1 or is_end(name, asked.keys, asked.ends)


def _joined(pieces: list[Source], items: list[list[_Item]], asked: Asked[Key]) -> list[_Item]:
    """The items; the first half of a pair is put before the second, a tied action behind the other.

    Raises:
        Unreadable: a piece is neither.
    """
    joined: list[_Item] = []
    half = ""
    for piece, found in zip(pieces, items, strict=True):
        if found:
            joined += [replace(found[0], name=f"{half} {found[0].name}".strip()), *found[1:]]
            half = ""
        elif joined and asked.goes_on and _is_tied(joined[-1], piece, asked):
            value = joined[-1].value
            joined[-1] = replace(joined[-1], value=Source(f"{value.text}, {piece.text}", value.start))
        elif half or isinstance(asked.keys[0], str) or piece.text[0] in "0123456789":
            if joined and re.fullmatch("[0-9]+", piece.text) and joined[-1].value.text[-1:].isdigit():
                shown_, point = (quoted(joined[-1].value.text + mark + piece.text) for mark in ",.")
                raise piece.unreadable(f"{shown_} may have a decimal comma; write {point}.")
            raise piece.unreadable(f"{quoted(piece.text)} is not understood; write it as {shown(asked.keys[0])}: … .")
        else:
            half = piece.text
    if half:
        raise pieces[-1].unreadable(f"{quoted(half)} has no value; write one after a colon.")
    return joined


def _is_tied(item: _Item, piece: Source, asked: Asked[Key]) -> bool:
    hits = keys_named(item.name, asked.keys)
    return bool(len(hits) == 1 and asked.goes_on and asked.goes_on(piece.text, hits[0]))


def _opened(item: _Item, asked: Asked[Key]) -> Iterator[_Item]:
    """The items within an item: ``cool: {fast: 3.5, slow: 2.5}``, ``cool: [3.5, 2.5]``."""
    inside = item.value.unwrapped()
    if inside is None or isinstance(asked.keys[0], str):
        yield item
    elif any(map(_marks, pieces := [piece for piece in inside.split(",;\n|") if piece.text])):
        for piece in pieces:
            for found in _items(piece, asked):
                yield replace(found, name=f"{item.name} {found.name}")
    else:
        own = [key for key in asked.keys if not isinstance(key, str) and matches(item.name, [(key[0], key)])]
        if own and len(own) == len(pieces) > 1:
            yield from (_Item(" ".join(key), piece, piece) for key, piece in zip(own, pieces, strict=True))
        elif pieces or not is_end(item.name, asked.keys, asked.ends):
            yield item


def _by_key(items: list[_Item], asked: Asked[Key]) -> dict[Key, Source]:
    """What is typed for each key, in the keys' order."""
    found: dict[Key, Source] = {}
    *named, last = sorted(items, key=lambda item: not is_end(item.name, asked.keys, asked.ends))
    if named and _REST.fullmatch(last.name) and not is_known(last.name, asked.keys, asked.ends):
        found = _by_key(named, asked)
        return {key: found.get(key, last.value) for key in asked.keys}
    for item in sorted(items, key=lambda item: item.shared):
        key = the_key(item.name, asked.keys, asked.ends, item.whole)
        if key is None:
            if not asked.means_nothing(item.value):
                worth = "its value is 0" if asked.numbers else "no action is taken there"
                raise item.value.unreadable(f"{quoted(item.name)} is terminal, so {worth}; leave it out.")
            continue
        if key in found and item.shared:
            continue
        if key in found:
            raise item.whole.unreadable(f"{shown(key)} is given twice; give it once.")
        found[key] = item.value
    return {key: found[key] for key in asked.keys if key in found}


def _tabled(body: Source, asked: Asked[Key]) -> dict[Key, Source] | None:
    """A table: a line for each key; or the keys in the first line; or states by actions."""
    lines = [ended(line) for line in _lines(body)]
    if not 2 <= len(lines) <= asked.most:
        return None
    parting = next((mark for mark in "|;," if lines[0].has(mark)), None)
    rows = [line.split(parting) if parting else _words(line) for line in lines]
    if not all(rows):  # a line of commas alone
        return None
    for reading in _readings(rows, pairs=not isinstance(asked.keys[0], str)):
        found = [(_key(names, asked), names, cell) for names, cell in reading]
        placed = {key: cell for key, _, cell in found if key is not None}
        idle = all(_is_idle(names, cell, asked) for key, names, cell in found if key is None)
        if idle and len(placed) == len(asked.keys) == sum(key is not None for key, *_ in found):
            return placed
    return None


def _readings(rows: list[list[Source]], *, pairs: bool) -> Iterator[list[tuple[list[Source], Source]]]:
    """The cells of a table with what may name them; its first line or column may be a heading."""
    by_line = [(cells[:-1], cells[-1]) for cells in rows]
    yield from (by_line[1:], by_line)
    if len(rows) == 2 and 0 <= (named := len(rows[1]) - len(rows[0])) <= 1:
        by_column = [([head], cell) for head, cell in zip(rows[0], rows[1][named:], strict=True)]
        yield from (by_column[1:], by_column)
    width = len(rows[1])
    if pairs and all(len(row) == width for row in rows[1:]) and len(rows[0]) in (width - 1, width):
        heads = rows[0][len(rows[0]) - width + 1 :]
        crossed = [(row[0], head, cell) for row in rows[1:] for head, cell in zip(heads, row[1:], strict=True)]
        yield [([state, action], cell) for state, action, cell in crossed]
        yield [([state, action], cell) for action, state, cell in crossed]


def _is_idle(names: Sequence[Source], cell: Source, asked: Asked[Key]) -> bool:
    """Whether a cell that has no key says nothing, as that of a terminal state does."""
    ended = is_end(" ".join(name.text for name in names), asked.keys, asked.ends)
    return bool(asked.means_nothing(cell) if ended else _NOTHING.fullmatch(cell.text))


def _lines(body: Source) -> list[Source]:
    """The lines of a table, or what stands in brackets of its own: ``('cool', 3.5), ('warm', 2.5)``."""
    if body.has("\n"):
        return filled(body.split("\n"))
    lines = [piece.unwrapped() for piece in body.split(",;") if piece.text]
    return [line for line in lines if line] if all(lines) else []


def _key(cells: Sequence[Source], asked: Asked[Key]) -> Key | None:
    hits = keys_named(" ".join(cell.text for cell in cells).strip(), asked.keys)
    return hits[0] if len(hits) == 1 else None


def _words(source: Source) -> list[Source]:
    return [word for word in source.split(lambda _, sign: sign.isspace()) if word.text]


def _spaced(body: Source, asked: Asked[Key]) -> dict[Key, Source] | None:
    """Keys with what they are given behind them: ``cool 3.5, warm 2.5``; at last perhaps ``others 2``.

    Raises:
        Unreadable: beside keys there is another name.
    """
    found: dict[Key, Source] = {}
    pieces = filled(body.split(",;\n|"))
    for piece in pieces:
        if found and piece is pieces[-1] and (rest := _REST.match(piece.text)) and piece.text[rest.end() :][:1] == " ":
            others = piece.part(rest.end(), len(piece.text))
            return {key: found.get(key, others) for key in asked.keys}
        words = _words(piece)
        if len(words) > 2 * asked.most:
            return None
        while words:
            length = next((n for n in (3, 2, 1) if _is_name(words[:n], n, asked)), 0)
            more = (n for n in range(length + 1, len(words)) if _is_name(words[n : n + 1], 1, asked))
            stop = next(more, len(words))
            if not length or stop == length:
                _refuse_other_names(pieces, asked)
                return None
            key = _key(words[:length], asked)
            value = Source(" ".join(word.text for word in words[length:stop]), words[length].start)
            if words[length].text == "-" and stop > length + 1 and asked.numbers:
                shown_ = quoted(" ".join(word.text for word in words[:stop]))
                raise value.unreadable(f"The dash in {shown_} may be a minus sign; write a colon behind the name.")
            if key in found or (key is None and not asked.means_nothing(value)):
                return None
            if key is not None:
                found[key] = value
            words = words[stop:]
    return found


def _refuse_other_names(pieces: Sequence[Source], asked: Asked[Key]) -> None:
    """Refuse a name that is no key, where each piece is a name and what it is given, and some of them are keys.

    Raises:
        Unreadable: there is one.
    """
    names = [_name_before(piece, asked) for piece in pieces]
    if all(names) and any(_known(name, asked) for name in names):
        for name, piece in zip(names, pieces, strict=True):
            the_key(name, asked.keys, asked.ends, piece)


def _name_before(piece: Source, asked: Asked[Key]) -> str:
    """What stands before a number or an action, if these are words."""
    *words, value = _words(piece)
    of_value = _NUMERIC.match(value.text) if asked.numbers else any(_goes_on(value.text, asked))
    name = " ".join(word.text for word in words)
    return name if of_value and re.fullmatch(r"[^\W\d_][^\W\d]+(?: [^\W\d]+)*", name) else ""


def _goes_on(word: str, asked: Asked[Key]) -> Iterator[bool]:
    return (asked.goes_on is not None and asked.goes_on(word, key) for key in asked.keys)


def _is_name(words: Sequence[Source], length: int, asked: Asked[Key]) -> bool:
    """Whether words are a known name; a number alone is none."""
    name = " ".join(word.text for word in words)
    return len(words) == length and not _NUMERIC.match(name) and _known(name, asked)


def in_order(rows: Sequence[Sequence[Source]], source: Source, asked: Asked[Key]) -> dict[Key, Source] | None:
    """Values alone in the keys' order, or in the shape of a grid; None if they are too few or too many.

    Raises:
        Unreadable: they can be placed in several ways.
    """
    keys, flat = asked.keys, [entry for row in rows for entry in row]
    cells = _grid(keys, asked.ends)
    ends = [end for end in asked.ends if not cells or end in cells.values()]  # what is over is no cell
    if cells and len(rows) == len({place[0] for place in cells}) > 1:
        return _grid_placed(rows, source, cells, asked)
    if len(flat) == len(keys):
        _check_rows(rows, source, keys)
        return dict(zip(keys, flat, strict=True))
    order = _natural_order(keys, ends)
    if ends and len(flat) > len(keys):
        _refuse_decimal_comma(source)
    if len(flat) != len(keys) + len(ends) or not ends:
        return _walled(flat, cells, asked) if cells else None
    if order:
        placed = dict(zip(order, flat, strict=True))
        for end in ends:
            _check_end(placed[end], end, asked)
        return {key: placed[key] for key in keys}  # type: ignore[index]
    idle = [index for index, entry in enumerate(flat) if asked.means_nothing(entry)]
    if len(idle) == len(ends):
        return dict(zip(keys, (entry for index, entry in enumerate(flat) if index not in idle), strict=True))
    readings = {tuple(entry.text for place, entry in enumerate(flat) if place != index) for index in idle}
    if len(ends) == 1 and len(readings) == 1:
        return dict(zip(keys, [entry for place, entry in enumerate(flat) if place != idle[0]], strict=True))
    if len(readings) > 1:
        raise source.unreadable(
            f"{len(flat)} entries were read, {len(keys)} are needed: {listed(map(shown, keys))}; which of them is for "
            f"{listed(ends)} may be read in {len(readings)} ways, so leave it out."
        )
    return None


def _refuse_decimal_comma(source: Source) -> None:
    """Refuse ``0,5`` where it may be one value, or a terminal state's 0 and a 5."""
    if "." not in source.text and (comma := re.search(r"[0-9](,)[0-9]", source.text)):
        refuse_comma(source, comma.start(1))
        raise source.unreadable("Commas may be decimal commas here; write decimals with a point, as in 3.5.")


def _check_rows(rows: Sequence[Sequence[Source]], source: Source, keys: Sequence[Key]) -> None:
    """Refuse a table with a row for each action, where one for each state is needed."""
    pairs = [key for key in keys if not isinstance(key, str)]
    lengths = [sum(key[0] == state for key in pairs) for state in dict.fromkeys(key[0] for key in pairs)]
    typed = [len(row) for row in rows]
    if pairs and len(typed) > 1 and max(typed) > 1 and typed != lengths:
        raise source.unreadable(f"Rows of {listed(map(str, typed))} entries were read; write a row for each state.")


def _grid(keys: Sequence[Key], ends: Sequence[str]) -> dict[tuple[int, int], str] | None:
    """The cells of a grid that are states, by row and column."""
    names = [*keys, *filter(_CELL.fullmatch, ends)]
    found = [_CELL.fullmatch(name) if isinstance(name, str) else None for name in names]
    if not keys or not all(found):
        return None
    return {(int(match[1]), int(match[2])): match[0] for match in found if match}


def _natural_order(keys: Sequence[Key], ends: Sequence[str]) -> list[str] | None:
    """All states in the order of their places or numbers, if they have such names."""
    if cells := _grid(keys, ends):
        return [cells[place] for place in sorted(cells)]
    names = [*keys, *ends]
    numbers = [name for name in names if isinstance(name, str) and re.fullmatch("-?[0-9]{1,9}", name)]
    return sorted(numbers, key=int) if len(numbers) == len(names) else None


def _grid_placed(
    rows: Sequence[Sequence[Source]], source: Source, cells: dict[tuple[int, int], str], asked: Asked[Key]
) -> dict[Key, Source]:
    """Each row is a whole row of the grid, or leaves out the walls, or the terminal states too."""
    width = max(column for _, column in cells)
    found: dict[str, Source] = {}
    for entries, down in zip(rows, sorted({row for row, _ in cells}), strict=True):
        inside = {column: name for (row, column), name in sorted(cells.items()) if row == down}
        acting = {column: name for column, name in inside.items() if name in asked.keys}
        if len(entries) == width or (len(entries) > width and all(map(asked.means_nothing, entries[width:]))):
            placed = {name: entries[column - 1] for column, name in inside.items()}
        elif len(entries) in (len(acting), len(inside)):
            wanted = acting if len(entries) == len(acting) else inside
            placed = dict(zip(wanted.values(), entries, strict=True))
        else:
            raise (entries[0] if entries else source).unreadable(
                f"Row {down} of the grid has {len(entries)} entries; write {width}, one for each cell."
            )
        for name, entry in placed.items():
            if name in asked.ends:
                _check_end(entry, name, asked)
        found |= placed
    return {key: found[key] for key in asked.keys}  # type: ignore[index]


def _walled(flat: Sequence[Source], cells: dict[tuple[int, int], str], asked: Asked[Key]) -> dict[Key, Source] | None:
    """All cells of the grid in one line, row after row, the walls too."""
    width, height = max(column for _, column in cells), max(row for row, _ in cells)
    if len(flat) != width * height:
        return None
    rows = [flat[start : start + width] for start in range(0, len(flat), width)]
    present = sorted({row for row, _ in cells})
    return _grid_placed([rows[row - 1] for row in present], flat[0], cells, asked)


def _check_end(entry: Source, end: str, asked: Asked[Key]) -> None:
    """Refuse a number other than 0 for a terminal state; in a grid it may be given as any sign."""
    if asked.numbers and _NUMERIC.match(entry.text) and not asked.means_nothing(entry):
        raise entry.unreadable(f"{end} is terminal, so its value is 0, not {quoted(entry.text)}; leave it out.")
