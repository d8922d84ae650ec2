"""The return from its definition, then backwards in time by the recursion."""

from typing import Any

import numpy as np

from rldrill.problems.runs import per_step
from rldrill.solutions.exact import ZERO, exact
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.fundamentals import (
    FIRST_DISCOUNTED,
    LINEAR_DISCOUNT,
    RETURN,
    RETURN_RECURSIVE,
    RETURN_STEP_BY_STEP,
    STARTS_EARLY,
    STEP_UNDISCOUNTED,
    UNDISCOUNTED,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (FIRST_DISCOUNTED, STARTS_EARLY, UNDISCOUNTED, LINEAR_DISCOUNT, STEP_UNDISCOUNTED)


# "return" is a keyword, so the twin's Given cannot be imported by name; hence Any.
def solve(given: Any, work: Work) -> None:
    """The return asked for by its definition; earlier ones by the recursion."""
    end = len(given.rewards)
    known = {"r": {0: ZERO} | {time + 1: exact(reward) for time, reward in enumerate(given.rewards)}, "T": end}
    if isinstance(given.gamma, tuple):
        _step_by_step(given, work, known)
        return
    known["gamma"] = exact(given.gamma)
    if given.time is None:
        work.answer(tuple(work.step(RETURN, t=time, **known) for time in range(end)))
        return
    value = work.answer(work.step(RETURN, t=given.time, **known))
    if given.time == 0:
        return
    if work.misreads(RETURN):  # the recursion holds for the true definition only
        value = work.step(RETURN, t=0, **known)
    else:
        for time in reversed(range(given.time)):
            value = work.step(RETURN_RECURSIVE, t=time, G={time + 1: value}, **known)
    work.answer(value)


def _step_by_step(given: Any, work: Work, known: dict[str, Any]) -> None:
    """Backwards in time, each step with its own discount."""
    known["gammas"] = {time: exact(gamma) for time, gamma in enumerate(given.gamma, 1)}
    G = {known["T"]: ZERO}
    for time in reversed(range(known["T"])):
        G[time] = work.step(RETURN_STEP_BY_STEP, t=time, G=dict(G), **known)
        if time == given.time:
            G[time] = work.answer(G[time])
    if given.time is None:
        work.answer(tuple(G[time] for time in range(known["T"])))
    elif given.time:
        work.answer(G[0])


def oracle(given: Any) -> Answers:
    """Each reward weighted by hand, all times at once: an upper triangle of powers times the rewards."""
    rewards = np.array([at(reward) for reward in given.rewards])
    gammas = [at(gamma) for gamma in per_step(given.gamma, len(rewards))]
    weights = [np.r_[np.zeros(time), 1.0, np.cumprod(gammas[time:-1])] for time in range(len(rewards))]
    returns = np.array(weights) @ rewards
    return (returns,) if given.time is None else (returns[given.time], returns[0])
