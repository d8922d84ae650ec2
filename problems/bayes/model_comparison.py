"""The evidences of models of a coin, their posterior odds, and which of them is the most probable."""

from fractions import Fraction
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.beliefs import check_distribution
from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Probability, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import DistributionField, Name, check_keys
from rldrill.problems.parts import Number, Part, Values, YesNo

TITLE = "Model comparison"
SOURCE = "MacKay 2003, section 3.3"
REVISION = 1


class CoinModel(Givens):
    """What a model says of the probability of heads: ``theta``, or its prior: some ``thetas``, or Beta(a, b)."""

    theta: Probability | None = Field(
        default=None, description="The probability of heads, if the model knows it; otherwise its prior is Beta(a, b)."
    )
    thetas: tuple[tuple[Probability, Probability], ...] | None = Field(
        default=None,
        min_length=1,
        max_length=100,
        description="The possible θ, each with its prior: [θ, p(θ)]; instead of theta, a and b.",
        examples=[[["1/4", "1/2"], ["3/4", "1/2"]]],
    )
    a: int = Field(default=1, ge=1, le=100, description="The first parameter of the prior Beta(a, b).")
    b: int = Field(default=1, ge=1, le=100, description="The second parameter of the prior Beta(a, b).")

    @model_validator(mode="after")
    def _one_of_both(self) -> Self:
        fixed = self.theta is not None or self.thetas is not None
        if fixed and (self.a, self.b) != (1, 1):  # 1 is what files hold where nothing was said
            what = "theta" if self.theta is not None else "thetas"
            raise ValueError(f"with {what} there is no prior Beta(a, b); leave out {what}, or a and b")
        if self.theta is not None and self.thetas is not None:
            raise ValueError("give either theta or thetas, its possible values with their priors")
        if self.thetas is not None:
            if len(dict(self.thetas)) < len(self.thetas):
                raise ValueError("thetas: one θ is given twice; add its priors up")
            check_distribution({str(theta): chance for theta, chance in self.thetas}, "thetas")
        return self

    @property
    def certain(self) -> tuple[tuple[Fraction, Fraction], ...]:
        """The possible θ with their priors, where these are a few; none where θ may be anything."""
        return self.thetas or (() if self.theta is None else ((self.theta, Fraction(1)),))

    def allows(self, heads: int, tails: int) -> bool:
        """Whether there can be such tosses."""
        possible = [not ((theta == 0 and heads) or (theta == 1 and tails)) for theta, chance in self.certain if chance]
        return any(possible) or not self.certain


class Given(Givens):
    """Some models of a coin with their priors, and how many heads and tails there were."""

    models: dict[Name, CoinModel] = Field(min_length=2, max_length=10, description="The models by their names.")
    prior: DistributionField = Field(description="The probability of every model beforehand.")
    heads: int = Field(ge=0, le=500, description="How many heads there were.")
    tails: int = Field(ge=0, le=500, description="How many tails there were.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_keys(self.prior, tuple(self.models), "the prior", needed=tuple(self.models))
        check_distribution(self.prior, "prior")
        if self.heads + self.tails == 0:
            raise ValueError("heads: without a toss there is nothing to compare the models by")
        left = [
            name for name, model in self.models.items() if self.prior[name] and model.allows(self.heads, self.tails)
        ]
        names = list(self.models)
        if not left:
            raise ValueError(
                "models: every model has the prior 0 or does not allow these tosses; add one that is possible"
            )
        if len(names) == 2 and names[1] not in left:
            raise ValueError(
                f"models: {names[1]!r} has the prior 0 or does not allow these tosses, so there are no odds against "
                "it; put it first"
            )
        return self


def draw(level: int, rng: Draws) -> Given:
    """A bent and a fair coin, equally probable; a bent and a worn one; these two and a fair one."""
    anything = CoinModel()
    bent, worn = (
        CoinModel(a=int(a), b=int(b)) for a, b in (rng.distinct(2, 1, 3), rng.choice(((1, 1), (2, 2), (3, 3))))
    )
    fair = CoinModel(theta=rng.fraction("1/2"))
    models = {
        1: {"bent": anything, "fair": fair},
        2: {"bent": bent, "worn": worn},
        3: {"bent": bent, "worn": worn, "fair": fair},
    }[level]
    prior = (Fraction(1, 2),) * 2 if level == 1 else rng.split(level, (3, 4, 5))
    return Given(
        models=models,
        prior=dict(zip(models, prior, strict=True)),
        heads=rng.below(4) + level - 1,
        tails=1 + rng.below(3),
    )


def question(given: Given) -> Question:
    """The models and the tosses; evidences, then odds or posteriors, then whether the first model wins."""
    names = tuple(given.models)
    blocks = (
        Paragraph(
            f"A coin is tossed ${given.heads + given.tails}$ times, independently, and the order is written down: "
            f"${given.heads}$ head{'s' * (given.heads != 1)} and ${given.tails}$ tail{'s' * (given.tails != 1)}. "
            "With $θ$ the probability of heads, models are compared:"
        ),
        Table(
            header=("$M$", "what it says of $θ$", "$p(M)$"),
            rows=tuple((name, _says(model), f"${shown(given.prior[name])}$") for name, model in given.models.items()),
        ),
        Paragraph("The data $D$ are the tosses in their order, so no binomial coefficient is needed."),
    )
    first, second = names[:2]
    if len(names) == 2:
        odds = Part(f'What are the posterior odds $p("{first}"|D) / p("{second}"|D)$?', Number(), 2)
    else:
        odds = Part("What is the posterior probability $p(M|D)$ of every model?", Values("p(·|D)", names), 2)
    return Question(
        blocks,
        (
            Part("What is the evidence $p(D|M)$ of every model?", Values("p(D|·)", names), 2),
            odds,
            Part(f"Is “{first}” the most probable model now?", YesNo()),
        ),
    )


def _says(model: CoinModel) -> str:
    if model.theta is not None:
        return f"$θ = {shown(model.theta)}$"
    if model.thetas is not None:
        return "; ".join(f"$θ = {shown(theta)}$ with $p(θ) = {shown(chance)}$" for theta, chance in model.thetas)
    if model.a == model.b == 1:
        return 'anything from $0$ to $1$ alike: $"Beta"(1, 1)$'
    return f'unknown, with the prior $"Beta"({model.a}, {model.b})$'
