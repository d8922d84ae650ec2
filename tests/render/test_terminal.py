"""Where the console writes, and how wide."""

import pytest

from rldrill.problems.document import Equation, Paragraph
from rldrill.problems.mathematics import Accent, operator, row, variable
from rldrill.render.mathematics.unicode import GLUE, inline
from rldrill.render.terminal import PIPED, console, plain, wrapped


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


def test_a_formula_is_broken_only_where_it_has_no_room_and_a_list_behind_its_commas() -> None:
    reward = inline("It earns $r(s_t, a_t) = −(s_t^⊤ Q_t s_t + a_t^⊤ R_t a_t)$ then.", glued=True)
    assert wrapped(reward, 40) == ["It earns", "r(sₜ, aₜ) = −(sₜᵀQₜsₜ + aₜᵀRₜaₜ) then."]
    assert max(map(len, wrapped(reward, 25))) <= 25
    numbers = ", ".join(f"{letter}(1, 2) = 1" for letter in "abcde")
    assert wrapped(inline(f"With ${numbers}$.", glued=True), 40) == [
        "With a(1, 2) = 1, b(1, 2) = 1,",
        "c(1, 2) = 1, d(1, 2) = 1, e(1, 2) = 1.",
    ]


def test_a_formula_of_48_signs_stays_in_one_piece_and_a_longer_one_may_be_broken() -> None:
    short, long = "1000" + " + a" * 11, "a" + " + a" * 12
    assert (len(short), len(long)) == (48, 49)
    assert inline(f"${short}$", glued=True) == short.replace(" ", GLUE)
    assert inline(f"${long}$", glued=True) == long


def test_a_word_that_is_too_long_is_not_broken() -> None:
    name = "a" * 41
    assert wrapped(f"It is in {name} now", 40) == ["It is in", name, "now"]
    assert wrapped(f"{name[:20]}-{name[:20]}", 40) == [f"{name[:20]}-{name[:20]}"]


def test_a_document_that_is_written_as_text_is_a_hundred_signs_wide() -> None:
    text = "a" * 49 + " " + "b" * 50
    assert plain((Paragraph(text),)) == text
    assert plain((Paragraph(text + "b"),)).splitlines() == ["a" * 49, "b" * 51]


def test_brackets_and_colons_of_a_text_are_no_commands(capsys: pytest.CaptureFixture[str]) -> None:
    text = "[bold] [red]states[/red] :warning: 12"
    assert plain((Paragraph(text),)) == text
    console().print(text)
    assert capsys.readouterr().out.strip() == text
