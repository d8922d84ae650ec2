"""Reads what a person typed as an answer: a number, a vector, a matrix, a table, a policy or a choice."""

import re
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from itertools import chain
from typing import TypeVar

from rldrill.problems.expressions import GREEK
from rldrill.problems.spelling import Source, Unreadable, quoted, spelled
from rldrill.solutions.answers.arithmetic import Arithmetic
from rldrill.solutions.answers.keyed import Asked, by_name, in_order
from rldrill.solutions.answers.lists import (
    ended,
    entries_of,
    filled,
    left_out,
    nested_rows,
    plain_rows,
    unscaled,
    untransposed,
    unwrapped,
    vector_entries,
)
from rldrill.solutions.answers.names import (
    MARKS,
    Key,
    entry_named,
    is_deviation,
    listed,
    matches,
    options_named,
    shown,
    the_options,
    unquoted,
)
from rldrill.solutions.answers.numbers import Reading, number, plain
from rldrill.solutions.answers.pasted import in_signs, keyed_list
from rldrill.solutions.answers.rule import equivalent, is_right
from rldrill.solutions.answers.shared import for_all
from rldrill.solutions.answers.source import LONGEST, clean
from rldrill.solutions.exact import NotReal, sign
from rldrill.solutions.exact import parameters as parameters_of

__all__ = [
    "Reading",
    "Unreadable",
    "names_alone",
    "read_choice",
    "read_matrix",
    "read_number",
    "read_table",
    "read_vector",
    "read_words",
    "read_yes_no",
]

Read = TypeVar("Read")

# x · V(s) · V^π(s) · R_0 · V_{k+1}(s) · Q̂(s, a) · ∂J/∂θ₁
_NAME = rf"(?:[∂d][\w']*/[∂d])?[^\W\d_](?:[\w '^*⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⊤{MARKS}]|\{{[^{{}}=]*\}}|\([^()=]*\)|\[[^\[\]=]*\])*"
_LABEL = re.compile(rf"(['\"]?)({_NAME})\1\s*(?:[:←]|<-(?=\s)|=(?!=))")
_LEFT_SIDE = re.compile(rf"(?:{_NAME})?=(?!=)")
_ONLY_NAME = re.compile(_NAME)
_NEXT_LABEL = re.compile(r"[^\W\d_∂](?:[^\s=:,;()]|\([^()=:;]*\))*\s*[=:](?!=)|∂[^\s=:,;]*\s*=(?!=)")
_YES = frozenset(
    {"yes", "yep", "y", "true", "t", "correct", "ja", "j", "wahr", "oui", "vrai", "sí", "sì", "si", "sim", "да", *"✓✔☑"}
)
_NO = frozenset({"no", "nope", "n", "false", "f", "incorrect", "nein", "falsch", "non", "faux", "não", "нет", *"✗✘☒"})
#: What parts yes or no from the reason for it.
_WHY = re.compile(r"\s*(?:[,;:(–—]|\.(?!\w))\s*|\s+(?:-|as)\s+")
#: The reason behind an answer: left, because it earns more.
_BECAUSE = re.compile(r"[\s,;:.(–—-]+(?:because|since|weil)\b.*", re.DOTALL | re.IGNORECASE)
#: A comparison, or a number, in brackets behind a word.
_COMPARED = re.compile(r"(?<=\w)(?:\s*\([^()]*[<>=≤≥≠][^()]*\)|\s+\([-+0-9./]+\))$")
_REMARK = re.compile(r"(?<=\w)\s+\([^()]*\)$")
_DRAWN = re.compile(r"(?=.*[↑↓←→<>^]|v+$)[↑↓←→<>^v.#*_A-Z-]{2,}")
_RELATION = re.compile(r"[<>!]=|=[<>]|[≤≥≠]")
_ROUNDED = re.compile(r"(?<=≈)\s*[-+]?[0-9]+$")  # 11, for 11.004
_OR = re.compile(r"\A(?:or|oder|/)(?!\w)\s*", re.IGNORECASE)
_SAID = re.compile(r"(?:answer|option|antwort)\b\s*[:=]?\s*(?=\S)", re.IGNORECASE)
#: What is said around the name of what is chosen: the green arm, model A, left!
_ARTICLE = re.compile(r"^(?:the|der|die|das)\s+|\s*!*$", re.IGNORECASE)
_AROUND = re.compile(
    r"^(?:(?:the|der|die|das)\s+)?(?:(?:arm|model|action|policy|method)\s+)?"
    r"|(?:\s+(?:arm|model|action|policy|method|one))?\s*!*$",
    re.IGNORECASE,
)
_BOTH = re.compile(r"\(?([A-Za-z])[).:]\s*(\S.*)", re.DOTALL)
_BARS = re.compile(r"\|([^\s|](?:[^|\n]*[^\s|])?)\|")  # a cell of a table has spaces at its edges
#: A normal distribution, by its mean and variance: N(5, 6).
_NORMAL = re.compile(r"(?:[^=~∼]*[=~∼])?\s*N\s*(?=[(\[])", re.DOTALL)
#: A vector in angle brackets: <24, -12>.
_ANGLES = re.compile(r"\A\s*<([^<>]+)>\s*\Z")
_BY_MEAN = ("mean",)
#: Odds: 2:15, 1 : 7.5; but 1: 7.5, and 1:7.5, may be the number of a question before the answer.
_ODDS = re.compile(r"\s*(?![0-9]+:[0-9]*[./])([0-9./]+)( ?):\2([0-9./]+)\s*")
#: What is said before a number: R_0: 1/4, answer: 1/4, the answer is 1/4.
_SAID_FIRST = re.compile(
    r"(?:the\s+)?(?:answer|result|solution)\s+is\s+(?=\S)|[^\W\d][^:=\n]{0,30}:\s*(?=[^\s:=])", re.IGNORECASE
)
#: In brackets a sign that touches what follows begins an entry: [1 -1].
_SIGNED_ENTRY = re.compile(r"[\w)]\s+[-+](?=[\w(√])")
_SIGNED_LINE = re.compile(r"[\w.)\]}%]\s*\n\s*(?=[-+])")
#: The name of an entry of a matrix, with its row and column: J12 =, J_{1,2} =, A[1, 2]:
_INDEXED = re.compile(r"[^\W\d_]\w*?_?[{(\[]?([1-9]),?\s*([1-9])[})\]]?\s*[=:]\s*(?=\S)")
#: An entry of a single row or column by its name with one index, C_2.
_NUMBERED = re.compile(r"([^\W\d_]+)_?[{(\[]?([1-9])[})\]]?\s*[=:]\s*(?=\S)")
#: A comma that may be a decimal comma.
_TIGHT = re.compile(r",(?!\s)")
_ENTRIES = 200
_FORMS = 30
_NUMBER_FIRST = re.compile(r"[-+]?[0-9][0-9./]*\s+([A-Za-z]{2,})(?![\w({\[])")


def read_number(text: str, parameters: Sequence[str] = (), longest: int = LONGEST) -> Reading:
    """Read one number, perhaps in several forms: ``V(s) = 1/4 = 0.25``.

    Args:
        text: what was typed.
        parameters: the names of the open parameters that it may contain, as in ``PARAMETERS``.
        longest: the most characters that are read.

    Raises:
        Unreadable: it is not one number.
    """
    if odds := _ODDS.fullmatch(text):
        text = f"({odds[1]})/({odds[3]})"
    reading = plain(text)
    if reading is None:
        said = clean(text, longest).before(_BECAUSE).behind(_SAID_FIRST)
        reading = _number(_whole(said), parameters, Arithmetic())
    plainly = re.sub(r"\s", "", in_signs(text)) if "\\" in text else text.strip()
    bars = _BARS.fullmatch(plainly.strip("$"))
    if bars and (parameters_of(reading.value) or sign(reading.value) < 0):
        raise Unreadable(
            f"{quoted(text.strip())} may be the absolute value, or {quoted(bars[1])} in a cell; write abs({bars[1]}), "
            "or the number without bars."
        )
    return reading


def read_vector(
    text: str,
    length: int | None = None,
    parameters: Sequence[str] = (),
    names: Sequence[str] = (),
    longest: int = LONGEST,
    called: Sequence[str] = (),
) -> tuple[Reading | None, ...]:
    """Read a vector: ``1, 2`` or ``[1 2]`` or ``(1; 2)``, or by name: ``mu: 1, Sigma: 2``; None for what is left out.

    Args:
        text: what was typed.
        length: how many numbers are needed, if that is known.
        parameters: the names of the open parameters that it may contain.
        names: what the entries are, in mathematics; entries that are typed with these names may stand in any order.
        longest: the most characters that are read.
        called: what the entries are called in words, which may be typed instead of their names.

    Raises:
        Unreadable: an entry is not a number, or is given twice, or there are too few or too many; or names that
            are not known stand in another order than the alphabet's, so that they may mean another one.
    """
    if length == 1:
        return (read_number(text.rstrip(" ,;"), parameters, longest),)
    source = clean(_ANGLES.sub(r"(\1)", text), longest)
    if called[:1] == _BY_MEAN and (normal := _NORMAL.match(source.text)):
        source = source.part(normal.end(), len(source.text))

    def vector(member: Source) -> tuple[Reading | None, ...]:
        return _vector(member, length, parameters, names, called)

    body = source.behind(_LEFT_SIDE)
    if body.has("=≈") and len(_pieces(body, length, parameters, called)) == 1:
        return _forms(source, vector, _given)  # (1/4, 2) = (0.25, 2)
    return vector(source)


def _given(entries: Iterable[Reading | None]) -> list[Reading]:
    return [entry for entry in entries if entry is not None]


def _vector(
    source: Source, length: int | None, parameters: Sequence[str], names: Sequence[str], called: Sequence[str]
) -> tuple[Reading | None, ...]:
    entries = _pieces(source, length, parameters, called)
    labels = _labels(entries, called)
    alone = len(entries) == 1 and not (labels[0] and entry_named(labels[0][2], names, called) is not None)
    if alone or not all(labels[1:]):
        source = source.behind(_LEFT_SIDE)  # R = 1, 2
        entries = _pieces(source, length, parameters, called)
    entries = _unlabelled(entries, names, called)  # R_0 = 1, R_1 = 2
    most = max(_ENTRIES, length or 0)
    _refuse_last_percent(entries)
    given = [index for index, entry in enumerate(entries) if not left_out(entry)] or range(len(entries))
    place = (lambda i: f"entry {given[i - 1] + 1}") if len(entries) != 1 else None
    readings = dict(zip(given, _numbers([entries[i] for i in given], parameters, place, most=most), strict=True))
    if length is not None and len(entries) != length:
        shown = listed(re.sub('[{}"]', "", name) for name in names)  # as one may type them
        needed = f"{length} are needed{f': {shown}' if names else ''}."
        raise source.unreadable(f"{_count(len(entries))} read, {needed}{_comma(source, len(entries), length)}")
    return tuple(readings.get(index) for index in range(len(entries)))


def _pieces(source: Source, length: int | None, parameters: Sequence[str], called: Sequence[str]) -> list[Source]:
    """The entries of a vector; labels begin new ones: ``mu = 1 Sigma = 2``, ``mean 1 variance 2``."""
    factor, bracket = _scaled(source, parameters)
    if factor:
        return _times(factor, vector_entries(bracket, length))
    body = untransposed(source)
    inside, _ = unwrapped(body)
    word = _called(called)
    labels = [
        index
        for index, sign in inside.outside()
        if sign.isspace()
        and (_NEXT_LABEL.match(inside.text, index + 1) or word.match(inside.text, index + 1))
        and inside.text[:index].rstrip()[-1:] not in "=≈:,;+-*/("
    ]
    if (labels or word.match(inside.text)) and not inside.has(",;|\n"):
        return inside.split(lambda index, _: index in labels)
    return vector_entries(body, length)


def read_matrix(
    text: str, shape: tuple[int, int] | None = None, parameters: Sequence[str] = (), longest: int = LONGEST
) -> tuple[tuple[Reading | None, ...], ...]:
    """Read a matrix by its rows: ``[[1, 2], [3, 4]]`` or ``[1 2; 3 4]`` or one row on each line.

    None stands for an entry that is left out: ``[1, ?; 3, 4]``.

    Args:
        text: what was typed.
        shape: the rows and columns that are needed, if that is known; a single row or column may
            then be typed as a vector, and a single entry as a number.
        parameters: the names of the open parameters that it may contain.
        longest: the most characters that are read.

    Raises:
        Unreadable: an entry is not a number, or the shape is another one.
    """
    source = clean(text, longest)
    if shape and (placed := _by_indices(source, *shape)):
        arithmetic = Arithmetic(shape[0] * shape[1])
        return tuple(tuple(_numbers([entry], parameters, None, arithmetic)[0] for entry in row) for row in placed)
    return _forms(
        source, lambda member: _matrix(member, shape, parameters), lambda rows: _given(chain.from_iterable(rows))
    )


def _by_indices(source: Source, rows: int, columns: int) -> list[list[Source]] | None:
    """The entries of a matrix that are typed one by one, each with its row and column; None if not all are.

    Those of a single row or column have one index, and the same letter.
    """
    pieces = [piece for piece in source.split(",;\n") if piece.text]
    once = [_NUMBERED.match(piece.text) for piece in pieces]
    if 1 in (rows, columns) and all(once) and len({name[1] for name in once if name}) == 1:
        numbered = {int(name[2]): piece.part(name.end(), len(piece.text))
                    for name, piece in zip(once, pieces, strict=True) if name}  # fmt: skip
        if len(pieces) == rows * columns > 1 and [*sorted(numbered)] == [*range(1, rows * columns + 1)]:
            line = [numbered[index] for index in sorted(numbered)]
            return [line] if rows == 1 else [[entry] for entry in line]
    named = [_INDEXED.match(piece.text) for piece in pieces]
    found = {
        (int(name[1]), int(name[2])): piece.part(name.end(), len(piece.text))
        for piece, name in zip(pieces, named, strict=True)
        if name
    }
    places = [[(row, column) for column in range(1, columns + 1)] for row in range(1, rows + 1)]
    if len(pieces) != rows * columns or {*found} != {*chain.from_iterable(places)}:
        return None
    return [[found[place] for place in row] for row in places]


def _matrix(
    source: Source, shape: tuple[int, int] | None, parameters: Sequence[str]
) -> tuple[tuple[Reading | None, ...], ...]:
    body = untransposed(source)
    transposed = body is not source
    factor, body = _scaled(body, parameters)
    rows = nested_rows(body)
    plain = rows is None
    if rows is None:
        column = shape[0] if shape and shape[1] == 1 else 0
        rows = plain_rows(body, spaced=shape not in (None, (1, 1)), column=column)
    if len(rows) > (most := max(_ENTRIES, *shape or (1,))):
        raise source.unreadable(f"More than {most} rows were typed; leave out those that were not asked for.")
    arithmetic, alone = Arithmetic(sum(map(len, rows))), len(rows) == len(rows[0]) == 1
    nothing = all(left_out(entry) for row in rows for entry in row)

    def read_row(number: int, row: list[Source]) -> tuple[Reading | None, ...]:
        given = [i for i, entry in enumerate(row) if nothing or not left_out(entry)]
        entries = [row[i] for i in given]
        place = None if alone else lambda i: f"row {number}, entry {given[i - 1] + 1}"
        readings = _numbers(_times(factor, entries) if factor else entries, parameters, place, arithmetic, most)
        found = dict(zip(given, readings, strict=True))
        return tuple(found.get(i) for i in range(len(row)))

    matrix = [read_row(number, row) for number, row in enumerate(rows, 1)]
    for i, row in enumerate(matrix, 1):
        if len(row) != len(matrix[0]):
            raise source.unreadable(f"Row {i} has length {len(row)}, row 1 has {len(matrix[0])}; make them equal.")
    if transposed:
        matrix = list(zip(*matrix, strict=True))
    read = (len(matrix), len(matrix[0]))
    if shape is not None and read != shape:
        if not (plain and 1 in read and read == shape[::-1]):
            sizes = f"A {read[0]}×{read[1]} matrix was read, {_wanted(*shape)}."
            raise source.unreadable(sizes + _comma(source, read[0] * read[1], shape[0] * shape[1]))
        matrix = list(zip(*matrix, strict=True))
    return tuple(matrix)


def read_table(
    text: str,
    keys: Sequence[Key],
    parameters: Sequence[str] = (),
    ends: Sequence[str] = (),
    longest: int = LONGEST,
) -> dict[Key, Reading]:
    """Read a number for each key: ``cool: 3.5, warm: 2.5``, or the numbers alone in the keys' order.

    A key that is left out is not in what is read.

    Args:
        text: what was typed.
        keys: the states, or the pairs of state and action, that each need a number.
        parameters: the names of the open parameters that the numbers may contain.
        ends: the terminal states, whose 0 may be typed too.
        longest: the most characters that are read.

    Raises:
        Unreadable: a key is unknown or repeated, or its number cannot be read.
    """
    if len(keys) == 1 and (reading := plain(text)) is not None:
        return {keys[0]: reading}
    text = _ANGLES.sub(r"(\1)", text)
    source = clean(keyed_list(text, (*keys, *ends)), longest)
    asked = Asked(keys, ends)
    shared = for_all(source, keys)
    found = dict.fromkeys(keys, shared) if shared else by_name(source, asked)
    if found is None:
        factor, body = _scaled(untransposed(_unnamed(source)), parameters)
        rows = _number_rows(body, len(keys))
        rows = [_times(factor, row) for row in rows] if factor else rows
        flat = [entry for row in rows for entry in row]
        found = in_order(rows, source, asked) if len(flat) <= asked.most else None
        if found is None:
            readings = _numbers(flat, parameters, "entry {}".format if len(flat) != 1 else None)
            needed = f"{len(keys)} {_are(len(keys))} needed: {listed(map(shown, keys))}."
            raise source.unreadable(f"{_count(len(readings))} read, {needed}{_comma(source, len(readings), len(keys))}")
    arithmetic = Arithmetic(len(found))
    given = {key: entry for key, entry in found.items() if not left_out(entry)} or found
    _refuse_last_percent(given.values())
    return {key: _numbers([entry], parameters, partial(_place, key), arithmetic)[0] for key, entry in given.items()}


def _place(key: str | tuple[str, str], _: int) -> str:
    return shown(key)


def _number_rows(source: Source, count: int) -> list[list[Source]]:
    """The numbers line by line, or by the brackets around each row; of as many lines as numbers each is one."""
    if rows := nested_rows(source):
        return rows
    body, wrapped = unwrapped(source)
    whole = [ended(row) for row in filled(body.split(";\n"))]
    rows = [filled(row.split(",")) for row in whole]
    tight = any(_TIGHT.search(row.text) for row in whole)
    square = len(whole) > 1 and len({*map(len, rows)}) == 1 and len(whole) != count  # 8,10;8,4 for four values
    if body.has(";") and (square or not tight) and sum(map(len, rows)) == count:
        return rows  # -2, 3; 4, 6
    lines = filled(body.split("\n;" if body.has("\n") or not body.has(",") else "\n"))
    return [entries_of(line, (count > 1 or wrapped) and len(lines) != count) for line in lines]


def read_words(
    text: str,
    keys: Sequence[str],
    options: Mapping[str, Sequence[str]],
    ends: Sequence[str] = (),
    longest: int = LONGEST,
) -> dict[str, tuple[str, ...]]:
    """Read a policy: ``cool: fast, warm: slow``, or the actions alone in the keys' order.

    Args:
        text: what was typed.
        keys: the states.
        options: the actions that are allowed in each.
        ends: the terminal states, for which a sign for no action may be typed.
        longest: the most characters that are read.

    Returns:
        The action of each state, or several that are said to be equally good: ``cool: E or S``; none of a state that
        is left out.

    Raises:
        Unreadable: a state is unknown or repeated, or its action is not allowed.
    """
    source = clean(keyed_list(text, (*keys, *ends)), longest)
    source = source.before(_BECAUSE) if len(keys) == 1 else source
    asked = Asked(keys, ends, lambda word, key: _is_option(word, options[key]))
    shared = for_all(source, keys)
    common = shared is not None and all(_is_option(shared.text, options[key]) for key in keys)
    found = dict.fromkeys(keys, shared) if shared and common else by_name(source, asked)
    if found is None:
        body = _unnamed(source)
        rows = _word_rows(body, options)
        words = [word for row in rows for word in row]
        tied = len(keys) == 1 and len(words) > 1
        found = {keys[0]: body} if tied else in_order(rows, source, asked)
        if found is None:
            needed = f"{len(keys)} {_are(len(keys))} needed: {listed(keys)}."
            raise source.unreadable(f"{_count(len(words), 'word')} read, {needed}")
    given = {key: word for key, word in found.items() if _is_option(word.text, options[key]) or not left_out(word)}
    given = given or found
    return {key: the_options(_last_form(word), key, options[key]) for key, word in given.items()}


def _is_option(word: str, allowed: Sequence[str]) -> bool:
    return len(options_named(word, allowed)) == 1


def _word_rows(source: Source, options: Mapping[str, Sequence[str]]) -> list[list[Source]]:
    """The words line by line, or by the brackets around each row; of a line without commas, those between spaces."""
    allowed = {tuple(actions) for actions in options.values()} if len(options) > 1 else set()
    body, _ = unwrapped(source)
    pieces = [piece for piece in body.split(",;\n ") if piece.text]
    rows = [piece.unwrapped("[(") for piece in pieces]
    if len(pieces) != len(options) and len(pieces) > 1 and all(rows):  # [[up, up], [left, up]]
        return [_line_words(row, allowed) for row in rows if row]
    lines = filled(body.split("\n;" if body.has("\n") else "\n"))
    if len(lines) == 1:
        lines = _rows_of_grid(body, len(options)) or lines
    return [_line_words(line, allowed) for line in lines]


def _rows_of_grid(body: Source, count: int) -> list[Source]:
    """The rows of a grid on one line: ``> > v; ^ # >``, ``>>v ^#>``; none, if these are no rows."""
    drawn = [word for word in body.split(lambda _, sign: sign.isspace()) if word.text]
    if 1 < len(drawn) != count and all(_DRAWN.fullmatch(word.text) and len(word.text) > 1 for word in drawn):
        return drawn
    for mark in ";|":
        rows = filled(body.split(mark))
        lengths = [len(row.text.split()) for row in rows]
        whole = 1 < len(rows) != count and not body.has(",") and max(lengths) > 1
        if whole and (sum(lengths) == count or len({*lengths}) == 1):
            return rows
    return []


def _line_words(line: Source, allowed: Collection[Sequence[str]]) -> list[Source]:
    if line.has(",;|"):
        return [word for word in line.split(",;|") if word.text]
    if not allowed or any(_is_option(line.text, actions) for actions in allowed):
        return [line]
    words = [word for word in line.split(lambda _, sign: sign.isspace()) if word.text]
    if len(words) == 1 and _DRAWN.fullmatch(line.text):
        return [line.part(index, index + 1) for index in range(len(line.text))]
    return words


def _last_form(source: Source) -> Source:
    """What stands behind the last equal sign, without its reason: the action in ``arg max {1; 2} = fast (2 > 1)``."""
    source = source.before(_BECAUSE)
    compared = _COMPARED.search(source.text)
    last = (source.part(0, compared.start()) if compared else source).split("=")[-1]
    if _RELATION.search(source.text[: last.start - source.start]):
        raise source.unreadable(f"{quoted(source.text)} says what it is not, or no more than that; type what it is.")
    return last


def read_choice(text: str, options: Mapping[str, str]) -> str:
    """Read which option was chosen, and give its letter.

    It may be typed as its letter, ``b`` or ``(b)``, its text, both, how its text begins, or words of it that no other
    has.

    Args:
        text: what was typed.
        options: the text of every option, by its letter.

    Raises:
        Unreadable: no option fits, or several do.
    """
    source = clean(text).before(_BECAUSE)
    source = source.unwrapped("[") or source
    typed = _flattened(unquoted(source.text))
    spellings = [(_flattened(told), letter) for letter, told in options.items()]
    typed = _SAID.sub("", typed)
    remark = _REMARK.search(typed)
    if remark and not matches(typed, spellings):
        before = typed[: remark.start()]
        if not _names_another(remark[0], _told(before, spellings), spellings):
            typed = before  # large (lower BIC)
    for bare in names_alone(typed):
        if not matches(typed, spellings) and (_lettered(bare, options) or matches(bare, spellings)):
            typed = bare
    both = _BOTH.fullmatch(typed)
    if both and (lettered := _lettered(both[1], options)):
        told = _told(both[2], spellings)
        if told == lettered:
            return lettered[0]
        if told:
            raise source.unreadable(f"{quoted(typed)} has the letter of one option and words of another; type one.")
    first, *why = _WHY.split(typed, maxsplit=1)
    if why and (chosen := _lettered(first, options)) and not _names_another(why[0], chosen, spellings):
        typed = first  # A, lower BIC
    alone = re.fullmatch(r"\(?([A-Za-z])[).:]?", typed)
    lettered = _lettered(alone[1], options) if alone else []
    marked = bool(lettered) and len(typed) > 1  # (b) is no text
    named = [] if marked else matches(typed, spellings)
    hits = list(dict.fromkeys(lettered + named)) or _partly(typed, spellings)
    if len(hits) == 1:
        return hits[0]
    fault = "fits more than one option" if hits else "is not one of the options"
    raise source.unreadable(f"{quoted(source.text)} {fault}; type a letter from {min(options)} to {max(options)}.")


def names_alone(text: str) -> tuple[str, str]:
    """A name without its article, ``arm 2`` for ``the arm 2``; and without all words around it, ``green``."""
    bare = text.strip()
    return _ARTICLE.sub("", bare), _AROUND.sub("", bare)


def _flattened(text: str) -> str:
    """A text without the signs that only set its mathematics: ``Q*`` for ``$Q^*$``, and ``Vπ`` for ``V^pi``."""
    return re.sub(r"(?<=\b[VQvq])_?pi\b", "π", re.sub(r"[$^{}]", "", text))


def _names_another(reason: str, chosen: Sequence[str], spellings: Sequence[tuple[str, str]]) -> bool:
    """Whether what is said behind an option is another one: its letter alone, its words, or "or" with them."""
    if any(re.search(rf"\b{letter}\b", reason) for _, letter in spellings):
        return True
    said = reason.strip(" ().,;:")
    alone = _OR.sub("", said)
    others = [(spelled(spelling).casefold(), letter) for spelling, letter in spellings if letter not in chosen]
    if alone != said:
        return any(re.search(rf"(?<!\w){re.escape(words)}(?!\w)", spelled(alone).casefold()) for words, _ in others)
    return bool(matches(alone, others))


def _lettered(typed: str, options: Iterable[str]) -> list[str]:
    return [letter for letter in options if letter.casefold() == typed.casefold()]


def _told(typed: str, spellings: Sequence[tuple[str, str]]) -> list[str]:
    return matches(typed, spellings) or _partly(typed, spellings)


def _partly(typed: str, spellings: Sequence[tuple[str, str]]) -> list[str]:
    """The one option that has the typed words; else those that begin as typed."""
    typed = typed.casefold().rstrip(". ")
    if not typed:
        return []
    told = [(spelled(spelling).casefold(), letter) for spelling, letter in spellings]
    words = re.compile(rf"(?<!\w){re.escape(typed)}(?!\w)")
    found = words.search if any(map(str.isalpha, typed)) else words.match  # the 1 in "with n > 1" tells nothing
    having = [letter for spelling, letter in told if found(spelling)]
    return having if len(having) == 1 else [letter for spelling, letter in told if spelling.startswith(typed)] or having


def read_yes_no(text: str) -> bool:
    """Read yes or no.

    Raises:
        Unreadable: it is neither.
    """
    source = clean(text)
    said, *why = _WHY.split(unquoted(source.before(_BECAUSE).text).casefold().rstrip(".!"), maxsplit=1)
    reason = "".join(why)
    if said in _YES | _NO and not (_YES | _NO) & {reason.strip(" )"), *re.findall(r"\w{2,}", reason)}:
        return said in _YES
    raise source.unreadable(f"{quoted(source.text)} is neither yes nor no; type one of them.")


def _whole(source: Source) -> Source:
    """One number; refused where a line begins with a sign: it may go on with it, or be another number."""
    if parted := _SIGNED_LINE.search(source.text):
        said = "A line that begins with a sign may be another number; write a sum on one line."
        raise source.unreadable(said, parted.end())
    return source


def _unnamed(source: Source) -> Source:
    """What is typed after ``V =`` or ``V:``, perhaps in braces with it: ``{"V": [3.5, 2.5]}``."""
    inside = source.unwrapped("{") or source
    label = _LABEL.match(inside.text)
    return inside.part(label.end(), len(inside.text)) if label else source


def _unlabelled(entries: list[Source], names: Sequence[str], called: Sequence[str]) -> list[Source]:
    """The entries without the ``R_0 =`` or ``R_0:`` before each; in the order of the names, if all are known."""
    labels = _labels(entries, called)
    values = [
        entry.part(label.end(), len(entry.text)) if label else entry.behind(_LEFT_SIDE)
        for entry, label in zip(entries, labels, strict=True)
    ]
    found = [(label[2].strip(), entry_named(label[2], names, called)) for label in labels if label]
    if deviation := next((name for name, index in found if index is None and is_deviation(name, names)), ""):
        raise entries[0].unreadable(
            f"{quoted(deviation)} is a standard deviation; give the variance, σ² = …, or Σ = … ."
        )
    meant = [index for _, index in found if index is not None]
    unknown = [name for name, index in found if index is None]
    if all(labels) and unknown and (meant or sorted(unknown, key=_naturally) != unknown):
        raise entries[0].unreadable(f"{quoted(unknown[0])} is not asked for here; give the {len(names)} entries alone.")
    if len(meant) < len(entries):
        return values
    placed: dict[int, Source] = {}
    for entry, value, index in zip(entries, values, meant, strict=True):
        if index in placed:
            raise entry.unreadable(f"Entry {index + 1} is given twice; give every entry once.")
        placed[index] = value
    return [placed.get(index, Source("")) for index in range(len(names))]


def _labels(entries: Sequence[Source], called: Sequence[str]) -> list[re.Match[str] | None]:
    """What names each entry: ``R_0 =``, ``R_0:``; words that entries are called by need no sign, ``mean 5``."""
    return [_LABEL.match(entry.text) or _called(called).match(entry.text) for entry in entries]


def _called(words: Sequence[str]) -> re.Pattern[str]:
    """One of these words, or its beginning, before a value; nothing, where there are none."""
    begun = "|".join(f"{word[:3]}[a-z]*" for word in words)
    return re.compile(rf"()({begun})\s+(?=\S)" if words else "(?!)", re.IGNORECASE)


def _scaled(source: Source, parameters: Sequence[str]) -> tuple[str, Source]:
    """The number before a bracket, and the bracket; no number where something else stands there, or nothing."""
    factor, bracket = unscaled(source)
    if factor:
        with suppress(Unreadable):
            number(Source(factor), parameters, Arithmetic())
            return factor, bracket
    return "", source


def _refuse_relations(source: Source) -> None:
    """Complain about ``k <= 4``, which is no value.

    Raises:
        Unreadable: it holds such a sign.
    """
    if found := _RELATION.search(source.text):
        raise source.unreadable(f"{quoted(found[0])} is no equal sign; write the value alone.", found.start())


def _refuse_last_percent(entries: Iterable[Source]) -> None:
    """Complain about ``50, 30, 20 %``, where all may be percent, or the last one alone.

    Raises:
        Unreadable: the sign stands behind the last entry alone, and before it there is more than 1.
    """
    *before, last = sorted(entries, key=lambda entry: entry.start) or [Source("")]
    bare = [reading for entry in before if (reading := plain(entry.text))]
    if last.text.endswith("%") and len(bare) == len(before) and any(sign(each.value - 1) > 0 for each in bare):
        raise last.unreadable("'%' stands behind the last number alone; write it behind each that is meant in percent.")


def _times(factor: str, entries: Iterable[Source]) -> list[Source]:
    return [Source(f"({factor})*({entry.text})", entry.start) for entry in entries]


def _naturally(name: str) -> list[str | int]:
    """By letters and by numbers: R_2 comes before R_10."""
    return [int(run) if run.isdecimal() else run for run in re.split("([0-9]+)", name.casefold())]


def _forms(source: Source, read: Callable[[Source], Read], numbers: Callable[[Read], Iterable[Reading]]) -> Read:
    """One answer in several forms, ``x = 1/4 = 0.25``: the last that is exact, else the last.

    Raises:
        Unreadable: the last cannot be read, or another one says something else.
    """
    _refuse_relations(source)
    members = source.split("=≈")
    while len(members) > 1 and not members[0].text:
        del members[0]
    if len(members) > _FORMS:
        raise source.unreadable("It holds too many equal signs; write the value alone, once.")
    best = read(members[-1])
    for place, member in reversed(list(enumerate(members[:-1]))):
        try:
            other = read(member)
        except Unreadable:
            continue  # what it is, or how it was worked out
        theirs, own = list(numbers(other)), list(numbers(best))
        pairs = list(zip(theirs, own, strict=False))
        if len(theirs) != len(own) or not all(_agree(*pair) for pair in pairs):
            if place == 0 and _ONLY_NAME.fullmatch(member.text):
                continue
            first, second = quoted(member.text), quoted(members[-1].text)
            raise member.unreadable(f"{first} and {second} are not equal; '=' stands between forms of one answer.")
        if any(mine.decimal and not others.decimal for others, mine in pairs):
            best = other
    return best


def _agree(first: Reading, second: Reading) -> bool:
    """Whether two readings may be forms of one number; decimals may be rounded."""
    key, value = (second, first) if first.decimal else (first, second)
    if not value.decimal:
        return equivalent(value.value, key.value)
    try:
        return is_right(value.value, key.value)
    except NotReal:
        return False


def _number(source: Source, parameters: Sequence[str], arithmetic: Arithmetic) -> Reading:
    """Read one number; before its forms may stand what it is, and how it was worked out."""
    if (reading := plain(source.text)) is not None:
        return reading
    for _ in range(2):  # a matrix of one number, too
        inside = source.unwrapped("[")
        if inside and _SIGNED_ENTRY.search(inside.text):
            raise source.unreadable(f"{quoted(source.text)} holds several entries; one number is needed here.")
        source = inside or source
    source = source.replaced(_ROUNDED, lambda match: f"{match[0]}.")
    _refuse_relations(source)
    signs = [index for index, sign in source.outside() if sign in "=≈←"]
    if len(signs) > _FORMS:
        raise source.unreadable("It holds too many equal signs; write the value alone, once.")
    probe, begun = Arithmetic(), 0
    for start, stop in reversed(list(zip([0, *(index + 1 for index in signs)], signs, strict=False))):
        member = source.part(start, stop)
        try:
            number(member, parameters, probe)
        except Unreadable:
            if not member.text or (re.search(r"[^\W\d_]", member.text) and not _goes_on(member.text)):
                begun = stop + 1  # V(cool), max{1; 2}
            break
    try:
        return number(source.part(begun, len(source.text)), parameters, arithmetic)
    except Unreadable:
        if begun or not signs or not _ONLY_NAME.fullmatch(source.text[: signs[0]].strip()):
            raise
        return number(source.part(signs[0] + 1, len(source.text)), parameters, arithmetic)  # e = 2 may name the trace


def _goes_on(text: str) -> bool:
    """Whether a number stands first and words go on from it: ``2.5 because γ``, before an equal sign."""
    found = _NUMBER_FIRST.match(text)
    return found is not None and found[1].lower() not in GREEK


def _numbers(
    entries: Sequence[Source],
    parameters: Sequence[str],
    place: Callable[..., str] | None,
    arithmetic: Arithmetic | None = None,
    most: int = _ENTRIES,
) -> tuple[Reading, ...]:
    """Read some entries with one effort; ``place`` names an entry by its number, counted from 1."""
    if len(entries) > most:
        raise Unreadable(f"More than {most} numbers were typed; leave out those that were not asked for.")
    arithmetic = arithmetic or Arithmetic(len(entries))
    readings = []
    for i, entry in enumerate(entries, 1):
        try:
            readings.append(_number(entry, parameters, arithmetic))
        except Unreadable as complaint:
            raise (complaint.within(place(i)) if place else complaint) from None
    return tuple(readings)


def _count(count: int, noun: str = "number") -> str:
    return f"1 {noun} was" if count == 1 else f"{count} {noun}s were"


def _wanted(rows: int, columns: int) -> str:
    """Which shape is needed, and how that is typed."""
    if rows == columns == 1:
        return "one number is needed"
    line = f"{columns} numbers" if columns > 1 else "1 number"
    return f"{rows}×{columns} is needed: {f'{rows} rows of {line}, parted by semicolons' if rows > 1 else line}"


def _are(count: int) -> str:
    return "is" if count == 1 else "are"


def _comma(source: Source, read: int, needed: int) -> str:
    """A hint for those who may have meant decimal commas."""
    meant = read == 2 * needed and "." not in source.text and re.search("[0-9],[0-9]", source.text)
    return " Decimals are written with a point, as in 3.5." if meant else ""
