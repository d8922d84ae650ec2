"""The gain from the sheet's formula, in matrices of rationals."""

from typing import Any

from msgspec.structs import replace

from rldrill.problems.exact import shown
from rldrill.problems.linear_methods.lqr_gain import Given
from rldrill.solutions import linear_quadratic
from rldrill.solutions.exact import exact
from rldrill.solutions.matrices import column
from rldrill.solutions.matrices import given as given_matrix
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.linear_methods import (
    FORGOT_R,
    LQR_GAIN,
    NEXT_NOT_DISCOUNTED,
    POSITIVE_S,
    TRANSPOSED_A,
    in_costs,
    quadratic,
)
from rldrill.solutions.work import Work

#: Without the price in it, the gain says nothing of a price that is to be found.
MISCONCEPTIONS = (
    POSITIVE_S,
    replace(FORGOT_R, when=lambda given: given.action is None),
    TRANSPOSED_A,
    NEXT_NOT_DISCOUNTED.where_it_shows(),
)


def solve(given: Given, work: Work) -> None:
    """One application; times are counted from t = 0. A price that is left open is found from an action first."""
    lqr = quadratic(given.notation, discounted=given.gamma != 1, crossed=given.N is not None)
    if lqr.gain is LQR_GAIN:
        work.say(in_costs(len(given.A)))
    known: dict[str, Any] = {
        f"{name}t": {0: given_matrix(getattr(given, name))} for name in ("ABRN" if given.N else "ABR")
    }
    known |= {"t": 0, "Pt": {1: given_matrix(given.P)}, "gamma": exact(given.gamma)}
    start = None if given.start is None else column(map(exact, given.start))
    L = linear_quadratic.gain(work, lqr, **known)
    if given.action is not None:
        action = work.step(lqr.action, t=0, Lt={0: L}, St={0: start})
        work.say(f"${given.notation.action}_0$ must be ${shown(given.action)}$:")
        price = work.answer(work.equate("rho", action[0, 0], exact(given.action), positive=True))
        work.answer(linear_quadratic.with_price(work, lqr, L, price))
        return
    L = work.answer(L)
    if start is not None:
        work.answer(work.step(lqr.action, t=0, Lt={0: L}, St={0: start}))


def oracle(given: Given) -> Answers:
    """The best action for each unit state, as the stationary point of r + V found from the Hessian."""
    A, B, R, P = (linear_quadratic.array(rows) for rows in (given.A, given.B, given.R, given.P))
    N = np.zeros_like(B) if given.N is None else linear_quadratic.array(given.N)
    ahead = at(given.gamma) * (-P if given.notation.costs else P)
    start = None if given.start is None else np.array([at(entry) for entry in given.start])

    def worth(s: Array, a: Array) -> float:
        after = A @ s + B @ a
        return float(after @ ahead @ after - a @ R @ a - 2 * s @ N @ a)

    price: list[float] = []
    if given.action is not None and start is not None:
        R, a = np.zeros((1, 1)), np.array([at(given.action)])
        # Without its price, the action's worth rises at the known action by what the price then takes back.
        price = [(worth(start, a + 1) - worth(start, a - 1)) / 2 / (2 * a[0])]
        R = np.array([price])
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
    return (*price, gain, *([] if start is None or price else [-gain @ start]))
