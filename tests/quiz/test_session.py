"""What a quiz keeps of the answers to a problem: R₁ = 4 and R₀ = 1 + 1/2·4 = 3."""

from fractions import Fraction

import pytest
from fsrs import Rating

import rldrill
from rldrill.history.attempts import Attempt
from rldrill.history.memory import rated
from rldrill.quiz.recording import Recorder
from rldrill.quiz.session import PartRecord, Record, Session, State

EXERCISE = rldrill.read({"family": "return", "given": {"gamma": "1/2", "rewards": [1, 4], "time": 1}})
TWO_VALUES = {"family": "value-from-action-values", "given": {
    "values": {"s": {"l": 1, "r": 3}, "t": {"l": 2, "r": 6}}, "policy": {"s": {"l": 1}, "t": {"r": 1}}}}  # fmt: skip


def record() -> tuple[Record, PartRecord, PartRecord]:
    fresh = Record.of(EXERCISE)
    first, second = fresh.parts
    return fresh, first, second


def test_a_right_answer_is_a_first_try() -> None:
    fresh, first, _ = record()
    fresh.answer(first, "4")
    assert first.state is State.DONE
    assert first.first_time
    assert first.points == 1


def test_a_hint_spoils_the_first_try() -> None:
    fresh, first, _ = record()
    first.hints = 1
    fresh.answer(first, "4")
    assert first.state is State.DONE
    assert not first.first_time


def test_a_wrong_answer_before_spoils_the_first_try() -> None:
    fresh, first, _ = record()
    fresh.answer(first, "7")
    assert first.state is State.OPEN
    fresh.answer(first, "4")
    assert first.tries == 2
    assert not first.first_time


def test_what_cannot_be_read_costs_no_try() -> None:
    fresh, first, _ = record()
    fresh.answer(first, "?!")
    assert first.tries == 0
    assert first.points == 0
    fresh.answer(first, "4")
    assert first.first_time


def test_what_is_left_out_is_asked_for_and_costs_no_try() -> None:
    fresh = Record.of(rldrill.read(TWO_VALUES))
    (part, *_) = fresh.parts  # V^π is 1 and 6
    verdict = fresh.answer(part, "s: 1").verdict
    assert verdict is not None
    assert (verdict.counts, verdict.missing) == (False, "t is missing; give it too.")
    assert (part.tries, part.points) == (0, 0)
    fresh.answer(part, "s: 1, t: 6")
    assert part.first_time


def test_the_points_are_those_of_the_answer_that_was_given_last() -> None:
    fresh = Record.of(rldrill.read(TWO_VALUES))
    (part, *_) = fresh.parts  # V^π is 1 and 6
    fresh.answer(part, "s: 1, t: 5")
    assert part.points == Fraction(part.part.points, 2)
    fresh.answer(part, "s: 0, t: 0")
    assert part.points == 0
    fresh.answer(part, "?!")
    assert part.points == 0
    fresh.answer(part, "s: 1, t: 6")
    assert part.points == Fraction(part.part.points, 2)  # two wrong answers before take a quarter each


def test_a_later_part_follows_the_earlier_answer_that_was_given_last() -> None:
    fresh, first, second = record()
    fresh.answer(first, "100")
    fresh.answer(first, "8")
    assert not fresh.answer(second, "51").accepted  # 1 + 1/2·100
    assert fresh.answer(second, "5").accepted  # 1 + 1/2·8


def test_a_session_counts_the_problems_that_were_begun() -> None:
    begun, _, second = record()
    begun.answer(second, "3")
    unread, first, _ = record()
    unread.answer(first, "?!")  # not understood, and not counted
    assert Session(3, [begun, unread, Record.of(EXERCISE)]).parts == begun.parts


def test_what_the_diagnosis_finds_is_kept_where_no_listed_mistake_gives_the_answer(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("rldrill.diagnosis.AT_THE_PROMPT", None)  # however busy the machine is
    kept: list[Attempt] = []
    recorder = Recorder(kept.append)
    longer = {"family": "return", "given": {"gamma": "1/2", "rewards": [1, 4, 3], "time": 1}}
    # R₁ = 4 + 3/2 = 11/2 with its sign turned; 1/2·11/2, with its first reward discounted, is a listed mistake.
    for typed in ("-11/2", "11/4"):
        fresh = Record.of(rldrill.read(longer))
        fresh.answer(fresh.parts[0], typed)
        recorder.ended(fresh, fresh.parts[0])
    assert [attempt.misconceptions for attempt in kept] == [("sign",), ("first-reward-discounted",)]


def test_what_was_looked_up_and_typed_off_is_asked_again_on_the_next_day() -> None:
    kept: list[Attempt] = []
    recorder = Recorder(kept.append)
    fresh, first, _ = record()
    first.state = State.SHOWN
    recorder.ended(fresh, first)
    fresh = fresh.again()
    for part, typed in zip(fresh.parts, ("4", "3"), strict=True):
        fresh.answer(part, typed)
        recorder.ended(fresh, part)
    assert [attempt.credit for attempt in kept] == [0, 0, 1]
    assert rated(kept) is Rating.Again
