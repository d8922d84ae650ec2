"""Numbers of Bayesian methods from books, as literals; where a book rounds, the fraction is worked out here."""

from math import factorial
from typing import Any

import pytest
from flint import fmpq

from asking import solved


def test_the_pushed_door_of_probabilistic_robotics() -> None:
    # Thrun, Burgard & Fox 2005, section 2.4.2: doing nothing and sensing "open" gives 0.75; pushing then gives
    # 1·0.75 + 0.8·0.25 = 0.95, and sensing "open" again 0.6·0.95/(0.6·0.95 + 0.2·0.05) = 57/58 = 0.983.
    door: dict[str, Any] = {
        "belief": {"open": "1/2", "closed": "1/2"},
        "motion": {
            "do nothing": {"open": {"open": 1}, "closed": {"closed": 1}},
            "push": {"open": {"open": 1}, "closed": {"open": 0.8, "closed": 0.2}},
        },
        "likelihood": {"sense open": {"open": 0.6, "closed": 0.2}, "sense closed": {"open": 0.4, "closed": 0.8}},
    }
    run = [
        {"action": "do nothing", "measurement": "sense open"}, {"action": "push"}, {"measurement": "sense open"},
    ]  # fmt: skip
    beliefs = solved("bayes-filter", **door, run=run)
    assert beliefs["a"] == {"open": fmpq(3, 4), "closed": fmpq(1, 4)}
    assert beliefs["b"] == {"open": fmpq(19, 20), "closed": fmpq(1, 20)}
    assert beliefs["c"] == {"open": fmpq(57, 58), "closed": fmpq(1, 58)}
    run = [{"action": "push", "measurement": "sense open"}]
    assert solved("bayes-filter", **door | {"belief": beliefs_text(beliefs["a"])}, run=run)["a"] == beliefs["c"]


def beliefs_text(belief: dict[str, fmpq]) -> dict[str, str]:
    return {state: str(chance) for state, chance in belief.items()}


def test_the_umbrella_world_of_russell_and_norvig() -> None:
    # Russell & Norvig 2010, section 15.2.1: the umbrella on days 1 and 2 gives 0.818 and 0.883.
    # Day 1: 1/2·9/10 against 1/2·1/5 is 9 : 2, so 9/11 = 0.818. Day 2: 7/10·9/11 + 3/10·2/11 = 69/110 is
    # predicted (0.627), then 69/110·9/10 against 41/110·1/5 is 621 : 82, so 621/703 = 0.883.
    beliefs = solved(
        "bayes-filter",
        belief={"rain": "1/2", "dry": "1/2"},
        motion={"wait": {"rain": {"rain": 0.7, "dry": 0.3}, "dry": {"rain": 0.3, "dry": 0.7}}},
        likelihood={"umbrella": {"rain": 0.9, "dry": 0.2}},
        run=[{"action": "wait", "measurement": "umbrella"}, {"action": "wait"}, {"measurement": "umbrella"}],
    )
    assert [belief["rain"] for belief in beliefs.values()] == [fmpq(9, 11), fmpq(69, 110), fmpq(621, 703)]


def test_the_m_and_m_problem_of_think_bayes() -> None:
    # Downey 2013, section 1.6: a yellow one from one bag and a green one from the other; the 1994 bag has 20 %
    # yellow and 10 % green, the 1996 bag 14 % and 20 %. Hypothesis A: 20·20, B: 14·10, so A has 400/540 = 20/27.
    belief = solved(
        "bayes-rule",
        prior={"A": "1/2", "B": "1/2"},
        likelihood={"yellow and green": {"A": 0.04, "B": 0.014}},
        measurements=["yellow and green"],
    )["a"]
    assert belief == {"A": fmpq(20, 27), "B": fmpq(7, 27)}


def test_the_monty_hall_problem_of_think_bayes() -> None:
    # Downey 2013, section 1.7: you chose A, Monty opens B; likelihoods 1/2, 0, 1 give A 1/3 and C 2/3.
    belief = solved(
        "bayes-rule",
        prior={"A": "1/3", "B": "1/3", "C": "1/3"},
        likelihood={"opens B": {"A": "1/2", "B": 0, "C": 1}},
        measurements=["opens B"],
    )["a"]
    assert belief == {"A": fmpq(1, 3), "B": fmpq(0), "C": fmpq(2, 3)}


@pytest.mark.parametrize(
    ("heads", "tails", "ratio", "printed"),
    [
        # MacKay 2003, table 3.5: the evidence ratio of the bent coin (θ uniform) and one of θ = 1/6, for six tosses.
        # heads! tails!/7! against (1/6)^heads (5/6)^tails; for 5 and 1 that is 1/42 · 46656/5 = 7776/35.
        (5, 1, fmpq(7776, 35), 222.2), (3, 3, fmpq(46656, 17500), 2.67), (2, 4, fmpq(46656, 65625), 0.71),
        (1, 5, fmpq(46656, 131250), 0.356), (0, 6, fmpq(46656, 109375), 0.427),
    ],
)  # fmt: skip
def test_the_bent_coin_of_mackay(heads: int, tails: int, ratio: fmpq, printed: float) -> None:
    models = {"bent": {}, "known": {"theta": "1/6"}}
    prior = {"bent": "1/2", "known": "1/2"}
    odds = solved("model-comparison", models=models, prior=prior, heads=heads, tails=tails)["b"]
    assert odds == ratio
    assert float(odds.numerator) / float(odds.denominator) == pytest.approx(printed, rel=5e-3)


def test_the_euro_of_think_bayes_and_mackay() -> None:
    # 250 spins of a Belgian euro, 140 heads: MacKay 2003, exercise 3.15, and Downey 2013, section 11.1, give
    # 140! 110!/251! · 2^250 = 0.48 for the uniform prior against a fair coin.
    models = {"biased": {}, "fair": {"theta": "1/2"}}
    prior = {"biased": "1/2", "fair": "1/2"}
    odds = solved("model-comparison", models=models, prior=prior, heads=140, tails=110)["b"]
    assert odds == fmpq(factorial(140) * factorial(110) * 2**250, factorial(251))
    assert round(int(odds.numerator) / int(odds.denominator), 2) == 0.48


def test_the_first_of_anscombes_four_sets() -> None:
    # Anscombe 1973, table: n = 11, mean of x 9, sum of squares of x 110, slope 0.5, intercept 3.0. Exactly:
    # the products sum to 55.01 and y to 82.51, so the slope is 5501/11000 and the intercept 8251/1100 − 9·5501/11000.
    x = [10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5]
    y = ["8.04", "6.95", "7.58", "8.81", "8.33", "9.96", "7.24", "4.26", "10.84", "4.82", "5.68"]
    slope, intercept = solved("model-fitting", line={"points": list(zip(x, y, strict=True))})["a"]
    assert slope == fmpq(5501, 11000)
    assert intercept == fmpq(33001, 11000)  # 82510/11000 − 49509/11000


def test_the_variances_of_two_numbers() -> None:
    # By hand: 1 and 3 have the mean 2; their squared distances sum to 2, so 2/2 = 1 and 2/1 = 2.
    assert solved("model-fitting", sample={"values": [1, 3]}) == {"a": fmpq(2), "b": fmpq(1), "c": fmpq(2)}


def test_fusing_two_measurements_by_hand() -> None:
    # A belief of mean 10 and variance 8 that does not move, and a reading of 13 of variance 4: the weights are the
    # inverse variances 1/8 and 1/4, so (10 + 2·13)/3 = 12, with variance 8/3.
    step = {"u": 0, "z": 13}
    answers = solved("kalman-filter", mean=10, covariance=8, process=0, sensor=4, steps=[step])
    assert answers == {"a": (fmpq(10), fmpq(8)), "b": (fmpq(12), fmpq(8, 3))}


def test_the_random_walk_of_russell_and_norvig() -> None:
    # Russell & Norvig 2010, section 15.4.2 and figure 15.10: μ0 = 0, σ0 = 1.5, σx = 2, σz = 1, first reading 2.5.
    # Their equation 15.20 gives ((σ0² + σx²) z + σz² μ0)/(σ0² + σx² + σz²) = (25/4 · 5/2)/(29/4) = 125/58 and the
    # variance (25/4 · 1)/(29/4) = 25/29.
    step = {"u": 0, "z": "2.5"}
    answers = solved("kalman-filter", mean=0, covariance="2.25", process=4, sensor=1, steps=[step])
    assert answers["b"] == (fmpq(125, 58), fmpq(25, 29))
