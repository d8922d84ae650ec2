"""A question fits the screen that there is: as airy as can be, and never wider than it."""

from io import StringIO

import pytest
from rich.console import Console

from rldrill.exercise import draw
from rldrill.problems.document import Beside, Block, Equation, Paragraph, Table
from rldrill.problems.mathematics import mathematics
from rldrill.problems.pictures import Arrow, StateDiagram
from rldrill.quiz.screen import Screen
from rldrill.quiz.session import Session
from rldrill.render.compact import Compact

TABLE = Table(("s", "s'"), (("cool", "warm"), ("warm", "cool")))
ARROWS = (Arrow("cool", "go", "warm", "1", "2"), Arrow("warm", "go", "cool", "1", "3"))
PICTURE = StateDiagram(("cool", "warm"), (), ARROWS)
MODEL = (Paragraph("The MDP has these transitions (on the arrows: probability, reward):"), Beside((TABLE, PICTURE)))


def shown(blocks: tuple[Block, ...], room: int, width: int = 80) -> list[str]:
    console = Console(file=StringIO(), width=width, height=room, color_system=None)
    with console.capture() as captured:
        console.print(Compact(blocks, 0))
    return captured.get().splitlines()


def test_where_there_is_room_nothing_is_left_out() -> None:
    text = "\n".join(shown(MODEL, 20))
    assert "on the arrows" in text
    assert "●" in text
    assert "──" in text


def test_where_the_picture_does_not_fit_the_table_stands_alone() -> None:
    assert shown(MODEL, 5, width=32) == [
        "The MDP has these transitions:",
        "   s      s'",
        "  ─────────────",
        "   cool   warm",
        "   warm   cool",
    ]


def test_tables_that_do_not_fit_side_by_side_move_together_before_they_lose_their_lines() -> None:
    assert [len(shown((TABLE, TABLE), room, width=25)) for room in (9, 8)] == [9, 8]
    assert [line for line in shown((TABLE, TABLE), 8, width=25) if not line] == []


def test_matrices_stand_side_by_side() -> None:
    blocks = tuple(Equation(mathematics(name), (mathematics("3"),), ("=",)) for name in ("A", "B", "C"))
    assert len(shown(blocks, 5)) == 5
    (line,) = shown(blocks, 1)
    assert line.split() == ["A", "=", "3", "B", "=", "3", "C", "=", "3"]


def test_what_is_said_of_tables_side_by_side_fills_the_width_and_no_more() -> None:
    # Both have 26 columns at least and 3 between them; of 61 the 6 that are left make it 29 for each.
    said = Paragraph("aa " * 18 + "bb:")
    lines = shown((said, TABLE, said, TABLE), 8, width=61)
    wide = " ".join(["aa"] * 10)
    assert lines[0] == f"{wide}   {wide}"
    assert len(wide) == 29
    assert max(map(len, lines)) == 61


def test_the_closest_way_is_two_columns_in_reading_order() -> None:
    lines = shown((Paragraph("Before."), TABLE, Paragraph("Then:"), TABLE), 3)
    assert lines == [
        "Before.          Then:",
        "   s      s'        s      s'",
        "   cool   warm      cool   warm",
        "   warm   cool      warm   cool",
    ]


#: One level of a family of every topic, among them the longest that fit: seeds by which nothing was chosen.
SAMPLE = ("return/1", "policy-value/2", "expected-return/2", "policy-improvement/2", "td-lambda-backward/2",
          "double-q-learning/2", "reinforce/1", "lqr-gain/2", "lqr-reward/3", "bayes-filter/1",
          "feature-expectations/2", "semi-gradient-td/2", "forward-kinematics/1", "backup-diagram-name/1")  # fmt: skip


def first_screen(name: str, width: int, height: int) -> list[str]:
    family, _, level = name.partition("/")
    console = Console(file=StringIO(), width=width, height=height, color_system=None, highlight=False)
    with console.capture() as captured:
        Screen(console, _ends).run([draw(family, int(level), 5)], Session(10))
    return captured.get().partition("\n\nNothing was answered")[0].splitlines()


def _ends(*_: str) -> str:
    raise EOFError


def test_nine_of_ten_problems_fit_the_smallest_usual_terminal() -> None:
    heights = [len(first_screen(name, 80, 24)) for name in SAMPLE]
    assert sum(height < 24 for height in heights) >= 0.9 * len(heights), heights


@pytest.mark.parametrize(("width", "height"), [(60, 20), (100, 32), (140, 40)])
def test_nothing_is_wider_than_the_screen_or_a_page(width: int, height: int) -> None:
    for name in ("expected-return/2", "lqr-gain/2", "double-q-learning/2"):
        assert max(map(len, first_screen(name, width, height))) <= min(width, 100)
