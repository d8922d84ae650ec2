"""Arrows of state diagrams: their heads end on the edge of what is drawn for the state that they lead to."""

import numpy as np
import pytest

from rldrill.problems.draws import Draws
from rldrill.problems.models import state_diagram
from rldrill.problems.pictures import StateDiagram
from rldrill.problems.settings import Shape, draw_model, draw_setting
from rldrill.render.pictures.curves import Outline, bent
from rldrill.render.pictures.scene import Caption, Ellipse, Path
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
    for seed in range(12):
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
