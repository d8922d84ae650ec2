"""What is asked back in problems of one's own: worked by hand, and refused where no number in its range does it."""

from typing import Any

import pytest

import rldrill
from rldrill.problems.errors import FileError

RUN = {"states": ["A", "B", "end"], "actions": ["l", "r"], "rewards": [1, 2], "terminal": ["end"]}
DOUBLE = {
    "trajectory": RUN, "values": {"A": {"l": 0, "r": 1}, "B": {"l": 3, "r": 2}},
    "second": {"A": {"l": 0, "r": 0}, "B": {"l": 1, "r": 1}}, "updates": [1, 2], "alpha": "alpha", "gamma": 1,
}  # fmt: skip
STEPS = {
    "trajectory": {"states": ["A", "B", "C"], "rewards": [1, 2]}, "values": {"A": 1, "B": 2, "C": 4},
    "gamma": ["gamma", "1/2"], "asked": [[0, 1], [0, 2]], "known": 2,
}  # fmt: skip
#: Waiting pays nothing and puts off the end, which pays 2/3; any larger number solves the equation, too.
WAIT = {
    "mdp": {"transitions": [["A", "stay", "A", 1, 0], ["A", "go", "end", 1, "2/3"]], "terminal": ["end"]},
    "gamma": 1,
}
TRACES = {
    "trajectory": RUN, "values": {"A": {"l": 0, "r": 1}, "B": {"l": 3, "r": 2}}, "alpha": "alpha", "gamma": 1, "lam": 1,
    "traces": {"A": {"r": 1}}, "outcome": ["A", "l", 1],
}  # fmt: skip
ANSWERED = [
    # 0 + α·(1 + 2 − 0) = 1 after the first update, and δ₁ = 0.
    ("sarsa-lambda", TRACES, {"a": "1/3"}),
    ("optimal-policy-from-v", WAIT | {"values": {"A": "0.67"}}, {"a": "{'A': 'go'}"}),  # rounded
    # A next state alone has all of the probability.
    ("markov-property", {"table": [["A", "A", "B", 1], ["B", "A", "B", 2]], "asked": "B"}, {"b": "yes"}),
    # x + 1/2 = 3
    ("return", {"rewards": ["x", 1], "gamma": ["1/2", "1/2"], "known": 3}, {"a": "5/2"}),
    # Q₂(B, r) = 1 + α(2 − 1); the first transition updates Q₁ alone.
    ("double-q-learning", DOUBLE | {"outcome": ["B", "r", "3/2"]}, {"a": "1/2"}),
    # 2 + R₁/2 = 2, and R₁ = 2(1 − x)
    ("return-infinite", {"first": [2], "repeated": ["1-x"], "gamma": "1/2", "known": 2}, {"a": "0", "b": "1"}),
    # x + ½·2x = 3, and R₁ = 2x
    ("return-infinite", {"first": ["x"], "repeated": ["x"], "gamma": "1/2", "known": 3}, {"a": "3", "b": "3/2"}),
    # 1 + 2γ = 2; 1 + ½(2 + ½·4)
    ("n-step-return", STEPS, {"a": "1/2", "b": "3"}),
]


@pytest.mark.parametrize(("family", "given", "answers"), ANSWERED)
def test_what_is_asked_back_by_hand(family: str, given: dict[str, Any], answers: dict[str, str]) -> None:
    exercise = rldrill.read({"family": family, "given": given})
    assert {label: str(answer) for label, answer in exercise.answers().items()} | answers == {
        label: str(answer) for label, answer in exercise.answers().items()
    }


REFUSED = [
    ("return", {"rewards": [1, 2], "others": [2, 1], "gamma": "1/2"}, "with γ = 1 both returns are 3"),
    ("double-q-learning", DOUBLE | {"outcome": ["A", "l", 1]}, "Q_2, the table of the last update, does not change at"),
    ("value-from-action-values",
     {"values": {"A": {"l": 1, "r": 2}}, "policy": {"A": {"l": "p", "r": "1-p"}}, "known": {"A": 5}},
     "p would have to be −3, and it lies between 0 and 1"),
    ("return-infinite", {"first": [1], "repeated": [1], "gamma": "gamma", "known": "1/2"}, "γ would have to be −1"),
    # 0 + α(1 + 2 − 0) = 10
    ("td-zero", {"trajectory": {"states": ["a", "b"], "rewards": [1]}, "values": {"a": 0, "b": 2}, "alpha": "alpha",
                 "gamma": 1, "known": 10}, "α would have to be 10/3"),
    ("epsilon-greedy", {"state": "s", "epsilon": "1-epsilon", "values": {"l": 1, "r": 0}},
     "'1-epsilon' is one minus what is asked for; leave epsilon open"),
    ("td-zero", {"trajectory": {"states": ["a", "b"], "rewards": [1]}, "values": {"a": 0, "b": 2}, "alpha": "1-alpha",
                 "gamma": 1, "known": 1}, "'1-alpha' is one minus"),
    ("optimal-policy-from-v", WAIT | {"values": {"A": 5}}, "the optimal value of 'A' is 2/3, not 5; correct it"),
    ("sample-average", {"values": {"A": 1}, "alpha": "alpha", "visits": [["A", 3], ["A", "x"]]}, "are left open"),
    ("td-zero", {"trajectory": {"states": ["a", "b"], "rewards": [1]}, "values": {"a": 0, "b": "x"}, "alpha": 1,
                 "gamma": 0, "known": 1}, "V(a) = 1, whatever x is, and this is what is known; change"),
    ("optimal-policy-from-q", {"values": {"s": {"a": 1}}, "gamma": "1/2", "terminal": ["end"],
                               "missing": {"transitions": [["s", "b", "end", 1, "1-x"]]}}, "'1-x' is one minus"),
    ("policy-iteration", {"mdp": {"transitions": [["s", "a", "end", 1, 1], ["s", "b", "end", 1, "1-x"]],
                                  "terminal": ["end"]}, "start": {"s": "a"}, "gamma": "1/2", "reward": 3},
     "'1-x' is one minus"),
]  # fmt: skip


@pytest.mark.parametrize(("family", "given", "says"), REFUSED)
def test_what_no_number_does_is_refused(family: str, given: dict[str, Any], says: str) -> None:
    with pytest.raises(FileError) as refused:
        rldrill.read({"family": family, "given": given})
    assert says in str(refused.value)


def test_a_reward_may_be_called_p() -> None:
    # p + 5/2 = 10 for an episode with the rewards p, 5 and γ = 1/2.
    exercise = rldrill.read({"family": "return", "given": {"rewards": ["p", 5], "gamma": "1/2", "known": 10}})
    assert str(exercise.answers()["a"]) == "15/2"


def test_names_keep_their_capitals_in_a_sentence() -> None:
    moves = [["a", "V", "end", 1, "x"], ["a", "w", "end", 1, 1], ["a", "B2", "end", 1, 0]]
    given = {"mdp": {"transitions": moves, "terminal": ["end"]}, "gamma": "1/2", "values": {"a": 3}, "reward": 4}
    exercise = rldrill.read({"family": "bellman-residual", "given": given})
    written = " ".join(str(block) for part in exercise.parts for block in exercise.working(part.label))
    assert "W and B2 are worth less" in written


def test_a_rival_is_no_pair_that_a_trace_from_before_moves() -> None:
    (part,) = rldrill.read({"family": "sarsa-lambda", "given": TRACES}).parts
    assert "What is the step size" in part.ask  # Q(A, r), too, is 1 before the run, and 2 after it


def test_a_system_in_which_an_unknown_falls_out_is_solved_at_once() -> None:
    moves = [["S0", "S0", 1, 1], ["S1", "S0", 1, 1], ["S2", "S1", 1, 1]]
    exercise = rldrill.read({"family": "policy-value", "given": {"mdp": {"transitions": moves}, "average": True}})
    assert "Together these equations give" in str(exercise.working("a"))
    assert exercise.answers()["a"] == {"S0": 1, "S1": 0, "S2": 0}


def test_a_loop_that_pays_is_no_trap() -> None:
    # V = 5 by going; looping earns 1 and again 5: 6 ≥ 5, and without end.
    mdp = {"transitions": [["A", "loop", "A", 1, 1], ["A", "go", "end", 1, 5]], "terminal": ["end"]}
    given = {"mdp": mdp, "policy": {"A": "go"}, "other": {"A": "loop"}, "gamma": 1}
    exercise = rldrill.read({"family": "policy-improvement-theorem", "given": given})
    assert exercise.answers()["c"] == "yes"


def test_two_letters_are_both_told() -> None:
    mdp = {"transitions": [["A", "go", "B", 1, "x"], ["B", "go", "end", 1, 2]], "terminal": ["end"]}
    exercise = rldrill.read({"family": "policy-value", "given": {"mdp": mdp, "gamma": "gamma"}})
    assert "in terms of $x$ and $γ$" in exercise.parts[0].ask or "in terms of $γ$ and $x$" in exercise.parts[0].ask


LQR = {"A": 1, "B": 1, "Q": 1, "R": "rho", "start": 1}
NO_SUCH = [
    # x + 3(1 − x) = 7 for x = −2; 1 + x = 5 for x = 4; 2 + x(4 − 2) = 8 for x = 3.
    ("value-from-action-values", {"values": {"A": {"l": 1, "r": 3}}, "policy": {"A": {"l": "x", "r": "1-x"}},
     "known": {"A": 7}}, "x would have to be −2, and it lies between 0 and 1"),
    ("return", {"rewards": [1, 1], "gamma": "x", "known": 5}, "x would have to be 4, and it lies between 0 and 1"),
    ("td-zero", {"trajectory": {"states": ["A", "end"], "rewards": [4], "terminal": ["end"]}, "values": {"A": 2},
     "gamma": 1, "alpha": "x", "known": 8}, "x would have to be 3, and it lies between 0 and 1"),
    ("lqr-backward", LQR | {"horizon": 1, "action": 1}, "ρ would have to be −2, and it is above 0"),
    ("forward-kinematics", {"lengths": ["w", 1], "angles": [0, "pi/2"], "x": -3}, "w would have to be −3"),
    ("linear-value", {"theta": [1, 2, 5, 9], "actions": ["l", "r"], "bumps": {"centres": [[0], [2]], "width": 3}},
     "between the centres one action is always better"),
    # The sum of the states keeps its size, and B does not reach it.
    ("lqr-infinite", {"A": [["1/2", "1/2"], ["1/2", "1/2"]], "B": [[1], [-1]], "Q": [[1, -1], [-1, 1]], "R": 1},
     "the state does not come to rest"),
    ("rbf", {"position": 1, "centres": [0, 2], "logarithms": {"1": "-1/2"}, "theta": [1, 2]}, "leave logarithms out"),
]  # fmt: skip


@pytest.mark.parametrize(("family", "given", "says"), NO_SUCH)
def test_what_cannot_be_is_refused(family: str, given: dict[str, Any], says: str) -> None:
    with pytest.raises(FileError) as refused:
        rldrill.read({"family": family, "given": given})
    assert says in str(refused.value)


def test_a_stable_system_that_costs_nothing_is_left_alone() -> None:
    # Its eigenvalues are 0.999 and 0.5.
    given = {"A": [["999/1000", 1000], [0, "1/2"]], "B": [[0], [1]], "Q": [[0, 0], [0, 0]], "R": 1}
    exercise = rldrill.read({"family": "lqr-infinite", "given": given})
    assert exercise.answers()["b"] == ((0, 0),)


def test_the_equation_that_is_asked_back_is_the_one_that_is_told() -> None:
    # −1 − ρ/4 + ½·(−1/4) = −3: ρ = 15/2; that of the rewards without a discount, and with an action at T, would be 7.
    exercise = rldrill.read(
        {"family": "lqr-reward", "given": LQR | {"L": "1/2", "gamma": "1/2", "horizon": 1, "total": -3}}
    )
    assert str(exercise.answers()["a"]) == "15/2"
    assert exercise.parts[0].ask.startswith("The total of all rewards, discounted, is $J = −3$")


def test_an_episode_ends_in_a_terminal_state_alone() -> None:
    run = {"states": ["a", "b"], "rewards": [1], "terminal": ["c"]}
    given = {"trajectory": run, "features": {"a": [1, 0], "b": [0, 1]}, "theta": [1, 2], "alpha": "1/2", "gamma": 1}
    exercise = rldrill.read({"family": "semi-gradient-td", "given": given})
    assert "terminal" not in str(exercise.question())
    assert exercise.answers()["a"] == (2,)  # 1 + 2 − 1


def test_robots_are_two_only_where_they_can_be_exchanged_in_every_matrix() -> None:
    given = {"A": [[1, "1/2"], ["1/2", 1]], "B": [[1, 0], [0, 1]], "Q": [[1, 0], [0, 2]], "R": [[1, 0], [0, 1]]}
    for Q, told in (([[1, 0], [0, 2]], False), ([[1, 0], [0, 1]], True)):
        try:
            exercise = rldrill.read({"family": "lqr-infinite", "given": given | {"Q": Q}})
        except FileError:
            continue  # no closed form
        assert ("Two identical robots" in str(exercise.question())) is told


def test_a_coin_that_never_shows_heads_is_most_probably_one_that_never_does() -> None:
    given = {"coin": {"heads": 0, "tails": 3, "a": 1, "b": 1}}
    exercise = rldrill.read({"family": "model-fitting", "given": given})
    written = " ".join(str(exercise.working("b")).split())
    assert "It falls all the way from" in written
    assert "derivative" not in written


def test_the_letter_that_is_asked_for_is_the_one_that_is_left_open() -> None:
    # p/(p + 1) = 2/3
    table = [["A", "A", "A", "p"], ["A", "A", "B", 1], ["B", "A", "A", 2], ["B", "A", "B", 1]]
    exercise = rldrill.read({"family": "markov-property", "given": {"table": table, "asked": "A"}})
    assert str(exercise.answers()["a"]) == "2"


def test_an_episode_may_be_as_long_as_a_model_is_large() -> None:
    length = 500
    rows = [[f"S{step}", "on", f"S{step + 1}", 1, 1] for step in range(length)]
    given = {"mdp": {"transitions": rows, "terminal": [f"S{length}"]}, "start": {"S0": 1}, "gamma": 1}
    assert rldrill.read({"family": "expected-return", "given": given}).answers() == {"a": length}


def test_an_action_that_is_worth_as_much_is_not_said_to_be_worth_less() -> None:
    ways = [["A", "u", 5], ["A", "v", 5], ["B", "u", 1], ["B", "v", "x"], ["B", "w", 1]]
    mdp = {"transitions": [[state, action, "end", 1, reward] for state, action, reward in ways], "terminal": ["end"]}
    given = {"mdp": mdp, "start": {"A": "u", "B": "u"}, "gamma": "1/2", "reward": 3}
    written = " ".join(str(rldrill.read({"family": "policy-iteration", "given": given}).working("b")).split())
    assert "v in A and w in B are worth no more than" in written


def test_a_value_that_another_action_has_anyway_leaves_the_other_state_open() -> None:
    rows = [["A", "stay", "end", 1, 5], ["A", "go", "B", 1, 0], ["B", "u", "end", 1, "x"], ["B", "v", "end", 1, -3]]
    given = {"mdp": {"transitions": rows, "terminal": ["end"]}, "gamma": "1/2", "optimum": {"A": 5}}
    with pytest.raises(FileError, match="more than one value of 'B' is right: another action in 'A' is worth 5"):
        rldrill.read({"family": "optimal-value", "given": given})


def test_what_multiplies_an_infinite_derivative_is_not_nothing() -> None:
    """D² is x, whose derivative is 1 and not the 0 that 2D·D′ looks like where D = √x is 0."""
    given = {"dynamics": {"x": "D^2 + u"}, "where": {"D": "sqrt(x)"}, "state": {"x": 0}, "action": {"u": 1}}
    with pytest.raises(FileError, match="do not exist at the operating point"):
        rldrill.read({"family": "linearise", "given": given})


def test_an_advantage_of_nothing_is_neither_positive_nor_negative() -> None:
    sample = {"state": "hall", "action": "roll", "old": "1/4", "new": "1/2", "advantage": 0}
    once = rldrill.read({"family": "ppo-clip", "given": {"samples": [sample], "epsilon": "1/5"}})
    assert "inside the range" not in str(once.working())
    assert once.answers()["d"] == "no"
    as_before = {**sample, "new": "1/4", "advantage": 2}
    sought = rldrill.read({"family": "ppo-clip", "given": {"samples": [sample, as_before]}})
    written = " ".join(str(sought.working()).split())
    assert "The advantage A₀ is 0, and the action has become more likely" in written
    assert "The advantage A₁ is positive, and the action is as likely as before" in written


@pytest.mark.parametrize(("A", "said"), [
    ([[1, 2], [0, 1]], "its position and its velocity"), ([[1, 0], [0, 1]], "2 components"),
    ([[1, 1], ["1/2", 1]], "2 components"),
])  # fmt: skip
def test_a_state_of_two_numbers_need_not_move(A: list[list[Any]], said: str) -> None:
    unit = [[1, 0], [0, 1]]
    given = {"mean": [1, 1], "covariance": unit, "A": A, "C": [[1, 0]], "process": unit, "sensor": [[4]],
             "steps": [{"z": [[4]]}]}  # fmt: skip
    question = " ".join(str(rldrill.read({"family": "kalman-filter", "given": given}).question()).split())
    assert f"A robot's state {'is' if 'its' in said else 'has'} {said}." in question


def test_one_return_is_not_asked_for_in_an_order() -> None:
    exercise = rldrill.read({"family": "return", "given": {"rewards": 3, "gamma": "1/2"}})
    assert exercise.parts[0].ask == "What is the return $R_0$?"
    assert exercise.check("3").accepted


@pytest.mark.parametrize(("A", "root", "said"), [
    # P² + (A² − 1)P = 0 with B = R = 1 and Q = 0: the roots are 0 and 1 − A².
    (2, -3, "with which the state would not come to rest: P is the other one."),
    ("1/2", 0, "so one of them is, and the other positive. No reward is positive, and neither is a sum of them: P"),
])  # fmt: skip
def test_a_state_that_costs_nothing_is_brought_to_rest_where_it_does_not_go_there(
    A: object, root: int, said: str
) -> None:
    exercise = rldrill.read({"family": "lqr-infinite", "given": {"A": [[A]], "B": [[1]], "Q": [[0]], "R": [[1]]}})
    assert exercise.answers()["a"] == ((root,),)
    assert said in " ".join(str(exercise.working("a")).split())


COMPARED = {
    "trajectory": {"states": ["A", "B"], "actions": ["l", "l"], "rewards": [1]}, "word": "on-policy", "gamma": "1/2",
    "values": {"A": {"l": 0, "r": 0}, "B": {"l": 8, "r": 4}}, "alpha": "1/2",
}  # fmt: skip


@pytest.mark.parametrize(("other", "why"), [(8, "greater than all others"), (6, "the greatest")])
def test_a_value_that_is_as_great_as_another_is_the_greatest(other: int, why: str) -> None:
    exercise = rldrill.read({"family": "sarsa-versus-q-learning", "given": COMPARED | {"instead": ["B", "r", other]}})
    assert f"in none of them is this value {why}." in " ".join(str(exercise.working()).split())


@pytest.mark.parametrize(("change", "says"), [
    ({"instead": ["B", "r", 4]}, "that is the value that it has"),
    ({"instead": ["B", "r", 9], "gamma": 0}, "no value counts"),
])  # fmt: skip
def test_another_value_is_another_and_counts(change: dict[str, Any], says: str) -> None:
    with pytest.raises(FileError, match=says):
        rldrill.read({"family": "sarsa-versus-q-learning", "given": COMPARED | change})


def test_the_other_values_are_optimal_with_the_one_that_is_missing() -> None:
    """B is worth 10 or 2 + A/2, and A is 4 or 1 + B/2."""
    rows = [["A", "a", "B", 1, 1], ["A", "b", "end", 1, 4], ["B", "a", "A", 1, 2], ["B", "b", "end", 1, 10]]
    given = {"mdp": {"transitions": rows, "terminal": ["end"]}, "gamma": "1/2", "missing": "B"}
    right: dict[str, Any] = {"family": "optimal-policy-from-v", "given": given | {"values": {"A": 6}}}
    assert rldrill.read(right).answers() == {"a": 10, "b": {"A": "a", "B": "b"}}
    right["given"]["values"] = {"A": "6.03"}  # rounded
    assert rldrill.read(right).answers() == {"a": 10, "b": {"A": "a", "B": "b"}}
    with pytest.raises(FileError, match="'A' is given as 100, but its best action is worth 27"):
        rldrill.read({"family": "optimal-policy-from-v", "given": given | {"values": {"A": 100}}})
