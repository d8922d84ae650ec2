"""Planar arms of problems as formulas need them."""

from typing import Any

from rldrill.problems.arms import PlanarArm
from rldrill.solutions.dynamics import angle, radians
from rldrill.solutions.exact import exact
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import at
from rldrill.solutions.sheet.beyond_the_sheet import LINK_ANGLE
from rldrill.solutions.work import Work


def known(given: PlanarArm) -> dict[str, Any]:
    """Lengths and joint angles by the formulas' letters."""
    return {
        "length": {index: exact(length) for index, length in enumerate(given.lengths, 1)},
        "thetaj": {index: angle(value) for index, value in enumerate(given.angles, 1)},
        "n": len(given.lengths),
    }


def link_angles(work: Work, arm: dict[str, Any]) -> dict[int, Any]:
    """The angle of every link against the base."""
    return {index: work.step(LINK_ANGLE, i=index, **arm) for index in arm["length"]}


def end_point(given: PlanarArm, angles: Array) -> Array:
    """Position and orientation of the end as a product of complex rotations, for the independent solvers."""
    point = 0j
    for length, turn in zip(reversed(given.lengths), reversed(angles), strict=True):
        point = (at(length) + point) * np.exp(1j * turn)
    return np.array([point.real, point.imag, float(sum(angles))])


def joint_angles(given: PlanarArm) -> Array:
    """The joint angles in floating point."""
    return np.array([radians(value) for value in given.angles])
