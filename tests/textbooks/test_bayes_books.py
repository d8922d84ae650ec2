"""Numbers of Bayesian methods from books, as literals; where a book rounds, the fraction is worked out here."""

from fractions import Fraction
from math import factorial
from typing import Any

import numpy as np
import pytest
import sympy
from flint import fmpq

from asking import rounded, solved
from rldrill.problems.errors import FileError


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
    ("heads", "tails", "printed"),
    [
        # MacKay 2003, table 3.5: the evidence ratio of the bent coin (θ uniform) and one of θ = 1/6. For 5 and 1 it is
        # 5! 1!/7! against (1/6)⁵ · 5/6, so 1/42 · 46656/5 = 7776/35 = 222.2. For 1 and 5 it is 0.35547, printed 0.356.
        (5, 1, "222.2"), (3, 3, "2.67"), (2, 4, "0.71"), (1, 5, "0.356"), (0, 6, "0.427"),
        (10, 10, "96.5"), (3, 17, "0.2"), (0, 20, "1.83"),
    ],
)  # fmt: skip
def test_the_bent_coin_of_mackay(heads: int, tails: int, printed: str) -> None:
    models = {"bent": {}, "known": {"theta": "1/6"}}
    prior = {"bent": "1/2", "known": "1/2"}
    odds = solved("model-comparison", models=models, prior=prior, heads=heads, tails=tails)["b"]
    decimals = len(printed.partition(".")[2])
    assert float(rounded(odds, 9)) == pytest.approx(float(printed), abs=0.53 * 10**-decimals)
    if (heads, tails) == (5, 1):
        assert odds == fmpq(7776, 35)


@pytest.mark.parametrize(
    ("model", "printed"),
    [
        # 250 spins of a Belgian euro, 140 heads, against a fair coin. MacKay 2003, exercise 3.15, tries Beta(α, α):
        # 0.48 for α = 1, which is 140! 110!/251! · 2²⁵⁰; 1.8 for α = 20 and 1.9 for α = 55.
        ({"a": 1, "b": 1}, "0.48"), ({"a": 20, "b": 20}, "1.8"), ({"a": 55, "b": 55}, "1.9"),
        # Downey 2013, section 11.1: the θ that is chosen after the data is 6.1 times as likely.
        ({"theta": "140/250"}, "6.1"),
    ],
)  # fmt: skip
def test_the_euro_of_mackay_and_think_bayes(model: dict[str, Any], printed: str) -> None:
    models, prior = {"biased": model, "fair": {"theta": "1/2"}}, {"biased": "1/2", "fair": "1/2"}
    odds = solved("model-comparison", models=models, prior=prior, heads=140, tails=110)["b"]
    assert rounded(odds, len(printed) - 2) == printed
    if model == {"a": 1, "b": 1}:
        assert odds == fmpq(factorial(140) * factorial(110) * 2**250, factorial(251))


def test_the_log_likelihoods_of_the_euro() -> None:
    # Downey 2013, section 11.1: the most likely θ = 0.56 makes the data 6.1 times as likely as a fair coin does.
    fits = solved("bic", data={"tosses": {"euro": [140, 110]}, "models": ["own", "fair"]})["a"]
    assert rounded(sympy.exp(fits["own"] - fits["fair"]), 1) == "6.1"


@pytest.mark.parametrize(
    ("values", "mean", "variance", "unbiased"),
    [
        # The documentation of Python's module statistics: the examples of variance, pvariance, mean and fractions.
        (["2.75", "1.75", "1.25", "0.25", "0.5", "1.25", "3.5"], None, None, "1.3720238095238095"),
        (["27.5", "30.25", "30.25", "34.5", "41.75"], None, None, "31.01875"),
        (["0", "0.25", "0.25", "1.25", "1.5", "1.75", "2.75", "3.25"], None, "1.25", None),
        (["27.5", "30.25", "30.25", "34.5", "41.75"], None, "24.815", None),
        ([1, 2, 3, 4, 4], "2.8", None, None),
        (["1/6", "1/2", "5/3"], None, None, "67/108"),
        (["1/4", "5/4", "1/2"], None, "13/72", None),
    ],
)
def test_the_variances_of_pythons_statistics(values: Any, mean: Any, variance: Any, unbiased: Any) -> None:
    answers = solved("model-fitting", sample={"values": values})
    for label, printed in zip("abc", (mean, variance, unbiased), strict=True):
        if printed is not None:
            assert float(rounded(answers[label], 15)) == pytest.approx(float(Fraction(printed)), abs=1e-14)


def test_the_midges_of_hoff() -> None:
    # Hoff 2009, section 5.2: nine wing lengths have the mean 1.804 and the variance 0.017; with that variance taken as
    # known and the prior N(1.9, 0.95²), the posterior mean is 1.805.
    lengths = ["1.64", "1.70", "1.72", "1.74", "1.82", "1.82", "1.82", "1.90", "2.08"]
    answers = solved(
        "model-fitting", sample={"values": lengths, "prior": {"mean": "1.9", "variance": "0.9025", "noise": "0.017"}}
    )
    assert [rounded(answers[label], 3) for label in "acd"] == ["1.804", "0.017", "1.805"]


def test_the_line_of_numpys_manual() -> None:
    # numpy.linalg.lstsq, example: x = 0, 1, 2, 3 and y = −1, 0.2, 0.9, 2.1 give the line 1.0 x − 0.95.
    points = [[0, -1], [1, "0.2"], [2, "0.9"], [3, "2.1"]]
    assert solved("model-fitting", line={"points": points})["a"] == (1, fmpq(-95, 100))


def test_the_line_of_pythons_statistics() -> None:
    # statistics.linear_regression, example: Monty Python's films over the years; by 2019 there would have been 16.
    years = [1971, 1975, 1979, 1982, 1983]
    slope, intercept = solved("model-fitting", line={"points": list(zip(years, range(1, 6), strict=True))})["a"]
    assert rounded(slope * 2019 + intercept, 0) == "16"


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


@pytest.mark.parametrize(
    ("prior", "hit", "false_alarm", "printed"),
    [
        # Gigerenzer & Hoffrage 1995, the mammography problem: 0.078.
        ("0.01", "0.8", "0.096", "0.078"),
        # Gigerenzer 2002, Calculated Risks, mammography again: 7 of 77, about 9 %.
        ("0.008", "0.9", "0.07", "0.09"),
        # Tversky & Kahneman 1982, the cab problem: 0.41.
        ("0.15", "0.8", "0.2", "0.41"),
        # MacKay 2003, example 2.3, Jo's test for a nasty disease: 0.16.
        ("0.01", "0.95", "0.05", "0.16"),
        # Murphy 2012, section 2.2.3.1, medical diagnosis: 0.031.
        ("0.004", "0.8", "0.1", "0.031"),
        # Murphy 2022, section 2.3.1, testing for COVID-19: 0.795.
        ("0.1", "0.875", "0.025", "0.795"),
        # Bishop & Bishop 2024, section 2.1, medical screening: 90/387, about 0.23.
        ("0.01", "0.9", "0.03", "0.23"),
        # Bishop 2006, section 1.2, eq. 1.23: an orange comes from the red box with 2/3.
        ("4/10", "3/4", "1/4", "0.667"),
        # Russell & Norvig 2010, section 13.3: P(cavity | toothache) = 0.6, of 0.108 + 0.012 and 0.016 + 0.064.
        ("0.2", "0.6", "0.1", "0.6"),
        # Russell & Norvig 2010, section 13.6, the wumpus world: α ⟨0.2 · 0.36, 0.8 · 0.20⟩ ≈ ⟨0.31, 0.69⟩.
        ("0.2", "0.36", "0.2", "0.31"),
        # Russell & Norvig 2010, section 14.4.1: both neighbours call, P(burglary) = 0.284. Of the tables in figure
        # 14.2, they do with 0.9 · 0.7 when there is an alarm and 0.05 · 0.01 when not; the alarm's chance with a
        # burglary is 0.002 · 0.95 + 0.998 · 0.94 = 0.94002, without 0.002 · 0.29 + 0.998 · 0.001 = 0.001578.
        ("0.001", "0.59224259", "0.001493351", "0.284"),
    ],
)  # fmt: skip
def test_one_positive_test(prior: str, hit: str, false_alarm: str, printed: str) -> None:
    belief = solved(
        "bayes-rule",
        prior={"true": prior, "false": str(1 - Fraction(prior))},
        likelihood={"positive": {"true": hit, "false": false_alarm}},
        measurements=["positive"],
    )["a"]
    assert rounded(belief["true"], len(printed) - 2) == printed


def test_two_positive_tests_of_dive_into_deep_learning() -> None:
    # Zhang, Lipton, Li & Smola, Dive into Deep Learning, section 2.6: a test for HIV, 0.1306; a second one, 0.8307.
    belief: dict[str, Any] = {"HIV": "0.0015", "healthy": "0.9985"}
    for hit, false_alarm, printed in ((1, "0.01", "0.1306"), ("0.98", "0.03", "0.8307")):
        likelihood = {"positive": {"HIV": hit, "healthy": false_alarm}}
        belief = solved("bayes-rule", prior=belief, likelihood=likelihood, measurements=["positive"])["a"]
        assert rounded(belief["HIV"], 4) == printed
        belief = beliefs_text(belief)


def test_the_dice_of_think_bayes() -> None:
    # Downey 2013, section 3.1: dice of 4, 6, 8, 12 and 20 sides; the posterior after a 6, and after 6, 8, 7, 7, 5, 4
    # more.
    sides = {str(n): n for n in (4, 6, 8, 12, 20)}
    rolls = [6, 6, 8, 7, 7, 5, 4]
    beliefs = solved(
        "bayes-rule",
        prior=dict.fromkeys(sides, "1/5"),
        likelihood={f"rolls {k}": {s: f"1/{n}" if k <= n else 0 for s, n in sides.items()} for k in set(rolls)},
        measurements=[f"rolls {k}" for k in rolls],
    )
    first, *_, last = ([rounded(chance, 8) for chance in belief.values()] for belief in beliefs.values())
    assert first == ["0.00000000", "0.39215686", "0.29411765", "0.19607843", "0.11764706"]
    assert last == ["0.00000000", "0.00000000", "0.94324845", "0.05520613", "0.00154542"]


def test_the_dice_of_the_second_think_bayes() -> None:
    # Downey 2021, chapter 2: dice of 6, 8 and 12 sides give 4/9, 1/3 and 2/9 after a 1; a 7 leaves 0.692 and 0.308.
    sides = {"6": {"1": "1/6", "7": 0}, "8": {"1": "1/8", "7": "1/8"}, "12": {"1": "1/12", "7": "1/12"}}
    beliefs = solved(
        "bayes-rule",
        prior=dict.fromkeys(sides, "1/3"),
        likelihood={k: {die: chances[k] for die, chances in sides.items()} for k in "17"},
        measurements=["1", "7"],
    )
    assert beliefs["a"] == {"6": fmpq(4, 9), "8": fmpq(1, 3), "12": fmpq(2, 9)}
    assert [rounded(chance, 3) for chance in beliefs["b"].values()] == ["0.000", "0.692", "0.308"]


def test_the_urns_of_mackay() -> None:
    # MacKay 2003, example 2.6: u of the 10 balls in urn u are black; 3 of 10 draws were. Figure 2.6 prints P(u | 3).
    table = ["0", "0.063", "0.22", "0.29", "0.24", "0.13", "0.047", "0.0099", "0.00086", "0.0000096", "0"]
    urns = {f"urn {u}": f"{u**3 * (10 - u) ** 7}/{10**10}" for u in range(11)}
    likelihood = {"3 of 10": urns}
    belief = solved("bayes-rule", prior=dict.fromkeys(urns, "1/11"), likelihood=likelihood, measurements=["3 of 10"])[
        "a"
    ]
    assert [
        rounded(chance, len(text) - 2 if "." in text else 0)
        for chance, text in zip(belief.values(), table, strict=True)
    ] == table


def test_the_localisation_of_thruns_course() -> None:
    # Thrun, Artificial Intelligence for Robotics (Udacity CS373), lesson 1: a ring of five cells, green, red, red,
    # green, green; 0.6 and 0.2 for the right and the wrong colour; a move of 1 undershoots and overshoots with 0.1
    # each. Seeing red from the uniform belief gives 1/9, 1/3, 1/3, 1/9, 1/9; red, move, green, move prints the last
    # list.
    cells = "ABCDE"
    belief = dict.fromkeys(cells, "1/5")
    motion = {"move": {cells[i]: {cells[(i + k) % 5]: p for k, p in ((0, 0.1), (1, 0.8), (2, 0.1))} for i in range(5)}}
    red = {cell: "0.6" if cell in "BC" else "0.2" for cell in cells}
    green = {cell: "0.2" if cell in "BC" else "0.6" for cell in cells}
    run = [{"measurement": "red"}, {"action": "move"}, {"measurement": "green"}, {"action": "move"}]
    beliefs = solved("bayes-filter", belief=belief, motion=motion, likelihood={"red": red, "green": green}, run=run)
    assert list(beliefs["a"].values()) == [fmpq(1, 9), fmpq(1, 3), fmpq(1, 3), fmpq(1, 9), fmpq(1, 9)]
    printed = ["0.211578947", "0.151578947", "0.081052632", "0.168421053", "0.387368421"]
    assert [rounded(chance, 9) for chance in beliefs["d"].values()] == printed


def test_the_weather_in_the_land_of_oz() -> None:
    # Grinstead & Snell, Introduction to Probability, section 11.1: the powers of the transition matrix. Two days after
    # rain: 0.438, 0.188, 0.375; six days after it 0.400, 0.200, 0.400.
    motion = {
        "rain": {"rain": "1/2", "nice": "1/4", "snow": "1/4"},
        "nice": {"rain": "1/2", "snow": "1/2"},
        "snow": {"rain": "1/4", "nice": "1/4", "snow": "1/2"},
    }
    start = {"rain": 1, "nice": 0, "snow": 0}
    beliefs = list(solved("bayes-predict", belief=start, motion={"a day": motion}, actions=["a day"] * 6).values())
    assert list(beliefs[1].values()) == [fmpq(7, 16), fmpq(3, 16), fmpq(3, 8)]
    assert [rounded(chance, 3) for chance in beliefs[5].values()] == ["0.400", "0.200", "0.400"]


def test_the_regression_of_rs_manual() -> None:
    # The example of R's help(AIC), lm(Fertility ~ ., data = swiss), with 47 data and 7 parameters: R prints the AIC
    # 326.0716. So the log-likelihood is 7 − 326.0716/2 = −156.0358, and the BIC 326.0716 − 14 + 7 ln 47 = 339.0226.
    fitted = {"all": {"log_likelihood": "-156.0358", "k": 7}, "worse": {"log_likelihood": "-180", "k": 2}}
    akaike, bayes = solved("bic", criterion="AIC", fitted=fitted), solved("bic", fitted=fitted, n=47)
    assert rounded(akaike["a"]["all"], 4) == "326.0716"
    assert rounded(bayes["a"]["all"], 4) == "339.0226"
    assert akaike["b"] == bayes["b"] == "A"


def test_speed_and_stopping_distance_of_cars_in_r() -> None:
    # R's data cars, speed and stopping distance of 50 cars (Ezekiel 1930); the line by least squares.
    speed = np.repeat([4, 7, *range(8, 21), *range(22, 26)], [2, 2, 1, 1, 3, 2, 4, 4, 4, 3, 2, 3, 4, 3, 5, 1, 1, 4, 1])
    distance = np.array(
        [2, 10, 4, 22, 16, 10, 18, 26, 34, 17, 28, 14, 20, 24, 28, 26, 34, 34, 46, 26, 36, 60, 80, 20, 26, 54, 32, 40,
         32, 40, 50, 42, 56, 76, 84, 36, 46, 68, 32, 48, 52, 56, 64, 66, 54, 70, 92, 93, 120, 85]
    )  # fmt: skip
    line = np.polyval(np.polyfit(speed, distance, 1), speed)
    for left, printed in ((distance - line, "-206.57843"), (distance - distance.mean(), "-232.90120")):
        assert f"{-25 * (np.log(2 * np.pi * np.mean(left**2)) + 1):.5f}" == printed
    # R prints the AIC 419.1569 and the BIC 424.8929. A fourth parameter without any use costs 2.
    fitted = {
        "mean": {"log_likelihood": "-232.90120", "k": 2},
        "line": {"log_likelihood": "-206.57843", "k": 3},
        "more": {"log_likelihood": "-206.57843", "k": 4},
    }
    akaike, bayes = solved("bic", criterion="AIC", fitted=fitted), solved("bic", fitted=fitted, n=50)
    assert [rounded(akaike["a"][model], 4) for model in fitted] == ["469.8024", "419.1569", "421.1569"]
    assert rounded(bayes["a"]["line"], 4) == "424.8929"
    assert akaike["b"] == bayes["b"] == "B"


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"fitted": {"a": {"k": 1}, "b": {"k": 2, "likelihood": 1}}, "n": 9}, "give either likelihood or log_likel"),
        (
            {"fitted": {"a": {"k": 1, "log_likelihood": 1}, "b": {"k": 2, "likelihood": 1}}, "n": 9},
            "the likelihoods of",
        ),
        ({"fitted": {"a": {"k": 1, "likelihood": 1}, "b": {"k": 2, "likelihood": 1}}}, "n, the number of data"),
    ],
)
def test_fitted_models_that_do_not_fit_together(given: Any, message: str) -> None:
    with pytest.raises(FileError, match=message):
        solved("bic", **given)


def test_a_coin_that_is_one_of_two_by_hand() -> None:
    # θ is 1/4 or 3/4, each with 1/2; two heads and a tail: (1/16·3/4 + 9/16·1/4)/2 = (3 + 9)/128 = 3/32. Of a uniform
    # prior the evidence is 2!1!/4! = 1/12, so the odds are 9/8.
    models = {"two": {"thetas": [["1/4", "1/2"], ["3/4", "1/2"]]}, "any": {}}
    answers = solved("model-comparison", models=models, prior={"two": "1/2", "any": "1/2"}, heads=2, tails=1)
    assert answers == {"a": {"two": fmpq(3, 32), "any": fmpq(1, 12)}, "b": fmpq(9, 8), "c": True}


@pytest.mark.parametrize(
    ("model", "message"),
    [
        ({"thetas": [["1/4", "1/2"]]}, "thetas: the probabilities sum to 1/2, not to 1"),
        ({"thetas": [["1/4", "1/2"], [0.25, "1/2"]]}, "one θ is given twice"),
        ({"thetas": [["1/4", 1]], "a": 2}, "with thetas there is no prior Beta"),
        ({"thetas": [["1/4", 1]], "theta": "1/2"}, "give either theta or thetas"),
        ({"thetas": [[0, 1]]}, "'some' has the prior 0 or does not allow these tosses"),
    ],
)
def test_values_of_a_coin_that_do_not_fit(model: Any, message: str) -> None:
    with pytest.raises(FileError, match=message):
        solved("model-comparison", models={"any": {}, "some": model}, prior={"any": "1/2", "some": "1/2"},
               heads=2, tails=1)  # fmt: skip


def test_the_prior_that_makes_two_models_equally_probable_by_hand() -> None:
    # Two heads: 1/3 under a uniform prior, 1/4 of a fair coin; q/3 = (1 − q)/4 for q = 3/7, and twice that for 3/5.
    models: dict[str, Any] = {"any": {}, "fair": {"theta": "1/2"}}
    case = {"models": models, "prior": {"any": "q", "fair": "1-q"}, "heads": 2, "tails": 0}
    assert solved("model-comparison", **case, odds=1)["b"] == fmpq(3, 7)
    assert solved("model-comparison", **case, odds=2)["b"] == fmpq(3, 5)
    with pytest.raises(FileError, match="odds: they go with two models"):
        solved("model-comparison", **case)


def test_the_variance_of_a_prior_that_is_found_by_hand() -> None:
    # Mean 8 of three; (2·6 + 24w)/(2 + 3w) = 13/2 gives 24 + 48w = 26 + 39w, so w = 2/9.
    prior = {"mean": 6, "variance": "w", "noise": 2, "estimate": "13/2"}
    assert solved("model-fitting", sample={"values": [7, 9, 8], "prior": prior}) == {"a": 8, "b": fmpq(2, 9)}
    # Deviations −1, 0, 1 of x and −1, 1, 0 of y: S_xy = 1, S_xx = 2; 1/(2 + 3/w) = 1/5 for w = 1.
    line = {"points": [[0, 1], [1, 3], [2, 2]], "prior": {"variance": "w", "noise": 3, "estimate": "1/5"}}
    assert solved("model-fitting", line=line) == {"a": (fmpq(1, 2), fmpq(3, 2)), "b": 1}


def test_the_number_of_data_at_which_two_models_are_alike_by_hand() -> None:
    # Three parameters more for a fit that is 27 times as likely: 2 ln 27 = 3 ln n, so n = 9; with fewer data they pay.
    fitted = {"rich": {"likelihood": "1/3", "k": 4}, "simple": {"likelihood": "1/81", "k": 1}}
    assert solved("bic", fitted=fitted, border="fewer") == {"a": 9, "b": "A"}
    assert solved("bic", fitted=fitted, border="more") == {"a": 9, "b": "B"}
    assert solved("bic", fitted=fitted, n=8)["b"] == "A"
    assert solved("bic", fitted=fitted, n=10)["b"] == "B"
