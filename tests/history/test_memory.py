"""What is remembered: how one problem is rated, and what FSRS makes of the log."""

from collections.abc import Iterator
from datetime import UTC, datetime, timedelta

import pytest
from fsrs import Rating
from msgspec.structs import replace

from rldrill.history.attempts import Attempt
from rldrill.history.memory import Skill, rated, remembered

NOW = datetime(2026, 11, 25, 8, tzinfo=UTC)
DAY = timedelta(days=1)


def sitting(name: str, when: datetime, *outcomes: str, family: str = "td-zero", parts: int = 1) -> list[Attempt]:
    """Attempts at the parts ``a``, ``b``, …: ``right``, ``wrong right`` for a second try, ``hint right``.

    ``skipped right`` is what was typed off, and ``missed right`` what was the only other answer: they earn nothing.
    """
    made: list[Attempt] = []
    for label, words in zip("abcdef", outcomes, strict=False):
        tries = hints = seen = 0
        for word in words.split():
            if word == "hint":
                hints += 1
                continue
            outcome, credit = "wrong" if word == "missed" else word, word in ("right", "follow-through") and not seen
            id_ = f"{name}{len(made)}"
            made.append(
                Attempt(id_, when, name, family, 1, 7, 1, label, parts, "", outcome, (), hints, tries, 9.0, credit)
            )
            tries += word != "skipped"
            seen += word in ("skipped", "missed")
    return made


@pytest.mark.parametrize(
    ("outcomes", "parts", "rating"),
    [
        (("right",), 1, Rating.Good),
        (("right", "follow-through"), 2, Rating.Good),
        (("wrong right",), 1, Rating.Hard),
        (("hint right", "right"), 2, Rating.Hard),
        (("wrong",), 1, Rating.Again),
        (("right", "skipped"), 2, Rating.Again),
        (("right", "wrong skipped", "right"), 3, Rating.Again),
        (("right", "close"), 3, Rating.Again),
        (("skipped right",), 1, Rating.Again),
        (("right", "missed right"), 2, Rating.Again),
        (("skipped right right",), 1, Rating.Again),
        (("right",), 2, None),  # left in the middle, all well so far
    ],
)
def test_how_a_problem_is_rated(outcomes: tuple[str, ...], parts: int, rating: Rating | None) -> None:
    assert rated(sitting("one", NOW, *outcomes, parts=parts)) is rating


def test_what_was_typed_off_is_not_right_at_the_first_try_and_not_mastered() -> None:
    attempts = sitting("one", NOW, "skipped right")
    assert [attempt.first_time for attempt in attempts] == [False, False]
    (memory,) = remembered(attempts).values()
    assert not memory.mastered
    assert memory.due == NOW + DAY / 2


def test_a_problem_is_reviewed_when_its_last_part_is_answered() -> None:
    first, last = sitting("one", NOW, "right", "right", parts=2)
    later = replace(last, time=NOW + timedelta(minutes=40))
    (memory,) = remembered([later, first]).values()
    assert memory.last == NOW + timedelta(minutes=40)


def test_a_clock_that_is_set_back_makes_no_wrong_answer_of_a_right_one() -> None:
    wrong, right = sitting("one", NOW, "wrong right")
    (memory,) = remembered([wrong, replace(right, time=NOW - timedelta(hours=1))]).values()
    assert memory.ratings == (Rating.Hard,)
    assert memory.last == NOW


def test_what_went_well_comes_after_days_and_what_went_wrong_on_the_next_day() -> None:
    (well,) = remembered(sitting("one", NOW, "right")).values()
    (badly,) = remembered(sitting("one", NOW, "wrong")).values()
    assert well.due >= NOW + DAY
    assert well.mastered
    assert badly.due == NOW + DAY / 2
    assert badly.lapses == 1
    assert badly.recall(NOW + DAY) == 0
    assert 0.5 < well.recall(NOW + 2 * DAY) < well.recall(NOW + DAY) < 1


def test_intervals_grow_as_it_goes_well() -> None:
    memories = remembered(sitting("0", NOW, "right"))
    waited = []
    for number in range(1, 5):
        (memory,) = memories.values()
        waited.append(memory.due - memory.last)
        memories = remembered(sitting(str(number), memory.due, "right"), memories)
    assert waited == sorted(waited)
    assert waited[0] < waited[-1]


def log() -> Iterator[Attempt]:
    for day in range(9):
        yield from sitting(f"{day} td", NOW + day * DAY, "wrong right" if day % 3 else "right")
        yield from sitting(f"{day} sarsa", NOW + day * DAY, "skipped" if day % 4 else "right", family="sarsa")


def test_the_log_is_the_truth() -> None:
    attempts = list(log())
    at_once = remembered(attempts)
    assert set(at_once) == {Skill("td-zero", 1), Skill("sarsa", 1)}
    for day in range(9):  # problem by problem or all at once, it is the same
        before = [attempt for attempt in attempts if attempt.time < NOW + day * DAY]
        assert remembered(attempts[len(before) :], remembered(before)) == at_once


def test_two_problems_that_are_answered_at_once_are_two_reviews() -> None:
    one, two = sitting("one", NOW, "right", "right", parts=2), sitting("two", NOW, "right", "wrong", parts=2)
    mixed = [one[0], two[0], one[1], two[1]]
    (memory,) = remembered(mixed).values()
    assert sorted(memory.ratings) == [Rating.Again, Rating.Good]


def test_problems_from_outside_are_no_skill() -> None:
    assert remembered(replace(attempt, level=None) for attempt in sitting("one", NOW, "right")) == {}
