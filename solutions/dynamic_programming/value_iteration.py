"""Synchronous sweeps of value iteration, then the greedy actions."""

from collections.abc import Callable

import numpy as np

from rldrill.problems.dynamic_programming.value_iteration import Given
from rldrill.problems.models import Model
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, Value, exact
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.formula.notation import V, numbered, pi
from rldrill.solutions.oracle import Answers, at, best_actions, lookahead, tensors
from rldrill.solutions.sheet.bellman import FORGOT_GAMMA
from rldrill.solutions.sheet.dynamic_programming import (
    GREEDY_FROM_V,
    MEAN_FOR_MAX,
    VALUE_ITERATION,
)
from rldrill.solutions.work import Work


def solve(
    given: Given,
    work: Work,
    in_place: bool = False,
    ends: Callable[[Model], dict[str, Value]] = lambda mdp: dict.fromkeys(mdp.terminal, ZERO),
) -> None:
    """Each sweep from the values of the one before; an end is worth nothing."""
    mdp = given.mdp
    known = knowns.model(mdp) | {"gamma": exact(given.gamma)}
    values = dict.fromkeys(mdp.states, ZERO) | knowns.values(given.start or {}) | ends(mdp)
    for sweep in range(1, given.sweeps + 1):
        work.say(f"Sweep {sweep}:")
        before = values
        for state in mdp.states:
            V_k = values if in_place else before
            values = values | {state: work.step(VALUE_ITERATION, s=state, V=V_k, into=numbered(V, sweep), **known)}
    values |= work.answer({state: values[state] for state in mdp.states})
    work.answer({state: work.step(GREEDY_FROM_V, s=state, V=values, into=pi, **known) for state in mdp.states})


@slip(
    "in-place",
    "A synchronous sweep uses the values of the sweep before; values found in this sweep wait for the next.",
)
def newest(given: Given, work: Work) -> None:
    """Every value is used as soon as it is there."""
    solve(given, work, in_place=True)


@slip(
    "terminal-reward-twice",
    "A terminal state is worth 0: the reward for reaching it is earned once, on the way there.",
    when=lambda given: knowns.pays_at_the_end(given.mdp),
)
def paid_twice(given: Given, work: Work) -> None:
    """An end is worth what the way there earned."""
    solve(given, work, ends=knowns.last_rewards)


MISCONCEPTIONS = (newest, paid_twice, MEAN_FOR_MAX, FORGOT_GAMMA)


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
