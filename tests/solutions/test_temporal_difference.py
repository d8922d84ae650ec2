"""Identities between the rules of temporal difference learning, and what is refused."""

from fractions import Fraction
from typing import Any

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

import rldrill
from asking import solved
from numbers_drawn import small
from rldrill.problems.errors import FileError
from rldrill.solutions.rational import RationalFunction

numbers = small(-5, 5, 4).map(str)
rates = st.sampled_from(["1/4", "1/2", "9/10"])
discounts = st.sampled_from(["0", "1/2", "4/5", "1"])
quick = settings(deadline=None, max_examples=30)


@st.composite
def episodes(draw: Any, repeats: bool = True) -> dict[str, Any]:
    """An episode with values for its states; states come back unless they must not."""
    states = draw(st.lists(st.sampled_from("abcd"), min_size=1, max_size=4, unique=not repeats))
    rewards = [draw(numbers) for _ in states]
    run = {"states": [*states, "end"], "rewards": rewards, "terminal": ["end"]}
    return {"trajectory": run, "values": {state: draw(numbers) for state in sorted(set(states))}}


def steps(episode: dict[str, Any]) -> int:
    return len(episode["trajectory"]["rewards"])


def last_of(answers: Any) -> Any:
    return answers[max(answers)]


@given(episodes(), discounts)
@quick
def test_the_lambda_return_of_lambda_0_is_the_one_step_return(episode: Any, gamma: str) -> None:
    one_step = solved("n-step-return", **episode, gamma=gamma, asked=[[0, 1]])["a"]
    assert last_of(solved("lambda-return", **episode, gamma=gamma, lam=0)) == one_step


@given(episodes(), discounts)
@quick
def test_the_lambda_return_of_lambda_1_is_the_return(episode: Any, gamma: str) -> None:
    for time in range(steps(episode)):
        whole = solved("return", rewards=episode["trajectory"]["rewards"], gamma=gamma)["a"][time]
        assert last_of(solved("lambda-return", **episode, gamma=gamma, lam=1, time=time)) == whole


@given(episodes())
@quick
def test_without_a_future_the_lambda_return_is_the_next_reward(episode: Any) -> None:
    found = last_of(solved("lambda-return", **episode, gamma=0, lam="1/3"))
    assert found == fmpq(*Fraction(episode["trajectory"]["rewards"][0]).as_integer_ratio())


@given(numbers, st.integers(1, 5), discounts)
@quick
def test_the_weights_of_the_lambda_return_sum_to_1(value: str, length: int, gamma: str) -> None:
    # Every n-step return is the value of the start if each reward is that value less what follows.
    follows = Fraction(gamma) * Fraction(value)
    rewards = [str(Fraction(value) - (follows if time < length - 1 else 0)) for time in range(length)]
    run = {"states": [*"abcde"[:length], "end"], "rewards": rewards, "terminal": ["end"]}
    values = dict.fromkeys("abcde"[:length], value)
    found = last_of(solved("lambda-return", trajectory=run, values=values, gamma=gamma, lam="lambda"))
    assert found == fmpq(*Fraction(value).as_integer_ratio())


@given(episodes(repeats=False), rates, discounts)
@quick
def test_the_forward_view_of_lambda_0_is_td_zero(episode: Any, alpha: str, gamma: str) -> None:
    run = episode["trajectory"]
    first = {"states": run["states"][:2], "rewards": run["rewards"][:1], "terminal": ["end"]}
    values = {state: value for state, value in episode["values"].items() if state in first["states"]}
    after = solved("td-zero", trajectory=first, values=values, alpha=alpha, gamma=gamma)["a"]
    assert solved("td-lambda-forward", **episode, alpha=alpha, gamma=gamma, lam=0, asked=[0])["b"] == after


@given(episodes(repeats=False), rates, discounts)
@quick
def test_the_forward_view_of_lambda_1_is_monte_carlo(episode: Any, alpha: str, gamma: str) -> None:
    known = {**episode, "alpha": alpha, "gamma": gamma}
    forward = solved("td-lambda-forward", **known, lam=1, asked=list(range(steps(episode))))["b"]
    assert forward == solved("monte-carlo", **known, visits="every")["b"]


@given(episodes(), rates, discounts)
@quick
def test_the_backward_view_of_lambda_0_is_td_zero(episode: Any, alpha: str, gamma: str) -> None:
    known = {**episode, "alpha": alpha, "gamma": gamma}
    assert solved("td-lambda-backward", **known, lam=0) == solved("td-zero", **known)


@given(episodes(), discounts, st.sampled_from(["0", "1/3", "1/2", "1"]))
@quick
def test_both_views_agree_offline(episode: Any, gamma: str, lam: str) -> None:
    # Sutton & Barto 2018, exercise 12.3 and section 12.2: with the values held still, the sum of the forward
    # view's errors, state by state, is the sum of the TD errors times the traces.
    run, known = episode["trajectory"], {**episode, "gamma": gamma}
    states = run["states"][:-1]
    before = {state: fmpq(*Fraction(value).as_integer_ratio()) for state, value in episode["values"].items()}
    forward, backward = dict.fromkeys(before, fmpq(0)), dict.fromkeys(before, fmpq(0))
    for time, state in enumerate(states):
        forward[state] += last_of(solved("lambda-return", **known, lam=lam, time=time)) - before[state]
        error = solved("n-step-return", **known, asked=[[time, 1]])["a"] - before[state]
        for other, trace in solved("eligibility-trace", states=states, gamma=gamma, lam=lam, asked=[time])["a"].items():
            backward[other] += error * trace
    assert forward == backward


@given(episodes(), discounts, st.sampled_from(["0", "1/3", "1"]))
@quick
def test_learning_online_is_learning_offline_to_first_order_in_alpha(episode: Any, gamma: str, lam: str) -> None:
    known = {**episode, "gamma": gamma, "lam": lam}
    online = solved("td-lambda-backward", **known, alpha="alpha")["a"]
    for state, value in online.items():
        times = [time for time, visited in enumerate(episode["trajectory"]["states"]) if visited == state]
        before = fmpq(*Fraction(episode["values"][state]).as_integer_ratio())
        first_order = value.top[1] if isinstance(value, RationalFunction) else fmpq(0)
        assert first_order == sum(last_of(solved("lambda-return", **known, time=time)) - before for time in times)


@given(st.lists(st.sampled_from("abc"), min_size=1, max_size=6), st.sampled_from([("0", "1/2"), ("1/2", "0")]))
@quick
def test_without_memory_only_the_visited_state_has_a_trace(states: list[str], rates_: tuple[str, str]) -> None:
    last = len(states) - 1
    traces = solved("eligibility-trace", states=states, gamma=rates_[0], lam=rates_[1], asked=[last])["a"]
    assert traces == {state: int(state == states[-1]) for state in traces}


@given(st.lists(st.sampled_from("abc"), min_size=1, max_size=6))
@quick
def test_traces_that_do_not_decay_count_the_visits(states: list[str]) -> None:
    traces = solved("eligibility-trace", states=states, gamma=1, lam=1, asked=[len(states) - 1])["a"]
    assert traces == {state: states.count(state) for state in traces}


@given(episodes(repeats=False), rates, discounts)
@quick
def test_first_visit_is_every_visit_where_no_state_comes_back(episode: Any, alpha: str, gamma: str) -> None:
    known = {**episode, "alpha": alpha, "gamma": gamma}
    assert solved("monte-carlo", **known, visits="first") == solved("monte-carlo", **known, visits="every")


@given(episodes(), discounts)
@quick
def test_monte_carlo_with_alpha_1_keeps_the_last_return(episode: Any, gamma: str) -> None:
    found = solved("monte-carlo", **episode, alpha=1, gamma=gamma, visits="every")
    returns = found["a"] if isinstance(found["a"], tuple) else (found["a"],)
    assert found["b"] == dict(zip(episode["trajectory"]["states"], returns, strict=False))


@given(episodes(), rates)
@quick
def test_without_a_future_monte_carlo_returns_are_the_rewards(episode: Any, alpha: str) -> None:
    returns = solved("monte-carlo", **episode, alpha=alpha, gamma=0, visits="every")["a"]
    rewards = [fmpq(*Fraction(reward).as_integer_ratio()) for reward in episode["trajectory"]["rewards"]]
    assert (list(returns) if len(rewards) > 1 else [returns]) == rewards


@given(st.lists(numbers, min_size=1, max_size=8), numbers)
@quick
def test_the_sample_average_is_the_plain_mean(returns: list[str], start: str) -> None:
    found = solved("sample-average", values={"a": start}, counts={"a": 0}, visits=[["a", value] for value in returns])
    mean = sum(map(Fraction, returns)) / len(returns)
    assert found["a"] == {"a": fmpq(mean.numerator, mean.denominator)}


@given(st.lists(numbers, min_size=1, max_size=5), numbers, st.sampled_from(["1/3", "1", "alpha"]))
@quick
def test_a_constant_step_size_weights_returns_that_are_all_alike_by_1(
    returns: list[str], start: str, alpha: str
) -> None:
    known = {"values": {"a": start}, "alpha": alpha}
    visits = [["a", start] for _ in returns]
    assert solved("sample-average", **known, visits=visits)["b"] == fmpq(*Fraction(start).as_integer_ratio())


@st.composite
def batches(draw: Any) -> list[dict[str, Any]]:
    """Some episodes over three states, some seen several times."""
    paths = draw(st.lists(st.lists(st.sampled_from("abc"), min_size=1, max_size=4), min_size=1, max_size=4))
    return [
        {"states": path, "rewards": [draw(numbers) for _ in path], "times": draw(st.integers(1, 3))} for path in paths
    ]


@given(batches(), discounts)
@quick
def test_batch_td_is_the_certainty_equivalence(episodes_: list[dict[str, Any]], gamma: str) -> None:
    # The value of the Markov process that is most likely behind the data: observed frequencies, mean rewards.
    seen: dict[tuple[str, str], list[Fraction]] = {}
    for episode in episodes_:
        after = [*episode["states"][1:], "end"]
        for state, reward, next_ in zip(episode["states"], episode["rewards"], after, strict=True):
            seen.setdefault((state, next_), []).extend([Fraction(reward)] * episode["times"])
    visits = {state: sum(len(found) for (left, _), found in seen.items() if left == state) for state, _ in seen}
    model = [
        [state, "go", next_, str(Fraction(len(found), visits[state])), str(sum(found) / len(found))]
        for (state, next_), found in seen.items()
    ]
    expected = solved("policy-value", mdp={"transitions": model, "terminal": ["end"]}, gamma=gamma)["a"]
    assert solved("batch-td-and-mc", episodes=episodes_, gamma=gamma)["b"] == expected


@given(batches())
@quick
def test_without_a_future_both_batch_methods_average_the_rewards(episodes_: list[dict[str, Any]]) -> None:
    answers = solved("batch-td-and-mc", episodes=episodes_, gamma=0)
    assert answers["a"] == answers["b"]


RUN = {"states": ["a", "b", "a", "end"], "rewards": [1, 2, 3], "terminal": ["end"]}
EPISODE: dict[str, Any] = {"trajectory": RUN, "values": {"a": 1, "b": 2}, "gamma": 1}
UNFINISHED = {"trajectory": {"states": ["a", "b"], "rewards": [1]}, "values": {"a": 1, "b": 2}, "gamma": 1}


@pytest.mark.parametrize(
    ("family", "given_", "fragment"),
    [
        ("lambda-return", EPISODE | {"lam": "1/2", "time": 3}, "time is 3, but the run ends at 3"),
        ("lambda-return", EPISODE | {"lam": "3/2"}, "given.lam: 3/2 is not between 0 and 1"),
        ("lambda-return", EPISODE | {"lam": "lambda", "gamma": "gamma"}, "gamma and lambda are left open"),
        ("td-lambda-forward", EPISODE | {"alpha": 1, "lam": 0, "asked": [0, 2]}, "asked: a state is updated twice"),
        ("td-lambda-forward", EPISODE | {"alpha": 1, "lam": 0, "asked": [3]}, "asked: there is no state to update"),
        ("td-lambda-backward", EPISODE | {"alpha": "alpha", "lam": "lambda"}, "alpha and lambda are left open"),
        ("td-lambda-backward", EPISODE | {"alpha": 1, "lam": 0, "values": {"a": 1}}, "the value of 'b' is missing"),
        ("eligibility-trace", {"states": ["a"], "gamma": 1, "lam": 1, "asked": [1]}, "no state is visited at time 1"),
        ("eligibility-trace", {"states": ["a", "b"], "gamma": 1, "lam": 1, "asked": [1, 0]}, "the times must rise"),
        ("eligibility-trace", {"states": [], "gamma": 1, "lam": 1, "asked": [0]}, "given.states"),
        ("monte-carlo", EPISODE | {"alpha": 1, "visits": "last"}, "given.visits"),
        (
            "monte-carlo",
            UNFINISHED | {"alpha": 1, "visits": "first"},
            "the run does not end in 'b'",
        ),
        ("monte-carlo", EPISODE | {"alpha": 0, "visits": "first"}, "given.alpha: 0 is not above 0"),
        ("sample-average", {"values": {"a": 1}, "visits": [["a", 2]]}, "the number of visits of 'a' is missing"),
        ("sample-average", {"values": {"a": 1}, "counts": {"a": 1}, "visits": [["b", 2]]}, "given for 'b'"),
        ("sample-average", {"values": {"a": 1}, "counts": {"a": -1}, "visits": [["a", 2]]}, "counts: 'a' cannot"),
        ("sample-average", {"values": {"a": 1}, "counts": {"a": 1}, "visits": [["a", 2]], "alpha": 1}, "either counts"),
        ("sample-average", {"values": {"a": 1, "b": 2}, "visits": [["a", 2]], "alpha": 1}, "the one state"),
        ("batch-td-and-mc", {"episodes": [{"states": ["a"], "rewards": [1, 2]}], "gamma": 1}, "as many rewards"),
        ("batch-td-and-mc", {"episodes": [], "gamma": 1}, "given.episodes"),
        ("batch-td-and-mc", {"episodes": [{"states": ["a"], "rewards": [1], "times": 0}], "gamma": 1}, "times"),
    ],
)
def test_wrong_givens(family: str, given_: dict[str, Any], fragment: str) -> None:
    with pytest.raises(FileError) as error:
        solved(family, **given_)
    assert fragment in str(error.value)
    assert "\n" not in str(error.value)


def test_mistakes_that_cannot_be_made_are_not_looked_for() -> None:
    # One step to the end: there is nothing to average, no state to visit twice, no reward before the state.
    run = {"states": ["a", "end"], "rewards": [3], "terminal": ["end"]}
    known: dict[str, Any] = {"trajectory": run, "values": {"a": 1}, "gamma": "1/2", "alpha": "1/2"}
    for family, more in (
        ("td-lambda-backward", {"lam": "1/2"}),
        ("monte-carlo", {"visits": "first"}),
    ):
        exercise = rldrill.read({"family": family, "given": known | more})
        names = {m.name for m, _ in exercise.solution.mistakes}
        assert not names & {"only-visited-state-updated", "own-value-in-td-error", "other-visits"}
        assert "reward-before-the-state" not in names


def test_the_literal_reading_of_the_sheet_is_recognised() -> None:
    # a → b: δ = 1 + 2 − 4 = −1, V(a) = 4 − 1/2 = 7/2. Then b → end: e(a) = 1/2 and δ = 3 − 2 = 1, so
    # V(a) = 7/2 + 1/2·1/2·1 = 15/4. With its own value in δ it would be 7/2 + 1/4·(3 − 7/2) = 27/8.
    run = {"states": ["a", "b", "end"], "rewards": [1, 3], "terminal": ["end"]}
    known = {"trajectory": run, "values": {"a": 4, "b": 2}, "alpha": "1/2", "gamma": 1, "lam": "1/2"}
    exercise = rldrill.read({"family": "td-lambda-backward", "given": known})
    assert exercise.solve()["a"] == {"a": fmpq(15, 4), "b": fmpq(5, 2)}
    (literal,) = [answers for m, answers in exercise.solution.mistakes if m.name == "own-value-in-td-error"]
    assert literal["a"]["a"] == fmpq(27, 8)
