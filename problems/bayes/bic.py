"""The Bayesian information criterion of two models, and which of them wins."""

from fractions import Fraction
from functools import cache
from string import ascii_lowercase
from typing import Literal, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import Name
from rldrill.problems.parts import Choice, Part, Values

TITLE = "Bayesian information criterion"
SOURCE = "Hastie, Tibshirani & Friedman 2009, section 7.7"
REVISION = 2

#: What the models say of the coins' probabilities of heads.
COIN_MODELS = {
    "fair": "every coin has $θ = 1/2$",
    "shared": "all coins have the same unknown $θ$",
    "own": "every coin has an unknown $θ$ of its own",
}


#: The same of a single coin.
ONE_COIN = {"fair": "$θ = 1/2$", "shared": "$θ$ is unknown", "own": "$θ$ is unknown"}


class Fitted(Givens):
    """A model that was fitted: its likelihood at the best parameters, or the logarithm of it, and their number k."""

    likelihood: Exact | None = Field(default=None, description="The likelihood at the best parameters, above 0.")
    log_likelihood: Exact | None = Field(
        default=None, description="Its natural logarithm, in place of the likelihood.", examples=[-40]
    )
    k: int = Field(ge=0, le=1000, description="The number of parameters.")

    @model_validator(mode="after")
    def _possible(self) -> Self:
        if (self.likelihood is None) == (self.log_likelihood is None):
            raise ValueError("give either likelihood or log_likelihood")
        if self.likelihood is not None and self.likelihood <= 0:
            raise ValueError(f"likelihood is {self.likelihood}, which has no logarithm; it must be above 0")
        return self


class Data(Givens):
    """How often each coin fell on its sides, heads and tails, and which two models are compared."""

    tosses: dict[Name, tuple[int, int]] = Field(
        min_length=1, max_length=20, description="For every coin how often it fell heads and tails."
    )
    models: tuple[Literal["fair", "shared", "own"], Literal["fair", "shared", "own"]] = Field(
        description="The two models that are compared: all coins fair, one shared probability, or each its own."
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        for name, counts in self.tosses.items():
            if min(counts) < 1 or max(counts) > 1000:
                raise ValueError(f"tosses: {name!r} needs from 1 to 1000 heads and as many tails, or ln 0 turns up")
        if self.models[0] == self.models[1]:
            raise ValueError(f"models: {self.models[0]!r} is compared with itself")
        return self


class Given(Givens):
    """Fitted models and the number of data, or the tosses of coins."""

    criterion: Literal["BIC", "AIC"] = Field(
        default="BIC",
        exclude_if=lambda criterion: criterion == "BIC",
        description="Which criterion is asked for, Bayes' or Akaike's; the latter does not need n.",
    )
    fitted: dict[Name, Fitted] | None = Field(
        default=None, min_length=2, max_length=10, description="The fitted models; with them goes n."
    )
    n: int | None = Field(default=None, ge=2, le=10**6, description="The number of data; only with fitted.")
    data: Data | None = Field(
        default=None, description="The tosses of coins, from which the models are fitted; instead of fitted and n."
    )

    @model_validator(mode="after")
    def _one(self) -> Self:
        if (self.fitted is None) == (self.data is None):
            raise ValueError("give either fitted models or data")
        if (self.fitted is None and self.n is not None) or (self.fitted and self.n is None and self.criterion == "BIC"):
            raise ValueError("n, the number of data, is needed with fitted models, and with them only")
        if self.fitted and len({model.likelihood is None for model in self.fitted.values()}) > 1:
            raise ValueError("fitted: give the likelihoods of all models, or the log_likelihoods of all")
        return self

    @property
    def names(self) -> tuple[str, ...]:
        """The models that are compared."""
        return tuple(self.fitted) if self.fitted is not None else self.data.models if self.data is not None else ()


def draw(level: int, rng: Draws) -> Given:
    """Two models already fitted; one coin; two coins."""
    if level == 1:
        simple, rich = sorted(rng.distinct(2, 1, 5))
        poor, good = sorted(rng.distinct(2, 2, 9), reverse=True)
        return Given(
            fitted={
                "simple": Fitted(likelihood=1 / 2**poor, k=int(simple)),
                "rich": Fitted(likelihood=1 / 2**good, k=int(rich)),
            },
            n=rng.choice((4, 8, 16, 32)),
        )
    if level == 2:
        return Given(
            data=Data(tosses={rng.choice(("red", "blue", "gold")): rng.choice(_handy())}, models=("fair", "shared"))
        )
    first, second = rng.choice(_handy_pairs())
    return Given(data=Data(tosses={"red": first, "blue": second}, models=(rng.choice(("fair", "shared")), "own")))


@cache
def _handy() -> tuple[tuple[int, int], ...]:
    """Tosses of a coin whose logarithms are all multiples of ln 2 and ln 3."""
    small = [number for number in range(1, 33) if 6**9 % number == 0]
    return tuple((heads, tails) for heads in small for tails in small if heads + tails in small and heads + tails > 3)


@cache
def _handy_pairs() -> tuple[tuple[tuple[int, int], tuple[int, int]], ...]:
    """The same for two coins, taken alone and together, that do not fall alike."""
    pairs = [(first, second) for first in _handy() for second in _handy()]
    return tuple(
        (first, second)
        for first, second in pairs
        if (first[0] + second[0], first[1] + second[1]) in _handy() and first[0] * second[1] != first[1] * second[0]
    )


def question(given: Given) -> Question:
    """The models; log-likelihoods unless they are given, both criteria, and the winner."""
    names, criterion = given.names, given.criterion
    cost = "2 k" if criterion == "AIC" else "k log n"
    rule = Paragraph(
        f'$"{criterion}"(M) = −2 log p(D|M, θ) + {cost}$, where $log$ is the natural logarithm, $ln$.'
        + (" The smallest wins." if criterion == "AIC" or len(names) > 2 else "")
    )
    of = "both models" if len(names) == 2 else "every model"
    criteria = Part(f"What is the {criterion} of {of}?", Values(criterion, names), 2, zero=True)
    if given.fitted is not None:
        return Question((*_fitted(given, given.fitted), rule), (criteria, _winner(given)))
    assert given.data is not None
    tosses = given.data.tosses
    told = ONE_COIN if len(tosses) == 1 else COIN_MODELS
    blocks = (
        Paragraph("Independent tosses of " + ("a coin" if len(tosses) == 1 else f"{len(tosses)} coins") + " gave:"),
        Table(
            header=("coin", "heads", "tails"),
            rows=tuple((coin, f"${heads}$", f"${tails}$") for coin, (heads, tails) in tosses.items()),
        ),
        Paragraph("With $θ$ the probability of heads, two models are compared:"),
        Table(
            header=("$M$", "what it says"),
            rows=tuple((name, told[name]) for name in names),
        ),
        Paragraph("The data $D$ are the tosses in their order; $n$ counts all of them, $k$ the unknown parameters."),
        rule,
    )
    fit = Part(
        "What is $ln p(D|M, θ)$ of both models, each at the parameters that fit it best?",
        Values("ln p", names),
        2,
        zero=True,
    )
    return Question(blocks, (fit, Part(criteria.ask, criteria.kind, 2, zero=True), _winner(given)))


def _fitted(given: Given, fitted: dict[str, Fitted]) -> tuple[Block, ...]:
    """The models by their numbers."""
    logarithms = any(model.likelihood is None for model in fitted.values())
    head, told = ("ln p(D|M, θ)", "log-likelihoods") if logarithms else ("p(D|M, θ)", "likelihoods")
    rows = tuple(
        (name, f"${model.k}$", f"${shown(_number(model))}$") for name, model in fitted.items()
    )  # fmt: skip
    count = "Two models" if len(fitted) == 2 else f"{len(fitted)} models"
    data = "the same data" if given.n is None else f"$n = {given.n}$ data"
    return (
        Paragraph(f"{count} were fitted to {data}. Their {told} at their best parameters:"),
        Table(header=("$M$", "parameters $k$", f"${head}$"), rows=rows),
    )


def _number(model: Fitted) -> Fraction:
    number = model.log_likelihood if model.likelihood is None else model.likelihood
    assert number is not None, "checked with the givens"
    return number


def _winner(given: Given) -> Part:
    options = dict(zip(ascii_lowercase, given.names, strict=False))
    return Part(f"Which model does the {given.criterion} prefer?", Choice(options))
