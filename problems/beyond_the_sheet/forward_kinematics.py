"""The end point and the orientation of a planar arm."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.angles import Angle, JointField, degrees, read_angle, text
from rldrill.problems.arms import PlanarArm, draw_angles, situation
from rldrill.problems.document import Block
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, shown
from rldrill.problems.family import AskedFor, Givens, Question, flag
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.parts import Number, Numbers, Part

TITLE = "Forward kinematics"
SOURCE = "Siciliano et al. 2009, section 2.9.1"
REVISION = 3


class Base(Givens):
    """Where the base of an arm is, and how its x axis is turned."""

    x: Exact = Field(default=Fraction(0), description="Where the base is along the x axis.", examples=[1])
    y: Exact = Field(default=Fraction(0), description="Where the base is along the y axis.", examples=[2])
    phi: JointField = Field(
        default=read_angle(0), description="The angle of the base's x axis, in radians.", examples=["pi/6"]
    )


class Given(AskedFor, PlanarArm):
    """An arm; what is asked for is where its end is, and how it points; with ``frames`` those of every link.

    With ``x``, that of the end point, the length of a link is left open and found from it; then y is asked for.
    """

    base: Base | None = Field(
        default=None,
        description="The pose of the base; the origin, if left out.",
        examples=[{"x": 1, "y": 2, "phi": "pi/6"}],
    )
    frames: bool = flag("Whether the pose of every link's end is asked for, not of the last one alone.")

    x: Exact | None = Field(
        default=None, description="The x of the end point, from which a length that is left open as w is found."
    )

    @model_validator(mode="after")
    def _found(self) -> Self:
        if (self.x is None) == bool(self.left_open):
            raise ValueError("x: it goes with a length that is left open, such as w")
        if self.x is not None and (self.frames or self.base is not None):
            raise ValueError("x: a length is found for an arm at the origin, without frames")
        return self

    @property
    def asked(self) -> range:
        """The links whose ends are asked for."""
        count = len(self.lengths)
        return range(1 if self.frames else count, count + 1)


def draw(level: int, rng: Draws) -> Given:
    """Two links at right angles; then at others, three links or a base; then a length to be found."""
    if level == 3 and rng.chance(Fraction(3, 4)):
        return _to_find(rng)
    kind = rng.choice({1: ("plain",), 2: ("plain", "three", "base"), 3: ("base",)}[level])
    count = 3 if level == 3 or kind == "three" else 2
    lengths = rng.distinct(count, 1, 4)
    base = None
    if kind == "base":
        base = Base(x=rng.nonzero(-2, 3), y=rng.nonzero(-2, 3), phi=read_angle(rng.choice(("pi/6", "pi/3", "-pi/6"))))
    angles = draw_angles(rng, level, count, diagonal=base is None)
    return Given(lengths=lengths, angles=angles, base=base)


def _to_find(rng: Draws) -> Given:
    """An arm all of whose angles are multiples of 60°, so that x is rational, with the length of a link left open."""
    count = 2 + rng.below(2)
    lengths = rng.distinct(count, 1, 5)
    turns = [rng.nonzero(-2, 3)] + [rng.nonzero(-2, 2) for _ in range(count - 1)]
    x, turned = Fraction(0), Fraction(0)
    for length, turn in zip(lengths, turns, strict=True):
        turned += turn
        x += length * _COSINES[int(turned) % 6]
    angles = tuple(Angle(turn / 3, of_pi=True) for turn in turns)
    place = rng.below(count)
    open_ = tuple(Parameter("w") if index == place else length for index, length in enumerate(lengths))
    return Given(lengths=open_, angles=angles, x=x)


#: Of the multiples of 60°.
_COSINES = tuple(map(fraction_of, ("1", "1/2", "-1/2", "-1", "-1/2", "1/2")))


def question(given: Given) -> Question:
    """Orientation, then position; of every link that is asked for."""
    if not given.frames:
        which = [("$φ$ of the last link", "$(x, y)$ of the last link", ("x", "y"))]
    else:
        which = [
            (f"$φ_{i}$ of link ${i}$", f"$(x_{i}, y_{i})$ of link ${i}$", (f"x_{i}", f"y_{i}")) for i in given.asked
        ]
    if given.x is not None:
        ask = f"One length, $w$, is unknown. The end point of the last link has $x = {shown(given.x)}$. What is $w$?"
        return Question(
            _situation(given), (Part(ask, Number()), Part("What is the $y$ coordinate of this end point?", Number()))
        )
    parts = []
    for angle, end, entries in which:
        parts += [
            Part(
                f"What is the angle {angle} relative to the $x$ axis, in radians, with no full turns added or "
                "subtracted?",
                Number(),
                zero=True,
            ),
            Part(f"Where is the end point {end}?", Numbers(entries), zero=given.frames),
        ]
    return Question(_situation(given), tuple(parts))


def _situation(given: Given) -> tuple[Block, ...]:
    if given.base is None:
        return situation(given)
    place = f"({shown(given.base.x)}, {shown(given.base.y)})"
    turned = f"its base is at $(x_B, y_B) = {place}$ with its own $x_0$ axis turned by $φ_0 = {text(given.base.phi)}$"
    return situation(given, f"{turned} relative to the $x$ axis", "x_0", degrees(given.base.phi))
