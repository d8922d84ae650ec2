"""A, B and f at the operating point, then what is left over, then the matrices with one more dimension."""

import numpy as np

from rldrill.problems.linear_methods.linearise_affine import Given
from rldrill.solutions import dynamics, matrices
from rldrill.solutions.exact import exact
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.linearisation import Linearised, after, linearised, rates, slips
from rldrill.solutions.matrices import AnyMatrix
from rldrill.solutions.oracle import Answers
from rldrill.solutions.sheet.linear_methods import (
    AFFINE_TERM,
    AUGMENTED_A,
    AUGMENTED_B,
    C_IS_F,
    EULER_F,
    FORGOT_IDENTITY,
)
from rldrill.solutions.work import Work


def solve(given: Given, work: Work, differentiated: Linearised = linearised) -> None:
    """Everything is taken at the operating point."""
    A, B = differentiated(given, work)
    s_bar = matrices.column(dynamics.angle(given.state[name]) for name in given.states)
    a_bar = matrices.column(dynamics.angle(value) for value in given.action.values())
    assert given.step is not None, "checked with the givens"
    f_bar = work.step(EULER_F, sbar=s_bar, dt=exact(given.step), fbar=rates(work, given))
    _augmented(work, A, B, work.step(AFFINE_TERM, fbar=f_bar, Ai=A, Bi=B, sbar=s_bar, abar=a_bar))


def _augmented(work: Work, A: AnyMatrix, B: AnyMatrix, C: AnyMatrix) -> None:
    C = work.answer(C)
    work.answer(work.step(AUGMENTED_A, Ai=A, Cc=C))
    work.answer(work.step(AUGMENTED_B, Bi=B))


@slip(
    "c-is-the-rates",
    "Those are the rates at the operating point; C belongs to the Euler step, and A s̄ and B ā are taken off there.",
)
def rates_for_c(given: Given, work: Work) -> None:
    """The rates in the place of C."""
    A, B = linearised(given, work)
    _augmented(work, A, B, rates(work, given))


MISCONCEPTIONS = (C_IS_F, rates_for_c, *slips(solve), FORGOT_IDENTITY)


def oracle(given: Given) -> Answers:
    """Complex steps for both matrices; C is where the tangent plane stands at zero."""
    values = dynamics.numbers(given)
    step = after(given)
    A, B = (dynamics.complex_step(step, values, by) for by in (given.states, tuple(given.action)))
    n, m = B.shape
    operating = np.real([values[name] for name in (*given.states, *given.action)])
    C = np.real(step(values)) - np.hstack([A, B]) @ operating
    return (
        C,
        np.vstack([np.column_stack([A, C]), np.eye(n + 1)[-1]]),
        np.vstack([B, np.zeros((1, m))]),
    )
