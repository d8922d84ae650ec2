"""Grids, bars and bumps as scenes."""

from math import exp

from rldrill.problems.pictures import Bars, Bumps, GridPicture
from rldrill.render.pictures.scene import SIZE, Bounds, Caption, Ellipse, Path, Scene, Shape, rectangle, text_width

_GREYS = (0.82, 0.35, 0.6, 0.1)
_CELL = 22.0
_TALL = 48.0
_AXIS = 240.0
_ROW = 1.2 * SIZE


def grid(picture: GridPicture) -> Scene:
    """A grid world: walls are dark."""
    widest = max(text_width(cell) for row in picture.rows for cell in row)
    side = max(_CELL, widest + 6)
    shapes: list[Shape] = []
    for down, row in enumerate(picture.rows):
        for across, cell in enumerate(row):
            x, y = across * side, down * _CELL
            shapes.append(rectangle(Bounds(x, y, x + side, y + _CELL), 0.35 if cell == "#" else 1.0))
            if cell not in ("", "#"):
                shapes.append(Caption((x + side / 2, y + _CELL / 2), cell))
    return Scene(tuple(shapes))


def bars(picture: Bars) -> Scene:
    """Bars in groups, one group for every name; what series a grey is stands above."""
    count = len(picture.series)
    wide = max(16.0, *(text_width(label) + 4 for row in picture.labels for label in row))
    group = max(count * wide, *(text_width(name) for name in picture.names)) + 12
    shapes: list[Shape] = []
    for index, name in enumerate(picture.names):
        middle = (index + 0.5) * group
        for row in range(count):
            left = middle + (row - count / 2) * wide
            share = picture.shares[row][index]
            shapes.append(rectangle(Bounds(left + 2, -_TALL * share, left + wide - 2, 0), _GREYS[row % len(_GREYS)]))
            shapes.append(Caption((left + wide / 2, -_TALL * share - 2), picture.labels[row][index], "above"))
        shapes.append(Caption((middle, 4), name, "below"))
    shapes.append(Path(((0, 0), (len(picture.names) * group, 0))))
    at = 0.0
    highest = max(share for row in picture.shares for share in row)
    for row, series in enumerate(picture.series):
        if series:
            top = -_TALL * highest - 22
            shapes.append(rectangle(Bounds(at, top, at + 8, top + 8), _GREYS[row % len(_GREYS)]))
            shapes.append(Caption((at + 11, top + 4), series, "left"))
            at += 11 + text_width(series) + 12
    return Scene(tuple(shapes))


def bumps(picture: Bumps) -> Scene:
    """The functions over the axis, and the state as a dashed line with a dot on it."""
    reach = picture.width * (2.6 if picture.shape == "gaussian" else 1.0)
    low = min(*picture.centres, picture.state) - reach
    high = max(*picture.centres, picture.state) + reach
    scale = _AXIS / (high - low)

    def across(value: float) -> float:
        return (value - low) * scale

    shapes: list[Shape] = [Path(((0, 0), (_AXIS, 0)))]
    for centre in picture.centres:
        near = [centre + reach * step / 24 for step in range(-24, 25)]
        shapes.append(Path(tuple((across(x), -_TALL * bump(picture, centre, x)) for x in near), width=0.8))
        shapes.append(Path(((across(centre), 0), (across(centre), 3))))
    at = across(picture.state)
    shapes.append(Path(((at, 0), (at, -_TALL)), dashed=True))
    shapes.append(Ellipse((at, 0), (2.2, 2.2), 0.0))
    places = [across(centre) for centre in picture.centres]
    above = [(x, f"$φ_{{{index}}}$") for index, x in enumerate(places, 1)]
    below = [(x, f"${_plain(centre)}$") for x, centre in zip(places, picture.centres, strict=True)]
    shapes += [Caption((x, -_TALL - 4 - row * _ROW), label, "above") for x, label, row in _rows(above)]
    shapes += [Caption((x, 5 + row * _ROW), label, "below") for x, label, row in _rows(below)]
    lowest = max(row for *_, row in _rows(below)) + 1
    shapes.append(Caption((at, 5 + lowest * _ROW), f"$s = {_plain(picture.state)}$", "below"))
    return Scene(tuple(shapes))


def _rows(labels: list[tuple[float, str]]) -> list[tuple[float, str, int]]:
    """Labels from left to right, each in the first row where it does not run into the one before."""
    edges: list[float] = []
    found = []
    for x, label in sorted(labels):
        half = text_width(label) / 2
        row = next((row for row, edge in enumerate(edges) if x - half >= edge), len(edges))
        edges[row : row + 1] = [x + half + 2]
        found.append((x, label, row))
    return found


def bump(picture: Bumps, centre: float, x: float) -> float:
    """The value of one function."""
    distance = abs(x - centre)
    if picture.shape == "tent":
        return max(0.0, 1 - distance / picture.width)
    return exp(-(distance**2) / (2 * picture.width**2))


def _plain(number: float) -> str:
    return f"{number:g}".replace("-", "−")
