"""TD(0) along a run: each update with the values then current."""

from rldrill.problems.temporal_difference.td_zero import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import exact
from rldrill.solutions.formula.formula import fork
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.bellman import FORGOT_GAMMA
from rldrill.solutions.sheet.temporal_difference import TARGET_ONLY, TD_ZERO, WRONG_SIGN
from rldrill.solutions.work import Work

STALE = fork(
    "stale-values",
    "Each update uses the values that are current then, changed ones included; the old ones were kept.",
    when=lambda given: len(given.trajectory.rewards) > len(given.visited),
)
MISCONCEPTIONS = (FORGOT_GAMMA, STALE, TARGET_ONLY, WRONG_SIGN)


def solve(given: Given, work: Work) -> None:
    """One update for every transition."""
    known = knowns.trajectory(given.trajectory) | {"alpha": exact(given.alpha), "gamma": exact(given.gamma)}
    before = knowns.state_values(given.values, given.trajectory.terminal)
    values = before
    for time, state in enumerate(given.trajectory.states[:-1]):
        current = before if work.makes(STALE) else values
        values = values | {state: work.step(TD_ZERO, t=time, V=current, **known)}
    work.answer({state: values[state] for state in given.visited})


def oracle(given: Given) -> Answers:
    """The update as a weighted mean of old value and target, on a plain dictionary of floats."""
    run = given.trajectory
    values = {state: at(number) for state, number in given.values.items()} | dict.fromkeys(run.terminal, 0.0)
    for state, after, reward in zip(run.states, run.states[1:], run.rewards, strict=False):
        target = at(reward) + at(given.gamma) * values[after]
        values[state] = (1 - at(given.alpha)) * values[state] + at(given.alpha) * target
    return ([values[state] for state in given.visited],)
