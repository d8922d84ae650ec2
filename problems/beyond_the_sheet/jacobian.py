"""The Jacobian of a planar arm, the velocity of its end, and whether the configuration is singular."""

from fractions import Fraction
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.angles import read_angle
from rldrill.problems.arms import PlanarArm, draw_angles, situation
from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, shown
from rldrill.problems.family import Question
from rldrill.problems.parts import Matrix, Numbers, Part, YesNo

TITLE = "Jacobian of an arm"
SOURCE = "Siciliano et al. 2009, section 3.2.1"
REVISION = 2

_STRAIGHT = (read_angle("0"), read_angle("pi"))


class Given(PlanarArm):
    """An arm and its joint velocities; with ``orientation`` the last link's angle is the third row of J."""

    rates: tuple[Exact, ...] = Field(description="The angular velocity of every joint, in radians a second.")
    orientation: bool = Field(
        default=False, description="Whether the angle of the last link is the third row of the Jacobian."
    )

    @model_validator(mode="after")
    def _rates_fit(self) -> Self:
        if len(self.rates) != len(self.lengths):
            raise ValueError(f"rates holds {len(self.rates)}, but there are {len(self.lengths)} joints")
        return self

    @property
    def rows(self) -> tuple[str, ...]:
        """What moves: x and y, perhaps φ."""
        return ("x", "y", "φ") if self.orientation else ("x", "y")

    @property
    def square(self) -> bool:
        """Whether J has as many rows as columns."""
        return len(self.rows) == len(self.lengths)


def draw(level: int, rng: Draws) -> Given:
    """Two links at right angles; then at others, sometimes stretched out; then three links with the orientation."""
    count = 3 if level == 3 else 2
    first, second, *rest = draw_angles(rng, level, count)
    if level > 1 and rng.chance(Fraction(1, 3)):
        second = rng.choice(_STRAIGHT)
    lengths = tuple(rng.whole(1, 3) for _ in range(count))
    rates = tuple(rng.nonzero(-2, 3) for _ in range(count))
    return Given(lengths=lengths, angles=(first, second, *rest), rates=rates, orientation=level == 3)


def question(given: Given) -> Question:
    """J, then the velocity, then the singularity where J is square."""
    m, n = len(given.rows), len(given.lengths)
    rates = ", ".join(f"ω_{index} = {shown(rate)}" for index, rate in enumerate(given.rates, 1))
    moves = "the end point $(x, y)$ and the angle $φ$ of the last link against the $x$ axis" if given.orientation else (
        "the end point $(x, y)$ of the last link"
    )  # fmt: skip
    velocity = tuple(f"v_{row}" for row in given.rows)
    parts = [
        Part("What is $J$ at this configuration?", Matrix(m, n)),
        Part(f"What is the velocity $({', '.join(velocity)})$?", Numbers(velocity), zero=True),
    ]
    if given.square:
        parts.append(Part("Is the configuration singular, that is, is $det J = 0$?", YesNo()))
    return Question(
        (
            *situation(given),
            Paragraph(
                f"The Jacobian $J$ has the derivatives of {moves} by the joint angles: one row for each of "
                f"${', '.join(given.rows)}$, one column for each joint. The joints turn with the angular velocities "
                f"${rates}$."
            ),
        ),
        tuple(parts),
    )
