"""Sarsa along a run: each update with the values then current."""

import numpy as np

from rldrill.problems.control.sarsa import Given
from rldrill.solutions import knowns
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.control import MAX_FOR_TAKEN, SARSA, SARSA_FORGOT_GAMMA, STATE_FOR_NEXT
from rldrill.solutions.work import Work

MISCONCEPTIONS = (MAX_FOR_TAKEN, STATE_FOR_NEXT, SARSA_FORGOT_GAMMA)


def solve(given: Given, work: Work) -> None:
    """One update for every transition."""
    run = given.trajectory
    known = knowns.action_run(given)
    for time, pair in enumerate(zip(run.states[:-1], run.actions, strict=False)):
        known["Q"] = known["Q"] | {pair: work.step(SARSA, t=time, **known)}
    work.answer({pair: known["Q"][pair] for pair in given.updated})


def oracle(given: Given) -> Answers:
    """The whole run as one product of matrices, which act on all action values and a 1 below them."""
    run = given.trajectory
    pairs = [(state, action) for state, row in given.values.items() for action in row]
    start = np.array([*(at(given.values[state][action]) for state, action in pairs), 1.0])
    whole = np.eye(len(start))
    visits = [pairs.index(pair) for pair in zip(run.states, run.actions, strict=False)]
    for time, reward in enumerate(run.rewards):
        update = np.eye(len(start))
        update[visits[time], visits[time]] -= at(given.alpha)
        update[visits[time], -1] += at(given.alpha) * at(reward)
        if run.states[time + 1] not in run.terminal:
            update[visits[time], visits[time + 1]] += at(given.alpha) * at(given.gamma)
        whole = update @ whole
    after = whole @ start
    return ([after[pairs.index(pair)] for pair in given.updated],)
