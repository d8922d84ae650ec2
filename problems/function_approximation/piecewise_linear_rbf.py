"""Piecewise linear basis functions: the features of a state for several centres."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.centres import Centred, bumps, centres_table, draw_in_the_plane, draw_on_a_line, place
from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, shown
from rldrill.problems.family import Question
from rldrill.problems.parts import Numbers, Part

TITLE = "Piecewise linear RBF"
SOURCE = "Lecture sheet; triangular kernel"
REVISION = 1


class Given(Centred):
    """The state, the centres, and the width b at which the features reach 0."""

    width: Exact = Field(description="The distance from its centre at which a feature reaches 0, above 0.")

    @model_validator(mode="after")
    def _wide(self) -> Self:
        if self.width <= 0:
            raise ValueError(f"width: it must be above 0, not {self.width}")
        return self


def draw(level: int, rng: Draws) -> Given:
    """Two centres on a line; then four in the plane at whole distances; then four with roots."""
    width = rng.whole(2, 4)
    if level == 1:
        inside, outside = rng.whole(1, int(width) - 1), width + rng.whole(1, 3)
        centred = draw_on_a_line(rng, rng.shuffled((inside, outside)))
    else:
        centred = draw_in_the_plane(rng, 4, 0) if level == 2 else draw_in_the_plane(rng, 1, 3)
    return Given(position=centred.position, centres=centred.centres, width=width)


def question(given: Given) -> Question:
    """The state and the centres; the features are asked for, in order."""
    names = tuple(f"φ_{{{number}}}(s)" for number in range(1, len(given.centres) + 1))
    blocks = (
        place(given),
        centres_table(given.centres),
        Paragraph(
            "All features are piecewise linear radial basis functions (triangular bumps of height $1$) "
            f"of the width $b = {shown(given.width)}$."
        ),
        *bumps(given, given.width, "tent"),
    )
    ask = f"What are the features ${', '.join(names)}$, in this order?"
    return Question(blocks, (Part(ask, Numbers(names)),))
