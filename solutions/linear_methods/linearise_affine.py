"""A, B and f at the operating point, then what is left over, then the matrices with one more dimension."""

import numpy as np

from rldrill.problems.linear_methods.linearise_affine import Given
from rldrill.solutions import dynamics, matrices
from rldrill.solutions.exact import exact
from rldrill.solutions.formula.formula import fork
from rldrill.solutions.linearisation import (
    AT_ZERO,
    SINE_FOR_COSINE,
    after,
    euler,
    jacobian,
    point,
    rates,
)
from rldrill.solutions.oracle import Answers
from rldrill.solutions.sheet.linear_methods import (
    AFFINE_TERM,
    AUGMENTED_A,
    AUGMENTED_B,
    C_IS_F,
    EULER_A,
    EULER_B,
    EULER_F,
    FORGOT_IDENTITY,
    INPUT_JACOBIAN,
    LINEARISE,
    STATE_JACOBIAN,
)
from rldrill.solutions.work import Work

C_IS_RATES = fork(
    "c-is-the-rates",
    "Those are the rates at the operating point; C belongs to the Euler step, and A s̄ and B ā are taken off there.",
)
MISCONCEPTIONS = (C_IS_F, C_IS_RATES, AT_ZERO, SINE_FOR_COSINE, FORGOT_IDENTITY)


def solve(given: Given, work: Work) -> None:
    """Everything is taken at the operating point."""
    work.recall(LINEARISE)
    known = point(work, given)
    A = euler(work, given, EULER_A, jacobian(work, given, STATE_JACOBIAN, known))
    B = euler(work, given, EULER_B, jacobian(work, given, INPUT_JACOBIAN, known))
    s_bar = matrices.column(dynamics.angle(given.state[name]) for name in given.states)
    a_bar = matrices.column(dynamics.angle(value) for value in given.action.values())
    assert given.step is not None, "checked with the givens"
    f = rates(work, given)
    f_bar = work.step(EULER_F, sbar=s_bar, dt=exact(given.step), fbar=f)
    C = work.step(AFFINE_TERM, fbar=f_bar, Ai=A, Bi=B, sbar=s_bar, abar=a_bar)
    C = work.answer(f if work.makes(C_IS_RATES) else C)
    work.answer(work.step(AUGMENTED_A, Ai=A, Cc=C))
    work.answer(work.step(AUGMENTED_B, Bi=B))


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
