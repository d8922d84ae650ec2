"""Inverse reinforcement learning worked out by hand, step by step in the comments."""

import sympy
from flint import fmpq

from asking import solved


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
    assert answers == {"a": {"x": fmpq(4, 3), "y": fmpq(2, 3)}, "b": (fmpq(7, 6),)}


def test_a_projection_in_the_plane() -> None:
    # From (0, 0) towards (4, 0) with the expert at (3, 2): the foot is (3, 0), w = (0, 2) and 2 is left;
    # (4, 0) itself is √(1 + 4) away.
    answers = solved("apprenticeship", expert=[3, 2], first=[0, 0], policies=[[4, 0]])
    assert answers["a"] == sympy.sqrt(5)
    assert answers["b"] == (fmpq(3), fmpq(0))
    assert answers["c"] == (fmpq(0), fmpq(2))
    assert answers["d"] == 2


def test_the_slack_of_two_constraints() -> None:
    # w = (1, 2): the expert is worth 8, the others 5 + 4 = 9 and 6 + 1 = 7 with their margins; so one holds, ξ = 1.
    others = {"x": {"mu": [1, 2], "margin": 4}, "y": {"mu": [0, 3], "margin": 1}}
    answers = solved("max-margin", w=[1, 2], expert=[2, 3], policies=others)
    assert answers == {"a": {"expert": fmpq(8), "x": fmpq(5), "y": fmpq(6)}, "b": fmpq(1), "c": fmpq(1)}
