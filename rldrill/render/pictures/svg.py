"""Pictures as SVG: the scenes that the PDF draws, for pages of the web."""

from functools import cache
from html import escape

from rldrill.problems.document import pieces
from rldrill.problems.mathematics import Math, Script
from rldrill.problems.pictures import Picture
from rldrill.render.mathematics.unicode import unicode
from rldrill.render.pictures.described import described
from rldrill.render.pictures.scene import (
    LINE,
    SHARES,
    SIZE,
    Caption,
    Curve,
    Ellipse,
    Path,
    Scene,
    Shape,
    caption_bounds,
)
from rldrill.render.pictures.scenes import scene_of

#: A point of the scene on the screen, in pixels.
_ZOOM = 1.5
_MARGIN = 2.0
_ANCHORS = {0.0: "start", 0.5: "middle", 1.0: "end"}


@cache
def svg(picture: Picture) -> str:
    """A picture as an ``svg`` element; nothing where it cannot be drawn readably.

    Raises:
        TypeError: it is a timeline, which is no drawing but a row of texts.
    """
    scene = scene_of(picture)
    return "" if scene is None else drawn(scene, described(picture))


def drawn(scene: Scene, description: str) -> str:
    """A scene as an ``svg`` element, with what it shows in words."""
    box = scene.box
    wide, high = box.right - box.left + 2 * _MARGIN, box.bottom - box.top + 2 * _MARGIN
    view = f"{box.left - _MARGIN:.1f} {box.top - _MARGIN:.1f} {wide:.1f} {high:.1f}"
    shapes = "".join(map(_shape, scene.shapes))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" role="img" aria-label="{escape(description)}" viewBox="{view}" '
        f'width="{wide * _ZOOM:.0f}" height="{high * _ZOOM:.0f}" font-family="serif">{shapes}</svg>'
    )


def _shape(shape: Shape) -> str:
    match shape:
        case Path(points, closed, fill, width, dashed):
            tag = "polygon" if closed else "polyline"
            places = " ".join(f"{_number(x)},{_number(y)}" for x, y in points)
            dashes = ' stroke-dasharray="3 2"' if dashed else ""
            return f'<{tag} points="{places}" {_ink(fill, width)}{dashes}/>'
        case Curve((x, y), (cx, cy), (ex, ey)):
            places = f"M{_number(x)} {_number(y)}Q{_number(cx)} {_number(cy)} {_number(ex)} {_number(ey)}"
            return f'<path d="{places}" {_ink(None, LINE)}/>'
        case Ellipse((x, y), (across, down), fill):
            return (
                f'<ellipse cx="{_number(x)}" cy="{_number(y)}" rx="{_number(across)}" ry="{_number(down)}" '
                f"{_ink(fill, LINE)}/>"
            )
        case Caption((x, _), text, anchor, plate):
            box = caption_bounds(shape)
            ground = (
                f'<rect x="{_number(box.left)}" y="{_number(box.top)}" width="{_number(box.right - box.left)}" '
                f'height="{_number(box.bottom - box.top)}" fill="white"/>'
                if plate
                else ""
            )
            line = box.bottom - 0.32 * SIZE
            return (
                f'{ground}<text x="{_number(x)}" y="{_number(line)}" font-size="{SIZE:g}" '
                f'text-anchor="{_ANCHORS[SHARES[anchor][0]]}">{_words(text)}</text>'
            )


def _words(text: str) -> str:
    return "".join(escape(piece) if isinstance(piece, str) else _math(piece) for piece in pieces(text))


def _math(math: Math) -> str:
    """Mathematics in a label; scripts that Unicode has no signs for are set small."""
    if isinstance(math, Script):
        below = "" if math.below is None else _shifted(math.below, 2.5)
        above = "" if math.above is None else _shifted(math.above, -3)
        return f"{escape(unicode(math.body).strip())}{below}{above}"
    return escape(unicode(math).strip())


def _shifted(math: Math, by: float) -> str:
    text = escape(unicode(math).strip())
    return f'<tspan font-size="70%" dy="{by:g}">{text}</tspan><tspan dy="{-by:g}">\u200b</tspan>'


def _number(value: float) -> str:
    return f"{value:.2f}".rstrip("0").rstrip(".")


def _ink(fill: float | None, width: float) -> str:
    inside = "none" if fill is None else f"rgb({','.join([str(round(255 * fill))] * 3)})"
    return f'fill="{inside}" stroke="black" stroke-width="{width:g}"'
