"""TD control and bandits: numbers from Sutton & Barto 2018, or worked out here by hand from its equations."""

from typing import Any

import pytest
import sympy
from flint import fmpq

from asking import solved
from rldrill.problems.errors import FileError


def test_exercise_2_1() -> None:
    # Two actions, ε = 0.5: the greedy action is selected with probability 0.5 + 0.5/2 = 0.75.
    answer = solved("epsilon-greedy", values={"greedy": 1, "other": 0}, epsilon=0.5)["a"]
    assert answer == {"greedy": fmpq(3, 4), "other": fmpq(1, 4)}


def test_exercise_2_2() -> None:
    # A = 1, 2, 2, 2, 3 and R = −1, 1, −2, 2, 0 give the averages −1, (1 − 2 + 2)/3 = 1/3 and 0.
    answers = solved("bandit", pulls=[["1", -1], ["2", 1], ["2", -2], ["2", 2], ["3", 0]])
    assert answers["a"] == {"1": -1, "2": fmpq(1, 3), "3": 0}
    assert answers["b"] == {"next": ("2",)}


@pytest.mark.parametrize("lefts", [1, 2, 5])
def test_example_5_5(lefts: int) -> None:
    # Infinite variance: π always goes left, b with probability 1/2, so k times left has the ratio 2^k. An episode
    # that ends on the left pays 1; the weighted estimate is then 1 from its first left-only episode on.
    left = {"states": ["s"] * lefts + ["end"], "actions": ["left"] * lefts, "rewards": [0] * (lefts - 1) + [1]}
    right = {"states": ["s", "end"], "actions": ["right"], "rewards": [0]}
    answers = solved(
        "importance-sampling",
        episodes=[left | {"terminal": ["end"]}, right | {"terminal": ["end"]}],
        target={"s": "left"},
        behaviour={"s": {"left": 0.5, "right": 0.5}},
        gamma=1,
    )
    assert answers["a"] == (2**lefts, 0)
    assert answers["b"] == fmpq(2**lefts, 2)
    assert answers["c"] == 1


def test_the_step_size_is_found_from_the_value_after_a_transition() -> None:
    # Eq. 6.7: 2 + α(1 + 1/2·6 − 2) = 5/2, so α = 1/4. Eq. 6.8 with the greatest value 10: 2 + α(1 + 5 − 2) = 5/2: 1/8.
    run = {"states": ["a", "b"], "actions": ["x", "y"], "rewards": [1]}
    given = {"trajectory": run, "values": {"a": {"x": 2}, "b": {"x": 10, "y": 6}}, "alpha": "alpha", "gamma": "1/2",
             "outcome": ["a", "x", "5/2"]}  # fmt: skip
    assert solved("sarsa", **given)["a"] == fmpq(1, 4)
    assert solved("q-learning", **given)["a"] == fmpq(1, 8)
    with pytest.raises(FileError, match="leave one number open"):
        solved("sarsa", **given | {"alpha": "1/2"})
    with pytest.raises(FileError, match=r"\(b, y\) is not updated"):
        solved("sarsa", **given | {"outcome": ["b", "y", 1]})


def test_expected_sarsa_by_hand() -> None:
    # Eq. 6.9 with α = γ = 1/2, ε = 1/2 and three actions: π is 2/3 for the best, 1/6 for the others.
    # 2/3·6 + 1/6·3 + 1/6·(−3) = 4; Q(a, x) = 2 + 1/2·(1 + 1/2·4 − 2) = 5/2.
    values = {"a": {"x": 2}, "b": {"x": 3, "y": 6, "z": -3}}
    run = {"states": ["a", "b"], "actions": ["x"], "rewards": [1]}
    answers = solved("expected-sarsa", trajectory=run, values=values, alpha=0.5, gamma=0.5, epsilon=0.5)
    assert answers["a"] == {("a", "x"): fmpq(5, 2)}


def test_the_exploration_rate_is_found_from_an_expected_update() -> None:
    # The next state is worth (1 − ε)·6 + ε·(6 + 2)/2 = 6 − 2ε: 2 + 1/2·(1 + 6 − 2ε − 2) = 4, so ε = 1/2.
    run = {"states": ["a", "b"], "actions": ["x"], "rewards": [1]}
    answers = solved("expected-sarsa", trajectory=run, values={"a": {"x": 2}, "b": {"x": 2, "y": 6}}, alpha="1/2",
                     gamma=1, epsilon="epsilon", outcome=["a", "x", 4])  # fmt: skip
    assert answers["a"] == fmpq(1, 2)


def test_epsilon_is_found_from_what_the_policy_does() -> None:
    # Three actions, so π of the best one is 1 − ε + ε/3 = 1 − 2/3·ε = 3/4 for ε = 3/8.
    values = {"x": 1, "y": 5, "z": 3}
    assert solved("epsilon-greedy", values=values, epsilon="epsilon", taken=["y", "3/4"])["a"] == fmpq(3, 8)
    # V = (1 − ε)·5 + ε·(1 + 5 + 3)/3 = 5 − 2ε = 4 for ε = 1/2.
    assert solved("epsilon-greedy", values=values, epsilon="epsilon", state_value=4)["a"] == fmpq(1, 2)
    with pytest.raises(FileError, match="leave it open, for it is asked for"):
        solved("epsilon-greedy", values=values, epsilon="1/2", state_value=4)


def test_lambda_is_found_from_a_value() -> None:
    # γ = 1, α = 1/2: Q(a, x) = 2 + 1/2·(1 + 4 − 2) = 7/2; then δ₁ = 6 − 4 = 2, Q(a, x) = 7/2 + 1/2·2·λ = 4: λ = 1/2.
    answers = solved(
        "sarsa-lambda",
        trajectory={"states": ["a", "b", "end"], "actions": ["x", "y"], "rewards": [1, 6], "terminal": ["end"]},
        values={"a": {"x": 2}, "b": {"y": 4}}, alpha="1/2", gamma=1, lam="lambda", outcome=["a", "x", 4],
    )  # fmt: skip
    assert answers["a"] == fmpq(1, 2)


def test_double_q_learning_by_hand() -> None:
    # Eq. 6.10 with α = γ = 1/2. Q₁ selects y in b (5 > 1), which Q₂ values with 2:
    # Q₁(a, x) = 4 + 1/2·(1 + 1/2·2 − 4) = 3. Then Q₂ selects x in a, which Q₁ values with 3:
    # Q₂(b, y) = 2 + 1/2·(−1 + 1/2·3 − 2) = 5/4.
    answers = solved(
        "double-q-learning",
        trajectory={"states": ["a", "b", "a"], "actions": ["x", "y"], "rewards": [1, -1]},
        values={"a": {"x": 4}, "b": {"x": 1, "y": 5}},
        second={"a": {"x": 9}, "b": {"x": 7, "y": 2}},
        updates=[1, 2], alpha=0.5, gamma=0.5,
    )  # fmt: skip
    assert answers["a"] == {("a", "x"): 3}
    assert answers["b"] == {("b", "y"): fmpq(5, 4)}


def test_dyna_q_by_hand() -> None:
    # Section 8.2 with α = γ = 1/2. Real: Q(a, x) = 0 + 1/2·(2 + 1/2·6 − 0) = 5/2, Q(b, y) = 4 + 1/2·(8 − 4) = 6.
    # The model had a, x → a with −2, which is replaced by → b with 2. Planned: max{6; 6} = 6 is what b is worth, so
    # Q(a, x) = 5/2 + 1/2·(2 + 3 − 5/2) = 15/4; then Q(b, y) = 6 + 1/2·(8 − 6) = 7 and
    # Q(a, x) = 15/4 + 1/2·(2 + 7/2 − 15/4) = 37/8.
    answers = solved(
        "dyna-q",
        trajectory={"states": ["a", "b", "end"], "actions": ["x", "y"], "rewards": [2, 8], "terminal": ["end"]},
        values={"a": {"x": 0, "y": 1}, "b": {"x": 6, "y": 4}}, alpha=0.5, gamma=0.5,
        model=[["a", "x", -2, "a"]], planned=[["a", "x"], ["b", "y"], ["a", "x"]],
    )  # fmt: skip
    assert answers["a"] == {("a", "x"): fmpq(5, 2), ("b", "y"): 6}
    assert answers["b"] == {("a", "x"): fmpq(37, 8), ("b", "y"): 7}


def test_sarsa_lambda_by_hand() -> None:
    # Section 12.7 with one feature per pair; γ = 1, λ = α = 1/2. δ₀ = 1 + 4 − 2 = 3: Q(a, x) = 7/2.
    # Then e(a, x) = 1/2, e(b, y) = 1 and δ₁ = 6 − 4 = 2: Q(a, x) = 7/2 + 1/2·2·1/2 = 4, Q(b, y) = 5.
    answers = solved(
        "sarsa-lambda",
        trajectory={"states": ["a", "b", "end"], "actions": ["x", "y"], "rewards": [1, 6], "terminal": ["end"]},
        values={"a": {"x": 2}, "b": {"y": 4}}, alpha=0.5, gamma=1, lam=0.5,
    )  # fmt: skip
    assert answers["a"] == {("a", "x"): fmpq(1, 2), ("b", "y"): 1}
    assert answers["b"] == {("a", "x"): 4, ("b", "y"): 5}


def test_both_targets_by_hand() -> None:
    # Eqs. 6.7 and 6.8: 3 + 1/2·(−4) = 1 for the action taken, 3 + 1/2·8 = 7 for the best one.
    run = {"states": ["a", "b"], "actions": ["x", "y"], "rewards": [3]}
    values = {"a": {"x": 5}, "b": {"x": 8, "y": -4}}
    answers = solved("sarsa-versus-q-learning", trajectory=run, values=values, alpha=0.1, gamma=0.5)
    assert (answers["a"], answers["b"], answers["c"]) == (1, 7, "A")


def test_the_step_size_from_a_target_of_sarsa_by_hand() -> None:
    # Sarsa: y₀ = 2 + 1/2·2 = 3, Q(a, go) ← 1 + 2α, y₁ = 4 + 1/2·(1 + 2α) = 5, so α = 1/2.
    # Q-learning: y₀ = 2 + 1/2·6 = 5, Q(a, go) ← 1 + 1/2·4 = 3, y₁ = 4 + 1/2·max{3; 2} = 11/2.
    run = {"states": ["a", "b", "a"], "actions": ["go"] * 3, "rewards": [2, 4]}
    values = {"a": {"go": 1, "stay": 2}, "b": {"go": 2, "stay": 6}}
    back = {"trajectory": run, "values": values, "gamma": "1/2", "alpha": "alpha", "known": 5}
    answers = solved("sarsa-versus-q-learning", **back)
    assert (answers["a"], answers["b"]) == (fmpq(1, 2), (5, fmpq(11, 2)))
    with pytest.raises(FileError, match="no target of Sarsa reads an updated value, so alpha does not follow"):
        solved("sarsa-versus-q-learning", **back | {"trajectory": run | {"actions": ["go", "go", "stay"]}})
    with pytest.raises(FileError, match="leave alpha open, which is asked for then"):
        solved("sarsa-versus-q-learning", **back | {"alpha": "1/2"})


def test_ucb_by_hand() -> None:
    # Eq. 2.10 at t = 7 with c = 2: averages 3, 1, 5 after 2, 3, 1 pulls.
    pulls = [["x", 2], ["y", 0], ["z", 5], ["x", 4], ["y", 1], ["y", 2]]
    answers = solved("bandit", pulls=pulls, c=2)
    log = sympy.log(7)
    expected = {"x": 3 + 2 * sympy.sqrt(log / 2), "y": 1 + 2 * sympy.sqrt(log / 3), "z": 5 + 2 * sympy.sqrt(log)}
    assert answers["b"] == expected
    assert answers["c"] == {"next": ("z",)}


def test_the_weight_that_makes_two_bounds_equal_by_hand() -> None:
    # Eq. 2.10 at t = 6: x has 3 after 4 pulls, y has 1 after one. 3 + c/2·√(ln 6) = 1 + c·√(ln 6), so c = 4/√(ln 6).
    pulls = [["x", 2], ["x", 4], ["y", 1], ["x", 1], ["x", 5]]
    answers = solved("bandit", pulls=pulls, between=["x", "y"])
    assert sympy.simplify(answers["b"] - 4 / sympy.sqrt(sympy.log(6))) == 0
    assert answers["c"] == {"next": ("y",)}
    with pytest.raises(FileError, match="no weight above 0 makes their bounds equal"):
        solved("bandit", pulls=pulls, between=["y", "x"])


def test_a_gradient_bandit_with_logarithms_by_hand() -> None:
    # e^(ln 3) = 3 and e^0 = 1: π = 3/4 and 1/4. The reward is 4 above the mean 2: H(x) = ln 3 − 1/2·4·3/4.
    answers = solved("bandit", pulls=[["x", 1], ["y", 3]], preferences={"x": "ln 3", "y": 0}, alpha="1/2",
                     pulled=["y", 6])  # fmt: skip
    assert answers["a"] == {"x": fmpq(3, 4), "y": fmpq(1, 4)}
    assert answers["b"] == {"x": sympy.log(3) - sympy.Rational(3, 2), "y": fmpq(3, 2)}


def test_a_gradient_bandit_by_hand() -> None:
    # Eq. 2.12: equal preferences of two arms, so π = 1/2; the baseline is (1 + 3)/2 = 2, the reward 6, α = 1/4.
    # H(x) = 1 + 1/4·(6 − 2)·(1 − 1/2) = 3/2, H(y) = 1 − 1/4·(6 − 2)·1/2 = 1/2.
    answers = solved("bandit", pulls=[["x", 1], ["y", 3]], preferences={"x": 1, "y": 1}, alpha="1/4", pulled=["x", 6])
    assert answers["a"] == {"x": fmpq(1, 2), "y": fmpq(1, 2)}
    assert answers["b"] == {"x": fmpq(3, 2), "y": fmpq(1, 2)}


def test_ucb_takes_an_arm_that_was_never_pulled_first() -> None:
    # Sutton & Barto 2018, section 2.7: with N(a) = 0 an arm is considered to be maximising. It has no sample average.
    pulls = [["a", 1], ["b", 0], ["a", 2]]
    answers = solved("bandit", arms=["a", "b", "c"], pulls=pulls, c=1)
    assert answers["a"] == {"a": fmpq(3, 2), "b": fmpq(0)}
    assert list(answers["b"]) == ["a", "b"]
    assert answers["c"] == {"next": ("c",)}
    assert solved("bandit", arms=["a", "b", "c", "d"], pulls=pulls, c=1)["c"] == {"next": ("c", "d")}
    assert solved("bandit", arms=["a", "b", "c"], pulls=pulls)["b"] == {"next": ("a",)}  # greedy: 3/2 beats 0


def test_all_arms_that_are_pulled_are_listed() -> None:
    with pytest.raises(FileError, match=r"a pull is given for 'c', which does not occur; leave it out, or correct"):
        solved("bandit", arms=["a", "b"], pulls=[["a", 1], ["c", 0]])


TRACED: dict[str, Any] = {
    "trajectory": {"states": ["a", "b", "a", "end"], "actions": ["x", "y", "x"], "rewards": [0, 3, 8],
                   "terminal": ["end"]},
    "values": {"a": {"x": 4, "y": 0}, "b": {"x": 2, "y": 0}},
    "alpha": "1/2", "gamma": 1, "lam": "1/2",
}  # fmt: skip


def test_sarsa_lambda_with_replacing_traces_by_hand() -> None:
    # δ_0 = 0 − 4: Q(a, x) = 2. δ_1 = 3 + 2 − 0 = 5, e(a, x) = 1/2: Q(a, x) = 2 + 5/4 = 13/4, Q(b, y) = 5/2.
    # δ_2 = 8 − 13/4 = 19/4, e(a, x) = 1, e(b, y) = 1/2: Q(a, x) = 13/4 + 19/8 = 45/8, Q(b, y) = 5/2 + 19/16 = 59/16.
    answers = solved("sarsa-lambda", **TRACED, replacing=True)
    assert answers["a"] == {("a", "x"): fmpq(1), ("b", "y"): fmpq(1, 2)}
    assert answers["b"] == {("a", "x"): fmpq(45, 8), ("b", "y"): fmpq(59, 16)}


def test_watkins_q_lambda_by_hand() -> None:
    # δ_0 = 0 + max{2, 0} − 4 = −2: Q(a, x) = 3. In b the action y is not greedy, so the trace of (a, x) is cut.
    # δ_1 = 3 + max{3, 0} − 0 = 6: Q(b, y) = 3, Q(a, x) stays. In a the action x is greedy: e(b, y) = 1/2, e(a, x) = 1.
    # δ_2 = 8 − 3 = 5: Q(a, x) = 3 + 5/2 = 11/2, Q(b, y) = 3 + 5/4 = 17/4.
    answers = solved("sarsa-lambda", **TRACED, watkins=True)
    assert answers["a"] == {("a", "x"): fmpq(1), ("b", "y"): fmpq(1, 2)}
    assert answers["b"] == {("a", "x"): fmpq(11, 2), ("b", "y"): fmpq(17, 4)}


def test_watkins_q_0_is_q_learning() -> None:
    known = {name: value for name, value in TRACED.items() if name != "lam"}
    expected = solved("q-learning", **known)["a"]
    assert solved("sarsa-lambda", **known, lam=0, watkins=True)["b"] == expected


def test_no_action_is_greedy_while_a_parameter_is_open() -> None:
    with pytest.raises(FileError, match="lambda is left open, so no action can be called greedy; give a number"):
        solved("sarsa-lambda", **{**TRACED, "lam": "lambda"}, watkins=True)


SEPARATE: dict[str, Any] = {"values": {"a": {"x": 4, "y": 0}, "b": {"x": 2, "y": 0}}, "alpha": "1/2", "gamma": 1,
                            "terminal": ["end"], "td_errors": True}  # fmt: skip


def test_transitions_that_do_not_join_by_hand() -> None:
    # (a, x) → b with 2: max{2, 0} for Q-learning, so δ = 2 + 2 − 4 = 0; y follows for Sarsa, so δ = 2 + 0 − 4 = −2 and
    # Q(a, x) = 3. (a, y) → end with 4: δ = 4 − 0, and Q(a, y) = 2.
    q_learning = solved("q-learning", transitions=[["a", "x", "b", 2], ["a", "y", "end", 4]], **SEPARATE)
    assert q_learning == {"a": (0, 4), "b": {("a", "x"): fmpq(4), ("a", "y"): fmpq(2)}}
    sarsa = solved("sarsa", transitions=[["a", "x", "b", 2, "y"], ["a", "y", "end", 4]], **SEPARATE)
    assert sarsa == {"a": (-2, 4), "b": {("a", "x"): fmpq(3), ("a", "y"): fmpq(2)}}


@pytest.mark.parametrize("name", ["q-learning", "sarsa"])
def test_transitions_that_join_are_a_run(name: str) -> None:
    rows = [["a", "x", "b", 0, "y"], ["b", "y", "a", 3, "x"], ["a", "x", "end", 8]]
    known = {"values": TRACED["values"], "alpha": "1/2", "gamma": 1}
    along = solved(name, trajectory=TRACED["trajectory"], **known)
    assert solved(name, transitions=rows, terminal=["end"], **known) == along


@pytest.mark.parametrize("name", ["q-learning", "sarsa"])
def test_actions_in_a_terminal_state_are_worth_0(name: str) -> None:
    known = {"trajectory": TRACED["trajectory"], "alpha": "1/2", "gamma": 1}
    expected = solved(name, **known, values=TRACED["values"])
    assert solved(name, **known, values=TRACED["values"] | {"end": {"x": 0}}) == expected
    with pytest.raises(FileError, match="values: the action value of 'end' must be 0, because it is terminal"):
        solved(name, **known, values=TRACED["values"] | {"end": {"x": 3}})
