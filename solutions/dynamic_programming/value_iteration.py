"""Synchronous sweeps of value iteration, then the greedy actions."""

import numpy as np

from rldrill.problems.dynamic_programming.value_iteration import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, exact
from rldrill.solutions.formula.formula import fork
from rldrill.solutions.formula.notation import V, numbered, pi
from rldrill.solutions.oracle import Answers, at, best_actions, lookahead, tensors
from rldrill.solutions.sheet.bellman import FORGOT_GAMMA
from rldrill.solutions.sheet.dynamic_programming import (
    GREEDY_FROM_V,
    MEAN_FOR_MAX,
    VALUE_ITERATION,
)
from rldrill.solutions.work import Work

IN_PLACE = fork(
    "in-place",
    "A synchronous sweep uses the values of the sweep before; values found in this sweep wait for the next.",
)
TERMINAL_TWICE = fork(
    "terminal-reward-twice",
    "A terminal state is worth 0: the reward for reaching it is earned once, on the way there.",
    when=lambda given: knowns.pays_at_the_end(given.mdp),
)
MISCONCEPTIONS = (IN_PLACE, TERMINAL_TWICE, MEAN_FOR_MAX, FORGOT_GAMMA)


def solve(given: Given, work: Work) -> None:
    """Each sweep from the values of the one before."""
    mdp = given.mdp
    known = knowns.model(mdp) | {"gamma": exact(given.gamma)}
    ends = dict.fromkeys(mdp.terminal, ZERO)
    if work.makes(TERMINAL_TWICE):
        ends |= knowns.last_rewards(mdp)
    values = dict.fromkeys(mdp.states, ZERO) if given.start is None else knowns.values(given.start)
    values |= ends
    for sweep in range(1, given.sweeps + 1):
        work.say(f"Sweep {sweep}:")
        old = values
        values = dict(ends)
        for state in mdp.states:
            current = old | values if work.makes(IN_PLACE) else old
            values[state] = work.step(VALUE_ITERATION, s=state, V=current, into=numbered(V, sweep), **known)
    values = ends | work.answer({state: values[state] for state in mdp.states})
    work.answer({state: work.step(GREEDY_FROM_V, s=state, V=values, into=pi, **known) for state in mdp.states})


def oracle(given: Given) -> Answers:
    """The same sweeps as array operations; the greedy action by trying all."""
    states = (*given.mdp.states, *given.mdp.terminal)
    P, R = tensors(given.mdp, states)
    V = np.array([at((given.start or {}).get(state, 0)) for state in states])
    n = len(given.mdp.states)
    for _ in range(given.sweeps):
        V = np.concatenate([lookahead(P, R, V, at(given.gamma))[:n].max(axis=1), V[n:] * 0])
    worth = lookahead(P, R, V, at(given.gamma))[:n]
    return (V[:n], best_actions(given.mdp, worth))
