"""Eligibility traces along a run: every trace at every time."""

import numpy as np

from rldrill.problems.temporal_difference.eligibility_trace import Given
from rldrill.solutions.exact import ZERO, exact
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.temporal_difference import (
    ACCUMULATING,
    DECAY_WITHOUT_GAMMA,
    DECAY_WITHOUT_LAMBDA,
    ELIGIBILITY_TRACE,
    INCREMENT_FIRST,
    REPLACING,
    REPLACING_TRACE,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (DECAY_WITHOUT_GAMMA, DECAY_WITHOUT_LAMBDA, REPLACING, INCREMENT_FIRST, ACCUMULATING)


def solve(given: Given, work: Work) -> None:
    """One step for every time and every state that was visited by then; the other traces are still 0."""
    formula = REPLACING_TRACE if given.replacing else ELIGIBILITY_TRACE
    known = {"S": dict(enumerate(given.states)), "gamma": exact(given.gamma), "lam": exact(given.lam)}
    traces = dict.fromkeys(given.visited, ZERO)
    for time in range(given.asked[-1] + 1):
        work.say(f"At $t = {time}$:")
        reached = dict.fromkeys(given.states[: time + 1])
        traces = traces | {s: work.step(formula, s=s, t=time, e=traces, **known) for s in reached}
        if time in given.asked:
            traces = work.answer(traces)


def oracle(given: Given) -> Answers:
    """Every visit on its own: what is left of its 1 after as many steps, summed; or of the last visit alone."""
    decay = at(given.gamma) * at(given.lam)
    answers = []
    for time in given.asked:
        left = decay ** np.arange(time, -1, -1)
        visits = np.array([[state == visited for visited in given.states[: time + 1]] for state in given.visited])
        answers.append((visits * left).max(axis=1) if given.replacing else visits @ left)
    return answers
