"""How a typed text is parted into entries, and into rows of entries."""

import re
from collections.abc import Callable
from itertools import pairwise

from rldrill.problems.grammar import refuse_comma
from rldrill.problems.notation import FUNCTIONS
from rldrill.problems.spelling import Source, quoted

_TRANSPOSED = re.compile(r"(?<=[\])}⟩])\s*(?:\^\s*\{?\s*[Tt⊤]\s*\}?|ᵀ|\.T|\.?')$")
_NOTHING = re.compile(r"[-–—?…]?")
_FACTOR = re.compile(
    r"(?P<factor>(?:[^()\[\],;|\s]|\((?:[^()\[\]]|\([^()\[\]]*\))+\))+)(?<!\*)\s*\*?\s*(?P<bracket>[\[(].*)",
    re.DOTALL,
)
_DIVIDED = re.compile(
    r"(?P<minus>-?)\s*(?P<bracket>[\[(].*[\])])\s*/\s*(?P<factor>[0-9.]+|√[0-9]+|[^\W\d_]+|\w*\([^()]*\))", re.DOTALL
)
_MIXED = re.compile(r"[0-9]+\s+[0-9]+\s*/\s*[0-9]+(?![0-9.])")


def untransposed(source: Source) -> Source:
    """A bracket without the ``^T`` behind it; the source itself if there is none."""
    return source.before(_TRANSPOSED)


def unscaled(source: Source) -> tuple[str, Source]:
    """The factor of a bracket of several entries, ``1/11 [5 3]`` or ``[5 3]/11``, and the bracket; no text without."""
    for pattern, written in ((_FACTOR, "{factor}"), (_DIVIDED, "{minus}1/({factor})")):
        if found := pattern.fullmatch(source.text):
            bracket = source.part(*found.span("bracket"))
            inside, wrapped = unwrapped(bracket)
            if wrapped and inside.has(",;| \n"):
                factor = written.format_map(found.groupdict())
                return ("-1" if factor == "-" else factor), bracket
    return "", source


def unwrapped(source: Source) -> tuple[Source, bool]:
    """What stands in up to three pairs of brackets around it all, and whether there are any."""
    body = source
    for _ in range(3):
        body = body.unwrapped() or body
    return body, body is not source


def vector_entries(source: Source, length: int | None) -> list[Source]:
    """The entries of a vector, perhaps each in brackets of its own."""
    body, wrapped = unwrapped(source)
    entries = entries_of(body, length != 1 and (wrapped or length is not None))
    columns = [entry.unwrapped("[") for entry in entries]  # [[1], [2]]
    whole = [column for column in columns if column]
    return whole if len(whole) == len(entries) else entries


def entries_of(source: Source, spaced: bool) -> list[Source]:
    """The entries between semicolons, else bars, else commas, else lines and (if ``spaced``) spaces.

    Raises:
        Unreadable: a comma may part two entries or be a decimal comma.
    """
    for marks in (";", "|"):
        if source.has(marks):
            entries = [ended(entry) for entry in source.split(marks if marks == ";" else "|\n")]
            _refuse_commas(entries, "semicolons" if marks == ";" else "bars")
            break
    else:
        if not source.has(","):
            lines = source.split("\n")
            alone = [not spaced or line.has("=≈:") for line in lines]
            cut = [[line] if whole else line.split(_gap(line)) for line, whole in zip(lines, alone, strict=True)]
            if len(lines) == 1:
                _refuse_product(source, cut[0])
            return filled([piece for pieces in cut for piece in pieces])
        entries = source.split(",")
        _refuse_doubtful(source, entries)
    if len(entries) > 1 and not entries[-1].text:
        del entries[-1]
    return [line for entry in entries for line in filled(entry.split("\n"))]


def ended(entry: Source) -> Source:
    """An entry without a comma behind it."""
    return entry.part(0, len(entry.text) - 1) if entry.text.endswith(",") else entry


def left_out(entry: Source) -> bool:
    """Whether nothing is typed for an entry, or a sign for nothing."""
    return _NOTHING.fullmatch(entry.text) is not None


def filled(pieces: list[Source]) -> list[Source]:
    """The pieces that are not blank; a blank one if all are, to be complained about."""
    return [piece for piece in pieces if piece.text] or pieces[:1]


def _refuse_commas(entries: list[Source], others: str) -> None:
    """Complain about commas inside entries that something else parts."""
    for entry in entries:
        for index, character in entry.outside():
            if character == ",":
                refuse_comma(entry, index)
                raise entry.unreadable(f"Commas and {others} are mixed; use one of them.", index)


def _refuse_doubtful(source: Source, entries: list[Source]) -> None:
    """Complain about ``-1 -0,5``: are these −1 and −0.5, or −1 − 0 and 5?"""
    tight = [
        index
        for index, sign in source.outside()
        if sign == "," and source.text[:index][-1:].isdigit() and source.text[index + 1 :][:1].isdigit()
    ]
    lines = [line.split("=≈:←")[-1] for entry in entries for line in entry.split("\n")] if tight else []
    if not any(len(filled(line.split(_gap(line)))) > 1 for line in map(_whole, lines)):
        return
    for index in tight:
        refuse_comma(source, index)
    raise source.unreadable(
        "Commas and spaces are mixed; put a comma between all entries, and write decimals with a point.", tight[0]
    )


def _whole(source: Source) -> Source:
    """An entry with its mixed numbers, 1 3/4, in one piece."""
    return Source(_MIXED.sub("1", source.text), source.start)


def _refuse_product(line: Source, entries: list[Source]) -> None:
    """Complain about ``1 + 2 gamma``: where spaces stand inside entries, one may also stand in a product."""
    if not any(" " in entry.text for entry in entries):
        return
    for before, after in pairwise(entries):
        product = f"{before.text.split(' ')[-1]} {after.text.split(' ')[0]}"
        if re.match(r"\S*[\w)] (?:[^\W\d_]|[(√])", product) and product in line.text:
            raise after.unreadable(f"{quoted(product)} may be a product or two entries; write * or a comma there.")


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


def nested_rows(source: Source) -> list[list[Source]] | None:
    """The entries of rows that each have brackets of their own; None if they have not."""
    for whole, fewest in ((source.unwrapped(), 1), (source, 2)):
        pieces = [piece for piece in whole.split(",;\n ") if piece.text] if whole else []
        rows = [piece.unwrapped("[{⟨") or piece.unwrapped("(") for piece in pieces]
        if len(rows) < fewest:
            continue
        found = [
            row for piece, row in zip(pieces, rows, strict=True) if row and (piece.text[0] != "(" or row.has(",;"))
        ]
        if len(found) == len(rows) and not (len(found) == 1 and found[0].has(";\n")):
            return [entries_of(row, True) for row in found]
    return None


def plain_rows(source: Source, *, spaced: bool, column: int = 0) -> list[list[Source]]:
    """The entries of rows that end with a semicolon or a line; ``spaced`` where there must be several.

    Of as many rows as a ``column`` is long each is one entry: ``1 2/3; 1 1/3``.
    """
    body, wrapped = unwrapped(source)
    rows = filled(body.split(";\n"))
    if len(rows) == column > 1:
        return [entries_of(row, False) for row in rows]
    return [entries_of(row, spaced or wrapped or len(rows) > 1 or row.has("|")) for row in rows]
