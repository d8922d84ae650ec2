"""Where the labels of a state diagram lie: over nothing else, and near what they belong to."""

import numpy as np
from msgspec.structs import replace

from rldrill.render.pictures.curves import COARSE, Ints, boxes_around, overlapping
from rldrill.render.pictures.graph_search import HARD, Action, Drawing, States, label_size

_COVERED_LINE = 220
_ASIDE = 60
_ROUNDS = 3
_DOT, _AIR = 30, 12
_HEAD = 55
_SHOWN = 55  # per cent of a short curve that its label may hide


def placed(drawing: Drawing, states: States, actions: tuple[Action, ...]) -> Drawing:
    """The drawing with its labels; it costs ``HARD`` and more if some lie over each other or over a node."""
    texts, choices, costs = [], [], []
    fine = [_samples(line) for line in drawing.lines] + [_samples(stem) for stem in drawing.stems]
    dots = boxes_around(np.stack(drawing.dots), (2 * _DOT, 2 * _DOT))
    heads = boxes_around(np.stack([curve[2] for curve in drawing.curves]), (_HEAD, _HEAD))
    nodes = np.concatenate([states.boxes, dots]) + np.array([-_AIR, -_AIR, _AIR, _AIR])
    owner = 0
    for number, action in enumerate(actions):
        for text in action.labels:
            boxes, cost = _on_curve(drawing.lines[owner], text)
            texts.append(text)
            choices.append(boxes)
            costs.append(cost + _covered(boxes, nodes, heads, fine, (owner,)))
            owner += 1
        boxes, cost = _around_dot(drawing.dots[number], action.name)
        texts.append(action.name)
        choices.append(boxes)
        costs.append(cost + _covered(boxes, nodes, heads, fine, ()))
    picked, total = _picked(choices, costs)
    middles = [(boxes[pick, :2] + boxes[pick, 2:]) // 2 for boxes, pick in zip(choices, picked, strict=True)]
    everything = np.concatenate([states.boxes, dots, *(b[None, p] for b, p in zip(choices, picked, strict=True))])
    size = everything[:, 2:].max(axis=0) - everything[:, :2].min(axis=0)
    room = int(max(0, size[0] - 2700)) * 2 + int(max(0, size[1] - 1700)) * 8
    return replace(drawing, cost=drawing.cost + total + room, labels=list(zip(middles, texts, strict=True)))


def _samples(line: Ints) -> Ints:
    """Points along a line, close enough together that no label slips between them."""
    t = np.arange(9, dtype=np.int64)[None, :, None]
    return ((line[:-1, None] * (8 - t) + line[1:, None] * t) // 8).reshape(-1, 2)


def _on_curve(line: Ints, text: str) -> tuple[Ints, Ints]:
    """A label on its curve, in the middle if that can be, or touching it."""
    wide, high = label_size(text)
    middles, costs = [], []
    for step, cost in ((4, 0), (3, 25), (5, 30), (2, 90), (6, 90)):
        for dx, dy in ((0, 0), (0, -1), (0, 1), (1, 0), (-1, 0)):
            middles.append(line[step * COARSE // 8] + np.array([dx * (wide // 2 + 10), dy * (high // 2 + 10)]))
            costs.append(cost + (_ASIDE if dx or dy else 0))
    boxes = boxes_around(np.stack(middles), (wide, high))
    points = _samples(line)
    hidden = overlapping(boxes, np.concatenate([points, points], axis=1)).sum(axis=1) * 100 // len(points)
    return boxes, np.array(costs, dtype=np.int64) + np.maximum(0, hidden - _SHOWN) * 6


def _around_dot(dot: Ints, text: str) -> tuple[Ints, Ints]:
    wide, high = label_size(text)
    side, up = wide // 2 + 48, high // 2 + 45
    ways = [(0, -up), (0, up), (side, 0), (-side, 0), (side, -up * 2 // 3), (-side, -up * 2 // 3),
            (side, up * 2 // 3), (-side, up * 2 // 3), (side * 2 // 3, -up), (-side * 2 // 3, -up),
            (side * 2 // 3, up), (-side * 2 // 3, up)]  # fmt: skip
    middles = dot + np.array(ways, dtype=np.int64)
    return boxes_around(middles, (wide, high)), np.arange(len(ways), dtype=np.int64) * 4


def _covered(boxes: Ints, nodes: Ints, heads: Ints, lines: list[Ints], own: tuple[int, ...]) -> Ints:
    cost = overlapping(boxes, nodes).sum(axis=1) * HARD + overlapping(boxes, heads).sum(axis=1) * 4 * _COVERED_LINE
    for index, line in enumerate(lines):
        if index not in own:
            points = np.concatenate([line, line], axis=1)
            cost = cost + overlapping(boxes, points).any(axis=1) * _COVERED_LINE
    return cost


def _picked(choices: list[Ints], costs: list[Ints]) -> tuple[list[int], int]:
    """For every label one of its places: the cheapest beside the others, moved until nothing changes."""
    picked = [int(np.argmin(cost)) for cost in costs]
    total = 0
    for _ in range(_ROUNDS):
        total = 0
        for index, (boxes, cost) in enumerate(zip(choices, costs, strict=True)):
            others = [choices[i][picked[i]] for i in range(len(choices)) if i != index]
            crowd = overlapping(boxes, np.stack(others)).sum(axis=1) * HARD if others else 0
            both = cost + crowd
            picked[index] = int(np.argmin(both))
            total += int(both[picked[index]])
    return picked, total
