"""What is asked next: the sheet's order, what is earned, what is forgotten, and all of it before the exam."""

from collections import Counter
from collections.abc import Callable
from datetime import UTC, date, datetime, timedelta
from itertools import count, pairwise

import pytest

from rldrill.commands import quiz as command
from rldrill.history.attempts import Attempt
from rldrill.history.memory import Skill
from rldrill.history.zone import LOCAL
from rldrill.problems.catalogue import topics
from rldrill.problems.errors import UsageError
from rldrill.quiz.planning import Plan, skills
from zones import zone

NOW = datetime(2026, 11, 25, 8, tzinfo=UTC)
DAY, MINUTE = timedelta(days=1), timedelta(minutes=1)
TOPIC = {family: topic for topic, names in topics().items() for family in names}
ORDER = skills()
_numbers = count()


def answered(skill: Skill, when: datetime, outcome: str = "right", mistake: str = "") -> Attempt:
    name = str(next(_numbers))
    mistakes = (mistake,) if mistake else ()
    return Attempt(
        name, when, name, skill.family, skill.level, 7, 1, "a", 1, "", outcome, mistakes, 0, 0, 60.0, outcome == "right"
    )


def studied(
    order: tuple[Skill, ...],
    days: int,
    number: int,
    *,
    exam: date | None = None,
    outcome: Callable[[Skill], str] = lambda _: "right",
) -> list[Attempt]:
    """Somebody who does so many problems every day."""
    log: list[Attempt] = []
    for day in range(days):
        now = NOW + day * DAY
        plan, today = Plan(order, log, number, now, exam), list[Attempt]()
        for _ in range(number):
            skill = plan.next(now)
            now += 3 * MINUTE
            today.append(answered(skill, now, outcome(skill)))
            plan.learn(today)
        log += today
    return log


def test_the_first_problem_is_of_level_1_and_of_the_first_topic() -> None:
    first = Plan(ORDER, [], 10, NOW).next(NOW)
    assert first.level == 1
    assert TOPIC[first.family] == "fundamentals"


def test_topics_are_mixed_and_nothing_comes_twice_on_the_first_day() -> None:
    asked = [Skill(attempt.family, attempt.level or 0) for attempt in studied(ORDER, 1, 8)]
    assert len(set(asked)) == 8
    assert all(TOPIC[one.family] != TOPIC[two.family] for one, two in pairwise(asked))
    assert {skill.level for skill in asked} == {1}


def test_a_level_comes_after_the_one_below_went_well() -> None:
    mastered: set[Skill] = set()
    log = studied(ORDER, 30, 12, outcome=lambda skill: "right" if len(skill.family) % 3 else "wrong")
    for attempt in log:
        assert attempt.level is not None
        below = Skill(attempt.family, attempt.level - 1)
        assert attempt.level == 1 or below in mastered
        if attempt.right:
            mastered.add(Skill(attempt.family, attempt.level))
    assert {skill.level for skill in mastered} == {1, 2, 3}


def test_what_is_due_comes_before_what_is_new_but_something_is_new_each_day() -> None:
    log = [answered(skill, NOW - 60 * DAY) for skill in ORDER[:30]]
    plan = Plan(ORDER, log, 10, NOW)
    asked = [plan.next(NOW) for _ in range(10)]
    assert sum(skill in ORDER[:30] for skill in asked) == 8


def test_the_least_remembered_comes_first() -> None:
    one, two = Skill("td-zero", 1), Skill("policy-value", 1)
    log = [answered(one, NOW - 40 * DAY), answered(two, NOW - 30 * DAY)]
    assert Plan((one, two), log, 10, NOW).due(NOW) == [one, two]
    assert Plan((two, one), log, 10, NOW).due(NOW) == [one, two]


def test_what_goes_wrong_twice_is_asked_a_level_lower() -> None:
    easy, hard = Skill("td-zero", 1), Skill("td-zero", 2)
    log = [answered(easy, NOW - 9 * DAY), answered(hard, NOW - 2 * DAY, "wrong")]
    assert Plan(ORDER, log, 10, NOW).due(NOW)[0] == hard
    log.append(answered(hard, NOW - DAY, "wrong"))
    assert Plan(ORDER, log, 10, NOW).due(NOW)[0] == easy
    log.append(answered(easy, NOW - DAY + MINUTE))
    assert Plan(ORDER, log, 10, NOW).due(NOW)[0] == hard


def test_what_goes_wrong_comes_again_on_the_next_day() -> None:
    plan = Plan(ORDER, [], 10, NOW)
    wrong = plan.next(NOW)
    plan.learn([answered(wrong, NOW, "wrong")])
    assert plan.next(NOW + 3 * MINUTE) != wrong
    assert wrong not in plan.due(NOW + 60 * MINUTE)
    assert wrong in plan.due(NOW + DAY)


@pytest.mark.parametrize("hours", [8, 23])
@pytest.mark.parametrize(("days", "number"), [(21, 15), (10, 20)])
def test_everything_is_seen_and_seen_again_before_the_exam(days: int, number: int, hours: int) -> None:
    order = skills([*topics()["bellman"], *topics()["dynamic_programming"]])  # 48 skills
    exam = (NOW.replace(hour=hours) + days * DAY).date()
    log = studied(order, days, number, exam=exam)
    seen = Counter(Skill(attempt.family, attempt.level or 0) for attempt in log)
    last = {Skill(attempt.family, attempt.level or 0): attempt.time for attempt in log}
    assert set(seen) == set(order)
    assert min(seen.values()) >= 2
    assert all(exam - when.date() <= timedelta(days=8) for when in last.values())


@pytest.mark.parametrize(("days", "new"), [(3, 4), (6, 2), (2, 5)])
def test_what_was_never_asked_is_shared_out_over_the_days_before_the_last_week(days: int, new: int) -> None:
    order = tuple(skill for skill in ORDER if skill.level == 1)[:32]
    log = [answered(skill, NOW - 60 * DAY) for skill in order[:20]]  # these are due, more than are asked
    exam = (NOW + (days + 8) * DAY).date()
    plan = Plan(order, log, 10, NOW, exam)
    asked = [plan.next(NOW) for _ in range(10)]
    assert sum(skill in order[20:] for skill in asked) == new  # 12 by the days, but at most half of the 10


def test_without_an_exam_intervals_are_longer() -> None:
    skill = Skill("td-zero", 1)
    log = [answered(skill, NOW - day * DAY) for day in (60, 50, 30, 0)]
    exam = (NOW + 12 * DAY).date()
    assert Plan(ORDER, log, 10, NOW).due_at(skill) > NOW + 20 * DAY
    assert Plan(ORDER, log, 10, NOW, exam).due_at(skill).date() < exam


def test_what_was_asked_at_the_last_moment_before_the_exam_is_not_asked_at_once_again() -> None:
    skill, last = Skill("td-zero", 1), datetime(2026, 12, 9, tzinfo=UTC)  # the day before begins
    plan = Plan((skill,), [answered(skill, last)], 10, last, date(2026, 12, 10))
    assert plan.due_at(skill) > last


def test_it_is_said_when_a_skill_comes_again() -> None:
    skill = Skill("td-zero", 1)
    for outcomes, said in ((["wrong"], "tomorrow"), (["right"], "in "), (["right", "wrong"], "tomorrow")):
        log = [answered(skill, NOW + number * DAY, each) for number, each in enumerate(outcomes)]
        plan = Plan(ORDER, log, 10, NOW + 3 * DAY)
        assert plan.again(skill, log[-1].time).startswith(said)


def test_an_exam_that_is_over_is_refused() -> None:
    for day in (NOW.date(), NOW.date() - DAY):
        with pytest.raises(UsageError, match="not ahead"):
            Plan(ORDER, [], 10, NOW, day)


def test_the_first_line_says_what_and_why() -> None:
    value, td = Skill("policy-value", 1), Skill("td-zero", 1)
    log = [
        answered(value, NOW - 25 * DAY, "wrong", "forgot-gamma"),
        answered(value, NOW - 20 * DAY, "wrong", "forgot-gamma"),
    ]
    assert Plan(ORDER, [], 10, NOW).says().startswith("Your first quiz: 10 problems")
    assert Plan(ORDER, [], 1, NOW).says().startswith("Your first quiz: an easy problem. What you")
    assert Plan(ORDER, [], 10, NOW).says(kept=False).startswith("What you answered before is not known: 10 problems")
    assert "; 9 days to the exam." in Plan(ORDER, [], 10, NOW, (NOW + 9 * DAY).date()).says()
    assert Plan(ORDER, log, 10, NOW).says() == (
        "1 due, 9 new; first policy-value, level 1, because of “forgot gamma”, twice."
    )
    log.append(answered(td, NOW - 30 * DAY))
    said = Plan(ORDER, log, 10, NOW, (NOW + 9 * DAY).date()).says()
    assert said.startswith("2 due, 8 new; 9 days to the exam; first policy-value")


@pytest.mark.parametrize(
    ("ago", "says"), [(DAY / 2, "earlier today"), (DAY, "a day ago"), (2 * DAY, "2 days ago"), (9 * DAY, "9 days ago")]
)
def test_it_is_said_when_a_skill_was_seen(ago: timedelta, says: str) -> None:
    skill = Skill("td-zero", 1)
    said = Plan((skill,), [answered(skill, NOW - ago)], 1, NOW).says()
    assert said.endswith(f"first td-zero, level 1, because you saw it {says}.")


@pytest.mark.parametrize(("times", "says"), [(1, "once"), (2, "twice"), (3, "3 times")])
def test_it_is_said_how_often_a_mistake_was_made_in_thirty_days(times: int, says: str) -> None:
    skill = Skill("td-zero", 1)
    every = [NOW - 31 * DAY, *(NOW - number * DAY for number in range(9, 9 - times, -1))]
    log = [answered(skill, when, "wrong", "forgot-gamma") for when in every]
    assert Plan((skill,), log, 1, NOW).says().endswith(f"because of “forgot gamma”, {says}.")


def test_the_day_of_the_exam_is_a_day_where_the_student_is() -> None:
    skill = Skill("td-zero", 1)
    with zone("America/Los_Angeles"):  # 18:00 on the 18th, and in Greenwich the 19th
        evening = datetime(2026, 11, 19, 2, tzinfo=UTC).astimezone(LOCAL)
        assert "; 1 day to the exam." in Plan(ORDER, [], 10, evening, date(2026, 11, 19)).says()
        plan = Plan((skill,), [answered(skill, evening.astimezone(UTC))], 10, evening, date(2026, 11, 20))
        assert plan.due_at(skill) == datetime(2026, 11, 19, 8, tzinfo=UTC)  # its midnight before, eight hours behind
    with zone("Pacific/Kiritimati"):  # the morning of the 28th, and in Greenwich the 27th
        morning = datetime(2026, 11, 27, 15, 1, tzinfo=UTC).astimezone(LOCAL)
        with pytest.raises(UsageError, match="is not ahead"):
            Plan(ORDER, [], 10, morning, date(2026, 11, 28))


@pytest.mark.parametrize("name", ["Pacific/Kiritimati", "Etc/GMT+12"])  # one of them has another date than Greenwich
def test_the_command_goes_by_the_day_where_it_is_typed(name: str) -> None:
    with zone(name):
        today = datetime.now(LOCAL).replace(tzinfo=None)
        with pytest.raises(UsageError, match="is not ahead"):
            command._plan([], [], 10, today)
        assert "1 day to the exam" in command._plan([], [], 10, today + DAY).says()


def test_as_many_new_problems_are_asked_as_were_said() -> None:
    # 15/22 · 22 is 15, and with floats less
    log = [answered(skill, NOW - 90 * DAY) for skill in ORDER[:7]]
    plan = Plan(ORDER, log, 22, NOW)
    assert plan.says().startswith("7 due, 15 new;")
    asked = [plan.next(NOW) for _ in range(22)]
    assert sum(skill not in ORDER[:7] for skill in asked) == 15


def test_the_first_line_says_why_a_skill_is_asked_first() -> None:
    one, two = Skill("td-zero", 1), Skill("td-zero", 2)
    for order, log, why in (
        ((one, two), [answered(one, NOW - DAY)], "level 2, because the level below went well."),
        ((one, two), [answered(one, NOW - DAY, "wrong")], "level 1, because it went wrong the last time."),
        ((two,), [answered(Skill("sarsa", 1), NOW)], "level 2, which is new."),
    ):
        assert Plan(order, log, 1, NOW).says().endswith(f"first td-zero, {why}")


def test_what_is_due_fills_what_is_not_left_to_new_problems() -> None:
    log = [answered(Skill(name, 1), NOW - 40 * DAY, "wrong") for name in ("td-zero", "sarsa", "return")]
    order = tuple(Skill(name, 1) for name in ("td-zero", "sarsa", "return", "bandit"))
    assert Plan(order, log, 2, NOW).says().startswith("2 due, 0 new (of 3 that are due); first ")
    assert Plan(order, log, 9, NOW).says().startswith("3 due, 1 new; first ")
    assert Plan(order[3:], log, 9, NOW).says().startswith("nothing due, 1 new; first bandit")


def test_the_order_is_that_of_the_sheet_with_higher_levels_later() -> None:
    place = {skill: number for number, skill in enumerate(ORDER)}
    assert len(ORDER) == len(set(ORDER))
    for skill in ORDER:
        if skill.level > 1:
            assert place[Skill(skill.family, skill.level - 1)] < place[skill]
    assert skills(["td-zero"]) == (Skill("td-zero", 1), Skill("td-zero", 2), Skill("td-zero", 3))
