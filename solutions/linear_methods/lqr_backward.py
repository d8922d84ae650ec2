"""The Riccati recursion backwards from the horizon: at every time first the gain, then the value matrix."""

from typing import Any

from msgspec.structs import replace

from rldrill.problems.exact import shown
from rldrill.problems.fractions import Fraction
from rldrill.problems.linear_methods.lqr_backward import Given
from rldrill.solutions import linear_quadratic
from rldrill.solutions.exact import NoSolution, exact
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.matrices import AnyMatrix
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.linear_methods import (
    FORGOT_R,
    FORGOT_R_IN_COSTS,
    LQR_GAIN,
    NEXT_NOT_DISCOUNTED,
    NO_TERMINAL,
    NO_TERMINAL_COST,
    POSITIVE_S,
    TRANSPOSED_A,
    Quadratic,
    in_costs,
    quadratic,
)
from rldrill.solutions.slips import right_answers
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """Two parts for every time that is asked for; the last is the action."""
    lqr = _formulas(given)
    if lqr.gain is LQR_GAIN:
        work.say(in_costs(len(given.start)))
    known = linear_quadratic.known(given)
    if given.plain and not given.notation.costs:
        work.say(f"At the last time, $T = {given.horizon}$, the best action is $0$, so $V_T(s) = −s^⊤ Q_T s$.")
    P = {given.horizon: work.step(lqr.terminal, T=given.horizon, **known)}
    start = {0: linear_quadratic.start(given)}
    if given.action is not None:
        gain = _gain(lqr, work, 0, Pt=P, **known)
        action = work.step(lqr.action, t=0, Lt={0: gain}, St=start)
        work.say(f"${given.notation.action}_0$ must be ${shown(given.action)}$:")
        price = work.answer(work.equate("rho", action[0, 0], exact(given.action), positive=True))
        priced = work.answer(linear_quadratic.with_price(work, lqr, gain, price))
        work.answer(work.step(lqr.riccati, t=0, Pt=P, Lt={0: priced}, **known))
        return
    for time in reversed(range(given.horizon)):
        L = {time: _gain(lqr, work, time, Pt=P, **known)}
        L = {time: work.answer(L[time])} if time in given.asked else L
        P = P | {time: work.step(lqr.riccati, t=time, Pt=P, Lt=L, **known)}
        P = P | {time: work.answer(P[time])} if time in given.asked else P
    work.answer(work.step(lqr.action, t=0, Lt=L, St=start))


def _formulas(given: Given) -> Quadratic:
    return quadratic(given.notation, discounted=given.gamma != 1, crossed=given.N is not None)


def _forwards(given: Given) -> bool:
    """Whether the price is given, not found."""
    return given.action is None


def _gain(lqr: Quadratic, work: Work, time: int, **known: Any) -> AnyMatrix:
    try:
        gain: AnyMatrix = linear_quadratic.gain(work, lqr, t=time, **known)
    except NoSolution:
        raise NoSolution(
            f"at time {time} the matrix that is to be inverted for the gain is singular: some action costs nothing "
            "there and changes nothing that does, so no single one is the best; make R positive definite"
        ) from None
    return gain


@slip(
    "gain-from-same-time",
    "The action at time t leads to time t + 1, so Lₜ comes from Pₜ₊₁, not from Pₜ.",
    when=_forwards,
)
def same_time(given: Given, work: Work) -> None:
    """The right value matrices, and every gain from that of its own time."""
    lqr, known = _formulas(given), linear_quadratic.known(given)
    L: dict[int, Any] = {}
    for time, P in zip(given.asked, right_answers(solve, given, work)[_values(given)], strict=True):
        L = {time: work.answer(_gain(lqr, work, time, Pt={time + 1: P}, **known))}
        work.answer(P)
    work.answer(work.step(lqr.action, t=0, Lt=L, St={0: linear_quadratic.start(given)}))


def _values(given: Given) -> slice:
    """Which answers are value matrices: every second one, behind the price if that is asked for."""
    return slice(1 if _forwards(given) else 2, None, 2)


#: As for a single gain, but here matrices are given by time.
TRANSPOSED = replace(TRANSPOSED_A, when=lambda given: len(given.start) > 1)
COST_TO_GO = linear_quadratic.cost_to_go(solve, _values)
#: Where the price is to be found: without it, or without a value at the end, the gain says nothing of it.
OF_GIVEN_PRICES = tuple(
    replace(mistake, when=_forwards) for mistake in (FORGOT_R, FORGOT_R_IN_COSTS, NO_TERMINAL, NO_TERMINAL_COST)
)
MISCONCEPTIONS = (POSITIVE_S, *OF_GIVEN_PRICES, TRANSPOSED, same_time, COST_TO_GO, NEXT_NOT_DISCOUNTED.where_it_shows())


def oracle(given: Given) -> Answers:
    """The best plan for every unit state: all remaining states and actions at once, the dynamics as constraints."""
    if given.action is not None:
        price = _price(given, at(given.action))
        priced = given.model_copy(update={"R": (((Fraction(price),),),), "action": None})
        return [price, *oracle(priced)[:2]]
    answers = []
    m, sign = given.actions, 1 if given.notation.costs else -1
    gain: Array = np.zeros((m, len(given.start)))
    for time in given.asked:
        plan, cost = _best(given, time)
        gain = -plan[:m]
        answers += [gain, sign * cost]
    return [*answers, -gain @ np.array([at(entry) for entry in given.start])]


def _price(given: Given, action: float) -> float:
    """The price for which the action is the best: its worth without a price rises by what the price takes back."""
    now, after = (
        linear_quadratic.arrays(given.model_copy(update={"R": (((Fraction(0),),),)}), time) for time in (0, 1)
    )
    state = np.array([at(entry) for entry in given.start])

    def worth(a: float) -> float:
        moved = now["A"] @ state + now["B"] @ [a]
        return float(-at(given.gamma) * moved @ after["Q"] @ moved - 2 * state @ now["N"] @ [a])

    return (worth(action + 1) - worth(action - 1)) / (4 * action)


def _best(given: Given, first: int) -> tuple[Array, Array]:
    """Actions and states from a time on by the first state, and the matrix of what they cost.

    The plan holds a_0, s_1, a_1, s_2 and so on; a state is scaled by the root of its discount.
    """
    n, m, count, root = len(given.start), given.actions, given.horizon - first, at(given.gamma) ** 0.5
    size = (m + n) * count
    H, E = np.zeros((size, size)), np.zeros((n * count, size))
    slope, origin = np.zeros((size, n)), np.zeros((n * count, n))
    for step in range(count):
        now = linear_quadratic.arrays(given, first + step)
        action = slice((m + n) * step, (m + n) * step + m)
        after = slice(action.stop, action.stop + n)
        lines = slice(n * step, n * (step + 1))
        H[action, action] = now["R"]
        H[after, after] = linear_quadratic.arrays(given, first + step + 1)["Q"]
        E[lines, action], E[lines, after] = root * now["B"], -np.eye(n)
        if step == 0:
            slope[action], origin[lines] = now["N"].T, -root * now["A"]
        else:
            before = slice(action.start - n, action.start)
            H[before, action], H[action, before] = now["N"], now["N"].T
            E[lines, before] = root * now["A"]
    saddle = np.block([[H, E.T], [E, np.zeros((n * count,) * 2)]])
    plan = np.linalg.solve(saddle, np.vstack([-slope, origin]))[:size]
    here = linear_quadratic.arrays(given, first)["Q"]
    return np.asarray(plan, dtype=float), here + plan.T @ H @ plan + plan.T @ slope + slope.T @ plan
