"""Arms and pendulums as scenes."""

from bisect import bisect_left, bisect_right
from collections.abc import Iterable
from itertools import pairwise
from math import asin, ceil, copysign, cos, degrees, dist, radians, sin

from msgspec import Struct

from rldrill.problems.pictures import Arm, Pendulum
from rldrill.render.pictures.scene import (
    Bounds,
    Caption,
    Ellipse,
    Path,
    Point,
    Scene,
    Shape,
    caption_bounds,
    rectangle,
)

_REACH = 120.0
_ROD = 44.0
#: How wide a link is drawn, the radius of a joint's arc, and how far beside the link before one folded back lies.
_LINK, _ARC, _FOLD = 2.2, 17.0, 6.0
#: How much worse it is to cover a link than a thin line.
_HEAVY = 3
#: How far apart the points of a line are that are tested for a label lying on them; and how many it is worth
#: not to lie on another label or a joint.
_STEP, _OVER = 1.5, 60
#: How far a label stands from the joints of others, and how many points that is worth.
_APART, _NEAR = 5.0, 15


class _Wanted(Struct, frozen=True):
    """A label, its joint or the two of its link, and where it may stand."""

    words: str
    joints: tuple[int, ...]
    places: list[Point]


def arm(picture: Arm) -> Scene:
    """The links from joint to joint; each angle is measured from the dashed line on."""
    scale = _REACH / sum(picture.lengths)
    at: Point = (0.0, 0.0)
    heading = picture.turned
    lines: list[Path] = []
    joints: list[Ellipse] = []
    wanted: list[_Wanted] = []
    if heading:
        lines.append(Path((at, _towards(at, 0.0, 44)), dashed=True, width=0.4))
        lines.append(Path((at, _towards(at, heading, 44)), dashed=True, width=0.4))
        lines.append(_arc(at, 0.0, heading, 38))
        wanted += [
            _Wanted("$x$", (0,), [_towards(at, side, far) for far in (50, 54) for side in (0.0, -8.0, 8.0)]),
            _Wanted(
                "$x_0$", (0,), [_towards(at, heading + side, far) for far in (50, 54) for side in (0.0, 8.0, -8.0)]
            ),
            _Wanted(
                "$φ_0$", (0,), [_towards(at, heading * share, far) for far in (47, 30) for share in (0.5, 0.3, 0.7)]
            ),
        ]
    for index, (length, angle) in enumerate(zip(picture.lengths, picture.angles, strict=True), 1):
        start, end = _from_joint(at, heading, angle) if index > 1 else (at, angle)
        if angle:
            lines.append(Path((at, _towards(at, heading, 30)), dashed=True, width=0.4))
            lines.append(_arc(at, heading, end, _ARC))
        wanted.append(_Wanted(f"$θ_{index}$", (index - 1,), list(_beside_arc(at, heading, angle))))
        heading += angle
        after = _towards(start, heading, length * scale)
        lines.append(Path((start, after) if start == at else (at, start, after), width=_LINK))
        wanted.append(_Wanted(f"$l_{index}$", (index - 1, index), list(_beside_link(start, heading, length * scale))))
        joints.append(Ellipse(at, (3, 3)))
        at = after
    joints.append(Ellipse(at, (2.5, 2.5), 0.0))
    lines = [*_free_ground(lines), *lines]
    return Scene((*lines, *joints, *_placed(wanted, lines, joints)))


def _from_joint(joint: Point, heading: float, angle: float) -> tuple[Point, float]:
    """Where the next link begins, and how far its arc reaches.

    A link that is folded back lies beside the one before, always on the same side of their line.
    """
    if angle % 360 != 180:
        return joint, angle
    side = heading % 180 + 90
    turn = degrees(asin(_FOLD / _ARC)) * (1 if (side - heading) % 360 < 180 else -1)
    return _towards(joint, side, _FOLD), angle - turn


def _arc(joint: Point, heading: float, angle: float, radius: float) -> Path:
    """The arc of an angle from a heading on."""
    return Path(tuple(_towards(joint, heading + angle * step / 12, radius) for step in range(13)), width=0.4)


def _beside_arc(joint: Point, heading: float, angle: float) -> Iterable[Point]:
    """Where the label of a joint's angle may stand: outside its arc, or anywhere near a joint that is straight."""
    if not angle:
        return (_towards(joint, heading + side, 12) for side in (-90, 90, -60, 60, -120, 120))
    headings = [heading + angle * share for share in (0.5, 0.3, 0.7, 0.15, 0.85)]
    outside = [_towards(joint, each, far) for far in (26, 33, 40) for each in headings]
    return [*outside, _towards(joint, heading - copysign(28, angle), 24)]  # at last, where the arc begins


def _beside_link(joint: Point, heading: float, length: float) -> Iterable[Point]:
    """Where the label of a link may stand: on either side, near its middle if that can be."""
    middles = (_towards(joint, heading, length * share) for share in (0.55, 0.4, 0.7, 0.25, 0.85))
    return (_towards(middle, heading + side, 8) for middle in middles for side in (90, -90))


def _placed(wanted: list[_Wanted], lines: list[Path], joints: list[Ellipse]) -> list[Caption]:
    """The labels, one after the other where they cover least; the first place wins if that is no worse."""
    taken = _inked(lines)
    across = [x for x, _ in taken]
    labels: list[Caption] = []
    for each in wanted:
        solid = [*map(caption_bounds, labels), *(_around(joint, 0) for joint in joints)]
        others = [_around(joint, _APART) for number, joint in enumerate(joints) if number not in each.joints]

        def covered(
            at: Point, words: str = each.words, solid: list[Bounds] = solid, others: list[Bounds] = others
        ) -> int:
            box = caption_bounds(Caption(at, words))
            near = taken[bisect_right(across, box.left) : bisect_left(across, box.right)]
            lines = sum(box.top < y < box.bottom for _, y in near)
            return lines + _OVER * sum(map(box.overlaps, solid)) + _NEAR * sum(map(box.overlaps, others))

        labels.append(Caption(min(each.places, key=covered), each.words, plate=True))
    return labels


def _around(joint: Ellipse, air: float) -> Bounds:
    (x, y), far = joint.centre, joint.radii[0] + air
    return Bounds(x - far, y - far, x + far, y + far)


def _inked(lines: list[Path]) -> list[Point]:
    """Points of lines from left to right, those of links more than once."""
    often = ((line, range(_HEAVY if line.width == _LINK else 1)) for line in lines)
    return sorted(p for line, times in often for ends in pairwise(line.points) for p in _along(*ends) for _ in times)


def _along(start: Point, end: Point) -> Iterable[Point]:
    count = max(1, ceil(dist(start, end) / _STEP))
    shares = (step / count for step in range(count + 1))
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
    radius = 29 if picture.cart else 22  # outside of the cart and its wheels
    arc = tuple(_swung(pivot, picture.angle * step / 24, radius) for step in range(25))
    shapes.append(Path(arc, width=0.4))
    shapes += [Ellipse(pivot, (2.4, 2.4)), Ellipse(weight, (6, 6), 0.5)]
    shapes.append(Caption(_swung(pivot, picture.angle / 2, radius + 8), "$θ$", plate=True))
    return Scene(tuple(shapes))


def _towards(at: Point, degrees: float, far: float) -> Point:
    """The point that lies so far off in a direction, counted against the clock from the right."""
    return at[0] + far * cos(radians(degrees)), at[1] - far * sin(radians(degrees))


def _swung(at: Point, degrees: float, far: float) -> Point:
    """The same, counted against the clock from straight down."""
    return _towards(at, degrees - 90, far)


def _free_ground(lines: list[Path]) -> tuple[Path, ...]:
    """The base below the first joint; or else on its left, above it or on its right, where least runs through it."""
    inked = _inked(lines)

    def covered(ground: tuple[Path, ...]) -> int:
        box = Scene(ground[:1] + ground[2:]).box  # without the triangle, where the joint is
        left, top, right, bottom = box.left - _STEP, box.top - _STEP, box.right + _STEP, box.bottom + _STEP
        return sum(left < x < right and top < y < bottom for x, y in inked)

    return min((_ground(way) for way in (270, 180, 90, 0)), key=covered)


def _ground(way: float) -> tuple[Path, ...]:
    """The base of an arm whose first joint is at the origin, in a direction of it."""

    def point(aside: float, far: float) -> Point:
        return _towards(_towards((0.0, 0.0), way, far), way + 90, aside)

    ticks = (Path((point(5 * n - 10, 8), point(5 * n - 13, 12)), width=0.4) for n in range(5))
    return (
        Path((point(-12, 8), point(12, 8))),
        Path((point(-5, 8), (0.0, 0.0), point(5, 8))),
        *ticks,
    )
