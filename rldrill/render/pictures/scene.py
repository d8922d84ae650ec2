"""Scenes: what a vector picture is made of, in points, with y pointing down."""

from typing import Literal, TypeAlias

from msgspec import Struct

from rldrill.render.mathematics.unicode import inline

Point: TypeAlias = tuple[float, float]

#: The size of the type in pictures.
SIZE = 8.0
#: How wide lines are, and how long the head of an arrow is.
LINE, _HEAD = 0.6, 5.0
#: Widths of signs in parts of the type's size, on the generous side.
_NARROW, _NORMAL, _WIDE = 0.36, 0.55, 0.85
_NARROW_SIGNS = frozenset("iljft.,;:'′!|()[] /₀₁₂₃₄₅₆₇₈₉ₐₜ")
_WIDE_SIGNS = frozenset("mwMW−+=<>←→")


class Path(Struct, frozen=True):
    """Straight lines from point to point; closed, it is a polygon. Fills are grey levels, 0 black to 1 white."""

    points: tuple[Point, ...]
    closed: bool = False
    fill: float | None = None
    width: float = LINE
    dashed: bool = False


class Curve(Struct, frozen=True):
    """A quadratic Bézier curve."""

    start: Point
    control: Point
    end: Point


class Ellipse(Struct, frozen=True):
    """An ellipse, or a circle."""

    centre: Point
    radii: Point
    fill: float = 1.0


class Caption(Struct, frozen=True):
    """A text: ``at`` is where its anchor lies; ``plate`` puts it on a white ground."""

    at: Point
    text: str
    anchor: Literal["centre", "left", "right", "below", "above"] = "centre"
    plate: bool = False


Shape: TypeAlias = Path | Curve | Ellipse | Caption


class Bounds(Struct, frozen=True):
    """A rectangle with its sides parallel to the axes."""

    left: float
    top: float
    right: float
    bottom: float

    def overlaps(self, other: "Bounds") -> bool:
        """Whether the two have points inside in common."""
        return (
            self.left < other.right and other.left < self.right and self.top < other.bottom and other.top < self.bottom
        )


class Scene(Struct, frozen=True):
    """Shapes, later ones over earlier ones; ``air`` is what is left free on the right, for what stands beside it."""

    shapes: tuple[Shape, ...]
    air: float = 0.0

    @property
    def box(self) -> Bounds:
        """The smallest rectangle around everything, and the air beside it."""
        boxes = [bounds_of(shape) for shape in self.shapes]
        return Bounds(
            min(box.left for box in boxes),
            min(box.top for box in boxes),
            max(box.right for box in boxes) + self.air,
            max(box.bottom for box in boxes),
        )


def text_width(text: str) -> float:
    """About how wide a text is when typeset, never less."""
    return sum(map(_sign_width, inline(text))) * SIZE


def _sign_width(sign: str) -> float:
    if sign in _NARROW_SIGNS:
        return _NARROW
    return _WIDE if sign in _WIDE_SIGNS or sign.isupper() else _NORMAL


def bounds_of(shape: Shape) -> Bounds:
    """The rectangle that a shape fills; of curves the one around their control points."""
    match shape:
        case Path(points):
            return _around(points)
        case Curve(start, control, end):
            return _around((start, ((start[0] + 2 * control[0] + end[0]) / 4, (start[1] + 2 * control[1] + end[1]) / 4),
                            end))  # fmt: skip
        case Ellipse((x, y), (across, down)):
            return Bounds(x - across, y - down, x + across, y + down)
        case Caption():
            return caption_bounds(shape)


def caption_bounds(label: Caption) -> Bounds:
    """The room that a label takes, with the air around it."""
    (x, y), wide, high = label.at, text_width(label.text) + 2, SIZE * 1.15
    across, down = SHARES[label.anchor]
    return Bounds(x - across * wide, y - down * high, x + (1 - across) * wide, y + (1 - down) * high)


#: How much of a label lies left of its anchor, and above it.
SHARES = {"centre": (0.5, 0.5), "left": (0.0, 0.5), "right": (1.0, 0.5), "below": (0.5, 0.0), "above": (0.5, 1.0)}


def _around(points: tuple[Point, ...]) -> Bounds:
    across, down = [x for x, _ in points], [y for _, y in points]
    return Bounds(min(across), min(down), max(across), max(down))


def rectangle(box: Bounds, fill: float) -> Path:
    """A rectangle of a grey."""
    corners = ((box.left, box.top), (box.right, box.top), (box.right, box.bottom), (box.left, box.bottom))
    return Path(corners, closed=True, fill=fill)


def arrowhead(before: Point, tip: Point) -> Path:
    """The head of an arrow that comes from ``before``."""
    dx, dy = tip[0] - before[0], tip[1] - before[1]
    long = (dx * dx + dy * dy) ** 0.5 or 1.0
    dx, dy = dx / long * _HEAD, dy / long * _HEAD
    foot = tip[0] - dx, tip[1] - dy
    wing = -dy * 0.34, dx * 0.34
    return Path(
        (tip, (foot[0] + wing[0], foot[1] + wing[1]), (foot[0] - wing[0], foot[1] - wing[1])),
        closed=True,
        fill=0.0,
        width=0.2,
    )
