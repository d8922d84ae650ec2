"""Sarsa along a run: each update with the values then current."""

from rldrill.problems.control.sarsa import Given
from rldrill.solutions.asking_back import oracle_along
from rldrill.solutions.learning import learn
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.control import (
    MAX_FOR_TAKEN,
    SARSA,
    SARSA_FORGOT_GAMMA,
    SARSA_TD_ERROR,
    STATE_FOR_NEXT,
    TARGET_FOR_PAIR,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (MAX_FOR_TAKEN, STATE_FOR_NEXT, SARSA_FORGOT_GAMMA, TARGET_FOR_PAIR.where_it_shows())


def solve(given: Given, work: Work) -> None:
    """One update for every transition."""
    learn(given, work, SARSA, SARSA_TD_ERROR)


def oracle(given: Given) -> Answers:
    """The values after the run; or where they are what is known, the step size or discount that leads there."""
    return oracle_along(given, _learned, given.updated)


def _learned(given: Given) -> Answers:
    """The whole run as one product of matrices, which act on all action values and a 1 below them."""
    pairs = [(state, action) for state, row in given.values.items() for action in row]
    start = np.array([*(at(given.values[state][action]) for state, action in pairs), 1.0])
    whole = np.eye(len(start))
    errors = []
    for state, action, after, reward, following in given.moves:
        error = np.zeros(len(start))
        error[-1] = at(reward)
        error[pairs.index((state, action))] = -1
        if following is not None and after not in given.terminal:
            error[pairs.index((after, following))] += at(given.gamma)
        errors.append(error @ whole @ start)
        update = np.eye(len(start))
        update[pairs.index((state, action))] += at(given.alpha) * error
        whole = update @ whole
    final = whole @ start
    answers = ([final[pairs.index(pair)] for pair in given.updated],)
    return (errors if len(errors) > 1 else errors[0], *answers) if given.td_errors else answers
