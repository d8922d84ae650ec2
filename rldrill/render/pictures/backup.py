"""Backup diagrams as Sutton & Barto draw them."""

from rldrill.problems.pictures import Branch, Node
from rldrill.render.pictures.scene import (
    SIZE,
    Bounds,
    Caption,
    Curve,
    Ellipse,
    Path,
    Point,
    Scene,
    Shape,
    rectangle,
    text_width,
)

_RADII = {"state": 5.0, "action": 3.0, "end": 4.5}
_STEP = 30.0  # from one level down to the next
_GAP = 10.0  # between what hangs side by side
_LEAST = 18.0
_BESIDE = 20.0  # between two diagrams
_SHARE = 0.62  # where labels stand along a branch
_ARC = 0.48  # where the arc crosses the branches


def scene(root: Node, title: str) -> Scene:
    """A backup diagram, its root above, and over it the title, which it has where another stands beside it."""
    lines: list[Shape] = []
    nodes: list[Shape] = []
    _draw(root, (0.0, 0.0), lines, nodes, root=True)
    drawn = Scene((*lines, *nodes))
    if not title:
        return drawn
    box = drawn.box
    return Scene((*drawn.shapes, Caption(((box.left + box.right) / 2, box.top - 7), title, "above")), air=_BESIDE)


def _draw(node: Node, at: Point, lines: list[Shape], nodes: list[Shape], *, root: bool = False) -> None:
    x, y = at
    ends = []
    for branch, across in zip(node.branches, _places(node), strict=True):
        end = (x + across, y + _drop(node))
        ends.append(end)
        lines.append(Path((at, end), dashed=node.dots))
        if branch.label:
            nodes.append(_beside(branch, at, end))
        _draw(branch.node, end, lines, nodes)
    if node.maximum and len(ends) > 1:
        lines.append(_arc(at, ends[0], ends[-1]))
    nodes.append(_mark(node, at))
    if node.label:
        radius = _RADII[node.kind]
        if node.branches:
            nodes.append(Caption((x + radius + 3, y - (2 if root else 0)), node.label, "left"))
        else:
            nodes.append(Caption((x, y + radius + 3), node.label, "below"))


def _mark(node: Node, at: Point) -> Shape:
    (x, y), radius = at, _RADII[node.kind]
    if node.kind == "end":
        return rectangle(Bounds(x - radius, y - radius, x + radius, y + radius), 0.85)
    return Ellipse(at, (radius, radius), 1.0 if node.kind == "state" else 0.0)


def _beside(branch: Branch, start: Point, end: Point) -> Caption:
    """What stands beside a branch: outside of it, so that neighbours' labels lie apart."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    x, y = start[0] + _SHARE * dx, start[1] + _SHARE * dy
    # A slanting line comes closer to one corner of the label than to its middle.
    clear = 3 + abs(dx / dy) * SIZE * 0.5
    if dx >= 0:
        return Caption((x + clear, y), branch.label, "left", plate=True)
    return Caption((x - clear, y), branch.label, "right", plate=True)


def _arc(top: Point, left: Point, right: Point) -> Curve:
    first = (top[0] + _ARC * (left[0] - top[0]), top[1] + _ARC * (left[1] - top[1]))
    last = (top[0] + _ARC * (right[0] - top[0]), top[1] + _ARC * (right[1] - top[1]))
    bow = min(8.0, 0.2 * (last[0] - first[0]) + 1)
    return Curve(first, (top[0], first[1] + 2 * bow), last)


def _drop(node: Node) -> float:
    """How far down the next level is: farther where branches are spread wide."""
    places = _places(node)
    spread = max(abs(place) for place in places) if places else 0.0
    return max(_STEP, 0.55 * spread)


def _places(node: Node) -> list[float]:
    """Where the branches end, left and right of the node."""
    extents = _extents(node)
    at = 0.0
    places = []
    for left, right in extents:
        places.append(at + left)
        at += left + right + _GAP
    middle = (places[0] + places[-1]) / 2 if places else 0.0
    return [place - middle for place in places]


def _extents(node: Node) -> list[tuple[float, float]]:
    """How much room every branch takes with all below it, left and right of where it ends."""
    count = len(node.branches)
    return [_extent(branch, left=2 * index < count - 1) for index, branch in enumerate(node.branches)]


def _extent(branch: Branch, *, left: bool) -> tuple[float, float]:
    node = branch.node
    if node.branches:
        sides = list(zip(_places(node), _extents(node), strict=True))
        before = max(-place + side[0] for place, side in sides)
        after = max(place + side[1] for place, side in sides)
        after = max(after, _RADII[node.kind] + 5 + text_width(node.label) if node.label else 0)
    else:
        before = after = max(_LEAST, text_width(node.label)) / 2
    if branch.label:  # it stands outside of the branch
        beside = text_width(branch.label) + 4
        before, after = (max(before, beside), after) if left else (before, max(after, beside))
    return before, after
