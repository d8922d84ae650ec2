"""Distances from centres, as solvers need them, and by other means."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from rldrill.problems.centres import Centred
from rldrill.problems.exact import Scalar
from rldrill.solutions.exact import NoSolution, Value, equals, exact
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import at
from rldrill.solutions.sheet.function_approximation import (
    DISTANCE,
    DISTANCE_ON_A_LINE,
    LINEAR_STATE_VALUE,
    beside_a_centre,
)
from rldrill.solutions.softmax import by_number
from rldrill.solutions.work import Work


def distances(given: Centred, work: Work, position: Sequence[Value] = (), of: Iterable[int] = ()) -> dict[str, Any]:
    """Work out the distance from every centre; what comes back is known by the formulas' letters.

    Args:
        given: the centres, and the state where it is known.
        work: the working.
        position: the state where it was found.
        of: the numbers of the centres whose distances are needed; without them, of all.
    """
    position = tuple(map(exact, given.position)) if given.position else position
    numbers = tuple(of) or range(1, len(given.centres) + 1)
    if len(position) == 1:
        line: dict[str, Any] = {
            "place": position[0],
            "centre_at": {number: exact(value) for number, (value,) in enumerate(given.centres, 1)},
        }
        return {"s": "s", "distance": {number: work.step(DISTANCE_ON_A_LINE, i=number, **line) for number in numbers}}
    axes = range(1, len(position) + 1)
    known: dict[str, Any] = {
        "position": dict(zip(axes, position, strict=True)),
        "centre": {
            (number, axis): exact(value)
            for number, centre in enumerate(given.centres, 1)
            for axis, value in zip(axes, centre, strict=True)
        },
        "dimensions": tuple(axes),
    }
    return {"s": "s", "distance": {number: work.step(DISTANCE, i=number, **known) for number in numbers}}


def found(given: Centred, work: Work, distance: Mapping[int, Value]) -> Value:
    """The place on a line that is at these distances from two of the centres.

    Raises:
        NoSolution: there is none, or more than one.
    """
    sides = {}
    for number, far in distance.items():
        known = {"centre_at": {number: exact(given.centres[number - 1][0])}, "distance": {number: far}, "i": number}
        work.say(f"By $φ_{{{number}}}(s)$ the state is to the left or to the right of $c_{{{number}}}$:")
        sides[number] = tuple(
            work.step(side, label=f'"to the {way}"', **known)
            for way, side in zip(("left", "right"), beside_a_centre(), strict=True)
        )
    common = set.intersection(*map(set, sides.values()))
    if len(common) != 1:
        raise NoSolution("the known features do not fit exactly one state")
    (state,) = common
    work.say(f"Only $s {equals(state)}$ fits both.")
    return state


def value_of_state(work: Work, theta: Sequence[Scalar], features: Sequence[Value]) -> None:
    """Answer with the weighted sum of all features."""
    known = by_number([exact(weight) for weight in theta])
    phi = {(number, "s"): value for number, value in enumerate(features, 1)}
    work.answer(work.step(LINEAR_STATE_VALUE, s="s", phi=phi, **known))


def measured(given: Centred, position: Sequence[float] = ()) -> Array:
    """The distances in floating point."""
    state = np.array([at(value) for value in given.position] if given.position else position)
    centres = np.array([[at(value) for value in centre] for centre in given.centres])
    return np.asarray(np.linalg.norm(centres - state, axis=1))


def nearest(given: Centred, distance: Mapping[int, float]) -> float:
    """By trying: the place on a line that is at these distances from the centres."""
    places = [at(given.centres[number - 1][0]) + way * far for number, far in distance.items() for way in (1, -1)]
    return min(
        places,
        key=lambda x: sum(abs(abs(x - at(given.centres[number - 1][0])) - far) for number, far in distance.items()),
    )
