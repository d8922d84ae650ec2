"""Identities between returns, expectations and the Markov property."""

from fractions import Fraction
from typing import Any

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

import rldrill
from asking import mistaken, solved
from numbers_drawn import small
from rldrill.problems.errors import FileError
from rldrill.problems.exact import Parameter
from rldrill.problems.parts import YesNo
from rldrill.solutions.drawing import draw
from rldrill.solutions.formula.compiling import value_of
from rldrill.solutions.formula.notation import Counting, ProductOver, i
from rldrill.solutions.formula.putting_in import put_in
from rldrill.solutions.formula.typesetting import typeset

numbers = small(-5, 5, 4).map(str)
discounts = st.sampled_from(["0", "1/2", "9/10"])


@given(st.lists(numbers, max_size=4), st.lists(numbers, min_size=1, max_size=3), discounts)
@settings(deadline=None, max_examples=40)
def test_a_round_written_out_once_more_changes_nothing(first: list[str], repeated: list[str], gamma: str) -> None:
    short = solved("return-infinite", first=first, repeated=repeated, gamma=gamma)
    long = solved("return-infinite", first=first + repeated, repeated=repeated * 2, gamma=gamma)
    assert short["b" if first else "a"] == long["b"]
    assert short["a"] == long["a"]


@given(st.lists(numbers, min_size=1, max_size=5), discounts)
@settings(deadline=None, max_examples=30)
def test_nothing_for_ever_after_is_a_return_that_ends(first: list[str], gamma: str) -> None:
    endless = solved("return-infinite", first=first, repeated=[0], gamma=gamma)["b"]
    assert endless == solved("return", rewards=first, gamma=gamma, time=0)["a"]


def test_rewards_without_an_end_need_a_discount() -> None:
    with pytest.raises(FileError, match=r"given.gamma: must be below 1"):
        solved("return-infinite", repeated=[1], gamma=1)


@given(st.integers(0, 10_000))
@settings(deadline=None, max_examples=20)
def test_the_expected_return_is_the_mean_of_the_values_of_the_starts(seed: int) -> None:
    solution = draw("expected-return", 2, seed)
    data = solution.problem.data()["given"]
    values = solved("policy-value", mdp=data["mdp"], policy=data["policy"], gamma=data["gamma"])["a"]
    chances = {state: Fraction(chance) for state, chance in data["start"].items()}
    mean = sum(fmpq(p.numerator, p.denominator) * values[state] for state, p in chances.items())
    assert mean == solution.answers["a"]


@pytest.mark.parametrize(
    ("changes", "fragment"),
    [
        ({"start": {"a": "1/2"}}, "start: the probabilities sum to 1/2, not to 1"),
        ({"start": {"end": 1}}, "the start probability is given for 'end'"),
        ({"policy": {"a": {"go": "1/2"}, "b": "go"}}, "the policy's probabilities in 'a'"),
        ({"mdp": {"transitions": [["a", "go", "a", 1, 1]]}}, "mdp: 'a' can come again"),
    ],
)
def test_what_is_no_tree_of_chances(changes: dict[str, Any], fragment: str) -> None:
    tree = {"transitions": [["a", "go", "b", "1/2", 1], ["a", "go", "end", "1/2", 2], ["b", "go", "end", 1, 3]]}
    given_ = {"start": {"a": 1}, "mdp": tree | {"terminal": ["end"]}, "gamma": "1/2"}
    assert solved("expected-return", **given_)["a"] == fmpq(9, 4)  # 1/2·(1 + 1/2·3) + 1/2·2
    with pytest.raises(FileError, match=fragment):
        solved("expected-return", **given_ | changes)


WEATHER = [["sun", "sun", "sun", 6], ["sun", "sun", "rain", 3], ["rain", "sun", "sun", 2], ["rain", "sun", "rain", 1]]


def test_a_process_is_markov_where_the_history_changes_nothing() -> None:
    answers = solved("markov-property", table=WEATHER, asked="sun")
    assert answers == {"a": {("sun", "sun"): fmpq(2, 3), ("rain", "sun"): fmpq(2, 3)}, "b": True}
    changed = [*WEATHER[:3], ["rain", "sun", "rain", 2]]
    assert solved("markov-property", table=changed, asked="sun")["b"] is False


def test_counts_and_their_shares_give_the_same_answers() -> None:
    shares = [[*row[:3], f"{row[3]}/12"] for row in WEATHER]
    assert solved("markov-property", table=shares, asked="sun") == solved("markov-property", table=WEATHER, asked="sun")


def test_one_next_state_alone_does_not_decide() -> None:
    # "fog" is 1/3 after both histories, but sun and rain change places.
    table = [["a", "b", "fog", 1], ["a", "b", "sun", 2], ["c", "b", "fog", 1], ["c", "b", "rain", 2]]
    exercise = rldrill.read({"family": "markov-property", "given": {"table": table, "asked": "fog"}})
    assert exercise.solve()["b"] is False
    assert "one-next-state" in [m.name for m, _ in exercise.solution.mistakes]
    assert any(isinstance(part.kind, YesNo) for part in exercise.parts)


@pytest.mark.parametrize(
    ("table", "fragment"),
    [
        ([["a", "b", "c", -1]], "is below 0"),
        ([["a", "b", "c", "1/3"]], "neither whole counts nor probabilities"),
        ([["a", "b", "c", 1], ["a", "b", "c", 2]], "a, b, c is given twice"),
        ([["a", "b", "c", 0], ["d", "b", "c", 2]], "the history a, b never occurs"),
        ([["a", "b", "d", 2]], "asked: 'c' is not a next state"),
    ],
)
def test_tables_that_do_not_fit(table: list[list[Any]], fragment: str) -> None:
    with pytest.raises(FileError, match=fragment):
        solved("markov-property", table=table, asked="c")


def test_a_product_over_a_finite_set() -> None:
    from rldrill.render.mathematics.latex import latex

    product = ProductOver(i + 1, i, Counting(1, 3))
    assert value_of(product, {}) == 2 * 3 * 4
    assert value_of(ProductOver(i, i, Counting(1, 0)), {}) == 1
    assert latex(typeset(product)).startswith(r"\prod_{i = 1}^{3}")
    assert put_in(product, {}).args == tuple(put_in(i + 1, {"i": number}) for number in (1, 2, 3))


def test_two_drawn_episodes_that_pay_the_same_do_so_at_a_discount_between_0_and_1() -> None:
    compared = [
        episodes
        for episodes in (rldrill.draw("return", 3, seed).problem.given for seed in range(80))
        if hasattr(episodes, "others") and isinstance(episodes.gamma, Parameter)
    ]
    assert len(compared) > 8
    for episodes in compared:
        (now, later), (other, after) = episodes.rewards, episodes.others
        assert 0 < Fraction(now - other, after - later) < 1


def test_a_return_that_repeats_is_said_to_hold_itself() -> None:
    working = " ".join(str(rldrill.draw("return-infinite", 2, 4).working("a")).split())
    assert "so R₄ = R₂, and this return is one round of rewards plus γⁿ times itself" in working


def test_a_return_that_begins_a_reward_too_early_keeps_the_last_reward() -> None:
    # R₁ = −1 + 7/2 + 4/4 − 4/8 = 3; from time 0 there is no reward before: 1/2·(−1) + 7/4 + 4/8 − 4/16 = 3/2.
    answers = mistaken("starts-at-r-t", "return", rewards=[-1, 7, 4, -4], gamma="1/2", time=1)
    assert answers == {"a": 3, "b": fmpq(3, 2)}


def test_whoever_discounts_the_first_reward_does_so_in_both_returns() -> None:
    # R₁ = 1/3·(−4)/(1 − 1/3) = −2 and R₀ = 1/3·7 + 1/3·(−2) = 5/3.
    answers = mistaken("first-reward-discounted", "return-infinite", first=[7], repeated=[-4], gamma="1/3")
    assert answers == {"a": -2, "b": fmpq(5, 3)}
