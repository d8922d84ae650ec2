"""The gain from the sheet's formula, in matrices of rationals."""

import numpy as np

from rldrill.problems.linear_methods.lqr_gain import Given
from rldrill.solutions.matrices import given as matrix
from rldrill.solutions.oracle import Answers, Array, at
from rldrill.solutions.sheet.linear_methods import FORGOT_R, IN_COSTS, LQR_GAIN, POSITIVE_S, TRANSPOSED_A
from rldrill.solutions.work import Work

MISCONCEPTIONS = (POSITIVE_S, FORGOT_R, TRANSPOSED_A)


def solve(given: Given, work: Work) -> None:
    """One application; times are counted from t = 0."""
    work.say(IN_COSTS)
    known = {"At": {0: matrix(given.A)}, "Bt": {0: matrix(given.B)}, "Rt": {0: matrix(given.R)}}
    work.answer(work.step(LQR_GAIN, t=0, Pt={1: matrix(given.P)}, **known))


def oracle(given: Given) -> Answers:
    """The best action for each unit state, as the stationary point of r + V found from the Hessian."""
    A, B, R, P = (
        np.array([[at(entry) for entry in line] for line in lines]) for lines in (given.A, given.B, given.R, given.P)
    )

    def worth(s: Array, a: Array) -> float:
        after = A @ s + B @ a
        return float(after @ P @ after - a @ R @ a)

    n, m = B.shape
    gain = np.zeros((m, n))
    for j in range(n):
        s = np.eye(n)[j]
        zero = np.zeros(m)
        unit = np.eye(m)
        base = worth(s, zero)
        # A quadratic is determined by its values at 0, ±e_i and e_i + e_k: no formula for the gain is used.
        slope = np.array([(worth(s, e) - worth(s, -e)) / 2 for e in unit])
        curve = np.array([[worth(s, e + f) - worth(s, e) - worth(s, f) + base for f in unit] for e in unit])
        gain[:, j] = -np.linalg.solve(curve, -slope)
    return (gain,)
