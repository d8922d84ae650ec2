"""Backup diagrams with signs: ○ a state, ● an action, □ the end, ╰─╯ the arc of a maximum."""

from msgspec import Struct

from rldrill.problems.pictures import Branch, Node
from rldrill.render.mathematics.unicode import inline

_SIGNS = {"state": "○", "action": "●", "end": "□"}
_GAP = 3


class _Block(Struct, frozen=True):
    """Lines of one width, and the column in which the node above hangs them."""

    lines: list[str]
    column: int

    @property
    def width(self) -> int:
        return len(self.lines[0])


def tree(root: Node) -> list[str]:
    """A backup diagram as lines, its root above."""
    return [line.rstrip() for line in _node(root).lines]


def _node(node: Node) -> _Block:
    sign, label = _SIGNS[node.kind], inline(node.label)
    if not node.branches:
        return _centred([sign, label] if label else [sign])
    below = _joined([_branch(branch, dots=node.dots) for branch in node.branches])
    columns = [at for at, char in enumerate(below[0]) if char in "│┊"]
    middle, wide = (columns[0] + columns[-1]) // 2, len(below[0])
    lines = []
    if len(columns) > 1:
        lines.append(_bar(columns, middle, wide))
        if node.maximum:
            lines.append(_arc(columns, wide))
    lines += below
    head = f"{' ' * middle}{sign}{' ' + label if label else ''}"
    width = max(wide, len(head))
    return _Block([line.ljust(width) for line in (head, *lines)], middle)


def _bar(columns: list[int], middle: int, width: int) -> str:
    line = [" "] * width
    for at in range(columns[0], columns[-1] + 1):
        line[at] = "─"
    for at in columns:
        line[at] = "┌" if at == columns[0] else "┐" if at == columns[-1] else "┬"
    line[middle] = "┼" if line[middle] == "┬" else "┴"
    return "".join(line)


def _arc(columns: list[int], width: int) -> str:
    """The arc from the first branch to the last, over those between them."""
    line = [" "] * width
    first, last = columns[0], columns[-1]
    for at in range(first + 1, last):
        line[at] = "─"
    line[first + 1], line[last - 1] = "╰", "╯"
    for at in columns:
        line[at] = "│" if at in (first, last) else "┼"
    return "".join(line)


def _branch(branch: Branch, *, dots: bool) -> _Block:
    """The line down, with what stands beside it, and the node at its end."""
    block = _node(branch.node)
    label = inline(branch.label)
    upright = "┊" if dots else "│"
    beside = f"{' ' * block.column}{upright}"
    above = [f"{beside} {label}"] if label else [beside] * (2 if dots else 1)
    rows = [*above, *block.lines]
    width = max(map(len, rows))
    return _Block([row.ljust(width) for row in rows], block.column)


def _centred(lines: list[str]) -> _Block:
    width = max(map(len, lines)) | 1  # odd, so that there is a middle
    return _Block([line.center(width) if len(line) % 2 else f"{line.center(width - 1)} " for line in lines], width // 2)


def _joined(blocks: list[_Block]) -> list[str]:
    """The lines of blocks side by side."""
    high = max(len(block.lines) for block in blocks)
    return [
        (" " * _GAP).join(block.lines[row] if row < len(block.lines) else " " * block.width for block in blocks)
        for row in range(high)
    ]
