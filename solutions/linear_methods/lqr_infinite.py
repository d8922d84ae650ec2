"""The scalar Riccati equation by its quadratic; a larger system by its modes, if it has any, else in decimals."""

import numpy as np
from flint import fmpq

from rldrill.problems.linear_methods.lqr_infinite import Given
from rldrill.solutions import linear_quadratic, matrices
from rldrill.solutions.exact import NoSolution, Value, decimal, is_rational
from rldrill.solutions.matrices import AnyMatrix
from rldrill.solutions.oracle import Answers
from rldrill.solutions.riccati import stationary
from rldrill.solutions.sheet.linear_methods import (
    LQR_BETA,
    LQR_CLOSED_LOOP,
    LQR_GAIN,
    LQR_MODES,
    LQR_ROOT,
    LQR_STATIONARY,
    OTHER_ROOT,
    POSITIVE_S,
    L_always,
)
from rldrill.solutions.work import Work

_QUADRATIC = (
    "Multiplied by $B^2 P − R$, the scalar equation becomes $B^2 P^2 + β P − Q R = 0$; the negative one of its roots "
    "brings the state to $0$."
)


def solve(given: Given, work: Work) -> None:
    """P, then the gain from it, then the closed loop, which shows that the root was the right one."""
    known = {name: matrices.given(getattr(given, name)) for name in "ABQR"}
    P = work.answer(_value(work, **known))
    by_time = {"At": {0: known["A"]}, "Bt": {0: known["B"]}, "Rt": {0: known["R"]}, "Pt": {1: P}}
    if all(is_rational(entry) and entry.q > _LONG for entry in P.entries()):
        work.say("The gain follows from this $P$, and is rounded likewise.")
        L = work.answer(_rounded(work.value(LQR_GAIN, t=0, **by_time)))
    else:
        L = work.answer(work.step(LQR_GAIN, into=L_always, t=0, **by_time))
    closed = work.step(LQR_CLOSED_LOOP, Ai=known["A"], Bi=known["B"], Li=L)
    if closed.nrows() == 1:
        work.say(f"$A − B L ≈ {decimal(closed[0, 0], 4)}$ is between $−1$ and $1$: stable, as it must be.")
    work.answer(closed)


def _value(work: Work, A: AnyMatrix, B: AnyMatrix, Q: AnyMatrix, R: AnyMatrix) -> AnyMatrix:
    work.recall(LQR_STATIONARY)
    work.say("$P$ is the matrix of the value; for the cost-to-go, $S = −P$, it reads $S = Q + A^⊤ S A − A^⊤ S B L$.")
    if A.nrows() == B.ncols() == 1:
        work.say(_QUADRATIC)
        return matrices.matrix([[_root(work, *(matrix[0, 0] for matrix in (A, B, Q, R)))]])
    for change in _changes(A.nrows()):
        split = [change.inv() * matrix * change for matrix in (A, B, Q, R)] if A.nrows() == B.ncols() else []
        if split and all(map(_is_diagonal, split)):
            return _by_modes(work, change, *split)
    return _in_decimals(work, A, B, Q, R)


def _root(work: Work, a: fmpq, b: fmpq, q: fmpq, r: fmpq) -> Value:
    """The scalar P: the root that makes the closed loop stable."""
    known = {"Ak": a, "Bk": b, "Qk": q, "Rk": r}
    if b == 0 and abs(a) >= 1:
        raise NoSolution("no action has an effect on a part of the state that does not go to 0 by itself")
    if b == 0:
        work.say("No action has an effect here, so the gain is $0$, and $P = −Q + A^2 P$:")
        value = -q / (1 - a * a)
        work.give(LQR_ROOT, value)
        return value
    if q == 0 and abs(a) == 1:
        raise NoSolution("to bring the state to 0 can be made as cheap as one likes, so no action is the best")
    beta = work.step(LQR_BETA, **known)
    return work.step(LQR_ROOT, betak=beta, **known)


def _changes(size: int) -> tuple[AnyMatrix, ...]:
    """The changes of coordinates that are tried: none, and sum and difference."""
    half = (matrices.matrix([[fmpq(1), fmpq(1)], [fmpq(1), fmpq(-1)]]),) if size == 2 else ()
    return (matrices.identity(size), *half)


def _is_diagonal(matrix: AnyMatrix) -> bool:
    return all(entry == 0 for i, line in enumerate(matrix.tolist()) for j, entry in enumerate(line) if i != j)


def _by_modes(work: Work, change: AnyMatrix, *split: AnyMatrix) -> AnyMatrix:
    size = change.nrows()
    roots = []
    of = ("the sum", "the difference") if change[0, 1] != 0 else tuple(f"entry {mode + 1}" for mode in range(size))
    names = tuple(f"{what} of the two states" if change[0, 1] != 0 else f"{what} of the state" for what in of)
    work.say(_QUADRATIC)
    for mode, what in enumerate(names):
        numbers = [matrix[mode, mode] for matrix in split]
        told = ", ".join(f"{name} = {number}".replace("-", "−") for name, number in zip("ABQR", numbers, strict=True))
        work.say(f"Mode {mode + 1}, {what}, is a system of its own with ${told}$:")
        roots.append(_root(work, *numbers))
    if size > 1:
        work.say("Back in the entries of the state, with the modes as the columns of $T$:")
    diagonal = matrices.matrix([[roots[i] if i == j else 0 for j in range(size)] for i in range(size)])
    return work.step(LQR_MODES, modes=change, Pm=diagonal)


def _in_decimals(work: Work, A: AnyMatrix, B: AnyMatrix, Q: AnyMatrix, R: AnyMatrix) -> AnyMatrix:
    """P to twelve decimals, with what is left over when it is put into its equation."""
    P = _rounded(-stationary(A, B, Q, R))
    L = LQR_GAIN.value({"t": 0, "At": {0: A}, "Bt": {0: B}, "Rt": {0: R}, "Pt": {1: P}})
    left_over = LQR_STATIONARY.value({"Ai": A, "Bi": B, "Qi": Q, "Li": L, "Pi": P}) - P
    largest = max(abs(entry) for entry in left_over.entries())
    work.say(
        "This system has no closed form here; $P$ is found by doubling the horizon until nothing changes, in rational "
        f"arithmetic. Put into its equation, it leaves an error of {decimal(largest, 2)}."
    )
    return P


_DECIMALS = 10**12
_LONG = 10**9


def _rounded(matrix: AnyMatrix) -> AnyMatrix:
    """Rational entries to twelve decimals."""
    rows: list[list[fmpq]] = matrix.tolist()
    return matrices.matrix([fmpq(round(entry * _DECIMALS), _DECIMALS) for entry in line] for line in rows)


MISCONCEPTIONS = (OTHER_ROOT, POSITIVE_S, linear_quadratic.cost_to_go(solve, slice(1)))


def oracle(given: Given) -> Answers:
    """Value iteration on the quadratic, until nothing changes."""
    A, B, Q, R = (linear_quadratic.array(getattr(given, name)) for name in "ABQR")
    S = Q + np.eye(len(Q))  # from any positive matrix it comes to the solution that is stable
    for _ in range(100_000):
        L = np.linalg.solve(R + B.T @ S @ B, B.T @ S @ A)
        after = Q + L.T @ R @ L + (A - B @ L).T @ S @ (A - B @ L)
        if np.allclose(after, S, rtol=1e-14, atol=1e-14):
            break
        S = after
    return (-S, L, A - B @ L)
