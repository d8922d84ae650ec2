"""The belief over some hypotheses after one or several measurements."""

from dataclasses import dataclass
from math import prod
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.bars import belief_bars
from rldrill.problems.beliefs import (
    LikelihoodField,
    check_distribution,
    check_likelihood,
    check_possible,
    likelihood_table,
)
from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import DistributionField, Name, check_keys
from rldrill.problems.parts import Part, Values

TITLE = "Bayes' rule"
SOURCE = "Thrun, Burgard & Fox 2005, sections 2.2 and 2.4"
REVISION = 2


class Given(Givens):
    """A prior over hypotheses, the likelihood of every reading under each, and the readings made."""

    prior: DistributionField = Field(min_length=2, description="The probability of every hypothesis beforehand.")
    likelihood: LikelihoodField = Field(description="For every reading its probability under every hypothesis.")
    measurements: tuple[Name, ...] = Field(
        min_length=1, max_length=26, description="The readings in the order in which they are made."
    )
    story: str = Field(
        default="", max_length=200, pattern=r"^[^$\\]*$", description="A sentence that is printed first."
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_distribution(self.prior, "prior")
        check_likelihood(self.likelihood, tuple(self.prior))
        check_keys(dict.fromkeys(self.measurements), tuple(self.likelihood), "a measurement", needed=())
        believed = tuple(hypothesis for hypothesis, chance in self.prior.items() if chance)
        for number, reading in enumerate(self.measurements, 1):
            what = f"measurements[{number}]: {reading!r}"
            believed = check_possible(believed, self.likelihood[reading], what)
        return self


@dataclass(frozen=True, slots=True)
class _Story:
    told: str
    hypotheses: tuple[str, ...]
    readings: tuple[str, str]


_STORIES = (
    _Story("A robot stands before a door and looks at it.", ("open", "closed", "ajar"), ("looks open", "looks closed")),
    _Story("A probe drills for water and reads its sensor.", ("water", "rock", "sand"), ("wet", "dry")),
    _Story("A robot does not know where in a corridor it is.", ("west", "middle", "east"), ("door", "wall")),
    _Story("A factory tests whether a motor is sound.", ("sound", "worn", "cracked"), ("quiet", "noisy")),
)


def draw(level: int, rng: Draws) -> Given:
    """Two hypotheses and one measurement; then three; then three and two measurements."""
    story = rng.choice(_STORIES)
    readings = story.readings
    hypotheses = story.hypotheses[: 2 if level == 1 else 3]
    tenths = ("1/10", "1/5", "3/10", "2/5", "3/5", "7/10", "4/5", "9/10")
    likely = {hypothesis: rng.fraction(*tenths) for hypothesis in hypotheses}
    while len(set(likely.values())) == 1:  # nothing would be learnt
        likely = {hypothesis: rng.fraction(*tenths) for hypothesis in hypotheses}
    likelihood = {
        readings[0]: likely,
        readings[1]: {hypothesis: 1 - chance for hypothesis, chance in likely.items()},
    }
    measurements = [rng.choice(readings) for _ in range(2 if level == 3 else 1)]
    if len({prod(likelihood[reading][name] for reading in measurements) for name in hypotheses}) == 1:
        measurements[-1] = measurements[0]  # two readings that take back what the other says
    return Given(
        prior=dict(zip(hypotheses, rng.split(len(hypotheses), (4, 5, 10)), strict=True)),
        likelihood=likelihood,
        measurements=tuple(measurements),
        story=story.told,
    )


def question(given: Given) -> Question:
    """The prior and the sensor as tables; the belief after every measurement is a part."""
    hypotheses = tuple(given.prior)
    blocks = (
        *([Paragraph(given.story)] if given.story else []),
        Paragraph("Beforehand it believes, as $p(h)$:"),
        belief_bars(prior=given.prior),
        Paragraph("What is measured depends on which of them is true:"),
        likelihood_table(given.likelihood, hypotheses, "h"),
    )
    parts = []
    for index, measurement in enumerate(given.measurements):
        first = f"The measurement is “{measurement}”." if index == 0 else f"The next measurement is “{measurement}”."
        ask = f"{first} What is the belief {'now' if index == 0 else 'after it'}?"
        parts.append(Part(ask, Values("p", hypotheses)))
    return Question(blocks, tuple(parts))
