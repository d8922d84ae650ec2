"""What is said at the end of a quiz: R₁ = 4 and R₀ = 1 + 1/2·4 = 3, a point each."""

import io
from fractions import Fraction

import pytest
from rich.console import Console

import rldrill
from rldrill.quiz.ending import ending, weakest
from rldrill.quiz.session import PartRecord, Record, Session, State

GIVEN = {"gamma": "1/2", "rewards": [1, 4], "time": 1}
EXERCISE = rldrill.read({"family": "return", "given": GIVEN})


def answered(first: str, second: str, exercise: rldrill.Exercise = EXERCISE) -> Record:
    """The answers to both parts, one after the other; words apart."""
    record = Record.of(exercise)
    for part, texts in zip(record.parts, (first, second), strict=True):
        for text in texts.split():
            record.answer(part, text)
    return record


def said(*records: Record, seconds: float = 75, due: int | None = None) -> list[str]:
    console = Console(file=io.StringIO(), width=100, color_system=None)
    with console.capture() as captured:
        for line in ending(Session(len(records), list(records)), seconds, due):
            console.print(line)
    return [line.rstrip() for line in captured.get().splitlines()]


def test_all_right_at_once() -> None:
    assert [part.points for part in EXERCISE.parts] == [1, 1]
    assert said(answered("4", "3"), due=3) == [
        "2 of 2 parts right, 2 of them at the first try.",
        "2 of 2 points in 1 min 15 s.",
        "Tomorrow, 3 due:  rldrill quiz",
    ]


def test_one_of_them_at_the_second_try() -> None:
    lines = said(answered("7 4", "3"), seconds=59.4)
    assert lines[:2] == ["2 of 2 parts right, 1 of them at the first try.", "1.75 of 2 points in 59 s."]
    assert "Weakest: Return." in lines
    assert lines[-1].split() == ["Tomorrow:", "rldrill", "quiz"]


def test_one_right_and_the_other_not_tried() -> None:
    assert said(answered("4", ""))[:2] == ["1 of 2 parts right, at the first try.", "1 of 2 points in 1 min 15 s."]
    assert said(answered("7 4", ""))[0] == "1 of 2 parts right."
    assert said(answered("7", ""))[0] == "0 of 2 parts right."


def test_a_mistake_is_told_as_often_as_it_was_made() -> None:
    # Without the discount: 1 + 4.
    lines = said(answered("4", "5"), answered("4", "5 5"))
    (told,) = (line for line in lines if line.startswith("  ✗"))
    assert told.startswith("  ✗ 3 times: ")
    assert any(line.split()[:5] == ["This", "mistake:", "rldrill", "quiz", "--mistake"] for line in lines)


def test_the_weakest_is_what_earned_the_smallest_share() -> None:
    drawn = rldrill.draw("td-zero", 1, 7)
    poor = Record.of(drawn)
    poor.answer(poor.parts[0], "-999")
    found = weakest(Session(2, [answered("4", "3"), poor]))
    assert found is not None
    assert (found.family, found.level, found.command) == ("td-zero", 1, "rldrill quiz td-zero --level 1 -n 5")
    assert weakest(Session(1, [answered("4", "3")])) is None
    other = weakest(Session(3, [answered("4", "3"), answered("7 4", "3"), Record.of(drawn)]))  # the last is not begun
    assert other is not None
    assert (other.title, other.command) == ("Return", "rldrill quiz return -n 5")


@pytest.mark.parametrize(
    ("wrong", "hints", "share"),
    [(0, 0, "1"), (1, 0, "3/4"), (0, 1, "3/4"), (1, 1, "1/2"), (2, 1, "1/4"), (3, 0, "1/4"), (5, 2, "1/4")],
)
def test_wrong_answers_and_hints_cost_a_quarter_each(wrong: int, hints: int, share: str) -> None:
    record = Record.of(EXERCISE)
    part = record.parts[0]
    part.hints = hints
    for text in [*["7"] * wrong, "4"]:
        record.answer(part, text)
    assert part.points == Fraction(share)
    part.given_up = True
    assert part.points == 0


@pytest.mark.parametrize(
    ("state", "given_up", "seen"),
    [(State.OPEN, False, False), (State.DONE, False, False), (State.SHOWN, False, True), (State.SKIPPED, False, True),
     (State.MISSED, False, True), (State.OPEN, True, True)],
)  # fmt: skip
def test_what_was_tried_and_seen_is_not_forgotten(state: State, given_up: bool, seen: bool) -> None:
    part = PartRecord(EXERCISE.parts[0], state=state, hints=2, before=3, given_up=given_up)
    again = part.again()
    assert (again.state, again.hints, again.before, again.given_up) == (State.OPEN, 2, 3, seen)


def test_yes_or_no_is_missed_at_once() -> None:
    given = {
        "mdp": {"transitions": [["a", "x", "end", 1, 1], ["a", "y", "end", 1, 2]], "terminal": ["end"]},
        "policy": {"a": "x"}, "other": {"a": "y"}, "values": {"a": 1}, "gamma": "1/2",
    }  # fmt: skip
    exercise = rldrill.read({"family": "policy-improvement-theorem", "given": given})
    record = Record.of(exercise)
    record.answer(record.parts[1], "maybe")
    assert record.parts[1].state is State.OPEN
    record.answer(record.parts[1], "no")
    assert record.parts[1].state is State.MISSED
