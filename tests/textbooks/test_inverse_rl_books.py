"""Inverse reinforcement learning: numbers from books and lectures, and some worked out by hand in the comments."""

from typing import Any

import pytest
import sympy
from flint import fmpq

from asking import rounded, solved


def test_discounted_features_of_two_trajectories() -> None:
    # γ = 1/2: (1, 0) + 1/2·(0, 1) + 1/4·(0, 1) = (1, 3/4) and (0, 1) + 1/2·(1, 0) = (1/2, 1); their mean is
    # (3/4, 7/8).
    given = {"features": {"x": [1, 0], "y": [0, 1]}, "trajectories": [["x", "y", "y"], ["y", "x"]], "gamma": "1/2"}
    assert solved("feature-expectations", **given)["a"] == (fmpq(3, 4), fmpq(7, 8))


def test_features_of_a_loop() -> None:
    # x goes to y and y back to x, the feature marks x, γ = 1/2: 1 + 1/4 + 1/16 + … = 4/3 from x, half of it from y;
    # started in x with 3/4: 3/4·4/3 + 1/4·2/3 = 7/6.
    answers = solved(
        "feature-expectations-policy",
        motion={"go": {"x": {"y": 1}, "y": {"x": 1}}}, policy={"x": "go", "y": "go"},
        features={"x": [1], "y": [0]}, start={"x": "3/4", "y": "1/4"}, gamma="1/2",
    )  # fmt: skip
    assert answers == {"a": {"x": fmpq(4, 3), "y": fmpq(2, 3)}, "b": fmpq(7, 6)}


def test_the_policy_that_matches_the_expert_by_hand() -> None:
    # In x the policy stays with probability q and ends otherwise, γ = 1/2: μ = 1 + q/2·μ = 4/3 for q = 1/2.
    answers = solved(
        "feature-expectations-policy",
        motion={"stay": {"x": {"x": 1}}, "go": {"x": {"end": 1}}}, policy={"x": {"stay": "q", "go": "1-q"}},
        features={"x": [1]}, start={"x": 1}, terminal=["end"], gamma="1/2", matched="4/3",
    )  # fmt: skip
    assert answers == {"a": fmpq(1, 2)}


def test_the_discount_is_found_from_an_estimate() -> None:
    # (1 + γ·2)/1 = 2 for γ = 1/2; the other feature has 0 + 1/2·4 = 2.
    given = {"features": {"x": [1, 0], "y": [2, 4]}, "trajectories": [["x", "y"]], "gamma": "gamma", "estimate": 2}
    assert solved("feature-expectations", **given) == {"a": fmpq(1, 2), "b": fmpq(2)}


def test_a_projection_in_the_plane() -> None:
    # From (0, 0) towards (4, 0) with the expert at (3, 2): 3/4 of the way, to (3, 0), w = (0, 2) and 2 is left.
    answers = solved("apprenticeship", expert=[3, 2], first=[0, 0], policies=[[4, 0]])
    assert answers["a"] == fmpq(3, 4)
    assert answers["b"] == (fmpq(3), fmpq(0))
    assert answers["c"] == (fmpq(0), fmpq(2))
    assert answers["d"] == 2


def test_the_policy_that_comes_next_need_not_be_projected() -> None:
    # c = 8/16, so the point is (2, 0) and w = (0, 3): A is worth 3·1, B 3·6; ‖w‖ = 3.
    answers = solved(
        "apprenticeship", expert=[2, 3], first=[0, 0], policies=[[4, 0]], candidates={"A": [9, 1], "B": [0, 6]},
        projected=False,
    )  # fmt: skip
    assert list(answers.values()) == [(2, 0), (0, 3), "B", 3]


def test_the_next_policy_of_apprenticeship_learning_by_hand() -> None:
    # From (0, 0) towards (4, 0): the foot of (2, 3) is (2, 0), w = (0, 3), so B with 3·6 beats A with 3·1. From (2, 0)
    # towards (8, 6), along (6, 6): c = 18/72 = 1/4, the point is (7/2, 3/2), and (−3/2, 3/2) is left: 3/√2 = 2.12 > 2.
    answers = solved(
        "apprenticeship", expert=[2, 3], first=[0, 0], policies=[[4, 0]], candidates={"A": [9, 1], "B": [8, 6]},
        tolerance=2,
    )  # fmt: skip
    assert answers["a"] == (2, 0)
    assert answers["b"] == (0, 3)
    assert answers["c"] == "B"
    assert answers["d"] == (fmpq(7, 2), fmpq(3, 2))
    assert answers["e"] == 3 / sympy.sqrt(2)
    assert answers["f"] is False


def test_the_slack_of_two_constraints() -> None:
    # w = (1, 2): the expert is worth 8, the others 5 + 4 = 9 and 6 + 1 = 7 with their margins; so one holds, ξ = 1.
    others = {"x": {"mu": [1, 2], "margin": 4}, "y": {"mu": [0, 3], "margin": 1}}
    answers = solved("max-margin", w=[1, 2], expert=[2, 3], policies=others)
    assert answers == {"a": (fmpq(8), fmpq(5), fmpq(6)), "b": fmpq(1), "c": fmpq(1)}
    assert solved("max-margin", w=[1, 2], expert=[2, 3], policies=others, slack=1)["b"] == 2


def test_the_weight_from_which_on_all_constraints_hold() -> None:
    # With w = (x, 2) the expert is worth 3x + 2. π₁: 3x + 2 ≥ x + 4 + 2 from x = 2 on; π₂: 3x + 2 ≥ 2x + 1 from −1 on.
    others = {"π₁": {"mu": [1, 2], "margin": 2}, "π₂": {"mu": [2, 0], "margin": 1}}
    answers = solved("max-margin", w=["x", 2], expert=[3, 1], policies=others)
    assert answers == {"a": {"π₁": fmpq(2), "π₂": fmpq(-1)}, "b": fmpq(2)}


# A feature that is the reward itself makes feature expectations values, for which there are printed numbers.
STUDENT_REWARDS = {"C1": [-2], "C2": [-2], "C3": [-2], "Pass": [10], "Pub": [1], "FB": [-1], "Sleep": [0]}


@pytest.mark.parametrize(
    ("trajectory", "printed"),
    [
        # Silver 2015, lecture 2, the student Markov reward process: the sample returns for γ = 1/2.
        ("C1 C2 C3 Pass Sleep", "-2.25"),
        ("C1 FB FB C1 C2 Sleep", "-3.125"),
        ("C1 C2 C3 Pub C2 C3 Pass Sleep", "-3.41"),
        ("C1 FB FB C1 C2 C3 Pub C1 FB FB FB C1 C2 C3 Pub C2 Sleep", "-3.20"),
    ],
)
def test_the_returns_of_silvers_student(trajectory: str, printed: str) -> None:
    given = {"features": STUDENT_REWARDS, "trajectories": [trajectory.split()], "gamma": "1/2"}
    assert rounded(solved("feature-expectations", **given)["a"][0], len(printed.partition(".")[2])) == printed


@pytest.mark.parametrize(
    ("gamma", "printed"),
    [
        # Silver 2015, lecture 2: the values of the student Markov reward process; its C1, C2, C3, Pass, Pub, FB.
        (0, ["-2", "-2", "-2", "10", "1", "-1"]),
        ("0.9", ["-5.0", "0.9", "4.1", "10", "1.9", "-7.6"]),
        (1, ["-13", "1.5", "4.3", "10", "0.8", "-23"]),
    ],
)
def test_the_values_of_silvers_student(gamma: Any, printed: list[str]) -> None:
    day = {
        "C1": {"C2": "0.5", "FB": "0.5"}, "C2": {"C3": "0.8", "Sleep": "0.2"}, "C3": {"Pass": "0.6", "Pub": "0.4"},
        "Pass": {"Sleep": 1}, "Pub": {"C1": "0.2", "C2": "0.4", "C3": "0.4"}, "FB": {"FB": "0.9", "C1": "0.1"},
    }  # fmt: skip
    answers = solved(
        "feature-expectations-policy",
        motion={"a day": day}, policy=dict.fromkeys(day, "a day"), start={"C1": 1}, terminal=["Sleep"], gamma=gamma,
        features={state: STUDENT_REWARDS[state] for state in day},
    )  # fmt: skip
    values = answers["a"]
    for state, text in zip(day, printed, strict=True):
        assert rounded(values[state], len(text.partition(".")[2])) == text


def test_the_drunkard_of_grinstead_and_snell() -> None:
    # Grinstead & Snell, Introduction to Probability, section 11.2, the drunkard's walk: the fundamental matrix is
    # (3/2 1 1/2; 1 2 1; 1/2 1 3/2). With one feature for every corner its rows are feature expectations for γ = 1.
    walk = {"1": {"home": "1/2", "2": "1/2"}, "2": {"1": "1/2", "3": "1/2"}, "3": {"2": "1/2", "bar": "1/2"}}
    rows = {"1": (fmpq(3, 2), 1, fmpq(1, 2)), "2": (1, 2, 1), "3": (fmpq(1, 2), 1, fmpq(3, 2))}
    for corner, row in rows.items():
        *_, visits = solved(
            "feature-expectations-policy",
            motion={"walk": walk}, policy=dict.fromkeys(walk, "walk"), start={corner: 1}, terminal=["home", "bar"],
            features={"1": [1, 0, 0], "2": [0, 1, 0], "3": [0, 0, 1]}, gamma=1,
        ).values()  # fmt: skip
        assert visits == row


@pytest.mark.parametrize(
    ("expert", "towards", "foot", "rest", "distance"),
    [
        # The projection of apprenticeship learning, from 0. Strang, Introduction to Linear Algebra, section 4.2: (1, 1,
        # 1) onto the line through (1, 2, 2) is (5/9, 10/9, 10/9), and what is left over is (4/9, −1/9, −1/9).
        ([1, 1, 1], [1, 2, 2], ("5/9", "10/9", "10/9"), ("4/9", "-1/9", "-1/9"), sympy.sqrt(2) / 3),
        # Lay, Linear Algebra and Its Applications, section 6.2: (7, 6) onto (4, 2) is (8, 4), the rest (−1, 2), and the
        # distance √5.
        ([7, 6], [4, 2], (8, 4), (-1, 2), sympy.sqrt(5)),
    ],
)
def test_projections_of_linear_algebra(expert: Any, towards: Any, foot: Any, rest: Any, distance: Any) -> None:
    answers = solved("apprenticeship", expert=expert, first=[0] * len(expert), policies=[towards])
    assert [str(value) for value in answers["b"]] == [str(value) for value in foot]
    assert [str(value) for value in answers["c"]] == [str(value) for value in rest]
    assert answers["d"] == distance


@pytest.mark.parametrize(
    ("right", "wrong", "margin", "printed"),
    # Stanford's CS231n, notes on linear classification: scores 13, −7 and 11, the first one right, margin 10: the loss
    # is 8. Its slides: 3.2, 5.1 and −1.7 with margin 1: 2.9. At most one constraint fails in both, so the slack is the
    # loss.
    [("13", ["-7", "11"], 10, fmpq(8)), ("3.2", ["5.1", "-1.7"], 1, fmpq(29, 10))],
)
def test_the_hinge_loss_of_cs231n(right: str, wrong: list[str], margin: int, printed: fmpq) -> None:
    others = {name: {"mu": [score], "margin": margin} for name, score in zip("xy", wrong, strict=True)}
    assert solved("max-margin", w=[1], expert=[right], policies=others)["c"] == printed
