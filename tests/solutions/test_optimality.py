"""Optimal values of larger models, exactly, and what happens where there are none."""

import random
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from flint import fmpq

from asking import solved
from rldrill.problems.errors import FileError
from rldrill.problems.models import Model
from rldrill.solutions.optimality import optimum
from rldrill.solutions.oracle import optimal_values, tensors


def random_model(states: int, actions: int, seed: int) -> dict[str, Any]:
    """A sparse model: every action leads to three states, the end perhaps among them."""
    choose = random.Random(seed)
    rows = []
    for state in range(states):
        for action in range(actions):
            weights = [choose.randint(1, 5) for _ in range(3)]
            for after, weight in zip(choose.sample(range(states + 1), 3), weights, strict=True):
                name = "end" if after == states else f"s{after}"
                rows.append([f"s{state}", f"a{action}", name, f"{weight}/{sum(weights)}", choose.randint(-9, 9)])
    return {"transitions": rows, "terminal": ["end"]}


@pytest.mark.parametrize("gamma", ["9/10", "1/2", "0"])
def test_sixty_states_against_value_iteration_in_floating_point(gamma: str) -> None:
    model = Model.model_validate(random_model(60, 4, seed=3))
    exact = optimum(model, Fraction(gamma))
    P, R = tensors(model)
    V = optimal_values(P, R, float(Fraction(gamma)), len(model.states))
    values = [exact.values[state] for state in model.states]
    np.testing.assert_allclose([float(int(v.p) / int(v.q)) for v in values], V[:-1], rtol=1e-9, atol=1e-9)


def test_a_file_with_a_hundred_states_is_solved_exactly() -> None:
    mdp = random_model(100, 3, seed=5)
    answers = solved("optimal-value", mdp=mdp, gamma="9/10")
    for state, value in answers["a"].items():
        best = max(answers["c"][state, action] for action in ("a0", "a1", "a2"))
        assert value == best
        assert all(answers["c"][state, action] == best for action in answers["b"][state])
    policy = {state: actions[0] for state, actions in answers["b"].items()}
    assert solved("policy-value", mdp=mdp, policy=policy, gamma="9/10")["a"] == answers["a"]


def test_all_of_several_best_actions_are_told() -> None:
    rows = [["a", "x", "end", 1, 4], ["a", "y", "b", 1, 2], ["a", "z", "end", 1, 3], ["b", "x", "end", 1, 4]]
    answers = solved("optimal-value", mdp={"transitions": rows, "terminal": ["end"]}, gamma="1/2")
    assert answers["b"] == {"a": ("x", "y"), "b": ("x",)}


# Undiscounted: a walk of three states; every step costs 1, and "jump" may fail and lead back.
WALK = [
    ["a", "walk", "b", 1, -1], ["b", "walk", "c", 1, -1], ["c", "walk", "end", 1, -1],
    ["a", "jump", "end", "1/2", -1], ["a", "jump", "a", "1/2", -1], ["b", "back", "a", 1, -1],
]  # fmt: skip


def test_without_discount_where_every_episode_can_end() -> None:
    # jump from a: V = −1 + V/2, so −2, better than walking (−3); b: −1 + V(c) = −2 or −1 + V(a) = −3.
    answers = solved("optimal-value", mdp={"transitions": WALK, "terminal": ["end"]}, gamma=1)
    assert answers["a"] == {"a": -2, "b": -2, "c": -1}
    assert answers["b"] == {"a": ("jump",), "b": ("walk",), "c": ("walk",)}


def test_what_is_left_open_decides_no_action() -> None:
    rows = [["a", "x", "end", "p", 4], ["a", "x", "a", "1-p", 4]]
    with pytest.raises(FileError, match="p is left open"):
        solved("optimal-value", mdp={"transitions": rows, "terminal": ["end"]}, gamma="1/2")


def test_without_a_future_the_best_reward_is_the_value() -> None:
    model = Model.model_validate(random_model(12, 4, seed=8))
    values = optimum(model, Fraction(0)).values
    for state in model.states:
        rewards = [
            sum(row.probability * row.reward for row in model.outcomes[state, action])  # type: ignore[operator]
            for action in model.actions[state]
        ]
        best = max(rewards)
        assert values[state] == fmpq(best.numerator, best.denominator)
