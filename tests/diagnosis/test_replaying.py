"""A working that is gone through again, with nothing changed in it, is the right working."""

import pytest
from flint import fmpq

import rldrill
from rldrill.diagnosis import Diagnosing
from rldrill.problems.catalogue import families
from rldrill.solutions.diagnosis.replay import Change


@pytest.mark.parametrize("name", families())
@pytest.mark.parametrize("level", [1, 3])
def test_every_step_as_it_was_leads_to_the_right_answers(name: str, level: int) -> None:
    solution = rldrill.draw(name, level, 4711).solution
    search = Diagnosing(solution).search({})
    for application in search.applications:
        again = search.replay(Change(values={application.number: application.value}))
        assert {label: str(answer) for label, answer in (again or {}).items()} == {
            label: str(answer) for label, answer in solution.answers.items()
        }, application.number


def test_what_goes_wrong_behind_a_comparison_is_told() -> None:
    # V*(cape) = 6 and Q*(cape, drift) = 2 + 2/3·6; the best actions are found before that is asked for.
    exercise = rldrill.draw("optimal-value", 1, 847825)
    said = exercise.diagnose("2, 8, -8, -3", "c").sentence  # 2 + 6 = 8
    assert "γ is missing" in said
    assert "Q*(cape, drift)" in said


def test_a_step_again_with_another_discount_is_another_step() -> None:
    """Two returns are equal at a discount, and compared at a greater one."""
    given = {"rewards": [2, -1], "others": [-2, 4], "gamma": "gamma"}
    search = Diagnosing(rldrill.read({"family": "return", "given": given}).solution).search({})
    first = search.applications[0]
    # 2 − γ = −2 + 4γ at γ = 4/5; at 1 they are 1 and 2.
    assert search.replay(Change(values={first.number: first.value})) == {"a": fmpq(4, 5), "b": "B"}
