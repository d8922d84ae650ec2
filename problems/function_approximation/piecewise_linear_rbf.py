"""Piecewise linear basis functions: the features of a state for several centres; or width or state from some."""

from math import ceil, isqrt
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
    tents,
    value_block,
)
from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, shown
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.names import once, read_whole
from rldrill.problems.parts import Number, Part

TITLE = "Piecewise linear RBF"
SOURCE = "Lecture sheet; triangular kernel"
REVISION = 5


class Given(Centred):
    """The state, the centres, and the width b at which the features reach 0.

    One of state and width may be left out: it is then to be found from features that are known.
    """

    width: Exact | None = Field(
        default=None, description="The distance from its centre at which a feature reaches 0, above 0."
    )
    known: Annotated[dict[int, Exact], once(read_whole)] = Field(
        default={},
        max_length=20,
        exclude_if=lambda known: not known,
        description="The known features by the numbers of their centres: one without the width, two without the state.",
        examples=[{"1": "1/2"}],
    )
    theta: tuple[Exact, ...] = Field(
        default=(),
        max_length=20,
        exclude_if=lambda theta: not theta,
        description="The weights of the features, where the value of the state is asked for, too.",
    )

    @model_validator(mode="after")
    def _wide(self) -> Self:
        if self.width is not None and self.width <= 0:
            raise ValueError(f"width: it must be above 0, not {self.width}")
        if self.width is None and self.position is None:
            raise ValueError("give the width or the position; both cannot be found")
        check_known(self.known, self.centres, 2 if self.position is None else 1 if self.width is None else 0)
        if self.position is None:
            check_line(self.centres)
        if not all(0 < value < 1 for value in self.known.values()):
            raise ValueError("known: a feature that tells how far away the state is lies between 0 and 1")
        if self.theta and self.known:
            raise ValueError("theta: a value is asked for where all features are worked out; leave known out")
        if self.theta and len(self.theta) != len(self.centres):
            raise ValueError(f"theta: {len(self.centres)} features need as many weights, not {len(self.theta)}")
        return self


#: Steps in the plane by the width, the first in both directions. Some are just outside: a step less, and they are not.
#: None are on the edge, where a feature is 0 whether it is cut off or not.
_WHOLE_STEPS = {
    "9/2": ((3, 4), (0, 1), (0, 3)), "6": ((3, 4), (0, 2), (0, 4)),
    "8": ((3, 4), (0, 4), (0, 6)), "19/2": ((3, 4), (0, 4), (6, 8)),
}  # fmt: skip
#: The same with distances that are roots; the second one never is.
_STEPS = {
    "9/2": ((1, 2), (0, 1), (3, 4)), "11/2": ((2, 3), (0, 3), (4, 4)), "4": ((1, 2), (0, 3), (3, 3)),
    "7": ((2, 4), (3, 4), (0, 4)), "8": ((1, 4), (3, 4), (0, 3)), "9": ((4, 5), (3, 4), (0, 7)),
}  # fmt: skip


#: Widths of features on a line: a whole distance just outside of one of the first kind is not on its edge.
_HALVES = {1: ("7/2", "9/2", "11/2"), 2: ("11/2", "13/2", "15/2"), 3: ("9/2", "11/2", "15/2", "21/2")}
_WHOLES = {1: ("3", "4", "5"), 2: ("5", "6", "7")}


def draw(level: int, rng: Draws) -> Given:
    """Centres on a line; then also in the plane, or the value of the state; then the width or the state is found.

    In about half of the draws the state lies just outside of one feature.
    """
    if level == 3:
        return rng.choice((_width_sought, _state_sought))(rng)
    valued = level == 2 and rng.choice((True, False))
    if level == 1 or rng.choice((True, False)):
        count = level + 1
        outside = not valued and rng.choice((True, False))
        width = rng.choice(_HALVES[level] if outside else (*_WHOLES[level], *_HALVES[level]))
        beyond = ceil(fraction_of(width))
        far: list[int | Fraction] = [
            *rng.distinct(min(count, beyond - 1), 1, beyond - 1),
            *([beyond] if outside else []),
        ]
        centred = draw_on_a_line(rng, rng.shuffled(far))
    else:
        width = rng.choice(("6", "8") if valued else tuple(_WHOLE_STEPS))
        centred = draw_in_the_plane(rng, _WHOLE_STEPS[width][: rng.choice((2, 3))] if valued else _WHOLE_STEPS[width])
    return Given(
        position=centred.position,
        centres=centred.centres,
        width=fraction_of(width),
        theta=tuple(rng.nonzero(-3, 5) for _ in centred.centres) if valued else (),
    )


def _width_sought(rng: Draws) -> Given:
    """One feature tells the width, and with it the others."""
    if rng.choice((True, False)):
        width = fraction_of(rng.choice(_HALVES[3]))
        beyond = ceil(width)
        centred = draw_on_a_line(rng, rng.shuffled((*rng.distinct(rng.choice((2, 3)), 1, beyond - 1), beyond)))
    else:
        text = rng.choice(tuple(_STEPS))
        width, centred = fraction_of(text), draw_in_the_plane(rng, _STEPS[text])
    squares = [square(centred.position or (), centre) for centre in centred.centres]
    number = rng.choice([n for n, far in enumerate(squares, 1) if far < width**2 and isqrt(int(far)) ** 2 == far])
    known = {number: 1 - isqrt(int(squares[number - 1])) / width}
    return Given(position=centred.position, centres=centred.centres, known=known)


def _state_sought(rng: Draws) -> Given:
    """Two features tell the state, on one side of both centres or between them, and with it the third."""
    width, count = rng.whole(6, 12), rng.choice((3, 4))
    far = rng.distinct(count, 1, int(width) - 1)
    if rng.choice((True, False)):
        width = fraction_of(rng.choice(_HALVES[3]))
        far = (*rng.distinct(count - 1, 1, ceil(width) - 1), Fraction(ceil(width)))
    centred = draw_on_a_line(rng, far)
    inside = [n for n, distance in enumerate(far, 1) if distance < width]
    known = {number: 1 - far[number - 1] / width for number in rng.sample(inside, 2)}
    if len(set(centred.centres)) < len(far):
        return _state_sought(rng)
    return Given(centres=centred.centres, width=width, known=known)


def question(given: Given) -> Question:
    """The centres with the state and the width, or known features in the place of one; what follows is asked for."""
    known = [
        f"{name} = {shown(value)}" for name, value in zip(feature_names(given.known), given.known.values(), strict=True)
    ]
    blocks = (
        place(given),
        centres_table(given.centres),
        Paragraph(tents(given.width) + (f" It is known that ${'$ and $'.join(known)}$." if known else "")),
        *bumps(given, given.width, "tent"),
        *value_block(given.theta),
    )
    parts = [
        *([Part("What is the width $b$?", Number())] if given.width is None else []),
        *([Part("What is the state $s$?", Number(), zero=True)] if given.position is None else []),
        *([asked_features(given, given.known)] if len(given.known) < len(given.centres) else []),
        *([Part("What is the value $V̂(s)$?", Number(), zero=True)] if given.theta else []),
    ]
    return Question(blocks, tuple(parts))
