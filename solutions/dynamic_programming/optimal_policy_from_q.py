"""The action with the greatest value; a missing value is a reward and the best value after it."""

from rldrill.problems.dynamic_programming.optimal_policy_from_q import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, exact
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.bellman import (
    BELLMAN_OPTIMALITY_Q,
    OPTIMAL_Q_BY_REWARD,
    OPTIMAL_Q_BY_VALUE,
    OPTIMAL_Q_MEAN_FOR_MAX,
)
from rldrill.solutions.sheet.dynamic_programming import (
    GREEDY_FROM_Q,
    SMALLEST_Q,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (SMALLEST_Q, OPTIMAL_Q_BY_VALUE, OPTIMAL_Q_BY_REWARD, OPTIMAL_Q_MEAN_FOR_MAX)


def solve(given: Given, work: Work) -> None:
    """What is missing first, then the best action of every state."""
    actions = given.actions | dict.fromkeys(given.terminal, (knowns.NO_ACTION,))
    Q = {(state, action): exact(value) for state, row in given.values.items() for action, value in row.items()}
    Q |= {(state, knowns.NO_ACTION): ZERO for state in given.terminal}
    if given.missing and given.gamma is not None:
        known = knowns.model(given.missing) | {"actions": actions, "gamma": exact(given.gamma), "Q": Q}
        found = {(state, a): work.step(BELLMAN_OPTIMALITY_Q, s=state, a=a, **known) for state, a in given.gaps}
        Q = Q | work.answer(found)
    best = {state: work.step(GREEDY_FROM_Q, s=state, Q=Q, actions=actions) for state in given.values}
    work.answer(best)


def oracle(given: Given) -> Answers:
    """Each missing value as an expectation over its outcomes; the best action by sorting."""
    table = {state: {action: at(value) for action, value in row.items()} for state, row in given.values.items()}
    worth = {state: max(row.values()) for state, row in table.items() if row} | dict.fromkeys(given.terminal, 0.0)
    answers: list[object] = []
    if given.missing and given.gamma is not None:
        found = dict.fromkeys(given.gaps, 0.0)
        for row in given.missing.transitions:
            gain = at(row.reward) + at(given.gamma) * worth[row.next]
            found[row.state, row.action] += at(row.probability) * gain
        for (state, action), value in found.items():
            table[state][action] = value
        answers.append(list(found.values()))
    answers.append({s: {a for a, q in row.items() if q > max(row.values()) - 1e-9} for s, row in table.items()})
    return answers
