"""Mathematics on several lines of text: matrices as matrices, everything else on the middle line."""

from collections.abc import Callable

from msgspec import Struct

from rldrill.problems.mathematics import Fence, Marked, Math, Row, Script, Tabular, word
from rldrill.render.mathematics.unicode import unicode

_BRACKETS = {
    "[": ("⎡", "⎢", "⎣"),
    "]": ("⎤", "⎥", "⎦"),
    "(": ("⎛", "⎜", "⎝"),
    ")": ("⎞", "⎟", "⎠"),
    "{": ("⎧", "⎨", "⎩"),
}


class Stack(Struct, frozen=True):
    """Lines of the same width; the one at ``base`` is in line with what stands beside it."""

    lines: tuple[str, ...]
    base: int = 0

    @property
    def width(self) -> int:
        """How wide the lines are."""
        return len(self.lines[0])


#: Writes mathematics on one line.
Write = Callable[[Math], str]


def stacked(math: Math, write: Write = unicode) -> tuple[str, ...]:
    """Mathematics as lines of text, one line where there is no matrix in it; ``write`` writes what stands on one."""
    return tuple(line.rstrip() for line in _box(math, write).lines) if _has_grid(math) else (write(math),)


def _has_grid(math: Math) -> bool:
    match math:
        case Tabular(rows):
            return len(rows) > 1
        case Row(items):
            return any(map(_has_grid, items))
        case Fence(body) | Script(body) | Marked(body):
            return _has_grid(body)
        case _:
            return False


def _box(math: Math, write: Write) -> Stack:
    match math:
        case Tabular(rows, left, right):
            return _fenced(_cells(rows, write), left, right)
        case Row(items):
            return _beside(items, write)
        case Fence(body, left, right):
            return _fenced(_box(body, write), left, right)
        case Script(body, below, above):
            box = _box(body, write)
            raised = write(Script(word(""), below, above))
            top = [line + (raised if index == 0 else " " * len(raised)) for index, line in enumerate(box.lines)]
            return Stack(tuple(top), box.base)
        case Marked(body):
            return _box(body, write)
        case _:
            return Stack((write(math),))


def _cells(rows: tuple[tuple[Math, ...], ...], write: Write) -> Stack:
    texts = [[write(cell) for cell in line] for line in rows]
    widths = [max(map(len, column)) for column in zip(*texts, strict=True)]
    lines = ["  ".join(text.rjust(width) for text, width in zip(line, widths, strict=True)) for line in texts]
    return Stack(tuple(lines), len(lines) // 2)


def _fenced(box: Stack, left: str, right: str) -> Stack:
    height = len(box.lines)
    lines = [
        f"{_bracket(left, index, height)}{line}{_bracket(right, index, height)}" for index, line in enumerate(box.lines)
    ]
    return Stack(tuple(lines), box.base)


def _bracket(sign: str, index: int, height: int) -> str:
    if height == 1 or sign not in _BRACKETS:
        return sign
    top, middle, bottom = _BRACKETS[sign]
    return top if index == 0 else bottom if index == height - 1 else middle


def _beside(items: tuple[Math, ...], write: Write) -> Stack:
    # What stands between two matrices is written as one piece, so that its signs get their spaces.
    boxes: list[Stack] = []
    plain: list[Math] = []
    for item in (*items, None):
        if item is not None and not _has_grid(item):
            plain.append(item)
            continue
        if plain:
            text = write(Row(tuple(plain)))
            sign = text[0] in "+−-" and bool(boxes)
            tail = item is not None and text[-1] in "+−-"
            boxes.append(Stack((f" {text[0]} {text[1:].lstrip()}" if sign else text + " " * tail,)))
            plain = []
        if item is not None:
            boxes.append(_box(item, write))
    above = max(box.base for box in boxes)
    below = max(len(box.lines) - box.base for box in boxes)
    lines = [""] * (above + below)
    for box in boxes:
        for index in range(above + below):
            inside = index - above + box.base
            lines[index] += box.lines[inside] if 0 <= inside < len(box.lines) else " " * box.width
    return Stack(tuple(lines), above)
