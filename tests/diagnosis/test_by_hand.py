"""Wrong answers worked out by hand with one error, and what is said of them."""

from typing import Any

import pytest

import rldrill
from rldrill.solutions.answers.judging import Outcome

RUN = {
    "trajectory": {"states": ["hot", "hot", "smoking", "end"], "rewards": [8, -6, 4], "terminal": ["end"]},
    "values": {"hot": -4, "smoking": -2}, "alpha": "1/5", "gamma": "1/2", "td_errors": True,
}  # fmt: skip
VISITS = {
    "values": {"start": -3, "edge": 2}, "counts": {"start": 4, "edge": 3},
    "visits": [["edge", 5], ["start", 9], ["start", 12], ["edge", -3]],
}  # fmt: skip
STEP = {
    "mean": [4], "covariance": [[6]], "A": [[1]], "B": [[1]], "C": [[1]], "process": [[2]], "sensor": [[8]],
    "steps": [{"u": [2], "z": [8]}],
}  # fmt: skip
CART = {"A": [[1, 1], [0, 1]], "B": [[0], [1]], "Q": [[1, 0], [0, 1]], "R": 1, "start": [4, 0], "horizon": 2}
WALK = {
    "motion": {
        "left": {"A": {"end": 1}, "B": {"A": "1/4", "end": "3/4"}},
        "right": {"A": {"B": "3/4", "end": "1/4"}, "B": {"A": 1}},
    },
    "policy": {"A": {"left": "1/3", "right": "2/3"}, "B": {"left": "2/3", "right": "1/3"}},
    "features": {"A": [9, 5], "B": [5, 1]}, "start": {"A": "1/3", "B": "2/3"}, "terminal": ["end"], "gamma": "2/3",
}  # fmt: skip
COUNTS = {"table": [["a", "m", "x", 4], ["a", "m", "y", 16], ["b", "m", "x", 6], ["b", "m", "y", 9]], "asked": "x"}
ONE = {"trajectory": {"states": ["hot", "cold"], "rewards": [7]}, "values": {"hot": 8, "cold": 10}, "alpha": "3/4"}
SAID = [
    # 8 + 4/3·(7 + 1/2·10 − 8) = 40/3, whether one divides by α or turns it over.
    ("td-zero", {**ONE, "gamma": "1/2"}, "a", "40/3", "α = 3/4 is upside down in the update"),
    # 8 + 3/4·(7 − 8) = 29/4; nobody takes 1 − 1 for γ = 1.
    ("td-zero", {**ONE, "gamma": 1}, "a", "29/4", "γV(sₜ₊₁) is missing in the update"),
    # δ = γ(r + V(s′) − V(s)): ½(8 − 4 + 4) = 4, V(hot) = −4 + 4/5; ½(−6 − 2 + 16/5); ½(4 + 0 + 2), V(smoking) being −2.
    ("td-zero", RUN, "a", "4, -12/5, 3", "a bracket is set in the wrong place in rₜ₊₁ + γV(sₜ₊₁) − V(sₜ) every time"),
    # Mean 4 + 2, variance 6 + 2 = 8, whose root is 2.83.
    ("kalman-filter", STEP, "a", "6, 2.83", "you gave the standard deviation, the root of the variance"),
    # μ(A) = 9 + μ(B)/3 and μ(B) = 5 + μ(A)/3 give 12 and 9. Without γ it is μ(B) = 5 + μ(A)/2, as with 1/3·1/4 + 2/3
    # for 2/3·1/4 + 1/3 before γμ(A): then μ(A) is 64/5. The second feature's equation of B is the same.
    (
        "feature-expectations-policy", WALK, "a", "12.8, 11.4",
        "γ is missing in the equation of μ₁(B), or 1 − π(a|s) stands where π(a|s) belongs in the equation of μ₁(B), "
        "or there is a slip in solving the equations",
    ),
    # P₁ = −(2 1; 1 5/2), as in examples/double-integrator.toml.
    ("lqr-backward", CART, "b", "[-2 1; 1 -5/2]", "the sign is wrong at row 1, column 2 and row 2, column 1"),
    # 4/(4 + 16), and 6/16, where 6 + 9 = 15 belongs below the line.
    ("markov-property", COUNTS, "a", "1/5, 6/16", "16 is put in for Σₛ′ N(sₜ₋₁, sₜ, s′), which is 15 in Pr(x|b, m)"),
    # The first visit of each state alone: edge 2 + (5 − 2)/4, start −3 + (9 + 3)/5; both are visited twice.
    ("sample-average", VISITS, "a", "start: -3/5, edge: 11/4", "the last round of updates is left out"),
]  # fmt: skip


@pytest.mark.parametrize(("family", "given", "part", "typed", "said"), SAID)
def test_what_is_said(family: str, given: dict[str, Any], part: str, typed: str, said: str) -> None:
    exercise = rldrill.read({"family": family, "given": given})
    assert exercise.diagnose(typed, part).sentence == f"It looks as if {said}."


def test_updates_that_are_all_worked_out_with_the_first_values_are_added_up() -> None:
    # V(hot) = −4 and V(smoking) = 10 all along: δ = 8 − 2 + 4 = 10, 9 + 5 + 4 = 18, 4 − 10 = −6, each with α = 1/5.
    run = {"states": ["hot", "hot", "smoking", "end"], "rewards": [8, 9, 4], "terminal": ["end"]}
    given = {"trajectory": run, "values": {"hot": -4, "smoking": 10}, "alpha": "1/5", "gamma": "1/2"}
    said = rldrill.read({"family": "td-zero", "given": given}).diagnose("hot: 8/5, smoking: 44/5", "a").sentence
    assert said.startswith("It looks as if the old values are used all along, though some of them have been updated")


# R₀ = 1 + 3/4·2 + 9/16·44 = 27.25
FAR_REWARD = {"family": "return", "given": {"rewards": [1, 2, 44], "gamma": "3/4", "time": 0}}


@pytest.mark.parametrize("typed", ["27.4", "27.1"])
def test_a_last_digit_that_is_one_off_is_a_matter_of_rounding(typed: str) -> None:
    # With 0.5652 for 9/16 = 0.5625 it would be 27.37, which rounds to 27.4.
    exercise = rldrill.read(FAR_REWARD)
    verdict = exercise.check(typed)
    assert verdict.outcome is Outcome.CLOSE
    assert exercise.diagnose(typed).of(verdict) == verdict.says


def test_digits_that_are_exchanged_are_shown_as_digits() -> None:
    # 1 + 3/2 + 0.5652·44 = 27.3688
    said = rldrill.read(FAR_REWARD).diagnose("27.3688").sentence
    assert "the digits of γⁱ = 0.5625 are exchanged: 0.5652" in said


@pytest.mark.parametrize("family", ["optimal-value", "policy-value"])
def test_in_a_large_problem_what_is_close_is_taken_for_close_at_once(
    monkeypatch: pytest.MonkeyPatch, family: str
) -> None:
    mdp = {"grid": "...G\n....\n....\n....", "rewards": {"G": 1}, "slip": "1/10"}
    more = {"policy": "uniform"} if family == "policy-value" else {}
    exercise = rldrill.read({"family": family, "given": {"gamma": "9/10", "mdp": mdp} | more})
    close = {state: float(value) * (1.01 if state == "r1c1" else 1) for state, value in exercise.answers()["a"].items()}
    verdict = exercise.check(close, "a")
    assert verdict.outcome is Outcome.CLOSE
    monkeypatch.setattr("rldrill.diagnosis.explained", None)  # what takes minutes there
    assert exercise.diagnosing.unmasked("a", str(close), verdict) is verdict
