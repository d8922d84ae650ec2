"""A state in space and the centres of basis functions, as problems give them."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, Weight, shown
from rldrill.problems.family import Givens
from rldrill.problems.features import weights
from rldrill.problems.fractions import Fraction
from rldrill.problems.parts import Numbers, Part
from rldrill.problems.pictures import Bumps

Point = Annotated[tuple[Exact, ...], Field(max_length=10)]


class Centred(Givens):
    """A state as its coordinates, and the centres of the features; without it, some features are known instead."""

    position: Point | None = Field(default=None, min_length=1, description="The coordinates of the state.")
    centres: tuple[Point, ...] = Field(min_length=1, max_length=20, description="The coordinates of every centre.")

    @model_validator(mode="after")
    def _one_space(self) -> Self:
        size, whose = (len(self.centres[0]), "number 1") if self.position is None else (len(self.position), "position")
        for number, centre in enumerate(self.centres, 1):
            if len(centre) != size:
                raise ValueError(f"centres: number {number} has {len(centre)} coordinates, but {whose} has {size}")
        return self


def check_known(known: Mapping[int, object], centres: Sequence[Point], needed: int) -> None:
    """Demand so many known features, each of a centre that there is.

    Raises:
        ValueError: there are more or fewer, or one is of no centre.
    """
    if len(known) != needed:
        raise ValueError(f"known: {needed} of the features must be known, not {len(known)}")
    for number in known:
        if number not in range(1, len(centres) + 1):
            raise ValueError(f"known: there is no centre number {number}")


def check_line(centres: Sequence[Point]) -> None:
    """Demand centres on a line, on which a state can be found.

    Raises:
        ValueError: they are in the plane or in space.
    """
    if len(centres[0]) > 1:
        raise ValueError("position: it can only be found on a line; give it, or centres with one coordinate")


def point(coordinates: Point) -> str:
    """A point as mathematics: (1, 2), or a number alone."""
    written = ", ".join(map(shown, coordinates))
    return written if len(coordinates) == 1 else f"({written})"


def centres_table(centres: tuple[Point, ...]) -> Table:
    """One column for every centre."""
    return Table(
        header=("$i$", *(f"${number}$" for number in range(1, len(centres) + 1))),
        rows=(("$c_i$", *(f"${point(centre)}$" for centre in centres)),),
    )


def bumps(given: Centred, width: Weight | None, shape: Literal["gaussian", "tent"]) -> tuple[Bumps, ...]:
    """The features over the state axis, if the state is on a line and it and their width are numbers."""
    if given.position is None or len(given.position) > 1 or width is None or isinstance(width, Parameter):
        return ()
    (state,), centres = given.position, tuple(float(centre) for (centre,) in given.centres)
    return (Bumps(centres, float(width), shape, float(state)),)


def place(given: Centred) -> Paragraph:
    """The sentence that says where the state is."""
    if given.position is None:
        return Paragraph("The state $s$ of a robot is its position on a line. The features have these centres:")
    what = "position" if len(given.position) == 1 else "position in the plane" if len(given.position) == 2 else "state"
    return Paragraph(
        f"The state of a robot is its {what}, $s = {point(given.position)}$. The features have these centres:"
    )


def feature_names(numbers: Iterable[int]) -> tuple[str, ...]:
    """What features are called, by the numbers of their centres."""
    return tuple(f"φ_{{{number}}}(s)" for number in numbers)


def asked_features(given: Centred, known: Collection[int], opened: str = "") -> Part:
    """The features that are not known already."""
    names = feature_names(number for number in range(1, len(given.centres) + 1) if number not in known)
    if len(names) == 1:
        return Part(f"What is the feature ${names[0]}${opened}?", Numbers(names), zero=True)
    what = "the other features" if known else "the features"
    return Part(f"What are {what} ${', '.join(names)}${opened}?", Numbers(names), zero=True)


def tents(width: Fraction | None) -> str:
    """The sentence that says what piecewise linear basis functions are."""
    far = "b" if width is None else f"b = {shown(width)}"
    return (
        "All features are piecewise linear radial basis functions: each is $1$ at its centre, falls linearly "
        f"with the Euclidean distance from it, and is $0$ from the distance ${far}$ on."
    )


def value_block(theta: Sequence[Fraction]) -> tuple[Paragraph, ...]:
    """The sentence on the value of a state that is linear in its features, if there is one."""
    if not theta:
        return ()
    return (Paragraph(f"Values are estimated as $V̂(s) = θ^⊤ φ(s)$, with the weights ${weights(theta)}$."),)


def square(state: Point, centre: Point) -> Fraction:
    """The square of the distance between two points."""
    return sum(((x - y) ** 2 for x, y in zip(state, centre, strict=True)), Fraction(0))


def draw_on_a_line(rng: Draws, distances: Iterable[int | Fraction]) -> Centred:
    """A state on a line, and centres at these distances from it, to its left or right."""
    state = rng.whole(1, 6)
    return Centred(position=(state,), centres=tuple((state + rng.choice((1, -1)) * far,) for far in distances))


def draw_in_the_plane(rng: Draws, steps: Sequence[tuple[int, int]]) -> Centred:
    """A state in the plane, and centres so many steps away in both directions, in any order and to any side."""
    state = (rng.whole(-1, 3), rng.whole(-1, 3))
    centres = []
    for way in rng.shuffled(steps):
        across, up = rng.shuffled(way)
        centres.append((state[0] + rng.choice((1, -1)) * across, state[1] + rng.choice((1, -1)) * up))
    return Centred(position=state, centres=tuple(centres))
