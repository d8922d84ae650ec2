"""Q-learning along a run: each update with the values then current."""

from rldrill.problems.control.q_learning import Given
from rldrill.solutions.asking_back import oracle_along
from rldrill.solutions.learning import learn
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.control import (
    MAX_OF_OLD_STATE,
    MEAN_FOR_MAX,
    NOT_DISCOUNTED,
    Q_LEARNING,
    Q_LEARNING_TD_ERROR,
    TAKEN_FOR_MAX,
    TARGET_FOR_PAIR,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (
    TAKEN_FOR_MAX,
    MEAN_FOR_MAX,
    NOT_DISCOUNTED,
    MAX_OF_OLD_STATE.where_it_shows(),
    TARGET_FOR_PAIR.where_it_shows(),
)


def solve(given: Given, work: Work) -> None:
    """One update for every transition."""
    learn(given, work, Q_LEARNING, Q_LEARNING_TD_ERROR)


def oracle(given: Given) -> Answers:
    """The values after the run; or where they are what is known, the step size or discount that leads there."""
    return oracle_along(given, _learned, given.updated)


def _learned(given: Given) -> Answers:
    """The update as a weighted mean of old value and target, on nested dictionaries of floats."""
    table = {state: {action: at(value) for action, value in row.items()} for state, row in given.values.items()}
    errors = []
    for state, action, after, reward, _ in given.moves:
        best = 0.0 if after in given.terminal else sorted(table[after].values())[-1]
        errors.append(at(reward) + at(given.gamma) * best - table[state][action])
        table[state][action] += at(given.alpha) * errors[-1]
    answers = ([table[state][action] for state, action in given.updated],)
    return (errors if len(errors) > 1 else errors[0], *answers) if given.td_errors else answers
