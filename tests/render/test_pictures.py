"""Pictures: nothing lies over anything else, everything is inside its box, and every run draws the same."""

import os
import subprocess
import sys
from io import StringIO
from itertools import combinations
from pathlib import Path

import pytest
from rich.console import Console

from printed import Word, words
from rldrill.exercise import draw
from rldrill.print.paper import page_setup, pdf
from rldrill.problems.backup_diagrams.backup_diagram_value import diagram
from rldrill.problems.backups import BACKUPS, backup_diagram
from rldrill.problems.document import Beside, Table
from rldrill.problems.draws import Draws
from rldrill.problems.models import model_blocks, state_diagram
from rldrill.problems.pictures import (
    Arm,
    Arrow,
    BackupDiagram,
    Bars,
    Branch,
    Bumps,
    GridPicture,
    Node,
    Pendulum,
    Picture,
    StateDiagram,
    Timeline,
)
from rldrill.problems.settings import Shape, draw_model, draw_setting
from rldrill.render.pictures.backup import scene as drawn_backup
from rldrill.render.pictures.scene import Caption, Ellipse, Scene, bounds_of, text_width
from rldrill.render.pictures.scene import Path as Lines
from rldrill.render.pictures.scenes import scene_of
from rldrill.render.terminal import render
from rldrill.render.typst import block
from rldrill.render.unicode import unicode_text

ROOT = Path(__file__).parents[2]
SETUP = page_setup("a4", title="t", margin="2cm", size="10.5pt", columns=1)
SHAPES = [(1, 2, 2), (2, 1, 2), (2, 2, 2), (2, 3, 2), (3, 2, 2), (4, 2, 1)]


def models(states: int, actions: int, branches: int, count: int = 6) -> list[StateDiagram]:
    found = []
    for seed in range(count):
        rng = Draws(f"pictures {seed}")
        found.append(state_diagram(draw_model(rng, draw_setting(rng), Shape(states, actions, branches))))
    return found


def backups() -> list[BackupDiagram]:
    found = [backup_diagram(name, branches, 3) for name in BACKUPS for branches in (2, 3)]
    for level in (1, 2, 3):
        found += [diagram(draw("backup-diagram-value", level, seed).problem.given) for seed in range(8)]  # type: ignore[arg-type]
    return found


RUN = Timeline(
    times=("$t = 0$", "$t = 1$", "$t = 2$"),
    states=("cool", "warm", "over"),
    actions=("fast", "slow"),
    rewards=("$r_1 = 2$", "$r_2 = −1$"),
    ended=True,
)
LONG_RUN = Timeline(tuple(f"$t = {t}$" for t in range(14)), ("cool",) * 14, ("fast",) * 14, ("$r = 2$",) * 13)
OTHERS: list[Picture] = [
    GridPicture((("$1$", "$−2$", "", "goal"), ("", "#", "", "$1/2$"), ("start", "", "", ""))),
    Bars(("open", "closed", "ajar"), ("",), ((0.5, 0.3, 0.2),), (("$1/2$", "$3/10$", "$1/5$"),)),
    Bars(("a", "b"), ("before", "after"), ((0.5, 0.5), (1.0, 0.0)), (("$1/2$", "$1/2$"), ("$1$", "$0$"))),
    Bumps((0, 1, 2), 0.5, "gaussian", 0.75),
    Bumps((0, 2, 4), 2, "tent", 3),
    Arm((1, 1), (30, 45)),
    Arm((2, 1, 1), (60, -90, 30)),
    Pendulum(30),
    Pendulum(-45),
    Pendulum(170, cart=True),
    RUN,
    LONG_RUN,
    Timeline(("", ""), ("$s_t$", "$s_{t+1}$"), ("$a_t$",), ("$r_{t+1}$",)),
]


def labels(scene: Scene) -> list[Caption]:
    return [shape for shape in scene.shapes if isinstance(shape, Caption)]


def nodes(scene: Scene) -> list[Ellipse | Lines]:
    """States and dots, and no arrowheads."""
    shapes = [s for s in scene.shapes if isinstance(s, Ellipse) or (isinstance(s, Lines) and s.closed)]
    return [shape for shape in shapes if shape.fill != 0.0 or isinstance(shape, Ellipse)]


def assert_apart(scene: Scene, texts: list[Caption]) -> None:
    for one, two in combinations(texts, 2):
        assert not bounds_of(one).overlaps(bounds_of(two)), (one, two)
    for label in texts:
        for node in nodes(scene):
            assert not bounds_of(label).overlaps(bounds_of(node)), (label, node)


@pytest.mark.parametrize("shape", SHAPES)
def test_labels_of_state_diagrams_cover_nothing(shape: tuple[int, int, int]) -> None:
    for picture in models(*shape):
        scene = scene_of(picture)
        assert scene is not None, "no layout was found"
        names = [label for label in labels(scene) if not label.plate]
        assert [label.text for label in names] == list(picture.states)
        assert_apart(scene, [label for label in labels(scene) if label.plate])
        box = scene.box
        assert box.bottom - box.top < 7 / 2.54 * 72, "a diagram must not fill a page"


def test_labels_of_backup_diagrams_cover_nothing() -> None:
    for picture in backups():
        scene = scene_of(picture)
        assert scene is not None
        assert_apart(scene, labels(scene))


def test_labels_of_arms_cover_no_other_label() -> None:
    turns = (-150, -90, -60, 0, 30, 90, 120, 180)
    arms = [Arm((1, 2), (first, second)) for first in turns for second in turns]
    arms += [Arm((2, 1, 1), angles) for angles in combinations(turns, 3)]
    for arm in arms:
        scene = scene_of(arm)
        assert scene is not None
        boxes = [bounds_of(label) for label in labels(scene)]
        assert len(boxes) == 2 * len(arm.lengths)
        assert not [pair for pair in combinations(boxes, 2) if pair[0].overlaps(pair[1])], arm
        ends = [bounds_of(shape) for shape in scene.shapes if isinstance(shape, Ellipse)]
        assert len(ends) == len(arm.lengths) + 1
        assert not [end for end in ends for box in boxes if box.overlaps(end)], arm


def words_of(source: str, folder: Path) -> list[Word]:
    """The words of a page."""
    (folder / "page.pdf").write_bytes(pdf(source))
    return list(words(folder / "page.pdf"))


def test_everything_that_is_written_is_inside_its_box(tmp_path: Path) -> None:
    pictures = [*(model for shape in SHAPES for model in models(*shape, count=2)), *backups(), *OTHERS]
    for picture in pictures:
        scene = scene_of(picture) if not isinstance(picture, Timeline) else None
        body = block(picture).removeprefix("#")
        source = f"{SETUP}#set page(width: auto, height: auto, margin: 0pt, header: none, footer: none)\n"
        source += f"#box(stroke: none, {body})" if scene is None else f"#{body}"
        if isinstance(picture, Timeline):
            source = source.replace("width: auto", "width: 14cm")
        # A page is as wide as the picture says that it is; words that stand out of it are outside the page.
        for word in words_of(source + "\n#metadata(none)", tmp_path):
            assert word.left > -1, picture
            assert word.right < word.width + 1, picture
            assert word.top > -3, picture  # the boxes of words hold room for accents that are not there
            assert word.bottom < word.height + 3, picture


def test_labels_are_at_least_as_small_as_was_reckoned(tmp_path: Path) -> None:
    texts = ["rattling", "overheated", "$1/2$, $−10$", "$V^π(s)$", "$π = 3/4$", "$Q^*(s, a)$", "Monte Carlo", "$s₁$"]
    source = f"{SETUP}#set page(width: 20cm, height: 25cm, margin: 0pt, header: none, footer: none)\n"
    for text in texts:
        (tmp_path / "one").mkdir(exist_ok=True)
        found = words_of(source + block(BackupDiagram(backup_diagram("td-zero").root, text)), tmp_path / "one")
        assert max(w.right for w in found) - min(w.left for w in found) <= text_width(text) + 2, text


def test_too_large_a_diagram_is_left_out() -> None:
    arrows = tuple(Arrow(str(n), "go", str((n + 1) % 7), "$1$", "$0$") for n in range(7))
    large = StateDiagram(tuple(map(str, range(7))), (), arrows)
    assert block(large) == ""
    table = Table(("a",), (("b",),))
    assert block(Beside((table, large))).count("[") == block(Beside((table,))).count("[")
    many = StateDiagram(("s", "t"), (), tuple(Arrow("s", f"a{n}", "t", "$1$", "$0$") for n in range(25)))
    assert block(many) == ""
    assert unicode_text(many) == ""


_HASHED = """
from rldrill.problems.settings import *
from rldrill.problems.draws import Draws
from rldrill.problems.models import state_diagram
from rldrill.render.typst import block
import hashlib
rng = Draws("x")
model = draw_model(rng, draw_setting(rng), Shape(3, 2, 2))
print(hashlib.sha256(block(state_diagram(model)).encode()).hexdigest())
"""


def test_the_same_diagram_is_drawn_in_every_process() -> None:
    printed = {
        subprocess.run(
            [sys.executable, "-c", _HASHED], capture_output=True, text=True, check=True,
            env={**os.environ, "PYTHONPATH": str(ROOT), "PYTHONHASHSEED": seed},
        ).stdout
        for seed in ("1", "2")
    }  # fmt: skip
    assert len(printed) == 1


def test_a_layout_that_was_once_drawn_is_drawn_again() -> None:
    # Whole numbers throughout: another machine, numpy or Python must give the same picture.
    racing = StateDiagram(("cool", "over"), ("over",), (
        Arrow("cool", "slow", "cool", "$1$", "$1$"), Arrow("cool", "fast", "cool", "$1/2$", "$2$"),
        Arrow("cool", "fast", "over", "$1/2$", "$−10$"),
    ))  # fmt: skip
    scene = scene_of(racing)
    assert scene is not None
    dots = [shape.centre for shape in scene.shapes if isinstance(shape, Ellipse) and shape.fill == 0.0]
    assert dots == [(20.1, -31.5), (0.0, 43.5)]


def shown(width: int, *blocks: Picture | Beside) -> list[str]:
    console = Console(file=StringIO(), width=width, highlight=False, markup=False)
    console.print(render(blocks))
    assert isinstance(console.file, StringIO)
    return [line.rstrip() for line in console.file.getvalue().splitlines()]


def test_a_time_line_is_folded_where_the_terminal_ends() -> None:
    lines = shown(40, RUN)
    assert lines[:8] == [
        "  t = 0           t = 1",
        "           fast",
        "  ○ cool ───────▶ ○ warm",
        "          r₁ = 2",
        "",
        "  t = 1            t = 2",
        "           slow",
        "  ○ warm ────────▶ □ over",
    ]
    assert max(map(len, shown(60, LONG_RUN))) <= 60


def test_a_table_and_its_diagram_stand_side_by_side_where_there_is_room() -> None:
    rng = Draws("beside")
    _, beside, *_ = model_blocks(draw_model(rng, draw_setting(rng), Shape(2, 2, 2)))
    assert isinstance(beside, Beside)
    wide, narrow = shown(120, beside), shown(60, beside)
    assert len(narrow) > len(wide)
    assert max(map(len, narrow)) <= 60


def test_an_arm_of_many_joints_is_left_to_its_table() -> None:
    assert shown(80, Arm((1, 1), (30, 45)))
    assert not "".join(shown(80, Arm((2, 1, 1), (60, -90, 30)))).strip()


def test_a_state_diagram_is_a_tree_in_the_terminal() -> None:
    arrows = (
        Arrow("cool", "slow", "cool", "$1$", "$1$"),
        Arrow("cool", "fast", "cool", "$1/2$", "$2$"),
        Arrow("cool", "fast", "over", "$1/2$", "$−10$"),
    )
    assert unicode_text(StateDiagram(("cool", "over"), ("over",), arrows)).splitlines() == [
        "○ cool",
        "├─● slow ──▶ ○ cool  1, 1",
        "└─● fast ─┬▶ ○ cool  1/2, 2",
        "          └▶ □ over  1/2, −10",
    ]


def test_the_title_of_a_backup_diagram_stands_over_its_middle() -> None:
    root = Node("state", branches=(Branch(Node("action"), "a long label"), Branch(Node("action"))))
    box, title = drawn_backup(root, "").box, drawn_backup(root, "Q").shapes[-1]
    assert isinstance(title, Caption)
    assert abs(box.left + box.right) > 1, "the diagram is not the same on both sides"
    assert title.at[0] - box.left == pytest.approx(box.right - title.at[0])


def test_a_backup_diagram_in_the_terminal() -> None:
    assert unicode_text(backup_diagram("q-learning", title="Q-learning")).splitlines() == [
        "Q-learning",
        "    ●",
        "    │",
        "    ○",
        "┌───┼───┐",
        "│╰──┼──╯│",
        "│   │   │",
        "●   ●   ●",
    ]


def test_bars_are_as_long_as_their_shares() -> None:
    assert unicode_text(OTHERS[2]).splitlines() == [
        "a  before  ██████████ 1/2",
        "   after   ████████████████████ 1",
        "b  before  ██████████ 1/2",
        "   after   ▏ 0",
    ]


def test_a_grid_in_the_terminal() -> None:
    assert unicode_text(GridPicture((("S", "#"), ("", "G")))).splitlines() == [
        "┌───┬───┐", "│ S │███│", "├───┼───┤", "│   │ G │", "└───┴───┘",
    ]  # fmt: skip


def test_every_picture_has_a_text_in_the_terminal() -> None:
    for picture in OTHERS:
        assert max(map(len, shown(100, picture))) <= 100
        assert unicode_text(picture) or isinstance(picture, Arm)  # of many joints


def test_a_base_that_is_turned_is_drawn_as_it_is_turned() -> None:
    # Turned by 30° with a link at 60° to it: the link points straight up.
    straight, turned = (scene_of(Arm((1.0,), angles, base)) for angles, base in (((90.0,), 0.0), ((60.0,), 30.0)))
    assert straight is not None
    assert turned is not None
    (one,), (other,) = (
        [each for each in scene.shapes if isinstance(each, Lines) and each.width > 2] for scene in (straight, turned)
    )
    assert other.points[1] == pytest.approx(one.points[1], abs=1e-9)
    assert {each.text for each in turned.shapes if isinstance(each, Caption)} >= {"$x$", "$x_0$", "$φ_0$", "$θ_1$"}


def links_of(arm: Arm) -> list[Lines]:
    scene = scene_of(arm)
    assert scene is not None
    return [each for each in scene.shapes if isinstance(each, Lines) and each.width > 2]


def test_a_link_that_is_folded_back_lies_beside_the_one_before() -> None:
    # A length is 120/3 = 40 points: up to (0, −80), and back down to half of that, 6 points to the left.
    first, second = links_of(Arm((2, 1), (90, 180)))
    assert sum(first.points, ()) == pytest.approx((0, 0, 0, -80), abs=1e-9)
    assert sum(second.points, ()) == pytest.approx((0, -80, -6, -80, -6, -40), abs=1e-9)
    # Folded again it lies beside both.
    assert [link.points[-1][1] for link in links_of(Arm((1, 1, 1), (0, 180, -180)))] == pytest.approx([0, -6, -12])


@pytest.mark.parametrize(
    ("angles", "side"),
    [((90, 0), (0, 8)), ((-90, 90), (-8, 0)), ((-135, 90), (0, -8)), ((180, 90), (0, 8))],
)
def test_the_base_stands_where_the_first_link_does_not_run_through_it(
    angles: tuple[float, ...], side: tuple[float, float]
) -> None:
    scene = scene_of(Arm((1, 1), angles))
    assert scene is not None
    (left, top), (right, bottom) = next(each for each in scene.shapes if isinstance(each, Lines)).points
    assert ((left + right) / 2, (top + bottom) / 2) == pytest.approx(side, abs=1e-9)


def test_the_arc_of_the_angle_runs_outside_of_the_cart_and_its_wheels() -> None:
    for angle in (150, 180, 210):
        scene = scene_of(Pendulum(angle, cart=True))
        assert scene is not None
        arc = next(each for each in scene.shapes if isinstance(each, Lines) and len(each.points) > 12)
        # A corner of the cart is √(22² + 7²) ≈ 23.1 from the pivot, the far side of a wheel √(13² + 11²) + 4 ≈ 21.0.
        assert all(x * x + y * y > 27**2 for x, y in arc.points)


def test_every_centre_of_a_bump_has_its_number_and_none_runs_into_another() -> None:
    for centres in ((-5, -4.5, 20), (0, 1, 2), (0, 0.25, 0.5, 40)):
        scene = scene_of(Bumps(centres, 2, "tent", -3))
        assert scene is not None
        found = [label.text for label in labels(scene)]
        assert {f"${centre:g}$".replace("-", "−") for centre in centres} < set(found)
        assert len(found) == 2 * len(centres) + 1
        assert_apart(scene, labels(scene))
        curves = [bounds_of(each).top for each in scene.shapes if isinstance(each, Lines) and len(each.points) > 40]
        assert all(bounds_of(each).bottom < min(curves) - 3 for each in labels(scene) if "φ" in each.text)


def test_two_diagrams_that_have_titles_stand_apart() -> None:
    root = backup_diagram("td-zero").root
    assert drawn_backup(root, "1").box.right == pytest.approx(drawn_backup(root, "").box.right + 20)
