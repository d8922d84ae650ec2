"""Policy gradient: numbers from books and papers, as literals."""

import pytest
import sympy
from flint import fmpq

from asking import solved


@pytest.mark.parametrize(
    ("ratio", "advantage", "objective", "cut"),
    [
        # Schulman et al. 2017, figure 1 with the ε = 0.2 of their experiments: L against the ratio r. For A > 0 it
        # rises up to r = 1 + ε and is flat from there on; for A < 0 it is flat up to r = 1 − ε and falls from there.
        ("1/2", 1, fmpq(1, 2), False),
        ("1", 1, fmpq(1), False),
        ("3/2", 1, fmpq(6, 5), True),
        ("1/2", -1, fmpq(-4, 5), True),
        ("1", -1, fmpq(-1), False),
        ("3/2", -1, fmpq(-3, 2), False),
    ],
)
def test_figure_1_of_ppo(ratio: str, advantage: int, objective: fmpq, cut: bool) -> None:
    new = str(sympy.Rational(ratio) / 2)
    sample = {"state": "s", "action": "a", "old": "1/2", "new": new, "advantage": advantage}
    answers = solved("ppo-clip", samples=[sample], epsilon="1/5")
    assert (answers["d"], answers["e"]) == (objective, cut)


def test_the_bernoulli_logistic_unit_of_williams() -> None:
    # Williams 1992, section 4: the characteristic eligibility of a weight is (y − p)x, where the unit gives y = 1
    # with the probability p. Two actions with features x and 0, p = 3/4, x = 2: (1 − 3/4)·2 and (0 − 3/4)·2.
    scores = solved("score-function", features={"1": [2], "0": [0]}, policy={"1": "3/4", "0": "1/4"})
    assert scores == {"a": (fmpq(1, 2),), "b": (fmpq(-3, 2),)}


def test_the_gradient_bandit_is_reinforce_with_a_baseline() -> None:
    # Sutton & Barto 2018, eq. 2.12, preferences from 0, α = 0.1, action 1 earns 5 while the average is 4:
    # H(1) = 0 + 0.1·(5 − 4)·(1 − 1/4) = 0.075, the other three 0 − 0.1·(5 − 4)·1/4 = −0.025.
    one_for_each = {str(k): [int(k == i) for i in range(1, 5)] for k in range(1, 5)}
    after = solved(
        "reinforce-baseline",
        trajectory={"states": ["bandit", "over"], "actions": ["1"], "rewards": [5], "terminal": ["over"]},
        features={"bandit": one_for_each}, theta=[0, 0, 0, 0], baseline={"bandit": 4}, alpha=0.1, gamma=1,
    )["c"]  # fmt: skip
    assert after == (fmpq(3, 40), fmpq(-1, 40), fmpq(-1, 40), fmpq(-1, 40))


def test_the_features_of_the_short_corridor() -> None:
    # Sutton & Barto 2018, example 13.1: x(s, right) = (1, 0), x(s, left) = (0, 1) in every state. An ε-greedy policy
    # with ε = 0.1 that prefers right takes it with probability 0.95, so by eq. 13.9 the score of right is
    # (1 − 0.95, 0 − 0.05).
    corridor = {"right": [1, 0], "left": [0, 1]}
    scores = solved("score-function", features=corridor, policy={"right": 0.95, "left": 0.05}, action="right")
    assert scores["a"] == (fmpq(1, 20), fmpq(-1, 20))
    # The best probability of right, 2 − √2 (printed as about 0.59), belongs to weights that differ by
    # ln((2 − √2)/(√2 − 1)) = ln √2.
    chances = solved("score-function", features=corridor, theta=["ln 2", 0], action="right")["a"]
    assert chances == {"right": fmpq(2, 3), "left": fmpq(1, 3)}


def test_gae_by_hand() -> None:
    # Schulman et al. 2016, eq. 16, with γ = 0.99 and λ = 0.95 as in PPO's experiments, so γλ = 0.9405; no values, and
    # three rewards of 1: δ = 1, 1, 1 and 1 + 0.9405 + 0.9405², 1 + 0.9405, 1.
    run = {"states": ["s", "s", "s", "end"], "rewards": [1, 1, 1], "terminal": ["end"]}
    estimates = solved("advantage", run={"trajectory": run, "values": {"s": 0}, "lam": 0.95}, gamma=0.99)["b"]
    step = fmpq(9405, 10000)
    assert estimates == (1 + step + step**2, 1 + step, 1)


def test_one_step_actor_critic_by_hand() -> None:
    # The box of Sutton & Barto 2018, section 13.5, in its first step (I = 1), α = β = 1/2, γ = 1/2, π even:
    # δ = 3 + 1/2·4 − 1 = 4, V(s) = 1 + 1/2·4 = 3, θ = 1/2·4·(1/2, −1/2) = (1, −1).
    answers = solved(
        "actor-critic",
        trajectory={"states": ["s", "t"], "actions": ["x"], "rewards": [3]},
        features={"s": {"x": [1, 0], "y": [0, 1]}}, theta=[0, 0], values={"s": 1, "t": 4},
        alpha="1/2", beta="1/2", gamma="1/2",
    )  # fmt: skip
    assert answers == {"a": (4,), "b": {"s": 3}, "c": (1, -1)}
