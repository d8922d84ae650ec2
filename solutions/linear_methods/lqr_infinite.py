"""The scalar Riccati equation by its quadratic; a larger system by its modes, if it has any, else in decimals."""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

from flint import fmpq

from rldrill.problems.fractions import Fraction
from rldrill.problems.linear_methods.lqr_infinite import Given
from rldrill.solutions import linear_quadratic, matrices
from rldrill.solutions.exact import ZERO, NoSolution, Value, decimal, exact, is_rational, to_sympy, told
from rldrill.solutions.matrices import AnyMatrix
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.rational import generator
from rldrill.solutions.riccati import Regulator, stationary
from rldrill.solutions.sheet.linear_methods import (
    OTHER_ROOT,
    POSITIVE_S,
    Stationary,
    back_from_modes,
)
from rldrill.solutions.sheet.linear_methods import stationary as stationary_formulas
from rldrill.solutions.work import Equality, Step, Work


def solve(given: Given, work: Work) -> None:
    """P, then the gain from it, then the closed loop, which shows that the root was the right one."""
    regulator = _regulator(given)
    added = {"discounted": given.gamma != 1, "crossed": given.N is not None}
    formulas = stationary_formulas(given.notation, **added)
    if given.closed_loop is not None:
        _price(given, work, formulas, regulator)
        return
    P = work.answer(_value(work, given, formulas, regulator))
    system = {f"{name}i": getattr(regulator, name) for name in "ABRN"} | {"gamma": regulator.gamma}
    system |= {f"{given.notation.value}i": P}
    if all(is_rational(entry) and entry.q > _LONG for entry in P.entries()):
        work.say(f"The gain follows from this ${given.notation.value}$, and is rounded likewise.")
        L = work.answer(_rounded(work.value(formulas.gain, **system)))
    elif (modes := _modes(regulator)) is not None and _is_diagonal(modes.in_modes(P)):
        L = work.answer(_gain_by_modes(work, given, formulas, modes, P, regulator.gamma))
    else:
        L = work.answer(work.step(formulas.gain, **system))
    letters = {f"{given.notation.gain}i": L}
    closed = work.step(formulas.closed_loop, Ai=regulator.A, Bi=regulator.B, **letters)
    if closed.nrows() == 1 and given.gamma == 1:
        loop = f"A − B {given.notation.gain}"
        value = closed[0, 0]
        work.say(lambda: f"${loop} {_told(value)}$ is between $−1$ and $1$: stable, as it must be.")
    work.answer(closed)


def _told(value: Value) -> str:
    return f"= {told(value)}" if is_rational(value) else f"≈ {decimal(value, 4)}"


def _price(given: Given, work: Work, formulas: Stationary, regulator: Regulator) -> None:
    """The gain from the closed loop; P from that equation of the two which holds no price; the price from the other."""
    L, P = given.notation.gain, given.notation.value
    system = {f"{name}i": getattr(regulator, name) for name in "ABQR"} | {"gamma": regulator.gamma}
    loop = work.step(formulas.closed_loop, **system, **{f"{L}i": _single(generator(L))})
    gain = work.equate(L, loop[0, 0], exact(given.closed_loop or 0))

    def riccati(value: Value) -> Value:
        found = work.step(formulas.equation, **system, **{f"{L}i": _single(gain), f"{P}i": _single(value)})
        return found[0, 0]

    def best(value: Value) -> Value:
        return work.step(formulas.gain, **system, **{f"{P}i": _single(value)})[0, 0]

    unknown = generator(P)
    if given.unknown == "Q":
        work.say(f"The formula of the gain contains no price, and gives ${P}$:")
        value = work.equate(P, best(unknown), gain)
        work.say(f"Now the equation of ${P}$ gives the price:")
        work.answer(work.equate("rho", riccati(value), value))
    else:
        work.say(f"The equation of ${P}$ contains no price, and gives ${P}$:")
        value = work.equate(P, unknown, riccati(unknown))
        work.say("Now the formula of the gain gives the price:")
        work.answer(work.equate("rho", best(value), gain))
    work.say("It has been found on the way:")
    work.lines.append(Equality(to_sympy(unknown), (value,)))
    work.answer(value)


def _single(entry: Value) -> AnyMatrix:
    return matrices.matrix([[entry]])


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
        work.say("With the gain put in:")
        numbers = [getattr(regulator, name)[0, 0] for name in "ABQRN"]
        return matrices.matrix([[_root(work, given, formulas, numbers)]])
    if (modes := _modes(regulator)) is not None:
        return _by_modes(work, given, formulas, modes)
    return _in_decimals(work, given, regulator)


def _in_costs(given: Given) -> str:
    gamma, N = ("" if given.gamma == 1 else "γ "), (" + N" if given.N else "")
    turned = f"({gamma}A^⊤ S B{N})" if N else f"{gamma}A^⊤ S B"
    what = "coefficient" if len(given.A) == 1 else "matrix"
    riccati = f"$S = Q + {gamma}A^⊤ S A − {turned} L$"
    return f"$P$ is the {what} of the value; for the cost-to-go, $S = −P$, it reads {riccati}."


def _quadratic(given: Given) -> str:
    """The scalar equation, cleared of its denominator."""
    P, costs = given.notation.value, given.notation.costs
    squared, product = _coefficients(given)
    ahead, crossed = "" if given.gamma == 1 else "γ ", "" if not given.N else " + N" if costs else " − N"
    bracket = f"R + {squared} {P}" if costs else f"{squared} {P} − R"
    cost, square = "Q" if costs else "−Q", f"{ahead and 'γ^2 '}A^2 B^2 {P}^2"
    return (
        f"Multiplied by its denominator this is ${P} ({bracket}) = ({cost} + {ahead}A^2 {P})({bracket}) − "
        f"({ahead}A B {P}{crossed})^2$. Multiplied out, ${square}$ cancels; collected, with $β$ for what stands at "
        f"${P}$, it is ${squared} {P}^2 {'−' if costs else '+'} β {P} − {product} = 0$:"
    )


def _which(given: Given) -> str:
    """Why one of the two roots is the value."""
    squared, product = _coefficients(given)
    what, never, side = (
        ("a cost", "negative", "positive") if given.notation.costs else ("a value", "positive", "negative")
    )
    below = squared if squared == "B^2" else f"({squared})"
    return (
        f"The product of its roots, $−{product}/{below}$, is not positive, so at most one root is {side}; {what} here "
        f"is never {never}, so ${given.notation.value}$ is that one."
    )


def _coefficients(given: Given) -> tuple[str, str]:
    """What stands at the square, and alone."""
    return "B^2" if given.gamma == 1 else "γ B^2", "(Q R − N^2)" if given.N else "Q R"


def _root(
    work: Work, given: Given, formulas: Stationary, numbers: Sequence[fmpq], *, told_before: bool = False
) -> Value:
    """The scalar P: the root that makes the closed loop stable."""
    a, b, q, r, n = numbers
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
    work.lines.append(Step(formulas.scalar, formulas.scalar.right, known, None, "="))
    if not told_before:
        work.say(_quadratic(given))
    beta: Value = work.step(formulas.beta, **known)
    P = generator(given.notation.value)
    linear = P * beta * (-1 if given.notation.costs else 1)
    work.lines.append(Equality(P * P * (gamma * b * b) + linear - (q * r - n * n), (ZERO,)))
    if not told_before:
        work.say(_which(given))
    found: Value = work.step(formulas.root, betak=beta, **known)
    if is_rational(found) and found != 0 and (other := (n * n - q * r) / (gamma * b * b * found)) != 0:
        side = "negative" if given.notation.costs else "positive"
        work.say(f"The other root, ${told(other)}$, is {side}, so it is not the one.")
    return found


def _unmoved(given: Given) -> str:
    """What is left of the equation where B is 0."""
    _, _, L, P, in_costs = given.notation
    cost = "Q − N^2/R" if given.N else "Q"
    signed = cost if in_costs else f"−({cost})" if given.N else "−Q"
    gamma, gain = "" if given.gamma == 1 else "γ ", "N/R" if given.N else "0"
    gains = f"gain is ${gain}$" if L == "L" and gain == "0" else f"gain is ${L} = {gain}$"
    return f"No action has an effect here, so the {gains}, and ${P} = {signed} + {gamma}A^2 {P}$:"


class _Modes(NamedTuple):
    """Coordinates, the columns of T, in which a system falls apart, and A, B, Q, R and N in them."""

    T: AnyMatrix
    split: tuple[AnyMatrix, ...]

    def in_modes(self, matrix: AnyMatrix) -> AnyMatrix:
        """A matrix in these coordinates."""
        return self.T.inv() * matrix * self.T

    @property
    def names(self) -> tuple[str, ...]:
        """What every mode is."""
        if self.T[0, 1] != 0:
            return tuple(
                f"the {what} of the two states and of the actions, over $√2$" for what in ("sum", "difference")
            )
        return tuple(f"entry {mode + 1} of the state" for mode in range(self.T.nrows()))


def _modes(regulator: Regulator) -> _Modes | None:
    """The coordinates in which the system falls apart: its own, or sum and difference."""
    size = regulator.A.nrows()
    if size == 1 or regulator.B.ncols() != size:
        return None
    half = (matrices.matrix([[fmpq(1), fmpq(1)], [fmpq(1), fmpq(-1)]]),) if size == 2 else ()
    for T in (matrices.identity(size), *half):
        split = tuple(T.inv() * matrix * T for matrix in regulator[:5])
        if all(map(_is_diagonal, split)):
            return _Modes(T, split)
    return None


def _is_diagonal(matrix: AnyMatrix) -> bool:
    return all(entry == 0 for i, line in enumerate(matrix.tolist()) for j, entry in enumerate(line) if i != j)


def _by_modes(work: Work, given: Given, formulas: Stationary, modes: _Modes) -> AnyMatrix:
    roots = []
    work.say("With the gain put in, every mode has its own equation:")
    letters = "ABQRN" if given.N else "ABQR"
    for mode, what in enumerate(modes.names):
        numbers = [matrix[mode, mode] for matrix in modes.split]
        told = ", ".join(f"{name} = {number}".replace("-", "−") for name, number in zip(letters, numbers, strict=False))
        work.say(f"Mode {mode + 1}, {what}, is a system of its own with ${told}$:")
        roots.append(_root(work, given, formulas, numbers, told_before=mode > 0))
    return _back(work, modes, given.notation.value, roots)


def _gain_by_modes(
    work: Work, given: Given, formulas: Stationary, modes: _Modes, P: AnyMatrix, gamma: fmpq
) -> AnyMatrix:
    """The gain of every mode, then of the states."""
    gains, hat = [], modes.in_modes(P)
    for mode, what in enumerate(modes.names):
        work.say(f"Mode {mode + 1}, {what}:")
        system = {f"{name}i": _single(matrix[mode, mode]) for name, matrix in zip("ABQRN", modes.split, strict=True)}
        system |= {f"{given.notation.value}i": _single(hat[mode, mode]), "gamma": gamma}
        gains.append(work.step(formulas.gain, **system)[0, 0])
    return _back(work, modes, given.notation.gain, gains)


def _back(work: Work, modes: _Modes, head: str, entries: list[Value]) -> AnyMatrix:
    """A matrix of the states from its entries in the modes."""
    size = len(entries)
    diagonal = matrices.matrix([[entries[i] if i == j else 0 for j in range(size)] for i in range(size)])
    if matrices.identity(size) == modes.T:
        work.say("These are the entries of the diagonal:")
        work.lines.append(Equality(back_from_modes(head).left, (diagonal,)))
        return diagonal
    work.say("Back in the entries of the state, with the modes as the columns of $T$:")
    back: AnyMatrix = work.step(back_from_modes(head), modes=modes.T, **{f"{head}m": diagonal})
    return back


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


MISCONCEPTIONS = (
    OTHER_ROOT,
    POSITIVE_S,
    replace(
        linear_quadratic.cost_to_go(solve, slice(1)),
        when=lambda given: given.convention == "value" and given.closed_loop is None,
    ),
)


def oracle(given: Given) -> Answers:
    """Value iteration on the quadratic, until nothing changes."""
    if given.closed_loop is not None:
        return _priced(given)
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


def _priced(given: Given) -> Answers:
    """The price for which value iteration ends in the closed loop, by bisection: cheap actions close it more."""
    prices = [1e-6, 1e6]
    for _ in range(60):
        middle = (prices[0] * prices[1]) ** 0.5
        entry = Fraction(middle)
        priced = given.model_copy(update={given.unknown: ((entry,),), "closed_loop": None})
        S, _, loop = oracle(priced)
        wide = abs(loop[0, 0]) > abs(at(given.closed_loop or 0))
        prices[int(wide == (given.unknown == "R"))] = middle
    return (middle, S[0, 0])
