"""Documents for the terminal, as rich's renderables."""

import os
import sys
from collections.abc import Callable, Container, Iterable, Iterator, Sequence
from io import StringIO, TextIOWrapper
from textwrap import wrap
from typing import TypeAlias

from msgspec import Struct
from rich import box
from rich.cells import cell_len
from rich.console import Console, ConsoleOptions, Group, RenderableType, RenderResult
from rich.control import Control
from rich.measure import Measurement
from rich.padding import Padding
from rich.table import Table as RichTable
from rich.text import Text

from rldrill.problems.document import Beside, Block, Equation, Heading, Paragraph, Table, counted
from rldrill.problems.mathematics import Math, Row, is_sign
from rldrill.problems.parts import Choice, Part
from rldrill.problems.pictures import Picture
from rldrill.render.differences import differences
from rldrill.render.encodable import Spelling
from rldrill.render.mathematics.breaking import broken
from rldrill.render.mathematics.unicode import GLUE

#: How wide output is when nobody's terminal says: wide enough that nothing is cut.
PIPED = 140
#: How wide a document is as text.
_PAGE = 100
#: The room between blocks that stand side by side.
_BETWEEN = 4
#: The room between the columns of a table.
_BETWEEN_COLUMNS = 2

#: A text with its style, or without.
Span: TypeAlias = tuple[str, str] | str


def console(*, stderr: bool = False, plain: bool = False) -> Console:
    """A console that leaves texts as they are, and is wide enough when its output is a file or a pipe.

    A ``plain`` one has no colours, and spells every sign in ASCII.
    """
    stream = sys.stderr if stderr else sys.stdout
    if plain and isinstance(stream, TextIOWrapper):
        stream.reconfigure(encoding="ascii", errors=stream.errors)
    width = None if stream.isatty() or "COLUMNS" in os.environ else PIPED
    return Console(stderr=stderr, highlight=False, markup=False, emoji=False, width=width, no_color=plain or None)


def render(blocks: Iterable[Block]) -> Group:
    """A document, its blocks one under the other with a line between them."""
    return Group(*(item for block in blocks for item in (renderable(block), Text(""))))


def plain(blocks: Iterable[Block]) -> str:
    """A document as text without colours."""
    screen = Console(file=StringIO(), width=_PAGE, color_system=None, highlight=False, markup=False, emoji=False)
    with screen.capture() as captured:
        screen.print(render(blocks))
    return "\n".join(line.rstrip() for line in captured.get().splitlines()).rstrip("\n")


class _Spelled(Struct, frozen=True):
    """What is written as the console's encoding and width demand, which are known only when it is printed."""

    write: Callable[[Spelling, int], RenderableType]

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        yield self._written(options)

    def __rich_measure__(self, console: Console, options: ConsoleOptions) -> Measurement:
        return Measurement.get(console, options, self._written(options))

    def _written(self, options: ConsoleOptions) -> RenderableType:
        return self.write(Spelling(options.encoding), options.max_width)


def renderable(block: Block) -> RenderableType:
    """One block."""
    match block:
        case Paragraph(text):
            return _Spelled(lambda spelling, width: _wrapped(spelling.inline(text, glued=True), width))
        case Heading(text):
            return _Spelled(lambda spelling, _: Text(spelling.inline(text), style="bold"))
        case Table():
            return _indented(_Spelled(lambda spelling, width: _table(block, spelling, width)))
        case Equation():
            equation = _Spelled(lambda spelling, width: _equation(block, spelling, width))
            return equation if block.is_bare else _indented(equation)
        case Beside(blocks):
            return _Beside(blocks)
        case Picture():
            return _indented(_Spelled(lambda spelling, width: _drawn(block, spelling, width)))
        case _:
            raise TypeError(f"{type(block).__name__} cannot be shown in a terminal")


def _wrapped(text: str, width: int) -> Text:
    return Text(text.replace(GLUE, " ") if width == _ENDLESS else "\n".join(wrapped(text, width)))


def wrapped(text: str, width: int) -> list[str]:
    """The lines of a paragraph, which end between words and never inside a formula that has room on one line."""
    text = " ".join(word if len(word) <= width else word.replace(GLUE, " ") for word in text.split(" "))
    return [
        line.replace(GLUE, " ")
        for part in text.split("\n")
        for line in wrap(part, width, break_long_words=False, break_on_hyphens=False) or [""]
    ]


def words(*spans: Span) -> RenderableType:
    """A line of texts, each with its style or without, that hold no mathematics between ``$`` signs."""
    return _Spelled(lambda spelling, _: _text(spelling, spans))


def _text(spelling: Spelling, spans: Iterable[Span]) -> Text:
    styled = ((span, "") if isinstance(span, str) else span for span in spans)
    return Text.assemble(*((spelling.plain(text), style) for text, style in styled))


class _Beside(Struct, frozen=True):
    """Blocks side by side where the terminal is wide enough, else one under the other.

    A picture that is wider than the terminal gives way to what it stands beside.
    """

    blocks: tuple[Block, ...]

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        items = [renderable(block) for block in self.blocks]
        widths = [Measurement.get(console, options.update(max_width=_ENDLESS), item).maximum for item in items]
        if sum(widths) + _BETWEEN * (len(widths) - 1) > options.max_width:
            fitting = [
                item
                for item, block, width in zip(items, self.blocks, widths, strict=True)
                if not isinstance(block, Picture) or width <= options.max_width
            ]
            stacked_items = [line for item in fitting for line in (item, Text(""))]
            yield Group(*stacked_items[:-1])
            return
        grid = RichTable.grid(padding=(0, _BETWEEN))
        for width in widths:
            grid.add_column(no_wrap=True, width=width)
        grid.add_row(*items)
        yield grid


#: Wider than any terminal.
_ENDLESS = 10_000


def _drawn(picture: Picture, spelling: Spelling, width: int) -> Text:
    """A picture drawn with signs, folded where it can be; what is wider than the terminal is folded, not cut."""
    drawn = spelling.lines(picture, width)
    fits = all(len(line) <= width for line in drawn)
    return Text("\n".join(drawn), no_wrap=fits, overflow="ignore" if fits else "fold")


def _table(table: Table, spelling: Spelling, width: int) -> RenderableType:
    header = [Text(spelling.inline(title)) for title in table.header]
    rows = [[Text(spelling.inline(cell)) for cell in line] for line in table.rows]
    numbers = [
        title.plain
        for title, column in zip(header, zip(*table.rows, strict=True), strict=True)
        if all(cell.startswith("$") or cell == "–" for cell in column)
    ]
    drawn = RichTable(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=True)
    return _filled(drawn, header, rows, width, right=numbers)


def table(
    header: Sequence[str],
    rows: Iterable[Sequence[Span]],
    *,
    right: Container[str] = (),
    whole: Container[str] = (),
    ruled: bool = False,
) -> RenderableType:
    """A table of texts, each with its style or without; a paragraph a line where the terminal is too narrow.

    Args:
        header: the titles of the columns.
        rows: the cells.
        right: the columns that stand to the right.
        whole: the columns that are not folded.
        ruled: whether there is a line under the titles.
    """
    lines = [list(line) for line in rows]

    def write(spelling: Spelling, width: int) -> RenderableType:
        drawn = RichTable(box=box.SIMPLE_HEAD if ruled else None, show_edge=False, pad_edge=False)
        drawn.collapse_padding = ruled
        titles = [Text(title, style="bold") for title in header]
        return _filled(
            drawn, titles, [[_text(spelling, [cell]) for cell in line] for line in lines], width, right, whole
        )

    return _Spelled(write)


def _filled(
    drawn: RichTable,
    header: list[Text],
    rows: list[list[Text]],
    width: int,
    right: Container[str],
    whole: Container[str] = (),
) -> RenderableType:
    """The rows in a table; as paragraphs where words would have to be broken to fit them in."""
    needed = 0
    for title, *cells in zip(header, *rows, strict=True):
        longest = len if title.plain in whole else _longest
        needed += _BETWEEN_COLUMNS + max(map(longest, (title, *cells)))
    if needed - _BETWEEN_COLUMNS + 2 * drawn.pad_edge > width:
        return Group(*(_paragraph(header, line) for line in rows))
    for title in header:
        drawn.add_column(
            title, justify="right" if title.plain in right else "left", overflow="fold", no_wrap=title.plain in whole
        )
    for line in rows:
        drawn.add_row(*line)
    return drawn


def _longest(cell: Text) -> int:
    return max(map(len, cell.plain.split()), default=0)


def _paragraph(header: list[Text], line: list[Text]) -> Text:
    told = [Text(f"{title.plain}: ").append_text(cell) for title, cell in zip(header, line, strict=True) if cell]
    return Text(", ").join(told)


def _equation(equation: Equation, spelling: Spelling, width: int) -> RenderableType:
    left = "\n".join(spelling.stacked(equation.left))
    signs = [spelling.plain(sign) for sign in equation.signs]
    named = not equation.is_bare
    room = width - (_wide(left.split("\n")) + _wide(signs) + 2 if named else 0)
    grid = RichTable.grid(padding=(0, 1))
    if named:
        grid.add_column(no_wrap=True)
        grid.add_column(no_wrap=True)
    grid.add_column(overflow="fold")
    for index, (sign, right) in enumerate(zip(signs, equation.rights, strict=True)):
        for row, part in enumerate(broken(right, lambda math, further: _wide(_line(math, further, spelling)), room)):
            lines = _line(part, row > 0, spelling)
            shift = "\n" * (len(lines) // 2)
            first = index == row == 0
            before = (Text(shift + left if first else ""), Text(shift + sign if row == 0 else ""))
            grid.add_row(*(before if named else ()), Text("\n".join(lines)))
    return grid


def _line(math: Math, further: bool, spelling: Spelling) -> list[str]:
    """One line of an equation; of a further one the sign has a space behind it."""
    if not further or not isinstance(math, Row) or not is_sign(sign := math.items[0]):
        return spelling.stacked(math)
    lines = spelling.stacked(Row(math.items[1:]))
    before = spelling.stacked(sign)[0].strip()
    return [f"{before if index == len(lines) // 2 else ' ' * len(before)} {line}" for index, line in enumerate(lines)]


def _wide(lines: Iterable[str]) -> int:
    """How many places the widest line takes: a hat takes none of its own."""
    return max(map(cell_len, lines), default=0)


def turn_page(screen: Console) -> None:
    """Go on at the top of the screen, where there is one; what was there is scrolled away, not erased."""
    if screen.is_terminal and not screen.is_dumb_terminal:
        screen.print("\n" * screen.height, end="")
        screen.control(Control.home())


def compared(wrong: Equation, right: Equation) -> RenderableType:
    """An equation as it was read above the right one, underlined where they differ."""
    return _Spelled(lambda spelling, _: _compared(wrong, right, spelling))


def _compared(wrong: Equation, right: Equation, spelling: Spelling) -> RenderableType:
    lines = differences(*("".join(_one_line(equation, spelling)) for equation in (wrong, right)))
    grid = RichTable.grid(padding=(0, 1))
    grid.add_column(no_wrap=True)
    grid.add_column(overflow="fold")
    for who, pieces in zip(("yours:", "right:"), lines, strict=True):
        marked = (Text(piece, style="underline" if differs else "") for piece, differs in pieces)
        grid.add_row(Text(who, style="dim"), Text("").join(marked))
    return _indented(grid)


def _one_line(equation: Equation, spelling: Spelling) -> Iterator[str]:
    yield " ".join(spelling.stacked(equation.left))
    for sign, side in zip(equation.signs, equation.rights, strict=True):
        yield f" {spelling.plain(sign)} {' '.join(line.strip() for line in spelling.stacked(side))}"


def _indented(content: RenderableType) -> RenderableType:
    return Padding(content, (0, 0, 0, 2), expand=False)


def asked(part: Part, *, only: bool = False) -> RenderableType:
    """The sentence that asks for a part, with its letter unless it is the only one."""
    return _Spelled(lambda spelling, width: _asked(part, spelling, width, only=only))


def _asked(part: Part, spelling: Spelling, width: int, *, only: bool) -> Text:
    letter = "" if only else f"({part.label}) "
    points = f"[{counted(part.points, 'point').replace(' ', GLUE)}]"
    text = _wrapped(f"{letter}{spelling.inline(part.ask, glued=True)} {points}", width)
    text.stylize("bold", 0, len(letter))
    text.stylize("dim", len(text) - len(points))
    if isinstance(part.kind, Choice):
        for letter, option in part.kind.options.items():
            text.append(f"\n    ({letter}) {spelling.inline(option)}")
    return text
