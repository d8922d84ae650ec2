"""Blocks as Typst. They call functions of ``PREAMBLE``, which must stand before them."""

import math
from collections.abc import Iterator

from msgspec import Struct

from rldrill.problems.document import Beside, Block, Document, Equation, Heading, Paragraph, Table
from rldrill.problems.mathematics import EMPTY, Math
from rldrill.problems.pictures import Picture
from rldrill.render.mathematics.typst import SHORT, quoted, relation, text, typst
from rldrill.render.mathematics.typst_breaks import breakable
from rldrill.render.mathematics.unicode import unicode
from rldrill.render.mathematics.width import width, width_of_line
from rldrill.render.pictures.typst import picture, width_of
from rldrill.render.typst_files import typst_file
from rldrill.render.unicode import unicode_text

#: What is no wider than a page's text is not measured, which would be to lay it out twice; in widths of the type.
PAGE = 40.0
#: Signs are taken for as wide as most are not; in widths of the type, and how many points that is.
_SIGN, _PADDING, _GAP, _POINTS = 0.65, 1.4, 1.2, 10.0
#: The same in the cells of tables, which hold words and small letters more often.
_IN_CELLS = 0.6
#: Blocks side by side have the whole line, which equations may share with points and a letter before them.
_WHOLE = 1.2
#: So far apart, at least, tables stand that each have a sentence above them.
_BETWEEN = 2.0
#: What is higher than about half a page is broken across pages; in heights of the type, as are a line of text, a row of
#: a table, a row with a fraction, and an equation.
_HALF_PAGE, _LINE, _ROW, _FRACTION, _EQUATION = 36.0, 1.2, 1.4, 1.9, 2.4

PREAMBLE = typst_file("rldrill.render", "blocks.typ") + typst_file("rldrill.render.pictures", "pictures.typ")


def block(item: Block, room: float = PAGE) -> str:
    """A block as Typst markup; what is wider than the room, in widths of the type, is measured and fitted."""
    match item:
        case Paragraph(words):
            said = f"par[{text(words)}]"
            return f"#block(sticky: true, {said})\n" if words.endswith(":") else f"#{said}\n"
        case Heading(words):
            return f"#block(sticky: true, strong[{text(words)}])\n"
        case Table(header, rows):
            cells = "".join(f", [{text(cell)}]" for line in rows for cell in line)
            first = ", ".join(f"[{text(cell)}]" for cell in header)
            drawn = f"grid-table({len(header)}, table.header({first}){cells})"
            if _width(item) <= room:
                return f"#block({drawn})\n"
            return f"#wide-block({drawn}{long_or_not((item,))})\n"
        case Equation(left, rights, signs):
            if item.is_bare:
                return _apart(rights, room)
            links = "".join(
                f", (${relation(sign)}$, {breakable(right)})" for sign, right in zip(signs, rights, strict=True)
            )
            said = unicode_text(item)
            first = "" if left == EMPTY else typst(left)
            if width_of_line(left, rights, signs) <= room:
                return _on_a_line(said, " ".join([first, *_links(item)]))
            return f"#chain({quoted(said)}, ${first}${links})\n"
        case Beside(blocks):
            return _side_by_side(blocks, room)
        case Picture():
            return picture(item, shrinks=_width(item) > room)
        case _:
            raise TypeError(f"{type(item).__name__} has no Typst")


def _on_a_line(said: str, mathematics: str) -> str:
    return f"#one-line({quoted(said)}, ${mathematics}$)\n"


def _width(item: Block) -> float:
    """How wide a block is at most, in widths of the type; infinite where it is not known."""
    match item:
        case Table(header, rows):
            columns = zip(header, *rows, strict=True)
            signs = sum(max(len(unicode_text(Paragraph(cell))) for cell in column) for column in columns)
            return _IN_CELLS * signs + _PADDING * len(header)
        case Picture():
            return width_of(item) / _POINTS
        case Equation(left, rights, signs):
            return width_of_line(left, rights, signs)
        case _:
            return math.inf


def long_or_not(blocks: Document) -> str:
    """The argument that breaks blocks across pages; nothing where they are low enough to be kept together."""
    return ", long: true" if sum(map(_height, blocks)) > _HALF_PAGE else ""


def _height(item: Block) -> float:
    """How high a block is, about, in heights of the type; nothing for a picture, which is never broken."""
    match item:
        case Paragraph() | Heading():
            return _LINE * math.ceil(_SIGN * len(unicode_text(item)) / PAGE)
        case Table():
            return sum(_FRACTION if "/" in line else _ROW for line in unicode_text(item).splitlines())
        case Equation(_, rights) if item.is_bare and _stands_in_a_line(rights):
            return _EQUATION * sum(map(width, rights)) / PAGE
        case Equation(_, rights):
            return _EQUATION * len(rights)
        case Beside(blocks):
            return max(map(_height, blocks))
        case _:
            return 0.0


def _side_by_side(blocks: Document, room: float) -> str:
    if long_or_not((Beside(blocks),)):
        return "".join(block(item, room) for item in blocks)
    fits = sum(map(_width, blocks)) + _GAP * (len(blocks) - 1) <= _WHOLE * room
    bodies = (picture(item, shrinks=not fits) if isinstance(item, Picture) else block(item, room) for item in blocks)
    inside = ", ".join(f"[{body}]" for body in bodies if body)  # a picture that is too large is left out
    return f"#{'abreast' if fits else 'beside'}({inside})\n"


def _apart(items: tuple[Math, ...], room: float) -> str:
    """Mathematics that stands side by side where there is room."""
    if _stands_in_a_line(items):
        return f"#flow({', '.join(f'({quoted(unicode(item))}, ${typst(item)}$)' for item in items)})\n"
    return "".join(
        _on_a_line(unicode(item), typst(item))
        if width(item) <= room
        else f"#chain({quoted(unicode(item))}, $$, ($$, {breakable(item)}))\n"
        for item in items
    )


def _stands_in_a_line(items: tuple[Math, ...]) -> bool:
    return all(len(unicode(item)) <= 2 * SHORT for item in items)


def document(blocks: Document) -> str:
    """Blocks one under the other; short equations and narrow tables that follow each other share a line."""
    result: list[str] = []
    waiting: list[str] = []
    for item in (*_announced_together(tuple(_short_ones_apart(blocks))), None):
        if isinstance(item, Equation) and _is_short(item):
            waiting.append(f"({quoted(unicode_text(item))}, ${line(item)}$)")
            continue
        if waiting:
            result.append(f"#flow({', '.join(waiting)})\n")
            waiting = []
        if isinstance(item, _Announced):
            widths = ", ".join(f"{each:.1f}em" for each in item.widths)
            columns = zip(*item.pairs, strict=True)
            sentences, tables = (", ".join(f"[{block(each)}]" for each in column) for column in columns)
            long = long_or_not((Beside(tuple(table for _, table in item.pairs)),))
            result.append(f"#announced(({widths}), ({sentences}), ({tables}){long})\n")
        elif item is not None:
            result.append(block(item))
    return "".join(result)


def _short_ones_apart(blocks: Document) -> Iterator[Block]:
    """The blocks; short equations side by side may stand on a line with those that follow."""
    for item in blocks:
        if isinstance(item, Beside) and all(isinstance(each, Equation) and _is_short(each) for each in item.blocks):
            yield from item.blocks
        else:
            yield item


class _Announced(Struct, frozen=True):
    """Narrow tables side by side, each below the sentence that announces it, and how wide each is at most."""

    pairs: tuple[tuple[Paragraph, Table], ...]
    widths: tuple[float, ...]


def _announced_together(blocks: Document) -> Iterator[Block | _Announced]:
    """The blocks, those side by side that announced tables are narrow enough for."""
    at = 0
    while at < len(blocks):
        pairs: list[tuple[Paragraph, Table]] = []
        widths: list[float] = []
        while (pair := _pair(blocks[at + 2 * len(pairs) :])) and sum(widths) + (
            wide := _width_of(*pair, lines=2)
        ) <= PAGE:
            pairs.append(pair)
            widths.append(wide + _BETWEEN)
        if len(pairs) > 1:
            whole = [_width_of(*pair, lines=1) + _BETWEEN for pair in pairs]
            yield _Announced(tuple(pairs), tuple(whole if sum(whole) <= PAGE else widths))
            at += 2 * len(pairs)
        else:
            yield blocks[at]
            at += 1


def _pair(blocks: Document) -> tuple[Paragraph, Table] | None:
    match blocks:
        case (Paragraph(words) as first, Table() as table, *_) if words.endswith(":"):
            return first, table
    return None


def _width_of(words: Paragraph, table: Table, lines: int) -> float:
    """How wide a table is with its sentence above it, on so many lines at most."""
    return max(_width(table), _SIGN * len(unicode_text(words)) / lines)


def _is_short(equation: Equation) -> bool:
    if len(equation.rights) != 1:
        return False
    return len(unicode(equation.left)) + len(unicode(equation.rights[0])) <= SHORT


def line(equation: Equation) -> str:
    """An equation as the inside of a Typst equation, on one line however long it is."""
    return " ".join([typst(equation.left), *_links(equation)])


def _links(equation: Equation) -> list[str]:
    links = zip(equation.signs, equation.rights, strict=True)
    return [f"{relation(sign)} {typst(right)}" for sign, right in links]
