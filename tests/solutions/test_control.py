"""Identities between the rules of TD control, how closed forms are judged, and what wrong givens are told."""

from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import rldrill
from asking import solved
from numbers_drawn import small
from rldrill.problems.catalogue import family
from rldrill.problems.document import Paragraph
from rldrill.problems.errors import FileError
from rldrill.solutions.answers.judging import Outcome, judge
from rldrill.solutions.drawing import draw
from rldrill.solutions.solution import solver

STATES = ("a", "b", "c")
ACTIONS = ("x", "y", "z")
numbers = small(-5, 5, 4).map(str)
rates = st.sampled_from(["1/2", "1/4", "1"])
chances = st.integers(1, 9).map(lambda tenths: f"{tenths}/10")
tables = st.fixed_dictionaries({state: st.fixed_dictionaries(dict.fromkeys(ACTIONS, numbers)) for state in STATES})


@st.composite
def runs(draw_: Any) -> dict[str, Any]:
    """A run with its last action, a table, α and γ."""
    length = draw_(st.integers(1, 4))
    states = draw_(st.lists(st.sampled_from(STATES), min_size=length + 1, max_size=length + 1))
    return {
        "trajectory": {
            "states": states,
            "actions": [draw_(st.sampled_from(ACTIONS)) for _ in states],
            "rewards": [draw_(numbers) for _ in states[1:]],
        },
        "values": draw_(tables),
        "alpha": draw_(rates),
        "gamma": draw_(st.sampled_from(["1/2", "9/10", "1"])),
    }


identity = settings(deadline=None, max_examples=30)


@given(runs())
@identity
def test_expected_sarsa_without_exploration_is_q_learning(run: dict[str, Any]) -> None:
    assert solved("expected-sarsa", **run, epsilon=0)["a"] == solved("q-learning", **run)["a"]


@given(runs())
@identity
def test_expected_sarsa_of_the_policy_that_was_followed_for_certain_is_sarsa(run: dict[str, Any]) -> None:
    states, actions = run["trajectory"]["states"], run["trajectory"]["actions"]
    habit = dict(zip(states, actions, strict=True))
    run = run | {"trajectory": run["trajectory"] | {"actions": [habit[state] for state in states]}}
    assert solved("expected-sarsa", **run, policy=habit)["a"] == solved("sarsa", **run)["a"]


@given(runs())
@identity
def test_sarsa_lambda_with_lambda_0_is_sarsa(run: dict[str, Any]) -> None:
    assert solved("sarsa-lambda", **run, lam=0)["b"] == solved("sarsa", **run)["a"]


@given(runs())
@identity
def test_an_update_with_alpha_1_is_the_target(run: dict[str, Any]) -> None:
    run = run | {"alpha": 1, "trajectory": {key: items[:2] for key, items in run["trajectory"].items()}}
    run["trajectory"]["rewards"] = run["trajectory"]["rewards"][:1]
    both = solved("sarsa-versus-q-learning", **run)
    assert [both["a"]] == list(solved("sarsa", **run)["a"].values())
    assert [both["b"]] == list(solved("q-learning", **run)["a"].values())


@given(runs())
@identity
def test_double_q_learning_with_equal_tables_begins_as_q_learning(run: dict[str, Any]) -> None:
    # One transition: after it the tables are no longer equal.
    run = run | {"trajectory": {key: items[:2] for key, items in run["trajectory"].items()}}
    run["trajectory"]["rewards"] = run["trajectory"]["rewards"][:1]
    double = solved("double-q-learning", **run, second=run["values"], updates=[2])
    assert double["a"] == solved("q-learning", **run)["a"]


@given(tables, st.lists(numbers, min_size=3, max_size=3), rates)
@identity
def test_planning_once_round_a_circle_is_q_learning_twice_round_it(
    values: dict[str, Any], rewards: list[str], alpha: str
) -> None:
    def circle(rounds: int) -> dict[str, Any]:
        return {"states": [*STATES * rounds, "a"], "actions": ["x"] * 3 * rounds, "rewards": rewards * rounds}

    rest = {"values": values, "alpha": alpha, "gamma": "1/2"}
    both = solved("dyna-q", trajectory=circle(1), planned=[[state, "x"] for state in STATES], **rest)
    assert both["a"] == solved("q-learning", trajectory=circle(1), **rest)["a"]
    assert both["b"] == solved("q-learning", trajectory=circle(2), **rest)["a"]


@given(st.dictionaries(st.sampled_from("uvwxyz"), numbers, min_size=2), chances)
@identity
def test_epsilon_greedy_sums_to_one_and_favours_the_best(values: dict[str, str], epsilon: str) -> None:
    chance = solved("epsilon-greedy", values=values, epsilon=epsilon)["a"]
    assert sum(chance.values()) == 1
    best = max(values, key=lambda action: Fraction(values[action]))
    assert chance[best] == max(chance.values())


@given(st.integers(0, 10_000))
@settings(deadline=None, max_examples=15)
def test_tied_probabilities_sum_to_one_for_every_epsilon(seed: int) -> None:
    values = draw("epsilon-greedy", 3, seed).problem.data()["given"]["values"]
    assert sum(solved("epsilon-greedy", values=values, epsilon="epsilon")["a"].values()) == 1


@given(st.integers(0, 10_000))
@settings(deadline=None, max_examples=15)
def test_importance_ratios_are_1_where_the_policies_agree(seed: int) -> None:
    given_ = draw("importance-sampling", 2, seed).problem.data()["given"]
    answers = solved("importance-sampling", **given_ | {"target": given_["behaviour"]})
    assert set(answers["a"]) == {1}
    assert answers["b"] == answers["c"]


@given(st.integers(0, 10_000))
@settings(deadline=None, max_examples=15)
def test_the_weighted_estimate_lies_among_the_returns(seed: int) -> None:
    solution = draw("importance-sampling", 2, seed)
    returns = [
        solved("return", rewards=[str(reward) for reward in episode.rewards], gamma=str(solution.problem.given.gamma),
               time=0)["a"]
        for episode in solution.problem.given.episodes
    ]  # fmt: skip
    assert min(returns) <= solution.answers["c"] <= max(returns)


def test_closed_forms_are_judged_as_written_and_as_decimals() -> None:
    exercise = rldrill.read({"family": "bandit", "given": {"pulls": [["x", 4], ["x", 2], ["y", 1]], "c": 1}})
    # t = 4: U(x) = 3 + √(ln 4 / 2) = 3.8326…, U(y) = 1 + √(ln 4) = 2.1774….
    for typed in ("x: 3 + sqrt(log(4)/2), y: 1 + sqrt(ln 4)", "3.83, 2.18", "x: 3 + sqrt(ln 2), y: 2.177"):
        assert judge(exercise.solution, "b", typed).outcome is Outcome.RIGHT, typed
    forgot = judge(exercise.solution, "b", "3 + sqrt(ln 4), 1 + sqrt(ln 4)")
    assert [mistake.name for mistake in forgot.misconceptions] == ["own-count-forgotten"]
    steps = {"pulls": [["x", 1], ["y", 3]], "preferences": {"x": 1, "y": 0}, "alpha": "1/2", "pulled": ["y", 4]}
    gradient = rldrill.read({"family": "bandit", "given": steps})
    # π(x) = e/(1 + e) = 0.73106; H(x) = 1 − 1/2·2·0.73106 = 0.26894, H(y) = 1·0.73106.
    for typed in ("x: 1 - e/(1+e), y: 1 - 1/(1+e)", "x: 0.269, y: 0.731"):
        assert judge(gradient.solution, "b", typed).outcome is Outcome.RIGHT, typed


def test_going_on_from_an_earlier_answer_is_right() -> None:
    exercise = rldrill.read({"family": "epsilon-greedy",
                             "given": {"values": {"x": 4, "y": 1}, "epsilon": "1/2", "valued": True}})  # fmt: skip
    wrong = judge(exercise.solution, "a", "1/2, 1/4")
    assert [mistake.name for mistake in wrong.misconceptions] == ["share-of-epsilon-forgotten"]
    assert judge(exercise.solution, "b", "9/4", {"a": wrong.value}).outcome is Outcome.FOLLOW_THROUGH


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"state_value": 7}, "no ε from 0 to 1 leads to 7, only ε = −2/5"),  # 6 − 5/2·ε = 7
        ({"taken": ["y", "1/4"]}, "no ε from 0 to 1 leads to 1/4, only ε = 3/2"),  # 1 − ε/2 = 1/4
    ],
)
def test_an_exploration_rate_that_is_no_probability_is_refused(asked: dict[str, Any], said: str) -> None:
    given = {"values": {"x": 1, "y": 6}, "epsilon": "epsilon", **asked}
    with pytest.raises(FileError, match=said):
        rldrill.read({"family": "epsilon-greedy", "given": given})


RUN: dict[str, Any] = {
    "trajectory": {"states": ["a", "b"], "actions": ["x"], "rewards": [1]},
    "values": {"a": {"x": 1}, "b": {"x": 2, "y": 3}},
    "alpha": "1/2",
    "gamma": "1/2",
}
DYNA = RUN | {"planned": [["a", "x"]]}
EPISODE = {"states": ["s", "end"], "actions": ["x"], "rewards": [1], "terminal": ["end"]}
SAMPLING: dict[str, Any] = {
    "episodes": [EPISODE], "target": {"s": "x"}, "behaviour": {"s": {"x": 0.5, "y": 0.5}}, "gamma": 1
}  # fmt: skip
PULLS: dict[str, Any] = {"pulls": [["x", 1], ["y", 2]]}


@pytest.mark.parametrize(
    ("family", "given_", "fragment"),
    [
        ("sarsa-lambda", RUN | {"lam": 0.5}, "Sarsa(λ) needs the action taken in 'b'"),
        ("sarsa-lambda", RUN | {"lam": 2}, "given.lam: 2 is not between 0 and 1"),
        ("sarsa-versus-q-learning", RUN, "Sarsa needs the action taken in 'b'"),
        ("expected-sarsa", RUN, "give either policy or epsilon"),
        ("expected-sarsa", RUN | {"epsilon": 0.1, "policy": {"b": "x"}}, "give either policy or epsilon"),
        ("expected-sarsa", RUN | {"policy": {"a": "x"}}, "the policy of 'b' is missing"),
        ("expected-sarsa", RUN | {"policy": {"b": {"x": 0.5}}}, "probabilities in 'b' sum to 1/2, not to 1"),
        ("expected-sarsa", RUN | {"policy": {"b": "w"}}, "'w', which does not occur"),
        ("double-q-learning", RUN | {"second": RUN["values"], "updates": [1, 2]}, "1 transitions need as many"),
        ("double-q-learning", RUN | {"second": {"a": {"x": 1}}, "updates": [1]}, "the same states and actions"),
        ("dyna-q", DYNA | {"planned": []}, "given.planned"),
        ("dyna-q", DYNA | {"planned": [["b", "x"]]}, "(b, x) is not in the model after the run"),
        ("dyna-q", DYNA | {"model": [["b", "x", 1, "a"]] * 2}, "(b, x) is given twice"),
        ("dyna-q", DYNA | {"model": [["b", "z", 1, "a"]]}, "model has 'z' in 'b', which has no value"),
        ("dyna-q", DYNA | {"model": [["b", "x", 1, "c"]]}, "model leads to 'c', whose action values are missing"),
        ("dyna-q", DYNA | {"changed": [["a", "x", 1, "a"]]}, "(a, x) must be in the model and not be tried"),
        ("epsilon-greedy", {"values": {"x": 1}, "epsilon": 0.1}, "given.values"),
        ("epsilon-greedy", {"values": {"x": 1, "y": 2}, "epsilon": -1}, "not between 0 and 1"),
        ("importance-sampling", SAMPLING | {"behaviour": {"s": "y"}}, "'x' is taken in 's', where it has no prob"),
        ("importance-sampling", SAMPLING | {"target": {"u": "x"}}, "the target policy of 's' is missing"),
        ("importance-sampling", SAMPLING | {"target": {"s": {"x": 0.5}}}, "sum to 1/2, not to 1"),
        ("importance-sampling", SAMPLING | {"episodes": [EPISODE | {"terminal": []}]}, "must end in a terminal state"),
        ("importance-sampling", SAMPLING | {"target": {"s": "y"}, "episodes": [EPISODE] * 2}, "no answer"),
        ("bandit", {"pulls": [["x", 1]]}, "at least two arms"),
        ("bandit", PULLS | {"c": 0}, "given.c"),
        ("bandit", PULLS | {"alpha": 1}, "given.preferences: is missing; add it"),
        ("bandit", PULLS | {"c": 1, "alpha": 1, "preferences": {"x": 0, "y": 0}, "pulled": ["x", 1]}, "give one of"),
        ("bandit", PULLS | {"alpha": 1, "preferences": {"x": 0, "z": 0}, "pulled": ["x", 1]}, "given for 'y'"),
    ],
)
def test_wrong_givens_are_told_in_one_sentence(family: str, given_: dict[str, Any], fragment: str) -> None:
    with pytest.raises(FileError) as error:
        solved(family, **given_)
    assert fragment in str(error.value)
    assert "\n" not in str(error.value)


def test_an_action_that_a_policy_leaves_out_is_not_taken() -> None:
    # From a to b, reward 1: b is worth 1/4·8 + 3/4·4 = 5 there, since z is never taken; 0 + 1/2·(1 + 5 − 0) = 3.
    given = {
        "trajectory": {"states": ["a", "b"], "actions": ["x"], "rewards": [1]},
        "values": {"a": {"x": 0}, "b": {"x": 8, "y": 4, "z": 100}},
        "alpha": "1/2", "gamma": 1, "policy": {"b": {"x": "1/4", "y": "3/4"}},
    }  # fmt: skip
    assert list(solved("expected-sarsa", **given)["a"].values()) == [3]
    known = family("expected-sarsa")
    ((value,),) = solver(known).oracle(known.read(given))
    assert value == pytest.approx(3)


@pytest.mark.parametrize(
    ("arms", "said"),
    [
        (["a", "b", "c"], "c was never pulled, so its sample average does not exist"),
        (["a", "b", "c", "d"], "c and d were never pulled, so their sample averages do not exist"),
    ],
)
def test_an_arm_that_was_never_pulled_is_named(arms: list[str], said: str) -> None:
    exercise = rldrill.read({"family": "bandit", "given": {"arms": arms, "pulls": [["a", 1], ["b", 0]], "c": 1}})
    assert said in str(exercise.question())


@pytest.mark.parametrize(
    ("instead", "letter"),
    [
        (["b", "y", 5], "A"),  # y₀ of Sarsa is 1 + 1/2·Q(b, y); the greatest of 8 and 5 is 8 as before
        (["b", "x", 6], "B"),  # y₀ of Q-learning is 1 + 1/2·8, and 1 + 1/2·6 then
        (["b", "y", 9], "C"),  # the action taken is the best one then
        (["b", "x", 9], "B"),
        (["a", "y", 9], "D"),  # no target reads the state that was left
    ],
)
def test_whose_targets_hang_on_an_action_value(instead: list[Any], letter: str) -> None:
    answers = solved(
        "sarsa-versus-q-learning", trajectory={"states": ["a", "b"], "actions": ["x", "y"], "rewards": [1]},
        values={"a": {"x": 1, "y": 2}, "b": {"x": 8, "y": 4}}, alpha="1/2", gamma="1/2", instead=instead,
    )  # fmt: skip
    assert answers["c"] == letter


def test_every_return_of_importance_sampling_says_of_which_episode_it_is() -> None:
    working = str(rldrill.draw("importance-sampling", 2, 1).working("b"))
    assert [f"episode {number}: R₀ = " in working for number in (1, 2, 3)] == [True, True, False]


def test_q_learning_says_which_value_is_the_greatest_before_it_takes_it() -> None:
    rows = {"a": {"l": 2, "r": 4}, "b": {"l": 1, "m": 6, "r": 3}}
    run = {"states": ["a", "b", "a", "end"], "actions": ["l", "r", "r"], "rewards": [1, 2, 3]}
    given_ = {"values": rows, "trajectory": run | {"terminal": ["end"]}, "alpha": "1/2", "gamma": "1/2"}
    exercise = rldrill.read({"family": "q-learning", "given": given_})
    said = [block.text for block in exercise.working() if isinstance(block, Paragraph)]
    # Of b the table still holds 6; in a the first update has made 2 + 1/2 (1 + 3 − 2) = 3 of 2; the run then ends.
    assert said == ["In b, m has the greatest value, $6$.", "In a, r has the greater value, $4$."]
