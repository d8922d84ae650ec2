"""Curves in whole numbers (tenths of a point), so that every machine lays out the same picture.

A curve is quadratic, from an action's dot to the outline of the state that it leads to.
"""

from typing import TypeAlias

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

Ints: TypeAlias = NDArray[np.int64]

#: How finely curves are looked at: to find where they end, and afterwards.
FINE, COARSE = 48, 8
#: How often the last piece of a curve is halved, until its end lies on the outline to a tenth of a point.
_HALVED = 6


class Outline(Struct, frozen=True):
    """The shape that is drawn for a state: an ellipse, or a rectangle, with its half width and half height."""

    wide: int
    high: int
    square: bool = False

    def holds(self, points: Ints, centre: Ints, air: int = 0) -> NDArray[np.bool_]:
        """Which points lie inside, or so near that there is less air than this."""
        apart = np.abs(points - centre)
        a, b = self.wide + air, self.high + air
        if self.square:
            return (apart[..., 0] < a) & (apart[..., 1] < b)
        return apart[..., 0] ** 2 * b * b + apart[..., 1] ** 2 * a * a < a * a * b * b


def bent(starts: Ints, ends: Ints, bends: Ints, outline: Outline) -> tuple[Ints, Ints]:
    """Curves from starts towards the centres of shapes, cut off at the outline.

    Args:
        starts: of shape (n, 2).
        ends: the centres, of shape (n, 2).
        bends: of shape (n,): how far to the side the control point lies, in eighths of the distance.
        outline: the shape.

    Returns:
        Start, control and end of every curve, of shape (n, 3, 2); points along them, of shape (n, 9, 2).
    """
    along = ends - starts
    aside = np.stack([-along[:, 1], along[:, 0]], axis=1)
    controls = (starts + ends) // 2 + aside * bends[:, None] // 8
    inside = outline.holds(_points(starts, controls, ends, FINE), ends[:, None, :])
    cut = np.where(inside.any(axis=1), np.argmax(inside, axis=1), FINE)
    whole = FINE << _HALVED
    outer, inner = np.maximum(cut - 1, 0) << _HALVED, cut << _HALVED
    for _ in range(_HALVED):
        middle = (outer + inner) // 2
        held = outline.holds(_at(starts, controls, ends, middle, whole), ends)
        outer, inner = np.where(held, outer, middle), np.where(held, middle, inner)
    inner = np.maximum(inner, 1)
    tips = _at(starts, controls, ends, inner, whole)
    controls = starts + (controls - starts) * inner[:, None] // whole
    return np.stack([starts, controls, tips], axis=1), _points(starts, controls, tips, COARSE)


def _at(starts: Ints, controls: Ints, ends: Ints, t: Ints, whole: int) -> Ints:
    """The point of each curve at its own ``t``, counted in parts of a whole."""
    t = t[:, None]
    u = whole - t
    return (u * u * starts + 2 * u * t * controls + t * t * ends) // (whole * whole)


def _points(starts: Ints, controls: Ints, ends: Ints, count: int) -> Ints:
    t = np.arange(count + 1, dtype=np.int64)[None, :, None]
    u = count - t
    total = u * u * starts[:, None] + 2 * u * t * controls[:, None] + t * t * ends[:, None]
    return total // (count * count)


def segments(lines: Ints) -> Ints:
    """The straight pieces of lines of shape (n, m, 2), as (n, m − 1, 4)."""
    return np.concatenate([lines[:, :-1], lines[:, 1:]], axis=2)


def crossings(lines: Ints, others: Ints) -> Ints:
    """How many of the other pieces, of shape (k, 4), each line of pieces, (n, m, 4), crosses."""
    if not len(others):
        return np.zeros(len(lines), dtype=np.int64)
    a, b = lines[:, :, None, :2], lines[:, :, None, 2:]
    c, d = others[None, None, :, :2], others[None, None, :, 2:]
    met = (_left(a, b, c) ^ _left(a, b, d)) & (_left(c, d, a) ^ _left(c, d, b))
    return met.sum(axis=(1, 2), dtype=np.int64)


def _left(a: Ints, b: Ints, c: Ints) -> NDArray[np.bool_]:
    """Whether c lies to the left of the line from a to b."""
    return (b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1]) > (b[..., 1] - a[..., 1]) * (c[..., 0] - a[..., 0])


def overlapping(boxes: Ints, others: Ints) -> NDArray[np.bool_]:
    """Which boxes (left, top, right, bottom) have points in common: shape (n, k)."""
    one, two = boxes[:, None], others[None]
    return (
        (one[..., 0] < two[..., 2])
        & (two[..., 0] < one[..., 2])
        & (one[..., 1] < two[..., 3])
        & (two[..., 1] < one[..., 3])
    )


def boxes_around(centres: Ints, size: tuple[int, int]) -> Ints:
    """Boxes of one size with these centres."""
    half = np.array([size[0] // 2, size[1] // 2], dtype=np.int64)
    return np.concatenate([centres - half, centres + half], axis=-1)
