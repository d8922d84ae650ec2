"""The gain from the sheet's formula, in matrices of rationals."""

import numpy as np

from rldrill.problems.linear_methods.lqr_gain import Given
from rldrill.solutions import linear_quadratic
from rldrill.solutions.exact import exact
from rldrill.solutions.matrices import given as matrix
from rldrill.solutions.oracle import Answers, Array, at
from rldrill.solutions.sheet.linear_methods import FORGOT_R, IN_COSTS, LQR_GAIN, POSITIVE_S, TRANSPOSED_A, quadratic
from rldrill.solutions.work import Work

MISCONCEPTIONS = (POSITIVE_S, FORGOT_R, TRANSPOSED_A)


def solve(given: Given, work: Work) -> None:
    """One application; times are counted from t = 0."""
    lqr = quadratic(given.notation, discounted=given.gamma != 1, crossed=given.N is not None)
    if lqr.gain is LQR_GAIN:
        work.say(IN_COSTS)
    known = {f"{name}t": {0: matrix(getattr(given, name))} for name in ("ABRN" if given.N else "ABR")}
    work.answer(work.step(lqr.gain, t=0, Pt={1: matrix(given.P)}, gamma=exact(given.gamma), **known))


def oracle(given: Given) -> Answers:
    """The best action for each unit state, as the stationary point of r + V found from the Hessian."""
    A, B, R, P = (linear_quadratic.array(rows) for rows in (given.A, given.B, given.R, given.P))

    N = np.zeros_like(B) if given.N is None else linear_quadratic.array(given.N)
    ahead = at(given.gamma) * (-P if given.notation.costs else P)

    def worth(s: Array, a: Array) -> float:
        after = A @ s + B @ a
        return float(after @ ahead @ after - a @ R @ a - 2 * s @ N @ a)

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
