"""Policy gradient: numbers from books and papers, as literals."""

from typing import Any

import pytest
import sympy
from flint import fmpq

from asking import rounded, solved
from rldrill.problems.errors import FileError


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
    assert (answers["c"], answers["d"]) == (objective, cut)


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


@pytest.mark.parametrize(
    ("preferences", "printed"),
    [
        # scipy.special.softmax, example: the rows of a matrix.
        (["1", "0.5", "0.2", "3"], ["0.105877", "0.0642177", "0.0475736", "0.782332"]),
        (["1", "-1", "7", "3"], ["0.00242746", "0.000328521", "0.979307", "0.0179366"]),
        (["2", "12", "13", "3"], ["0.0000122094", "0.268929", "0.731025", "0.0000331885"]),
        # Stanford's CS231n, notes on linear classification: the scores of a cat, dog and ship, and what weaker and
        # stronger regularisation makes of 1, −2 and 0.
        (["-2.85", "0.86", "0.28"], ["0.016", "0.631", "0.353"]),
        (["1", "-2", "0"], ["0.7", "0.04", "0.26"]),
        (["0.5", "-1", "0"], ["0.55", "0.12", "0.33"]),
    ],
)  # fmt: skip
def test_softmax_in_manuals_and_lectures(preferences: list[str], printed: list[str]) -> None:
    features = {str(number): [preference] for number, preference in enumerate(preferences)}
    chances = solved("softmax-policy", theta=[1], features=features)["b"].values()
    found = [float(rounded(chance, 15)) for chance in chances]
    for chance, text in zip(found, printed, strict=True):
        assert chance == pytest.approx(float(text), abs=0.6 * 10 ** -len(text.partition(".")[2]))


CUT_OFF = ([0, 0, 1, 0, "-0.5"], [1, 4, -3, -2, -1, -1])


@pytest.mark.parametrize(
    ("rewards", "values", "gamma", "lam", "printed"),
    [
        # DeepMind's RLax, test of truncated_generalized_advantage_estimation, the first row of the batch: six values,
        # the last of them of the state that the run was cut off in; and the second row up to where its discount is 0.
        (*CUT_OFF, "0.99", "1", ["-1.45118", "-4.4557", "2.5396", "0.5249", "-0.49"]),
        (*CUT_OFF, "0.99", "0.7", ["-0.676979", "-5.248167", "2.4846", "0.6704", "-0.49"]),
        (*CUT_OFF, "0.99", "0.4", ["0.56731", "-6.042", "2.3431", "0.815", "-0.49"]),
        ([0, 0, 0, 0], [-3, -2, -1, 0], "0.9", "0.7", ["2.2899", "1.73", "1", "0"]),
        ([0, 0, 0, 0], [-3, -2, -1, 0], "0.9", "0.4", ["1.725", "1.46", "1", "0"]),
        # Tianshou, test of compute_episodic_return: returns, which are advantages and values added.
        ([101, 102, 103, 200], [-3, 2, 3, 4], "0.99", "0.95", ["457.8344", "374.1143", "288.298", "196"]),
        ([104, 105, 106, 201], [-1, 5, 6, 7], "0.99", "0.95", ["465.5610", "378.1085", "289.387", "194"]),
    ],
)  # fmt: skip
def test_gae_in_libraries(rewards: Any, values: Any, gamma: str, lam: str, printed: list[str]) -> None:
    states = [f"s{time}" for time in range(len(rewards) + 1)]
    run: dict[str, Any] = {"states": states, "rewards": rewards}
    if len(values) == len(rewards):
        run["terminal"] = [states[-1]]
    known = dict(zip(states, values, strict=False))
    estimates = solved("advantage", run={"trajectory": run, "values": known, "lam": lam}, gamma=gamma)["b"]
    found = [float(rounded(value, 9)) for value in estimates]
    for estimate, text in zip(found, printed, strict=True):
        assert estimate == pytest.approx(float(text), abs=10 ** -len(text.partition(".")[2]))  # some cut


@pytest.mark.parametrize(
    ("right", "printed"),
    # Sutton & Barto 2018, example 13.1: the short corridor from its start is worth −44 to an ε-greedy policy (ε = 0.1)
    # that prefers right and −82 to one that prefers left; and about −11.6 to the best one, right with about 0.59.
    [("0.95", -44), ("0.05", -82), ("0.59", -11.6)],
)  # fmt: skip
def test_the_short_corridor(right: str, printed: float) -> None:
    steps = {("1", "right"): "2", ("1", "left"): "1", ("2", "right"): "1", ("2", "left"): "3",
             ("3", "right"): "end", ("3", "left"): "2"}  # fmt: skip
    rows = [[state, action, after, 1, -1] for (state, action), after in steps.items()]
    policy = {state: {"right": right, "left": str(1 - sympy.Rational(right))} for state in "123"}
    mdp = {"transitions": rows, "terminal": ["end"]}
    value = float(rounded(solved("policy-value", mdp=mdp, policy=policy, gamma=1)["a"]["1"], 6))
    assert value == pytest.approx(printed, abs=0.3 if printed < -12 else 0.1)


def test_a_ratio_of_two_softmax_policies_by_hand() -> None:
    # Old: ln 1 and ln 3, so the second action had 3/4; new: both alike, 1/2. ρ = 2/3 is below 1 − 1/5, A = −3: the
    # unclipped term is −2, the clipped one −12/5, which is smaller.
    sample = {
        "state": "s", "action": "b", "advantage": -3,
        "old_preferences": {"a": 0, "b": "ln 3"}, "preferences": {"a": 1, "b": 1},
    }  # fmt: skip
    answers = solved("ppo-clip", samples=[sample], epsilon="1/5")
    assert answers == {"a": fmpq(2, 3), "b": (-2, fmpq(-12, 5)), "c": fmpq(-12, 5), "d": True}


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"old": "1/2"}, "give either the old probability or the old policy's preferences"),
        ({"old_preferences": {"a": 0}}, "old_preferences: the preference of 'b' is missing"),
    ],
)
def test_old_policies_that_do_not_fit(changed: Any, message: str) -> None:
    sample = {"state": "s", "action": "b", "advantage": 1, "new": "1/2", "old_preferences": {"a": 0, "b": 1}}
    with pytest.raises(FileError, match=message):
        solved("ppo-clip", samples=[sample | changed], epsilon="1/5")


def test_the_entropy_of_cover_and_thomas() -> None:
    # Cover & Thomas 2006, example 1.1.2: 1/2, 1/4, 1/8 and four times 1/64 … have 2 bits; here 1/2, 1/4, 1/8, 1/8
    # (example 2.1.1), 7/4 bits, so 7/4 ln 2.
    features = {"a": [2, 0], "b": [1, 0], "c": [0, 0], "d": [0, 0]}
    answers = solved("softmax-policy", theta=["ln 2", 0], features=features, entropy=True)
    assert answers["b"] == {"a": fmpq(1, 2), "b": fmpq(1, 4), "c": fmpq(1, 8), "d": fmpq(1, 8)}
    assert sympy.simplify(answers["c"] - sympy.Rational(7, 4) * sympy.log(2)) == 0


def test_the_entropy_of_a_policy_in_powers_of_e() -> None:
    # With h = 1 and 0: ln(1 + e) − e/(1 + e).
    answers = solved("softmax-policy", theta=[1], features={"a": [1], "b": [0]}, entropy=True)
    assert rounded(answers["c"], 6) == rounded(sympy.log(1 + sympy.E) - sympy.E / (1 + sympy.E), 6) == "0.582203"


def test_a_critic_has_0_for_a_terminal_state() -> None:
    run = {"states": ["a", "end"], "actions": ["x"], "rewards": [2], "terminal": ["end"]}
    with pytest.raises(FileError, match="the value of 'end' must be 0, because it is terminal"):
        solved("advantage", run={"trajectory": run, "values": {"a": 1, "end": 4}, "lam": "1/2"}, gamma=1)
    actor = {"features": {"a": {"x": [1, 0], "y": [0, 1]}}, "theta": [0, 0], "alpha": "1/2", "beta": 1, "gamma": 1}
    assert solved("actor-critic", trajectory=run, values={"a": 1, "end": 0}, **actor)["a"] == (1,)
    with pytest.raises(FileError, match="the value of 'end' must be 0, because it is terminal"):
        solved("actor-critic", trajectory=run, values={"a": 1, "end": 4}, **actor)
