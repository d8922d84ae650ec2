"""Every derivative in letters, then at the operating point; sines and cosines stay exact."""

import numpy as np

from rldrill.problems.linear_methods.linearise import Given
from rldrill.solutions import dynamics
from rldrill.solutions.linearisation import AT_ZERO, SINE_FOR_COSINE, after, euler, jacobian, point
from rldrill.solutions.oracle import Answers
from rldrill.solutions.sheet.linear_methods import (
    EULER_A,
    EULER_B,
    FORGOT_IDENTITY,
    INPUT_JACOBIAN,
    LINEARISE,
    STATE_JACOBIAN,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (AT_ZERO, SINE_FOR_COSINE, FORGOT_IDENTITY)


def solve(given: Given, work: Work) -> None:
    """A, then B."""
    work.recall(LINEARISE)
    known = point(work, given)
    work.answer(euler(work, given, EULER_A, jacobian(work, given, STATE_JACOBIAN, known)))
    work.answer(euler(work, given, EULER_B, jacobian(work, given, INPUT_JACOBIAN, known)))


def oracle(given: Given) -> Answers:
    """Complex steps through the dynamics, or through their Euler step."""
    values, step = dynamics.numbers(given), after(given)
    return (
        np.real(dynamics.complex_step(step, values, given.states)),
        dynamics.complex_step(step, values, tuple(given.action)),
    )
