"""Numbers from books, as literals; the problem files of the examples among them."""

from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from flint import fmpq

import rldrill
from asking import solved

EXAMPLES = Path(__file__).parent.parent.parent / "examples"


def test_the_racing_car_of_berkeley() -> None:
    # CS 188, "Markov Decision Processes": V2 = 3.5, 2.5 and 0.
    assert rldrill.load(EXAMPLES / "racing-car.toml").solve()["a"] == {"cool": fmpq(7, 2), "warm": fmpq(5, 2)}


def test_example_4_1_of_sutton_and_barto() -> None:
    # Figure 4.1, k = ∞, rows of the grid without its two corners.
    figure = [-14, -20, -22, -14, -18, -20, -20, -20, -20, -18, -14, -22, -20, -14]
    values = rldrill.load(EXAMPLES / "gridworld-4-1.toml").solve()["a"]
    assert list(values.values()) == figure


def test_exercise_3_8_of_sutton_and_barto() -> None:
    # γ = 0.5, rewards −1, 2, 6, 3, 2: G0 … G4 by the recursion, backwards from G5 = 0:
    # 2, 3 + 1 = 4, 6 + 2 = 8, 2 + 4 = 6, −1 + 3 = 2.
    assert solved("return", rewards=[-1, 2, 6, 3, 2], gamma=0.5)["a"] == (2, 6, 8, 4, 2)


def test_the_door_of_probabilistic_robotics() -> None:
    # Thrun, Burgard & Fox 2005, section 2.4.2: the belief that the door is open after sensing "open" is
    # 0.6·0.5 / (0.6·0.5 + 0.2·0.5) = 0.75.
    belief = solved(
        "bayes-rule",
        prior={"open": 0.5, "closed": 0.5},
        likelihood={"sense open": {"open": 0.6, "closed": 0.2}, "sense closed": {"open": 0.4, "closed": 0.8}},
        measurements=["sense open"],
    )["a"]
    assert belief == {"open": fmpq(3, 4), "closed": fmpq(1, 4)}


def test_the_cookie_problem_of_think_bayes() -> None:
    # Downey 2013, section 1.3: bowl 1 has 30 of 40 vanilla cookies, bowl 2 has 20 of 40: 3/5.
    belief = solved(
        "bayes-rule",
        prior={"Bowl 1": "1/2", "Bowl 2": "1/2"},
        likelihood={
            "vanilla": {"Bowl 1": "3/4", "Bowl 2": "1/2"},
            "chocolate": {"Bowl 1": "1/4", "Bowl 2": "1/2"},
        },
        measurements=["vanilla"],
    )["a"]
    assert belief["Bowl 1"] == fmpq(3, 5)


def test_the_random_walk_of_sutton_and_barto() -> None:
    # Example 6.2: the values of A … E are 1/6 … 5/6. With α = 0.1 the first episode, ending on the left,
    # changes V(A) alone, from 0.5 to 0.45 (exercise 6.3).
    line = ["left end", *"ABCDE", "right end"]
    walk = [
        [state, "step", after, "1/2", int(after == "right end")]
        for left, state, right in zip(line, line[1:], line[2:], strict=False)
        for after in (left, right)
    ]
    values = solved("policy-value", gamma=1, mdp={"transitions": walk, "terminal": ["left end", "right end"]})["a"]
    assert [Fraction(int(v.numerator), int(v.denominator)) for v in values.values()] == [
        Fraction(k, 6) for k in range(1, 6)
    ]
    after = solved(
        "td-zero",
        trajectory={"states": ["C", "B", "A", "left end"], "rewards": [0, 0, 0], "terminal": ["left end"]},
        values={"A": 0.5, "B": 0.5, "C": 0.5}, alpha=0.1, gamma=1,
    )["a"]  # fmt: skip
    assert after == {"C": fmpq(1, 2), "B": fmpq(1, 2), "A": fmpq(9, 20)}


def test_sarsa_by_hand() -> None:
    # Sutton & Barto 2018, eq. 6.7, with α = γ = 1/2. The action taken is not the best one; the first update counts
    # in the second; nothing follows the end.
    # Q(a, x) = 2 + 1/2·(1 + 1/2·4 − 2) = 5/2, Q(b, y) = 4 + 1/2·(−2 + 1/2·5/2 − 4) = 13/8,
    # Q(a, x) = 5/2 + 1/2·(3 + 0 − 5/2) = 11/4.
    run = {"states": ["a", "b", "a", "end"], "actions": ["x", "y", "x"], "rewards": [1, -2, 3]}
    run["terminal"] = ["end"]
    values = {"a": {"x": 2, "y": 7}, "b": {"x": 9, "y": 4}}
    after = solved("sarsa", trajectory=run, values=values, alpha=0.5, gamma=0.5)["a"]
    assert after == {("a", "x"): fmpq(11, 4), ("b", "y"): fmpq(13, 8)}


@pytest.mark.parametrize(
    ("A", "B", "R", "P", "gain"),
    [
        # By hand, in the cost-to-go convention S = −P: L = (R + BᵀSB)⁻¹BᵀSA.
        ([[1]], [[1]], [[1]], [[-1]], [[fmpq(1, 2)]]),
        # S = I, B = (0, 1)ᵀ, A = (1 1; 0 1): BᵀSB = 1, BᵀSA = (0 1): L = (0 1)/2.
        ([[1, 1], [0, 1]], [[0], [1]], [[1]], [[-1, 0], [0, -1]], [[0, fmpq(1, 2)]]),
    ],
)
def test_gains_by_hand(A: Any, B: Any, R: Any, P: Any, gain: Any) -> None:
    assert solved("lqr-gain", A=A, B=B, R=R, P=P)["a"].tolist() == gain
