"""Scenes as Braille signs, two dots across and four down in each, with their labels written over them."""

from collections import defaultdict
from collections.abc import Callable, Mapping
from math import ceil, hypot

from rldrill.render.mathematics.unicode import inline
from rldrill.render.pictures.scene import SHARES, Caption, Ellipse, Path, Point, Scene

#: Points of the scene to a dot.
_DOT = 2.2
_BITS = ((0x01, 0x08), (0x02, 0x10), (0x04, 0x20), (0x40, 0x80))


def raster(scene: Scene) -> list[str]:
    """A scene without curves as lines of text."""
    box = scene.box
    high = ceil((box.bottom - box.top) / _DOT / 4) + 1
    dots = [defaultdict[int, int](int) for _ in range(high)]
    texts: dict[tuple[int, int], str] = {}

    def mark(point: Point) -> None:
        across, down = round((point[0] - box.left) / _DOT), round((point[1] - box.top) / _DOT)
        dots[down // 4][across // 2] |= _BITS[down % 4][across % 2]

    for shape in scene.shapes:
        match shape:
            case Path(points, closed=closed, dashed=dashed):
                for start, end in zip(points, (*points[1:], *points[: int(closed)]), strict=False):
                    _line(start, end, mark, dashed=dashed)
            case Ellipse((x, y), (across, down), fill):
                for step in range(-4, 5):
                    for half in range(-4, 5):
                        if step * step + half * half <= 16 and (fill != 1.0 or step * step + half * half >= 9):
                            mark((x + across * step / 4, y + down * half / 4))
            case Caption((x, y), words, anchor):
                text = inline(words)
                row = min(high - 1, max(0, int((y - box.top) / _DOT / 4 - (SHARES[anchor][1] - 0.5))))
                column = round((x - box.left) / _DOT / 2 - SHARES[anchor][0] * len(text))
                texts[row, max(0, column)] = text
    lines = [
        _row(line, {at: text for (row, at), text in texts.items() if row == number}) for number, line in enumerate(dots)
    ]
    while lines and not lines[-1]:
        lines.pop()
    return lines


def _row(cells: Mapping[int, int], texts: Mapping[int, str]) -> str:
    line = [chr(0x2800 + cells[at]) if at in cells else " " for at in range(max(cells, default=-1) + 1)]
    for at, text in texts.items():
        line += " " * (at + len(text) - len(line))
        line[at : at + len(text)] = text
    return "".join(line).rstrip()


def _line(start: Point, end: Point, mark: Callable[[Point], None], *, dashed: bool) -> None:
    steps = max(1, ceil(hypot(end[0] - start[0], end[1] - start[1]) / _DOT * 1.5))
    for step in range(steps + 1):
        if not dashed or step % 6 < 3:
            share = step / steps
            mark((start[0] + share * (end[0] - start[0]), start[1] + share * (end[1] - start[1])))
