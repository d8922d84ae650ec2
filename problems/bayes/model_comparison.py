"""The evidences of models of a coin, their posterior odds, and which of them is the most probable."""

from functools import cache, lru_cache
from typing import Annotated, ClassVar, Self

from pydantic import Field, model_validator

from rldrill.problems.beliefs import check_distribution
from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, Probability, shown
from rldrill.problems.family import AskedFor, Givens, Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Name, OpenDistributionField, check_keys
from rldrill.problems.names import once, read_name
from rldrill.problems.parts import Number, Part, Values, YesNo

TITLE = "Model comparison"
SOURCE = "MacKay 2003, section 3.3"
REVISION = 3


@lru_cache(maxsize=4096)  # the same coins are drawn again and again
def _evidence(certain: tuple[tuple[Fraction, Fraction], ...], a: int, b: int, heads: int, tails: int) -> Fraction:
    if certain:
        return sum((theta**heads * (1 - theta) ** tails * chance for theta, chance in certain), Fraction(0))
    result = Fraction(1)
    for toss in range(heads + tails):
        seen = (toss, 0) if toss < heads else (heads, toss - heads)
        counts = (a + seen[0], b + seen[1])
        result *= Fraction(counts[toss >= heads], sum(counts))
    return result


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

    def evidence(self, heads: int, tails: int) -> Fraction:
        """The probability of these tosses in their order, toss by toss."""
        return _evidence(self.certain, self.a, self.b, heads, tails)

    def allows(self, heads: int, tails: int) -> bool:
        """Whether there can be such tosses."""
        possible = [not ((theta == 0 and heads) or (theta == 1 and tails)) for theta, chance in self.certain if chance]
        return any(possible) or not self.certain


class Given(AskedFor):
    """Some models of a coin with their priors, and how many heads and tails there were.

    With ``odds`` the prior is left open, and found for two models from these posterior odds.
    """

    OWN: ClassVar[str] = "a"

    models: Annotated[dict[Name, CoinModel], Field(min_length=2, max_length=10), once(read_name)] = Field(
        description="The models by their names."
    )
    prior: OpenDistributionField = Field(description="The probability of every model beforehand.")
    heads: int = Field(ge=0, le=500, description="How many heads there were.")
    tails: int = Field(ge=0, le=500, description="How many tails there were.")
    odds: Exact | None = Field(
        default=None,
        gt=0,
        description="The posterior odds of the first model, from which its prior is found, where that is q.",
        examples=[1],
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_keys(self.prior, tuple(self.models), "the prior", needed=tuple(self.models))
        check_distribution(self.prior, "prior")
        if (self.odds is None) == bool(self.left_open) or (self.odds is not None and len(self.models) > 2):
            raise ValueError("odds: they go with two models, and with a prior that is left open as q and 1-q")
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


#: How long the numbers of a level may be.
_LONGEST = {1: 64, 2: 100, 3: 220}
_HALF = Fraction(1, 2)
#: Of tosses and prior together, so that no factorial is above 6! = 720.
_MOST_COUNTED = 7


def draw(level: int, rng: Draws) -> Given:
    """An unknown or a loaded coin, or a fair one; then priors of its θ; then three models, or a prior to be found."""
    wanted = rng.chance(_HALF)
    found = level == 3 and rng.chance(_HALF)
    while True:
        models = _models(level, rng, two=level < 3 or found)
        heads, tails = rng.below(5), rng.below(5)
        if heads + tails < 2 or any(heads * model.b == tails * model.a for model in models.values()):
            continue
        if any(model.a + model.b + heads + tails > _MOST_COUNTED for model in models.values() if not model.certain):
            continue
        q = rng.fraction("1/4", "1/3", "2/5", "1/2", "3/5", "2/3", "3/4", "4/5")
        if found:
            first, second = (model.evidence(heads, tails) for model in models.values())
            odds = rng.fraction("1", "1", "2", "3", "1/2")
            q = odds * second / (first + odds * second)
        prior = (q, 1 - q) if len(models) == 2 and level > 1 else rng.split(len(models), (len(models), 4, 5))
        weights = [model.evidence(heads, tails) * chance for model, chance in zip(models.values(), prior, strict=True)]
        after = [weight / sum(weights) for weight in weights] if len(weights) > 2 else [weights[0] / weights[1]]
        numbers = [q, *after, *(model.evidence(heads, tails) for model in models.values())]
        best = max(weights)
        if not found and (weights.count(best) > 1 or wanted != (weights[0] == best)):
            continue
        if max(max(number.numerator, number.denominator) for number in numbers) <= _LONGEST[level]:
            break
    names = tuple(models)
    if found:
        left_open = {names[0]: Parameter("q"), names[1]: Parameter("1-q")}
        return Given(models=models, prior=left_open, heads=heads, tails=tails, odds=after[0])
    return Given(models=models, prior=dict(zip(names, prior, strict=True)), heads=heads, tails=tails)


_coin = cache(CoinModel)


def _models(level: int, rng: Draws, *, two: bool) -> dict[str, CoinModel]:
    fair, unknown = _coin(theta=_HALF), _coin()
    loaded = _coin(theta=rng.fraction("1/3", "2/3", "1/4", "3/4"))
    share = rng.fraction("1/4", "1/3")
    marked = _coin(thetas=((share, _HALF), (1 - share, _HALF)))
    bent, worn = (_coin(a=a, b=b) for a, b in (rng.integers(2, 1, 3), rng.choice(((1, 1), (2, 2), (3, 3)))))
    if level == 1:
        return rng.choice(({"unknown": unknown, "fair": fair}, {"loaded": loaded, "fair": fair}))
    if two:
        return rng.choice((
            {"bent": bent, "worn": worn}, {"marked": marked, "bent": bent}, {"bent": bent, "loaded": loaded},
            {"marked": marked, "fair": fair},
        ))  # fmt: skip
    return rng.choice((
        {"bent": bent, "worn": worn, "fair": fair}, {"marked": marked, "loaded": loaded, "unknown": unknown},
        {"marked": marked, "bent": bent, "fair": fair},
    ))  # fmt: skip


def question(given: Given) -> Question:
    """The models and the tosses; evidences, then odds or posteriors, then whether the first model wins."""
    names = tuple(given.models)
    blocks = (
        Paragraph(
            f"A coin is tossed ${given.heads + given.tails}$ times, independently, and the order is written down: "
            f"$n_1 = {given.heads}$ head{'s' * (given.heads != 1)} and $n_0 = {given.tails}$ "
            f"tail{'s' * (given.tails != 1)}. "
            "With $θ$ the probability of heads, these models $M$ are compared:"
        ),
        Table(
            header=("$M$", "what it says", "$p(M)$"),
            rows=tuple((name, _says(model), f"${shown(given.prior[name])}$") for name, model in given.models.items()),
        ),
        Paragraph("The data $D_z$ are the tosses in their order, so no binomial coefficient is needed."),
    )
    first, second = names[:2]
    evidences = Part("What is the evidence $p(D_z|M)$ of every model?", Values("p(D_z|·)", names))
    ratio = f'$p("{first}"|D_z) / p("{second}"|D_z)$'
    if given.odds is not None:
        what = (
            "both models equally probable after these tosses"
            if given.odds == 1
            else f"the posterior odds {ratio} equal to ${shown(given.odds)}$"
        )
        letter = shown(Parameter(given.left_open[0]))
        return Question(blocks, (evidences, Part(f"For which prior probability ${letter}$ are {what}?", Number())))
    if len(names) == 2:
        odds = Part(f"What are the posterior odds {ratio}?", Number())
    else:
        odds = Part("What is the posterior probability $p(M|D_z)$ of every model?", Values("p(·|D_z)", names))
    most = "more" if len(names) == 2 else "most"
    return Question(blocks, (evidences, odds, Part(f"Given $D_z$, is “{first}” the {most} probable model?", YesNo())))


def _says(model: CoinModel) -> str:
    if model.theta is not None:
        return f"$θ = {shown(model.theta)}$"
    if model.thetas is not None:
        return "; ".join(f"$θ = {shown(theta)}$ with $p(θ) = {shown(chance)}$" for theta, chance in model.thetas)
    if model.a == model.b == 1:
        return '$θ$ is unknown, with a uniform prior, $"Beta"(1, 1)$'
    return f'$θ$ is unknown, with the prior $"Beta"({model.a}, {model.b})$'
