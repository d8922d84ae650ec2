"""Q-learning along a run: each update with the values then current."""

from rldrill.problems.control.q_learning import Given
from rldrill.solutions import knowns
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.bellman import FORGOT_GAMMA
from rldrill.solutions.sheet.control import MEAN_FOR_MAX, Q_LEARNING, TAKEN_FOR_MAX
from rldrill.solutions.work import Work

MISCONCEPTIONS = (TAKEN_FOR_MAX, MEAN_FOR_MAX, FORGOT_GAMMA)


def solve(given: Given, work: Work) -> None:
    """One update for every transition."""
    known = knowns.action_run(given)
    for time, pair in enumerate(zip(given.trajectory.states[:-1], given.trajectory.actions, strict=False)):
        known["Q"] = known["Q"] | {pair: work.step(Q_LEARNING, t=time, **known)}
    work.answer({pair: known["Q"][pair] for pair in given.updated})


def oracle(given: Given) -> Answers:
    """The update as a weighted mean of old value and target, on nested dictionaries of floats."""
    run = given.trajectory
    table = {state: {action: at(value) for action, value in row.items()} for state, row in given.values.items()}
    for state, action, reward, after in zip(run.states, run.actions, run.rewards, run.states[1:], strict=False):
        best = 0.0 if after in run.terminal else sorted(table[after].values())[-1]
        target = at(reward) + at(given.gamma) * best
        table[state][action] += at(given.alpha) * (target - table[state][action])
    return ([table[state][action] for state, action in given.updated],)
