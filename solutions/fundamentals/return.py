"""The return from its definition, then backwards in time by the recursion."""

from importlib import import_module
from typing import Any

from rldrill.problems.runs import per_step
from rldrill.solutions.exact import ONE, ZERO, NoSolution, exact, sign, to_sympy
from rldrill.solutions.formula.notation import quantity, subscripted
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.reversible import find, tried
from rldrill.solutions.sheet.fundamentals import (
    FIRST_DISCOUNTED,
    LAST_LEFT_OUT,
    LINEAR_DISCOUNT,
    RETURN,
    RETURN_RECURSIVE,
    RETURN_STEP_BY_STEP,
    STARTS_EARLY,
    STEP_UNDISCOUNTED,
    UNDISCOUNTED,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (
    FIRST_DISCOUNTED,
    STARTS_EARLY,
    UNDISCOUNTED,
    LINEAR_DISCOUNT,
    STEP_UNDISCOUNTED,
    LAST_LEFT_OUT.where_it_shows(),
)


# "return" is a keyword, so the twin cannot be imported by name; hence Any.
EPISODES = import_module("rldrill.problems.fundamentals.return").EPISODES

#: The return of the second of two episodes.
_OF_SECOND = quantity("G", subscripted("R′"))


def solve(given: Any, work: Work) -> None:
    """The last return asked for by its definition; earlier ones by the recursion. Two episodes one after the other."""
    if hasattr(given, "others"):
        _compare(given, work)
        return
    end = len(given.rewards)
    known = {"r": {0: ZERO} | {time + 1: exact(reward) for time, reward in enumerate(given.rewards)}, "T": end}
    if isinstance(given.gamma, tuple):
        _step_by_step(given, work, known)
        return
    known["gamma"] = exact(given.gamma)
    if given.known is not None:
        find(given, work, work.step(RETURN, t=0, **known), "R_0")
        return
    last = end - 1 if given.time is None else given.time
    G = {last: work.step(RETURN, t=last, **known)}
    if given.time is not None:
        G[last] = work.answer(G[last])
    formula = RETURN if work.misreads(RETURN) else RETURN_RECURSIVE  # the recursion holds for the true definition only
    for time in reversed(range(last)):
        G[time] = work.step(formula, t=time, G=dict(G), **known)
    if given.time is None:
        work.answer(tuple(G[time] for time in range(end)))
    elif given.time:
        work.answer(G[0])


def _compare(given: Any, work: Work) -> None:
    gamma = exact(given.gamma)
    both = [_known(rewards) for rewards in (given.rewards, given.others)]
    first, second = (
        work.step(RETURN, t=0, **known, gamma=gamma, into=name)
        for known, name in zip(both, (None, _OF_SECOND), strict=True)
    )
    if given.sought:
        work.say("They are equal where")
        same = work.answer(work.equate("gamma", first, second))
        beyond = ONE if sign(ONE - same) > 0 else same + 1
        told = f"They are equal only there. With $γ = {to_sympy(beyond)}$, which is larger, the returns are"
    else:
        work.answer((first, second))
        beyond = ONE
        told = "Without a discount, $γ = 1$, the returns are the sums of the rewards,"
    written = (_added(each) if beyond == ONE else "" for each in (given.rewards, given.others))
    first, second = (work.value(RETURN, t=0, **known, gamma=beyond) for known in both)
    if first == second:
        raise NoSolution(
            f"with γ = {to_sympy(beyond)} both returns are {to_sympy(first)}, and it is asked which is larger"
        )
    larger = "A" if sign(first - second) > 0 else "B"
    ends = " and ".join(
        f"${name} = {sum_}{to_sympy(end)}$"
        for name, sum_, end in zip(("R_0", "R'_0"), written, (first, second), strict=True)
    )
    work.say(f"{told} {ends}: that of {EPISODES[larger]} episode is larger.")
    work.answer(larger)


def _added(rewards: Any) -> str:
    """The sum of rewards as one writes it down, before what it makes."""
    first, *others = map(str, rewards)
    return "".join([first, *(f" − {each[1:]}" if each.startswith("-") else f" + {each}" for each in others), " = "])


def _known(rewards: Any) -> dict[str, Any]:
    return {
        "r": {0: ZERO} | {time: exact(reward) for time, reward in enumerate(rewards, 1)},
        "T": len(rewards),
    }


def _step_by_step(given: Any, work: Work, known: dict[str, Any]) -> None:
    """Backwards in time, each step with its own discount."""
    known["gammas"] = {time: exact(gamma) for time, gamma in enumerate(given.gamma, 1)}
    G = {known["T"]: ZERO}
    for time in reversed(range(known["T"])):
        G[time] = work.step(RETURN_STEP_BY_STEP, t=time, G=dict(G), **known)
        if time == given.time and given.known is None:
            G[time] = work.answer(G[time])
    if given.known is not None:
        find(given, work, G[0], "R_0")
    elif given.time is None:
        work.answer(tuple(G[time] for time in range(known["T"])))
    elif given.time:
        work.answer(G[0])


def oracle(given: Any) -> Answers:
    """Each reward weighted by hand, all times at once: an upper triangle of powers times the rewards."""
    if hasattr(given, "others"):
        return _compared(given)
    if given.known is not None:
        return (tried(given, lambda tried: oracle(tried.model_copy(update={"time": 0}))[0]),)
    rewards = np.array([at(reward) for reward in given.rewards])
    gammas = [at(gamma) for gamma in per_step(given.gamma, len(rewards))]
    weights = [np.r_[np.zeros(time), 1.0, np.cumprod(gammas[time:-1])] for time in range(len(rewards))]
    returns = np.array(weights) @ rewards
    return (returns,) if given.time is None else (returns[given.time], returns[0])


def _compared(given: Any) -> Answers:
    """The polynomials in γ: their values, or the root of their difference and the sign to the right of it."""
    first, second = (np.polynomial.Polynomial([at(r) for r in rewards]) for rewards in (given.rewards, given.others))
    root = float((first - second).roots()[0]) if given.sought else at(given.gamma)
    larger = "A" if (first - second)(root + 0.01 if given.sought else 1.0) > 0 else "B"
    return (root if given.sought else (first(root), second(root)), larger)
