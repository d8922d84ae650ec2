"""Section 9 of the sheet: Bayesian methods."""

from functools import cache
from typing import Any

from msgspec.structs import replace
from sympy import Pow, Rational, evaluate, factorial, log, sqrt

from rldrill.problems.mathematics import (
    Accent,
    Fence,
    Math,
    Script,
    listed,
    number,
    own,
    punctuation,
    row,
    variable,
    word,
)
from rldrill.solutions.formula.formula import Formula, Misconception, Place
from rldrill.solutions.formula.notation import (
    ArgMaxOver,
    Counting,
    Hypotheses,
    IntegralOver,
    MaxOver,
    States,
    SumOver,
    Transposed,
    a,
    called,
    conditioned,
    h,
    h1,
    i,
    letter,
    n,
    quantity,
    s,
    s1,
    subscripted,
    t,
    z,
)
from rldrill.solutions.sheet.linear_methods import Ai, Bi, Qi, Ri

p = quantity("p", conditioned("p"))
likelihood = quantity("likelihood", conditioned("p"))
motion = quantity("motion", conditioned("p"))
p_bar = quantity("p_bar", conditioned(Accent(variable("p"), "bar")))
first = letter("first", Script(variable("h"), number(1)))
second = letter("second", Script(variable("h"), number(2)))

# Models and what is fitted to data
_DATA = Script(variable("D"), variable("z"))
_THETA = variable("θ")
_HAT = Accent(_THETA, "hat")


def _given(*conditions: Math) -> Math:
    return row(variable("p"), Fence(row(_DATA, punctuation("|"), listed(conditions))))


def _below(head: Math, index: str) -> Math:
    return Script(head, variable(index) if index.isalpha() else number(index))


M = letter("M")
M1 = letter("M1", "M′")
Models = letter("models", "M")
theta = letter("share", "θ")
Thetas = letter("thetas", "Θ")
theta_hat = letter("theta_hat", _HAT)
model_hat = letter("model_hat", Accent(variable("M"), "hat"))
#: The probability (density) of a parameter, of a model, and of both, given the data.
of_theta = quantity(
    "of_theta", lambda value: row(variable("p"), Fence(row(value, punctuation("|"), listed((variable("M"), _DATA)))))
)
of_model = quantity("of_model", lambda model: row(variable("p"), Fence(row(model, punctuation("|"), _DATA))))
of_both = quantity("of_both", lambda *both: row(variable("p"), Fence(row(listed(both), punctuation("|"), _DATA))))
evidence = quantity("evidence", _given)
with_theta = quantity("with_theta", lambda model: _given(model, _THETA))
density = quantity("density", conditioned("p"))
first_model = letter("first_model", _below(variable("M"), "1"))
second_model = letter("second_model", _below(variable("M"), "2"))
heads = letter("heads", _below(variable("n"), "1"))
tails = letter("tails", _below(variable("n"), "0"))
beta_a = letter("beta_a", own("a"))
beta_b = letter("beta_b", "b")
coin = letter("coin", "c")
Coins = letter("coins", "C")
heads_of = quantity("heads_of", lambda index: Script(variable("n"), listed((number(1), index))))
tails_of = quantity("tails_of", lambda index: Script(variable("n"), listed((number(0), index))))
theta_of = quantity("theta_of", lambda index: Script(_HAT, index))
log_likelihood = letter("log_likelihood", row(word("ln"), _given(variable("M"), _HAT)))
k = letter("free", "k")
log_likelihood_of = quantity("log_likelihood_of", lambda model: row(word("ln"), _given(model, _HAT)))
bic = quantity("bic", called(word("BIC")))
aic = quantity("aic", called(word("AIC")))
theta_at = quantity("theta_at", subscripted(_THETA))
count = letter("count", "m")
prior_at = quantity("prior_at", lambda index: row(variable("p"), Fence(Script(_THETA, index))))

# Samples and lines
x = quantity("x", lambda index: Script(variable("x"), index))
mu_hat = letter("mu_hat", Accent(variable("μ"), "hat"))
mu_map = letter("mu_map", Script(Accent(variable("μ"), "hat"), word("MAP")))
sigma2_hat = letter("sigma2_hat", Script(Accent(variable("σ"), "hat"), above=number(2)))
sample_variance = letter("sample_variance", Script(own("s"), above=number(2)))
sigma2 = letter("sigma2", Script(variable("σ"), above=number(2)))
prior_mean = letter("prior_mean", _below(variable("μ"), "0"))
prior_variance = letter("prior_variance", Script(variable("σ"), number(0), number(2)))
abscissa = letter("abscissa", "x")
ordinate = letter("ordinate", "y")
value_of = quantity("value_of", lambda of, index: Script(of, index))
average = quantity("average", lambda of: Accent(of, "bar"))
slope = letter("slope", Script(_HAT, number(1)))
intercept_map = letter("intercept_map", Script(_HAT, row(number(0), punctuation(","), word("MAP"))))
slope_map = letter("slope_map", Script(_HAT, row(number(1), punctuation(","), word("MAP"))))
S_xy, S_xx = (letter(f"S_{both}", Script(variable("S"), row(*map(variable, both)))) for both in ("xy", "xx"))
intercept = letter("intercept", Script(_HAT, number(0)))

# A Gaussian belief; A, B as in section 7, R and Q the covariances of the motion's and the sensor's noise
mean = quantity("mean", subscripted("μ"), matrix=True)
mean_bar = quantity("mean_bar", subscripted(Accent(variable("μ"), "bar")), matrix=True)
covariance = quantity("covariance", subscripted("Σ"), matrix=True)
covariance_bar = quantity("covariance_bar", subscripted(Accent(variable("Σ"), "bar")), matrix=True)
moved = quantity("moved", subscripted("u"), matrix=True)
read = quantity("read", subscripted("z"), matrix=True)
Ci = letter("Ci", "C", matrix=True)
Kt = quantity("Kt", subscripted("K"), matrix=True)
identity = letter("identity", "I", matrix=True)


def _on_a_line(given: Any) -> bool:
    return bool(given.on_a_line)


def _weighed(given: Any) -> bool:
    """Whether variances may be taken for their inverses: not where that of the motion is to be found from the gain."""
    return _on_a_line(given) and not isinstance(given.process[0][0], str)


def _is_noisy(given: Any) -> bool:
    """Whether the motion has a noise, and no noise is to be found."""
    return given.variance is None and any(any(line) for line in given.process)


def _may_stay(given: Any) -> bool:
    """Whether some state is believed in that every action may leave as it is."""
    return any(
        chance and all(given.motion[action][state].get(state) for action in given.actions)
        for state, chance in given.belief.items()
    )


with evaluate(False):
    NOT_NORMALISED = Misconception(
        "not-normalised", "The posterior sums to 1: divide by p(z), the sum over all hypotheses."
    )
    BASE_RATE_IGNORED = Misconception(
        "base-rate-ignored",
        "The prior counts: each likelihood is weighted by the probability of its hypothesis.",
    )
    LIKELIHOOD_FOR_POSTERIOR = Misconception(
        "likelihood-for-posterior",
        "p(z|h) is the probability of the measurement given the hypothesis, not the other way round.",
    )
    MEASURED_TWICE = Misconception(
        "measured-twice", "Every measurement counts once: its likelihood is one factor, not two."
    )
    OTHER_MEASUREMENT = Misconception(
        "other-measurement",
        "What was measured counts, with its own likelihood; 1 minus it is the probability of measuring anything else.",
    )
    BAYES = Formula(
        "bayes",
        p(h, z),
        likelihood(z, h) * p(h) / SumOver(likelihood(z, h1) * p(h1), h1, Hypotheses),
        title="Bayes' rule",
        source="Thrun, Burgard & Fox 2005, section 2.2",
        hint="Multiply each hypothesis's probability by its likelihood, then divide by the sum of these.",
        also=(likelihood(z, h) * p(h) / p(z),),
        misread={
            NOT_NORMALISED: likelihood(z, h) * p(h),
            BASE_RATE_IGNORED: likelihood(z, h) / SumOver(likelihood(z, h1), h1, Hypotheses),
            LIKELIHOOD_FOR_POSTERIOR: likelihood(z, h),
            MEASURED_TWICE: likelihood(z, h)
            * likelihood(z, h)
            * p(h)
            / SumOver(likelihood(z, h1) * likelihood(z, h1) * p(h1), h1, Hypotheses),
            OTHER_MEASUREMENT: (1 - likelihood(z, h)) * p(h) / SumOver((1 - likelihood(z, h1)) * p(h1), h1, Hypotheses),
        },
    )

    #: What stands below the line of Bayes' rule, and the rule with its value there, where there are many hypotheses.
    SUM_OF_JOINT = SumOver(likelihood(z, h1) * p(h1), h1, Hypotheses)
    BAYES_BY_READING = likelihood(z, h) * p(h) / p(z)

    BAYES_TWO_STATES = Formula(
        "bayes-two-states",
        p(first, z),
        likelihood(z, first) * p(first) / (likelihood(z, first) * p(first) + likelihood(z, second) * p(second)),
        title="Bayes' rule for two hypotheses",
        source="Thrun, Burgard & Fox 2005, section 2.2, with two hypotheses",
        hint="The two products of likelihood and prior stand below the line, the one asked for above it.",
    )

    MOTION_TRANSPOSED = Misconception(
        "motion-transposed",
        "p(s′|s, a) leads from s to s′: add up over the states that lead to s′, not over those that s′ leads to.",
    )
    MOTION_AS_LIKELIHOOD = Misconception(
        "motion-as-likelihood",
        "An action is no measurement: nothing is weighed and normalised, probability flows from state to state.",
        when=_may_stay,
    )
    PREDICT = Formula(
        "predict",
        p(s1),
        SumOver(motion(s1, s, a) * p(s), s, States),
        title="Belief after an action",
        source="Thrun, Burgard & Fox 2005, table 4.1, line 3",
        hint="Sum over the states that may come before: the probability of each, times that of the way here.",
        misread={
            MOTION_TRANSPOSED: SumOver(motion(s, s1, a) * p(s), s, States),
            MOTION_AS_LIKELIHOOD: motion(s1, s1, a) * p(s1) / SumOver(motion(s, s, a) * p(s), s, States),
        },
    )

    PREDICTION = Formula(
        "prediction",
        p_bar(s1),
        SumOver(motion(s1, s, a) * p(s), s, States),
        title="Prediction of a Bayes filter",
        source="Thrun, Burgard & Fox 2005, table 2.1, line 3",
        hint="Sum over the states that may come before: the probability of each, times that of the way here.",
        place=Place.WORKING,
        misread={
            MOTION_TRANSPOSED: SumOver(motion(s, s1, a) * p(s), s, States),
        },
    )
    BELIEF_NOT_NORMALISED = Misconception(
        "not-normalised", "The belief sums to 1: divide by p(z), the sum over all states."
    )
    PREDICTION_IGNORED = Misconception(
        "base-rate-ignored", "What was believed before the measurement counts: it weighs the likelihood of each state."
    )
    CORRECTION = Formula(
        "correction",
        p(s, z),
        likelihood(z, s) * p_bar(s) / SumOver(likelihood(z, s1) * p_bar(s1), s1, States),
        title="Correction of a Bayes filter",
        source="Thrun, Burgard & Fox 2005, table 2.1, line 4",
        hint="Multiply the prediction of each state by its likelihood, then divide by the sum of these.",
        place=Place.WORKING,
        misread={
            BELIEF_NOT_NORMALISED: likelihood(z, s) * p_bar(s),
            PREDICTION_IGNORED: likelihood(z, s) / SumOver(likelihood(z, s1), s1, States),
            MEASURED_TWICE: likelihood(z, s)
            * likelihood(z, s)
            * p_bar(s)
            / SumOver(likelihood(z, s1) * likelihood(z, s1) * p_bar(s1), s1, States),
            OTHER_MEASUREMENT: (1 - likelihood(z, s))
            * p_bar(s)
            / SumOver((1 - likelihood(z, s1)) * p_bar(s1), s1, States),
        },
    )
    READING = Formula(
        "probability-of-a-reading",
        p(z),
        SumOver(likelihood(z, s) * p_bar(s), s, States),
        title="Probability of a reading",
        source="Thrun, Burgard & Fox 2005, section 2.2",
        hint="Sum over all states: the probability of each, times that of this reading there.",
        place=Place.WORKING,
    )

    KALMAN_MOVE_MEAN = Formula(
        "kalman-predict-mean",
        mean_bar(t),
        Ai * mean(t - 1) + Bi * moved(t),
        title="Kalman: mean after a motion",
        source="Thrun, Burgard & Fox 2005, table 3.1, line 2",
        hint="Put the old mean and the command into the motion model, without noise.",
        place=Place.BEYOND,
    )
    NOISES_EXCHANGED = Misconception(
        "noises-exchanged",
        "A motion adds the variance R of its own noise; Q is that of the sensor's, which only the gain reads.",
        when=_on_a_line,
    )
    PROCESS_NOISE_FORGOTTEN = Misconception(
        "process-noise-forgotten", "Every motion adds the variance of its own noise to the belief.", when=_is_noisy
    )
    NOISE_SQUARED = Misconception(
        "noise-squared", "R is a variance already: it is added as it is, not squared.", when=_on_a_line
    )
    KALMAN_MOVE_COVARIANCE = Formula(
        "kalman-predict-covariance",
        covariance_bar(t),
        Ai * covariance(t - 1) * Transposed(Ai) + Ri,
        title="Kalman: covariance after a motion",
        source="Thrun, Burgard & Fox 2005, table 3.1, line 3",
        hint="A motion makes the belief wider: the covariance of its noise is added.",
        note="$R$ is the covariance of the motion's noise, $Q$ that of the sensor's.",
        place=Place.BEYOND,
        misread={
            PROCESS_NOISE_FORGOTTEN: Ai * covariance(t - 1) * Transposed(Ai),
            NOISES_EXCHANGED: Ai * covariance(t - 1) * Transposed(Ai) + Qi,
            NOISE_SQUARED: Ai * covariance(t - 1) * Transposed(Ai) + Ri**2,
        },
    )
    VARIANCES_FOR_INVERSES = Misconception(
        "variances-for-inverses",
        "The more certain of the two counts more: weigh with the inverse of its variance, not with the variance.",
        when=_weighed,
    )
    MOTION_NOISE_AGAIN = Misconception(
        "motion-noise-again",
        "The noise of the motion is in Σ̄ already: in the gain only that of the sensor is added to it.",
        when=_on_a_line,
    )
    GAIN_BEFORE_THE_MOTION = Misconception(
        "gain-before-the-motion",
        "The gain weighs the belief after the motion: Σ̄, to which the motion has added its noise, not the old Σ.",
        when=lambda given: any(any(line) for line in given.process),
    )
    KALMAN_GAIN = Formula(
        "kalman-gain",
        Kt(t),
        covariance_bar(t) * Transposed(Ci) * Pow(Ci * covariance_bar(t) * Transposed(Ci) + Qi, -1),
        title="Kalman gain",
        source="Thrun, Burgard & Fox 2005, table 3.1, line 4",
        hint="The gain is the share of the predicted variance in the sum of predicted and sensor variance.",
        place=Place.BEYOND,
        misread={
            GAIN_BEFORE_THE_MOTION: covariance(t - 1)
            * Transposed(Ci)
            * Pow(Ci * covariance(t - 1) * Transposed(Ci) + Qi, -1),
            VARIANCES_FOR_INVERSES: Qi * Pow(covariance_bar(t) + Qi, -1),
            NOISES_EXCHANGED: covariance_bar(t)
            * Transposed(Ci)
            * Pow(Ci * covariance_bar(t) * Transposed(Ci) + Ri, -1),
            MOTION_NOISE_AGAIN: covariance_bar(t)
            * Transposed(Ci)
            * Pow(Ci * covariance_bar(t) * Transposed(Ci) + Ri + Qi, -1),
        },
    )
    GAIN_ON_PREDICTION = Misconception(
        "gain-on-prediction",
        "The gain weighs the innovation z − μ̄: start from the predicted mean and go K of the way to the measurement.",
        when=_on_a_line,
    )
    PREDICTION_AND_READING_ALIKE = Misconception(
        "prediction-and-reading-alike",
        "Prediction and measurement do not count alike: go the share K of the way, not half of it.",
        when=_on_a_line,
    )
    COMPARED_BEFORE_THE_MOTION = Misconception(
        "compared-before-the-motion",
        "The measurement is compared with the mean after the motion, which is predicted, not with that before it.",
    )
    KALMAN_MEAN = Formula(
        "kalman-mean",
        mean(t),
        mean_bar(t) + Kt(t) * (read(t) - Ci * mean_bar(t)),
        title="Kalman: mean after measuring",
        source="Thrun, Burgard & Fox 2005, table 3.1, line 5",
        hint="Go the share K of the way from the predicted mean to the measurement.",
        place=Place.BEYOND,
        misread={
            GAIN_ON_PREDICTION: read(t) + Kt(t) * (mean_bar(t) - read(t)),
            PREDICTION_AND_READING_ALIKE: Rational(1, 2) * (mean_bar(t) + read(t)),
            COMPARED_BEFORE_THE_MOTION: mean_bar(t) + Kt(t) * (read(t) - Ci * mean(t - 1)),
        },
    )
    SHARE_TAKEN = Misconception(
        "share-taken-for-rest", "KC is the share of the variance that the measurement takes away; I − KC of it is left."
    )
    KALMAN_COVARIANCE = Formula(
        "kalman-covariance",
        covariance(t),
        (identity - Kt(t) * Ci) * covariance_bar(t),
        title="Kalman: covariance after measuring",
        source="Thrun, Burgard & Fox 2005, table 3.1, line 6",
        hint="A measurement makes the belief narrower, by the share K.",
        place=Place.BEYOND,
        misread={
            SHARE_TAKEN: Kt(t) * Ci * covariance_bar(t),
        },
    )

    MODEL_FITTING = Formula(
        "model-fitting",
        theta_hat,
        ArgMaxOver(of_theta(theta), theta, Thetas),
        title="Model fitting",
        source="Bishop 2006, section 3.3.1",
        hint="Take the parameter that is most probable given the data; with a flat prior that is maximum likelihood.",
    )
    COIN_ML = Formula(
        "coin-ml",
        theta_hat,
        heads / (heads + tails),
        title="Maximum likelihood: coin",
        source="Murphy 2012, section 3.3.3",
        hint="The relative frequency makes the data most probable.",
        note="$n_1$ heads and $n_0$ tails were seen.",
        place=Place.BEYOND,
    )
    COIN_MAP = Formula(
        "coin-map",
        theta_hat,
        (heads + beta_a - 1) / (heads + tails + beta_a + beta_b - 2),
        title="Maximum a posteriori: coin",
        source="Murphy 2012, section 3.3.3",
        hint="The prior counts as a − 1 cases of the one outcome and b − 1 of the other that were seen before.",
        note="For the prior $!Beta(a, b)$.",
        place=Place.BEYOND,
    )
    GAUSSIAN_MEAN = Formula(
        "gaussian-mean",
        mu_hat,
        SumOver(x(i), i, Counting(1, n)) * Pow(n, -1),
        title="Maximum likelihood: mean",
        source="Bishop 2006, eq. 1.55",
        hint="Add the measurements and divide by how many there are.",
        place=Place.BEYOND,
    )
    N_MINUS_1_FOR_N = Misconception(
        "n-minus-1-for-n",
        "Maximum likelihood divides by n; dividing by n − 1 makes the estimate unbiased.",
        when=lambda given: given.sample is not None,
    )
    STANDARD_DEVIATION = Misconception(
        "standard-deviation",
        "That is the standard deviation; the variance is its square.",
    )
    SQUARES_NOT_DIVIDED = Misconception(
        "squares-not-divided",
        "A variance is a mean: the sum of the squared distances is divided by their number n, or by n − 1.",
        when=lambda given: given.sample is not None,
    )
    GAUSSIAN_VARIANCE = Formula(
        "gaussian-variance",
        sigma2_hat,
        SumOver((x(i) - mu_hat) ** 2, i, Counting(1, n)) * Pow(n, -1),
        title="Maximum likelihood: variance",
        source="Bishop 2006, eq. 1.56",
        hint="Average the squared distances from the mean.",
        place=Place.BEYOND,
        misread={
            N_MINUS_1_FOR_N: SumOver((x(i) - mu_hat) ** 2, i, Counting(1, n)) * Pow(n - 1, -1),
            STANDARD_DEVIATION: sqrt(SumOver((x(i) - mu_hat) ** 2, i, Counting(1, n)) * Pow(n, -1)),
            SQUARES_NOT_DIVIDED: SumOver((x(i) - mu_hat) ** 2, i, Counting(1, n)),
        },
    )
    N_FOR_N_MINUS_1 = Misconception(
        "n-for-n-minus-1",
        "The unbiased estimate divides by n − 1; dividing by n is maximum likelihood.",
        when=lambda given: given.sample is not None,
    )
    SAMPLE_VARIANCE = Formula(
        "sample-variance",
        sample_variance,
        SumOver((x(i) - mu_hat) ** 2, i, Counting(1, n)) * Pow(n - 1, -1),
        title="Unbiased estimate of the variance",
        source="Bishop 2006, eq. 1.59",
        hint="Divide by n − 1: the mean was estimated from the same data.",
        place=Place.WORKING,
        misread={
            N_FOR_N_MINUS_1: SumOver((x(i) - mu_hat) ** 2, i, Counting(1, n)) * Pow(n, -1),
            STANDARD_DEVIATION: sqrt(SumOver((x(i) - mu_hat) ** 2, i, Counting(1, n)) * Pow(n - 1, -1)),
            SQUARES_NOT_DIVIDED: SumOver((x(i) - mu_hat) ** 2, i, Counting(1, n)),
        },
    )
    ONE_MEASUREMENT = Misconception(
        "counted-as-one", "The mean of n measurements counts n times as much as a single one: with n σ₀²."
    )
    MEAN_OF_MEANS = Misconception(
        "prior-and-data-alike",
        "The prior mean and that of the data do not count alike: weight them with σ² and n σ₀².",
    )
    VARIANCES_AS_WEIGHTS = Misconception(
        "variances-as-weights", "The more certain of the two counts more: each is weighed by the other's variance."
    )
    GAUSSIAN_MAP = Formula(
        "gaussian-mean-map",
        mu_map,
        (sigma2 * prior_mean + n * prior_variance * mu_hat) / (n * prior_variance + sigma2),
        title="Maximum a posteriori: mean",
        source="Bishop 2006, eq. 2.141",
        hint="Weight the prior mean by σ² and the data's mean by n σ₀².",
        note="For a known variance $σ^2$ and the prior $N(μ_0, σ_0^2)$.",
        place=Place.BEYOND,
        misread={
            ONE_MEASUREMENT: (sigma2 * prior_mean + prior_variance * mu_hat) / (prior_variance + sigma2),
            MEAN_OF_MEANS: (prior_mean + mu_hat) / 2,
            VARIANCES_AS_WEIGHTS: (n * prior_variance * prior_mean + sigma2 * mu_hat) / (n * prior_variance + sigma2),
        },
    )
    MEAN_OF_X, MEAN_OF_Y = (
        Formula(
            f"mean-of-{name_}",
            average(axis),
            SumOver(value_of(axis, i), i, Counting(1, n)) * Pow(n, -1),
            title=f"Mean of {name_}",
            source="James, Witten, Hastie & Tibshirani 2013, section 3.1.1",
            hint="Add up and divide by how many there are.",
            place=Place.WORKING,
        )
        for name_, axis in (("x", abscissa), ("y", ordinate))
    )
    NOT_CENTRED = Misconception(
        "not-centred", "In both sums the means are subtracted first: (xᵢ − x̄)(yᵢ − ȳ) over (xᵢ − x̄)²."
    )
    PRODUCTS = Formula(
        "line-products",
        S_xy,
        SumOver(
            (value_of(abscissa, i) - average(abscissa)) * (value_of(ordinate, i) - average(ordinate)), i, Counting(1, n)
        ),
        title="Least squares: products of the deviations",
        source="James, Witten, Hastie & Tibshirani 2013, eq. 3.4",
        hint="Write down how far every x and y is from its mean, multiply and add.",
        place=Place.WORKING,
        misread={
            NOT_CENTRED: SumOver(value_of(abscissa, i) * value_of(ordinate, i), i, Counting(1, n)),
        },
    )
    SQUARES = Formula(
        "line-squares",
        S_xx,
        SumOver((value_of(abscissa, i) - average(abscissa)) ** 2, i, Counting(1, n)),
        title="Least squares: squares of the deviations",
        source="James, Witten, Hastie & Tibshirani 2013, eq. 3.4",
        hint="Write down how far every x is from its mean, square and add.",
        place=Place.WORKING,
        misread={
            NOT_CENTRED: SumOver(value_of(abscissa, i) ** 2, i, Counting(1, n)),
        },
    )
    LINE_SLOPE = Formula(
        "line-slope",
        slope,
        S_xy / S_xx,
        title="Least squares: slope",
        source="James, Witten, Hastie & Tibshirani 2013, eq. 3.4",
        hint="Divide the sum of the products of the deviations by that of the squares of those of x.",
        place=Place.BEYOND,
    )
    LINE_INTERCEPT = Formula(
        "line-intercept",
        intercept,
        average(ordinate) - slope * average(abscissa),
        title="Least squares: intercept",
        source="James, Witten, Hastie & Tibshirani 2013, eq. 3.4",
        hint="The line goes through the point of the means.",
        place=Place.BEYOND,
    )
    OLD_SLOPE = Misconception(
        "intercept-of-the-old-slope", "With another slope the line has another intercept: put the new slope in."
    )
    HALF_OF_THE_SLOPE = Misconception(
        "slope-halved",
        "The prior's mean and the fitted slope do not count alike: the prior adds σ²/σ₀² below the line.",
    )
    LINE_SLOPE_MAP = Formula(
        "line-slope-map",
        slope_map,
        S_xy / (S_xx + sigma2 / prior_variance),
        title="Maximum a posteriori: slope",
        source="Bishop 2006, section 3.3.1, for a line with a free intercept",
        hint="The prior adds σ²/σ₀² below the line, which draws the slope towards 0.",
        note="For noise of variance $σ^2$ and the prior $N(0, σ_0^2)$.",
        place=Place.BEYOND,
        misread={
            HALF_OF_THE_SLOPE: S_xy / (2 * S_xx),
        },
    )

    MODEL_COMPARISON = Formula(
        "model-comparison",
        model_hat,
        ArgMaxOver(evidence(M) * p(M), M, Models),
        title="Model comparison",
        source="Bishop 2006, eq. 3.66",
        hint="Multiply each model's evidence by its prior; the greatest product wins.",
        also=(
            ArgMaxOver(of_model(M), M, Models),
            ArgMaxOver(IntegralOver(of_both(M, theta), theta, Thetas), M, Models),
        ),
    )
    #: In how many orders as many heads and tails can come.
    _ORDERS = factorial(heads + tails) / (factorial(heads) * factorial(tails))
    BINOMIAL = Misconception(
        "binomial-coefficient",
        "The tosses are given in their order, so no binomial coefficient counts the orders in which they may come.",
        when=lambda given: given.heads and given.tails,
    )
    FIXED_COIN = Formula(
        "coin-likelihood",
        evidence(M),
        theta**heads * (1 - theta) ** tails,
        title="Evidence of a coin whose θ is known",
        source="Murphy 2012, section 3.3.1",
        hint="Every head has the probability θ, every tail 1 − θ, and the tosses are independent.",
        place=Place.WORKING,
        misread={
            BINOMIAL: _ORDERS * theta**heads * (1 - theta) ** tails,
        },
    )
    BEST_FIT = Misconception(
        "best-fit-for-evidence",
        "The evidence averages the likelihood over the prior of θ; the likelihood at the best θ is too good.",
        when=lambda given: any(model.theta is None for model in given.models.values()),
    )
    MEAN_OF_PRIOR = Misconception(
        "prior-mean-for-evidence",
        "The evidence is the mean of the likelihood over the prior of θ, not the likelihood at the mean of θ.",
        when=BEST_FIT.when,
    )
    _MEAN_LIKELIHOOD = (
        factorial(beta_a + beta_b - 1)
        * factorial(beta_a + heads - 1)
        * factorial(beta_b + tails - 1)
        / (factorial(beta_a - 1) * factorial(beta_b - 1) * factorial(beta_a + beta_b + heads + tails - 1))
    )
    PRIOR_NOT_NORMALISED = Misconception(
        "prior-not-normalised",
        "The density of Beta(a, b) integrates to 1: its constant (a + b − 1)!/((a − 1)!(b − 1)!) belongs to it.",
    )
    EVIDENCE = Formula(
        "evidence",
        evidence(M),
        _MEAN_LIKELIHOOD,
        title="Evidence of a coin",
        source="MacKay 2003, section 3.2, there with a = b = 1",
        hint="Average the likelihood over the prior of θ; with whole a and b that is a quotient of factorials.",
        also=(IntegralOver(with_theta(M) * density(theta, M), theta, Thetas),),
        note="For the prior $!Beta(a, b)$.",
        place=Place.BEYOND,
        misread={
            BEST_FIT: (heads / (heads + tails)) ** heads * (tails / (heads + tails)) ** tails,
            MEAN_OF_PRIOR: (beta_a / (beta_a + beta_b)) ** heads * (beta_b / (beta_a + beta_b)) ** tails,
            BINOMIAL: _ORDERS * _MEAN_LIKELIHOOD,
            PRIOR_NOT_NORMALISED: factorial(beta_a + heads - 1)
            * factorial(beta_b + tails - 1)
            / factorial(beta_a + beta_b + heads + tails - 1),
        },
    )
    PRIORS_FORGOTTEN = Misconception(
        "priors-forgotten", "The priors count, too: the ratio of the evidences is multiplied by that of the priors."
    )
    SHARE_FOR_ODDS = Misconception(
        "share-for-odds",
        "Odds divide the one posterior probability by the other; divided by the sum of both it is a probability.",
    )
    PRIORS_UPSIDE_DOWN = Misconception(
        "priors-upside-down", "Each evidence is multiplied by the prior of its own model, not by that of the other one."
    )
    POSTERIOR_ODDS = Formula(
        "posterior-odds",
        of_model(first_model) / of_model(second_model),
        evidence(first_model) * p(first_model) / (evidence(second_model) * p(second_model)),
        title="Posterior odds of two models",
        source="MacKay 2003, section 3.3",
        hint="Multiply the ratio of the evidences by the ratio of the priors; $p(D_z)$ cancels.",
        place=Place.BEYOND,
        misread={
            PRIORS_FORGOTTEN: evidence(first_model) / evidence(second_model),
            PRIORS_UPSIDE_DOWN: evidence(first_model) * p(second_model) / (evidence(second_model) * p(first_model)),
            SHARE_FOR_ODDS: evidence(first_model)
            * p(first_model)
            / (evidence(first_model) * p(first_model) + evidence(second_model) * p(second_model)),
        },
    )

    MODEL_POSTERIOR = Formula(
        "model-posterior",
        of_model(M),
        evidence(M) * p(M) / SumOver(evidence(M1) * p(M1), M1, Models),
        title="Posterior probability of a model",
        source="Bishop 2006, eq. 3.66",
        hint="Bayes' rule: the evidence is the likelihood of a model.",
        place=Place.BEYOND,
    )

    LOG_LIKELIHOOD = Formula(
        "coin-log-likelihood",
        log_likelihood_of(M),
        SumOver(heads_of(coin) * log(theta_of(coin)) + tails_of(coin) * log(1 - theta_of(coin)), coin, Coins),
        title="Log-likelihood of coins",
        source="Murphy 2012, section 3.3.1",
        hint="Every head adds ln θ, every tail ln(1 − θ), with the θ of its coin.",
        place=Place.WORKING,
        misread={
            BINOMIAL: SumOver(
                heads_of(coin) * log(theta_of(coin))
                + tails_of(coin) * log(1 - theta_of(coin))
                + log(
                    factorial(heads_of(coin) + tails_of(coin)) / (factorial(heads_of(coin)) * factorial(tails_of(coin)))
                ),
                coin,
                Coins,
            ),
        },
    )
    BIC_SIGN = Misconception(
        "sign", "The log-likelihood is multiplied by −2, so that a better fit makes the BIC smaller."
    )
    HALF_FIT = Misconception("two-forgotten", "The log-likelihood is multiplied by −2, not by −1.")
    BIC_WITHOUT_LOG = Misconception("k-times-n", "Each free parameter costs ln n, not n.")
    BIC_LOG_10 = Misconception("log-base", "The logarithms of the BIC are natural, to the base e.")
    BIC_LOG_2 = Misconception("log-base-2", "The logarithms of the BIC are natural, to the base e, not to the base 2.")
    AIC_FOR_BIC = Misconception(
        "akaike-for-bayes", "That is the AIC: in the BIC each free parameter costs ln n, not 2, as n counts, too."
    )
    BIC_FOR_AIC = Misconception(
        "bayes-for-akaike", "That is the BIC: in the AIC each free parameter costs 2, however many data there are."
    )
    BIC = Formula(
        "bic",
        bic(M),
        -2 * log_likelihood + k * log(n),
        title="Bayesian information criterion",
        source="Hastie, Tibshirani & Friedman 2009, eq. 7.35",
        hint="k counts the free parameters, n the data; the smallest BIC wins.",
        note="With natural logarithms.",
        misread={
            BIC_SIGN: 2 * log_likelihood + k * log(n),
            BIC_WITHOUT_LOG: -2 * log_likelihood + k * n,
            AIC_FOR_BIC: -2 * log_likelihood + 2 * k,
            BIC_LOG_10: (-2 * log_likelihood + k * log(n)) / log(10),
            BIC_LOG_2: (-2 * log_likelihood + k * log(n)) / log(2),
            HALF_FIT: -log_likelihood + k * log(n),
        },
    )


@cache
def without_command() -> Formula:
    """The mean after a motion where there are no commands."""
    with evaluate(False):
        return replace(KALMAN_MOVE_MEAN, right=Ai * mean(t - 1))


@cache
def uniform_evidence() -> Formula:
    """The evidence of a coin whose θ has a uniform prior."""
    with evaluate(False):
        right = factorial(heads) * factorial(tails) / factorial(heads + tails + 1)
        misread = {
            **EVIDENCE.misread,
            BINOMIAL: _ORDERS * right,
            PRIOR_NOT_NORMALISED: right,  # it is 1 all over
            MEAN_OF_PRIOR: Pow(2, -heads - tails),
        }
        return replace(EVIDENCE, right=right, also=(), note="", misread=misread)


@cache
def share_of_each() -> Formula:
    """The estimate of a coin where every coin has its own."""
    with evaluate(False):
        return replace(
            COIN_ML,
            left=theta_of(coin),
            right=heads_of(coin) / (heads_of(coin) + tails_of(coin)),
            note="",
        )


@cache
def akaike() -> Formula:
    """The other criterion, which charges every parameter the same."""
    with evaluate(False):
        return replace(
            BIC,
            left=aic(M),
            right=-2 * log_likelihood + 2 * k,
            title="Akaike's information criterion",
            source="Burnham & Anderson 2002, section 2.2",
            hint="k counts the free parameters, each of which costs 2; the smallest AIC wins.",
            note="",
            misread={HALF_FIT: -log_likelihood + 2 * k, BIC_FOR_AIC: BIC.right},
        )


@cache
def few_values() -> Formula:
    """The evidence of a coin whose θ is one of a few values."""
    with evaluate(False):
        mean_theta = SumOver(theta_at(i) * prior_at(i), i, Counting(1, count))
        right = SumOver(theta_at(i) ** heads * (1 - theta_at(i)) ** tails * prior_at(i), i, Counting(1, count))
        return replace(
            FIXED_COIN,
            right=right,
            title="Evidence of a coin whose θ is one of a few values",
            source="MacKay 2003, section 3.2, with a sum for the integral",
            hint="Weight the likelihood at every possible θ by the prior of that θ, and add.",
            misread={
                BINOMIAL: _ORDERS * right,
                BEST_FIT: MaxOver(theta_at(i) ** heads * (1 - theta_at(i)) ** tails, i, Counting(1, count)),
                MEAN_OF_PRIOR: mean_theta**heads * (1 - mean_theta) ** tails,
            },
        )


@cache
def line_intercept_map() -> Formula:
    """The intercept of the line whose slope is drawn towards 0 by its prior."""
    with evaluate(False):
        return replace(
            LINE_INTERCEPT,
            left=intercept_map,
            right=average(ordinate) - slope_map * average(abscissa),
            misread={OLD_SLOPE: LINE_INTERCEPT.right},
        )
