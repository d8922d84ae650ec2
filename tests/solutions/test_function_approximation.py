"""Identities of the function approximation families, and what is wrong with givens that do not fit."""

import math
from typing import Any

import pytest
import sympy
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

import rldrill
from asking import solved
from numbers_drawn import small
from rldrill.problems.catalogue import family
from rldrill.problems.errors import FileError
from rldrill.render.unicode import unicode_text
from rldrill.solutions.solution import solver

whole = st.integers(-5, 5)
texts = small(-4, 4, 3).map(str)
discounts = st.sampled_from(["0", "1/2", "9/10", "1"])


@given(st.lists(whole, min_size=1, max_size=3), st.integers(1, 5))
@settings(deadline=None, max_examples=20)
def test_basis_functions_are_1_at_their_centre(position: list[int], width: int) -> None:
    assert solved("rbf", position=position, centres=[position], sigma=width)["a"] == (1,)
    assert solved("piecewise-linear-rbf", position=position, centres=[position], width=width)["a"] == (1,)


@given(whole, st.integers(1, 6))
@settings(deadline=None, max_examples=20)
def test_a_piecewise_linear_function_is_0_from_its_width_on_and_even(position: int, width: int) -> None:
    centres = [[position + far] for far in (width, -width, width + 1, 1, -1)]
    *outside, right, left = solved("piecewise-linear-rbf", position=[position], centres=centres, width=width)["a"]
    assert outside == [0, 0, 0]
    assert right == left == 1 - fmpq(1, width)


@given(texts, texts, texts, texts, discounts)
@settings(deadline=None, max_examples=20)
def test_semi_gradient_td_with_one_feature_for_every_state_is_td_zero(
    first: str, second: str, here: str, there: str, gamma: str
) -> None:
    run = {"states": ["a", "b", "a", "end"], "rewards": [first, second, "2"], "terminal": ["end"]}
    learnt = solved(
        "semi-gradient-td", trajectory=run, features={"a": [1, 0], "b": [0, 1]}, theta=[here, there],
        alpha="1/3", gamma=gamma,
    )["b"]  # fmt: skip
    table = solved("td-zero", trajectory=run, values={"a": here, "b": there}, alpha="1/3", gamma=gamma)["a"]
    assert learnt == tuple(table.values())


def test_of_every_step_only_its_own_two_states_are_valued() -> None:
    run = {"states": ["a", "b", "c"], "rewards": [1, 2]}
    features = {"a": [1, 0], "b": [0, 1], "c": [1, 1]}
    given_ = {"trajectory": run, "features": features, "theta": [2, 3], "alpha": "1/2", "gamma": 1}
    exercise = rldrill.read({"family": "semi-gradient-td", "given": given_})
    written = "\n".join(unicode_text(block) for block in exercise.working())
    assert [written.count(f"V\u0302({state}) =") for state in "abc"] == [1, 2, 1]


@given(st.lists(texts, min_size=4, max_size=4), texts, discounts)
@settings(deadline=None, max_examples=20)
def test_semi_gradient_sarsa_with_one_feature_for_every_state_is_sarsa(
    theta: list[str], reward: str, gamma: str
) -> None:
    run = {"states": ["a", "b", "a"], "actions": ["x", "y", "x"], "rewards": [reward, "1"]}
    learnt = solved(
        "semi-gradient-td", trajectory=run, features={"a": [1, 0], "b": [0, 1]}, theta=theta, actions=["x", "y"],
        alpha="1/2", gamma=gamma,
    )["b"]  # fmt: skip
    values = {"a": {"x": theta[0], "y": theta[2]}, "b": {"x": theta[1], "y": theta[3]}}
    table = solved("sarsa", trajectory=run, values=values, alpha="1/2", gamma=gamma)["a"]
    assert (learnt[0], learnt[3]) == (table["a", "x"], table["b", "y"])
    assert [str(learnt[1]), str(learnt[2])] == theta[1:3]


@given(st.lists(texts, min_size=6, max_size=6), st.integers(0, 1))
@settings(deadline=None, max_examples=20)
def test_one_feature_picks_one_weight_from_every_block(theta: list[str], place: int) -> None:
    features = [int(index == place) for index in range(2)]
    answers = solved("linear-value", theta=theta, actions=["x", "y", "z"], features=features, action="y")
    assert [str(value) for value in answers["b"].values()] == theta[place::2]
    assert answers["a"] == (0, 0, *features, 0, 0)


TD = {
    "trajectory": {"states": ["a", "b"], "rewards": [1]}, "features": {"a": [1, 0], "b": [0, 1]}, "theta": [1, 2],
    "alpha": 1, "gamma": 1,
}  # fmt: skip
VALUE = {"theta": [1, 2, 3, 4], "actions": ["x", "y"], "features": [1, 2], "action": "x"}


@pytest.mark.parametrize(
    ("name", "given_", "fragment"),
    [
        ("rbf", {"position": [1], "centres": [[1, 2]], "sigma": 1}, "number 1 has 2 coordinates, but position has 1"),
        ("rbf", {"position": [1], "centres": [[1]], "sigma": 0}, "the width must be above 0"),
        ("rbf", {"position": [], "centres": [[]], "sigma": 1}, "given.position"),
        ("piecewise-linear-rbf", {"position": [1], "centres": [[1]], "width": -1}, "it must be above 0, not -1"),
        ("linear-value", VALUE | {"theta": [1, 2, 3]}, "here 2·2 = 4, not 3"),
        ("linear-value", VALUE | {"action": "z"}, "'z' is not among the actions"),
        ("linear-value", VALUE | {"actions": ["x", "x"]}, "one is named twice"),
        ("linear-value", VALUE | {"features": None}, "give either features or bumps"),
        ("semi-gradient-td", TD | {"features": {"a": [1, 0]}}, "the row of features of 'b' is missing"),
        ("semi-gradient-td", TD | {"theta": [1, 2, 3]}, "'a' has 2 features, but theta 3"),
        ("semi-gradient-td", TD | {"actions": ["x", "y"], "theta": [1, 2, 3]}, "cannot be shared among 2 actions"),
        ("semi-gradient-td", TD | {"actions": ["x", "y"], "theta": [1, 2, 3, 4]}, "Sarsa needs the action taken"),
    ],
)
def test_wrong_givens(name: str, given_: Any, fragment: str) -> None:
    with pytest.raises(FileError) as error:
        family(name).read(given_)
    assert fragment in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("sigma", ["sqrt(3/2)", "√1.5", "sqrt(6)/2", "3/sqrt(6)"])
def test_a_width_may_be_a_square_root(sigma: str) -> None:
    # σ² = 3/2: exp(-1²/3) and exp(-2²/3).
    exercise = rldrill.read({"family": "rbf", "given": {"position": [1], "centres": [[0], [3]], "sigma": sigma}})
    assert exercise.answers()["a"] == ("exp(-1/3)", "exp(-4/3)")
    (densities,) = solver(exercise.problem.family).oracle(exercise.problem.given)
    assert densities == pytest.approx([math.exp(-1 / 3), math.exp(-4 / 3)])
    assert family("rbf").read(exercise.problem.data()["given"]) == exercise.problem.given


@pytest.mark.parametrize("sigma", ["sqrt(-1)", "sqrt(2) + 1", "sqrt(0)", "sqrt(x)", "1/sqrt(0)"])
def test_what_is_no_width(sigma: str) -> None:
    with pytest.raises(FileError, match=r"^given\.sigma: [^\n]*\.$"):
        family("rbf").read({"position": [1], "centres": [[0], [3]], "sigma": sigma})


def test_the_state_and_the_width_follow_from_features() -> None:
    # Tents of width 4 at 0, 4 and 7: 3/4 puts the state at ±1, 1/4 at 1 or 7, so it is 1, and 7 is too far away.
    centres = [[0], [4], [7]]
    found = solved("piecewise-linear-rbf", centres=centres, width=4, known={1: "3/4", 2: "1/4"})
    assert found == {"a": 1, "b": (0,)}
    # A state 3 away from the centre with the feature 2/5: 1 − 3/b = 2/5 for b = 5; 5 away from the other one it is 0.
    found = solved("piecewise-linear-rbf", position=[3, 4], centres=[[3, 1], [0, 0]], known={1: "2/5"})
    assert found == {"a": 5, "b": (0,)}
    # Gaussians with σ = 2: exp(−1/8) is at the distance 1, exp(−9/8) at 3, exp(−1/2) at 2.
    found = solved("rbf", centres=[[0], [4], [3]], sigma=2, logarithms={1: "-1/8", 2: "-9/8"})
    assert found == {"a": 1, "b": (sympy.exp(sympy.Rational(-1, 2)),)}
    assert solved("rbf", position=[3], centres=[[0], [9]], logarithms={1: "-1/2"})["a"] == 3


def test_a_value_of_features_is_their_weighted_sum() -> None:
    # Tents at the distances 1 and 3 of width 4: 3/4 and 1/4, and 4·3/4 − 2·1/4 = 5/2.
    found = solved("piecewise-linear-rbf", position=[1], centres=[[0], [4]], width=4, theta=[4, -2])
    assert found == {"a": (fmpq(3, 4), fmpq(1, 4)), "b": fmpq(5, 2)}


def test_where_two_actions_are_worth_the_same() -> None:
    # Tents of width 2 at 0 and 2: x is worth 3 − 3/2·s, y is worth s/2; equal at s = 3/2, where both are 3/4.
    bumps = {"centres": [[0], [2]], "width": 2}
    found = solved("linear-value", theta=[3, 0, 0, 1], actions=["x", "y"], bumps=bumps)
    assert found == {"a": fmpq(3, 2), "b": fmpq(3, 4), "c": {"s": ("x",)}}
    # With φ = (2, 1): x is worth 4, z is worth 5, and y is worth 2w − 1, which exceeds 5 above w = 3.
    found = solved("linear-value", theta=[1, 2, "w", -1, 2, 1], actions=["x", "y", "z"], features=[2, 1])
    assert found == {"a": {("s", "x"): 4, ("s", "z"): 5}, "b": 3}


@pytest.mark.parametrize(
    ("name", "given_", "fragment"),
    [
        ("rbf", {"centres": [[0], [1]]}, "both cannot be found"),
        ("rbf", {"centres": [[0], [1]], "sigma": 1, "logarithms": {"1": -1}}, "2 of the features must be known, not 1"),
        ("rbf", {"centres": [[0], [1]], "sigma": 1, "logarithms": {"1": -1, "3": -1}}, "no centre number 3"),
        ("rbf", {"position": [0], "centres": [[1]], "logarithms": {"1": 1}}, "lies between 0 and 1"),
        (
            "piecewise-linear-rbf",
            {"centres": [[0, 0], [1, 1]], "width": 1, "known": {"1": "1/2", "2": "1/2"}},
            "a line",
        ),
        ("piecewise-linear-rbf", {"position": [0], "centres": [[1]], "width": 2, "theta": [1, 2]}, "as many weights"),
        ("linear-value", VALUE | {"theta": [1, "w", 3, "w"], "action": None}, "only one weight may be left open"),
        ("linear-value", VALUE | {"theta": [1, "w", 3, 4]}, "only asked for where nothing is to be found"),
    ],
)
def test_wrong_givens_of_what_is_sought(name: str, given_: Any, fragment: str) -> None:
    with pytest.raises(FileError) as error:
        family(name).read(given_)
    assert fragment in str(error.value)


def test_features_that_fit_no_state_have_no_solution() -> None:
    # 2 away from 0 and 4 away from 4.
    with pytest.raises(FileError, match="exactly one state"):
        solved("piecewise-linear-rbf", centres=[[0], [4]], width=8, known={1: "3/4", 2: "1/2"})


def test_features_of_states_and_actions_have_one_letter_everywhere() -> None:
    """f of a state and an action, as on the sheet; φ of a state."""
    for name in ("linear-policy", "linear-value", "semi-gradient-td", "softmax-policy"):
        for seed in range(6):
            for level in (1, 2, 3):
                exercise = rldrill.draw(name, level, seed)
                assert "φ(s, a)" not in f"{exercise.question()} {exercise.working()}", exercise.id


@pytest.mark.parametrize("name", ["rbf", "piecewise-linear-rbf"])
def test_finding_the_state_earns_more_than_putting_it_in(name: str) -> None:
    for seed in range(20):
        exercise = rldrill.draw(name, 3, seed)
        if exercise.solution.problem.given.position is None:  # type: ignore[attr-defined]
            found, *put_in = [part.points for part in exercise.parts]
            assert found >= max(put_in, default=0)
