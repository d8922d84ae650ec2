"""The action probabilities of a softmax policy that is linear in features; or the weight for which they are so."""

from math import exp, log, prod
from typing import NamedTuple, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Logarithm, Parameter, Weight, WeightField, shown
from rldrill.problems.family import Givens, Question, flag
from rldrill.problems.features import FeatureVector, OneStateFeatures, check_features, features_table, weights
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.models import Name
from rldrill.problems.parts import Number, Part, Values
from rldrill.problems.phrases import check_one_open, in_open
from rldrill.problems.settings import draw_setting
from rldrill.problems.softmax import draw_log_policy

TITLE = "Softmax policy"
SOURCE = "Sutton & Barto 2018, section 13.1"
REVISION = 6


class Odds(NamedTuple):
    """How many times as often one action is taken as another."""

    action: Name
    other: Name
    times: Exact


class Given(Givens):
    """The weights θ, and in one state the features of every action.

    With ``odds`` one weight is the logarithm of x, and x is asked for.
    """

    FOUND_BY = "odds"

    theta: tuple[WeightField, ...] = Field(min_length=1, max_length=20, description="The weights.")
    features: OneStateFeatures = Field(min_length=2, description="The features of every action.")
    entropy: bool = flag("Whether the policy's entropy is asked for.")
    odds: Odds | None = Field(
        default=None, description="How many times as often an action is taken as another, from which x is to be found."
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_features(self.features, len(self.theta))
        check_one_open(self)
        if self.odds is not None:
            for action in self.odds[:2]:
                if action not in self.features:
                    raise ValueError(f"odds: {action!r} has no features; add them")
            if self.odds.times <= 0:
                raise ValueError(f"odds: {self.odds.times} is not above 0; give one that is")
            if self.left_open != ("x",):
                raise ValueError("theta: with odds one weight must be ln x")
        return self


def draw(level: int, rng: Draws) -> Given:
    """Two actions; then three, or more features; then x left open, or found from probabilities, or the entropy.

    Weights are logarithms of whole numbers, or whole numbers for which no preference is below 0.
    """
    actions = draw_setting(rng).actions
    if level == 3:
        return rng.choice((_open, _odds, _entropy))(rng, actions)
    count, size = (2, 2) if level == 1 else rng.choice(((3, 2), (2, 3), (3, 3)))
    while True:
        logarithms = rng.choice((True, False))
        if logarithms:
            theta, rows = draw_log_policy(rng, ("s",), actions[:count], size)
            features = rows["s"]
        else:
            theta = tuple(rng.nonzero(-1, 2) for _ in range(size))
            features = {action: tuple(rng.whole(0, 2) for _ in range(size)) for action in actions[:count]}
        sums = [_sum(theta, row) for row in features.values()]
        told_apart = all(len(set(column)) > 1 for column in zip(*features.values(), strict=True))
        if len(set(sums)) == count and told_apart and (logarithms or min(sums) == 0):
            return Given(theta=theta, features=features)


def _sum(theta: tuple[Weight, ...], row: FeatureVector) -> float:
    """A preference in floating point, to tell which are equal."""
    weights = (log(int(w.removeprefix("ln "))) if isinstance(w, Logarithm) else float(w) for w in theta)
    return round(sum(w * float(x) for w, x in zip(weights, row, strict=True)), 9)


def _open(rng: Draws, actions: tuple[str, ...]) -> Given:
    """No two actions with the same preference, whatever x is."""
    while True:
        theta, rows = draw_log_policy(rng, ("s",), actions[:3], rng.choice((2, 3)))
        features = rows["s"]
        if len({(_sum(theta[:-1], row[:-1]), row[-1]) for row in features.values()}) == len(features):
            return Given(theta=(*theta[:-1], Logarithm("ln x")), features=features)


def _odds(rng: Draws, actions: tuple[str, ...]) -> Given:
    """The weight ln x counts once more for one of two actions than for the other, and another weight differs, too."""
    count, size = rng.choice(((2, 2), (3, 2), (3, 3)))
    theta, rows = draw_log_policy(rng, ("s",), actions[:count], size)
    features = rows["s"]
    pairs = [
        (a, b) for a, row in features.items() for b, less in features.items()
        if row[-1] > less[-1] and row[:-1] != less[:-1]
    ]  # fmt: skip
    if not pairs:
        return _odds(rng, actions)
    action, other = rng.choice(pairs)
    x = rng.fraction("2", "3", "4", "5", "3/2", "5/2", "1/2", "2/3")
    bases = (*(fraction_of(str(weight).removeprefix("ln ")) for weight in theta[:-1]), x)
    weights = {name: _exponential(bases, row) for name, row in features.items()}
    if len(set(weights.values())) < count:
        return _odds(rng, actions)
    times = weights[action] / weights[other]
    odds = Odds(action, other, times) if times >= 1 else Odds(other, action, 1 / times)
    return Given(theta=(*theta[:-1], Logarithm("ln x")), features=features, odds=odds)


def _exponential(bases: tuple[Fraction, ...], row: FeatureVector) -> Fraction:
    """What e to the power of a preference is, for weights that are the logarithms of these numbers."""
    return prod((base ** int(more) for base, more in zip(bases, row, strict=True)), start=Fraction(1))


def _entropy(rng: Draws, actions: tuple[str, ...]) -> Given:
    while True:
        theta, rows = draw_log_policy(rng, ("s",), actions[:3], rng.choice((2, 3)))
        sums = [_sum(theta, row) for row in rows["s"].values()]
        # Probabilities of halves, thirds, quarters and sixths: then the entropy has few logarithms.
        if len(set(sums)) > 1 and round(sum(map(exp, sums)), 6) in (8, 9, 12):
            return Given(theta=theta, features=rows["s"], entropy=True)


def question(given: Given) -> Question:
    """Weights and features; the preferences and probabilities, or x first."""
    actions = tuple(given.features)
    opened = "".join(f" The number ${shown(Parameter(name))} > 0$ is left open." for name in given.parameters())
    blocks = (
        Paragraph("In state $s$ the actions have these features:"),
        features_table(given.features),
        Paragraph(
            f"The weights are ${weights(given.theta)}$. The policy is softmax in the preferences "
            f"$h(s, a) = θ^⊤ f(s, a)$.{opened}"
        ),
    )
    if given.odds is not None:
        action, other, times = given.odds
        often = "as often" if times == 1 else f"${shown(times)}$ times as often"
        return Question(
            blocks,
            (
                Part(f"For which $x$ is {action} taken {often} as {other}?", Number()),
                Part("What is the probability $π(a|s)$ of every action for this $x$?", Values("π(·|s)", actions)),
            ),
        )
    parts = [
        Part(
            f"What is the preference $h(s, a)$ of every action{in_open(given)}?",
            Values("h(s, ·)", actions),
            zero=True,
        ),
        Part(f"What is the probability $π(a|s)$ of every action{in_open(given)}?", Values("π(·|s)", actions)),
    ]
    if given.entropy:
        ask = "What is the entropy $H = −∑_a π(a|s) ln π(a|s)$ of the policy in $s$, with natural logarithms"
        parts.append(Part(f"{ask}{in_open(given)}?", Number()))
    return Question(blocks, tuple(parts))
