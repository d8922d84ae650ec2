"""The transforms of an arm's links from their Denavit-Hartenberg parameters, and their product."""

import tomllib
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any, ClassVar, Literal, Self

from pydantic import Field, model_validator

from rldrill.problems import robots
from rldrill.problems.angles import JointField, read_angle, text
from rldrill.problems.document import Block, Equation, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, dot, shown
from rldrill.problems.family import Givens, Question, flag
from rldrill.problems.fractions import Fraction
from rldrill.problems.mathematics import mathematics
from rldrill.problems.matrices import MatrixField, check_shape, tabular
from rldrill.problems.parts import Matrix, Numbers, Part

TITLE = "Denavit-Hartenberg transforms"
SOURCE = "Siciliano et al. 2009, section 2.8.2"
REVISION = 3


class Link(Givens):
    """The parameters of one link: angle and offset along z, length and twist along the new x."""

    theta: JointField = Field(description="The angle of the joint about z, in radians.")
    d: Exact = Field(description="The offset along z.")
    a: Exact = Field(description="The length of the link along the new x.")
    alpha: JointField = Field(description="The twist of the link about the new x, in radians.")


class Given(Givens):
    """The links from the base outwards, and what the arm is called.

    With ``frames`` the pose of every link's frame is asked for, not of the last one alone. With ``asked`` it is not the
    transforms that are asked for: of the ``pose`` the rotation and the origin; of a ``point`` that is given in the last
    frame its coordinates in every frame before it; of one that is given in the base's (``back``) those in every frame
    after it.
    """

    OWN: ClassVar[str] = "a"

    links: tuple[Link, ...] = Field(min_length=1, max_length=7, description="The links from the base outwards.")
    name: str = Field(
        default="an arm", max_length=60, pattern=r"^[^$\\]*$", description="What the arm is called in the question."
    )
    base: MatrixField | None = Field(
        default=None,
        description="The 4×4 transform of the base's frame to the world's; none if left out.",
        examples=[[[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 1], [0, 0, 0, 1]]],
    )
    frames: bool = flag("Whether the pose of every link's frame is asked for, not of the last one alone.")

    asked: Literal["transforms", "pose", "point", "back"] = Field(
        default="transforms",
        exclude_if=lambda asked: asked == "transforms",
        description="What is asked for: all transforms; rotation and origin of the last frame; the coordinates of a "
        "point of the last frame in those before it; or back, those of a point of the base's in all frames.",
    )
    point: tuple[Exact, Exact, Exact] | None = Field(
        default=None, description="The coordinates of the point, where one is asked for.", examples=[[1, 0, 2]]
    )

    @model_validator(mode="after")
    def _asked(self) -> Self:
        if (self.point is None) == (self.asked in ("point", "back")):
            raise ValueError("point: it is needed where the coordinates of a point are asked for, and only there")
        if self.asked != "transforms" and (self.frames or self.base is not None):
            raise ValueError("asked: with frames or a base only the transforms are asked for; leave them out")
        return self

    @model_validator(mode="after")
    def _placed(self) -> Self:
        if self.base is None:
            return self
        check_shape("base", self.base, 4, 4)
        *axes, last = self.base
        if list(last) != [0, 0, 0, 1]:
            raise ValueError("base: the last row of a transform is 0, 0, 0, 1; correct it")
        (a, b, c), (d, e, f), (g, h, i) = (line[:3] for line in axes)
        rows = ((a, b, c), (d, e, f), (g, h, i))
        turned = all(dot(rows[k], rows[m]) == (k == m) for k in range(3) for m in range(k + 1))
        if not turned or a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) != 1:
            raise ValueError("base: its 3×3 corner must be a rotation, whose rows are perpendicular and of length 1")
        return self

    @property
    def posed(self) -> range:
        """The links of which the pose is asked for; that of a first link without a base is its transform."""
        first, count = (1 if self.base else 2), len(self.links)
        return range(first if self.frames else max(first, count), count + 1)


@cache
def _arms() -> tuple[Mapping[str, Any], ...]:
    with (Path(robots.__file__).parent / "robots.toml").open("rb") as file:
        return tuple(tomllib.load(file)["arm"])


def draw(level: int, rng: Draws) -> Given:
    """The pose of one link; of two, or a point seen from two frames; a point through three links, or back."""
    if level == 1:
        theta = rng.choice(("pi/3", "pi/6", "2*pi/3", "-pi/3", "-pi/6", "5*pi/6"))
        alpha = rng.choice([twist for twist in ("pi/2", "-pi/2", "pi/3", "pi/6", "-pi/3") if twist != theta])
        d, a = rng.distinct(2, 1, 4)
        link = Link(theta=read_angle(theta), d=d, a=a, alpha=read_angle(alpha))
        return Given(links=(link,), asked="pose")
    arm = rng.choice(_arms())
    asked = rng.choice(("pose", "point") if level == 2 else ("point", "back", "back"))
    whole = level == 3 and (asked == "point" or rng.chance(Fraction(1, 2)))
    used = arm["links"] if whole else arm["links"][:2]
    rows = ({name: rng.choice(texts) for name, texts in row.items()} for row in used)
    links = tuple(map(Link.model_validate, rows))
    point = tuple(rng.nonzero(-2, 3) for _ in range(3)) if asked in ("point", "back") else None
    return Given(links=links, name=arm["name"], asked=asked, point=point)


def question(given: Given) -> Question:
    """The table of parameters; every link's transform, then the product."""
    count = len(given.links)
    rows = tuple(
        (f"${index}$", f"${text(link.theta)}$", f"${shown(link.d)}$", f"${shown(link.a)}$", f"${text(link.alpha)}$")
        for index, link in enumerate(given.links, 1)
    )
    asks = [f"What is the transform $T_{index}$ of link ${index}$?" for index in range(1, count + 1)]
    for link in given.posed:
        product = " ".join((*(["T_b"] if given.base else []), *(f"T_{index}" for index in range(1, link + 1))))
        asks.append(_pose(given, link, product))
    several = {1: "The link", 2: "The first two links", 3: "The first three links"}.get(count, "The links")
    return Question(
        (
            Paragraph(f"{several} of {given.name} {'has' if count == 1 else 'have'} these parameters:"),
            Table(("link $i$", "$θ_i$", "$d_i$", "$a_i$", "$α_i$"), rows),
            Paragraph(
                "In the standard convention of Denavit and Hartenberg link $i$ has the $4 × 4$ transform "
                '$T_i = "Rot"_z(θ_i) "Trans"_z(d_i) "Trans"_x(a_i) "Rot"_x(α_i)$, which takes coordinates of its own '
                "frame to the frame before it."
            ),
            *_base(given),
        ),
        tuple(Part(ask, Matrix(4, 4)) for ask in asks) if given.asked == "transforms" else tuple(_parts(given)),
    )


def _parts(given: Given) -> Iterator[Part]:
    """What is asked for in place of the transforms."""
    last = len(given.links)
    if given.asked == "pose":
        product = " ".join(f"T_{index}" for index in range(1, last + 1))
        head = "T" if last > 1 else "T_1"
        from_ = f" of the transform $T = {product}$ from the base to the last link" if last > 1 else " of $T_1$"
        yield Part(f"What is the rotation, the upper left $3 × 3$ corner{from_}?", Matrix(3, 3))
        yield Part(
            f"What is the origin of {_frame(last)}, the upper right column of ${head}$?", Numbers(("x", "y", "z")),
            zero=True,
        )  # fmt: skip
        return
    here = ", ".join(map(shown, given.point or ()))
    start, frames = (last, range(last - 1, -1, -1)) if given.asked == "point" else (0, range(1, last + 1))
    told = f"A point has the coordinates $p_{start} = ({here})^⊤$ in {_frame(start)}. "
    for frame in frames:
        yield Part(
            f"{told}What are its coordinates $p_{frame}$ in {_frame(frame)}?", Numbers(("x", "y", "z")), zero=True
        )
        told = ""


def _frame(link: int) -> str:
    return f"the frame of link ${link}$" if link else "the frame of the base"


def _pose(given: Given, link: int, product: str) -> str:
    if not given.frames and given.base is None:
        return f"What is the transform $T = {product}$ from the base to the last link?"
    seen = "world" if given.base else "base"
    which = f"of link ${link}$" if given.frames else "of the last link"
    return f"What is the transform $T = {product}$ that takes coordinates of the frame {which} to those of the {seen}?"


def _base(given: Given) -> tuple[Block, ...]:
    if given.base is None:
        return ()
    return (
        Paragraph("The base does not stand in the frame of the world; its coordinates are taken there by"),
        Equation(mathematics("T_b"), (tabular(given.base),), ("=",)),
    )
