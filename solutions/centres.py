"""Distances from centres, as solvers need them, and by other means."""

from typing import Any

import numpy as np

from rldrill.problems.centres import Centred
from rldrill.solutions.exact import exact
from rldrill.solutions.oracle import Array, at
from rldrill.solutions.sheet.function_approximation import DISTANCE
from rldrill.solutions.work import Work


def distances(given: Centred, work: Work) -> dict[str, Any]:
    """Work out the distance from every centre; what comes back is known by the formulas' letters."""
    axes = range(1, len(given.position) + 1)
    known: dict[str, Any] = {
        "position": dict(zip(axes, map(exact, given.position), strict=True)),
        "centre": {
            (number, axis): exact(value)
            for number, centre in enumerate(given.centres, 1)
            for axis, value in zip(axes, centre, strict=True)
        },
        "dimensions": tuple(axes),
    }
    numbers = range(1, len(given.centres) + 1)
    return {"s": "s", "distance": {number: work.step(DISTANCE, i=number, **known) for number in numbers}}


def measured(given: Centred) -> Array:
    """The distances in floating point."""
    state = np.array([at(value) for value in given.position])
    centres = np.array([[at(value) for value in centre] for centre in given.centres])
    return np.asarray(np.linalg.norm(centres - state, axis=1))
