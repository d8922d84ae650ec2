"""A family that is not complete, or contradicts itself, tells its author what to do, wherever that is met first."""

from collections.abc import Callable
from typing import Any

import pytest
from msgspec.structs import replace

from rldrill.problems.catalogue import family
from rldrill.problems.errors import BrokenFamily
from rldrill.problems.family import Family
from rldrill.solutions import drawing, solution
from rldrill.solutions.drawing import draw
from rldrill.solutions.sheet.temporal_difference import TD_ZERO

TD = family("td-zero")


def solved_by(monkeypatch: pytest.MonkeyPatch, solve: Callable[[Any, Any], None]) -> None:
    real = solution.solver(TD)
    monkeypatch.setattr(solution, "solver", lambda _: replace(real, solve=solve))


def told(broken: Family = TD) -> str:
    with pytest.raises(BrokenFamily) as error:
        draw(broken, 1, 0)
    return str(error.value)


def test_a_family_without_a_solver() -> None:
    with pytest.raises(BrokenFamily, match=r"td-two: there is no solutions/control/td_two\.py to solve it; write"):
        solution.solver(replace(TD, name="td-two", topic="control"))


def test_a_solver_that_answers_fewer_parts_than_are_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    solved_by(monkeypatch, lambda *_: None)
    assert "the question has the parts a, and its solver answers none" in told()


def test_a_solver_that_answers_more_parts_than_are_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    solved_by(monkeypatch, lambda given, work: [work.answer(given.alpha) for _ in "ab"] and None)
    assert "the question has the parts a, and its solver answers a, b" in told()


def test_a_step_without_a_value_for_a_letter(monkeypatch: pytest.MonkeyPatch) -> None:
    solved_by(monkeypatch, lambda _, work: work.step(TD_ZERO, t=0))
    assert "no value is given for 'S', which the formula needs" in told()


def test_draws_that_the_givens_refuse() -> None:
    def wrong(*_: Any) -> Any:
        return TD.kinds[0].model_validate({"gamma": 2})

    assert "'draw' makes givens of level 1 that 'Given' refuses: " in told(replace(TD, draw=wrong))


def test_draws_that_are_no_good_questions(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(drawing, "ATTEMPTS", 3)
    monkeypatch.setattr(drawing, "flaws", lambda _: iter(["(a) is zero"]))
    assert "none of 3 draws is a good question (3 × (a) is zero); draw otherwise" in told()


def test_the_three_commonest_flaws_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    found = iter("cabdaabbc")
    monkeypatch.setattr(drawing, "ATTEMPTS", 9)
    monkeypatch.setattr(drawing, "flaws", lambda _: iter([f"({next(found)}) is zero"]))
    assert "(3 × (a) is zero; 3 × (b) is zero; 2 × (c) is zero)" in told()
