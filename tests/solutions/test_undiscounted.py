"""Models without discount: loops that pay nothing, against brute force over all policies, and what has no value."""

import itertools
import math
import random
import re
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import rldrill
from asking import solved
from rldrill.problems.errors import FileError
from rldrill.problems.models import Model
from rldrill.solutions.exact import NoSolution
from rldrill.solutions.optimality import optimum
from rldrill.solutions.oracle import chances, optimal_values, policy_values, tensors

Rows = list[list[Any]]
Policy = Mapping[str, str]


def undiscounted(rows: Rows, terminal: tuple[str, ...] = ("end",)) -> Model:
    return Model.model_validate({"transitions": rows, "terminal": terminal})


def random_rows(seed: int) -> Rows:
    """Two to four states, most moves for nothing, with stay actions and states that nothing reaches."""
    choose = random.Random(seed)
    states = "abcd"[: choose.randint(2, 4)]
    rewards = choose.choice([(0, 0, 0, 1, 3), (0, 0, 0, -1, -2), (0, 0, 0, 0, -1, 2), (-1,), (0,)])
    rows: Rows = []
    for state in states:
        for action in range(choose.randint(1, 3)):
            targets = choose.choice([(state,), choose.sample([*states, "end"], choose.randint(1, 2))])
            for after in targets:
                paid = 0 if after == state and choose.random() < 0.8 else choose.choice(rewards)
                rows.append([state, f"{action}", after, f"1/{len(targets)}", paid])
    return rows


def policies(model: Model) -> Iterator[dict[str, str]]:
    for actions in itertools.product(*model.actions.values()):
        yield dict(zip(model.states, actions, strict=True))


def total(model: Model, policy: Policy) -> dict[str, float] | None:
    """The expected totals of a policy, by what is reached from where; None where some sum never settles.

    What matters is which states are visited again and again: those that can come back from wherever they lead.
    """
    states = model.states
    rows = {state: model.outcomes[state, policy[state]] for state in states}
    reach = {state: {row.next for row in rows[state]} for state in states}
    for _ in states:
        reach = {
            s: seen | {after for each in seen if each in reach for after in reach[each]} for s, seen in reach.items()
        }
    again = [s for s in states if all(after in reach and s in reach[after] for after in reach[s])]
    pays = {s: float(sum(row.probability * row.reward for row in rows[s])) for s in states}  # type: ignore[operator, misc]
    worth: dict[str, float] = {}
    for state in again:
        circle = sorted(reach[state])
        if any(pays[each] for each in circle):
            P = np.array([[sum(float(r.probability) for r in rows[a] if r.next == b) for b in circle] for a in circle])  # type: ignore[arg-type]
            share = np.linalg.lstsq(
                np.vstack([P.T - np.eye(len(circle)), np.ones(len(circle))]), np.eye(len(circle) + 1)[-1], rcond=None
            )[0]
            mean = share @ [pays[each] for each in circle]
            if abs(mean) < 1e-9:
                return None
            worth[state] = math.copysign(math.inf, mean)
        else:
            worth[state] = 0.0
    passing = [s for s in states if s not in again]
    endless = {s: {worth[after] for after in reach[s] if math.isinf(worth.get(after, 0))} for s in passing}
    if any(len(kinds) > 1 for kinds in endless.values()):
        return None
    worth |= {s: kinds.pop() for s, kinds in endless.items() if kinds}
    rest = [s for s in passing if s not in worth]
    P = np.array([[sum(float(r.probability) for r in rows[a] if r.next == b) for b in rest] for a in rest])  # type: ignore[arg-type]
    if rest:
        worth |= dict(zip(rest, np.linalg.solve(np.eye(len(rest)) - P, [pays[s] for s in rest]), strict=True))
    return worth


def holds_against_brute_force(rows: Rows) -> str:
    """Compare, and say what was found: values, or none."""
    model = undiscounted(rows)
    totals = {tuple(policy.values()): total(model, policy) for policy in policies(model)}
    defined = [worth for worth in totals.values() if worth is not None]
    best = {s: max((worth[s] for worth in defined), default=math.nan) for s in model.states}
    try:
        found = optimum(model, Fraction(1))
    except NoSolution as error:
        text = str(error)
        if "+∞" in text or "−∞" in text:
            state = text.split("the value of ")[1].split(" is ")[0]
            assert best[state] == (math.inf if "+∞" in text else -math.inf) or None in totals.values()
        else:
            assert None in totals.values()
        assert any(math.isinf(value) for value in best.values()) or None in totals.values()
        return "none"
    assert {s: pytest.approx(int(v.p) / int(v.q)) for s, v in found.values.items()} == best
    worth = total(model, found.policy)
    assert worth == {s: pytest.approx(value) for s, value in best.items()}, (
        "the first of the best actions are a best policy"
    )
    optimal = [policy for policy, worth in totals.items() if worth is not None and worth == pytest.approx(best)]
    for place, state in enumerate(model.states):
        assert set(found.best[state]) == {policy[place] for policy in optimal}
    P, R = tensors(model)
    V = optimal_values(P, R, 1.0, len(model.states))
    assert dict(zip(model.states, V, strict=False)) == {s: pytest.approx(value, abs=1e-6) for s, value in best.items()}
    return "loops" if any(policy_goes_round(model, policy) for policy in policies(model)) else "values"


def policy_goes_round(model: Model, policy: Policy) -> bool:
    return any(all(row.next == state for row in model.outcomes[state, policy[state]]) for state in model.states)


def test_three_hundred_models_against_brute_force_over_all_policies() -> None:
    found = [holds_against_brute_force(random_rows(seed)) for seed in range(300)]
    assert found.count("loops") >= 100
    assert found.count("none") >= 30


@given(st.integers(min_value=1000))
@settings(deadline=None)
def test_any_model_against_brute_force(seed: int) -> None:
    holds_against_brute_force(random_rows(seed))


@given(st.integers(min_value=0), st.data())
@settings(deadline=None)
def test_any_policy_is_worth_its_total(seed: int, data: st.DataObject) -> None:
    rows = random_rows(seed)
    model = undiscounted(rows)
    policy = {state: data.draw(st.sampled_from(actions)) for state, actions in model.actions.items()}
    worth = total(model, policy)
    mdp = {"transitions": rows, "terminal": ["end"]}
    if worth is None or any(map(math.isinf, worth.values())):
        with pytest.raises(FileError, match="with γ = 1"):
            solved("policy-value", mdp=mdp, policy=policy, gamma=1)
        return
    answers = solved("policy-value", mdp=mdp, policy=policy, gamma=1)["a"]
    assert {s: pytest.approx(int(v.p) / int(v.q)) for s, v in answers.items()} == worth
    P, R = tensors(model)
    V = policy_values(P, R, chances({s: {a: Fraction(1)} for s, a in policy.items()}, model), 1.0)
    assert dict(zip(model.states, V, strict=False)) == {s: pytest.approx(value, abs=1e-9) for s, value in worth.items()}


def best(rows: Rows, terminal: tuple[str, ...] = ("end",)) -> Any:
    return solved("optimal-value", mdp={"transitions": rows, "terminal": terminal}, gamma=1)


def working(family: str, **given_: Any) -> str:
    text = str(rldrill.read({"family": family, "given": given_}).working())
    return " ".join(text.split())


def test_nothing_for_moving_and_two_exits() -> None:
    # From everywhere one can walk to the exit that pays 10, and no step costs anything.
    answers = solved("optimal-value", mdp={"grid": "L...R", "rewards": {"L": 1, "R": 10}}, gamma=1)
    assert set(answers["a"].values()) == {10}
    assert set(answers["b"].values()) == {("right",)}  # up, down and (but beside L) left have Q = 10, but get nowhere


@pytest.mark.parametrize("first", ["go", "exit"])
def test_the_first_of_tied_actions_get_to_the_end_together(first: str) -> None:
    """Each state may go to the other or leave, for the same; but where both go, nobody ever leaves."""
    ways = {"go": {"a": ["b", 1, 0], "b": ["a", 1, 0]}, "exit": {"a": ["end", 1, 1], "b": ["end", 1, 1]}}
    rows = [[state, way, *ways[way][state]] for state in "ab" for way in sorted(ways, key=lambda way: way != first)]
    model = undiscounted(rows)
    found = optimum(model, Fraction(1))
    assert {state: set(actions) for state, actions in found.best.items()} == {"a": {*ways}, "b": {*ways}}
    assert total(model, found.policy) == {"a": 1, "b": 1}


def test_an_end_written_as_a_loop_is_worth_nothing() -> None:
    rows: Rows = [["a", "go", "goal", 1, 7], ["goal", "stay", "goal", 1, 0]]
    assert best(rows, ())["a"] == {"a": 7, "goal": 0}
    mdp = {"transitions": rows}
    assert solved("policy-value", mdp=mdp, gamma=1)["a"] == {"a": 7, "goal": 0}
    text = working("policy-value", mdp=mdp, gamma=1)
    assert "Whoever comes to goal (stay) stays there for ever, and every step there pays 0" in text
    assert text.index("V^π(goal) = 0") < text.index("V^π(a) = ")


def test_staying_is_not_the_way_to_an_end_but_better_than_a_bad_one() -> None:
    assert best([["a", "stay", "a", 1, 0], ["a", "go", "end", 1, 5]])["b"] == {"a": ("go",)}
    answers = best([["a", "stay", "a", 1, 0], ["a", "go", "end", 1, -5]])
    assert answers["a"] == {"a": 0}
    assert answers["b"] == {"a": ("stay",)}
    assert set(best([["a", "stay", "a", 1, 0], ["a", "go", "end", 1, 0]])["b"]["a"]) == {"stay", "go"}


def test_a_loop_that_nothing_reaches_is_worth_nothing() -> None:
    rows: Rows = [["a", "go", "end", 1, 3], ["island", "turn", "shore", 1, 0], ["shore", "turn", "island", 1, 0]]
    assert best(rows)["a"] == {"a": 3, "island": 0, "shore": 0}


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        (
            [["a", "stay", "a", 1, -1]],
            "the value of a is −∞: no end can be reached.* a \\(stay\\), where a step earns −1",
        ),
        (
            [["a", "stay", "a", 1, 1], ["a", "go", "end", 1, 0]],
            "the value of a is \\+∞: an episode can go on for ever with a \\(stay\\), where a step earns 1 on average",
        ),
        # 2 for one way, −1 for the way back: half a unit a step.
        ([["a", "x", "b", 1, 2], ["b", "x", "a", 1, -1]], "a \\(x\\) and b \\(x\\), where a step earns 1/2 on average"),
        ([["a", "x", "b", 1, 1], ["b", "x", "a", 1, -1]], "a has no value.*the sum of all rewards never settles"),
        (
            [["a", "x", "b", 1, 1], ["b", "x", "a", 1, -1], ["a", "go", "end", 1, -5], ["b", "go", "end", 1, -5]],
            "a has no value: instead of taking a loss",
        ),
    ],
)
def test_where_there_is_no_value_the_state_the_loop_and_the_cure_are_named(rows: Rows, said: str) -> None:
    with pytest.raises(FileError, match=f"with γ = 1 .*{said}.*or take γ below 1"):
        best(rows)


def test_what_is_paid_back_at_once_does_no_harm_where_there_is_a_good_end() -> None:
    # a earns 1 on the way to b, and the way back costs it again; both may end for nothing.
    rows: Rows = [["a", "x", "b", 1, 1], ["b", "x", "a", 1, -1], ["a", "go", "end", 1, 0], ["b", "go", "end", 1, 0]]
    answers = best(rows)
    assert answers["a"] == {"a": 1, "b": 0}
    assert answers["b"] == {"a": ("x",), "b": ("go",)}


def test_what_a_loop_pays_on_average_is_exact_up_to_eight_digits() -> None:
    def said(reward: str) -> str:
        model = undiscounted([["a", "go", "a", 1, reward]], ())
        with pytest.raises(NoSolution) as told:
            optimum(model, Fraction(1))
        return str(told.value)

    assert "1234/5679" in said("1234/5679")
    assert "about 0.2173" in said("12340/56787")


def test_a_policy_that_pays_for_ever_is_told_where() -> None:
    rows = [
        ["s1", "left", "s1", 1, -1],
        ["s1", "right", "s2", 1, -1],
        ["s2", "left", "s1", 1, -1],
        ["s2", "right", "end", 1, -1],
    ]
    mdp = {"transitions": rows, "terminal": ["end"]}
    said = "the value of s1 is −∞: the policy goes on for ever with s1 \\(left\\), where a step earns −1"
    with pytest.raises(FileError, match=said):
        solved("policy-value", mdp=mdp, policy={"s1": "left", "s2": "left"}, gamma=1)
    assert solved("policy-value", mdp=mdp, policy={"s1": "right", "s2": "right"}, gamma=1)["a"] == {"s1": -2, "s2": -1}


# Waiting is free; borrowing earns 5, and what is owed costs 10 in the end, or 1 a step for ever.
BORROW: Rows = [
    ["a", "wait", "a", 1, 0], ["a", "borrow", "b", 1, 5],
    ["b", "pay", "end", 1, -10], ["b", "delay", "b", 1, -1],
]  # fmt: skip


def test_where_value_iteration_does_not_come_to_the_optimum_the_working_says_so() -> None:
    # Of n steps the last can borrow: the sweeps give 5 in a. But for ever nobody gains by it: 5 − 10 is below 0.
    mdp = {"transitions": BORROW, "terminal": ["end"]}
    assert best(BORROW)["a"] == {"a": 0, "b": -10}
    assert "Value iteration that begins with 0 does not come to them: in a it settles at 5." in working(
        "optimal-value", mdp=mdp, gamma=1
    )
    swept = solved("value-iteration", mdp=mdp, gamma=1, sweeps=30)["a"]
    assert swept["a"] == 5


def test_that_one_value_has_settled_is_not_enough_for_value_iteration() -> None:
    # c is worth 0 from the first sweep on, a only from the second one: −2, then −2 + 1.
    rows: Rows = [["a", "go", "b", 1, -2], ["b", "go", "c", 1, 1], ["c", "go", "end", 1, 0], ["c", "stay", "c", 1, 0]]
    mdp = {"transitions": rows, "terminal": ["end"]}
    assert best(rows)["a"] == {"a": -1, "b": 1, "c": 0}
    assert "settles" not in working("optimal-value", mdp=mdp, gamma=1)


def test_greedy_for_its_own_values_is_not_enough() -> None:
    # Going costs 1. Staying is worth as much by the equation, −1, and so improvement keeps to going; but it is worth 0.
    mdp = {"transitions": [["a", "stay", "a", 1, 0], ["a", "go", "end", 1, -1]], "terminal": ["end"]}
    answers = solved("policy-iteration", mdp=mdp, start={"a": "go"}, gamma=1, rounds=1)
    assert answers["a"] == {"a": -1}
    assert answers["c"] is False
    assert solved("policy-iteration", mdp=mdp, start={"a": "stay"}, gamma=1, rounds=1)["c"] is True
    assert solved("policy-improvement", mdp=mdp, policy={"a": {"go": 1}}, gamma=1)["c"] is False


def test_the_improvement_theorem_needs_a_policy_that_gets_there() -> None:
    # Q(a, stay) = 0 + V(a) = 5 is no loss for one step, but whoever always stays has 0.
    mdp = {"transitions": [["a", "stay", "a", 1, 0], ["a", "go", "end", 1, 5]], "terminal": ["end"]}
    answers = solved("policy-improvement-theorem", mdp=mdp, policy={"a": "go"}, other={"a": "stay"}, gamma=1)
    assert answers == {"a": {"a": 5}, "b": {("a", "stay"): 5}, "c": False}
    back = solved("policy-improvement-theorem", mdp=mdp, policy={"a": "stay"}, other={"a": "go"}, gamma=1)
    assert back == {"a": {"a": 0}, "b": {("a", "go"): 5}, "c": True}


@pytest.mark.parametrize(("value", "right"), [(0, True), (7, False)])
def test_without_discount_no_residual_is_not_enough(value: int, right: bool) -> None:
    mdp = {"transitions": [["a", "stay", "a", 1, 0]]}
    answers = solved("bellman-residual", mdp=mdp, values={"a": value}, gamma=1)
    assert answers == {"a": {"a": 0}, "b": right}
    assert solved("bellman-residual", mdp=mdp, values={"a": value}, gamma=1, optimal=True) == answers


def test_the_best_action_for_known_values_is_one_that_gets_there() -> None:
    mdp = {"transitions": [["a", "stay", "a", 1, 0], ["a", "go", "end", 1, 5]], "terminal": ["end"]}
    assert solved("optimal-policy-from-v", mdp=mdp, values={"a": 5}, gamma=1)["a"] == {"a": ("go",)}


def features_of(features: dict[str, list[int]], motion: Any, **others: Any) -> dict[str, Any]:
    policy = {state: {"go": 1} for state in features}
    return {"motion": {"go": motion}, "policy": policy, "features": features, "start": {"a": 1}, "gamma": 1, **others}


def test_features_that_are_0_where_it_goes_round_for_ever_have_expectations() -> None:
    # a is left after 2 steps on average, for b, which is never left.
    answers = solved(
        "feature-expectations-policy",
        **features_of({"a": [1, 3], "b": [0, 0]}, {"a": {"a": "1/2", "b": "1/2"}, "b": {"b": 1}}),
    )
    assert answers == {"a": {"a": 2, "b": 0}, "b": {"a": 6, "b": 0}, "c": (2, 6)}


def test_features_until_an_end_that_is_reached_by_way_of_a_loop() -> None:
    # μ(a) = 1 + μ(b)/2 and μ(b) = 2 + μ(a).
    motion = {"a": {"b": "1/2", "end": "1/2"}, "b": {"a": 1}}
    answers = solved("feature-expectations-policy", **features_of({"a": [1], "b": [2]}, motion, terminal=["end"]))
    assert answers == {"a": {"a": 4, "b": 6}, "b": 4}


@pytest.mark.parametrize(
    ("features", "motion", "said"),
    [
        ({"a": [1], "b": [2]}, {"a": {"b": 1}, "b": {"b": 1}}, "μ_1(b) is +∞: the policy goes on for ever with b (go), "
         "where the feature is 2 on average"),
        ({"a": [1], "b": [-1]}, {"a": {"b": 1}, "b": {"a": 1}}, "μ_1(a) does not exist: the policy goes on for ever "
         "with a (go) and b (go), where the feature cancels on average"),
    ],
)  # fmt: skip
def test_features_that_count_for_ever_have_none(features: Any, motion: Any, said: str) -> None:
    with pytest.raises(FileError, match=re.escape(said)):
        solved("feature-expectations-policy", **features_of(features, motion))


REST = {"transitions": [["a", "stay", "a", 1, 0], ["b", "go", "a", 1, 2], ["c", "go", "end", 1, 1]]}


@pytest.mark.parametrize("family", ["policy-improvement", "policy-improvement-theorem"])
def test_values_that_only_solve_the_equations_are_not_those_of_the_policy(family: str) -> None:
    actions = {"a": "stay", "b": "go", "c": "go"}
    chances = {state: {action: 1} for state, action in actions.items()}
    policies = {"policy": chances} if family == "policy-improvement" else {"policy": actions, "other": actions}
    with pytest.raises(FileError, match=r"values: 'a' is given as 5, but its value under the policy is 0: with γ = 1"):
        solved(family, mdp=REST, values={"a": 5, "b": 7, "c": 1}, gamma=1, **policies)
    assert solved(family, mdp=REST, values={"a": 0, "b": 2, "c": 1}, gamma=1, **policies)


def test_values_of_what_never_settles_are_refused() -> None:
    mdp = {"transitions": [["a", "go", "b", 1, 1], ["b", "go", "a", 1, -1]]}
    with pytest.raises(FileError, match=r"with γ = 1 'a' has no value, for the policy comes back to it for ever"):
        solved("policy-improvement", mdp=mdp, policy={s: {"go": 1} for s in "ab"}, values={"a": 1, "b": 0}, gamma=1)
