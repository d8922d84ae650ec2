"""Where the console writes, and how wide."""

import pytest

from rldrill.problems.document import Equation
from rldrill.problems.mathematics import Accent, operator, row, variable
from rldrill.render.terminal import PIPED, console, plain


def test_it_writes_to_the_output_unless_it_is_told_to_complain(capsys: pytest.CaptureFixture[str]) -> None:
    console().print("an answer")
    console(stderr=True).print("a complaint")
    captured = capsys.readouterr()
    assert captured.out == "an answer\n"
    assert captured.err == "a complaint\n"


def test_a_pipe_is_wide_enough_and_columns_decide(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("COLUMNS", raising=False)
    assert console().width == PIPED
    monkeypatch.setenv("COLUMNS", "72")
    assert console().width == 72


def test_a_hat_takes_no_place_of_its_own() -> None:
    equation = Equation(
        Accent(variable("M"), "hat"), (row(*map(variable, "abcdefgh"), operator("+"), variable("i")),), ("=",)
    )
    assert plain([equation]).splitlines() == ["  M̂ = abcdefgh + i"]
