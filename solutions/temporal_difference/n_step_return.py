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
    run = given.trajectory
    known = knowns.trajectory(run) | {
        "V": knowns.state_values(given.values, run.terminal),
        "gamma": exact(given.gamma),
    }
    end = len(run.rewards)
    beyond = range(end + 1, max(end, *(time + steps for time, steps in given.asked)) + 2)
    known["r"] |= dict.fromkeys(beyond, ZERO)  # nothing comes after the run
    known["S"] |= dict.fromkeys(beyond, run.states[-1])
    for time, steps in given.asked:
        if time + steps > end:
            work.say(f"The episode ends at $t = {end}$; after that all rewards are $0$, so this is the whole return:")
        work.answer(work.step(N_STEP_RETURN, t=time, n=steps, **known))


def oracle(given: Given) -> Answers:
    """Backwards from the bootstrap: worth = reward + γ · worth."""
    run = given.trajectory
    answers = []
    for time, steps in given.asked:
        last = run.states[min(time + steps, len(run.rewards))]
        worth = 0.0 if last in run.terminal else at(given.values[last])
        for reward in reversed(run.rewards[time : time + steps]):
            worth = at(reward) + at(given.gamma) * worth
        answers.append(worth)
    return answers
