"""Arms and pendulums as scenes."""

from math import cos, radians, sin

from rldrill.problems.pictures import Arm, Pendulum
from rldrill.render.pictures.scene import Box, Ellipse, Label, Path, Point, Scene, Shape, rectangle

_REACH = 110.0
_ROD = 60.0


def arm(picture: Arm) -> Scene:
    """The links from joint to joint; each angle is measured from the dashed line on."""
    scale = _REACH / sum(picture.lengths)
    at: Point = (0.0, 0.0)
    heading = 0.0
    lines: list[Shape] = [*_ground(at)]
    labels: list[Shape] = []
    for index, (length, angle) in enumerate(zip(picture.lengths, picture.angles, strict=True), 1):
        lines.append(Path((at, _towards(at, heading, 30)), dashed=True, width=0.4))
        lines.append(Path(tuple(_towards(at, heading + angle * step / 12, 17) for step in range(13)), width=0.4))
        labels.append(Label(_towards(at, heading + angle / 2, 27), f"$θ_{index}$", plate=True))
        heading += angle
        after = _towards(at, heading, length * scale)
        lines.append(Path((at, after), width=2.2))
        middle = _towards(at, heading, length * scale * 0.6)
        labels.append(Label(_towards(middle, heading + (90 if angle >= 0 else -90), 9), f"$l_{index}$", plate=True))
        labels.append(Ellipse(at, (3, 3)))
        at = after
    labels.append(Ellipse(at, (2.5, 2.5), 0.0))
    angles = zip(picture.lengths, picture.angles, strict=True)
    words = [f"$l_{i} = {_plain(length)}$, $θ_{i} = {_plain(angle)}°$" for i, (length, angle) in enumerate(angles, 1)]
    scene = Scene((*lines, *labels))
    box = scene.box
    notes = [Label((box.right + 12, box.top + 8 + 12 * row), line, "left") for row, line in enumerate(words)]
    return Scene((*scene.shapes, *notes))


def pendulum(picture: Pendulum) -> Scene:
    """The rod and its weight, the angle from hanging straight down, and the cart if there is one."""
    pivot: Point = (0.0, 0.0)
    weight = _swung(pivot, picture.angle, _ROD)
    shapes: list[Shape] = []
    if picture.cart:
        shapes += [
            rectangle(Box(-22, -7, 22, 7), 0.9),
            Ellipse((-13, 11), (4, 4)),
            Ellipse((13, 11), (4, 4)),
            Path(((-60, 15), (60, 15))),
        ]
    else:
        shapes += [Path(((-18, 0), (18, 0)), width=1.2)]
    shapes.append(Path((pivot, _swung(pivot, 0, _ROD * 0.8)), dashed=True, width=0.4))
    shapes.append(Path((pivot, weight), width=1.8))
    arc = tuple(_swung(pivot, picture.angle * step / 24, 30) for step in range(25))
    shapes.append(Path(arc, width=0.4))
    shapes += [Ellipse(pivot, (2.4, 2.4)), Ellipse(weight, (6, 6), 0.5)]
    shapes.append(Label(_swung(pivot, picture.angle / 2, 39), "$θ$", plate=True))
    box = Scene(tuple(shapes)).box
    shapes.append(Label((box.right + 10, (box.top + box.bottom) / 2), f"$θ = {_plain(picture.angle)}°$", "left"))
    return Scene(tuple(shapes))


def _towards(at: Point, degrees: float, far: float) -> Point:
    """The point that lies so far off in a direction, counted against the clock from the right."""
    return at[0] + far * cos(radians(degrees)), at[1] - far * sin(radians(degrees))


def _swung(at: Point, degrees: float, far: float) -> Point:
    """The same, counted against the clock from straight down."""
    return _towards(at, degrees - 90, far)


def _ground(at: Point) -> tuple[Shape, ...]:
    x, y = at
    ticks = (Path(((x - 10 + 5 * n, y + 8), (x - 13 + 5 * n, y + 12)), width=0.4) for n in range(5))
    return (Path(((x - 12, y + 8), (x + 12, y + 8))), Path(((x - 5, y + 8), (x, y), (x + 5, y + 8))), *ticks)


def _plain(number: float) -> str:
    return f"{round(number, 4):g}".replace("-", "−")
