"""The Bayesian information criterion of two or three models, or Akaike's, and which of them wins."""

import math
from collections.abc import Sequence
from functools import cache
from itertools import product
from string import ascii_uppercase
from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, needed, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Name
from rldrill.problems.names import once, read_name
from rldrill.problems.parts import Choice, Number, Part, Values

TITLE = "Information criterion (BIC or AIC)"
SOURCE = "Hastie, Tibshirani & Friedman 2009, section 7.7"
REVISION = 8

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

    tosses: Annotated[dict[Name, tuple[int, int]], Field(min_length=1, max_length=20), once(read_name)] = Field(
        description="For every coin how often it fell heads and tails."
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
            raise ValueError(f"models: {self.models[0]!r} is compared with itself; name two")
        return self


class Given(Givens):
    """Fitted models and the number of data, or the tosses of coins."""

    criterion: Literal["BIC", "AIC"] = Field(
        default="BIC",
        exclude_if=lambda criterion: criterion == "BIC",
        description="Which criterion is asked for, Bayes' or Akaike's; the latter does not need n.",
    )
    fitted: Annotated[dict[Name, Fitted], Field(min_length=2, max_length=10), once(read_name)] | None = Field(
        default=None, description="The fitted models; with them goes n."
    )
    n: int | None = Field(default=None, ge=2, le=10**6, description="The number of data; only with fitted.")
    border: Literal["more", "fewer"] | None = Field(
        default=None,
        description="If it is asked for which n two fitted models have the same BIC, and which is preferred then with "
        "more data, or with fewer; n is then left out.",
    )
    data: Data | None = Field(
        default=None, description="The tosses of coins, from which the models are fitted; instead of fitted and n."
    )

    @model_validator(mode="after")
    def _one(self) -> Self:
        if (self.fitted is None) == (self.data is None):
            raise ValueError("give either fitted models or data")
        needed = self.fitted is not None and self.criterion == "BIC" and not self.border
        if (self.fitted is None and self.n is not None) or (needed and self.n is None):
            raise ValueError("n, the number of data, is needed with fitted models, and with them only")
        if self.fitted and len({model.likelihood is None for model in self.fitted.values()}) > 1:
            raise ValueError("fitted: give the likelihoods of all models, or the log_likelihoods of all")
        return self

    @model_validator(mode="after")
    def _bordered(self) -> Self:
        if not self.border:
            return self
        if self.fitted is None or len(self.fitted) != 2 or self.n is not None or self.criterion != "BIC":
            raise ValueError("border: it goes with two fitted models and the BIC, without n")
        (first, then) = self.fitted.values()
        if first.likelihood is None or then.likelihood is None or first.k == then.k:
            raise ValueError("border: give the likelihoods of both models, and different numbers k")
        return self

    @property
    def names(self) -> tuple[str, ...]:
        """The models that are compared."""
        return tuple(self.fitted) if self.fitted is not None else self.data.models if self.data is not None else ()


def draw(level: int, rng: Draws) -> Given:
    """Two models already fitted; three of them, or a coin; two coins, or from how many data on the simpler one wins."""
    place = rng.below(6)  # that of the winner
    while True:
        given = _drawn(level, rng)
        costs = [_cost(given, name) for name in given.names]
        winners = [index for index, cost in enumerate(costs) if cost == min(costs)]
        if given.border or winners == [place % len(costs)]:
            return given


#: So many tosses of a single coin leave the numbers small.
_FEW_TOSSES = 12
#: There are at least so many data for each parameter: nobody fits a model with more parameters than data.
_DATA_EACH = 2
#: What the richer model gains is at most so great a factor of the likelihood.
_GAINED = 3**7


def _drawn(level: int, rng: Draws) -> Given:
    criterion = rng.choice(("BIC", "BIC", "AIC"))
    kind = rng.choice({1: ("fitted",), 2: ("fitted", "AIC", "coin"), 3: ("coins", "three coins", "border")}[level])
    if kind == "coin":
        # Of as many heads as tails both models say the same.
        unlike = tuple(counts for counts in _handy() if counts[0] != counts[1] and sum(counts) <= _FEW_TOSSES)
        tosses = {rng.choice(("red", "blue", "gold")): rng.choice(unlike)}
        return Given(
            criterion=criterion, data=Data(tosses=tosses, models=rng.choice((("fair", "shared"), ("shared", "fair"))))
        )
    if kind in ("coins", "three coins"):
        counts = rng.choice(_handy_coins(2 if kind == "coins" else 3))
        models = rng.shuffled((rng.choice(("fair", "shared")), "own"))
        return Given(
            criterion=criterion,
            data=Data(tosses=dict(zip(("red", "blue", "gold"), counts, strict=False)), models=(models[0], models[1])),
        )
    names = ("small", "medium", "large") if level == 2 else ("small", "large")
    numbers = sorted(rng.distinct(len(names), 1, 6))
    if kind == "border":
        base, better = rng.choice(_borders(*map(int, numbers)))
        lost = better + 1 + rng.below(3)
        likelihoods = [Fraction(1, base**lost), Fraction(1, base ** (lost - better))]
        return _fitted_models(rng, names, numbers, likelihoods, border=rng.choice(("more", "fewer")))
    if kind == "AIC":
        logs = sorted(rng.distinct(len(names), 10, 20), reverse=True)
        fitted = {
            name: Fitted(log_likelihood=-log, k=int(k)) for name, log, k in zip(names, logs, numbers, strict=True)
        }
        return Given(criterion="AIC", fitted={name: fitted[name] for name in rng.shuffled(names)})
    powers = sorted(rng.distinct(len(names), 2, 9), reverse=True)
    n = rng.choice([n for n in (8, 16, 32, 64) if n >= _DATA_EACH * numbers[-1]])
    return _fitted_models(rng, names, numbers, [Fraction(1, 2 ** int(power)) for power in powers], n=n)


def _borders(few: int, many: int) -> list[tuple[int, int]]:
    """A base of the likelihoods, and by which of its powers that of the richer model is the greater one.

    Both models are then worth the same at a power of the base, n, which makes up for the parameters.
    """
    more = many - few
    return [
        (base, more * power // 2)
        for base in (2, 3)
        for power in (1, 2, 3, 4)
        if more * power % 2 == 0 and base ** (more * power // 2) <= _GAINED and base**power >= _DATA_EACH * many
    ]


def _fitted_models(
    rng: Draws, names: tuple[str, ...], numbers: Sequence[Fraction], likelihoods: Sequence[Fraction], **more: Any
) -> Given:
    models = {
        name: Fitted(likelihood=likelihood, k=int(k))
        for name, likelihood, k in zip(names, likelihoods, numbers, strict=True)
    }
    return Given(fitted={name: models[name] for name in rng.shuffled(names)}, **more)


def _cost(given: Given, name: str) -> float:
    """The criterion of a model, to see which is the smallest."""
    if given.fitted is not None:
        model = given.fitted[name]
        log = float(needed(model.log_likelihood)) if model.likelihood is None else math.log(model.likelihood)
        return model.k * _price(given, given.n) - 2 * log
    assert given.data is not None
    tosses = list(given.data.tosses.values())
    pooled = (sum(heads for heads, _ in tosses), sum(tails for _, tails in tosses))
    n, fair = sum(pooled), sum(pooled) * math.log(2)
    lost, k = {
        "fair": (fair, 0), "shared": (_lost(*pooled), 1), "own": (sum(_lost(*pair) for pair in tosses), len(tosses)),
    }[name]  # fmt: skip
    return 2 * lost + k * _price(given, n)


def _price(given: Given, n: int | None) -> float:
    """What a parameter costs; Akaike's criterion does not need n."""
    return 2.0 if n is None or given.criterion == "AIC" else math.log(n)


def _lost(heads: int, tails: int) -> float:
    n = heads + tails
    return -heads * math.log(heads / n) - tails * math.log(tails / n)


@cache
def _handy() -> tuple[tuple[int, int], ...]:
    """Tosses of a coin whose logarithms are all multiples of ln 2 and ln 3."""
    small = [number for number in range(1, 28) if 6**9 % number == 0]
    return tuple((heads, tails) for heads in small for tails in small if heads + tails in small and heads + tails > 3)


@cache
def _handy_coins(count: int) -> tuple[tuple[tuple[int, int], ...], ...]:
    """The same for several coins, taken alone and together, that do not fall alike."""
    few = [coin for coin in _handy() if sum(coin) <= (27 if count == 2 else 9)]
    return tuple(
        coins
        for coins in product(few, repeat=count)
        if (sum(heads for heads, _ in coins), sum(tails for _, tails in coins)) in _handy()
        and len({Fraction(*coin) for coin in coins}) == count
    )


def question(given: Given) -> Question:
    """The models; log-likelihoods unless they are given, both criteria, and the winner."""
    names, criterion = given.names, given.criterion
    cost = "2 k" if criterion == "AIC" else "k ln n"
    rule = Paragraph(
        f'$"{criterion}"(M) = −2 ln p(D_z|M, θ̂) + {cost}$, with the natural logarithm.'
        + (" The smaller one wins." if len(names) == 2 else " The smallest wins.")
    )
    of = "both models" if len(names) == 2 else "every model"
    criteria = Part(f"What is the {criterion} of {of}?", Values(criterion, names), zero=True)
    if given.fitted is not None and given.border:
        border = Part("For which number $n$ of data points do both models have the same BIC?", Number())
        options = dict(zip(ascii_uppercase, names, strict=False))
        data = f"{given.border} data points than that"
        after = Part(
            f"Which model does the BIC prefer if, with the same likelihoods, there are {data}?", Choice(options)
        )
        return Question((*_fitted(given, given.fitted), rule), (border, after))
    if given.fitted is not None:
        return Question((*_fitted(given, given.fitted), rule), (criteria, _winner(given)))
    assert given.data is not None
    tosses = given.data.tosses
    told = ONE_COIN if len(tosses) == 1 else COIN_MODELS
    blocks = (
        Paragraph(
            "Independent tosses of "
            + {1: "a coin", 2: "two coins", 3: "three coins"}.get(len(tosses), f"{len(tosses)} coins")
            + " gave:"
        ),
        Table(
            header=("coin $c$", "heads $n_{1, c}$", "tails $n_{0, c}$"),
            rows=tuple((coin, f"${heads}$", f"${tails}$") for coin, (heads, tails) in tosses.items()),
        ),
        Paragraph("With $θ$ the probability of heads, two models are compared:"),
        Table(
            header=("$M$", "what it says"),
            rows=tuple((name, told[name]) for name in names),
        ),
        Paragraph(
            f"The data $D_z$ are the tosses in their order; {'' if criterion == 'AIC' else '$n$ counts all of them, '}"
            "$k$ counts the unknown parameters."
        ),
        rule,
    )
    fit = Part(
        "What is $ln p(D_z|M, θ̂)$ of both models, each with its best-fitting parameters, $θ̂$?",
        Values("ln p(D_z|·, θ̂)", names),
        zero=True,
    )
    return Question(blocks, (fit, criteria, _winner(given)))


def _fitted(given: Given, fitted: dict[str, Fitted]) -> tuple[Block, ...]:
    """The models by their numbers."""
    logarithms = any(model.likelihood is None for model in fitted.values())
    head, told = ("ln p(D_z|M, θ̂)", "log-likelihoods") if logarithms else ("p(D_z|M, θ̂)", "likelihoods")
    rows = tuple(
        (name, f"${model.k}$", f"${shown(_number(model))}$") for name, model in fitted.items()
    )  # fmt: skip
    count = {2: "Two models", 3: "Three models"}.get(len(fitted), f"{len(fitted)} models")
    count_of_data = "$n$ data points" if given.border else f"$n = {given.n}$ data points"
    data = "the same data $D_z$" if given.n is None and not given.border else f"the same {count_of_data}, $D_z$"
    return (
        Paragraph(f"{count} were fitted to {data}. Their {told} at their best parameters, $θ̂$:"),
        Table(header=("$M$", "parameters $k$", f"${head}$"), rows=rows),
    )


def _number(model: Fitted) -> Fraction:
    number = model.log_likelihood if model.likelihood is None else model.likelihood
    assert number is not None, "checked with the givens"
    return number


def _winner(given: Given) -> Part:
    options = dict(zip(ascii_uppercase, given.names, strict=False))
    return Part(f"Which model does the {given.criterion} prefer?", Choice(options))
