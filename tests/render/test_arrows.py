"""State diagrams: heads end on the edge of what is drawn for a state, and it is clear what a label belongs to."""

import math
from collections import Counter
from itertools import combinations

import numpy as np
import pytest

from rldrill.problems.draws import Draws
from rldrill.problems.models import state_diagram
from rldrill.problems.pictures import StateDiagram
from rldrill.problems.settings import Shape, draw_model, draw_setting
from rldrill.render.pictures.curves import Outline, bent
from rldrill.render.pictures.scene import Bounds, Caption, Curve, Ellipse, Path, bounds_of
from rldrill.render.pictures.scenes import scene_of

BOX, CIRCLE = Outline(130, 105, square=True), Outline(50, 50)
#: Shape, where an arrow to (0, 0) begins, where it ends: worked by hand, in tenths of a point.
TIPS = [
    (BOX, (-1000, 0), (-130, 0)),  # level
    (BOX, (0, 900), (0, 105)),  # upright
    (BOX, (200, -1000), (21, -105)),  # steep: at y = −105, x = 105/5
    (BOX, (-1000, -800), (-130, -104)),  # just below a corner: at x = −130, y = −130 · 4/5
    (BOX, (-1000, -840), (-125, -105)),  # just right of it: at y = −105, x = −105 · 25/21
    (BOX, (1300, 1050), (130, 105)),  # the corner itself
    (CIRCLE, (-1000, 0), (-50, 0)),
    (CIRCLE, (0, 900), (0, 50)),
    (CIRCLE, (300, 400), (30, 40)),
    (CIRCLE, (-1200, -500), (-46, -19)),  # 50/13 of (−12, −5), which is (−46.2, −19.2)
    (Outline(200, 100), (-800, 300), (-160, 60)),  # (−160/200)² + (60/100)² = 1
]


@pytest.mark.parametrize(("outline", "start", "tip"), TIPS)
def test_a_straight_arrow_ends_where_its_line_meets_the_shape(
    outline: Outline, start: tuple[int, int], tip: tuple[int, int]
) -> None:
    curves, _ = bent(np.array([start]), np.array([[0, 0]]), np.array([0]), outline)
    assert np.abs(curves[0, 2] - np.array(tip)).max() <= 1


def off_the_edge(shape: Ellipse | Path, point: tuple[float, float]) -> float:
    """About how far a point is from the border of a shape."""
    if isinstance(shape, Ellipse):
        (x, y), (a, b) = shape.centre, shape.radii
        return float(abs(np.hypot((point[0] - x) / a, (point[1] - y) / b) - 1) * max(a, b))
    (left, top), _, (right, bottom), _ = shape.points
    return float(abs(max(left - point[0], point[0] - right, top - point[1], point[1] - bottom)))


def heads_and_shapes(diagram: StateDiagram) -> tuple[list[Path], dict[str, Ellipse | Path]]:
    scene = scene_of(diagram)
    assert scene is not None
    heads = [each for each in scene.shapes if isinstance(each, Path) and each.closed and each.fill == 0.0]
    named = {
        name.text: shape
        for shape, name in zip(scene.shapes, scene.shapes[1:], strict=False)
        if isinstance(name, Caption) and not name.plate and isinstance(shape, Ellipse | Path)
    }
    return heads, named


@pytest.mark.parametrize("shape", [(2, 2, 2), (3, 1, 2), (3, 2, 2), (4, 2, 1)])
def test_every_head_ends_on_the_edge_of_its_state_and_nothing_lies_over_it(shape: tuple[int, int, int]) -> None:
    for seed in range(6):
        rng = Draws(f"arrows {seed}")
        diagram = state_diagram(draw_model(rng, draw_setting(rng), Shape(*shape)))
        heads, named = heads_and_shapes(diagram)
        assert all(isinstance(named[name], Path) for name in diagram.terminal)
        targets: dict[tuple[str, str], list[str]] = {}
        for arrow in diagram.arrows:
            targets.setdefault((arrow.state, arrow.action), []).append(arrow.next)
        wanted = [name for names in targets.values() for name in names]
        assert len(heads) == len(wanted)
        for head, name in zip(heads, wanted, strict=True):
            assert off_the_edge(named[name], head.points[0]) < 0.3, (seed, name)
        scene = scene_of(diagram)
        assert scene is not None
        assert scene.shapes[-len(heads) :] == tuple(heads), "nothing is drawn over a head"


def ink(label: Caption) -> Bounds:
    """The label without the air around it."""
    box = bounds_of(label)
    return Bounds(box.left + 0.5, box.top + 1, box.right - 0.5, box.bottom - 1)


def samples(line: Curve | Path) -> list[tuple[float, float]]:
    """Points along a curve or a straight line, less than the height of a label apart."""
    if isinstance(line, Path):
        (x, y), (u, v) = line.points
        line = Curve((x, y), ((x + u) / 2, (y + v) / 2), (u, v))
    (x, y), (a, b), (u, v) = line.start, line.control, line.end
    shares = [n / 60 for n in range(61)]
    return [
        ((1 - t) ** 2 * x + 2 * t * (1 - t) * a + t**2 * u, (1 - t) ** 2 * y + 2 * t * (1 - t) * b + t**2 * v)
        for t in shares
    ]


def apart(box: Bounds, point: tuple[float, float]) -> float:
    across = max(box.left - point[0], 0, point[0] - box.right)
    return float(np.hypot(across, max(box.top - point[1], 0, point[1] - box.bottom)))


def muddles(diagram: StateDiagram) -> list[str]:
    """Labels on another's line, names nearer to another's dot, and labels that read as one."""
    scene = scene_of(diagram)
    assert scene is not None
    curves = [each for each in scene.shapes if isinstance(each, Curve)]
    stems = [each for each in scene.shapes if isinstance(each, Path) and not each.closed]
    dots = [each.centre for each in scene.shapes if isinstance(each, Ellipse) and each.fill == 0.0]
    labels = [each for each in scene.shapes if isinstance(each, Caption) and each.plate]
    found, curve = [], 0
    pairs = Counter((arrow.state, arrow.action) for arrow in diagram.arrows)
    order = [(number, last) for number, count in enumerate(pairs.values()) for last in (*[False] * count, True)]
    for (number, name), label in zip(order, labels, strict=True):
        box = ink(label)
        others = [line for index, line in enumerate([*curves, *stems]) if name or index != curve]
        curve += not name
        if any(apart(box, point) == 0 for line in others for point in samples(line)):
            found.append(f"{label.text} lies on another's line")
        far = [apart(box, dot) for dot in dots]
        if name and len(far) > 1 and min(far[:number] + far[number + 1 :]) <= far[number]:
            found.append(f"{label.text} is nearer to another's dot")
    for one, two in combinations(map(ink, labels), 2):
        level = min(one.bottom, two.bottom) - max(one.top, two.top)
        if level > 2 and max(one.left, two.left) - min(one.right, two.right) < 5:
            found.append("two labels read as one")
    return found


def test_labels_of_state_diagrams_belong_to_one_thing() -> None:
    shapes = [(2, 2, 2), (3, 1, 2), (3, 2, 1), (3, 2, 2), (4, 2, 1)]
    found = []
    for shape in shapes:
        for seed in range(5):
            rng = Draws(f"labels {seed}")
            found.append(muddles(state_diagram(draw_model(rng, draw_setting(rng), Shape(*shape)))))
    assert sum(map(bool, found)) <= 1, [each for each in found if each]


def test_no_two_heads_land_on_one_spot() -> None:
    close = 0
    for shape in [(2, 2, 2), (3, 2, 1), (3, 2, 2)]:
        for seed in range(10):
            rng = Draws(f"labels {seed}")
            scene = scene_of(state_diagram(draw_model(rng, draw_setting(rng), Shape(*shape))))
            assert scene is not None
            tips = [each.end for each in scene.shapes if isinstance(each, Curve)]
            close += sum(math.dist(one, two) < 6 for one, two in combinations(tips, 2))
    assert close <= 1
