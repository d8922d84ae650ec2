"""Curves in whole numbers (tenths of a point), so that every machine lays out the same picture.

A curve is quadratic, from an action's dot to the rim of the state that it leads to.
"""

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Ints: TypeAlias = NDArray[np.int64]

#: How finely curves are looked at: to find the rim, and afterwards.
FINE, COARSE = 48, 8


def bent(starts: Ints, ends: Ints, bends: Ints, rim: tuple[int, int]) -> tuple[Ints, Ints]:
    """Curves from starts towards the centres of ellipses, cut off at the rim.

    Args:
        starts: of shape (n, 2).
        ends: the centres, of shape (n, 2).
        bends: of shape (n,): how far to the side the control point lies, in eighths of the distance.
        rim: the ellipse's half axes.

    Returns:
        Start, control and end of every curve, of shape (n, 3, 2); points along them, of shape (n, 9, 2).
    """
    along = ends - starts
    aside = np.stack([-along[:, 1], along[:, 0]], axis=1)
    controls = (starts + ends) // 2 + aside * bends[:, None] // 8
    fine = _points(starts, controls, ends, FINE)
    inside = within(fine, ends[:, None, :], rim)
    cut = np.where(inside.any(axis=1), np.argmax(inside, axis=1), FINE)
    cut = np.maximum(cut, 1)
    tips = fine[np.arange(len(starts)), cut]
    controls = starts + (controls - starts) * cut[:, None] // FINE
    return np.stack([starts, controls, tips], axis=1), _points(starts, controls, tips, COARSE)


def _points(starts: Ints, controls: Ints, ends: Ints, count: int) -> Ints:
    t = np.arange(count + 1, dtype=np.int64)[None, :, None]
    u = count - t
    total = u * u * starts[:, None] + 2 * u * t * controls[:, None] + t * t * ends[:, None]
    return total // (count * count)


def within(points: Ints, centre: Ints, axes: tuple[int, int]) -> NDArray[np.bool_]:
    """Which points lie in an ellipse."""
    apart = points - centre
    a, b = axes
    return apart[..., 0] ** 2 * b * b + apart[..., 1] ** 2 * a * a < a * a * b * b


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
