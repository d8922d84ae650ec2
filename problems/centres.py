"""A state in space and the centres of basis functions, as problems give them."""

from collections.abc import Iterable
from fractions import Fraction
from typing import Literal, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, Weight, shown
from rldrill.problems.family import Givens
from rldrill.problems.pictures import Bumps

Point = tuple[Exact, ...]

#: Steps across and up, by the length of the way; the lengths are whole, and then roots.
_WHOLE = {1: ((0, 1), (1, 0)), 2: ((0, 2), (2, 0)), 3: ((0, 3), (3, 0)), 5: ((3, 4), (4, 3))}
_ROOTS = {2: ((1, 1),), 5: ((1, 2), (2, 1)), 8: ((2, 2),), 10: ((1, 3), (3, 1)), 13: ((2, 3), (3, 2))}


class Centred(Givens):
    """A state as its coordinates, and the centres of the features."""

    position: Point = Field(min_length=1, max_length=10, description="The coordinates of the state.")
    centres: tuple[Point, ...] = Field(min_length=1, max_length=20, description="The coordinates of every centre.")

    @model_validator(mode="after")
    def _one_space(self) -> Self:
        for number, centre in enumerate(self.centres, 1):
            if len(centre) != len(self.position):
                raise ValueError(
                    f"centres: number {number} has {len(centre)} coordinates, but position has {len(self.position)}"
                )
        return self


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


def bumps(given: Centred, width: Weight, shape: Literal["gaussian", "tent"]) -> tuple[Bumps, ...]:
    """The features over the state axis, if the state is on a line and their width is a number."""
    if len(given.position) > 1 or isinstance(width, Parameter):
        return ()
    (state,), centres = given.position, tuple(float(centre) for (centre,) in given.centres)
    return (Bumps(centres, float(width), shape, float(state)),)


def place(given: Centred) -> Paragraph:
    """The sentence that says where the state is."""
    what = "position" if len(given.position) == 1 else "position in the plane" if len(given.position) == 2 else "state"
    return Paragraph(
        f"The state of a robot is its {what}, $s = {point(given.position)}$. The features have these centres:"
    )


def draw_on_a_line(rng: Draws, distances: Iterable[int | Fraction]) -> Centred:
    """A state on a line, and centres at these distances from it, to its left or right."""
    state = rng.whole(1, 6)
    return Centred(position=(state,), centres=tuple((state + rng.choice((1, -1)) * far,) for far in distances))


def draw_in_the_plane(rng: Draws, whole: int, roots: int) -> Centred:
    """A state in the plane, and centres: so many at whole distances, so many at distances that are roots."""
    near = {length: steps for length, steps in _WHOLE.items() if not roots or length < 5}
    ways = [*rng.shuffled(tuple(near.values()))[:whole], *rng.shuffled(tuple(_ROOTS.values()))[:roots]]
    state = (rng.whole(-1, 3), rng.whole(-1, 3))
    centres = []
    for steps in rng.shuffled(ways):
        across, up = rng.choice(steps)
        centres.append((state[0] + rng.choice((1, -1)) * across, state[1] + rng.choice((1, -1)) * up))
    return Centred(position=state, centres=tuple(centres))
