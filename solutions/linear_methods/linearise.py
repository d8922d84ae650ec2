"""Every derivative in letters, then at the operating point; sines and cosines stay exact."""

import numpy as np

from rldrill.problems.linear_methods.linearise import Given
from rldrill.solutions import dynamics
from rldrill.solutions.linearisation import Linearised, after, held_numerically, linearised, slips
from rldrill.solutions.oracle import Answers
from rldrill.solutions.sheet.linear_methods import FORGOT_IDENTITY
from rldrill.solutions.work import Work


def solve(given: Given, work: Work, matrices: Linearised = linearised) -> None:
    """A, then B."""
    for matrix in matrices(given, work):
        work.answer(matrix)


MISCONCEPTIONS = (*slips(solve), FORGOT_IDENTITY)


def oracle(given: Given) -> Answers:
    """Complex steps through the dynamics, or through their Euler step."""
    if given.held:
        return held_numerically(given)[:2]
    values, step = dynamics.numbers(given), after(given)
    return (
        np.real(dynamics.complex_step(step, values, given.states)),
        dynamics.complex_step(step, values, tuple(given.action)),
    )
