"""The n-step returns asked for, each from its formula."""

from rldrill.problems.temporal_difference.n_step_return import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, exact
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.temporal_difference import (
    BOOTSTRAP_ONE_SHORT,
    BOOTSTRAP_UNDISCOUNTED,
    N_STEP_RETURN,
    ONE_REWARD_TOO_MANY,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (BOOTSTRAP_UNDISCOUNTED, BOOTSTRAP_ONE_SHORT, ONE_REWARD_TOO_MANY)


def solve(given: Given, work: Work) -> None:
    """One application for every part."""
    run = knowns.trajectory(given.trajectory)
    run["r"] |= {len(given.trajectory.rewards) + 1: ZERO}  # nothing comes after the run
    known = run | {
        "V": knowns.state_values(given.values, given.trajectory.terminal),
        "gamma": exact(given.gamma),
    }
    for time, steps in given.asked:
        work.answer(work.step(N_STEP_RETURN, t=time, n=steps, **known))


def oracle(given: Given) -> Answers:
    """Backwards from the bootstrap: worth = reward + γ · worth."""
    run = given.trajectory
    answers = []
    for time, steps in given.asked:
        last = run.states[time + steps]
        worth = 0.0 if last in run.terminal else at(given.values[last])
        for reward in reversed(run.rewards[time : time + steps]):
            worth = at(reward) + at(given.gamma) * worth
        answers.append(worth)
    return answers
