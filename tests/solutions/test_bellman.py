"""Identities between the Bellman equations, and givens that do not fit."""

from fractions import Fraction
from typing import Any

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

import rldrill
from asking import mistaken, solved
from rldrill.problems.errors import FileError
from rldrill.problems.valued import with_reward
from rldrill.solutions.drawing import draw
from rldrill.solutions.effort import points
from rldrill.solutions.exact import exact

seeds = st.integers(0, 10_000)


def test_the_smallest_reward_is_more_than_a_glance_at_the_table() -> None:
    for seed in range(40):
        solution = draw("optimal-value", 3, seed)
        given_, least = solution.problem.given, solution.answers["c"]
        sought, rows = given_.row, given_.mdp.transitions
        assert least not in [row.reward for row in rows]
        at_once = {
            action: sum(exact(row.probability) * exact(row.reward) for row in outcomes if row is not sought)
            for (state, action), outcomes in given_.mdp.outcomes.items()
            if state == sought.state
        }
        unpaid = at_once.pop(sought.action)
        chance = exact(sought.probability)
        assert all(unpaid + chance * least != other for other in at_once.values()), "γ and V* play no part"


def test_optimal_values_are_evaluated_from_a_policy_that_is_near() -> None:
    for level, most in ((1, 4), (2, 8)):
        assert all(points(draw("optimal-value", level, seed))["a"] <= most for seed in range(40))


weights = st.lists(st.integers(0, 4), min_size=2, max_size=2).filter(any)


@given(seeds, st.lists(weights, min_size=2, max_size=2))
@settings(deadline=None, max_examples=25)
def test_no_policy_is_better_than_the_optimal_values(seed: int, chosen: list[list[int]]) -> None:
    solution = draw("optimal-value", 2, seed)
    data = solution.problem.data()["given"]
    policy = {
        state: {action: f"{weight}/{sum(row)}" for action, weight in zip(actions, row, strict=True)}
        for (state, actions), row in zip(solution.problem.given.mdp.actions.items(), chosen, strict=True)
    }
    values = solved("policy-value", mdp=data["mdp"], policy=policy, gamma=data["gamma"])["a"]
    assert all(solution.answers["a"][state] >= value for state, value in values.items())


@given(seeds, st.sampled_from([1, 2]))
@settings(deadline=None, max_examples=25)
def test_optimal_values_solve_their_equations(seed: int, level: int) -> None:
    solution = draw("optimal-value", level, seed)
    mdp, answers = solution.problem.given.mdp, solution.answers
    values = answers["a"] | dict.fromkeys(mdp.terminal, fmpq(0))
    for state, actions in mdp.actions.items():
        assert values[state] == max(answers["c"][state, action] for action in actions)
    gamma = exact(solution.problem.given.gamma)
    for pair, rows in mdp.outcomes.items():
        worth = sum((exact(r.probability) * (exact(r.reward) + gamma * values[r.next]) for r in rows), fmpq(0))
        assert answers["c"][pair] == worth


@given(seeds, st.sampled_from([1, 2]))
@settings(deadline=None, max_examples=25)
def test_optimal_values_and_only_they_have_no_residual(seed: int, level: int) -> None:
    solution = draw("optimal-value", level, seed)
    data = solution.problem.data()["given"]
    claim = {"mdp": data["mdp"], "gamma": data["gamma"], "optimal": True}
    values = {state: str(value) for state, value in solution.answers["a"].items()}
    right = solved("bellman-residual", values=values, **claim)
    assert right["b"] is True
    assert not any(right["a"].values())
    first = next(iter(values))
    shifted = values | {first: str(solution.answers["a"][first] + 1)}
    assert solved("bellman-residual", values=shifted, **claim)["b"] is False


@given(seeds)
@settings(deadline=None, max_examples=20)
def test_with_the_reward_that_is_found_the_optimal_values_are_those(seed: int) -> None:
    solution = draw("optimal-value", 3, seed)
    given_: Any = solution.problem.given
    mdp = with_reward(given_.mdp, Fraction(str(solution.answers["b"])))
    answers = solved("optimal-value", mdp=mdp.model_dump(mode="json"), gamma=str(given_.gamma))
    assert answers["a"] == {
        state: exact(given_.optimum[state]) if state == given_.state else solution.answers["a"]
        for state in given_.mdp.states
    }


@given(seeds)
@settings(deadline=None, max_examples=20)
def test_the_policys_mean_of_its_action_values_is_its_value(seed: int) -> None:
    solution = draw("policy-action-value", 2, seed)
    pairs = solution.answers["b"]
    table: dict[str, dict[str, str]] = {}
    for (state, action), value in pairs.items():
        table.setdefault(state, {})[action] = str(value)
    policy = solution.problem.data()["given"]["policy"]
    assert solved("value-from-action-values", values=table, policy=policy)["a"] == solution.answers["a"]


@given(seeds)
@settings(deadline=None, max_examples=20)
def test_a_backup_is_the_mean_of_action_values(seed: int) -> None:
    solution = draw("bellman-backup", 2, seed)
    data = solution.problem.data()["given"]
    known = {"dynamics": data["dynamics"], "values": data["values"], "gamma": data["gamma"]}
    pairs = solved("action-value", **known)["a"]
    given_ = solution.problem.given
    mean = sum((exact(given_.policy[s][a]) * value for (s, a), value in pairs.items()), fmpq(0))
    assert mean == solution.answers["a"]


@given(seeds)
@settings(deadline=None, max_examples=20)
def test_a_graph_is_a_decision_process_without_chance(seed: int) -> None:
    solution = draw("principle-of-optimality", 2, seed)
    given_ = solution.problem.given
    rows = [[edge.state, f"to {edge.next}", edge.next, 1, edge.reward] for edge in given_.edges]
    answers = solved("optimal-value", mdp={"transitions": rows, "terminal": [given_.goal]}, gamma=1)
    assert answers["a"] == solution.answers["a"]
    for state, best in solution.answers["b"].items():
        assert answers["b"][state] == tuple(f"to {after}" for after in best)


@given(seeds)
@settings(deadline=None, max_examples=20)
def test_a_best_path_goes_through_its_own_states_at_no_loss(seed: int) -> None:
    data = draw("principle-of-optimality", 3, seed).problem.data()["given"]
    answers = solved("principle-of-optimality", **data)
    onward = answers["b"][data["start"]][0]
    assert answers["c"] < answers["a"][data["start"]]  # the draw takes a state that is not on the best path
    if onward != data["goal"]:
        along = solved("principle-of-optimality", **data | {"through": onward})
        assert along["c"] == along["a"][data["start"]]


EDGES = [["a", "b", 1], ["a", "c", 2], ["b", "c", 3], ["c", "end", -1]]


@pytest.mark.parametrize(
    ("changes", "fragment"),
    [
        ({"edges": [*EDGES, ["c", "a", 1]]}, "edges: a path can go round and round"),
        ({"edges": [*EDGES, ["c", "d", 1]]}, "no edge leads on from 'd'"),
        ({"edges": [*EDGES, ["end", "a", 1]]}, "'end' is the goal"),
        ({"edges": [*EDGES, ["a", "b", 2]]}, "given twice"),
        ({"start": "x"}, "start: no edge leads on from 'x'"),
        ({"through": "x"}, "through: 'x' is no state"),
        ({"start": "b", "through": "a"}, "through: no path from 'b' reaches 'a'"),
    ],
)
def test_graphs_that_do_not_fit(changes: dict[str, Any], fragment: str) -> None:
    graph = {"edges": EDGES, "start": "a", "goal": "end"}
    assert solved("principle-of-optimality", **graph)["a"] == {"a": 3, "b": 2, "c": -1}
    with pytest.raises(FileError, match=fragment):
        solved("principle-of-optimality", **graph | changes)


@pytest.mark.parametrize(("reward", "costs"), [(-1, True), (0, False), (1, False)])
def test_only_a_negative_reward_is_called_a_cost(reward: int, costs: bool) -> None:
    graph = {"edges": [["a", "b", reward], ["b", "end", 2], ["a", "end", 1]], "start": "a", "goal": "end"}
    asked = rldrill.read({"family": "principle-of-optimality", "given": graph}).question()
    assert ("(a cost, if it is negative)" in " ".join(str(asked).split())) == costs


MDP = {"transitions": [["a", "x", "b", 1, 1], ["a", "y", "end", 1, 3], ["b", "x", "a", 1, 2]], "terminal": ["end"]}


@pytest.mark.parametrize(
    ("changes", "fragment"),
    [
        ({"values": {"a": 1}}, "the value of 'b' is missing"),
        ({"values": {"a": 1, "b": 2, "c": 3}}, "the value is given for 'c'"),
        ({"gamma": "gamma"}, "gamma is left open"),
        ({"optimal": True, "policy": {"a": "x", "b": "x"}}, "optimal values belong to no given policy"),
    ],
)
def test_claims_that_do_not_fit(changes: dict[str, Any], fragment: str) -> None:
    claim = {"mdp": MDP, "gamma": "1/2", "values": {"a": 3, "b": "7/2"}, "optimal": True}
    assert solved("bellman-residual", **claim)["b"] is True  # max{1 + 7/4; 3} = 3 and 2 + 3/2 = 7/2
    with pytest.raises(FileError, match=fragment):
        solved("bellman-residual", **claim | changes)


def test_a_policy_may_leave_out_what_it_never_does() -> None:
    short = solved("policy-value", mdp=MDP, policy={"a": "y", "b": "x"}, gamma="1/2")
    assert short["a"] == {"a": 3, "b": fmpq(7, 2)}
    pairs = solved("policy-action-value", mdp=MDP, policy={"a": "y", "b": "x"}, gamma="1/2")["b"]
    assert pairs[("a", "x")] == fmpq(11, 4)  # 1 + 1/2·7/2


@pytest.mark.parametrize(
    ("changes", "fragment"),
    [
        ({"policy": {"a": {"x": "1/2"}}}, "the policy's probabilities in 'a' sum to 1/2, not to 1"),
        ({"policy": {"a": "z"}}, "the policy in 'a' is given for 'z'"),
        ({"policy": {}}, "the policy of 'a' is missing"),
        ({"values": {"a": {}}}, "the action values of 'a' are missing"),
    ],
)
def test_tables_that_do_not_fit(changes: dict[str, Any], fragment: str) -> None:
    known = {"values": {"a": {"x": 1, "y": 2}}, "policy": {"a": "x"}}
    assert solved("value-from-action-values", **known) == {"a": {"a": 1}, "b": {"a": 2}}
    with pytest.raises(FileError, match=fragment):
        solved("value-from-action-values", **known | changes)


@pytest.mark.parametrize(
    ("name", "reward", "residual"),
    [
        ("forgot-gamma", 2, 2),  # x + 4 = 6; then the greater of 0 + 4 and 2 + 6, less 6
        ("mean-for-max", 5, "-5/2"),  # (x + 2 + 2 + 3)/2 = 6; then (2 + 5)/2 − 6
        ("sign-of-residual", 4, 1),  # x + 2 = 6; then 6 less the greater of 2 and 5
    ],
)
def test_an_equation_that_is_misread_gives_another_reward_too(name: str, reward: int, residual: int | str) -> None:
    rows = [["s", "go", "t", 1, "x"], ["s", "stay", "s", 1, 2], ["t", "quit", "end", 1, 4]]
    given = {"mdp": {"transitions": rows, "terminal": ["end"]}, "gamma": "1/2", "values": {"s": 6, "t": 4}, "reward": 0}
    assert mistaken(name, "bellman-residual", **given) == {"a": reward, "b": {"s": exact(Fraction(residual)), "t": 0}}
