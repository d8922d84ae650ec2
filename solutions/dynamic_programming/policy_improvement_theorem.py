"""One step of the other policy, held against the first policy's values in every state."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from rldrill.problems.dynamic_programming.policy_improvement_theorem import Given
from rldrill.problems.valued import deterministic
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, NoSolution, Value, exact, sign
from rldrill.solutions.formula.formula import fork
from rldrill.solutions.oracle import Answers, at, chances, lookahead, policy_values, tensors
from rldrill.solutions.policy_values import ONE_SWEEP, evaluated
from rldrill.solutions.sheet.bellman import BELLMAN_Q
from rldrill.solutions.sheet.dynamic_programming import POLICY_IMPROVEMENT_THEOREM, POLICY_ITERATION
from rldrill.solutions.work import Work


def _better_here_worse_there(given: Given) -> bool:
    try:
        gaps = _gaps(given, Work()).values()
    except NoSolution:
        return False
    return any(gap > 0 for gap in gaps) and any(gap < 0 for gap in gaps)


NEW_VALUES = fork(
    "values-of-the-new-policy",
    "Q^π(s, π′(s)) takes π′ for one step only and goes on with π; the theorem does not need the values of π′.",
    when=lambda given: given.policy != given.other,
)
ONE_STATE = fork(
    "one-state-enough",
    "The inequality must hold in every state; where it fails in one, the theorem says nothing.",
    when=_better_here_worse_there,
)
MISCONCEPTIONS = (NEW_VALUES, ONE_STATE, ONE_SWEEP)


def solve(given: Given, work: Work) -> None:
    """What one step of the other policy is worth; the theorem applies if that is never a loss."""
    gaps = _gaps(given, work)
    applies = all(gap >= 0 for gap in gaps.values())
    if work.makes(ONE_STATE):
        applies = any(gap > 0 for gap in gaps.values())
    elif applies:
        work.say("This holds in every state, so $π'$ is at least as good as $π$.")
    else:
        work.say("This does not hold in every state, so the theorem says nothing about $π'$.")
    work.answer(applies)


def _gaps(given: Given, work: Work) -> Mapping[str, int]:
    """Whether one step of the other policy is worth more (1), as much (0) or less (−1) in every state."""
    mdp = given.mdp
    known = knowns.model(mdp) | {"gamma": exact(given.gamma)}
    if given.values is None:
        found = evaluated(work, POLICY_ITERATION, mdp, known | {"pi": given.policy})
        answered: Mapping[str, Value] = work.answer({state: found[state] for state in mdp.states})
    else:
        answered = knowns.values(given.values)
    values = {**answered, **dict.fromkeys(mdp.terminal, ZERO)}
    if work.makes(NEW_VALUES):
        after = evaluated(work, POLICY_ITERATION, mdp, known | {"pi": given.other})
        worth = {pair: after[pair[0]] for pair in given.pairs}
    else:
        worth = {(state, a): work.step(BELLMAN_Q, s=state, a=a, V=values, **known) for state, a in given.pairs}
    worth = work.answer(worth)
    gaps = {state: sign(worth[state, a] - values[state]) for state, a in given.pairs}
    for state, gap in gaps.items():
        holds = "<" if gap < 0 else "≥"
        work.step(POLICY_IMPROVEMENT_THEOREM, sign=holds, s=state, V=values, pi1=given.other)
    return gaps


def oracle(given: Given) -> Answers:
    """Both policies as one-hot rows: the second picks from the lookahead on the first one's values."""
    states = (*given.mdp.states, *given.mdp.terminal)
    n = len(given.mdp.states)
    P, R = tensors(given.mdp, states)
    first, second = (chances(deterministic(pi), given.mdp, states) for pi in (given.policy, given.other))
    V = policy_values(P, R, first, at(given.gamma))
    worth = lookahead(P, R, V, at(given.gamma))[:n][second[:n] > 0]
    answers: list[Any] = [V[:n]] if given.values is None else []
    answers += [worth, bool(np.all(worth > V[:n] - 1e-9))]
    return answers
