"""Pictures in Typst: scenes with its own lines and curves, so that the PDF needs nothing else."""

import math
from functools import lru_cache

from rldrill.problems.document import pieces
from rldrill.problems.mathematics import Fraction, Glyph, Math, Row
from rldrill.problems.pictures import Picture, Timeline
from rldrill.render.mathematics.typst import quoted, typst
from rldrill.render.pictures.described import described
from rldrill.render.pictures.scene import LINE, SHARES, SIZE, Caption, Curve, Ellipse, Path, Point, Scene, Shape
from rldrill.render.pictures.scenes import scene_of

#: A picture that is no wider is not measured; in points.
_ROOM = 460


#: A worksheet and its key have the same pictures, and to lay one out takes a while.
_scene = lru_cache(maxsize=64)(scene_of)


def width_of(block: Picture) -> float:
    """The width of a picture in points; infinite where only the page decides it."""
    scene = None if isinstance(block, Timeline) else _scene(block)
    return math.inf if scene is None else scene.box.right - scene.box.left


def picture(block: Picture, *, shrinks: bool = False) -> str:
    """A picture as Typst markup; nothing where it cannot be drawn readably.

    Args:
        block: the picture.
        shrinks: whether there may be less room than usual.
    """
    if isinstance(block, Timeline):
        return f"#drawing({quoted(described(block))}, {_timeline(block)})\n"
    scene = _scene(block)
    return "" if scene is None else f"#drawing({quoted(described(block))}, {scene_box(scene, shrinks=shrinks)})\n"


def scene_box(scene: Scene, *, shrinks: bool) -> str:
    """A scene as an expression: a box of its size, shrunk where there is less room."""
    box = scene.box
    shapes = "".join(f"\n  {_shape(shape, (box.left, box.top))}" for shape in scene.shapes)
    width = box.right - box.left
    how = "wide-picture" if shrinks or width > _ROOM else "picture"
    return f"{how}({_pt(width)}, {_pt(box.bottom - box.top)}, {{{shapes}\n}})"


def _shape(shape: Shape, origin: Point) -> str:
    match shape:
        case Path(points, closed, fill, width, dashed):
            (x, y), *rest = (_moved(point, origin) for point in points)
            steps = "".join(f"curve.line(({_pt(a)}, {_pt(b)})), " for a, b in rest)
            close = 'curve.close(mode: "straight"), ' if closed else ""
            style = f"{_fill(fill)}stroke: {_stroke(width, dashed)}"
            return f"place(curve({style}, curve.move(({_pt(x)}, {_pt(y)})), {steps}{close}))"
        case Curve(start, control, end):
            (x, y), (cx, cy), (ex, ey) = (_moved(point, origin) for point in (start, control, end))
            bend = f"curve.quad(({_pt(cx)}, {_pt(cy)}), ({_pt(ex)}, {_pt(ey)}))"
            return f"place(curve(stroke: {_stroke(LINE)}, curve.move(({_pt(x)}, {_pt(y)})), {bend}))"
        case Ellipse(centre, (across, down), fill):
            x, y = _moved(centre, origin)
            size = f"width: {_pt(2 * across)}, height: {_pt(2 * down)}"
            where = f"dx: {_pt(x - across)}, dy: {_pt(y - down)}"
            return f"place({where}, ellipse({size}, {_fill(fill)}stroke: {_stroke(LINE)}))"
        case Caption(at, words, anchor, plate):
            x, y = _moved(at, origin)
            across, down = SHARES[anchor]
            ground = "white" if plate else "none"
            return f"label({_pt(x)}, {_pt(y)}, {across}, {down}, {ground}, {_pt(SIZE)}, [{small(words)}])"


def _moved(point: Point, origin: Point) -> Point:
    return point[0] - origin[0], point[1] - origin[1]


def _pt(number: float) -> str:
    return f"{round(number, 2) + 0:g}pt" if abs(number) < 1000 else f"{number:.1f}pt"


def _fill(grey: float | None) -> str:
    return "" if grey is None else f"fill: luma({round(255 * grey)}), "


def _stroke(width: float, dashed: bool = False) -> str:
    return f'(paint: black, thickness: {width}pt, dash: "dashed")' if dashed else f"{width}pt"


def small(words: str) -> str:
    """A label's text: its fractions on one line, ``1/2``."""
    return "".join(
        f"#{quoted(piece)};" if isinstance(piece, str) else f"${typst(_flat(piece))}$" for piece in pieces(words)
    )


def _flat(math: Math) -> Math:
    if isinstance(math, Row):
        return Row(tuple(map(_flat, math.items)))
    if isinstance(math, Fraction):
        return Row((_flat(math.numerator), Glyph("/", "punctuation"), _flat(math.denominator)))
    return math


def _timeline(line: Timeline) -> str:
    steps = []
    for moment in line.moments():
        ends = "true" if line.ended and moment.last else "false"
        parts = [f"time-state([{small(moment.label)}], {ends}, [{small(moment.state)}])"]
        if moment.goes_on:
            each = (moment.action, moment.reward)
            action, reward = ("none" if text is None else f"[{small(text)}]" for text in each)
            parts.append(f"time-arrow({action}, {reward})")
        steps.append(f"box({{{'; '.join(parts)}}})")
    return f"timeline({', '.join(steps)})"
