"""Function approximation: numbers from books, as literals."""

from typing import Any

import pytest
import sympy
from flint import fmpq

from asking import rounded, solved


def test_the_gaussian_at_one_two_and_three_sigma() -> None:
    # exp(−1/2), exp(−2) and exp(−9/2): 0.6065, 0.1353 and 0.0111 in every table of the normal density.
    features = solved("rbf", position=[0], centres=[[2], [-4], [6]], sigma=2)["a"]
    assert features == (sympy.exp(sympy.Rational(-1, 2)), sympy.exp(-2), sympy.exp(sympy.Rational(-9, 2)))
    assert [round(float(value), 4) for value in features] == [0.6065, 0.1353, 0.0111]


@pytest.mark.parametrize(
    ("position", "centre", "sigma", "printed"),
    [
        # Stanford's Machine Learning (Coursera), exercise 6, section 1.2.1: gaussianKernel of (1, 2, 1) and (0, 4, −1)
        # with σ = 2 "should be about 0.324652".
        ([1, 2, 1], [0, 4, -1], 2, "0.324652"),
        # MATLAB, the manual of newrbe: exp(−n²) is 0.5 at n = 0.8326. With σ = 1 that is twice n² = d²/2.
        (["0.8326", "0.8326"], [0, 0], 1, "0.5000"),
        # scikit-learn, rbf_kernel, example: γ = 1/3 and the squared distances 1 and 2 give 0.71… and 0.51…; 6/(2·3²)
        # and 12/(2·3²) are the same exponents.
        ([0, 0, 0], [2, 1, 1], 3, "0.71"),
        ([0, 0, 0], [2, 2, 2], 3, "0.51"),
    ],
)
def test_gaussians_of_manuals_and_courses(position: Any, centre: Any, sigma: int, printed: str) -> None:
    value = solved("rbf", position=position, centres=[centre], sigma=sigma)["a"][0]
    assert rounded(value, 9).startswith(printed) or rounded(value, len(printed) - 2) == printed


def test_approximate_q_learning_in_berkeleys_pacman() -> None:
    # CS 188, the lecture on approximate Q-learning: Q = 4.0 f_DOT − 1.0 f_GST with f_DOT = 0.5 and f_GST = 1 is 1; the
    # reward −500 ends the game, so the difference is −501, and the weights become 3.0 and −3.0 (which takes α = 0.004).
    value = solved("linear-value", theta=[4, -1, 0, 0], actions=["north", "stop"], features=["1/2", 1], action="north")
    assert value["b"]["s", "north"] == 1
    run = {"states": ["dot and ghost", "over"], "rewards": [-500], "terminal": ["over"]}
    features = {"dot and ghost": ["1/2", 1]}
    answers = solved("semi-gradient-td", trajectory=run, features=features, theta=[4, -1], alpha="0.004", gamma=1)
    assert answers["a"] == (-501,)
    assert [rounded(weight, 1) for weight in answers["b"]] == ["3.0", "-3.0"]


def test_w_and_2w() -> None:
    # Sutton & Barto 2018, section 11.2: two states of value w and 2w; from w = 10, with reward 0, α = 0.1 and γ
    # nearly 1, "w will be increased to nearly 11", then "to ≈12.1".
    first = {"states": ["one", "two"], "rewards": [0]}
    features = {"one": [1], "two": [2]}
    once = solved("semi-gradient-td", trajectory=first, features=features, theta=[10], alpha=0.1, gamma=1)
    assert once == {"a": (10,), "b": (11,)}
    again = solved("semi-gradient-td", trajectory=first, features=features, theta=[11], alpha=0.1, gamma=1)["b"]
    assert again == (fmpq(121, 10),)


def test_bairds_counterexample() -> None:
    # Sutton & Barto 2018, section 11.2 (figure 11.1): the upper states are worth 2wᵢ + w₈, the lower one w₇ + 2w₈;
    # w = (1, 1, 1, 1, 1, 1, 10, 1), γ = 0.99, α = 0.01, reward 0. From the first state down: 3 and 12, so
    # δ = 0.99·12 − 3 = 8.88, and w₁ = 1 + 0.01·8.88·2 = 1.1776, w₈ = 1 + 0.01·8.88 = 1.0888.
    features = {"upper": [2, 0, 0, 0, 0, 0, 0, 1], "lower": [0, 0, 0, 0, 0, 0, 1, 2]}
    run = {"states": ["upper", "lower"], "rewards": [0]}
    weights = [1, 1, 1, 1, 1, 1, 10, 1]
    answers = solved("semi-gradient-td", trajectory=run, features=features, theta=weights, alpha=0.01, gamma=0.99)
    assert answers["a"] == (fmpq(888, 100),)
    assert answers["b"] == (fmpq(11776, 10000), 1, 1, 1, 1, 1, 10, fmpq(10888, 10000))


def test_the_triangle_by_hand() -> None:
    # 1 at the centre, a half at half the width, 0 from the width on; (3, 4) is at the distance 5.
    values = solved("piecewise-linear-rbf", position=[0, 0], centres=[[0, 0], [3, 4], [6, 8], [30, 40]], width=10)["a"]
    assert values == (1, fmpq(1, 2), 0, 0)
