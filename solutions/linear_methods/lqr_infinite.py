"""The scalar Riccati equation by its quadratic; a larger system by its modes, if it has any, else in decimals."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import sympy
from flint import fmpq
from sympy import Expr

from rldrill.problems.document import joined
from rldrill.problems.exact import needed, shown
from rldrill.problems.fractions import Fraction
from rldrill.problems.linear_methods.lqr_infinite import Given
from rldrill.solutions import linear_quadratic, matrices
from rldrill.solutions.exact import ZERO, NoSolution, Value, decimal, equals, exact, is_rational, to_sympy, told
from rldrill.solutions.formula.putting_in import put_in, sum_of
from rldrill.solutions.matrices import AnyMatrix
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.rational import generator, linear
from rldrill.solutions.riccati import Regulator, stationary
from rldrill.solutions.sheet.linear_methods import (
    LOOP_WITH_PLUS,
    NEXT_NOT_DISCOUNTED,
    OTHER_ROOT,
    POSITIVE_S,
    Modes,
    ScalarSystem,
    Stationary,
    back_from_modes,
    of_a_mode,
    scalar_system,
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
        L = work.answer(_gain_by_modes(work, given, modes, P, regulator.gamma))
    else:
        L = work.answer(work.step(formulas.gain, **system))
    letters = {f"{given.notation.gain}i": L}
    closed = work.step(formulas.closed_loop, Ai=regulator.A, Bi=regulator.B, **letters)
    if work.misconception is None and (factors := _factors(work, given, regulator, L, closed)) is not None:
        work.say(lambda: _goes_to_zero(given, factors))
    work.answer(closed)


def _factors(
    work: Work, given: Given, regulator: Regulator, L: AnyMatrix, closed: AnyMatrix
) -> tuple[Value, ...] | None:
    """What the closed loop multiplies the state with, or each of its modes."""
    if closed.nrows() == 1:
        return (closed[0, 0],)
    modes = _modes(regulator)
    if modes is None or not _is_diagonal(looped := modes.in_modes(closed)):
        return None
    if modes.kind is Modes.ENTRIES:
        return tuple(looped[i, i] for i in range(looped.nrows()))
    system, hat = _system(given, modes.kind), modes.in_modes(L)
    return tuple(
        work.step(
            system.closed_loop,
            **system.letters.known(mode, **modes.numbers(mode), gain=hat[mode - 1, mode - 1]),
        )
        for mode in modes.counted
    )


def _goes_to_zero(given: Given, factors: tuple[Value, ...]) -> str:
    """That the state goes to 0, as it must: the condition that the question states, checked."""
    many, modes = len(factors) > 1, _modes(_regulator(given))
    what = "entries of the state" if modes is None or modes.kind is Modes.ENTRIES else "modes"
    numbers = joined([f"${told(factor) if is_rational(factor) else decimal(factor, 4)}$" for factor in factors])
    loop = f"The {what} are multiplied by {numbers}" if many else f"$A − B {given.notation.gain}$"
    if given.gamma == 1:
        if many:
            return f"{loop} at every time, all between $−1$ and $1$: the state goes to $0$, as it must."
        value = equals(factors[0]) if is_rational(factors[0]) else f"≈ {decimal(factors[0], 4)}"
        return f"$A − B {given.notation.gain} {value}$ is between $−1$ and $1$: stable, as it must be."
    gamma = exact(given.gamma)
    squares = joined([f"${told(gamma)}·{_squared(each)} {equals(gamma * each**2)}$" for each in dict.fromkeys(factors)])
    lead = f"The {what} are multiplied by {numbers}, and " if many else f"$γ (A − B {given.notation.gain})^2$ is "
    below = "both below" if " and " in squares else "below"
    return f"{lead}{squares}, {below} $1$: $γ^{{t/2}} {given.notation.state}_t$ goes to $0$, as it must."


def _squared(number: Value) -> str:
    written = told(number)
    return f"{written}^2" if written.isdigit() else f"({written})^2"


def _price(given: Given, work: Work, formulas: Stationary, regulator: Regulator) -> None:
    """The gain from the closed loop; P from that equation of the two which holds no price; the price from the other."""
    L, P = given.notation.gain, given.notation.value
    system = {f"{name}i": getattr(regulator, name) for name in "ABQR"} | {"gamma": regulator.gamma}
    loop = work.step(formulas.closed_loop, **system, **{f"{L}i": _single(generator(L))})
    work.say(f"$A − B {L}$ must be ${shown(needed(given.closed_loop))}$:")
    gain = work.equate(L, loop[0, 0], exact(needed(given.closed_loop)))

    def riccati(value: Value) -> Value:
        found = work.step(formulas.equation, **system, **{f"{L}i": _single(gain), f"{P}i": _single(value)})
        return found[0, 0]

    def best(value: Value) -> Value:
        return work.step(formulas.gain, **system, **{f"{P}i": _single(value)})[0, 0]

    unknown = generator(P)
    if given.unknown == "Q":
        work.say(f"The formula of the gain does not contain $ρ$, and gives ${P}$:")
        value = work.answer(work.equate(P, best(unknown), gain))
        work.say(f"Now the equation of ${P}$ gives the price:")
        work.answer(work.equate("rho", riccati(value), value, positive=True))
    else:
        work.say(f"The equation of ${P}$ does not contain $ρ$, and gives ${P}$:")
        slope, constant = linear(riccati(unknown), P)
        value = work.answer(work.equate(P, unknown * (1 - slope), constant))
        work.say("Now the formula of the gain gives the price:")
        work.answer(work.equate("rho", best(value), gain, positive=True))


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
        numbers = {name: getattr(regulator, name)[0, 0] for name in "ABQRN"}
        return matrices.matrix([[_root(work, given, numbers)]])
    if (modes := _modes(regulator)) is not None:
        return _by_modes(work, given, modes)
    return _in_decimals(work, given, regulator)


def _system(given: Given, modes: Modes) -> ScalarSystem:
    return scalar_system(given.notation, discounted=given.gamma != 1, crossed=given.N is not None, modes=modes)


def _in_costs(given: Given) -> str:
    gamma, N = ("" if given.gamma == 1 else "γ "), (" + N" if given.N else "")
    turned = f"({gamma}A^⊤ S B{N})" if N else f"{gamma}A^⊤ S B"
    what = "coefficient" if len(given.A) == 1 else "matrix"
    riccati = f"$S = Q + {gamma}A^⊤ S A − {turned} L$"
    return f"$P$ is the {what} of the value; for the cost-to-go, $S = −P$, it reads {riccati}."


def _which(given: Given, value: str, product: Value, cost: Value, *, rests: bool) -> str:
    """Why one of the two roots is the value: their product is not positive.

    Args:
        given: the problem.
        value: the letter of the value.
        product: what the two roots multiply to.
        cost: $Q R − N^2$.
        rests: whether the state goes to 0 with the root 0, if that is one.
    """
    what, never, side = ("cost", "negative", "positive") if given.notation.costs else ("reward", "positive", "negative")
    if product == 0 and not rests:
        return f"One of the two roots is $0$, with which the state would not come to rest: ${value}$ is the other one."
    one = (
        f"is negative, so one of them is {side}"
        if product != 0
        else f"is $0$, so one of them is, and the other {never}"
    )
    why = f", since $Q R − N^2 {equals(cost)}$ is not negative" if given.N else ""
    root = "that root" if product != 0 else "$0$"
    return (
        f"The product of the two roots, ${told(product)}$, {one}. No {what} is {never}{why}, and neither is a sum "
        f"of them: ${value}$ is {root}."
    )


def _letter(name: str, modes: Modes, mode: int | str) -> str:
    """The letter of a number, in a sentence."""
    if modes is Modes.NONE:
        return name
    return f"{name}_{mode}" if modes is Modes.ENTRIES else f"{name}\u0302_{mode}"


def _root(work: Work, given: Given, numbers: Mapping[str, fmpq], modes: Modes = Modes.NONE, mode: int = 0) -> Value:
    """The scalar P: the root that makes the closed loop stable."""
    system = _system(given, modes)
    a, b, q, r, n = (numbers[name] for name in "ABQRN")
    gamma: fmpq = exact(given.gamma)
    if r == 0 and (b == 0 or q == 0):
        raise NoSolution("some action costs nothing and changes nothing that does, so no single one is the best")
    left, cost = (
        (a - b * n / r, q - n * n / r) if r else (a, q)
    )  # with the action −n/r s, which the cross term asks for
    if b == 0 and gamma * a * a >= 1:
        raise NoSolution("no action has an effect on a part of the state that does not go to 0 by itself")
    if b == 0:
        work.say(_unmoved(given, modes, mode))
        value = cost / (1 - gamma * a * a) * (1 if given.notation.costs else -1)
        work.give(system.root, value, i=mode)
        return value
    if r and cost == 0 and gamma * left * left == 1:
        raise NoSolution("to bring the state to 0 can be made as cheap as one likes, so no action is the best")
    known = {**system.letters.known(mode, **numbers), "gamma": gamma}
    if mode > 1:
        work.say(f"Likewise ${_letter(given.notation.value, modes, mode)}$:")
    else:
        work.say("The best gain for a value of the next states is:")
        work.recall(system.gain)
        work.say("Put into the equation:")
    work.lines.append(Step(system.equation, system.equation.right, known, None, "="))
    if mode <= 1:
        work.say("This is multiplied by its denominator, multiplied out and collected:")
        work.lines += [Equality(line, (right,)) for line, right in system.cleared]
        work.say(f"With $β$ for what stands at ${_letter(given.notation.value, modes, 'i')}$:")
    beta: Value = work.step(system.beta, **known)
    known |= system.letters.known(mode, beta=beta)
    if work.misconception is None:  # nobody reads the working of a mistake
        work.lines += _quadratic(given, system, known, numbers, beta)
    if mode <= 1:
        squares = q * r - n * n
        product = -squares / (gamma * b * b)
        work.say(
            _which(given, _letter(given.notation.value, modes, mode), product, squares, rests=gamma * left * left < 1)
        )
    found: Value = work.step(system.root, **known)
    if is_rational(found) and found != 0 and (other := (n * n - q * r) / (gamma * b * b * found)) != 0:
        side = "negative" if given.notation.costs else "positive"
        work.say(f"The other root, ${told(other)}$, is {side}, so it is not the one.")
    return found


def _quadratic(
    given: Given, system: ScalarSystem, known: Mapping[str, Any], numbers: Mapping[str, fmpq], beta: Value
) -> tuple[Equality, Equality]:
    """The equation of P with the numbers put in, and worked out."""
    b, q, r, n = (numbers[name] for name in "BQRN")
    of_unknown = (exact(given.gamma) * b * b, beta * (-1 if given.notation.costs else 1), n * n - q * r)
    put_in_ = put_in(system.quadratic, known)
    return Equality(put_in_, (ZERO,)), Equality(_polynomial(of_unknown, system, known), (ZERO,))


def _polynomial(coefficients: Sequence[Value], system: ScalarSystem, known: Mapping[str, Any]) -> Expr:
    """What is 0 for P, worked out: the coefficients of its square, of itself, and what stands alone."""
    unknown = put_in(system.letters.value, known)
    powers = (unknown**2, unknown, sympy.S.One)
    terms = (to_sympy(number) * power for number, power in zip(coefficients, powers, strict=True))
    return sum_of(term for term in terms if term != 0)


def _unmoved(given: Given, modes: Modes, mode: int) -> str:
    """What is left of the equation where B is 0."""
    A, Q, R, N, P, L = (
        _letter(name, modes, mode) for name in ("A", "Q", "R", "N", given.notation[3], given.notation[2])
    )
    cost = f"{Q} − {N}^2/{R}" if given.N else Q
    signed = cost if given.notation.costs else f"−({cost})" if given.N else f"−{Q}"
    gamma, gain = "" if given.gamma == 1 else "γ ", f"{N}/{R}" if given.N else "0"
    return f"No action has an effect here, so the gain is ${L} = {gain}$, and ${P} = {signed} + {gamma}{A}^2 {P}$:"


class _Modes(NamedTuple):
    """Coordinates, the columns of T, in which a system falls apart, and A, B, Q, R and N in them."""

    T: AnyMatrix
    split: tuple[AnyMatrix, ...]

    def in_modes(self, matrix: AnyMatrix) -> AnyMatrix:
        """A matrix in these coordinates."""
        return self.T.inv() * matrix * self.T

    @property
    def kind(self) -> Modes:
        """Whether they are the entries of the state."""
        return Modes.SUM_AND_DIFFERENCE if self.T[0, 1] != 0 else Modes.ENTRIES

    def numbers(self, mode: int) -> dict[str, fmpq]:
        """A, B, Q, R and N of a mode, the first of which is 1."""
        return {name: matrix[mode - 1, mode - 1] for name, matrix in zip("ABQRN", self.split, strict=True)}

    @property
    def counted(self) -> range:
        """The numbers of the modes."""
        return range(1, self.T.nrows() + 1)


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


def _by_modes(work: Work, given: Given, modes: _Modes) -> AnyMatrix:
    """Every mode has a P of its own."""
    letters = "ABQRN" if given.N else "ABQR"
    if modes.kind is Modes.ENTRIES:
        work.say("All matrices are diagonal, so every entry of the state is a system of its own:")
    else:
        if work.misconception is None:
            _taken_apart(work, modes, letters)
    for mode in modes.counted:
        numbers = modes.numbers(mode)
        own = ", ".join(f"{_letter(name, modes.kind, mode)} {equals(numbers[name])}" for name in letters)
        work.say(f"{_called(modes, mode)}: ${own}$.")
    roots = [_root(work, given, modes.numbers(mode), modes.kind, mode) for mode in modes.counted]
    return _back(work, modes, given.notation.value, roots)


def _called(modes: _Modes, mode: int) -> str:
    if modes.kind is Modes.ENTRIES:
        return f"Entry {mode}"
    return f"Mode {mode}, the {('sum', 'difference')[mode - 1]}"


def _taken_apart(work: Work, modes: _Modes, letters: str) -> None:
    """What every matrix does to the sum and to the difference."""
    work.say(
        "The modes are the sum and the difference of the two states, and of the two actions, each over $√2$, so that "
        "the squares add up to the same. The columns of $T$, $(1, 1)$ and $(1, −1)$, point along them, and every "
        "matrix multiplies each column by a number, its number in that mode:"
    )
    same = []
    for name, split in zip(letters, modes.split, strict=False):
        if split[0, 0] == split[1, 1]:
            same.append(f"${name}$")
            continue
        on_columns, of_columns = of_a_mode(name)
        matrix = modes.T * split * modes.T.inv()
        known = {f"{name}i": matrix, f"{name}m": split, "modes": modes.T}
        work.lines.append(
            Equality(on_columns, (put_in(on_columns, known), matrix * modes.T, put_in(of_columns, known), of_columns))
        )
    if same:
        work.say(f"{joined(same)} {'are multiples' if len(same) > 1 else 'is a multiple'} of $I$.")


def _gain_by_modes(work: Work, given: Given, modes: _Modes, P: AnyMatrix, gamma: fmpq) -> AnyMatrix:
    """The gain of every mode, then of the states."""
    system, hat = _system(given, modes.kind), modes.in_modes(P)
    gains = [
        work.step(
            system.gain,
            **system.letters.known(mode, **modes.numbers(mode), value=hat[mode - 1, mode - 1]),
            gamma=gamma,
        )
        for mode in modes.counted
    ]
    return _back(work, modes, given.notation.gain, gains)


def _back(work: Work, modes: _Modes, head: str, entries: list[Value]) -> AnyMatrix:
    """A matrix of the states from its entries in the modes."""
    size = len(entries)
    diagonal = matrices.matrix([[entries[i] if i == j else 0 for j in range(size)] for i in range(size)])
    if modes.kind is Modes.ENTRIES:
        work.say("These are the entries of the diagonal:")
        work.lines.append(Equality(back_from_modes(head).left, (diagonal,)))
        return diagonal
    work.say("Back in the entries of the state, where $T^{−1} = 1/2·T$, since $T^2 = 2 I$:")
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
    LOOP_WITH_PLUS.where_it_shows(),
    NEXT_NOT_DISCOUNTED.where_it_shows(),
    linear_quadratic.cost_to_go(solve, lambda _: slice(1)),
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
        wide = abs(loop[0, 0]) > abs(at(needed(given.closed_loop)))
        prices[int(wide == (given.unknown == "R"))] = middle
    return (S[0, 0], middle)
