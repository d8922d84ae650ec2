"""Wrong answers worked out by hand with one error, and what is said of them."""

import pytest

import rldrill
from rldrill.solutions.answers.judging import Outcome

SAID = [
    # δ = γ(r + V(s′) − V(s)): ½(8 − 4 + 4) = 4, V(hot) = −4 + 4/5; ½(−6 − 2 + 16/5); ½(4 + 0 + 2), V(smoking) being −2.
    ("td-zero/2/234", "a", "4, -12/5, 3", "a bracket is set in the wrong place in rₜ₊₁ + γV(sₜ₊₁) − V(sₜ) every time"),
    # The first visit of each state alone: edge 2 + (5 − 2)/4, start −3 + (9 + 3)/5; both are visited twice.
    ("sample-average/2/2", "a", "start: -3/5, edge: 11/4", "the last round of updates is left out"),
]


@pytest.mark.parametrize(("problem", "part", "typed", "said"), SAID)
def test_what_is_said(problem: str, part: str, typed: str, said: str) -> None:
    assert rldrill.load(problem).diagnose(typed, part).sentence == f"It looks as if {said}."


def test_in_a_large_problem_what_is_close_is_taken_for_close_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    mdp = {"grid": "...G\n....\n....\n....", "rewards": {"G": 1}, "slip": "1/10"}
    exercise = rldrill.read({"family": "optimal-value", "given": {"gamma": "9/10", "mdp": mdp}})
    close = {state: float(value) * (1.01 if state == "r1c1" else 1) for state, value in exercise.answers()["a"].items()}
    verdict = exercise.check(close, "a")
    assert verdict.outcome is Outcome.CLOSE
    monkeypatch.setattr("rldrill.diagnosis.explained", None)  # what takes minutes there
    assert exercise.diagnosing.unmasked("a", str(close), verdict) is verdict
