"""Planar arms as problems give them."""

from collections.abc import Sequence
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.angles import Angle, JointField, degrees, read_angle, text
from rldrill.problems.document import Beside, Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Open, Parameter, shown
from rldrill.problems.family import Givens
from rldrill.problems.fractions import Fraction
from rldrill.problems.pictures import Arm

_RIGHT = tuple(map(read_angle, ("0", "pi/2", "pi", "-pi/2")))
_SLANTED = tuple(map(read_angle, ("pi/6", "pi/3", "pi/2", "2*pi/3", "-pi/6", "-pi/3", "-pi/2", "5*pi/6")))
_DIAGONAL = tuple(map(read_angle, ("pi/4", "pi/2", "3*pi/4", "-pi/4", "-pi/2")))


class PlanarArm(Givens):
    """The lengths of an arm's links, and its joint angles, each relative to the link before."""

    lengths: tuple[Open, ...] = Field(
        min_length=1, max_length=6, description="The lengths of the links, from the base outwards."
    )
    angles: tuple[JointField, ...] = Field(
        max_length=6,
        description="The angle of every joint in radians, counter-clockwise, each relative to the link before.",
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if len(self.angles) != len(self.lengths):
            raise ValueError(
                f"angles holds {len(self.angles)}, but there are {len(self.lengths)} links; give one for each"
            )
        known = [length for length in self.lengths if isinstance(length, Fraction)]
        if known and min(known) <= 0:
            raise ValueError(f"lengths: {min(known)} is not above 0; give one that is")
        return self

    @property
    def drawn(self) -> tuple[float, ...]:
        """The lengths of the picture, in which one that is left open is as good as any other."""
        return tuple(2.0 if isinstance(length, Parameter) else float(length) for length in self.lengths)


def draw_angles(rng: Draws, level: int, count: int, *, diagonal: bool = True) -> tuple[Angle, ...]:
    """Right angles; then multiples of 30°, or of 45° (``diagonal``), so that all sums have short sines."""
    if level == 1:
        return (rng.choice(_RIGHT), *(rng.choice((_RIGHT[1], _RIGHT[3])) for _ in range(count - 1)))
    angles: Sequence[Angle] = rng.choice((_SLANTED, _SLANTED, _DIAGONAL if diagonal else _SLANTED))
    return tuple(rng.choice(angles) for _ in range(count))


def situation(
    given: PlanarArm, base: str = "its base is at the origin", axis: str = "x", turned: float = 0.0
) -> tuple[Block, ...]:
    """The arm in words, its links, and a picture of it.

    Args:
        given: the arm.
        base: where its base is, in words.
        axis: from which axis the first link's angle counts.
        turned: by how many degrees that axis is turned.
    """
    rows = tuple(
        (f"${index}$", f"${shown(length)}$", f"${text(angle)}$")
        for index, (length, angle) in enumerate(zip(given.lengths, given.angles, strict=True), 1)
    )
    known = all(isinstance(length, Fraction) for length in given.lengths)
    scale = "" if known else " Figures of it are not to scale, since a length is not known."
    return (
        Paragraph(
            f"An arm with {len(rows)} link{'s' * (len(rows) > 1)} moves in the plane; {base}. Link $i$ has the length "
            f"$l_i$. $θ_1$ is the angle of the first link relative to the ${axis}$ axis; every other $θ_i$ is that of "
            f"link $i$ relative to the link before it. Angles are in radians, counter-clockwise.{scale}"
        ),
        Beside(
            (
                Table(("link $i$", "$l_i$", "$θ_i$"), rows),
                Arm(given.drawn, tuple(map(degrees, given.angles)), turned),
            )
        ),
    )
