"""Which problems a quiz asks: those that are named, then what is drawn; as long as there is time."""

from collections.abc import Iterator
from itertools import count, islice

import pytest

import rldrill
from rldrill.history.memory import Skill
from rldrill.problems.errors import UsageError
from rldrill.quiz.planning import Plan
from rldrill.quiz.questions import planned, questions, timed
from rldrill.quiz.recording import Recorder, utc_now

NAMED = ("td-zero/1/7", "return/1/3")


def asked(names: tuple[str, ...], number: int) -> tuple[list[str], int]:
    exercises, total = questions(names, number, 2, lambda: 5)
    return [str(each.id).partition("@")[0] for each in exercises], total


def test_problems_that_are_named_are_asked_and_no_others() -> None:
    assert asked(NAMED, 10) == (list(NAMED), 2)


def test_named_problems_come_first_and_draws_fill_the_number() -> None:
    found, total = asked(("sarsa", *NAMED), 4)
    assert (found[:2], total, len(found)) == (list(NAMED), 4, 4)
    assert all(each.startswith("sarsa/2/") for each in found[2:])


def test_more_problems_that_are_named_than_are_wanted_are_all_asked() -> None:
    assert asked(("sarsa", *NAMED), 1) == (list(NAMED), 2)


def test_a_wrong_name_is_told_before_a_seed_is_asked_for() -> None:
    with pytest.raises(UsageError, match="sarsaa"):
        questions(("sarsaa", "td-zero/1/7"), 3, None, lambda: pytest.fail("no seed is needed"))


def test_what_is_planned_is_drawn_anew_each_time() -> None:
    skill = Skill("td-zero", 2)
    seeds = count(3)
    plan = Plan((skill,), [], 10, utc_now())
    exercises = planned(plan, Recorder(), utc_now, lambda: next(seeds))
    assert [str(each.id).partition("@")[0] for each in islice(exercises, 2)] == ["td-zero/2/3", "td-zero/2/4"]


def test_what_is_begun_within_the_minutes_is_asked() -> None:
    clock = iter([0.0, 0.0, 119.0, 120.0])
    recorder = Recorder(clock=lambda: next(clock))
    endless: Iterator[rldrill.Exercise] = (rldrill.draw("return", 1, seed) for seed in count())
    assert len(list(timed(endless, 2, recorder))) == 2
    assert list(timed(iter(()), 2, Recorder())) == []
