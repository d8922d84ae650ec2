"""Pictures in the terminal, line by line, as one would draw them by hand."""

import io

from rich.console import Console

from rldrill.problems.document import Block, Table
from rldrill.problems.pictures import Arrow, BackupDiagram, Bars, Branch, GridPicture, Node, StateDiagram, Timeline
from rldrill.render.pictures.graph import MOST_ARROWS, scene
from rldrill.render.pictures.raster import _row
from rldrill.render.pictures.text import lines
from rldrill.render.terminal import plain, render


def test_a_grid_has_a_line_between_its_rows_and_one_below_them() -> None:
    assert lines(GridPicture((("1", "#"), ("", "−10"), ("S", "")))) == [
        "┌─────┬─────┐",
        "│  1  │█████│",
        "├─────┼─────┤",
        "│     │ −10 │",
        "├─────┼─────┤",
        "│  S  │     │",
        "└─────┴─────┘",
    ]


def test_a_bar_is_as_long_as_its_share() -> None:
    half, whole = lines(Bars(("a", "b"), ("",), ((0.5, 1.0),), (("1/2", "1"),)))
    assert half.count("█") * 2 == whole.count("█")
    assert half.strip().startswith("a")
    assert half.rstrip().endswith("1/2")


def test_a_branch_ends_above_the_middle_of_what_its_leaf_is_called() -> None:
    leaves = (Branch(Node("state", (), "longer")), Branch(Node("end", (), "x"), "$p$"))
    assert lines(BackupDiagram(Node("state", leaves, "s"))) == [
        "      ○ s",
        "   ┌──┴───┐",
        "   │      │ p",
        "   ○      □",
        "longer    x",
    ]


def test_a_long_label_of_a_root_is_not_cut_off() -> None:
    root = Node("state", (Branch(Node("action")),), "a root with a long label")
    assert any("a root with a long label" in line for line in lines(BackupDiagram(root)))


def _diagram(count: int) -> StateDiagram:
    arrows = tuple(Arrow("s", f"a{index}", "t", "1", "0") for index in range(count))
    return StateDiagram(("s", "t"), ("t",), arrows)


def test_a_state_diagram_with_one_arrow_too_many_is_left_to_the_table() -> None:
    assert scene(_diagram(MOST_ARROWS + 1)) is None
    assert scene(_diagram(3)) is not None


def _printed(block: Block) -> list[str]:
    console = Console(file=io.StringIO(), width=60, color_system=None)
    with console.capture() as capture:
        console.print(render((block,)))
    return [line.rstrip() for line in capture.get().splitlines() if line.strip()]


def test_a_column_of_numbers_stands_right_and_one_with_a_word_in_it_left() -> None:
    numbers = _printed(Table(("x",), (("$1$",), ("$10$",))))
    mixed = _printed(Table(("x",), (("$1$",), ("ten",))))
    assert numbers[-2].index("1") == numbers[-1].index("1") + 1
    assert mixed[-2].index("1") == mixed[-1].index("t")


def test_a_tree_of_24_arrows_is_drawn_and_of_25_not() -> None:
    assert len(lines(_diagram(24))) == 25  # a line for each, below that of the state
    assert lines(_diagram(25)) == []


def test_a_run_that_fits_is_not_torn_by_the_room_behind_its_last_action() -> None:
    run = Timeline(("$t = 0$", "$t = 1$", "$t = 2$"), ("rim", "floor", "rim"), ("climb", "drive", "drill"), ("1", "2"))
    assert plain([run]).count("○") == 3
    assert max(map(len, lines(run, 44))) <= 44


def test_words_beyond_the_end_of_a_row_stand_where_they_belong() -> None:
    assert _row({0: 1}, {5: "x₀"}) == "⠁    x₀"
