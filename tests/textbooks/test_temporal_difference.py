"""Numbers of temporal difference learning, from books or worked out by hand in the comments."""

from typing import Any

import pytest
from flint import fmpq

from asking import solved
from rldrill.problems.errors import FileError


def test_example_6_4_of_sutton_and_barto() -> None:
    # "You are the Predictor": A, 0, B, 0; six times B, 1; once B, 0. V(B) is 3/4 for both methods; batch TD(0) gives
    # V(A) = 3/4, batch Monte Carlo V(A) = 0.
    episodes = [
        {"states": ["A", "B"], "rewards": [0, 0]},
        {"states": ["B"], "rewards": [1], "times": 6},
        {"states": ["B"], "rewards": [0]},
    ]
    answers = solved("batch-td-and-mc", episodes=episodes, gamma=1)
    assert answers["a"] == {"A": fmpq(0), "B": fmpq(3, 4)}
    assert answers["b"] == {"A": fmpq(3, 4), "B": fmpq(3, 4)}


def test_exercise_5_5_of_sutton_and_barto() -> None:
    # One state, one episode of ten steps with reward +1 each, γ = 1. First visit: the one return, 10. Every visit:
    # the mean of the returns 10, 9, …, 1, which is 55/10.
    run = {"states": [*["s"] * 10, "end"], "rewards": [1] * 10, "terminal": ["end"]}
    first = solved("monte-carlo", trajectory=run, values={"s": 0}, alpha=1, gamma=1, visits="first")
    assert first["a"] == tuple(range(10, 0, -1))
    assert first["b"] == {"s": fmpq(10)}
    visits = [["s", value] for value in range(10, 0, -1)]
    assert solved("sample-average", values={"s": 0}, counts={"s": 0}, visits=visits)["a"] == {"s": fmpq(11, 2)}
    episode = {"states": ["s"] * 10, "rewards": [1] * 10}
    assert solved("batch-td-and-mc", episodes=[episode], gamma=1)["a"] == {"s": fmpq(11, 2)}


def test_example_6_2_of_sutton_and_barto() -> None:
    # The random walk A … E, every value 1/2 in the beginning, α = 1/10: after C, B, A, left only V(A) has changed, by
    # 1/10·(0 + 0 − 1/2) to 9/20. The values of D and E, where the episode does not come, are given and do not matter.
    values = dict.fromkeys("ABCDE", "1/2")
    expected = {"C": fmpq(1, 2), "B": fmpq(1, 2), "A": fmpq(9, 20)}
    run = {"states": ["C", "B", "A", "left"], "rewards": [0, 0, 0], "terminal": ["left", "right"]}
    moves = [["C", "B", 0], ["B", "A", 0], ["A", "left", 0]]
    known = {"values": values, "alpha": "1/10", "gamma": 1}
    assert solved("td-zero", trajectory=run, **known)["a"] == expected
    assert solved("td-zero", transitions=moves, terminal=["left", "right"], **known)["a"] == expected
    # n = 2 from the beginning: 0 + 0 + V(A); n = 3: 0.
    returns = solved("n-step-return", trajectory=run, values=values, gamma=1, asked=[[0, 2], [0, 3]])
    assert list(returns.values()) == [fmpq(1, 2), fmpq(0)]


def test_the_weights_of_figure_12_2_of_sutton_and_barto() -> None:
    # The weights 1 − λ, (1 − λ)λ, (1 − λ)λ² and, for the full return, λ³ (T − t − 1 = 3), read off one by one:
    # values 1, 0, 0 at the ends of the n-step returns leave one n-step return alone; so does a last reward of 1
    # for the full return.
    states = ["a", "b", "c", "d", "end"]
    expected = {"b": fmpq(1, 4), "c": fmpq(3, 16), "d": fmpq(9, 64), "end": fmpq(27, 64)}
    for alone, weight in expected.items():
        run = {"states": states, "rewards": [0, 0, 0, int(alone == "end")], "terminal": ["end"]}
        values = {state: int(state == alone) for state in states[:-1]}
        assert solved("lambda-return", trajectory=run, values=values, gamma=1, lam="3/4")["b"] == weight


def test_a_lambda_return_by_hand() -> None:
    # γ = λ = 1/2. From time 0: one step 1 + 1/2·4 = 3, two steps 1 + 1/2·2 + 1/4·8 = 4, all 1 + 1 + 1/4·4 = 3;
    # 1/2·3 + 1/4·4 + 1/4·3 = 13/4. With α = 1/2: V(a) = 2 + 1/2·(13/4 − 2) = 21/8.
    run = {"states": ["a", "b", "c", "end"], "rewards": [1, 2, 4], "terminal": ["end"]}
    known = {"trajectory": run, "values": {"a": 2, "b": 4, "c": 8}, "gamma": "1/2", "lam": "1/2"}
    answers = solved("lambda-return", **known)
    assert answers["a"] == (3, 4, 3)
    assert answers["b"] == fmpq(13, 4)
    assert solved("td-lambda-forward", **known, alpha="1/2", asked=[0])["b"] == {"a": fmpq(21, 8)}


def test_traces_by_hand() -> None:
    # γ = 1/2, λ = 4/5, so every step leaves 2/5. a: 1, 2/5, 4/25 + 1 = 29/25, 58/125; b: 0, 1, 2/5, 4/25 + 1 = 29/25.
    traces = solved("eligibility-trace", states=["a", "b", "a", "b"], gamma="1/2", lam="4/5", asked=[0, 2, 3])
    assert traces == {
        "a": {"a": fmpq(1), "b": fmpq(0)},
        "b": {"a": fmpq(29, 25), "b": fmpq(2, 5)},
        "c": {"a": fmpq(58, 125), "b": fmpq(29, 25)},
    }


def test_the_backward_view_by_hand() -> None:
    # α = λ = 1/2, γ = 1, V(a) = 4, V(b) = 2.
    # a → b, r = 0: δ = 0 + 2 − 4 = −2; V(a) = 4 − 1 = 3.
    # b → a, r = 3: δ = 3 + 3 − 2 = 4; e(a) = 1/2, e(b) = 1; V(a) = 3 + 1/2·1/2·4 = 4, V(b) = 2 + 1/2·4 = 4.
    # a → end, r = 8: δ = 8 − 4 = 4; e(a) = 1/4 + 1 = 5/4, e(b) = 1/2; V(a) = 4 + 5/2 = 13/2, V(b) = 4 + 1 = 5.
    run = {"states": ["a", "b", "a", "end"], "rewards": [0, 3, 8], "terminal": ["end"]}
    known = {"trajectory": run, "values": {"a": 4, "b": 2}, "alpha": "1/2", "gamma": 1, "lam": "1/2"}
    assert solved("td-lambda-backward", **known)["a"] == {"a": fmpq(13, 2), "b": fmpq(5)}


def test_first_and_every_visit_by_hand() -> None:
    # γ = 1/2, rewards 1, 2, 4: R2 = 4, R1 = 2 + 2 = 4, R0 = 1 + 2 = 3. α = 1/2, V(a) = 1, V(b) = 0; a, b, a.
    # First visit: V(a) = 1 + 1/2·(3 − 1) = 2. Every visit: then V(a) = 2 + 1/2·(4 − 2) = 3. V(b) = 2.
    run = {"states": ["a", "b", "a", "end"], "rewards": [1, 2, 4], "terminal": ["end"]}
    known = {"trajectory": run, "values": {"a": 1, "b": 0}, "alpha": "1/2", "gamma": "1/2"}
    assert solved("monte-carlo", **known, visits="first") == {"a": (3, 4, 4), "b": {"a": fmpq(2), "b": fmpq(2)}}
    assert solved("monte-carlo", **known, visits="every")["b"] == {"a": fmpq(3), "b": fmpq(2)}


def test_the_weights_of_equation_2_6_of_sutton_and_barto() -> None:
    # α = 1/2, three returns: (1/2)³, (1/2)², 1/2, and (1/2)³ for the first value: 8/8 + 8/8 + 4/4 + 2/2 = 4.
    visits = [["s", 8], ["s", 4], ["s", 2]]
    answers = solved("sample-average", values={"s": 8}, visits=visits, alpha="1/2")
    assert answers["a"] == (fmpq(1, 8), fmpq(1, 4), fmpq(1, 2))
    assert answers["b"] == fmpq(4)


CUT_OFF: dict[str, Any] = {"states": ["a", "b", "c"], "rewards": [1, 2]}
ENDED: dict[str, Any] = {"states": ["a", "b", "end"], "rewards": [1, 2], "terminal": ["end"]}


def test_a_run_that_is_cut_off_goes_on_with_the_value_of_its_last_state() -> None:
    # γ = λ = 1/2. One step 1 + 1/2·4 = 3, two steps 1 + 1/2·2 + 1/4·8 = 4; the two steps have all the weight that is
    # left: 1/2·3 + 1/2·4 = 7/2. From time 1: 2 + 1/2·8 = 6. The advantage estimates are these minus the values.
    known = {"trajectory": CUT_OFF, "values": {"a": 2, "b": 4, "c": 8}, "gamma": "1/2", "lam": "1/2"}
    assert solved("lambda-return", **known) == {"a": (3, 4), "b": fmpq(7, 2)}
    assert solved("td-lambda-forward", **known, alpha="1/2", asked=[0, 1])["a"] == (fmpq(7, 2), 6)
    gamma = known.pop("gamma")
    assert solved("advantage", run=known, gamma=gamma)["b"] == (fmpq(7, 2) - 2, 6 - 4)


def test_beyond_the_end_of_the_episode_an_n_step_return_is_the_return() -> None:
    # Sutton & Barto 2018, below eq. 7.1: all terms beyond the end are taken to be 0. 1 + 1/2·2 = 2.
    answers = solved("n-step-return", trajectory=ENDED, values={"a": 2, "b": 4}, gamma="1/2", asked=[[0, 2], [0, 7]])
    assert answers == {"a": 2, "b": 2}


@pytest.mark.parametrize("value", [0, 4])
@pytest.mark.parametrize(
    ("name", "given"),
    [
        ("td-zero", {"alpha": "1/2"}),
        ("n-step-return", {"asked": [[0, 1]]}),
        ("lambda-return", {"lam": "1/2"}),
        ("td-lambda-backward", {"alpha": "1/2", "lam": "1/2"}),
    ],
)
def test_a_terminal_state_is_worth_0(name: str, given: dict[str, Any], value: int) -> None:
    given = {"trajectory": ENDED, "values": {"a": 2, "b": 4, "end": value}, "gamma": "1/2"} | given
    if value == 0:
        assert solved(name, **given)
        return
    with pytest.raises(FileError, match=r"the value of 'end' must be 0, because it is terminal; give 0, or take it"):
        solved(name, **given)


def test_an_n_step_return_of_a_run_that_is_cut_off_may_not_go_beyond_it() -> None:
    with pytest.raises(FileError, match="5 steps do not fit into a run that is cut off at 2; list 'c' as terminal"):
        solved("n-step-return", trajectory=CUT_OFF, values={"a": 2, "b": 4, "c": 8}, gamma=1, asked=[[0, 5]])


def test_a_discount_for_every_step_by_hand() -> None:
    # γ_1 = 1/2, γ_2 = 1/4. Two steps: 1 + 1/2·(2 + 1/4·8) = 3; one step: 1 + 1/2·4 = 3, from time 1: 2 + 1/4·8 = 4.
    # With λ = 1/2, backwards: R_1 = 2 + 1/4·8 = 4, R_0 = 1 + 1/2·(1/2·4 + 1/2·4) = 3.
    known = {"trajectory": CUT_OFF, "values": {"a": 2, "b": 4, "c": 8}, "gamma": ["1/2", "1/4"]}
    assert solved("n-step-return", **known, asked=[[0, 2], [0, 1], [1, 1]]) == {"a": 3, "b": 3, "c": 4}
    assert solved("lambda-return", **known, lam="1/2")["b"] == 3


def test_a_discount_of_0_cuts_the_return_off() -> None:
    # Sutton & Barto 2018, eq. 17.1: where γ is 0 the return ends, as if in a terminal state. R_2 = 4, R_1 = 2 and
    # R_0 = 1 + 1/2·2 = 2.
    assert solved("return", rewards=[1, 2, 4], gamma=["1/2", 0, 1])["a"] == (2, 2, 4)
    assert solved("return", rewards=[1, 2, 4], gamma=["1/2", 0, 1], time=1) == {"a": 2, "b": 2}


@pytest.mark.parametrize(
    ("name", "more"), [("n-step-return", {"asked": [[0, 2], [0, 5]]}), ("lambda-return", {"lam": "1/3"})]
)
def test_the_same_discount_in_every_step_is_the_discount(name: str, more: dict[str, Any]) -> None:
    known = {"trajectory": ENDED, "values": {"a": 2, "b": 4}} | more
    assert solved(name, **known, gamma=["2/3", "2/3"]) == solved(name, **known, gamma="2/3")


def test_there_are_as_many_discounts_as_rewards() -> None:
    with pytest.raises(FileError, match="gamma: 3 rewards need as many discounts, or a single one, not 2"):
        solved("return", rewards=[1, 2, 4], gamma=["1/2", 0])


def test_replacing_traces_by_hand() -> None:
    # γλ = 2/5. A visit sets the trace to 1: a at times 0, 2 and 3, b at time 1, so b has 2/5 at time 2, 4/25 at time 3.
    known = {"states": ["a", "b", "a", "a"], "gamma": "1/2", "lam": "4/5", "asked": [2, 3]}
    traces = solved("eligibility-trace", **known, replacing=True)
    assert traces == {"a": {"a": fmpq(1), "b": fmpq(2, 5)}, "b": {"a": fmpq(1), "b": fmpq(4, 25)}}


def test_the_backward_view_with_replacing_traces_by_hand() -> None:
    # As with accumulating traces until V(a) = V(b) = 4; then e(a) = 1, e(b) = 1/2 and δ = 8 − 4 = 4:
    # V(a) = 4 + 1/2·4 = 6, V(b) = 4 + 1/2·1/2·4 = 5.
    run = {"states": ["a", "b", "a", "end"], "rewards": [0, 3, 8], "terminal": ["end"]}
    known = {"trajectory": run, "values": {"a": 4, "b": 2}, "alpha": "1/2", "gamma": 1, "lam": "1/2"}
    assert solved("td-lambda-backward", **known, replacing=True)["a"] == {"a": fmpq(6), "b": fmpq(5)}


def test_first_visits_in_a_batch() -> None:
    # Exercise 5.5 of Sutton & Barto once more, with the first visit alone: the one return, 10. And by hand: the
    # returns after first visits are 1 + 3 = 4 and 8, with the mean 6; TD(0) counts every visit as ever: 3 V = 12 + V.
    episode = {"states": ["s"] * 10, "rewards": [1] * 10}
    assert solved("batch-td-and-mc", episodes=[episode], gamma=1, visits="first")["a"] == {"s": fmpq(10)}
    episodes = [{"states": ["a", "a"], "rewards": [1, 3]}, {"states": ["a"], "rewards": [8]}]
    assert solved("batch-td-and-mc", episodes=episodes, gamma=1, visits="first") == {"a": {"a": 6}, "b": {"a": 6}}


def test_the_temporal_difference_example_of_cs_188() -> None:
    # Berkeley CS 188, lecture "Reinforcement Learning I": γ = 1, α = 1/2, V(D) = 8 and 0 elsewhere; B, east, C, −2 and
    # C, east, D, −2 give V(B) = −1 and V(C) = 3. The TD errors are −2 + 0 − 0 and −2 + 8 − 0.
    known = {"transitions": [["B", "C", -2], ["C", "D", -2]], "values": {"B": 0, "C": 0, "D": 8}}
    answers = solved("td-zero", **known, alpha="1/2", gamma=1, td_errors=True)
    assert answers == {"a": (-2, 6), "b": {"B": fmpq(-1), "C": fmpq(3)}}


def test_transitions_that_do_not_join_by_hand() -> None:
    # α = 1/2, γ = 1. A → B: V(A) = 0 + 1/2·(2 + 4 − 0) = 3; C → end: V(C) = 2 + 1/2·(4 − 2) = 3; A → C: the TD error
    # is 0 + 3 − 3 = 0.
    known = {"transitions": [["A", "B", 2], ["C", "end", 4], ["A", "C", 0]], "terminal": ["end"]}
    answers = solved("td-zero", **known, values={"A": 0, "B": 4, "C": 2}, alpha="1/2", gamma=1, td_errors=True)
    assert answers == {"a": (6, 2, 0), "b": {"A": fmpq(3), "C": fmpq(3)}}


@pytest.mark.parametrize(
    ("name", "more", "says"),
    [
        ("td-zero", {"transitions": [["end", "A", 1]]}, r"transitions\[1\]: 'end' is terminal, so nothing leads on"),
        ("td-zero", {"transitions": [["A", "B", 1]]}, "the value of 'B' is missing"),
        ("td-zero", {"transitions": [["A", "end", 1]], "trajectory": CUT_OFF}, "give either a trajectory, or transit"),
        ("q-learning", {"transitions": [["A", "x", "B", 1]]}, "the action values of 'B' are missing"),
        ("sarsa", {"transitions": [["A", "x", "A", 1]]}, r"transitions\[1\]: Sarsa needs the action taken in 'A' too"),
        ("sarsa", {"transitions": [["A", "x", "end", 1, "x"]]}, "'end' is terminal, so no action is taken there"),
    ],
)
def test_transitions_that_do_not_fit(name: str, more: dict[str, Any], says: str) -> None:
    values = {"A": 1} if name == "td-zero" else {"A": {"x": 1}}
    with pytest.raises(FileError, match=says):
        solved(name, **{"terminal": ["end"], "values": values, "alpha": 1, "gamma": 1} | more)


def test_monte_carlo_of_action_values_by_hand() -> None:
    # γ = 1/2, rewards 2, 4, 8: R_2 = 8, R_1 = 4 + 4 = 8, R_0 = 2 + 4 = 6. The pair (a, x) is visited at times 0 and 2.
    # First visit, α = 1/2: Q(a, x) = 0 + 1/2·(6 − 0) = 3; every visit: then 3 + 1/2·(8 − 3) = 11/2. Q(b, y) = 4 + 2.
    run = {"states": ["a", "b", "a", "end"], "actions": ["x", "y", "x"], "rewards": [2, 4, 8], "terminal": ["end"]}
    known = {"trajectory": run, "values": {"a": {"x": 0, "y": 1}, "b": {"y": 4}}, "alpha": "1/2", "gamma": "1/2"}
    first = solved("monte-carlo", **known, visits="first")
    assert first == {"a": (6, 8, 8), "b": {("a", "x"): fmpq(3), ("b", "y"): fmpq(6)}}
    every = solved("monte-carlo", **known, visits="every")
    assert every["b"] == {("a", "x"): fmpq(11, 2), ("b", "y"): fmpq(6)}
