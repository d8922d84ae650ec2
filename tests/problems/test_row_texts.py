"""Rows and runs that are written as one text; how givens use them is in test_habits.py."""

import pytest

from promptness import at_once
from rldrill.problems.row_texts import row_of, rows_of, run_of, tables_of


@pytest.mark.parametrize(
    ("text", "rows"),
    [
        ("a 1\nb 2", [["a", "1"], ["b", "2"]]),
        ("a, 1; b, 2", [["a", "1"], ["b", "2"]]),
        ("arm;reward\na;1", [["a", "1"]]),
        ("reward\tarm\n1\ta", [["a", "1"]]),
        ("| arm | reward |\n| --- | ---: |\n| left arm | -1/2 |", [["left arm", "-1/2"]]),
        ("r 1\na 2", [["r", "1"], ["a", "2"]]),  # an arm called r
        # another header, a line that is too short, one row of three
        ("lever pay\na 1", None),
        ("a 1\nb", None),
        ("a 1 2", None),
        ("", None),
    ],
)
def test_rows(text: str, rows: list[list[str]] | None) -> None:
    assert rows_of(text, ["arm", "reward"]) == rows


def test_no_row_is_left_out() -> None:
    with pytest.raises(ValueError, match="row 3 has 3 entries, the header has 2; make them equal"):
        rows_of("arm reward\na 1\nb 2 toll\nc 3", ["arm", "reward"])


def test_tables_need_their_names() -> None:
    assert tables_of("a d\n1 2\n3 4", ["d", "a", "theta"]) == [{"a": "1", "d": "2"}, {"a": "3", "d": "4"}]
    assert tables_of("1 2\n3 4", ["d", "a"]) is None
    assert tables_of("a b\n1 2", ["d", "a"]) is None
    assert tables_of("a d", ["d", "a"]) is None


def test_a_row_that_is_a_table() -> None:
    assert row_of({"r": 1, "s": "A", "s'": "B"}, ["state", "next", "reward"]) == ["A", "B", 1]
    assert row_of({"r": 1, "s": "A"}, ["state", "next", "reward"]) is None
    assert row_of({"r": 1, "s": "A", "state": "B"}, ["state", "next", "reward"]) is None


def test_runs() -> None:
    assert run_of("A, 0, B, -1/2") == {"states": ["A", "B"], "rewards": ["0", "-1/2"]}
    assert run_of("A → go → 1 → B → stay") == {"states": ["A", "B"], "actions": ["go", "stay"], "rewards": ["1"]}
    assert run_of("A 1 2") is None
    assert run_of("1 2 3") is None


def test_texts_without_end_take_no_time() -> None:
    with at_once():
        for text in ("-" * 100_000 + "x", "a" + " " * 100_000, "|" * 100_000, "->" * 50_000):
            rows_of(text, ["arm", "reward"])
            run_of(text)
