"""The Jacobian of a planar arm, the velocity of its end, and whether the configuration is singular."""

from itertools import accumulate
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.angles import Angle, read_angle
from rldrill.problems.arms import PlanarArm, draw_angles, situation
from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, shown
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.parts import Matrix, Numbers, Part, YesNo

TITLE = "Jacobian of an arm"
SOURCE = "Siciliano et al. 2009, section 3.2.1"
REVISION = 7

_STRAIGHT = (read_angle("0"), read_angle("pi"))


class Given(PlanarArm):
    """An arm and its joint velocities; with ``orientation`` the last link's angle is the third row of J.

    With ``velocity`` in place of ``rates`` the joint velocities are asked for that move the end like this.
    """

    rates: tuple[Exact, ...] | None = Field(
        default=None,
        max_length=6,
        description="The angular velocity of every joint, in radians a second.",
        examples=[[1, -2]],
    )
    velocity: tuple[Exact, ...] | None = Field(
        default=None,
        max_length=2,
        description="The velocity of the end point, from which the rates are found.",
        examples=[[1, 0]],
    )
    orientation: bool = Field(
        default=False, description="Whether the angle of the last link is the third row of the Jacobian."
    )

    @model_validator(mode="after")
    def _rates_fit(self) -> Self:
        if self.parameters():
            raise ValueError("lengths: give a number for every link here")
        if (self.rates is None) == (self.velocity is None):
            raise ValueError("give either rates, the joints' velocities, or velocity, that of the end point")
        if self.rates is not None and len(self.rates) != len(self.lengths):
            raise ValueError(f"rates holds {len(self.rates)}, but there are {len(self.lengths)} joints")
        if self.velocity is not None and not len(self.velocity) == len(self.rows) == len(self.lengths):
            raise ValueError("velocity: it needs as many entries as the Jacobian has rows, and as many joints")
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
    """Two links, perhaps in a line; then at other angles, or three; then with the orientation, or the joints' rates."""
    singular = rng.chance(Fraction(1, 2))
    count = 3 if level > 1 and rng.chance(Fraction(level - 1, 4)) else 2
    lengths = rng.distinct(count, 1, 4 if level < 3 else 6)
    rates = _rates(rng, count)
    if level == 3 and count == 2:
        first, second = rng.choice(_DIAGONAL), rng.choice(_RIGHT)
        return Given(lengths=lengths, angles=(first, second), velocity=_moved(lengths, (first, second), rates))
    first, second, *rest = draw_angles(rng, max(level, 2), count)
    if level == 1:
        first, second = rng.choice(_SLANTED), rng.choice(_RIGHT)
    if singular:
        second = rng.choice(_STRAIGHT)
    return Given(lengths=lengths, angles=(first, second, *rest), rates=rates, orientation=level == 3)


def _rates(rng: Draws, count: int) -> tuple[Fraction, ...]:
    """Rates with which every link turns: with a sum of 0 one keeps its direction, whatever its length and angle."""
    rates = tuple(rng.shuffled(_RATES)[:count])
    return rates if all(accumulate(rates)) else _rates(rng, count)


_RATES = tuple(map(Fraction, (-2, -1, 1, 2, 3)))
_RIGHT = tuple(map(read_angle, ("pi/2", "-pi/2")))
_DIAGONAL = tuple(map(read_angle, ("pi/4", "3*pi/4", "-pi/4", "-3*pi/4")))
_SLANTED = tuple(map(read_angle, ("pi/6", "pi/3", "2*pi/3", "5*pi/6", "-pi/6", "-pi/3")))


def _moved(
    lengths: tuple[Fraction, ...], angles: tuple[Angle, ...], rates: tuple[Fraction, ...]
) -> tuple[Fraction, Fraction]:
    """The velocity of the end of an arm along the diagonals, if its joints turn √2 times as fast as these rates."""
    eighths, turning, velocity = 0, Fraction(0), (Fraction(0), Fraction(0))
    for length, angle, rate in zip(lengths, angles, rates, strict=True):
        eighths = (eighths + int(angle.number * 4)) % 8
        turning += rate
        cosine, sine = (1, -1, -1, 1)[eighths // 2], (1, 1, -1, -1)[eighths // 2]  # times √2
        velocity = (velocity[0] - length * sine * turning, velocity[1] + length * cosine * turning)
    return velocity


def question(given: Given) -> Question:
    """J, then the velocity, then the singularity where J is square."""
    m, n = len(given.rows), len(given.lengths)
    rates = ", ".join(f"ω_{index} = {shown(rate)}" for index, rate in enumerate(given.rates or (), 1))
    angle = "and the angle $φ$ of the last link relative to the $x$ axis"
    moves = f"the end point $(x, y)$ {angle}" if given.orientation else "the end point $(x, y)$ of the last link"
    velocity = tuple(f"v_{row}" for row in given.rows)
    turned = f" The joints turn with the angular velocities ${rates}$." if rates else ""
    parts = [Part("What is $J$ at this configuration?", Matrix(m, n))]
    if given.velocity is not None:
        wanted = ", ".join(map(shown, given.velocity))
        entries = tuple(f"ω_{index}" for index in range(1, n + 1))
        ask = (
            f"The velocity of the end is to be $({', '.join(velocity)}) = ({wanted})$. What angular velocities "
            f"${', '.join(entries)}$ of the joints achieve this?"
        )
        parts.append(Part(ask, Numbers(entries), zero=True))
    else:
        parts.append(
            Part(f"What is the velocity $({', '.join(velocity)})$ of the end point?", Numbers(velocity), zero=True)
        )
    if given.square and given.velocity is None:
        parts.append(Part("Is the configuration singular, that is, is $det J = 0$?", YesNo()))
    return Question(
        (
            *situation(given),
            Paragraph(
                f"The Jacobian $J$ has the derivatives of {moves} with respect to the joint angles: one row for each "
                f"of ${', '.join(given.rows)}$, one column for each joint.{turned}"
            ),
        ),
        tuple(parts),
    )
