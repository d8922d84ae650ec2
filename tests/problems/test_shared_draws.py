"""What the draws that many families share promise, of some hundred draws each, worked out here by themselves."""

from collections.abc import Iterator
from itertools import product
from typing import Literal

import pytest

from rldrill.problems import asking_back, runs
from rldrill.problems.draws import Draws
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Model, Transition
from rldrill.problems.settings import Shape, draw_model, draw_setting
from rldrill.problems.valued import UNITS, averaging, draw_mixed, draw_valued, tells_apart

HALF, TWO_THIRDS = Fraction(1, 2), Fraction(2, 3)
RATES = [*UNITS, Fraction(3, 4), Fraction(1, 4)]


def streams(number: int = 150) -> Iterator[Draws]:
    return (Draws(f"shared {key}") for key in range(number))


def whole(number: Fraction) -> bool:
    return Fraction(number).denominator == 1


def test_values_of_states_stay_whole_when_they_are_discounted_and_are_not_0() -> None:
    for rng, gamma in product(streams(40), RATES):
        found = runs.draw_values(rng, "abc", gamma)
        assert list(found) == [*"abc"]
        for value in found.values():
            assert value != 0
            assert whole(gamma * value)
            assert -4 <= value <= max(12, 3 * gamma.denominator)  # three states are to differ


def test_a_reward_moves_a_value_and_to_a_multiple_of_the_unit() -> None:
    for rng in streams():
        old, later, alpha = Fraction(rng.whole(-4, 9)), Fraction(rng.whole(-4, 9)), rng.fraction("1/2", "1/4")
        for unit in (None, 1):
            reward = runs.draw_reward(rng, old, later, alpha, unit)
            assert -6 <= reward <= 9
            assert reward + later - old != 0
            assert unit is None or whole(old + alpha * (reward + later - old))


def test_returns_are_whole_and_not_0() -> None:
    for rng, gamma in product(streams(40), (HALF, TWO_THIRDS, Fraction(3, 4), Fraction(4, 5))):
        rewards = runs.draw_rewards(rng, 4, gamma)
        assert all(-5 <= reward <= 9 for reward in rewards)
        total = Fraction(0)
        for time, reward in reversed([*enumerate(rewards)]):
            total = reward + gamma * total
            assert total != 0
            assert whole(total)
            assert time == 0 or whole(gamma * total)


@pytest.mark.parametrize("states", [("cool", "warm", "cool", "overheated"), ("cool", "warm", "warm", "cool")])
def test_the_longest_returns_of_a_run_are_whole_and_no_states_value(states: tuple[str, ...]) -> None:
    for rng, gamma in product(streams(40), (HALF, TWO_THIRDS, Fraction(3, 4))):
        run, values = runs.draw_whole(rng, states, "overheated", gamma)
        assert run.terminal == (("overheated",) if "overheated" in states else ())
        assert set(values) == {"cool", "warm"}
        V = values | {"overheated": Fraction(0)}
        longest = V[states[-1]]
        for time in reversed(range(3)):
            longest = run.rewards[time] + gamma * longest
            assert whole(longest)
            assert V[states[time]] not in (longest, run.rewards[time] + gamma * V[states[time + 1]])


@pytest.mark.parametrize(
    ("number", "easy"),
    [("250", True), ("-250", True), ("251", False), ("-251", False), ("1/80", True), ("1/81", False), ("250/79", True)],
)
def test_a_number_is_readable_up_to_so_much_above_and_below_the_line(number: str, easy: bool) -> None:
    assert runs.readable([Fraction(1), Fraction(number)]) is easy
    assert runs.readable([])


def test_rows_of_action_values_are_different_multiples_of_a_unit_and_not_0() -> None:
    for rng, unit in product(streams(40), (2, 4, 5)):
        for row in asking_back.draw_rows(rng, ("s", "t"), ("x", "y", "z"), unit).values():
            assert list(row) == ["x", "y", "z"]
            assert len({*row.values()}) == 3
            assert 0 not in row.values()
            assert all(value % unit == 0 and -unit <= value <= max(3 * unit, 10) for value in row.values())


def test_rates_differ_and_their_products_with_values_are_readable() -> None:
    for rng in streams(60):
        alpha, gamma, unit = asking_back.draw_rates(rng)
        assert alpha != gamma
        assert whole(alpha * gamma * unit * 2)
        assert whole(gamma * unit)


def gone_through(
    model: Model, policy: dict[str, dict[str, Fraction]], values: dict[str, Fraction], gamma: Fraction
) -> None:
    """Assert that one step of the policy gives the values back, and that the rewards are whole and small."""
    for state, chances in policy.items():
        assert values[state] == sum(
            chances.get(row.action, 0) * row.probability * (row.reward + gamma * values.get(row.next, 0))
            for row in model.transitions
            if row.state == state
        )
    assert all(whole(row.reward) for row in model.transitions)
    for pair, rows in model.outcomes.items():
        assert sum(row.probability for row in rows) == 1
        assert len({row.reward + gamma * values.get(row.next, 0) for row in rows}) == len(rows), pair


@pytest.mark.parametrize("forked", ["all", "own", "others"])
@pytest.mark.parametrize("others", [(-4, -1), (-4, 4)])
def test_a_policy_has_the_values_that_were_drawn(
    forked: Literal["all", "own", "others"], others: tuple[int, int]
) -> None:
    for rng, gamma in product(streams(15), (HALF, TWO_THIRDS)):
        shape = Shape(states=2, actions=3, branches=2, denominators=(2,))
        model, policy, values, worths = draw_valued(rng, draw_setting(rng), shape, gamma, others, forked=forked)
        gone_through(model, {state: {action: Fraction(1)} for state, action in policy.items()}, values, gamma)
        assert len({*values.values()}) == 2
        assert all(value and whole(gamma * value) for value in values.values())
        for (state, action), rows in model.outcomes.items():
            worth = sum(row.probability * (row.reward + gamma * values.get(row.next, 0)) for row in rows)
            assert worth == worths[state, action]
            surplus = worth - values[state]
            own = action == policy[state]
            assert surplus == 0 if own else surplus and others[0] <= surplus <= others[1]
            assert len(rows) == 1 or forked in ("all", "own" if own else "others")
        for state in model.states:
            assert tells_apart([row for row in model.transitions if row.state == state], values, gamma)


def test_a_policy_that_mixes_has_the_values_that_were_drawn() -> None:
    for rng, gamma in product(streams(30), (HALF, TWO_THIRDS)):
        shape = Shape(states=2, actions=2, branches=2, denominators=(2,))
        model, policy, values = draw_mixed(rng, draw_setting(rng), shape, gamma)
        gone_through(model, policy, values, gamma)  # type: ignore[arg-type]
        assert all(chance > 0 for row in policy.values() for chance in row.values())
        for state in model.states:
            assert tells_apart([row for row in model.transitions if row.state == state], values, gamma)


def test_numbers_with_a_mean_are_different() -> None:
    for rng in streams():
        shares = rng.choice(((1, 1), (1, 3), (2, 1, 1)))
        found = averaging(rng, shares, 5 * sum(shares))
        if found is not None:
            assert sum(share * number for share, number in zip(shares, found, strict=True)) == 5 * sum(shares)
            assert len({*found}) == len(shares)


def test_actions_of_the_same_worth_are_not_told_apart() -> None:
    one = Fraction(1)
    rows = [Transition("a", "x", "b", one, 3 * one), Transition("a", "y", "end", one, 4 * one)]
    assert not tells_apart(rows, {"b": Fraction(2)}, HALF)  # 3 + 1/2·2 and 4
    assert tells_apart(rows, {"b": Fraction(4)}, HALF)
    forked = [Transition("a", "x", after, HALF, reward) for after, reward in (("b", 3 * one), ("end", 4 * one))]
    assert not tells_apart(forked, {"b": Fraction(2)}, HALF)
    assert tells_apart(forked, {"b": Fraction(4)}, HALF)


def test_a_random_model_goes_on_to_its_end_from_everywhere() -> None:
    for rng in streams(60):
        model = draw_model(rng, draw_setting(rng), Shape(states=3, actions=2, branches=2))
        assert len(model.states) == 3
        assert model.terminal
        for rows in model.outcomes.values():
            assert 1 <= len(rows) <= 2
            assert sum(row.probability for row in rows) == 1
            assert all(row.probability.denominator in (1, 2, 4) for row in rows)
            assert all(-3 <= row.reward <= 6 for row in rows)
        ending = {*model.terminal}
        for state in reversed(model.states):  # the first actions lead on, so that the end is reached
            assert any(row.next in ending for row in model.transitions if row.state == state), state
            ending.add(state)
