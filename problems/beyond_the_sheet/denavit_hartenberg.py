"""The transforms of an arm's links from their Denavit-Hartenberg parameters, and their product."""

import tomllib
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from pydantic import Field

from rldrill.problems import robots
from rldrill.problems.angles import AngleField, read_angle, text
from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.parts import Matrix, Part

TITLE = "Denavit-Hartenberg transforms"
SOURCE = "Siciliano et al. 2009, section 2.8.2"
REVISION = 1


class Link(Givens):
    """The parameters of one link: angle and offset along z, length and twist along the new x."""

    theta: AngleField = Field(description="The angle of the joint about z, in radians.")
    d: Exact = Field(description="The offset along z.")
    a: Exact = Field(description="The length of the link along the new x.")
    alpha: AngleField = Field(description="The twist of the link about the new x, in radians.")


class Given(Givens):
    """The links from the base outwards, and what the arm is called."""

    links: tuple[Link, ...] = Field(min_length=1, max_length=7, description="The links from the base outwards.")
    name: str = Field(
        default="an arm", max_length=60, pattern=r"^[^$\\]*$", description="What the arm is called in the question."
    )


@cache
def _arms() -> tuple[Mapping[str, Any], ...]:
    with (Path(robots.__file__).parent / "robots.toml").open("rb") as file:
        return tuple(tomllib.load(file)["arm"])


def draw(level: int, rng: Draws) -> Given:
    """The first link of an arm; then its first two; then three."""
    if level == 1:
        theta = read_angle(rng.choice(("pi/2", "-pi/2", "pi/3", "pi/6", "2*pi/3")))
        link = Link(theta=theta, d=rng.whole(0, 3), a=rng.whole(1, 4), alpha=read_angle(rng.choice(("pi/2", "-pi/2"))))
        return Given(links=(link,))
    arm = rng.choice(_arms())
    links = tuple(Link(**{name: rng.choice(texts) for name, texts in row.items()}) for row in arm["links"][:level])
    return Given(links=links, name=arm["name"])


def question(given: Given) -> Question:
    """The table of parameters; every link's transform, then the product."""
    count = len(given.links)
    rows = tuple(
        (f"${index}$", f"${text(link.theta)}$", f"${shown(link.d)}$", f"${shown(link.a)}$", f"${text(link.alpha)}$")
        for index, link in enumerate(given.links, 1)
    )
    asks = [(f"What is the transform $T_{index}$ of link ${index}$?", 1) for index in range(1, count + 1)]
    if count > 1:
        product = " ".join(f"T_{index}" for index in range(1, count + 1))
        asks.append((f"What is the transform $T = {product}$ from the base to the last link?", 2))
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
        ),
        tuple(Part(ask, Matrix(4, 4), points=points) for ask, points in asks),
    )
