"""The parameters of a coin, a normal distribution or a line, by maximum likelihood and maximum a posteriori."""

from fractions import Fraction
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.parts import Number, Numbers, Part

TITLE = "Model fitting"
SOURCE = "Bishop 2006, sections 1.2.4, 2.3.6 and 3.3.1"
REVISION = 2


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
    """A normal prior of one parameter, and the variance of the noise, which is then known."""

    mean: Exact = Field(default=Fraction(0), description="The mean of the prior.", examples=["1/2"])
    variance: Exact = Field(description="The variance of the prior, above 0.")
    noise: Exact = Field(description="The variance of the noise of a measurement, above 0.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.variance <= 0 or self.noise <= 0:
            raise ValueError("variance and noise must be above 0")
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


class Given(Givens):
    """One of the three: tosses of a coin, a sample, or points for a line."""

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
        return any(model is not None and model.prior is not None for model in (self.sample, self.line))


def draw(level: int, rng: Draws) -> Given:
    """A coin; then a sample; then a line."""
    if level == 1:
        heads, tails = (int(rng.whole(1, 6)) for _ in range(2))
        return Given(coin=Coin(heads=heads, tails=tails, a=rng.whole(1, 4), b=rng.whole(2, 4)))
    prior = Prior(
        mean=rng.whole(6, 12) if level == 2 else 0, variance=rng.fraction("1", "2", "4"), noise=rng.whole(1, 6)
    )
    if level == 2:
        return Given(sample=Sample(values=_balanced(rng, 4 + rng.below(2), 2, 12), prior=prior))
    size = 4 + rng.below(2)
    ordinates = _balanced(rng, size, 0, 9)
    abscissas = _balanced(rng, size, 0, 6)
    while len(set(abscissas)) < size:
        abscissas = _balanced(rng, size, 0, 6)
    return Given(line=Line(points=tuple(zip(sorted(abscissas), ordinates, strict=True)), prior=prior))


def _balanced(rng: Draws, size: int, low: int, high: int) -> tuple[Fraction, ...]:
    """Whole numbers whose mean is whole, not all the same."""
    while True:
        values = tuple(rng.whole(low, high) for _ in range(size))
        if sum(values) % size == 0 and len(set(values)) > 1:
            return values


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
            f"A gripper is tried ${tosses}$ times: ${coin.heads}$ times it holds, ${coin.tails}$ times it slips. "
            "The trials are independent, and each holds with the same unknown probability $θ$."
        ),
    )
    prior = f'Now $θ$ has the prior $"Beta"({shown(coin.a)}, {shown(coin.b)})$, whose density is proportional to '
    power = f"$θ^{{{shown(coin.a - 1)}}} (1 − θ)^{{{shown(coin.b - 1)}}}$."
    return Question(
        blocks,
        (
            Part("What is the maximum likelihood estimate of $θ$?", Number(), zero=True),
            Part(f"{prior}{power} What is the maximum a posteriori estimate of $θ$?", Number(), 2, zero=True),
        ),
    )


def _sample(sample: Sample) -> Question:
    values = ", ".join(map(shown, sample.values))
    blocks: list[Block] = [
        Paragraph(
            f"A range finder measures the same distance ${len(sample.values)}$ times: ${values}$. The measurements are "
            "independent and normal, with unknown mean $μ$ and variance $σ^2$."
        ),
    ]
    parts = [
        Part("What is the maximum likelihood estimate of $μ$?", Number(), zero=True),
        Part("What is the maximum likelihood estimate of $σ^2$, which divides by $n$?", Number(), zero=True),
        Part("What is the unbiased estimate of $σ^2$, which divides by $n − 1$?", Number(), zero=True),
    ]
    if sample.prior is not None:
        prior = sample.prior
        told = (
            f"Now let the variance of a measurement be known, $σ^2 = {shown(prior.noise)}$, and let the prior of $μ$ "
            f"be normal with mean $μ_0 = {shown(prior.mean)}$ and variance $σ_0^2 = {shown(prior.variance)}$."
        )
        parts.append(Part(f"{told} What is the maximum a posteriori estimate of $μ$?", Number(), 2, zero=True))
    return Question(tuple(blocks), tuple(parts))


def _line(line: Line) -> Question:
    blocks = (
        Paragraph("At the motor voltage $x$ a robot was seen to have the speed $y$:"),
        Table(
            header=("$x$", *(f"${shown(x)}$" for x, _ in line.points)),
            rows=(("$y$", *(f"${shown(y)}$" for _, y in line.points)),),
        ),
        Paragraph("The model is a line with independent normal noise of the same variance: $y = θ_0 + θ_1 x + ε$."),
    )
    entries = Numbers(("θ_1", "θ_0"))
    parts = [Part("Which slope $θ_1$ and intercept $θ_0$ have the greatest likelihood (least squares)?", entries, 2)]
    if line.prior is not None:
        told = (
            f"Now let the variance of the noise be known, $σ^2 = {shown(line.prior.noise)}$, and let the prior of the "
            f"slope be normal with mean $0$ and variance $σ_0^2 = {shown(line.prior.variance)}$; that of $θ_0$ is flat."
        )
        parts.append(Part(f"{told} Which $θ_1$ and $θ_0$ are the most probable?", entries, 2))
    return Question(blocks, tuple(parts))
