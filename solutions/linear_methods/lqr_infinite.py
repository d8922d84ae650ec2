"""The scalar Riccati equation by its quadratic; a larger system by its modes, if it has any, else in decimals."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
from flint import fmpq

from rldrill.problems.linear_methods.lqr_infinite import Given
from rldrill.solutions import linear_quadratic, matrices
from rldrill.solutions.exact import NoSolution, Value, decimal, exact, is_rational
from rldrill.solutions.matrices import AnyMatrix
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.riccati import Regulator, stationary
from rldrill.solutions.sheet.linear_methods import (
    LQR_MODES,
    OTHER_ROOT,
    POSITIVE_S,
    Stationary,
    quadratic,
)
from rldrill.solutions.sheet.linear_methods import stationary as stationary_formulas
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """P, then the gain from it, then the closed loop, which shows that the root was the right one."""
    regulator = _regulator(given)
    added = {"discounted": given.gamma != 1, "crossed": given.N is not None}
    lqr, formulas = quadratic(given.notation, **added), stationary_formulas(given.notation, **added)
    P = work.answer(_value(work, given, formulas, regulator))
    by_time = {f"{name}t": {0: getattr(regulator, name)} for name in "ABRN"} | {"Pt": {1: P}, "gamma": regulator.gamma}
    if all(is_rational(entry) and entry.q > _LONG for entry in P.entries()):
        work.say(f"The gain follows from this ${given.notation.value}$, and is rounded likewise.")
        L = work.answer(_rounded(work.value(lqr.gain, t=0, **by_time)))
    else:
        L = work.answer(work.step(lqr.gain, into=lqr.always, t=0, **by_time))
    letters = {f"{given.notation.gain}i": L}
    closed = work.step(formulas.closed_loop, Ai=regulator.A, Bi=regulator.B, **letters)
    if closed.nrows() == 1 and given.gamma == 1:
        loop = f"A − B {given.notation.gain}"
        work.say(f"${loop} ≈ {decimal(closed[0, 0], 4)}$ is between $−1$ and $1$: stable, as it must be.")
    work.answer(closed)


def _regulator(given: Given) -> Regulator:
    A, B, Q, R = (matrices.given(getattr(given, name)) for name in "ABQR")
    N = B * 0 if given.N is None else matrices.given(given.N)
    return Regulator(A, B, Q, R, N, exact(given.gamma))


def _value(work: Work, given: Given, formulas: Stationary, regulator: Regulator) -> AnyMatrix:
    work.recall(formulas.equation)
    if not given.notation.costs:
        work.say(_in_costs(given))
    A, B = regulator.A, regulator.B
    if A.nrows() == B.ncols() == 1:
        work.say(_equation(given))
        numbers = (getattr(regulator, name)[0, 0] for name in "ABQRN")
        return matrices.matrix([[_root(work, given, formulas, *numbers)]])
    for change in _changes(A.nrows()):
        split = [change.inv() * matrix * change for matrix in regulator[:5]] if A.nrows() == B.ncols() else []
        if split and all(map(_is_diagonal, split)):
            return _by_modes(work, given, formulas, change, *split)
    return _in_decimals(work, given, regulator)


def _in_costs(given: Given) -> str:
    gamma, N = ("" if given.gamma == 1 else "γ "), (" + N" if given.N else "")
    turned = f"({gamma}A^⊤ S B{N})" if N else f"{gamma}A^⊤ S B"
    return (
        f"$P$ is the matrix of the value; for the cost-to-go, $S = −P$, it reads $S = Q + {gamma}A^⊤ S A − {turned} L$."
    )


def _equation(given: Given) -> str:
    """The scalar equation, cleared of its denominator."""
    gamma, product = ("" if given.gamma == 1 else "γ "), ("(Q R − N^2)" if given.N else "Q R")
    P, sign, other = given.notation.value, "−" if given.notation.costs else "+", given.notation.costs
    bracket = f"R + {gamma}B^2 {P}" if other else f"{gamma}B^2 P − R"
    return (
        f"Multiplied by ${bracket}$, the scalar equation becomes ${gamma}B^2 {P}^2 {sign} β {P} − {product} = 0$; the "
        f"{'positive' if other else 'negative'} one of its roots brings the state to $0$."
    )


def _root(work: Work, given: Given, formulas: Stationary, a: fmpq, b: fmpq, q: fmpq, r: fmpq, n: fmpq) -> Value:
    """The scalar P: the root that makes the closed loop stable."""
    gamma: fmpq = exact(given.gamma)
    if r == 0 and (b == 0 or q == 0):
        raise NoSolution("some action costs nothing and changes nothing that does, so no single one is the best")
    left, cost = (
        (a - b * n / r, q - n * n / r) if r else (a, q)
    )  # with the action −n/r s, which the cross term asks for
    if b == 0 and gamma * a * a >= 1:
        raise NoSolution("no action has an effect on a part of the state that does not go to 0 by itself")
    if b == 0:
        work.say(_unmoved(given))
        value = cost / (1 - gamma * a * a) * (1 if given.notation.costs else -1)
        work.give(formulas.root, value)
        return value
    if r and cost == 0 and gamma * left * left == 1:
        raise NoSolution("to bring the state to 0 can be made as cheap as one likes, so no action is the best")
    known = {"Ak": a, "Bk": b, "Qk": q, "Rk": r, "Nk": n, "gamma": gamma}
    return work.step(formulas.root, betak=work.step(formulas.beta, **known), **known)


def _unmoved(given: Given) -> str:
    """What is left of the equation where B is 0."""
    _, _, L, P, in_costs = given.notation
    cost = "Q − N^2/R" if given.N else "Q"
    signed = cost if in_costs else f"−({cost})" if given.N else "−Q"
    gamma, gain = "" if given.gamma == 1 else "γ ", "N/R" if given.N else "0"
    gains = f"gain is ${gain}$" if L == "L" and gain == "0" else f"gain is ${L} = {gain}$"
    return f"No action has an effect here, so the {gains}, and ${P} = {signed} + {gamma}A^2 {P}$:"


def _changes(size: int) -> tuple[AnyMatrix, ...]:
    """The changes of coordinates that are tried: none, and sum and difference."""
    half = (matrices.matrix([[fmpq(1), fmpq(1)], [fmpq(1), fmpq(-1)]]),) if size == 2 else ()
    return (matrices.identity(size), *half)


def _is_diagonal(matrix: AnyMatrix) -> bool:
    return all(entry == 0 for i, line in enumerate(matrix.tolist()) for j, entry in enumerate(line) if i != j)


def _by_modes(work: Work, given: Given, formulas: Stationary, change: AnyMatrix, *split: AnyMatrix) -> AnyMatrix:
    size = change.nrows()
    roots = []
    of = ("the sum", "the difference") if change[0, 1] != 0 else tuple(f"entry {mode + 1}" for mode in range(size))
    names = tuple(f"{what} of the two states" if change[0, 1] != 0 else f"{what} of the state" for what in of)
    work.say(_equation(given))
    letters = "ABQRN" if given.N else "ABQR"
    for mode, what in enumerate(names):
        numbers = [matrix[mode, mode] for matrix in split]
        told = ", ".join(f"{name} = {number}".replace("-", "−") for name, number in zip(letters, numbers, strict=False))
        work.say(f"Mode {mode + 1}, {what}, is a system of its own with ${told}$:")
        roots.append(_root(work, given, formulas, *numbers))
    if size > 1:
        work.say("Back in the entries of the state, with the modes as the columns of $T$:")
    diagonal = matrices.matrix([[roots[i] if i == j else 0 for j in range(size)] for i in range(size)])
    modes = LQR_MODES if not given.notation.costs else replace(LQR_MODES, left=formulas.equation.left)
    return work.step(modes, modes=change, Pm=diagonal)


def _in_decimals(work: Work, given: Given, regulator: Regulator) -> AnyMatrix:
    """The matrix itself, where it is rational; else to twelve decimals, with what is left over in its equation."""
    found, P = stationary(regulator), given.notation.value
    sign = 1 if given.notation.costs else -1
    simple = matrices.matrix([_simple(entry) for entry in line] for line in found.tolist())
    doubling = f"${P}$ is found by doubling the horizon until nothing changes, in rational arithmetic."
    if regulator.before(simple) == simple:
        work.say(f"{doubling} Put into its equation, it fulfils it exactly:")
        work.give(stationary_formulas(given.notation, discounted=False, crossed=False).equation, simple * sign)
        return simple * sign
    rounded = _rounded(found)
    left_over: list[fmpq] = (regulator.before(rounded) - rounded).entries()
    largest = max(map(abs, left_over))
    work.say(
        f"This system has no closed form here; ${P}$ is found by doubling the horizon until nothing changes, in "
        f"rational arithmetic. Put into its equation, it leaves an error of {decimal(largest, 2)}."
    )
    return rounded * sign


def _simple(entry: fmpq) -> fmpq:
    """The simplest rational number nearby."""
    near = Fraction(int(entry.p), int(entry.q)).limit_denominator(_LONG)
    return fmpq(near.numerator, near.denominator)


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
    N = np.zeros_like(B) if given.N is None else linear_quadratic.array(given.N)
    gamma, sign = at(given.gamma), 1 if given.notation.costs else -1
    S = Q + np.eye(len(Q))  # from any positive matrix it comes to the solution that is stable
    for _ in range(100_000):
        L = np.linalg.solve(R + gamma * B.T @ S @ B, gamma * B.T @ S @ A + N.T)
        crossed = N @ L
        after = Q - crossed - crossed.T + L.T @ R @ L + gamma * (A - B @ L).T @ S @ (A - B @ L)
        if np.allclose(after, S, rtol=1e-14, atol=1e-14):
            break
        S = after
    return (sign * S, L, A - B @ L)
