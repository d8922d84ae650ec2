"""The end point and the orientation of a planar arm."""

from fractions import Fraction

from pydantic import Field

from rldrill.problems.angles import AngleField, read_angle, text
from rldrill.problems.arms import PlanarArm, draw_angles, situation
from rldrill.problems.document import Block
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.parts import Number, Numbers, Part

TITLE = "Forward kinematics"
SOURCE = "Siciliano et al. 2009, section 2.9.1"
REVISION = 1


class Base(Givens):
    """Where the base of an arm is, and how its x axis is turned."""

    x: Exact = Field(default=Fraction(0), description="Where the base is along the x axis.", examples=[1])
    y: Exact = Field(default=Fraction(0), description="Where the base is along the y axis.", examples=[2])
    phi: AngleField = Field(
        default=read_angle(0), description="The angle of the base's x axis, in radians.", examples=["pi/6"]
    )


class Given(PlanarArm):
    """An arm; what is asked for is where its end is, and how it points; with ``frames`` those of every link."""

    base: Base | None = Field(
        default=None,
        description="The pose of the base; the origin, if left out.",
        examples=[{"x": 1, "y": 2, "phi": "pi/6"}],
    )
    frames: bool = Field(
        default=False,
        exclude_if=lambda frames: not frames,
        description="Whether the pose of every link's end is asked for, not of the last one alone.",
    )

    @property
    def asked(self) -> range:
        """The links whose ends are asked for."""
        count = len(self.lengths)
        return range(1 if self.frames else count, count + 1)


def draw(level: int, rng: Draws) -> Given:
    """Two links at right angles; then at angles with short sines; then three links."""
    count = 3 if level == 3 else 2
    lengths = tuple(rng.whole(1, 4) if level < 3 else rng.fraction("1", "2", "3", "4", "1/2") for _ in range(count))
    return Given(lengths=lengths, angles=draw_angles(rng, level, count))


def question(given: Given) -> Question:
    """Orientation, then position; of every link that is asked for."""
    if not given.frames:
        which = [("$φ$ of the last link", "$(x, y)$ of the last link", ("x", "y"))]
    else:
        which = [
            (f"$φ_{i}$ of link ${i}$", f"$(x_{i}, y_{i})$ of link ${i}$", (f"x_{i}", f"y_{i}")) for i in given.asked
        ]
    parts = []
    for angle, end, entries in which:
        parts += [
            Part(f"What is the angle {angle} against the $x$ axis, in radians?", Number(), zero=True),
            Part(f"Where is the end point {end}?", Numbers(entries), zero=given.frames),
        ]
    return Question(_situation(given), tuple(parts))


def _situation(given: Given) -> tuple[Block, ...]:
    if given.base is None:
        return situation(given)
    place = f"({shown(given.base.x)}, {shown(given.base.y)})"
    turned = f"its base is at ${place}$ with its own $x_0$ axis turned by $φ_0 = {text(given.base.phi)}$"
    return situation(given, f"{turned} against the $x$ axis", "x_0")
