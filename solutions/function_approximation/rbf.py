"""The distance from every centre, then its bump; exponentials stay as they are."""

import numpy as np

from rldrill.problems.function_approximation.rbf import Given
from rldrill.solutions.centres import distances, measured
from rldrill.solutions.exact import exact
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.function_approximation import HALF_FORGOTTEN, NORM_NOT_SQUARED, RBF, SIGMA_NOT_SQUARED
from rldrill.solutions.work import Work

MISCONCEPTIONS = (HALF_FORGOTTEN, SIGMA_NOT_SQUARED, NORM_NOT_SQUARED)


def solve(given: Given, work: Work) -> None:
    """Centre by centre."""
    known = distances(given, work) | {"sigma": exact(given.sigma)}
    work.answer(tuple(work.step(RBF, i=number, **known) for number in known["distance"]))


def oracle(given: Given) -> Answers:
    """A normal density, relative to its height at the centre, coordinate by coordinate."""
    sigma = at(given.sigma)

    def density(x: float) -> float:
        return float(np.exp(-((x / sigma) ** 2) / 2) / (sigma * np.sqrt(2 * np.pi)))

    height = density(0.0)
    return ([density(distance) / height for distance in measured(given)],)
