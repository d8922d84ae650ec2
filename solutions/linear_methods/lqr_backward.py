"""The Riccati recursion backwards from the horizon: at every time first the gain, then the value matrix."""

from dataclasses import replace

import numpy as np

from rldrill.problems.linear_methods.lqr_backward import Given
from rldrill.solutions import linear_quadratic
from rldrill.solutions.formula.formula import fork
from rldrill.solutions.oracle import Answers, Array, at
from rldrill.solutions.sheet.linear_methods import (
    COST_TO_GO,
    FORGOT_R,
    IN_COSTS,
    LQR_ACTION,
    LQR_GAIN,
    LQR_RICCATI,
    LQR_TERMINAL,
    NO_TERMINAL,
    POSITIVE_S,
    TRANSPOSED_A,
)
from rldrill.solutions.work import Work

SAME_TIME = fork(
    "gain-from-same-time",
    "The action at time t leads to time t + 1, so L_t comes from P_{t+1}, not from P_t.",
)
#: As for a single gain, but here matrices are given by time.
TRANSPOSED = replace(TRANSPOSED_A, when=lambda given: len(given.start) > 1)
MISCONCEPTIONS = (POSITIVE_S, FORGOT_R, TRANSPOSED, NO_TERMINAL, SAME_TIME, COST_TO_GO)


def solve(given: Given, work: Work) -> None:
    """Two parts for every time; the last is the action."""
    known = linear_quadratic.known(given)
    last = given.horizon
    work.say(IN_COSTS)
    P = {last: work.step(LQR_TERMINAL, T=last, **known)}
    L = {}
    for time in range(last - 1, -1, -1):
        gain = right = work.step(LQR_GAIN, t=time, Pt=P, **known)
        if work.makes(SAME_TIME):
            value = LQR_RICCATI.value({"t": time, "Pt": P, "Lt": {time: right}, **known})
            gain = work.step(LQR_GAIN, t=time, Pt={time + 1: value}, **known)
        L = {time: work.answer(gain)}
        value = work.step(LQR_RICCATI, t=time, Pt=P, Lt={time: right} if work.makes(SAME_TIME) else L, **known)
        given_ = work.answer(-value if work.makes(COST_TO_GO) else value)
        P = P | {time: value if work.makes(COST_TO_GO) else given_}
    work.answer(work.step(LQR_ACTION, t=0, Lt=L, St={0: linear_quadratic.start(given)}))


def oracle(given: Given) -> Answers:
    """The best plan for every unit state as one least-squares problem over all remaining actions at once."""
    answers = []
    m = given.actions
    gain: Array = np.zeros((m, len(given.start)))
    for time in range(given.horizon - 1, -1, -1):
        plan, worth = _best(given, time)
        gain = -plan[:m]
        answers += [gain, worth]
    return [*answers, -gain @ np.array([at(entry) for entry in given.start])]


def _best(given: Given, first: int) -> tuple[Array, Array]:
    """The best actions from a time on, as a matrix acting on the state, and the matrix of their worth."""
    n, m, last = len(given.start), given.actions, given.horizon
    count = last + 1 - first
    reach: Array = np.eye(n)  # of the state by the first state, and by all actions
    steer: Array = np.zeros((n, m * count))
    H, F, W = np.zeros((m * count, m * count)), np.zeros((m * count, n)), np.zeros((n, n))
    for step in range(count):
        now = linear_quadratic.arrays(given, first + step)
        here = slice(m * step, m * (step + 1))
        H += steer.T @ now["Q"] @ steer
        F += steer.T @ now["Q"] @ reach
        W += reach.T @ now["Q"] @ reach
        H[here, here] += now["R"]
        reach, steer = now["A"] @ reach, now["A"] @ steer
        steer[:, here] += now["B"]
    plan = np.linalg.inv(-H) @ F
    return np.asarray(plan, dtype=float), -(W + F.T @ plan)
