"""The distance from every centre, then its triangular bump."""

import numpy as np

from rldrill.problems.function_approximation.piecewise_linear_rbf import Given
from rldrill.solutions.centres import distances, measured
from rldrill.solutions.exact import exact
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.function_approximation import NOT_CLAMPED, PIECEWISE_LINEAR_RBF, WIDTH_FORGOTTEN
from rldrill.solutions.work import Work

MISCONCEPTIONS = (NOT_CLAMPED, WIDTH_FORGOTTEN)


def solve(given: Given, work: Work) -> None:
    """Centre by centre."""
    known = distances(given, work) | {"width": exact(given.width)}
    work.answer(tuple(work.step(PIECEWISE_LINEAR_RBF, i=number, **known) for number in known["distance"]))


def oracle(given: Given) -> Answers:
    """The bump as a line between its peak and its foot."""
    return (np.interp(measured(given), [0.0, at(given.width)], [1.0, 0.0]),)
