"""The audit notices what it is there to notice."""

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from flint import fmpq
from msgspec.structs import replace

import rldrill
from rldrill.audit import checking as audit
from rldrill.audit.checking import Finding, agrees, examine
from rldrill.problems.catalogue import family
from rldrill.problems.parts import Number, Part, Policy
from rldrill.solutions.answers.judging import Outcome, judge
from rldrill.solutions.drawing import draw
from rldrill.solutions.solution import solver


@pytest.mark.parametrize(("off", "same"), [(0.0, True), (1e-10, True), (1e-6, False), (1e-3, False), (-1e-6, False)])
def test_answers_agree_to_eight_places(off: float, same: bool) -> None:
    assert agrees(Part("?", Number()), fmpq(7, 2), 3.5 + off) is same


def test_a_large_answer_may_be_off_by_as_much_more() -> None:
    assert agrees(Part("?", Number()), fmpq(7_000_000), 7_000_000.001)
    assert not agrees(Part("?", Number()), fmpq(7_000_000), 7_000_001)


def test_a_policy_agrees_if_all_tied_actions_do() -> None:
    part = Part("?", Policy({"s": ("l", "r")}))
    assert agrees(part, {"s": ("l", "r")}, {"s": {"r", "l"}})
    assert not agrees(part, {"s": ("l",)}, {"s": {"r", "l"}})


def _found(monkeypatch: pytest.MonkeyPatch, **changed: Any) -> Finding:
    for name, value in changed.items():
        monkeypatch.setattr(audit, name, value)
    finding = Finding(family("td-zero"), 1)
    examine(draw("td-zero", 1, 7), finding)
    return finding


def test_a_sound_problem_is_clean(monkeypatch: pytest.MonkeyPatch) -> None:
    finding = _found(monkeypatch)
    assert finding.clean
    assert finding.drawn == 1
    assert finding.made == finding.recognised > 0


def test_a_wrong_oracle_is_a_disagreement(monkeypatch: pytest.MonkeyPatch) -> None:
    real = solver(family("td-zero"))
    finding = _found(monkeypatch, solver=lambda _: replace(real, oracle=lambda g: [np.add(real.oracle(g), 1e-5)]))
    assert len(finding.disagreements) == 1
    assert not finding.clean


def test_one_state_with_two_best_actions_is_a_tie() -> None:
    # γ = 1/2: stay pays 1 for ever, V*(b) = 2; go pays 1 and leads there, V*(a) = 1 + 1/2·2 = 2; walk pays 2 and ends.
    mdp = {
        "transitions": [["a", "go", "b", 1, 1], ["a", "walk", "end", 1, 2], ["b", "stay", "b", 1, 1]],
        "terminal": ["end"],
    }
    exercise = rldrill.read({"family": "optimal-value", "given": {"mdp": mdp, "gamma": "1/2"}})
    finding = Finding(family("optimal-value"), 1)
    examine(exercise.solution, finding)
    assert (finding.ties, finding.disagreements) == (1, [])


def test_an_answer_that_is_not_judged_right_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    finding = _found(monkeypatch, judge=lambda *given: replace(judge(*given), outcome=Outcome.WRONG))
    assert finding.refused == [f"td-zero/1/7@{family('td-zero').revision} (a)"]
    assert not finding.clean


def test_a_mistake_that_is_not_recognised_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    finding = _found(monkeypatch, judge=lambda *given: replace(judge(*given), misconceptions=()))
    assert finding.recognised == 0
    assert len(finding.unrecognised) == finding.made > 0
    assert not finding.clean


def test_open_parameters_are_compared_where_the_oracle_has_them() -> None:
    assert audit.as_float(fmpq(1, 4)) == 0.25
    gamma = next(each for seed in range(50) if (each := draw("return-infinite", 3, seed)).problem.parameters)
    value = audit.as_float(next(iter(gamma.answers.values())))
    assert value == pytest.approx(float(np.ravel(solver(gamma.problem.family).oracle(gamma.problem.given)[0])[0]))
    assert Fraction(7, 19) == audit.OPEN
