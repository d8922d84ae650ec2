"""Radial basis functions: the features of a state for several centres."""

from fractions import Fraction
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.centres import Centred, bumps, centres_table, draw_in_the_plane, draw_on_a_line, place
from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter, WidthField, shown
from rldrill.problems.family import Question
from rldrill.problems.parts import Numbers, Part
from rldrill.problems.phrases import in_open

TITLE = "Radial basis functions"
SOURCE = "Sutton & Barto 2018, section 9.5.5"
REVISION = 2


class Given(Centred):
    """The state, the centres, and the width σ of all features, which may be left open."""

    sigma: WidthField = Field(description="The width of all features, above 0.")

    @model_validator(mode="after")
    def _wide(self) -> Self:
        if isinstance(self.sigma, Fraction) and self.sigma <= 0:
            raise ValueError(f"sigma: the width must be above 0, not {self.sigma}")
        return self


def draw(level: int, rng: Draws) -> Given:
    """Two centres on a line; then three in the plane at whole distances; then three, and σ left open."""
    if level == 1:
        centred = draw_on_a_line(rng, rng.distinct(2, 1, 4))
    else:
        centred = draw_in_the_plane(rng, 3, 0) if level == 2 else draw_in_the_plane(rng, 1, 2)
    sigma = Parameter("sigma") if level == 3 else rng.choice(((3, 4), (3, 5))[level - 1])
    return Given(position=centred.position, centres=centred.centres, sigma=sigma)


def question(given: Given) -> Question:
    """The state and the centres; the features are asked for, in order."""
    names = tuple(f"φ_{{{number}}}(s)" for number in range(1, len(given.centres) + 1))
    width = (
        f"The width ${shown(given.sigma)} > 0$ is left open."
        if isinstance(given.sigma, Parameter)
        else f"The width is $σ = {shown(given.sigma)}$."
    )
    blocks = (
        place(given),
        centres_table(given.centres),
        Paragraph(f"All features are Gaussian radial basis functions of the same width. {width}"),
        *bumps(given, given.sigma, "gaussian"),
    )
    ask = f"What are the features ${', '.join(names)}$, in this order{in_open(given)}?"
    return Question(blocks, (Part(ask, Numbers(names)),))
