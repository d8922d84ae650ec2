"""A question on one screen: as airy as there is room for, else closer, side by side, and at last in two columns."""

import re
from collections.abc import Iterable, Iterator, Sequence

from msgspec import Struct
from rich.console import Console, ConsoleOptions, RenderResult
from rich.segment import Segment

from rldrill.problems.document import Beside, Block, Paragraph, Table
from rldrill.problems.pictures import Picture
from rldrill.render.encodable import Spelling
from rldrill.render.terminal import renderable, wrapped

#: No question is wider, however wide the terminal.
WIDEST = 100
#: The room between what stands side by side.
_BETWEEN = 3
#: A column of text is no narrower.
_NARROWEST = 26
#: What is said of a picture, where the table stands alone.
_OF_THE_PICTURE = re.compile(r" \(on the arrows: [^)]*\)")

#: Lines of the terminal.
Lines = list[list[Segment]]


class Compact(Struct, frozen=True):
    """A document in at most so many lines, if there is a way to write it so.

    Args:
        blocks: the document.
        besides: how many lines of the terminal something else takes.
    """

    blocks: tuple[Block, ...]
    besides: int

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        width = min(options.max_width, WIDEST)
        room = console.size.height - self.besides
        shortest: Lines | None = None
        for lines in _layouts(self.blocks, console, options, width):
            if shortest is None or len(lines) < len(shortest):
                shortest = lines
            if len(lines) <= room:
                break
        for line in shortest or []:
            yield from line
            yield Segment.line()


def _layouts(blocks: Sequence[Block], console: Console, options: ConsoleOptions, width: int) -> Iterator[Lines]:
    """The same document, each time in fewer lines."""
    writer = _Writer(console, options, width)
    airy = [writer.block(block) for block in blocks]
    yield _under(airy, gap=1)
    for tables in (blocks, tuple(_without_pictures(blocks))):
        units = list(_units(writer, tables))
        yield _under(_rows(units, width), gap=1)
        yield _under(_rows(units, width), gap=0)
        closer = list(_units(_Writer(console, options, width, ruled=False), tables))
        for first in (1, 0):
            yield from _columns(closer[:first], closer[first:], width)


class _Writer:
    """Writes blocks as lines of a console."""

    def __init__(self, console: Console, options: ConsoleOptions, width: int, *, ruled: bool = True) -> None:
        self._console = console
        self._options = options
        self._width = width
        self._ruled = ruled
        self._spelling = Spelling(options.encoding)

    def block(self, block: Block) -> Lines:
        if isinstance(block, Paragraph):
            return self.text(block.text, self._width)
        lines = self._console.render_lines(renderable(block), self._options.update(width=self._width), pad=False)
        lines = [_trimmed(line) for line in lines]
        return lines if self._ruled or not isinstance(block, Table) else _unruled(lines)

    def text(self, text: str, width: int) -> Lines:
        return [[Segment(line)] for line in wrapped(self._spelling.inline(text, glued=True), width)]


class _Unit:
    """Text and the block that it introduces, either of which may be missing."""

    def __init__(self, writer: _Writer, text: str, block: Block | None) -> None:
        self._writer = writer
        self._text = text
        self._block = writer.block(block) if block is not None else []
        self._lines: dict[int, Lines] = {}
        self.narrowest = max(_wide(self._block), _NARROWEST if text else 0)

    @property
    def is_text(self) -> bool:
        """Whether it is nothing but text, which is best as wide as can be."""
        return not self._block

    def lines(self, width: int) -> Lines:
        """The unit where there is so much room."""
        if width not in self._lines:
            text = self._writer.text(self._text, width) if self._text else []
            self._lines[width] = [*text, *self._block]
        return self._lines[width]


def _units(writer: _Writer, blocks: Iterable[Block]) -> Iterator[_Unit]:
    """Paragraphs run on; a text that ends in a colon stands above what it introduces."""
    text: list[str] = []
    for block in _unfolded(blocks):
        if isinstance(block, Paragraph):
            text.append(block.text)
            continue
        said, introduces = " ".join(text), bool(text) and text[-1].endswith(":")
        if introduces and len(text) > 1:
            yield _Unit(writer, " ".join(text[:-1]), None)
            said = text[-1]
        if said and not introduces:
            yield _Unit(writer, said, None)
        yield _Unit(writer, said if introduces else "", block)
        text = []
    if text:
        yield _Unit(writer, " ".join(text), None)


def _unfolded(blocks: Iterable[Block]) -> Iterator[Block]:
    for block in blocks:
        if isinstance(block, Beside):
            yield from block.blocks
        else:
            yield block


def _without_pictures(blocks: Iterable[Block]) -> Iterator[Block]:
    """The document without the pictures that show what is in the table beside them, too."""
    for block in blocks:
        if isinstance(block, Beside) and any(isinstance(each, Table) for each in block.blocks):
            yield from (each for each in block.blocks if not isinstance(each, Picture))
        elif isinstance(block, Paragraph):
            yield Paragraph(_OF_THE_PICTURE.sub("", block.text))
        else:
            yield block


def _under(parts: Iterable[Lines], gap: int) -> Lines:
    """Parts one under the other, with a gap between them."""
    result: Lines = []
    for part in parts:
        result += [*([[]] * gap if result else []), *part]
    return result


def _rows(units: Sequence[_Unit], width: int) -> Iterator[Lines]:
    """Units side by side as long as they fit; text for itself."""
    row: list[_Unit] = []
    for unit in units:
        taken = sum(each.narrowest + _BETWEEN for each in row)
        if row and (unit.is_text or taken + unit.narrowest > width):
            yield _row(row, width)
            row = []
        if unit.is_text:
            yield unit.lines(width)
        else:
            row.append(unit)
    if row:
        yield _row(row, width)


def _row(units: Sequence[_Unit], width: int) -> Lines:
    spare = (width - sum(unit.narrowest + _BETWEEN for unit in units) + _BETWEEN) // len(units)
    return _beside([unit.lines(unit.narrowest + spare) for unit in units])


def _columns(above: Sequence[_Unit], units: Sequence[_Unit], width: int) -> Iterator[Lines]:
    """The shortest of all ways to write units in two columns, under those that come first."""
    best: Lines | None = None
    for split in range(1, len(units)):
        left, right = units[:split], units[split:]
        least = max(unit.narrowest for unit in left)
        most = width - _BETWEEN - max(unit.narrowest for unit in right)
        for wide in sorted({least, (least + most) // 2, most}) if least <= most else ():
            lines = _beside(
                [
                    _under((unit.lines(wide) for unit in left), gap=0),
                    _under((unit.lines(width - _BETWEEN - wide) for unit in right), gap=0),
                ]
            )
            if best is None or len(lines) < len(best):
                best = lines
    if best is not None:
        yield _under([*(unit.lines(width) for unit in above), best], gap=0)


def _beside(parts: Sequence[Lines]) -> Lines:
    """Parts from the left to the right, their first lines at the same height."""
    widths = [_wide(part) + _BETWEEN for part in parts]
    result: Lines = []
    for number in range(max(map(len, parts))):
        line: list[Segment] = []
        for part, wide in zip(parts, widths, strict=True):
            own = part[number] if number < len(part) else []
            line += [*own, Segment(" " * (wide - Segment.get_line_length(own)))]
        result.append(_trimmed(line))
    return result


def _wide(lines: Lines) -> int:
    return max(map(Segment.get_line_length, lines), default=0)


def _trimmed(line: list[Segment]) -> list[Segment]:
    """A line without the blanks at its end."""
    line = list(line)
    while line and not line[-1].text.strip():
        line.pop()
    if line:
        line[-1] = Segment(line[-1].text.rstrip(), line[-1].style)
    return line


def _unruled(lines: Lines) -> Lines:
    """A table without the line under its titles."""
    return [line for line in lines if set("".join(segment.text for segment in line)) - set(" ─-")]
