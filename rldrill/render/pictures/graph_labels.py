"""Where the labels of a state diagram lie: over nothing else, and near what they belong to."""

from collections.abc import Iterator
from itertools import pairwise
from math import isqrt

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from rldrill.render.pictures.curves import COARSE, Ints, boxes_around, overlapping
from rldrill.render.pictures.graph_search import GAP, HARD, Action, Drawing, States, label_size

_COVERED_LINE = 400
_OTHERS_DOT = 300  # another dot is nearer, or nearly so
_ONE_WORD = 250  # two labels side by side without a gap
_ASIDE = 120
_FAR = 70
_ROUNDS = 6
_DOT, _AIR = 30, 12
_CLEAR = 8  # between a label and another's line
_BESIDE = 70  # a dot so near seems to belong to a label
_HEAD = 55
_WIDEST, _HIGHEST = 2500, 1700  # a picture that is larger costs: a table stands beside it
_MUDDLED = 2500
_SHOWN = 50  # per cent of a short curve that its label may hide


class _Label(Struct, frozen=True):
    """A label with the places where it may lie: boxes, and what each costs by itself."""

    text: str
    boxes: Ints
    costs: Ints
    dot: int
    line: int | None = None  # the curve that it stands on or beside


def placed(drawing: Drawing, states: States, actions: tuple[Action, ...]) -> Drawing:
    """The drawing with its labels; it costs ``HARD`` and more if some lie over each other or over a node."""
    labels = list(_labels(drawing, actions))
    boxes = np.concatenate([label.boxes for label in labels])
    whose = np.repeat(np.arange(len(labels)), [len(label.boxes) for label in labels])
    costs = np.concatenate([label.costs for label in labels])
    dots = boxes_around(np.stack(drawing.dots), (2 * _DOT, 2 * _DOT))
    costs = costs + _covered(drawing, np.concatenate([states.boxes, dots]), boxes)
    costs = costs + _lines_covered(drawing, labels, boxes, whose) * _COVERED_LINE
    costs = costs + _others_nearer(np.stack(drawing.dots), labels, boxes, whose) * _OTHERS_DOT
    picked, each = _picked(costs, _crowded(boxes, whose), whose)
    middles = (boxes[picked, :2] + boxes[picked, 2:]) // 2
    everything = np.concatenate([states.boxes, dots, boxes[picked]])
    size = everything[:, 2:].max(axis=0) - everything[:, :2].min(axis=0)
    room = (int(max(0, size[0] - _WIDEST)) + int(max(0, size[1] - _HIGHEST))) * 8
    texts = [label.text for label in labels]
    muddled = bool((each >= _ONE_WORD).any())
    cost = drawing.cost + int(each.sum()) + room + muddled * _MUDDLED
    return replace(drawing, cost=cost, labels=list(zip(middles, texts, strict=True)), muddled=muddled)


def _labels(drawing: Drawing, actions: tuple[Action, ...]) -> Iterator[_Label]:
    line = 0
    for number, action in enumerate(actions):
        for text in action.labels:
            yield _on_curve(drawing.lines[line], text, number, line)
            line += 1
        yield _around_dot(drawing.dots[number], action.name, number)


def _on_curve(line: Ints, text: str, dot: int, owner: int) -> _Label:
    """A label on its curve, in the middle if that can be, or touching it on either side."""
    wide, high = label_size(text)
    middles, costs = [], []
    for step, cost in ((4, 0), (3, 25), (5, 30), (2, 90), (6, 90)):
        at = step * COARSE // 8
        along = line[at + 1] - line[at - 1]
        aside = _clear_of(np.array([-along[1], along[0]]), wide // 2 + 10, high // 2 + 10)
        middles += [line[at], line[at] + aside, line[at] - aside]
        costs += [cost, cost + _ASIDE, cost + _ASIDE]
    boxes = boxes_around(np.stack(middles), (wide, high))
    hidden = _points_in(boxes, line)
    on = np.arange(len(boxes)) % 3 == 0
    too_much = np.where(on, np.maximum(0, hidden - _SHOWN) * 6, (hidden > 0) * _COVERED_LINE)
    return _Label(text, boxes, np.array(costs, dtype=np.int64) + too_much, dot, owner)


def _clear_of(normal: Ints, wide: int, high: int) -> Ints:
    """How far along a line's normal the middle of a box must be moved from it, that they touch no more."""
    x, y = map(int, normal)
    length = max(1, isqrt(x * x + y * y))
    far = (wide * abs(x) + high * abs(y)) // length
    return np.array([x * far // length, y * far // length], dtype=np.int64)


def _points_in(boxes: Ints, line: Ints) -> Ints:
    """How many per cent of a line lie in each box."""
    points = _samples(line)
    share: Ints = overlapping(boxes, np.concatenate([points, points], axis=1)).sum(axis=1) * 100 // len(points)
    return share


def _samples(line: Ints) -> Ints:
    """Points along a line, close enough together that no label slips between them."""
    t = np.arange(9, dtype=np.int64)[None, :, None]
    return ((line[:-1, None] * (8 - t) + line[1:, None] * t) // 8).reshape(-1, 2)


def _around_dot(dot: Ints, text: str, number: int) -> _Label:
    """The name of an action around its dot, close to it if that can be."""
    wide, high = label_size(text)
    ways = []
    for far in (0, 45):
        side, up = wide // 2 + 48 + far, high // 2 + 45 + far
        ways += [(0, -up), (0, up), (side, 0), (-side, 0), (side, -up * 2 // 3), (-side, -up * 2 // 3),
                 (side, up * 2 // 3), (-side, up * 2 // 3), (side * 2 // 3, -up), (-side * 2 // 3, -up),
                 (side * 2 // 3, up), (-side * 2 // 3, up)]  # fmt: skip
    costs = np.arange(len(ways), dtype=np.int64) * 4
    costs[len(ways) // 2 :] += _FAR
    return _Label(text, boxes_around(dot + np.array(ways, dtype=np.int64), (wide, high)), costs, number)


def _covered(drawing: Drawing, nodes: Ints, boxes: Ints) -> Ints:
    """What it costs that boxes lie over states and dots, or over the heads of arrows."""
    heads = boxes_around(np.stack([curve[2] for curve in drawing.curves]), (_HEAD, _HEAD))
    over = overlapping(boxes, nodes + np.array([-_AIR, -_AIR, _AIR, _AIR])).sum(axis=1) * HARD
    cost: Ints = over + overlapping(boxes, heads).sum(axis=1) * 2 * _COVERED_LINE
    return cost


def _lines_covered(drawing: Drawing, labels: list[_Label], boxes: Ints, whose: Ints) -> Ints:
    """How many curves and stems of others run through each box, or close by it."""
    found = np.zeros(len(boxes), dtype=np.int64)
    own = np.array([-1 if label.line is None else label.line for label in labels], dtype=np.int64)[whose]
    large = boxes + np.array([-_CLEAR, -_CLEAR, _CLEAR, _CLEAR])
    for index, line in enumerate([*drawing.lines, *drawing.stems]):
        found += (_points_in(large, line) > 0) & (own != index)
    return found


def _others_nearer(dots: Ints, labels: list[_Label], boxes: Ints, whose: Ints) -> Ints:
    """How many dots of other actions lie close to each box, or to a name less than twice as far off as its own."""
    apart = np.maximum(np.maximum(boxes[:, None, :2] - dots, dots - boxes[:, None, 2:]), 0)
    far = (apart**2).sum(axis=2)
    number = np.arange(len(boxes))
    own = np.array([label.dot for label in labels])[whose]
    name = np.array([label.line is None for label in labels])[whose]
    near = far < np.maximum(_BESIDE**2, 4 * far[number, own] * name)[:, None]
    near[number, own] = False
    count: Ints = near.sum(axis=1)
    return count


def _crowded(boxes: Ints, whose: Ints) -> Ints:
    """What every two boxes of different labels cost together."""
    wide = boxes + np.array([-GAP, 20, GAP, -20])
    cost = overlapping(boxes, boxes) * HARD + overlapping(wide, boxes) * _ONE_WORD
    cost[whose[:, None] == whose] = 0
    return cost


def _picked(costs: Ints, together: Ints, whose: Ints) -> tuple[Ints, Ints]:
    """For every label its cheapest box beside the others, moved until nothing changes; and what each costs."""
    starts = np.searchsorted(whose, np.arange(whose[-1] + 2))
    mine = [slice(a, b) for a, b in pairwise(starts)]
    picked = np.array([part.start + int(np.argmin(costs[part])) for part in mine])
    for _ in range(_ROUNDS):
        before = picked.copy()
        for index, part in enumerate(mine):
            both = costs[part] + together[part][:, picked].sum(axis=1)
            picked[index] = part.start + int(np.argmin(both))
        if (picked == before).all():
            break
    return picked, costs[picked] + together[np.ix_(picked, picked)].sum(axis=1)
