"""Returns and expectations from books, as literals."""

from typing import Any

from flint import fmpq

from asking import solved


def test_exercise_3_9_of_sutton_and_barto() -> None:
    # γ = 0.9, the first reward is 2, followed by an infinite sequence of 7s: G1 = 7/(1 − 0.9) = 70, G0 = 2 + 0.9·70.
    assert solved("return-infinite", first=[2], repeated=[7], gamma=0.9) == {"a": 70, "b": 65}


def test_equation_3_10_of_sutton_and_barto() -> None:
    # A reward of +1 for ever is worth 1/(1 − γ).
    value = solved("return-infinite", repeated=[1], gamma="gamma")["a"]
    assert value(fmpq(3, 4)) == 4


def test_exercise_3_22_of_sutton_and_barto() -> None:
    # The left action earns 1, 0, 1, 0, … and the right one 0, 2, 0, 2, …: left is better for γ = 0, right for
    # γ = 0.9, and for γ = 0.5 both are worth 4/3.
    def value(rewards: list[int], gamma: float) -> Any:
        return solved("return-infinite", repeated=rewards, gamma=gamma)["a"]

    assert value([1, 0], 0) > value([0, 2], 0)
    assert value([1, 0], 0.9) < value([0, 2], 0.9)
    assert value([1, 0], 0.5) == value([0, 2], 0.5) == fmpq(4, 3)
