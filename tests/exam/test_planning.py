"""An exam as it is planned: versions share nothing, take as long as each other, and have the points that are wanted."""

from collections import Counter
from fractions import Fraction

import pytest

from rldrill.exam import drawn, expected
from rldrill.exam.blueprint import LONGEST_TITLE, Blueprint, Entry
from rldrill.exam.exam import points_of
from rldrill.exam.fairness import Fairness, content, fairness, told
from rldrill.exam.planning import plan, version_code
from rldrill.exam.pool import variety
from rldrill.exam.selection import MAX_DRAWN, fresh_seed, sequence
from rldrill.exam.slots import slots
from rldrill.exam.worth import shared
from rldrill.problems.catalogue import families, family
from rldrill.problems.errors import UsageError


def blueprint(*names: str, count: int = 3, level: int | None = None, **more: object) -> Blueprint:
    return Blueprint(problems=(Entry(topic=names, count=count, level=level),), **more)


@pytest.mark.parametrize(
    ("index", "code"),
    [(0, "A"), (1, "B"), (25, "Z"), (26, "AA"), (27, "AB"), (51, "AZ"), (52, "BA"), (701, "ZZ"), (702, "AAA")],
)
def test_versions_are_called_as_columns_of_a_sheet(index: int, code: str) -> None:
    assert version_code(index) == code


def test_every_version_has_as_many_problems_as_are_asked_for_and_is_told() -> None:
    done: list[None] = []
    exam = plan(blueprint("bellman", level=2, seed=7, versions=2), advance=lambda: done.append(None))
    assert [len(version.exercises) for version in exam.versions] == [3, 3]
    assert [version.code for version in exam.versions] == ["A", "B"]
    assert len(done) == 2
    assert exam.seed == 7


def test_seeds_can_be_typed_from_paper() -> None:
    assert all(0 <= fresh_seed() < 10**6 for _ in range(20))
    drawn = sequence((), None, 3)
    assert all(0 <= next(drawn)[2] < MAX_DRAWN == 10**6 for _ in range(50))


def test_the_same_blueprint_plans_the_same_exam_and_another_seed_another_one() -> None:
    def ids(seed: int) -> list[list[str | None]]:
        exam = plan(blueprint("control", count=4, seed=seed, versions=2))
        return [[item.id for item in version.exercises] for version in exam.versions]

    assert ids(3) == ids(3)
    assert ids(3) != ids(4)
    first, second = ids(3)
    assert not set(first) & set(second)


def test_versions_are_fair() -> None:
    exam = plan(blueprint("fundamentals", "control", count=4, seed=2, versions=6))
    slots = [[(item.problem.family.name, item.problem.level) for item in each.exercises] for each in exam.versions]
    assert all(slot == slots[0] for slot in slots)
    problems = [content(item) for version in exam.versions for item in version.exercises]
    assert len(set(problems)) == len(problems)
    for place in range(4):
        answers = [answer for version in exam.versions for answer in told(version.exercises[place])]
        assert len(set(answers)) == len(answers)
    times = [version.time for version in exam.versions]
    assert max(times) <= min(times) * Fraction(110, 100)
    figures = fairness(exam)
    assert (figures.shared_problems, figures.shared_answers) == (0, 0)
    assert figures.spread <= 0.1
    points = [[points_of(item) for item in version.exercises] for version in exam.versions]
    assert all(each == points[0] for each in points)


def test_yes_and_no_are_right_about_as_often() -> None:
    exam = plan(blueprint("markov-property", count=1, level=1, seed=2, versions=8))
    for counts in fairness(exam).balance.values():
        assert max(counts.values()) - min(counts.values()) <= 2


def test_a_version_repeats_no_problem() -> None:
    (version,) = plan(blueprint("return", count=40, level=1, seed=3)).versions
    assert len({content(item) for item in version.exercises}) == 40


def test_a_fixed_problem_is_the_same_in_every_version_and_counts_as_shared_by_no_one() -> None:
    entries = (Entry(id="td-zero/1/7"), Entry(family="return", level=1, count=2))
    exam = plan(Blueprint(problems=entries, seed=1, versions=3))
    assert {version.exercises[0].id for version in exam.versions} == {exam.versions[0].exercises[0].id}
    assert fairness(exam).shared_problems == 0


def test_every_version_may_have_an_order_of_its_own() -> None:
    exam = plan(blueprint("bellman", count=5, seed=1, versions=3, order="shuffled"))
    assert len({version.slots for version in exam.versions}) > 1
    for version in exam.versions:
        assert sorted(version.slots) == [0, 1, 2, 3, 4]
        by_slot = dict(zip(version.slots, version.exercises, strict=True))
        assert [by_slot[slot].problem.family.name for slot in range(5)] == [
            dict(zip(exam.versions[0].slots, exam.versions[0].exercises, strict=True))[slot].problem.family.name
            for slot in range(5)
        ]


def test_points_are_shared_out_to_a_total() -> None:
    assert shared([1, 1, 1], 7) == [3, 2, 2]
    assert shared([3, 1], 10) == [7, 3]  # one each, and 8 in the proportion 3 : 1
    assert shared([Fraction(9, 2), 1, 1], 3) == [1, 1, 1]


def test_points_that_are_set_are_kept_and_the_others_fill_the_total() -> None:
    entries = (Entry(family="return", level=1, points=5), Entry(family="td-zero", level=2, points=(1, 3)))
    exam = plan(Blueprint(problems=(*entries, Entry(topic=("bellman",), count=2)), seed=1, points=40, versions=2))
    for version in exam.versions:
        assert [points_of(item) for item in version.exercises[:2]] == [5, 4]
        assert [part.points for part in version.exercises[1].parts] == [1, 3]
        assert version.points == 40
        assert version.exercises[1].grade({"a": "", "b": ""}).of == 4


def test_points_that_do_not_add_up_are_said() -> None:
    entry = Entry(family="return", level=1, points=5)
    with pytest.raises(UsageError, match="points add up to 5, not to 9"):
        plan(Blueprint(problems=(entry,), seed=1, points=9))
    with pytest.raises(UsageError, match="each needs one; raise the total"):
        plan(Blueprint(problems=(entry, Entry(family="td-zero", level=2)), seed=1, points=5))


def test_a_time_is_filled_with_a_choice_of_topics() -> None:
    (version,) = plan(Blueprint(problems=(Entry(topic=()),), seed=4, minutes=60)).versions
    assert 54 <= version.minutes <= 66
    assert len({item.problem.family.topic for item in version.exercises}) >= 5


def test_what_is_excluded_is_not_drawn() -> None:
    exam = plan(blueprint("control", count=12, seed=4, exclude=("lqr-gain", "bandit")))
    assert not {"lqr-gain", "bandit"} & {item.problem.family.name for item in exam.versions[0].exercises}
    with pytest.raises(UsageError, match="Nothing is left of bandit without control"):
        plan(blueprint("bandit", seed=4, exclude=("control",)))


@pytest.mark.parametrize("problem", [Entry(family="td_zero", level=2), Entry(id="td-zero/2/18")])
def test_what_is_excluded_is_known_and_not_named(problem: Entry) -> None:
    with pytest.raises(UsageError, match="There is no topic or family 'nonsense'"):
        slots(Blueprint(problems=(problem,), exclude=("nonsense",)), 1)
    left_out = Blueprint(problems=(problem,), exclude=("temporal-difference",))
    if problem.is_fixed:
        assert len(slots(left_out, 1)) == 1
        return
    with pytest.raises(UsageError, match="td-zero is left out by exclude; take it out there, or here"):
        slots(left_out, 1)


def test_too_few_different_problems_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rldrill.exam.pool._ATTEMPTS", -20)
    with pytest.raises(UsageError, match="too few different problems"):
        plan(blueprint("return", count=1, level=1, seed=1))


def test_answers_are_shared_only_where_there_are_too_few_and_that_is_told() -> None:
    """How many of two constraints hold with a slack that helps: (b) of max-margin at level 1 is 1 or 2."""
    exam = plan(Blueprint(problems=(Entry(family="max-margin", level=1),), seed=1, versions=6))
    figures = fairness(exam)
    assert figures.scarce["1 b"] == 2
    given = Counter(answer for version in exam.versions for answer in told(version.exercises[0]) if answer[0] == "b")
    assert set(given.values()) == {3}  # none more often than it must be
    said = "fewer different answers than 6 versions: problem 1 (max-margin at level 1): 2 to (b)"
    assert figures.says_what_is_scarce(6).startswith(said)


def test_where_answers_are_too_few_versions_are_still_equally_long() -> None:
    """Sixty versions of a problem that has 47 different answers."""
    entries = (Entry(family="bandit", level=3), Entry(family="td-zero", level=2), Entry(family="return", level=2))
    assert fairness(plan(Blueprint(problems=entries, seed=1, versions=60))).spread <= 0.1


def test_of_a_topic_those_families_come_first_that_have_an_answer_for_every_version() -> None:
    wanted = blueprint("monte-carlo", "bellman", count=4, seed=3)
    assert all(slot.variety >= 40 for slot in slots(wanted, 3, 40))
    one, many = slots(wanted, 3, 1), slots(wanted, 3, 40)
    assert len(one) == len(many) == 4


def test_every_family_has_its_variety_counted() -> None:
    assert {name: len(counts) for name, counts in expected.variety().items()} == {
        name: len(family(name).levels) for name in families()
    }
    assert variety("max-margin", 1, 20) == expected.variety()["max-margin"][0]
    assert variety("td-zero", 2, 20) == 20 <= expected.variety()["td-zero"][1]


def test_points_that_do_not_fit_a_problem_are_said() -> None:
    with pytest.raises(UsageError, match="Td-zero has 2 parts, each of which needs a point, and is given 1"):
        plan(Blueprint(problems=(Entry(family="td-zero", level=2, points=1),), seed=1))
    for points, said in (((1, 2, 3), "3 parts"), ((3,), "1 part")):
        with pytest.raises(UsageError, match=f"Points are given for {said}, and td-zero has 2 here"):
            plan(Blueprint(problems=(Entry(id="td-zero/2/234", points=points),), seed=1))
    exam = plan(Blueprint(problems=(Entry(family="td-zero", level=2, points=2),), seed=1))
    assert [part.points for part in exam.versions[0].exercises[0].parts] == [1, 1]


def test_named_problems_may_not_take_all_of_the_time_from_the_topics() -> None:
    named = Entry(family="optimal-value", level=2, count=4)
    with pytest.raises(UsageError, match="The problems that are named take all of the time already"):
        slots(Blueprint(problems=(named, Entry(topic=("bellman",))), seed=1, minutes=10), 1)
    assert len(slots(Blueprint(problems=(named,), seed=1, minutes=10), 1)) == 4


def test_where_a_minute_is_left_every_topic_has_a_problem_all_the_same() -> None:
    named, two = Entry(id="td-zero/2/234"), [Entry(topic=("bellman",)), Entry(topic=("control",))]
    (alone,) = slots(Blueprint(problems=(named,), seed=1), 1)
    found = slots(Blueprint(problems=(named, *two), seed=1, minutes=int(alone.minutes) + 1), 1)
    assert [family(slot.family).topic for slot in found[1:]] == ["bellman", "control"]


def test_a_title_may_have_so_many_signs_and_no_more() -> None:
    assert blueprint("bellman").but(title="x" * LONGEST_TITLE).title == "x" * LONGEST_TITLE
    with pytest.raises(UsageError, match=f"The title has {LONGEST_TITLE + 1} characters; give one of at most"):
        blueprint("bellman").but(title="x" * (LONGEST_TITLE + 1))


def test_families_with_too_few_answers_for_all_versions_come_last_the_most_various_of_them_first() -> None:
    every = Blueprint(problems=(Entry(topic=("bayes", "inverse-rl"), count=11, level=1),), seed=3)
    for versions, needed in ((1, 1), (3, 4), (15, 20), (60, 80)):  # a third more than there are versions
        found = [slot.variety for slot in slots(every, 3, versions)]
        enough = [variety >= needed for variety in found]
        assert enough == sorted(enough, reverse=True)
        poor = [variety for variety in found if variety < needed]
        assert poor == sorted(poor, reverse=True)
    assert len(poor) > 2


def test_of_a_family_with_too_few_answers_another_level_is_taken_where_none_is_asked_for() -> None:
    free = Blueprint(problems=(Entry(topic=("max-margin",), count=1),), seed=3)
    (one,), (many,) = slots(free, 3, 1), slots(free, 3, 40)
    assert one.variety < 40 <= many.variety


@pytest.mark.parametrize(
    ("minutes", "wanted", "says"),
    [
        ((54, 66), 60, ""),  # a tenth less, and a tenth more
        ((53, 60), 60, "the problems take 53 to 60 minutes, not 60;"),
        ((67, 67), 60, "the problems take 67 minutes, not 60;"),
    ],
)
def test_minutes_are_missed_by_more_than_a_tenth(minutes: tuple[int, int], wanted: int, says: str) -> None:
    told = Fairness(0, 0, minutes, 0.0, {}, {}, {}).says_what_is_missed(wanted)
    assert told == (f"{says} ask for other minutes, or name more topics or problems" if says else "")


@pytest.mark.parametrize(("versions", "where"), [(49, "here"), (50, "apart")])
def test_many_versions_are_planned_in_a_process_of_its_own(
    monkeypatch: pytest.MonkeyPatch, versions: int, where: str
) -> None:
    monkeypatch.setattr("rldrill.exam.drawn._drawn", lambda *_: "here")
    monkeypatch.setattr("rldrill.exam.drawn.apart", lambda *_: "apart")
    assert drawn.drawn(blueprint("bellman", versions=versions), "0") == where


@pytest.mark.parametrize(
    ("minutes", "duration", "told"),
    [
        ((12, 12), 90, "the problems take 12 minutes, and the head says 90"),
        ((58, 61), 60, "the problems take 58 to 61 minutes, and the head says 60"),
        ((45, 50), 60, ""),
        ((45, 50), 100, ""),
    ],
)
def test_a_duration_that_does_not_fit_the_problems_is_told(minutes: tuple[int, int], duration: int, told: str) -> None:
    assert Fairness(0, 0, minutes, 0.0, {}, {}, {}).says_what_is_printed(duration).partition(";")[0] == told
