"""Maximum likelihood by the closed forms, then maximum a posteriori with a prior."""

from collections.abc import Callable
from typing import Any

from rldrill.problems.bayes.model_fitting import Coin, Given, Line, Sample
from rldrill.problems.exact import shown
from rldrill.solutions.exact import exact, told
from rldrill.solutions.formula.formula import Formula, slip
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.bayes import (
    COIN_MAP,
    COIN_ML,
    GAUSSIAN_MAP,
    GAUSSIAN_MEAN,
    GAUSSIAN_VARIANCE,
    LINE_INTERCEPT,
    LINE_SLOPE,
    LINE_SLOPE_MAP,
    MEAN_OF_MEANS,
    MEAN_OF_X,
    MEAN_OF_Y,
    MODEL_FITTING,
    N_FOR_N_MINUS_1,
    N_MINUS_1_FOR_N,
    ONE_MEASUREMENT,
    PRODUCTS,
    SAMPLE_VARIANCE,
    SQUARES,
    SQUARES_NOT_DIVIDED,
    STANDARD_DEVIATION,
    VARIANCES_AS_WEIGHTS,
    line_intercept_map,
)
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """What the data alone say; then with the prior."""
    _fit(given, work, COIN_MAP, GAUSSIAN_MAP, LINE_SLOPE_MAP)


def _fit(given: Given, work: Work, of_coin: Formula, of_sample: Formula, of_line: Formula) -> None:
    """The estimates, those with the prior by these formulas."""
    if given.coin is not None:
        _coin(given.coin, work, of_coin)
    elif given.sample is not None:
        _sample(given.sample, work, of_sample)
    elif given.line is not None:
        _line(given.line, work, of_line)


def _coin(coin: Coin, work: Work, with_prior: Formula) -> None:
    known = {
        "heads": exact(coin.heads), "tails": exact(coin.tails), "beta_a": exact(coin.a), "beta_b": exact(coin.b),
    }  # fmt: skip
    work.answer(work.step(COIN_ML, **known))
    ones, zeros = (
        told(total) for total in (known["heads"] + known["beta_a"] - 1, known["tails"] + known["beta_b"] - 1)
    )
    _most_probable(
        work,
        "Likelihood times prior is proportional to $θ^{n_1} (1 − θ)^{n_0}·θ^{a − 1} (1 − θ)^{b − 1}$, that is "
        f"$θ^{{{ones}}} (1 − θ)^{{{zeros}}}$. {_greatest(ones, zeros)}:",
    )
    work.answer(work.step(with_prior, **known))


def _greatest(ones: str, zeros: str) -> str:
    """Where θ^ones (1 − θ)^zeros is greatest, and why."""
    if "0" in (ones, zeros):
        goes, most = ("falls", 0) if ones == "0" else ("rises", 1)
        return f"It {goes} all the way from $0$ to $1$, so it is greatest at $θ = {most}$"
    return (
        f"It is greatest where the derivative of its logarithm, ${ones}/θ − {zeros}/(1 − θ)$, is $0$, so where "
        f"${_times(ones)}(1 − θ) = {_times(zeros)}θ$"
    )


def _times(factor: str) -> str:
    """A factor as it stands before a bracket or a letter: no 1."""
    return "" if factor == "1" else factor


def _most_probable(work: Work, why: str) -> None:
    """What the maximum a posteriori estimate is, and how the formula for it comes from likelihood times prior."""
    work.say(
        "The maximum a posteriori estimate is the parameter that is most probable given the data, here called $D_z$, "
        "and the model, $M$:"
    )
    work.recall(MODEL_FITTING)
    work.say(why)


def _sample(sample: Sample, work: Work, with_prior: Formula) -> None:
    known: dict[str, Any] = {"x": dict(enumerate(map(exact, sample.values), 1)), "n": len(sample.values)}
    known["mu_hat"] = work.answer(work.step(GAUSSIAN_MEAN, **known))
    prior = sample.prior
    if prior is None or prior.estimate is None:
        variance = work.step(GAUSSIAN_VARIANCE, **known)
        found = work.answer(variance)
        unbiased = work.step(SAMPLE_VARIANCE, **known)
        if variance not in (found, 0):
            unbiased = unbiased * found / variance  # from one's own sum of squares
        work.answer(unbiased)
    if prior is None:
        return
    _most_probable(
        work,
        "Likelihood times prior is proportional to $exp(−∑_i (x_i − μ)^2/(2 σ^2) − (μ − μ_0)^2/(2 σ_0^2))$. It is "
        "greatest where the derivative of the exponent, $n (μ̂ − μ)/σ^2 − (μ − μ_0)/σ_0^2$, is $0$, so where "
        "$n σ_0^2 (μ̂ − μ) = σ^2 (μ − μ_0)$:",
    )
    noise, mean, variance = exact(prior.noise), exact(prior.mean), exact(prior.variance)
    peak = work.step(with_prior, sigma2=noise, prior_mean=mean, prior_variance=variance, **known)
    if prior.estimate is not None:
        work.say(f"This estimate must be ${shown(prior.estimate)}$:")
        peak = work.equate("w", peak, exact(prior.estimate), positive=True)
    work.answer(peak)


def _line(line: Line, work: Work, with_prior: Formula) -> None:
    values = {
        (axis, index): exact(number)
        for index, point in enumerate(line.points, 1)
        for axis, number in zip("xy", point, strict=True)
    }
    known: dict[str, Any] = {"n": len(line.points), "abscissa": "x", "ordinate": "y", "value_of": values}
    known["average"] = {axis: work.step(formula, **known) for axis, formula in (("x", MEAN_OF_X), ("y", MEAN_OF_Y))}
    known |= {"S_xy": work.step(PRODUCTS, **known), "S_xx": work.step(SQUARES, **known)}
    known["slope"] = work.step(LINE_SLOPE, **known)
    found, _ = work.answer((known["slope"], work.step(LINE_INTERCEPT, **known)))
    if found != known["slope"]:  # from one's own sum of products
        known |= {"slope": found, "S_xy": found * known["S_xx"]}
    prior = line.prior
    if prior is None:
        return
    _most_probable(
        work,
        "Likelihood times prior is proportional to $exp(−∑_i (y_i − θ_0 − θ_1 x_i)^2/(2 σ^2) − θ_1^2/(2 σ_0^2))$. For "
        "every $θ_1$ the best $θ_0$ is $ȳ − θ_1 x̄$, since its prior is flat. With it this is greatest where the "
        "derivative of the exponent with respect to $θ_1$, "
        "$(S_{x y} − θ_1 S_{x x})/σ^2 − θ_1/σ_0^2$, is $0$, so where $S_{x y} − θ_1 S_{x x} = θ_1 σ^2/σ_0^2$:",
    )
    slope = work.step(with_prior, sigma2=exact(prior.noise), prior_variance=exact(prior.variance), **known)
    if prior.estimate is not None:
        work.say(f"This estimate must be ${shown(prior.estimate)}$:")
        work.answer(work.equate("w", slope, exact(prior.estimate), positive=True))
    else:
        work.answer((slope, work.step(line_intercept_map(), slope_map=slope, **known)))


@slip(
    "prior-ignored",
    "That is the maximum likelihood estimate; maximum a posteriori weighs it with the prior.",
    when=lambda given: given.has_prior,
)
def prior_ignored(given: Given, work: Work) -> None:
    """Maximum likelihood once more, where the prior is asked for."""
    _fit(given, work, COIN_ML, GAUSSIAN_MEAN, LINE_SLOPE)


MISCONCEPTIONS = (
    N_FOR_N_MINUS_1,
    N_MINUS_1_FOR_N,
    STANDARD_DEVIATION.where_it_shows(),
    SQUARES_NOT_DIVIDED.where_it_shows(),
    prior_ignored,
    ONE_MEASUREMENT.where_it_shows(),
    MEAN_OF_MEANS.where_it_shows(),
    VARIANCES_AS_WEIGHTS.where_it_shows(),
)


def oracle(given: Given) -> Answers:
    """The peak of likelihood times prior by bisection, a parabola through three points, or numpy's least squares."""
    if given.coin is not None:
        heads, tails, a, b = (at(n) for n in (given.coin.heads, given.coin.tails, given.coin.a, given.coin.b))
        return (_best_share(heads, tails), _best_share(heads + a - 1, tails + b - 1))
    if given.sample is not None:
        values = np.array([at(value) for value in given.sample.values])
        # The mean over all pairs of half their squared distance, with and without a value's pair with itself.
        squares = (values[:, None] - values[None, :]) ** 2 / 2
        size = len(values)
        variances = [squares.mean(), squares.sum() / (size * (size - 1))]
        prior = given.sample.prior
        if prior is None:
            return [values.mean(), *variances]
        mean, noise = at(prior.mean), at(prior.noise)
        if prior.estimate is not None:
            estimate = at(prior.estimate)
            return [
                values.mean(),
                _variance(lambda w: abs(_peak(values, mean, w, noise) - mean) < abs(estimate - mean)),
            ]
        return [values.mean(), *variances, _peak(values, mean, at(prior.variance), noise)]
    assert given.line is not None
    x, y = np.array([[at(number) for number in point] for point in given.line.points]).T
    design = np.stack([x, np.ones_like(x)], axis=1)
    answers = [np.linalg.lstsq(design, y, rcond=None)[0]]
    if (prior := given.line.prior) is None:
        return answers
    noise = at(prior.noise)
    if prior.estimate is None:
        return [*answers, _ridge(design, y, noise / at(prior.variance))]
    steepness = abs(at(prior.estimate))
    return [*answers, _variance(lambda w: abs(_ridge(design, y, noise / w)[0]) < steepness)]


def _ridge(design: Array, y: Array, weight: float) -> Array:
    """The line with a prior of the slope: one more point, seen with its own noise."""
    line: Array = np.linalg.lstsq(np.vstack([design, [weight**0.5, 0.0]]), np.append(y, 0.0), rcond=None)[0]
    return line


def _variance(narrow: Callable[[float], bool]) -> float:
    """Where a variance stops to be too narrow, by bisection."""
    low, high = 1e-9, 1e9
    for _ in range(200):
        middle = (low * high) ** 0.5
        low, high = (middle, high) if narrow(middle) else (low, middle)
    return middle


def _best_share(heads: float, tails: float) -> float:
    """Where θ^heads (1 − θ)^tails is greatest: bisection of the slope of its logarithm."""
    low, high = 0.0, 1.0
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if heads * (1 - middle) > tails * middle else (low, middle)
    return (low + high) / 2


def _peak(values: Array, mean: float, variance: float, noise: float) -> float:
    """Where the posterior of the mean is greatest: its log is a parabola, so three of its values say where."""

    def log_posterior(mu: float) -> float:
        return float(-((values - mu) ** 2).sum() / (2 * noise) - (mu - mean) ** 2 / (2 * variance))

    middle = float(values.mean())
    left, here, right = (log_posterior(middle + step) for step in (-1.0, 0.0, 1.0))
    return middle + (left - right) / (2 * (left - 2 * here + right))
