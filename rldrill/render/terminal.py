"""Documents for the terminal, as rich's renderables."""

import os
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from io import StringIO

from rich import box
from rich.console import Console, ConsoleOptions, Group, RenderableType, RenderResult
from rich.measure import Measurement
from rich.padding import Padding
from rich.table import Table as RichTable
from rich.text import Text

from rldrill.problems.document import Beside, Block, Equation, Heading, Paragraph, Table
from rldrill.problems.parts import Choice, Part
from rldrill.problems.pictures import Picture
from rldrill.render.mathematics.stacked import stacked
from rldrill.render.mathematics.unicode import inline
from rldrill.render.pictures.text import lines

#: How wide output is when nobody's terminal says: wide enough that nothing is cut.
PIPED = 140
#: How wide a document is as text.
_PAGE = 100
#: The room between blocks that stand side by side.
_BETWEEN = 4


def console(*, stderr: bool = False) -> Console:
    """A console that leaves texts as they are, and is wide enough when its output is a file or a pipe."""
    stream = sys.stderr if stderr else sys.stdout
    width = None if stream.isatty() or "COLUMNS" in os.environ else PIPED
    return Console(stderr=stderr, highlight=False, markup=False, emoji=False, width=width)


def render(blocks: Iterable[Block]) -> Group:
    """A document, its blocks one under the other with a line between them."""
    return Group(*(item for block in blocks for item in (renderable(block), Text(""))))


def plain(blocks: Iterable[Block]) -> str:
    """A document as text without colours."""
    screen = Console(file=StringIO(), width=_PAGE, color_system=None, highlight=False, markup=False, emoji=False)
    with screen.capture() as captured:
        screen.print(render(blocks))
    return "\n".join(line.rstrip() for line in captured.get().splitlines()).rstrip("\n")


def renderable(block: Block) -> RenderableType:
    """One block."""
    match block:
        case Paragraph(text):
            return Text(inline(text))
        case Heading(text):
            return Text(inline(text), style="bold")
        case Table(header, rows):
            return _table(header, rows)
        case Equation():
            return _equation(block)
        case Beside(blocks):
            return _Beside(tuple(map(renderable, blocks)))
        case Picture():
            return _indented(_Drawn(block))
        case _:
            raise TypeError(f"{type(block).__name__} cannot be shown in a terminal")


@dataclass(frozen=True)
class _Beside:
    """Blocks side by side where the terminal is wide enough, else one under the other."""

    items: tuple[RenderableType, ...]

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        widths = [Measurement.get(console, options, item).maximum for item in self.items]
        if sum(widths) + _BETWEEN * (len(widths) - 1) > options.max_width:
            stacked_items = [line for item in self.items for line in (item, Text(""))]
            yield Group(*stacked_items[:-1])
            return
        grid = RichTable.grid(padding=(0, _BETWEEN, 0, 0))
        for width in widths:
            grid.add_column(no_wrap=True, width=width)
        grid.add_row(*self.items)
        yield grid


@dataclass(frozen=True)
class _Drawn:
    """A picture drawn with signs, folded where it can be."""

    picture: Picture

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        yield self._text(options.max_width)

    def __rich_measure__(self, console: Console, options: ConsoleOptions) -> Measurement:
        return Measurement.get(console, options, self._text(options.max_width))

    def _text(self, width: int) -> Text:
        return Text("\n".join(lines(self.picture, width)), no_wrap=True, overflow="ignore")


def _table(header: tuple[str, ...], rows: tuple[tuple[str, ...], ...]) -> RenderableType:
    table = RichTable(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=True)
    for title, column in zip(header, zip(*rows, strict=True), strict=True):
        numbers = all(cell.startswith("$") or cell == "–" for cell in column)
        table.add_column(Text(inline(title)), justify="right" if numbers else "left", overflow="fold")
    for line in rows:
        table.add_row(*(Text(inline(cell)) for cell in line))
    return _indented(table)


def _equation(equation: Equation) -> RenderableType:
    grid = RichTable.grid(padding=(0, 1, 0, 0))
    grid.add_column(no_wrap=True)
    grid.add_column(no_wrap=True)
    grid.add_column(overflow="fold")
    left = "\n".join(stacked(equation.left))
    for index, (sign, right) in enumerate(zip(equation.signs, equation.rights, strict=True)):
        lines = stacked(right)
        middle = len(lines) // 2
        shift = "\n" * middle
        grid.add_row(Text(shift + left if index == 0 else ""), Text(shift + sign), Text("\n".join(lines)))
    return _indented(grid)


def _indented(content: RenderableType) -> RenderableType:
    return Padding(content, (0, 0, 0, 2), expand=False)


def asked(part: Part, *, only: bool = False) -> Text:
    """The sentence that asks for a part, with its letter unless it is the only one."""
    text = Text() if only else Text(f"({part.label}) ", style="bold")
    text.append(inline(part.ask))
    if isinstance(part.kind, Choice):
        for letter, option in part.kind.options.items():
            text.append(f"\n    ({letter}) {inline(option)}")
    if part.points != 1:
        text.append(f"  [{part.points} points]", style="dim")
    return text
