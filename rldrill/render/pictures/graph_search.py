"""Where the action dots of a state diagram lie, and how their curves run."""

from math import isqrt

import numpy as np
from msgspec import Struct, field
from numpy.typing import NDArray

from rldrill.render.pictures.curves import (
    COARSE,
    Ints,
    Outline,
    bent,
    boxes_around,
    crossings,
    overlapping,
    segments,
)
from rldrill.render.pictures.scene import SIZE, text_width

#: How far apart two labels side by side stand, so that they do not read as one.
GAP = 50
#: A drawing that costs as much is not readable: something lies over something else.
HARD = 100_000
_CROSSING = 900
_THROUGH = 4000
_TOUCHING = 700
_ALONG, _APART = 160, 55  # two lines so close for a while
_MEETING, _HEAD = 500, 70  # two heads so close
_BEND = 25
_ROUNDS = 3
_CLEAR = 60
_HIGHEST = 1600  # a taller picture costs
_BENDS = np.array([0, 1, -1, 2, -2, 4, -4], dtype=np.int64)
_BACK = np.array([7, -7, 10, -10, 13, -13], dtype=np.int64)


class Action(Struct, frozen=True):
    """An action of a state: where it may lead, and what stands on the arrows there."""

    state: int
    name: str
    targets: tuple[int, ...]
    labels: tuple[str, ...]


class States(Struct, frozen=True):
    """The states' shapes: centres of shape (n, 2), outlines."""

    centres: Ints
    outlines: list[Outline]

    @property
    def boxes(self) -> Ints:
        """The rectangles around them."""
        return np.concatenate(
            [boxes_around(self.centres[i : i + 1], (2 * o.wide, 2 * o.high)) for i, o in enumerate(self.outlines)]
        )


class Drawing(Struct, frozen=True):
    """A state diagram laid out: curves are start, control and end; labels lie with their middle at a point."""

    states: States
    dots: list[Ints]
    stems: list[Ints]
    curves: list[Ints]
    lines: list[Ints]
    cost: int
    labels: list[tuple[Ints, str]] = field(default_factory=list)
    muddled: bool = True  # a label lies on another's line, or seems to belong to something else


class _Options(Struct):
    """All ways to draw one action: every place of its dot, and from there every curve to every target."""

    places: Ints
    stems: Ints
    own: Ints  # what a place costs by itself
    curves: list[Ints]  # by target: (places, bends, 3, 2)
    lines: list[Ints]  # by target: (places, bends, points, 2)
    each: list[Ints]  # by target: (places, bends): what a curve costs by itself
    sizes: list[tuple[int, int]]


class _Choice(Struct):
    place: int
    bends: list[int]


def _with_gap(size: tuple[int, int]) -> tuple[int, int]:
    return size[0] + GAP, size[1]


def label_size(text: str) -> tuple[int, int]:
    """The room for a label, in tenths of a point."""
    return round(text_width(text) * 10) + 20, round(SIZE * 11.5)


def search(states: States, actions: tuple[Action, ...]) -> Drawing:
    """Move one dot after the other, with its curves, to where it costs least."""
    options = [_options(states, action) for action in actions]
    # Actions that may lead to most places first, and the other way round; what turns out better is kept.
    order = sorted(range(len(actions)), key=lambda index: (-len(actions[index].targets), index))
    tries = [_settled(options, each) for each in (order, order[::-1])]
    total, chosen = min(tries, key=lambda found: found[0])
    taken = [(options[index], chosen[index]) for index in range(len(actions))]
    return Drawing(
        states,
        [option.places[choice.place] for option, choice in taken],
        [option.stems[choice.place] for option, choice in taken],
        [curves[c.place, b] for option, c in taken for curves, b in zip(option.curves, c.bends, strict=True)],
        [lines[c.place, b] for option, c in taken for lines, b in zip(option.lines, c.bends, strict=True)],
        total,
    )


def _settled(options: list[_Options], order: list[int]) -> tuple[int, dict[int, _Choice]]:
    """Rounds in which every action moves to where it costs least, until none moves."""
    chosen: dict[int, _Choice] = {}
    total = 0
    for _ in range(_ROUNDS):
        before, total = dict(chosen), 0
        for index in order:
            chosen.pop(index, None)
            chosen[index], cost = _best(options[index], [(options[i], chosen[i]) for i in sorted(chosen)])
            total += cost
        if before == chosen:
            break
    return total, chosen


def _options(states: States, action: Action) -> _Options:
    places = _places(states, action)
    count = len(places)
    centre, outline = states.centres[action.state], states.outlines[action.state]
    _, stems = bent(places, np.broadcast_to(centre, places.shape), np.zeros(count, dtype=np.int64), outline)
    stems = stems[:, [0, -1]]
    curves, lines, each = [], [], []
    sizes = [_with_gap(label_size(text)) for text in action.labels]
    for target, size in zip(action.targets, sizes, strict=True):
        bends = _BACK if target == action.state else _BENDS
        starts = np.repeat(places, len(bends), axis=0)
        ends = np.broadcast_to(states.centres[target], starts.shape)
        turns = np.tile(bends, count)
        curve, line = bent(starts, ends, turns, states.outlines[target])
        shape = (count, len(bends))
        curves.append(curve.reshape(*shape, 3, 2))
        lines.append(line.reshape(*shape, COARSE + 1, 2))
        each.append(_alone(states, line, turns, target, size).reshape(shape))
    apart = stems[:, 0] - stems[:, 1]
    own = np.array([isqrt(int(x * x + y * y)) for x, y in apart], dtype=np.int64)
    reach = np.abs(places[:, 1] - (states.centres[:, 1].min() + states.centres[:, 1].max()) // 2)
    return _Options(places, stems, own + 4 * np.maximum(0, reach - _HIGHEST // 2), curves, lines, each, sizes)


def _places(states: States, action: Action) -> Ints:
    """Around the state, near and far; and on the ways to the targets."""
    x, y = map(int, states.centres[action.state])
    a, b = states.outlines[action.state].wide, states.outlines[action.state].high
    found = [(x + dx * (a + far), y) for far in (230, 330) for dx in (1, -1)]
    found += [(x, y + dy * (b + far)) for far in (230, 320) for dy in (-1, 1)]
    for across, down in ((a * 7 // 10 + 110, b + 200), (a + 200, b + 150), (a + 150, b + 260)):
        found += [(x + dx * across, y + dy * down) for dy in (-1, 1) for dx in (1, -1)]
    for target in action.targets:
        tx, ty = map(int, states.centres[target])
        dx, dy = tx - x, ty - y
        long = isqrt(dx * dx + dy * dy)
        for aside in (0, 250, -250, 450, -450) if long else ():
            found.append(((x * 5 + tx * 4) // 9 - dy * aside // long, (y * 5 + ty * 4) // 9 + dx * aside // long))
    places = np.array(found, dtype=np.int64)
    near = np.zeros(len(places), dtype=bool)
    for centre, outline in zip(states.centres, states.outlines, strict=True):
        near |= outline.holds(places, centre, 140)
    return places[~near]


def _alone(states: States, lines: Ints, bends: Ints, target: int, size: tuple[int, int]) -> Ints:
    """What curves cost without the others: length, bends, states that they touch or whose label would."""
    steps = np.abs(np.diff(lines, axis=1)).max(axis=2).sum(axis=1)
    wanted = size[0] * 9 // 5
    cost = steps // 2 + np.maximum(0, wanted - steps) * 4 + np.abs(bends) * _BEND
    middles = boxes_around(lines[:, COARSE // 2], size)
    for index, (centre, outline) in enumerate(zip(states.centres, states.outlines, strict=True)):
        inner = lines[:, 1:-2] if index == target else lines
        touched = outline.holds(inner, centre, 10 if index == target else _CLEAR)
        cost = cost + touched.any(axis=1) * _THROUGH
    covered = overlapping(middles, states.boxes).sum(axis=1)
    return cost + covered * _TOUCHING


def _best(option: _Options, others: list[tuple[_Options, _Choice]]) -> tuple[_Choice, int]:
    """The cheapest way to draw an action beside the others."""
    drawn, points, dots, boxes, tips = _drawn(others)
    place_cost = option.own + crossings(segments(option.stems), drawn) * _CROSSING
    place_cost = place_cost + _close(option.places[:, None], dots, 260).sum(axis=1) * _THROUGH
    tables = []
    for lines, each, size in zip(option.lines, option.each, option.sizes, strict=True):
        flat = lines.reshape(-1, *lines.shape[2:])
        cost = each.reshape(-1) + crossings(_pieces(flat), drawn) * _CROSSING
        cost = cost + _close(flat, dots, 90).any(axis=1) * _THROUGH
        cost = cost + overlapping(boxes_around(flat[:, COARSE // 2], size), boxes).sum(axis=1) * _TOUCHING
        cost = cost + _alongside(flat[:, 2:-1:2], points) * _ALONG
        cost = cost + _close(flat[:, -1:], tips, _HEAD).sum(axis=1) * _MEETING
        tables.append(cost.reshape(each.shape))
        place_cost = place_cost + tables[-1].min(axis=1)
    place = int(np.argmin(place_cost))
    choice = _Choice(place, [int(np.argmin(table[place])) for table in tables])
    return _untangled(option, choice, [table[place] for table in tables]), int(place_cost[place])


def _untangled(option: _Options, choice: _Choice, costs: list[Ints]) -> _Choice:
    """The same place, with bends at which an action's own curves keep clear of each other."""
    place = choice.place
    for index, cost in enumerate(costs if len(costs) > 1 else ()):
        siblings = [i for i in range(len(costs)) if i != index]
        lines = option.lines[index][place]
        beside = np.stack([option.lines[i][place, choice.bends[i]] for i in siblings])
        cost = cost + crossings(_pieces(lines), _pieces(beside).reshape(-1, 4)) * _CROSSING
        cost = cost + _alongside(lines[:, 2::2], beside[:, 2:].reshape(-1, 2)) * _ALONG
        cost = cost + _close(lines[:, -1:], beside[:, -1], _HEAD).sum(axis=1) * _MEETING
        boxes = np.concatenate(
            [boxes_around(b[None, COARSE // 2], option.sizes[i]) for b, i in zip(beside, siblings, strict=True)]
        )
        own = boxes_around(lines[:, COARSE // 2], option.sizes[index])
        cost = cost + overlapping(own, boxes).sum(axis=1) * 2 * _TOUCHING
        choice.bends[index] = int(np.argmin(cost))
    return choice


def _drawn(others: list[tuple[_Options, _Choice]]) -> tuple[Ints, Ints, Ints, Ints, Ints]:
    """What is drawn already: pieces of lines, points along them, dots, boxes of labels on curves, and their tips."""
    pieces = [np.zeros((0, 4), dtype=np.int64)]
    boxes = [np.zeros((0, 4), dtype=np.int64)]
    dots = [np.zeros((0, 2), dtype=np.int64)]
    points = [np.zeros((0, 2), dtype=np.int64)]
    tips = [np.zeros((0, 2), dtype=np.int64)]
    for option, choice in others:
        dots.append(option.places[choice.place][None])
        pieces.append(segments(option.stems[choice.place][None]).reshape(-1, 4))
        start, end = option.stems[choice.place]
        points.append(np.stack([(start * k + end * (4 - k)) // 4 for k in range(1, 5)]))
        for lines, bend, size in zip(option.lines, choice.bends, option.sizes, strict=True):
            line = lines[choice.place, bend][None]
            pieces.append(_pieces(line).reshape(-1, 4))
            points.append(line[0, 1:-1])
            boxes.append(boxes_around(line[:, COARSE // 2], size))
            tips.append(line[:, -1])
    return (
        np.concatenate(pieces),
        np.concatenate(points),
        np.concatenate(dots),
        np.concatenate(boxes),
        np.concatenate(tips),
    )


def _pieces(curves: Ints) -> Ints:
    """Curves as few straight pieces, enough to see what they cross."""
    return segments(curves[:, ::2])


def _alongside(lines: Ints, points: Ints) -> Ints:
    """How many points of each line come close to some of the others' points."""
    near = _close(points[None], lines.reshape(-1, 2), _APART)[0]
    return near.reshape(len(lines), -1).sum(axis=1, dtype=np.int64)


def _close(lines: Ints, dots: Ints, limit: int) -> NDArray[np.bool_]:
    """Which lines come how close to which dots, shape (n, dots)."""
    across = lines[..., 0, None] - dots[:, 0]
    down = lines[..., 1, None] - dots[:, 1]
    close: NDArray[np.bool_] = np.any(across * across + down * down < limit * limit, axis=1)
    return close
