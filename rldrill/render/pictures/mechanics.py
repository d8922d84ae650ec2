"""Arms and pendulums as scenes."""

from bisect import bisect_left, bisect_right
from collections.abc import Iterable
from itertools import pairwise
from math import cos, radians, sin

from rldrill.problems.pictures import Arm, Pendulum
from rldrill.render.pictures.scene import Bounds, Caption, Ellipse, Path, Point, Scene, Shape, caption_bounds, rectangle

_REACH = 120.0
_ROD = 44.0
#: Points of a line that are tested for a label lying on them.
_SAMPLES = 24


def arm(picture: Arm) -> Scene:
    """The links from joint to joint; each angle is measured from the dashed line on."""
    scale = _REACH / sum(picture.lengths)
    at: Point = (0.0, 0.0)
    heading = picture.turned
    lines: list[Path] = [*_ground(at)]
    joints: list[Shape] = []
    wanted: list[tuple[str, list[Point]]] = []
    if heading:
        lines.append(Path((at, _towards(at, 0.0, 44)), dashed=True, width=0.4))
        lines.append(Path((at, _towards(at, heading, 44)), dashed=True, width=0.4))
        lines.append(_arc(at, 0.0, heading, 38))
        wanted += [
            ("$x$", [_towards(at, side, far) for far in (50, 54) for side in (0.0, -8.0, 8.0)]),
            ("$x_0$", [_towards(at, heading + side, far) for far in (50, 54) for side in (0.0, 8.0, -8.0)]),
            ("$φ_0$", [_towards(at, heading * share, far) for far in (47, 30) for share in (0.5, 0.3, 0.7)]),
        ]
    for index, (length, angle) in enumerate(zip(picture.lengths, picture.angles, strict=True), 1):
        if angle:
            lines.append(Path((at, _towards(at, heading, 30)), dashed=True, width=0.4))
            lines.append(_arc(at, heading, angle, 17))
        wanted.append((f"$θ_{index}$", list(_beside_arc(at, heading, angle))))
        heading += angle
        after = _towards(at, heading, length * scale)
        lines.append(Path((at, after), width=2.2))
        wanted.append((f"$l_{index}$", list(_beside_link(at, heading, length * scale))))
        joints.append(Ellipse(at, (3, 3)))
        at = after
    return Scene((*lines, *joints, Ellipse(at, (2.5, 2.5), 0.0), *_placed(wanted, lines)))


def _arc(joint: Point, heading: float, angle: float, radius: float) -> Path:
    """The arc of an angle from a heading on."""
    return Path(tuple(_towards(joint, heading + angle * step / 12, radius) for step in range(13)), width=0.4)


def _beside_arc(joint: Point, heading: float, angle: float) -> Iterable[Point]:
    """Where the label of a joint's angle may stand: outside its arc, or anywhere near a joint that is straight."""
    if not angle:
        return (_towards(joint, heading + side, 12) for side in (-90, 90, -60, 60, -120, 120))
    return (_towards(joint, heading + angle * share, far) for far in (26, 33) for share in (0.5, 0.3, 0.7, 0.15, 0.85))


def _beside_link(joint: Point, heading: float, length: float) -> Iterable[Point]:
    """Where the label of a link may stand: on either side, near its middle if that can be."""
    middles = (_towards(joint, heading, length * share) for share in (0.55, 0.4, 0.7, 0.25, 0.85))
    return (_towards(middle, heading + side, 8) for middle in middles for side in (90, -90))


def _placed(wanted: list[tuple[str, list[Point]]], lines: list[Path]) -> list[Caption]:
    """The labels, one after the other where they cover least; the first place wins if that is no worse."""
    taken = sorted(point for line in lines for ends in pairwise(line.points) for point in _along(*ends))
    across = [x for x, _ in taken]
    labels: list[Caption] = []
    for words, places in wanted:
        boxes = [caption_bounds(label) for label in labels]

        def covered(at: Point, words: str = words, boxes: list[Bounds] = boxes) -> int:
            box = caption_bounds(Caption(at, words))
            near = taken[bisect_right(across, box.left) : bisect_left(across, box.right)]
            return sum(box.top < y < box.bottom for _, y in near) + _SAMPLES * sum(map(box.overlaps, boxes))

        labels.append(Caption(min(places, key=covered), words, plate=True))
    return labels


def _along(start: Point, end: Point) -> Iterable[Point]:
    shares = (step / _SAMPLES for step in range(_SAMPLES + 1))
    return ((start[0] + (end[0] - start[0]) * share, start[1] + (end[1] - start[1]) * share) for share in shares)


def pendulum(picture: Pendulum) -> Scene:
    """The rod and its weight, the angle from hanging straight down, and the cart if there is one."""
    pivot: Point = (0.0, 0.0)
    weight = _swung(pivot, picture.angle, _ROD)
    shapes: list[Shape] = []
    if picture.cart:
        shapes += [
            rectangle(Bounds(-22, -7, 22, 7), 0.9),
            Ellipse((-13, 11), (4, 4)),
            Ellipse((13, 11), (4, 4)),
            Path(((-60, 15), (60, 15))),
        ]
    else:
        shapes += [Path(((-18, 0), (18, 0)), width=1.2)]
    shapes.append(Path((pivot, _swung(pivot, 0, _ROD * 0.8)), dashed=True, width=0.4))
    shapes.append(Path((pivot, weight), width=1.8))
    arc = tuple(_swung(pivot, picture.angle * step / 24, 22) for step in range(25))
    shapes.append(Path(arc, width=0.4))
    shapes += [Ellipse(pivot, (2.4, 2.4)), Ellipse(weight, (6, 6), 0.5)]
    shapes.append(Caption(_swung(pivot, picture.angle / 2, 30), "$θ$", plate=True))
    return Scene(tuple(shapes))


def _towards(at: Point, degrees: float, far: float) -> Point:
    """The point that lies so far off in a direction, counted against the clock from the right."""
    return at[0] + far * cos(radians(degrees)), at[1] - far * sin(radians(degrees))


def _swung(at: Point, degrees: float, far: float) -> Point:
    """The same, counted against the clock from straight down."""
    return _towards(at, degrees - 90, far)


def _ground(at: Point) -> tuple[Path, ...]:
    x, y = at
    ticks = (Path(((x - 10 + 5 * n, y + 8), (x - 13 + 5 * n, y + 12)), width=0.4) for n in range(5))
    return (Path(((x - 12, y + 8), (x + 12, y + 8))), Path(((x - 5, y + 8), (x, y), (x + 5, y + 8))), *ticks)
