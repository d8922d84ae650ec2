"""Radial basis functions: the features of a state for several centres; or the width or the state from some of them."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from rldrill.problems.centres import (
    Centred,
    asked_features,
    bumps,
    centres_table,
    check_known,
    check_line,
    draw_in_the_plane,
    draw_on_a_line,
    feature_names,
    place,
    square,
    value_block,
)
from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, WidthField, shown
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.names import once, read_whole
from rldrill.problems.parts import Number, Part
from rldrill.problems.phrases import in_open

TITLE = "Radial basis functions"
SOURCE = "Sutton & Barto 2018, section 9.5.5"
REVISION = 7


class Given(Centred):
    """The state, the centres, and the width σ of all features, which may be left open.

    One of state and width may be left out: it is then to be found from features that are known.
    """

    sigma: WidthField | None = Field(default=None, description="The width of all features, above 0.")
    logarithms: Annotated[dict[int, Exact], once(read_whole)] = Field(
        default={},
        max_length=20,
        exclude_if=lambda known: not known,
        description="The logarithms of the known features by the numbers of their centres: one without the width, two "
        "without the state.",
        examples=[{"1": "-1/2"}],
    )
    theta: tuple[Exact, ...] = Field(
        default=(),
        max_length=20,
        exclude_if=lambda theta: not theta,
        description="The weights of the features, where the value of the state is asked for, too.",
        examples=[["2", "-1"]],
    )

    @model_validator(mode="after")
    def _wide(self) -> Self:
        if isinstance(self.sigma, Fraction) and self.sigma <= 0:
            raise ValueError(f"sigma: the width must be above 0, not {self.sigma}")
        if self.sigma is None and self.position is None:
            raise ValueError("give the width or the position; both cannot be found")
        check_known(self.logarithms, self.centres, 2 if self.position is None else 1 if self.sigma is None else 0)
        if self.position is None:
            check_line(self.centres)
            if isinstance(self.sigma, Parameter):
                raise ValueError("sigma: the position can only be found where it is a number")
        if not all(value < 0 for value in self.logarithms.values()):
            raise ValueError("logarithms: a feature that tells how far away the state is lies between 0 and 1")
        if self.theta and self.logarithms:
            raise ValueError("theta: a value is asked for where all features are worked out; leave logarithms out")
        if self.theta and len(self.theta) != len(self.centres):
            raise ValueError(f"theta: {len(self.centres)} features need as many weights, not {len(self.theta)}")
        return self


#: Steps to a centre in the plane, in one direction and in two.
_STRAIGHT = ((0, 1), (0, 2), (0, 3))
_SLANTED = ((1, 1), (1, 2), (2, 2), (1, 3), (2, 3), (3, 4))


def draw(level: int, rng: Draws) -> Given:
    """Two centres on a line; then three, or the plane, or a value; then the width or the state is found."""
    if level == 3:
        return rng.choice((_width_sought, _state_sought))(rng)
    if level == 1:
        centred = draw_on_a_line(rng, rng.distinct(2, 1, 4))
    elif rng.choice((True, False)):
        centred = draw_on_a_line(rng, rng.distinct(3, 1, 4))
    else:
        steps = (*rng.shuffled(_STRAIGHT)[: rng.choice((1, 2))], rng.choice(_SLANTED))
        centred = draw_in_the_plane(rng, steps)
    valued = level == 2 and rng.choice((True, False))
    return Given(
        position=centred.position,
        centres=centred.centres,
        sigma=rng.whole(3, 4) if level == 1 else Fraction(3),  # of 2 the square is the double
        theta=tuple(rng.nonzero(-3, 5) for _ in centred.centres) if valued else (),
    )


def _width_sought(rng: Draws) -> Given:
    """One feature tells the width, and with it the others."""
    sigma = rng.whole(4, 6)
    if rng.choice((True, False)):
        centred = draw_on_a_line(rng, rng.distinct(3, 1, 5))
    else:
        centred = draw_in_the_plane(
            rng, (rng.choice((*_STRAIGHT, _SLANTED[-1])), *rng.shuffled(_SLANTED[:-1])[: rng.choice((1, 2))])
        )
    squares = [square(centred.position or (), centre) for centre in centred.centres]
    number = rng.choice([n for n, far in enumerate(squares, 1) if far in (1, 4, 9, 16, 25)])
    return Given(
        position=centred.position, centres=centred.centres, logarithms={number: -squares[number - 1] / (2 * sigma**2)}
    )


def _state_sought(rng: Draws) -> Given:
    """Two features tell the state, on one side of both centres or between them, and with it the third."""
    count = rng.choice((3, 4))
    sigma, far = rng.whole(4, 6), rng.distinct(count, 1, 6)
    centred = draw_on_a_line(rng, far)
    known = {number: -(far[number - 1] ** 2) / (2 * sigma**2) for number in rng.sample(range(1, count + 1), 2)}
    return Given(centres=centred.centres, sigma=sigma, logarithms=known)


def question(given: Given) -> Question:
    """The centres with the state and the width, or known features in the place of one; what follows is asked for."""
    width = "σ" if given.sigma is None or isinstance(given.sigma, Parameter) else f"σ = {shown(given.sigma)}"
    known = [
        f"{name} = exp({shown(value)})"
        for name, value in zip(feature_names(given.logarithms), given.logarithms.values(), strict=True)
    ]
    blocks = (
        place(given),
        centres_table(given.centres),
        Paragraph(
            "All features are Gaussian radial basis functions of the Euclidean distance from their centres, of height "
            f"$1$ and standard deviation ${width}$."
            + (" Here $σ > 0$ is left open." if isinstance(given.sigma, Parameter) else "")
            + (f" It is known that ${'$ and $'.join(known)}$." if known else "")
        ),
        *bumps(given, given.sigma, "gaussian"),
        *value_block(given.theta),
    )
    parts = [
        *([Part("What is the standard deviation $σ$?", Number())] if given.sigma is None else []),
        *([Part("What is the state $s$?", Number(), zero=True)] if given.position is None else []),
        *(
            [asked_features(given, given.logarithms, in_open(given))]
            if len(given.logarithms) < len(given.centres)
            else []
        ),
        *([Part(f"What is the value $V̂(s)${in_open(given)}?", Number(), zero=True)] if given.theta else []),
    ]
    return Question(blocks, tuple(parts))
