"""Identities between sweeps, improvement, policy iteration and the error bounds of dynamic programming."""

from collections.abc import Mapping
from fractions import Fraction
from itertools import pairwise
from typing import Any

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

import rldrill
from asking import mistaken, solved
from rldrill.problems.document import Table
from rldrill.problems.errors import FileError
from rldrill.problems.models import Model
from rldrill.problems.valued import with_reward, worth
from rldrill.solutions.answers.judging import Outcome, judge
from rldrill.solutions.drawing import draw
from rldrill.solutions.work import Note, Step

Values = dict[str, fmpq]
GAMMAS = st.sampled_from(["1/4", "1/2", "9/10"])
STATES = ("a", "b", "c")


@st.composite
def models(draw: Any) -> dict[str, Any]:
    """Three states with two actions each, one next state or two, and an end."""
    rows = []
    for state in STATES:
        for action in ("go", "stay"):
            targets = draw(st.lists(st.sampled_from([*STATES, "end"]), min_size=1, max_size=2, unique=True))
            reward = draw(st.integers(-9, 9))
            rows += [[state, action, target, f"1/{len(targets)}", reward] for target in targets]
    return {"transitions": rows, "terminal": ["end"]}


policies = st.fixed_dictionaries(dict.fromkeys(STATES, st.sampled_from(["go", "stay"])))
starts = st.fixed_dictionaries(dict.fromkeys(STATES, st.integers(-9, 9)))


def text(values: Mapping[str, fmpq]) -> dict[str, str]:
    return {state: str(value) for state, value in values.items()}


def lookahead(mdp: dict[str, Any], gamma: str, values: Mapping[str, fmpq], pair: tuple[str, str]) -> fmpq:
    """One backup, from the table of transitions itself."""
    rows = [row for row in mdp["transitions"] if (row[0], row[1]) == pair]
    return sum((exact(p) * (exact(r) + exact(gamma) * values.get(s1, fmpq(0))) for _, _, s1, p, r in rows), fmpq(0))


def exact(number: object) -> fmpq:
    above, _, below = str(number).partition("/")
    return fmpq(int(above), int(below or 1))


def best(mdp: dict[str, Any], gamma: str, values: Mapping[str, fmpq], state: str) -> fmpq:
    return max(lookahead(mdp, gamma, values, (state, action)) for action in ("go", "stay"))


def rounds(mdp: dict[str, Any], start: Mapping[str, str], gamma: str, count: int) -> list[Any]:
    return list(solved("policy-iteration", mdp=mdp, start=start, gamma=gamma, rounds=count).values())


@pytest.mark.parametrize("level", [1, 2])
def test_a_tie_is_told_only_where_several_actions_are_best(level: int) -> None:
    for seed in range(10):
        lines = draw("policy-iteration", level, seed).lines
        several = sum(
            isinstance(line, Step) and isinstance(line.value, tuple) and len(line.value) > 1 for line in lines
        )
        told = sum(isinstance(line, Note) and "there is a tie" in line.text for line in lines)
        assert told <= several


@given(models(), policies, GAMMAS)
@settings(deadline=None, max_examples=25)
def test_policy_iteration_never_gets_worse_and_ends_optimal(mdp: Any, start: Any, gamma: str) -> None:
    *answers, ended = rounds(mdp, start, gamma, 9)  # there are eight policies, so the ninth round changes nothing
    values = answers[::2]
    for before, after in pairwise(values):
        assert all(after[state] >= before[state] for state in STATES)
    assert ended is True
    assert all(values[-1][state] == best(mdp, gamma, values[-1], state) for state in STATES)


@given(models(), policies, GAMMAS)
@settings(deadline=None, max_examples=20)
def test_a_round_of_policy_iteration_is_evaluation_and_improvement(mdp: Any, start: Any, gamma: str) -> None:
    values, improved, ended = rounds(mdp, start, gamma, 1)
    assert values == solved("policy-value", mdp=mdp, policy=start, gamma=gamma)["a"]
    greedy = solved("policy-improvement", mdp=mdp, policy=start, values=text(values), gamma=gamma)
    for state in STATES:
        kept = start[state] in greedy["a"][state]
        assert improved[state] == ((start[state],) if kept else greedy["a"][state])
    assert greedy["b"] is ended


@given(models(), policies, GAMMAS)
@settings(deadline=None, max_examples=20)
def test_values_that_are_asked_for_are_those_that_can_be_given(mdp: Any, start: Any, gamma: str) -> None:
    given_ = {"mdp": mdp, "policy": start, "gamma": gamma}
    other = dict.fromkeys(STATES, "go")
    asked = solved("policy-improvement", **given_)
    assert (asked["b"], asked["c"]) == tuple(solved("policy-improvement", **given_, values=text(asked["a"])).values())
    asked = solved("policy-improvement-theorem", **given_, other=other)
    known = solved("policy-improvement-theorem", **given_, other=other, values=text(asked["a"]))
    assert (asked["b"], asked["c"]) == tuple(known.values())


@given(models(), policies, policies, GAMMAS)
@settings(deadline=None, max_examples=30)
def test_the_policy_improvement_theorem_is_true(mdp: Any, policy: Any, other: Any, gamma: str) -> None:
    applies = solved("policy-improvement-theorem", mdp=mdp, policy=policy, other=other, gamma=gamma)["c"]
    old, new = (solved("policy-value", mdp=mdp, policy=pi, gamma=gamma)["a"] for pi in (policy, other))
    if applies:
        assert all(new[state] >= old[state] for state in STATES)


@given(models(), policies, GAMMAS)
@settings(deadline=None, max_examples=20)
def test_the_theorem_applies_to_the_greedy_policy(mdp: Any, policy: Any, gamma: str) -> None:
    greedy = solved("policy-improvement", mdp=mdp, policy=policy, gamma=gamma)["b"]
    other = {state: actions[0] for state, actions in greedy.items()}
    assert solved("policy-improvement-theorem", mdp=mdp, policy=policy, other=other, gamma=gamma)["c"] is True


@given(models(), GAMMAS, st.integers(1, 4))
@settings(deadline=None, max_examples=25)
def test_value_iteration_rises_from_below(mdp: Any, gamma: str, sweeps: int) -> None:
    low = dict.fromkeys(STATES, -9 / (1 - exact(gamma)))  # no policy earns less, so V₀ ≤ TV₀
    given_ = {"mdp": mdp, "gamma": gamma, "start": text(low)}
    before, after = (solved("value-iteration", **given_, sweeps=k)["a"] for k in (sweeps, sweeps + 1))
    assert all(low[state] <= before[state] <= after[state] for state in STATES)


@given(models(), starts, GAMMAS, st.integers(1, 4))
@settings(deadline=None, max_examples=25)
def test_value_iteration_keeps_the_bound_of_contraction(mdp: Any, start: Any, gamma: str, sweeps: int) -> None:
    optimum = rounds(mdp, dict.fromkeys(STATES, "go"), gamma, 9)[-3]
    after = solved("value-iteration", mdp=mdp, gamma=gamma, start=start, sweeps=sweeps)["a"]
    error = max(abs(after[state] - optimum[state]) for state in STATES)
    given_ = {"start": start, "gamma": gamma, "sweeps": sweeps}
    assert error <= solved("contraction", **given_, optimum=text(optimum))["b"]
    first = solved("value-iteration", mdp=mdp, gamma=gamma, start=start, sweeps=1)["a"]
    bounds = solved("contraction", **given_, first=text(first))
    assert max(abs(start[state] - optimum[state]) for state in STATES) <= bounds["b"]
    assert error <= bounds["c"]


@given(models(), policies, starts, GAMMAS, st.booleans(), st.integers(1, 5))
@settings(deadline=None, max_examples=30)
def test_both_kinds_of_sweep_shrink_the_error_by_gamma(
    mdp: Any, policy: Any, start: Any, gamma: str, in_place: bool, sweeps: int
) -> None:
    limit = solved("policy-value", mdp=mdp, policy=policy, gamma=gamma)["a"]
    given_ = {"mdp": mdp, "policy": policy, "gamma": gamma, "start": start, "in_place": in_place}
    after = solved("policy-evaluation", **given_, sweeps=sweeps)["a"]
    error = max(abs(after[state] - limit[state]) for state in STATES)
    assert error <= exact(gamma) ** sweeps * max(abs(start[state] - limit[state]) for state in STATES)


@given(models(), policies, starts, GAMMAS, st.integers(1, 3))
@settings(deadline=None, max_examples=20)
def test_evaluation_of_the_only_policy_is_value_iteration(
    mdp: Any, policy: Any, start: Any, gamma: str, sweeps: int
) -> None:
    only = {**mdp, "transitions": [row for row in mdp["transitions"] if policy[row[0]] == row[1]]}
    given_ = {"mdp": only, "gamma": gamma, "start": start, "sweeps": sweeps}
    assert solved("policy-evaluation", **given_)["a"] == solved("value-iteration", **given_)["a"]


def test_without_discount_of_the_future_one_sweep_is_enough() -> None:
    mdp = {"transitions": [["a", "x", "a", 1, 2], ["a", "y", "b", 1, 4], ["b", "x", "a", 1, 6]]}
    once, twice = (solved("policy-evaluation", mdp=mdp, gamma=0, sweeps=k)["a"] for k in (1, 2))
    assert once == twice == {"a": 3, "b": 6}


@given(models(), GAMMAS)
@settings(deadline=None, max_examples=20)
def test_greedy_from_q_of_v_is_greedy_from_v(mdp: Any, gamma: str) -> None:
    optimum = rounds(mdp, dict.fromkeys(STATES, "go"), gamma, 9)[-3]
    table = {
        state: {action: str(lookahead(mdp, gamma, optimum, (state, action))) for action in ("go", "stay")}
        for state in STATES
    }
    from_v = solved("optimal-policy-from-v", mdp=mdp, values=text(optimum), gamma=gamma)["a"]
    assert solved("optimal-policy-from-q", values=table)["a"] == from_v


@given(models(), GAMMAS)
@settings(deadline=None, max_examples=20)
def test_a_gap_in_q_is_filled_with_what_was_there(mdp: Any, gamma: str) -> None:
    optimum = rounds(mdp, dict.fromkeys(STATES, "go"), gamma, 9)[-3]
    table = {
        state: {action: lookahead(mdp, gamma, optimum, (state, action)) for action in ("go", "stay")}
        for state in STATES
    }
    rows = [row for row in mdp["transitions"] if row[:2] == ["a", "go"]]
    if any(row[2] == "a" for row in rows):  # back to its own state, whose values would not be complete
        return
    holed = {state: {a: str(q) for a, q in row.items() if (state, a) != ("a", "go")} for state, row in table.items()}
    missing = {"transitions": rows}
    answers = solved("optimal-policy-from-q", values=holed, missing=missing, gamma=gamma, terminal=["end"])
    assert answers["a"] == {("a", "go"): table["a"]["go"]}


@given(st.integers(0, 10_000), st.sampled_from([1, 2, 3]))
@settings(deadline=None, max_examples=20)
def test_drawn_optimal_values_are_optimal(seed: int, level: int) -> None:
    solution = draw("optimal-policy-from-v", level, seed)
    given_: Any = solution.problem.given
    mdp: Model = given_.mdp
    values = dict(given_.values)
    if given_.missing is not None:
        found = solution.answers["a"]
        values[given_.missing] = Fraction(int(found.p), int(found.q))
    for state, actions in mdp.actions.items():
        assert values[state] == max(worth(mdp, (state, a), values, given_.gamma) for a in actions)


@given(st.integers(1, 40), st.sampled_from(["1/2", "2/3", "99/100", "0"]), st.sampled_from(["1", "1/7", "1/1000", "5"]))
@settings(deadline=None, max_examples=40)
def test_the_smallest_k_is_the_first_that_is_enough(distance: int, gamma: str, accuracy: str) -> None:
    given_ = {"start": {"a": 0}, "optimum": {"a": distance}, "gamma": gamma, "sweeps": 1, "accuracy": accuracy}
    error, k = fmpq(distance), 0
    while error > exact(accuracy):
        error, k = error * exact(gamma), k + 1
    assert solved("contraction", **given_)["c"] == k


def test_an_accuracy_that_is_met_exactly_is_met() -> None:
    # 8 · (1/2)³ = 1.
    given_ = {"start": {"a": 0}, "optimum": {"a": 8}, "gamma": "1/2", "sweeps": 2, "accuracy": 1}
    assert solved("contraction", **given_) == {"a": 8, "b": 2, "c": 3}


@given(st.integers(0, 10_000))
@settings(deadline=None, max_examples=15)
def test_a_policy_is_optimal_up_to_the_bound_and_not_beyond(seed: int) -> None:
    solution = draw("policy-iteration", 3, seed)
    given_: Any = solution.problem.given
    bound = Fraction(str(solution.answers["b"]))
    for reward, optimal in ((bound - 1, True), (bound, True), (bound + Fraction(1, 1000), False)):
        mdp = with_reward(given_.mdp, reward).model_dump(mode="json")
        assert rounds(mdp, given_.start, str(given_.gamma), 1)[-1] is optimal
    mdp = with_reward(given_.mdp, given_.reward).model_dump(mode="json")
    assert solution.answers["c"] == rounds(mdp, given_.start, str(given_.gamma), 2)[2]


def test_on_a_tie_the_old_action_is_kept() -> None:
    mdp = {"transitions": [["a", "x", "end", 1, 1], ["a", "y", "end", 1, 1]], "terminal": ["end"]}
    for action in ("x", "y"):
        assert rounds(mdp, {"a": action}, "1/2", 1) == [{"a": 1}, {"a": (action,)}, True]


def test_a_wrong_evaluation_costs_once() -> None:
    solution = draw("policy-iteration", 2, 1)
    states = list(solution.answers["a"])
    wrong = {state: value + 1 for state, value in solution.answers["a"].items()}
    follow = solution.following({"a": wrong})
    typed = ", ".join(f"{state}: {follow['b'][state][0]}" for state in states)
    assert judge(solution, "b", typed, {"a": wrong}).accepted
    # Somebody whose first policy is another one goes on with that one.
    given_: Any = solution.problem.given
    other = {
        state: (next(a for a in given_.mdp.actions[state] if (a,) != solution.answers["b"][state]),) for state in states
    }
    follow = solution.following({"b": other})
    typed = ", ".join(f"{state}: {follow['c'][state]}" for state in states)
    assert follow["c"] != solution.answers["c"]
    assert judge(solution, "c", typed, {"b": other}).outcome is Outcome.FOLLOW_THROUGH


MDP = {"transitions": [["a", "x", "b", 1, 2], ["a", "y", "end", 1, 1], ["b", "x", "end", 1, 4]], "terminal": ["end"]}
OPEN = {"transitions": [["a", "x", "b", 1, 2], ["a", "y", "end", 1, "x"], ["b", "x", "end", 1, 4]], "terminal": ["end"]}
PI = {"a": "x", "b": "x"}


@pytest.mark.parametrize(
    ("family", "given_", "fragment"),
    [
        ("policy-evaluation", {"mdp": MDP, "gamma": 1, "sweeps": 0}, "given.sweeps"),
        ("policy-evaluation", {"mdp": MDP, "gamma": 1, "sweeps": 1, "policy": {"a": "z", "b": "x"}}, "policy in 'a'"),
        ("policy-evaluation", {"mdp": MDP, "gamma": 1, "sweeps": 1, "start": {"a": 1}}, "value of 'b' is missing"),
        ("policy-improvement", {"mdp": MDP, "gamma": "1/2", "policy": PI, "values": {"a": 3, "b": 4}}, "gives 4"),
        ("policy-improvement", {"mdp": MDP, "gamma": "1/2", "policy": PI, "values": {"a": 4}}, "'b' is missing"),
        ("policy-improvement", {"mdp": MDP, "gamma": "1/2", "policy": {"a": "x"}}, "policy of 'b' is missing"),
        ("policy-improvement-theorem", {"mdp": MDP, "gamma": 1, "policy": PI, "other": {"a": "y"}}, "'b' is missing"),
        ("policy-iteration", {"mdp": MDP, "gamma": 1, "start": {"a": "x", "b": "y"}, "rounds": 1}, "policy in 'b'"),
        ("policy-iteration", {"mdp": MDP, "gamma": 1, "start": PI, "rounds": 99}, "given.rounds"),
        ("policy-iteration", {"mdp": MDP, "gamma": "1/2", "start": PI, "rounds": 1, "reward": 1}, "give one of them"),
        ("policy-iteration", {"mdp": MDP, "gamma": "1/2", "start": PI, "reward": 1}, "leave exactly one number open"),
        ("policy-iteration", {"mdp": OPEN, "gamma": "1/2", "start": {"a": "y", "b": "x"}, "reward": 9}, "start with"),
        ("policy-iteration", {"mdp": OPEN, "gamma": 1, "start": PI, "reward": 9}, "choose a smaller one"),
        ("optimal-policy-from-v", {"mdp": MDP, "gamma": 1, "values": {"a": 6, "b": 5}}, "best action is worth"),
        ("optimal-policy-from-v", {"mdp": MDP, "gamma": 1, "values": {"a": 6, "c": 5}}, "'b' is missing"),
        ("optimal-policy-from-q", {"values": {}}, "given.values"),
        ("optimal-policy-from-q", {"values": {"a": {}}}, "no action of 'a'"),
        ("optimal-policy-from-q", {"values": {"a": {"x": 1}}, "terminal": ["a"]}, "'a' is terminal"),
        ("contraction", {"start": {"a": 1}, "gamma": "1/2", "sweeps": 1}, "give either optimum"),
        ("contraction", {"start": {"a": 1}, "optimum": {"a": 2}, "gamma": 1, "sweeps": 1}, "no contraction"),
        ("contraction", {"start": {"a": 1}, "optimum": {"b": 2}, "gamma": 0, "sweeps": 1}, "'a' is missing"),
        (
            "contraction",
            {"start": {"a": 1}, "optimum": {"a": 2}, "gamma": 0, "sweeps": 1, "accuracy": 0},
            "given.accuracy: 0 is not above 0",
        ),
        (
            "contraction",
            {"start": {"a": 1}, "optimum": {"a": 2}, "gamma": "0.9999", "sweeps": 1, "accuracy": "1e-9"},
            "more than 4096 sweeps",
        ),
    ],
)  # fmt: skip
def test_wrong_givens(family: str, given_: Any, fragment: str) -> None:
    with pytest.raises(FileError) as error:
        solved(family, **given_)
    assert fragment in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("rows", "more", "fragment"),
    [
        ([["a", "y", "end", 1, 1]], {}, "discount is needed"),
        ([["a", "x", "end", 1, 1]], {"gamma": 1}, "has a value already"),
        ([["c", "x", "end", 1, 1]], {"gamma": 1}, "'c' does not occur"),
        ([["a", "y", "d", 1, 1]], {"gamma": 1}, "'d' is reached but has no values"),
        ([["a", "y", "a", 1, 1]], {"gamma": 1}, "'a' is reached but has a missing value itself"),
    ],
)
def test_gaps_that_cannot_be_filled(rows: Any, more: Any, fragment: str) -> None:
    values = {"a": {"x": 1}, "b": {"x": 2}}
    with pytest.raises(FileError, match=fragment):
        solved("optimal-policy-from-q", values=values, missing={"transitions": rows}, terminal=["end"], **more)


def test_the_actions_of_a_table_stand_in_the_order_of_the_longest_row() -> None:
    given = {"values": {"a": {"stay": 1}, "b": {"left": 3, "stay": 2, "right": 1}}}
    (table,) = (block for block in rldrill.read({"family": "optimal-policy-from-q", "given": given}).question()
                if isinstance(block, Table))  # fmt: skip
    assert table.header[1:] == ("left", "stay", "right")
    assert table.rows == (("a", "–", "$1$", "–"), ("b", "$3$", "$2$", "$1$"))


def test_whoever_averages_over_the_actions_finds_other_values_and_another_reward() -> None:
    # a: (2 + 1/2·y + 2)/2 = 5 gives y = V₁(b) = 12; b: (x + 1/2·V₀(a) + 4)/2 = (x + 2 + 4)/2 = 12 gives x = 18.
    # V₁(a) = (2 + 1/2·2 + 2)/2 = 5/2, so V₂(b) = (18 + 1/2·5/2 + 4)/2 = 93/8.
    rows = [["a", "go", "b", 1, 2], ["a", "quit", "end", 1, 2], ["b", "back", "a", 1, "x"], ["b", "quit", "end", 1, 4]]
    mdp = {"transitions": rows, "terminal": ["end"]}
    given = {"mdp": mdp, "gamma": "1/2", "start": {"a": 4, "b": 2}, "outcome": {"a": 5}}
    answers = mistaken("mean-for-max", "value-iteration", **given)
    assert (answers["a"], answers["b"], answers["c"]) == (12, 18, {"b": fmpq(93, 8)})
