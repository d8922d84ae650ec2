"""The belief over some hypotheses after one or several measurements."""

from collections.abc import Mapping
from itertools import pairwise
from typing import Self

from msgspec import Struct
from pydantic import Field, model_validator

from rldrill.problems.beliefs import (
    LikelihoodField,
    Outcome,
    belief_shown,
    check_distribution,
    check_likelihood,
    check_outcome,
    check_possible,
    filled,
    likelihood_table,
    updated,
)
from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter, Scalar, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.models import Name, OpenDistributionField, check_keys
from rldrill.problems.parts import Number, Part, Values
from rldrill.problems.phrases import in_open

TITLE = "Bayes' rule"
SOURCE = "Thrun, Burgard & Fox 2005, sections 2.2 and 2.4"
REVISION = 4


class Given(Givens):
    """A prior over hypotheses, the likelihood of every reading under each, and the readings made.

    A probability may be left open; with ``outcome`` it is found from the belief after the first reading.
    """

    FOUND_BY = "outcome"

    prior: OpenDistributionField = Field(min_length=2, description="The probability of every hypothesis beforehand.")
    likelihood: LikelihoodField = Field(description="For every reading its probability under every hypothesis.")
    measurements: tuple[Name, ...] = Field(
        min_length=1, max_length=26, description="The readings in the order in which they are made."
    )
    outcome: Outcome | None = Field(
        default=None,
        description="What is known of the belief after the first reading, if a probability is to be found from it.",
        examples=[{"state": "open", "probability": "3/4"}],
    )
    story: str = Field(
        default="", max_length=200, pattern=r"^[^$\\]*$", description="A sentence that is printed first."
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_distribution(self.prior, "prior")
        hypotheses = tuple(self.prior)
        check_likelihood(self.likelihood, hypotheses)
        check_keys(dict.fromkeys(self.measurements), tuple(self.likelihood), "a measurement", (), by="likelihood")
        believed = tuple(hypothesis for hypothesis, chance in self.prior.items() if chance)
        for number, reading in enumerate(self.measurements, 1):
            what = f"measurements[{number}]: {reading!r}"
            believed = check_possible(believed, self.likelihood[reading], what)
        check_outcome(self.outcome, self.left_open, hypotheses)
        if self.outcome is None and any(map(left_open, self.likelihood.values())):
            raise ValueError("likelihood: a probability may be left open here only with an outcome to find it from")
        return self

    @property
    def prior_found(self) -> bool:
        """Whether it is the prior that is to be found."""
        return self.outcome is not None and left_open(self.prior)


def left_open(chances: Mapping[str, Scalar]) -> bool:
    """Whether one of these probabilities is a letter."""
    return any(isinstance(chance, Parameter) for chance in chances.values())


class _Story(Struct, frozen=True):
    """What is told; the first reading is the more probable, the earlier the hypothesis stands."""

    told: str
    hypotheses: tuple[str, ...]
    readings: tuple[str, str]


_STORIES = (
    _Story("A robot stands before a door and looks at it.", ("open", "ajar", "closed"), ("looks open", "looks closed")),
    _Story("A probe drills for water and reads its sensor.", ("water", "sand", "rock"), ("wet", "dry")),
    _Story("A robot does not know where in a corridor it is.", ("west", "middle", "east"), ("door", "wall")),
    _Story("A factory tests whether a motor is sound.", ("sound", "worn", "cracked"), ("quiet", "noisy")),
)


_OPEN, _REST = Parameter("q"), Parameter("1-q")
#: What q may be as a prior, and the likelihoods of a sensor.
_SHARES = tuple(map(fraction_of, ("1/4", "1/3", "1/2", "2/3", "3/4", "1/5", "2/5", "3/5", "4/5")))
_CHANCES = tuple(
    tuple(map(fraction_of, chances))
    for chances in (("1/4", "1/2", "3/4"), ("1/5", "2/5", "3/5", "4/5"), ("1/10", "1/5", "1/2", "9/10"))
)
#: The greatest denominator of a belief on the way.
_FINEST = {1: 20, 2: 50, 3: 90}


def draw(level: int, rng: Draws) -> Given:
    """Two hypotheses and a measurement; more of either; a probability left open, or to be found."""
    story = rng.choice(_STORIES)
    kind = rng.choice(("prior", "likelihood", "open")) if level == 3 else ""
    count = 2 if level == 1 or kind in ("prior", "open") else 2 + rng.below(2)
    hypotheses = story.hypotheses if count == 3 else story.hypotheses[::2]
    named = rng.choice(hypotheses)
    while True:
        chances = sorted(rng.sample(rng.choice(_CHANCES), count), reverse=True)
        likely: dict[str, Scalar] = dict(zip(hypotheses, chances, strict=True))
        q = rng.choice(_SHARES)
        if kind == "likelihood":
            likely[named], q = _OPEN, chances[hypotheses.index(named)]
        prior: tuple[Scalar, ...] = (_OPEN, _REST) if kind in ("prior", "open") else rng.split(count, (2, 3, 4, 5))
        rest = {name: _REST if isinstance(chance, Parameter) else 1 - chance for name, chance in likely.items()}
        likelihood = dict(zip(story.readings, (likely, rest), strict=True))
        several = kind != "open" and (level == 3 or count == 2 or rng.chance(Fraction(1, 2)))
        readings = tuple(rng.choice(story.readings) for _ in range(2 if level > 1 and several else 1))
        beliefs = [{name: filled(chance, q) for name, chance in zip(hypotheses, prior, strict=True)}]
        for reading in readings:
            beliefs.append(updated(beliefs[-1], likelihood[reading], q))
        if _is_good(beliefs, _FINEST[level]):
            break
    return Given(
        prior=dict(zip(hypotheses, prior, strict=True)),
        likelihood={reading: row for reading, row in likelihood.items() if reading in readings},
        measurements=readings,
        outcome=Outcome(state=named, probability=beliefs[1][named]) if kind in ("prior", "likelihood") else None,
        story=story.told,
    )


def _is_good(beliefs: list[dict[str, Fraction]], finest: int) -> bool:
    """Whether every measurement says something, none takes back what another said, and the numbers are short."""
    if any(first == then for first, then in pairwise(beliefs)) or beliefs[0] == beliefs[-1]:
        return False
    return max(chance.denominator for belief in beliefs for chance in belief.values()) <= finest


def question(given: Given) -> Question:
    """The prior and the sensor as tables; the belief after every measurement is a part."""
    hypotheses = tuple(given.prior)
    letter = shown(Parameter(given.left_open[0])) if given.left_open else ""
    unknown = "unknown" if given.outcome else "left open"
    blocks = (
        *([Paragraph(given.story)] if given.story else []),
        Paragraph("The hypotheses have these prior probabilities $p(h)$:"),
        belief_shown(given.prior, "h"),
        Paragraph(
            "If $h$ is true, a measurement is $z$ with probability $p(z|h)$, independently of the others:"
            if len(given.measurements) > 1
            else "If $h$ is true, the measurement is $z$ with probability $p(z|h)$:"
        ),
        likelihood_table(given.likelihood, hypotheses, "h"),
        *([Paragraph(f"The probability ${letter}$ is {unknown}.")] if letter else []),
    )
    parts = []
    for index, measurement in enumerate(given.measurements):
        first = f"The measurement is “{measurement}”." if index == 0 else f"The next measurement is “{measurement}”."
        if given.outcome is not None and index == 0:
            known = f"Afterwards the belief is $p({given.outcome.state}) = {shown(given.outcome.probability)}$."
            parts.append(Part(f"{first} {known} What is ${letter}$?", Number()))
        else:
            parts.append(Part(f"{first} What is the belief afterwards{in_open(given)}?", Values("p", hypotheses)))
    return Question(blocks, tuple(parts))
