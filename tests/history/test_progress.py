"""Progress: what is worked out from the log, and how it looks."""

import io
import json
from collections.abc import Iterator
from datetime import UTC, date, datetime, timedelta
from pathlib import Path

import pytest
from msgspec.structs import replace
from rich.console import Console
from typer.testing import CliRunner

from rldrill.cli import app
from rldrill.history.attempts import Attempt
from rldrill.history.log import append
from rldrill.history.memory import Skill
from rldrill.history.place import HistoryError
from rldrill.history.progress import Day, Mistake, Progress, Share, progress
from rldrill.quiz.mistakes import called
from rldrill.quiz.progress import shown
from rldrill.solutions.diagnosis import weights
from zones import zone

NOW = datetime(2026, 11, 25, 8, tzinfo=UTC)
DAY = timedelta(days=1)
GROUPS = {"bellman": [Skill("policy-value", 1), Skill("policy-value", 2)], "td": [Skill("td-zero", 1)]}


def log() -> Iterator[Attempt]:
    """Yesterday policy-value/1 at once, td-zero/1 at the second try; three days ago td-zero/1 given up."""
    first = Attempt(
        "1", NOW - DAY, "x", "policy-value", 1, 7, 1, "a", 1, "3", "right", (), hints=0, retries=0, seconds=30, credit=1
    )
    yield first
    td = replace(first, sitting="y", family="td-zero", time=NOW - DAY + timedelta(minutes=5))
    yield replace(td, id="2", outcome="misconception", misconceptions=("forgot-gamma",), credit=0, seconds=50)
    yield replace(td, id="3", retries=1, time=td.time + timedelta(minutes=1), seconds=10)
    yield replace(td, id="4", sitting="z", time=NOW - 3 * DAY, outcome="skipped", credit=0, seconds=90)
    yield replace(first, id="5", sitting="w", family="bandit", time=NOW - 9 * DAY)  # not among the groups


def test_what_is_worked_out() -> None:
    found = progress(tuple(log()), GROUPS, NOW)
    bellman, td = found.shares
    assert (bellman.seen, bellman.of, bellman.answers, bellman.right, bellman.parts) == (1, 2, 1, 1, 1)
    # One of two skills was asked, and would be right with a probability between 1/2 and 1.
    assert 0.25 < bellman.mastery < 0.5
    assert (td.seen, td.of, td.answers, td.right, td.parts, td.seconds) == (1, 1, 3, 0, 2, 50)
    assert [(day.day, day.answers, day.right, day.parts) for day in found.days] == [
        (date(2026, 11, 22), 1, 0, 1),
        (date(2026, 11, 24), 3, 1, 2),
    ]
    assert found.mistakes == (Mistake("forgot-gamma", "td-zero", 1),)
    assert found.streak == 1
    assert sum(found.due) == 2


def test_a_streak_ends_with_a_day_without_answers() -> None:
    attempts = [replace(next(log()), id=str(days), time=NOW - days * DAY) for days in (0, 1, 2, 4)]
    assert progress(attempts, GROUPS, NOW).streak == 3
    assert progress(attempts, GROUPS, NOW + DAY).streak == 3
    assert progress(attempts, GROUPS, NOW + 2 * DAY).streak == 0


@pytest.mark.parametrize("width", [60, 80, 120])
def test_it_fits_the_terminal(width: int) -> None:
    screen = Console(width=width, record=True, markup=False, highlight=False)
    screen.print(shown(progress(tuple(log()), GROUPS, NOW)))
    text = screen.export_text()
    assert max(map(len, text.splitlines())) <= width
    for piece in (
        "bellman",
        "1/2 seen",
        "33 % of the questions right",
        "1 ×  forgot gamma",
        "quiz --mistake forgot-gamma",
    ):
        assert piece in text


def test_where_it_is_narrow_the_bars_are_shorter_and_nothing_else() -> None:
    screen = Console(width=60, record=True, markup=False, highlight=False)
    groups = {"function-approximation": GROUPS["bellman"], "temporal-difference": GROUPS["td"]}
    screen.print(shown(progress(tuple(log()), groups, NOW)))
    text = screen.export_text()
    for piece in ("function-approximation  ", "  47 %  1/2 seen  30 s", " 100 %  1/1 seen  50 s"):
        assert piece in text


def test_where_it_is_narrower_still_a_row_is_a_line_and_keeps_its_numbers() -> None:
    screen = Console(width=40, record=True, markup=False, highlight=False)
    groups = {"function-approximation": GROUPS["bellman"], "temporal-difference": GROUPS["td"]}
    screen.print(shown(progress(tuple(log()), groups, NOW)))
    text = " ".join(screen.export_text().split())
    for piece in ("function-approximation, 47 %, 1/2 seen, 30 s", "1 ×, forgot gamma", "half within"):
        assert piece in text


def test_a_database_that_cannot_be_read_is_named(tmp_path: Path) -> None:
    (tmp_path / "history.db").write_text("a shopping list " * 100)
    result = CliRunner().invoke(app, ["stats"], env={"RLDRILL_HOME": str(tmp_path)})
    assert isinstance(result.exception, HistoryError)
    assert f"{tmp_path / 'history.db'}: file is not a database; move it elsewhere, and a new one is begun." in str(
        result.exception
    )


def test_every_kind_of_cause_has_words_of_its_own() -> None:
    kinds = {*weights.IDEAS, *weights.VALUES, *weights.INSIDE, *weights.PROCEDURE, *weights.ANSWERS}
    words = {kind: called(kind) for kind in kinds}
    assert [kind for kind in words if " " not in words[kind]] == []
    assert len(set(words.values())) == len(words)
    assert called("forgot-gamma") == "forgot gamma"  # a listed mistake


def stats(folder: Path, *arguments: str) -> str:
    return CliRunner().invoke(app, ["stats", *arguments], env={"RLDRILL_HOME": str(folder)}).output


def test_the_command(tmp_path: Path) -> None:
    assert "There are no answers yet: 'rldrill quiz' asks the first questions." in stats(tmp_path)
    append(tmp_path / "history.db", log())
    assert '"answers": 5' in stats(tmp_path, "--json")
    assert "policy-value" in stats(tmp_path, "bellman")
    heads = {".svg": b"<svg", ".png": b"\x89PNG", ".html": b"<!DOCTYPE html>", ".txt": b"5 answers on 3 days"}
    for ending, head in heads.items():
        stats(tmp_path, "-o", str(tmp_path / f"progress{ending}"))
        assert (tmp_path / f"progress{ending}").read_bytes().startswith(head)


def test_a_day_is_called_as_it_was_then_whatever_the_season_is_now(tmp_path: Path) -> None:
    # In Berlin 22:30 of Greenwich is half past midnight in summer, and half past eleven in winter.
    late, later = (datetime(2026, month, 14, 22, 30, tzinfo=UTC) for month in (1, 7))
    first = next(log())
    append(tmp_path / "history.db", [replace(first, time=late), replace(first, id="2", time=later)])
    with zone("Europe/Berlin"):
        days = json.loads(stats(tmp_path, "--json"))["days"]
    assert [each["day"] for each in days] == ["2026-01-14", "2026-07-15"]


MONDAY = date(2026, 11, 23)


def day(number: int, answers: int, right: int = 0, seconds: float = 30) -> Day:
    return Day(MONDAY + number * DAY, answers, right, 1, seconds)


def screen(found: Progress) -> list[str]:
    console = Console(file=io.StringIO(), width=92, color_system=None)
    with console.capture() as captured:
        console.print(shown(found))
    return [line.rstrip() for line in captured.get().splitlines()]


def test_days_of_several_years_have_their_year() -> None:
    found = Progress((), (day(-400, 1), day(0, 1)), (0,) * 8, (), 0)
    assert [line[:15] for line in screen(found) if "1 answer" in line] == ["Sun 19 Oct 2025", "Mon 23 Nov 2026"]


def test_the_whole_of_it_as_one_would_draw_it() -> None:
    shares = (Share("td", 0.5, 1, 2, 3, 1, 2, 89.4), Share("bellman", 0.0, 0, 3, 0, 0, 0, None))
    mistake = Mistake("forgot-gamma", "td-zero", 2)
    found = Progress(shares, (day(0, 1), day(1, 20, 1, 90)), (2, 3, 1, 0, 0, 0, 1, 0), (mistake,), 2)
    assert screen(found) == [
        "21 answers on 2 days; 50 % of the questions right at the first try; 2 days in a row.",
        "",
        "What you would get right today",
        "td       ━━━━━━━━━━            50 %  1/2 seen  89 s",
        "bellman                         0 %  0/3 seen",
        "",
        "Due",
        "2 now, 3 more tomorrow, 2 more in the days after, up to a week.",
        "",
        "Day by day",
        "Mon 23 Nov                          0 %    1 answer   half within 30 s",
        "Tue 24 Nov  ━━━━━━━━━━━━━━━━━━━━  100 %  20 answers  half within 2 min",
        "",
        "Mon  · · · · · · · · · · · ░",
        "Tue  · · · · · · · · · · · █",
        *(f"{name}  · · · · · · · · · · ·" for name in ("Wed", "Thu", "Fri", "Sat", "Sun")),
        "",
        "Your mistakes",
        "2 ×  forgot gamma  td-zero",
        "To drill one of them alone:",
        "  rldrill quiz --mistake forgot-gamma",
        "",
    ]


def test_a_day_is_darker_the_more_was_answered() -> None:
    # Four shades: the next one begins with every third of twenty answers.
    answers = (1, 6, 7, 13, 14, 19, 20, 99)
    found = Progress((), tuple(day(7 * week, each) for week, each in enumerate(answers)), (0,) * 8, (), 1)
    lines = screen(found)
    assert lines[0] == "179 answers on 8 days; 0 % of the questions right at the first try."
    assert "Nothing in the next days; new problems wait." in lines
    assert "Mon  · · · · ░ ░ ▒ ▒ ▓ ▓ █ █" in lines
    assert sum(" Nov" in line or " Dec" in line or " Jan" in line for line in lines) == 7  # the last days
