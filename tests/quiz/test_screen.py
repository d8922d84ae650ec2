"""What a quiz prints above its problems, for its keys, and for another problem of the same kind: R₁ = 4, R₀ = 3."""

from io import StringIO

import pytest
from rich.console import Console

import rldrill
from rldrill.exercise import Exercise
from rldrill.problems.identity import MAX_SEED
from rldrill.quiz.keys import HELP
from rldrill.quiz.recording import Recorder
from rldrill.quiz.screen import Screen, variant
from rldrill.quiz.session import Session

EXERCISE = rldrill.read({"family": "return", "given": {"gamma": "1/2", "rewards": [1, 4], "time": 1}})
#: Both answers, and Enter for the next problem.
RIGHT = ("4", "3", "")


#: V^π is 1 in s and 6 in t.
TWO_VALUES = rldrill.read({"family": "value-from-action-values", "given": {
    "values": {"s": {"l": 1, "r": 3}, "t": {"l": 2, "r": 6}}, "policy": {"s": {"l": 1}, "t": {"r": 1}}}})  # fmt: skip


def printed(
    session: Session, *typed: str, number: int = 1, plain: bool = False, seconds: float = 0.0, of: Exercise = EXERCISE
) -> list[str]:
    """The lines of a quiz of that problem, again and again, in which this is typed; then its input ends."""
    console = Console(file=StringIO(), width=100, color_system=None)
    lines = iter(typed)

    def line(*_: object) -> str:
        for text in lines:
            return text
        raise EOFError

    clock = iter([0.0, *[seconds] * 1000])
    recorder = Recorder(clock=lambda: next(clock))
    Screen(console, line, plain=plain, recorder=recorder).run([of] * number, session)
    assert isinstance(console.file, StringIO)
    return [text.rstrip() for text in console.file.getvalue().splitlines()]


def headers(session: Session, number: int, **more: float) -> list[str]:
    lines = printed(session, *RIGHT * number, number=number, **more)  # type: ignore[arg-type]
    return [line.removesuffix("  your own problem") for line in lines if line.startswith("Problem ")]


def test_a_bar_grows_with_the_problems() -> None:
    assert headers(Session(3), 3) == [
        "Problem 1 of 3  ━──  Return", "Problem 2 of 3  ━━─  Return", "Problem 3 of 3  ━━━  Return",
    ]  # fmt: skip


def test_more_than_forty_problems_have_no_bar() -> None:
    assert headers(Session(40), 1) == [f"Problem 1 of 40  ━{'─' * 39}  Return"]
    assert headers(Session(41), 1) == ["Problem 1 of 41  Return"]
    assert printed(Session(3), plain=True)[0] == "Problem 1 of 3  Return  your own problem"


@pytest.mark.parametrize(("seconds", "minute"), [(0, 1), (59, 1), (60, 2), (150, 3)])
def test_where_the_time_decides_the_minute_is_told(seconds: float, minute: int) -> None:
    assert headers(Session(None, minutes=5), 1, seconds=seconds) == [f"Problem 1 · minute {minute} of 5  Return"]
    assert headers(Session(None), 1) == ["Problem 1  Return"]


def test_half_an_answer_is_called_incomplete_not_misunderstood() -> None:
    screen = "\n".join(printed(Session(1), "s: 1", of=TWO_VALUES))
    assert "? Incomplete, and not counted: t is missing; give it too." in screen
    assert "Not understood" not in screen


def test_the_help_lists_every_key() -> None:
    lines = printed(Session(1), "?")
    for key, says in HELP:
        assert f"  {key}  {says}" in lines
    assert any("takes a quarter of the points, down to a quarter." in line for line in lines)


def test_the_problem_is_shown_again_when_it_is_asked_for() -> None:
    first = "An episode has the rewards r₁ = 1, r₂ = 4 and ends at T = 2. Here Rₜ = rₜ₊₁ + γrₜ₊₂ + … is the"
    assert printed(Session(1)).count(first) == 1
    assert printed(Session(1), "p").count(first) == 2


def test_begun_again_it_is_the_same_problem() -> None:
    again = printed(Session(1), "7", "4", "r", *RIGHT)
    assert sum(line.startswith("Problem 1 of 1") for line in again) == 2


def test_a_variant_is_the_next_seed_of_its_level_or_for_ones_own_problem_any_of_level_2() -> None:
    assert str(variant(rldrill.load("return/1/7")).id).startswith("return/1/8@")
    assert str(variant(rldrill.draw("return", 3, MAX_SEED - 1)).id).startswith("return/3/0@")
    assert str(variant(EXERCISE).id).startswith("return/2/")
    assert len({variant(EXERCISE).id for _ in range(3)}) > 1


#: In (2, 2) the centre (5, 6) is √(3² + 4²) = 5 away, the others 4 and 6: the features are 3/8, 1/2 and 1/4.
FEATURES = rldrill.read({"family": "piecewise-linear-rbf", "given": {
    "position": [2, 2], "centres": [[5, 6], [2, 6], [8, 2]], "width": 8, "theta": [-1, -2, 2]}})  # fmt: skip


def test_a_typical_mistake_that_the_family_does_not_list_is_told_and_goes_by_its_name(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("rldrill.diagnosis.AT_THE_PROMPT", None)  # however busy the machine is
    session = Session(1)
    lines = printed(session, "1/8, 1/2, 1/4", "", of=FEATURES)  # 1 − (3 + 4)/8
    assert "the root of the sum of squares, not the sum of the differences." in " ".join("\n".join(lines).split())
    assert [each.name for made in session.parts[0].made for each in made] == ["sum-of-differences"]
    assert any("rldrill quiz --mistake sum-of-differences" in line for line in lines)
