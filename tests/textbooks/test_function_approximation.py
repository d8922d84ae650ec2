"""Function approximation: numbers from books, as literals."""

import sympy
from flint import fmpq

from asking import solved


def test_the_gaussian_at_one_two_and_three_sigma() -> None:
    # exp(−1/2), exp(−2) and exp(−9/2): 0.6065, 0.1353 and 0.0111 in every table of the normal density.
    features = solved("rbf", position=[0], centres=[[2], [-4], [6]], sigma=2)["a"]
    assert features == (sympy.exp(sympy.Rational(-1, 2)), sympy.exp(-2), sympy.exp(sympy.Rational(-9, 2)))
    assert [round(float(value), 4) for value in features] == [0.6065, 0.1353, 0.0111]


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
    # Sutton & Barto 2018, example 11.1 (figure 11.1): the upper states are worth 2wᵢ + w₈, the lower one w₇ + 2w₈;
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
