"""One mistake alone: the problems in which it gives a wrong answer, and what is said of how it went."""

from datetime import UTC, datetime
from io import StringIO
from itertools import islice

import pytest
from rich.console import Console

import rldrill
from rldrill.history.attempts import Attempt
from rldrill.history.memory import Skill
from rldrill.problems.errors import UsageError
from rldrill.quiz.drilling import drill
from rldrill.quiz.ending import ending
from rldrill.quiz.session import Record, Session
from rldrill.solutions.answers.kinds import answer_kind


def attempt(number: int, family: str, level: int, *mistakes: str) -> Attempt:
    return Attempt(
        id=str(number), time=datetime(2026, 11, 1, tzinfo=UTC), sitting=str(number), family=family, level=level, seed=1,
        revision=1, part="a", parts=1, typed="1", outcome="wrong", misconceptions=mistakes, hints=0, retries=0,
        seconds=9.0, credit=0.0,
    )  # fmt: skip


def test_whoever_makes_the_mistake_is_wrong_in_every_problem_and_told_so() -> None:
    for exercise in islice(drill("forgot-gamma", ()).exercises(7), 6):
        (made,) = (answers for mistake, answers in exercise.solution.mistakes if mistake.name == "forgot-gamma")
        typed = {part.label: answer_kind(part.kind).write(made[part.label]) for part in exercise.parts}
        told = [mistake.name for part in exercise.grade(typed).parts if part.verdict for mistake in part.verdict.told]
        assert "forgot-gamma" in told, exercise.id


def test_the_skills_at_which_it_was_made_come_alone_and_the_most_often_made_first() -> None:
    history = [
        attempt(1, "bellman-backup", 2, "forgot-gamma"),
        attempt(2, "value-iteration", 1, "forgot-gamma"),
        attempt(3, "value-iteration", 1, "forgot-gamma", "mean-for-max"),
        attempt(4, "return", 1, "sign"),
    ]
    found = drill("forgot-gamma", history)
    assert found.skills == (Skill("value-iteration", 1), Skill("bellman-backup", 2))
    assert found.made == 3
    assert "made 3 times" in found.says()
    drawn = [(each.problem.family.name, each.problem.level) for each in islice(found.exercises(1), 3)]
    assert drawn == [("value-iteration", 1), ("bellman-backup", 2), ("value-iteration", 1)]


def test_names_and_a_level_leave_the_others_out() -> None:
    skills = drill("forgot-gamma", (), ["dynamic-programming"], 2).skills
    assert Skill("value-iteration", 2) in skills
    assert {skill.level for skill in skills} == {2}
    assert "bellman-backup" not in {skill.family for skill in skills}


@pytest.mark.parametrize("text", ["forgot-gamma", "forgot gamma", "Forgot_Gamma", "“forgot gamma”"])
def test_a_mistake_goes_by_its_name_and_by_what_it_is_called(text: str) -> None:
    assert drill(text, ()).name == "forgot-gamma"


def test_families_that_list_a_mistake_come_first() -> None:
    skills = drill("sign", ()).skills
    assert {skill.family for skill in skills[:3]} == {"bic"}
    assert len({skill.family for skill in skills}) > 1  # a sign may be lost anywhere


def test_a_slip_that_no_family_lists_goes_by_what_it_is_called_too() -> None:
    assert drill("a fraction upside down", ()).name == "upside-down"


def test_a_slip_that_no_family_lists_is_drilled_where_a_step_has_room_for_it() -> None:
    # Bayes' rule divides; a return is a sum of products, in which no fraction can be upside down.
    (exercise,) = islice(drill("upside-down", [attempt(1, "bayes-rule", 1, "upside-down")]).exercises(3), 1)
    assert exercise.problem.family.name == "bayes-rule"
    with pytest.raises(UsageError, match="No problem was found in which “a fraction upside down” gives a wrong answer"):
        next(drill("upside-down", [attempt(1, "return", 1, "upside-down")]).exercises(3))


@pytest.mark.parametrize(
    ("text", "names", "said"),
    [
        ("forgot-gama", (), "Did you mean forgot-gamma"),
        ("qqqq", (), "There is no mistake called 'qqqq'. 'rldrill stats'"),
        ("forgot-gamma", ("bayes",), "“forgot gamma” is no mistake of these problems; drill it in bellman-backup"),
        ("forgot-gamma", ("bays",), "There is no topic or family 'bays'"),
    ],
)
def test_what_cannot_be_drilled_is_told_in_a_sentence(text: str, names: tuple[str, ...], said: str) -> None:
    with pytest.raises(UsageError, match=said) as refused:
        drill(text, (), names)
    assert "\n" not in str(refused.value)


def said_at_the_end(*answers: str, drilled: str) -> str:
    # R₁ = 4 and R₀ = 1 + 1/2·4 = 3; who discounts the first reward, too, has R₁ = 1/2·4 = 2.
    exercise = rldrill.read({"family": "return", "given": {"gamma": "1/2", "rewards": [1, 4], "time": 1}})
    record = Record.of(exercise)
    for answer in answers:
        record.answer(record.parts[0], answer)
    console = Console(file=StringIO(), width=100, color_system=None)
    for line in ending(Session(1, [record], drilled=drilled), 9):
        console.print(line)
    assert isinstance(console.file, StringIO)
    return console.file.getvalue()


def test_the_end_counts_the_problems_in_which_the_mistake_was_made() -> None:
    name = "first-reward-discounted"
    assert "“first reward discounted”: made in 1 of 1 problem." in said_at_the_end("2", "2", "4", drilled=name)
    assert "“first reward discounted”: made in none of 1 problem." in said_at_the_end("4", drilled=name)


def test_the_end_tells_the_command_that_drills_the_mistake_made_most() -> None:
    assert "rldrill quiz --mistake first-reward-discounted\n" in said_at_the_end("2", drilled="")
    assert "--mistake" not in said_at_the_end("4", drilled="")


def test_a_mistake_that_a_family_does_not_list_is_drilled_where_it_was_made() -> None:
    history = [attempt(1, "piecewise-linear-rbf", 2, "sum-of-differences")]
    found = drill("sum-of-differences", history, ["piecewise-linear-rbf"])
    assert found.skills == (Skill("piecewise-linear-rbf", 2),)
    assert next(found.exercises(1)).problem.family.name == "piecewise-linear-rbf"
