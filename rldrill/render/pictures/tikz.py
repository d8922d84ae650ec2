"""Pictures as TikZ, from the scenes that the PDF draws."""

from functools import cache

from rldrill.problems.pictures import Picture
from rldrill.render.mathematics.latex import latex_text
from rldrill.render.pictures.scene import LINE, Caption, Curve, Ellipse, Path, Point, Scene, Shape
from rldrill.render.pictures.scenes import scene_of

_ANCHORS = {"centre": "center", "left": "west", "right": "east", "below": "north", "above": "south"}


@cache
def tikz(picture: Picture) -> str:
    """A picture as a ``tikzpicture``; nothing where it cannot be drawn readably.

    Raises:
        TypeError: it is a timeline, which is no drawing but a row of texts.
    """
    scene = scene_of(picture)
    return "" if scene is None else drawn(scene)


def drawn(scene: Scene) -> str:
    """A scene as a ``tikzpicture``; y points down, as in the scene."""
    shapes = "\n".join(map(_shape, scene.shapes))
    return f"\\begin{{tikzpicture}}[x=1pt,y=-1pt,font=\\footnotesize]\n{shapes}\n\\end{{tikzpicture}}"


def _shape(shape: Shape) -> str:
    match shape:
        case Path(points, closed, fill, width, dashed):
            line = " -- ".join(map(_point, points)) + (" -- cycle" if closed else "")
            return rf"\path[{_ink(fill, width)}{',dashed' if dashed else ''}] {line};"
        case Curve(start, (cx, cy), end):
            first, second = ((_third(x, cx), _third(y, cy)) for x, y in (start, end))
            bend = f"{_point(first)} and {_point(second)}"
            return rf"\path[{_ink(None, LINE)}] {_point(start)} .. controls {bend} .. {_point(end)};"
        case Ellipse(centre, (across, down), fill):
            radii = f"x radius={across:.2f}pt, y radius={down:.2f}pt"
            return rf"\path[{_ink(fill, LINE)}] {_point(centre)} ellipse [{radii}];"
        case Caption(at, text, anchor, plate):
            ground = ",fill=white" if plate else ""
            return rf"\node[anchor={_ANCHORS[anchor]},inner sep=1pt{ground}] at {_point(at)} {{{latex_text(text)}}};"


def _third(end: float, control: float) -> float:
    """Where the control point of a cubic curve lies that is the quadratic one."""
    return end + (control - end) * 2 / 3


def _point(point: Point) -> str:
    return f"({point[0]:.2f},{point[1]:.2f})"


def _ink(fill: float | None, width: float) -> str:
    inside = "" if fill is None else f",fill=black!{round(100 * (1 - fill))}"
    return f"draw,line width={width:g}pt{inside}"
