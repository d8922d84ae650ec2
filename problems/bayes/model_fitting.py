"""The parameters of a coin, a normal distribution or a line, by maximum likelihood and maximum a posteriori."""

from collections.abc import Sequence
from typing import ClassVar, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Open, Parameter, shown
from rldrill.problems.family import AskedFor, Givens, Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.parts import Number, Numbers, Part

TITLE = "Model fitting"
SOURCE = "Bishop 2006, sections 1.2.4, 2.3.6 and 3.3.1"
REVISION = 5


class Coin(Givens):
    """Tosses of a coin, heads and tails, and the prior Beta(a, b) of the probability of heads."""

    heads: int = Field(ge=0, le=1000, description="How many heads there were.")
    tails: int = Field(ge=0, le=1000, description="How many tails there were.")
    a: Exact = Field(description="The first parameter of the prior Beta(a, b), above 0.")
    b: Exact = Field(description="The second parameter of the prior Beta(a, b), above 0.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.heads + self.tails == 0:
            raise ValueError("heads: without a toss there is nothing to fit")
        if self.a < 1 or self.b < 1:
            raise ValueError("a and b must be at least 1, or the most probable θ may not exist")
        return self


class Prior(Givens):
    """A normal prior of one parameter, and the variance of the noise, which is then known.

    With ``estimate``, the most probable parameter, the variance of the prior is left open and found from it.
    """

    mean: Exact = Field(default=Fraction(0), description="The mean of the prior.", examples=["1/2"])
    variance: Open = Field(description="The variance of the prior, above 0.")
    noise: Exact = Field(description="The variance of the noise of a measurement, above 0.")
    estimate: Exact | None = Field(
        default=None,
        description="The maximum a posteriori estimate, from which the variance w is found that is left open.",
        examples=["5/2"],
    )

    @property
    def found(self) -> bool:
        """Whether the variance is to be found."""
        return isinstance(self.variance, Parameter)

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.noise <= 0 or (isinstance(self.variance, Fraction) and self.variance <= 0):
            raise ValueError("variance and noise must be above 0")
        if self.found != (self.estimate is not None):
            raise ValueError("estimate: it goes with a variance that is left open as w, and is needed then")
        return self


class Sample(Givens):
    """Measurements of one quantity, and if wanted a prior of its mean."""

    values: tuple[Exact, ...] = Field(min_length=2, max_length=100, description="The measurements.")
    prior: Prior | None = Field(
        default=None, description="A prior of the mean, for the posterior; without it the best fit is asked for."
    )


class Line(Givens):
    """Points (x, y) for a line, and if wanted a prior of its slope, with mean 0."""

    points: tuple[tuple[Exact, Exact], ...] = Field(
        min_length=2, max_length=100, description="The points, each as [x, y]."
    )
    prior: Prior | None = Field(
        default=None, description="A prior of the slope, with mean 0; without it the best fit is asked for."
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if len({x for x, _ in self.points}) == 1:
            raise ValueError("points: all x are the same, so no slope fits best")
        if self.prior is not None and self.prior.mean:
            raise ValueError("prior: the prior of a slope must have the mean 0")
        return self


class Given(AskedFor):
    """One of the three: tosses of a coin, a sample, or points for a line."""

    OWN: ClassVar[str] = "asx"

    coin: Coin | None = Field(default=None, description="Tosses of a coin.")
    sample: Sample | None = Field(default=None, description="Measurements of one quantity; instead of coin.")
    line: Line | None = Field(default=None, description="Points for a line; instead of coin.")

    @model_validator(mode="after")
    def _one(self) -> Self:
        if sum(model is not None for model in (self.coin, self.sample, self.line)) != 1:
            raise ValueError("give one of coin, sample and line")
        return self

    @property
    def has_prior(self) -> bool:
        """Whether a prior is given that says anything."""
        if self.coin is not None:
            return self.coin.a != 1 or self.coin.b != 1
        priors = [model.prior for model in (self.sample, self.line) if model is not None]
        return any(prior is not None and not prior.found for prior in priors)


def draw(level: int, rng: Draws) -> Given:
    """A coin; then a sample, or a line without a prior; then a line with one, or the variance of a prior."""
    if level == 1:
        heads, tails = (int(rng.whole(1, 6)) for _ in range(2))
        return Given(coin=Coin(heads=heads, tails=tails, a=rng.whole(1, 4), b=rng.whole(2, 4)))
    if level == 2:
        if rng.chance(Fraction(1, 3)):
            return Given(line=Line(points=_points(rng, 3 + rng.below(2))))
        values = _balanced(rng, 3 + rng.below(2), 4, 9)
        prior = Prior(mean=rng.whole(4, 9), **_variances(rng, ("1", "2", "1/2"), 3))
        return Given(sample=Sample(values=values, prior=prior if rng.chance(Fraction(3, 4)) else None))
    prior = Prior(**_variances(rng, ("1", "2", "1/2", "1/4"), 6))
    kind = rng.choice(("line", "sample found", "line found"))
    if kind == "line":
        return Given(line=Line(points=_points(rng, 4 + rng.below(2)), prior=prior))
    if kind == "line found":
        points = _points(rng, 3 + rng.below(3))
        slope = _slope(points, prior.noise / rng.fraction("1", "2", "1/2", "1/4", "1/3"))
        found = Prior(variance=Parameter("w"), noise=prior.noise, estimate=slope)
        return Given(line=Line(points=points, prior=found))
    values = _balanced(rng, 3 + rng.below(3), 4, 12)
    average = sum(values) / len(values)
    mean = average + rng.nonzero(-4, 4)
    share = rng.fraction("2/5", "1/3", "1/4", "2/3", "3/5", "1/5")  # of the prior
    found = Prior(mean=mean, variance=Parameter("w"), noise=prior.noise, estimate=share * mean + (1 - share) * average)
    return Given(sample=Sample(values=values, prior=found))


def _variances(rng: Draws, of_prior: Sequence[str], most: int) -> dict[str, Fraction]:
    """The variances of a prior and of the noise, which do not cancel."""
    variance = rng.fraction(*of_prior)
    return {"variance": variance, "noise": rng.fitting(1, most, lambda noise: noise != variance)}


def _points(rng: Draws, size: int) -> tuple[tuple[Fraction, Fraction], ...]:
    """Points whose means are whole, and whose least-squares line has short numbers."""
    while True:
        abscissas, ordinates = _balanced(rng, size, 0, 6), _balanced(rng, size, 0, 9)
        if len(set(abscissas)) == size:
            points = tuple(zip(sorted(abscissas), ordinates, strict=True))
            slope = _slope(points, Fraction(0))
            if slope and slope.denominator <= 10:
                return points


def _slope(points: tuple[tuple[Fraction, Fraction], ...], added: Fraction) -> Fraction:
    """The slope of the line that fits best, with this added to the squares below the line of its formula."""
    x_mean, y_mean = (sum(column) / len(points) for column in zip(*points, strict=True))
    products = sum(((x - x_mean) * (y - y_mean) for x, y in points), Fraction(0))
    return products / (sum(((x - x_mean) ** 2 for x, _ in points), Fraction(0)) + added)


def _balanced(rng: Draws, size: int, low: int, high: int) -> tuple[Fraction, ...]:
    """Whole numbers whose mean is whole, not all the same."""
    while True:
        values = tuple(rng.whole(low, high) for _ in range(size))
        if sum(values) % size == 0 and len(set(values)) > 1:
            return values


def _power(base: str, exponent: Fraction) -> str:
    """A power as one writes it: nothing for the exponent 0, the base alone for 1."""
    return "" if exponent == 0 else base if exponent == 1 else f"{base}^{{{shown(exponent)}}}"


def question(given: Given) -> Question:
    """The data; first what fits best, then what is most probable with a prior."""
    if given.coin is not None:
        return _coin(given.coin)
    if given.sample is not None:
        return _sample(given.sample)
    assert given.line is not None
    return _line(given.line)


def _coin(coin: Coin) -> Question:
    tosses = coin.heads + coin.tails
    blocks = (
        Paragraph(
            f"A gripper is tried ${tosses}$ times: it holds in $n_1 = {coin.heads}$ of the trials and "
            f"slips in $n_0 = {coin.tails}$. The trials are independent, and each holds with the same unknown "
            "probability $θ$."
        ),
    )
    beta = f'$"Beta"(a, b)$ with $a = {shown(coin.a)}$ and $b = {shown(coin.b)}$'
    prior = f"Now $θ$ has the prior {beta}, whose density is proportional to "
    factors = (_power("θ", coin.a - 1), _power("(1 − θ)", coin.b - 1))
    power = f"${' '.join(filter(None, factors)) or '1'}$."
    return Question(
        blocks,
        (
            Part("What is the maximum likelihood estimate of $θ$?", Number(), zero=True),
            Part(f"{prior}{power} What is the maximum a posteriori estimate of $θ$?", Number(), zero=True),
        ),
    )


def _sample(sample: Sample) -> Question:
    values = ", ".join(map(shown, sample.values))
    blocks: tuple[Block, ...] = (
        Paragraph(
            f"A range finder measures the same distance ${len(sample.values)}$ times: ${values}$. The measurements are "
            "independent and normal, with unknown mean $μ$ and variance $σ^2$."
        ),
    )
    parts = [
        Part("What is the maximum likelihood estimate of $μ$?", Number(), zero=True),
        Part("What is the maximum likelihood estimate of $σ^2$, which divides by $n$?", Number(), zero=True),
        Part("What is the unbiased estimate of $σ^2$, which divides by $n − 1$?", Number(), zero=True),
    ]
    if sample.prior is not None:
        prior = sample.prior
        told = (
            f"Now let the variance of a measurement be known, $σ^2 = {shown(prior.noise)}$, and let the prior of $μ$ "
            f"be normal with mean $μ_0 = {shown(prior.mean)}$"
        )
        if prior.estimate is not None:
            parts = parts[:1]
            known = (
                f"and an unknown variance $σ_0^2 = w$. The maximum a posteriori estimate is ${shown(prior.estimate)}$."
            )
            parts.append(Part(f"{told} {known} What is $w$?", Number()))
        else:
            known = f"and variance $σ_0^2 = {shown(prior.variance)}$."
            parts.append(Part(f"{told} {known} What is the maximum a posteriori estimate of $μ$?", Number(), zero=True))
    return Question(blocks, tuple(parts))


_CALLED = ("slope", "intercept")


def _line(line: Line) -> Question:
    blocks = (
        Paragraph("A sensor was read at some places $x$ along a track. Its readings are $y$:"),
        Table(
            header=("$x$", *(f"${shown(x)}$" for x, _ in line.points)),
            rows=(("$y$", *(f"${shown(y)}$" for _, y in line.points)),),
        ),
        Paragraph(
            "The model is a line with independent normal noise of mean $0$ and the same variance: "
            "$y = θ_0 + θ_1 x + ε$."
        ),
    )
    entries = Numbers(("θ̂_1", "θ̂_0"), called=_CALLED)
    ask = "What are the maximum likelihood (least squares) estimates of the slope $θ_1$ and the intercept $θ_0$?"
    parts = [Part(ask, entries)]
    if line.prior is not None:
        told = (
            f"Now let the variance of the noise be known, $σ^2 = {shown(line.prior.noise)}$, and let the prior of the "
            f"slope be normal with mean $0$ and variance $σ_0^2 = {shown(line.prior.variance)}$; that of $θ_0$ is flat."
        )
        if line.prior.estimate is not None:
            known = f"The maximum a posteriori estimate of the slope is ${shown(line.prior.estimate)}$."
            parts.append(Part(f"{told} {known} What is $w$?", Number()))
        else:
            with_prior = Numbers(('θ̂_{1,"MAP"}', 'θ̂_{0,"MAP"}'), called=_CALLED)
            parts.append(Part(f"{told} What are their maximum a posteriori estimates?", with_prior))
    return Question(blocks, tuple(parts))
