"""The return from its definition, then backwards in time by the recursion."""

from typing import Any

import numpy as np

from rldrill.solutions.exact import ZERO, exact
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.fundamentals import (
    FIRST_DISCOUNTED,
    LINEAR_DISCOUNT,
    RETURN,
    RETURN_RECURSIVE,
    STARTS_EARLY,
    UNDISCOUNTED,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (FIRST_DISCOUNTED, STARTS_EARLY, UNDISCOUNTED, LINEAR_DISCOUNT)


# "return" is a keyword, so the twin's Given cannot be imported by name; hence Any.
def solve(given: Any, work: Work) -> None:
    """The return asked for by its definition; earlier ones by the recursion."""
    end = len(given.rewards)
    known = {
        "gamma": exact(given.gamma),
        "r": {0: ZERO} | {time + 1: exact(reward) for time, reward in enumerate(given.rewards)},
        "T": end,
    }
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


def oracle(given: Any) -> Answers:
    """Each reward weighted by hand, all times at once: an upper triangle of powers times the rewards."""
    rewards = np.array([at(reward) for reward in given.rewards])
    steps = np.arange(len(rewards))[None, :] - np.arange(len(rewards))[:, None]
    weights = np.where(steps >= 0, at(given.gamma) ** np.maximum(steps, 0), 0.0)
    returns = weights @ rewards
    return (returns,) if given.time is None else (returns[given.time], returns[0])
