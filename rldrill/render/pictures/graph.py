"""State diagrams: where states, dots, curves and labels go.

States stand on one of a few arrangements. For each, dots and curves are moved one after the other to where
they cross and touch least, then labels to where they cover nothing; the best arrangement is drawn. All is
done in whole numbers, so that every machine finds the same picture.
"""

from functools import cache

import numpy as np

from rldrill.problems.pictures import StateDiagram
from rldrill.render.pictures.curves import Ints, Outline
from rldrill.render.pictures.graph_labels import placed
from rldrill.render.pictures.graph_search import HARD, Action, Drawing, States, search
from rldrill.render.pictures.scene import (
    Bounds,
    Caption,
    Curve,
    Ellipse,
    Path,
    Point,
    Scene,
    Shape,
    arrowhead,
    rectangle,
    text_width,
)

#: Larger diagrams are left out: the table says it better.
MOST_STATES, MOST_ARROWS = 6, 24
UNIT = 10  # per point
_HIGH = 115
#: Where states stand, in columns and rows, by their number.
_ARRANGEMENTS: dict[int, tuple[tuple[tuple[int, int], ...], ...]] = {
    1: (((0, 0),),),
    2: (((0, 0), (2, 0)),),
    3: (((0, 0), (2, 0), (4, 0)), ((0, 0), (2, 0), (1, 2)), ((0, 0), (1, 2), (2, 0))),
    4: (((0, 0), (2, 0), (4, 0), (6, 0)), ((0, 0), (2, 0), (0, 2), (2, 2)), ((0, 0), (2, 0), (2, 2), (0, 2)),
        ((0, 0), (1, 2), (2, 0), (3, 2))),
    5: (((0, 0), (2, 0), (4, 0), (1, 2), (3, 2)), ((0, 0), (1, 2), (2, 0), (3, 2), (4, 0)),
        ((0, 0), (2, 0), (4, 0), (3, 2), (1, 2))),
    6: (((0, 0), (2, 0), (4, 0), (0, 2), (2, 2), (4, 2)), ((0, 0), (2, 0), (4, 0), (4, 2), (2, 2), (0, 2))),
}  # fmt: skip
#: How much room there is between states, tried from tight to wide.
_AIR = (100, 125, 150)


@cache
def scene(diagram: StateDiagram) -> Scene | None:
    """A state diagram as a scene; None where it is too large, or no readable layout is found."""
    if len(diagram.states) > MOST_STATES or len(diagram.arrows) > MOST_ARROWS or not diagram.arrows:
        return None
    actions = _actions(diagram)
    found: list[Drawing] = []
    for air in _AIR:
        found += [placed(search(states, actions), states, actions) for states in _arranged(diagram, air)]
        best = min(found, key=lambda drawing: drawing.cost)
        if best.cost < HARD and not best.muddled:
            break
    return _scene(diagram, best) if best.cost < HARD else None


def _actions(diagram: StateDiagram) -> tuple[Action, ...]:
    pairs: dict[tuple[str, str], list[tuple[int, str]]] = {}
    for arrow in diagram.arrows:
        label = f"{arrow.probability}, {arrow.reward}"
        pairs.setdefault((arrow.state, arrow.action), []).append((diagram.states.index(arrow.next), label))
    return tuple(
        Action(diagram.states.index(state), name, tuple(target for target, _ in outcomes),
               tuple(label for _, label in outcomes))
        for (state, name), outcomes in pairs.items()
    )  # fmt: skip


def _arranged(diagram: StateDiagram, air: int) -> list[States]:
    wide = [max(130, round(text_width(name) * UNIT) // 2 + 45) for name in diagram.states]
    step = (2 * max(wide) + 7 * air) // 2
    down = (2 * _HIGH + 6 * air) // 2
    outlines = [
        Outline(half, _HIGH - 10, square=True) if name in diagram.terminal else Outline(half, _HIGH)
        for name, half in zip(diagram.states, wide, strict=True)
    ]
    return [
        States(np.array([(x * step, y * down) for x, y in places], dtype=np.int64), outlines)
        for places in _ARRANGEMENTS[len(diagram.states)]
    ]


def _scene(diagram: StateDiagram, drawing: Drawing) -> Scene:
    lines: list[Shape] = []
    marks: list[Shape] = []
    heads: list[Shape] = []
    for dot, stem in zip(drawing.dots, drawing.stems, strict=True):
        lines.append(Path((_point(stem[0]), _point(stem[1]))))
        marks.append(Ellipse(_point(dot), (2.6, 2.6), 0.0))
    for curve in drawing.curves:
        start, control, end = map(_point, curve)
        lines.append(Curve(start, control, end))
        heads.append(arrowhead(control, end))
    for name, centre, outline in zip(diagram.states, drawing.states.centres, drawing.states.outlines, strict=True):
        marks += [_shape(_point(centre), outline), Caption(_point(centre), name)]
    texts = [Caption(_point(at), text, plate=True) for at, text in drawing.labels]
    return Scene((*lines, *texts, *marks, *heads))


def _shape(centre: Point, outline: Outline) -> Shape:
    (x, y), (a, b) = centre, (outline.wide / UNIT, outline.high / UNIT)
    return rectangle(Bounds(x - a, y - b, x + a, y + b), 0.88) if outline.square else Ellipse(centre, (a, b))


def _point(place: Ints) -> Point:
    return int(place[0]) / UNIT, int(place[1]) / UNIT
