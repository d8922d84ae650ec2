"""The n-step returns asked for, each from its formula."""

from collections.abc import Callable, Mapping
from typing import Any

from rldrill.problems.exact import Scalar
from rldrill.problems.fractions import Fraction
from rldrill.problems.runs import per_step
from rldrill.problems.temporal_difference.n_step_return import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, Value, exact
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.reversible import find, reading, tried, with_letter
from rldrill.solutions.sheet.fundamentals import STEP_UNDISCOUNTED
from rldrill.solutions.sheet.temporal_difference import (
    BOOTSTRAP_AT_START,
    BOOTSTRAP_ONE_SHORT,
    BOOTSTRAP_UNDISCOUNTED,
    FROM_TIME_0,
    N_STEP_RETURN,
    N_STEP_RETURN_STEP_BY_STEP,
    ONE_REWARD_TOO_MANY,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (
    BOOTSTRAP_UNDISCOUNTED,
    BOOTSTRAP_ONE_SHORT,
    ONE_REWARD_TOO_MANY,
    STEP_UNDISCOUNTED,
    BOOTSTRAP_AT_START.where_it_shows(),
    FROM_TIME_0.where_it_shows(),
)


def solve(given: Given, work: Work) -> None:
    """One application for every part; where the first return is known, what was left open comes before the others."""
    read: Callable[[Scalar], Value] = exact
    asked = given.asked
    if given.known is not None:
        time, steps = asked[0]
        first = n_step(work, _known(given, exact), time, steps)
        letter = find(given, work, first, f"R_{{{time}}}^{{({steps})}}")
        read, asked = reading(letter), asked[1:]
    known = _known(given, read)
    end = len(given.trajectory.rewards)
    for time, steps in asked:
        if time + steps > end:
            work.say(f"The episode ends at $t = {end}$. All later rewards are $0$, so this is the whole return:")
        work.answer(n_step(work, known, time, steps))


def _known(given: Given, read: Callable[[Scalar], Value]) -> dict[str, Any]:
    run, gamma = given.trajectory, given.gamma
    known = knowns.trajectory(run)
    if isinstance(gamma, tuple):
        known["gammas"] = {time: read(each) for time, each in enumerate(gamma, 1)}
    else:
        known["gamma"] = read(gamma)
    known["V"] = {state: read(value) for state, value in given.values.items()} | dict.fromkeys(run.terminal, ZERO)
    end = len(run.rewards)
    beyond = range(end + 1, max(end, *(time + steps for time, steps in given.asked)) + 2)
    known["r"] |= dict.fromkeys(beyond, ZERO)  # nothing comes after the run
    known["S"] |= dict.fromkeys(beyond, run.states[-1])
    return known


def n_step(work: Work, known: Mapping[str, Any], time: int, steps: int) -> Value:
    """An n-step return from its formula; or where every step has its own discount, backwards from the value."""
    if "gamma" in known:
        return work.step(N_STEP_RETURN, t=time, n=steps, **known)
    steps = min(steps, len(known["gammas"]) - time)
    value = known["V"][known["S"][time + steps]]
    for n in range(1, steps + 1):
        start = time + steps - n
        value = work.step(N_STEP_RETURN_STEP_BY_STEP, t=start, n=n, Gn={(start + 1, n - 1): value}, **known)
    return value


def oracle(given: Given) -> Answers:
    """Backwards from the bootstrap: worth = reward + γ · worth."""
    if given.known is not None:
        letter = tried(given, lambda trial: float(oracle(trial)[0]))
        return (letter, *oracle(with_letter(given, Fraction(letter).limit_denominator(10**6)))[1:])
    run = given.trajectory
    gammas = per_step(given.gamma, len(run.rewards))
    answers = []
    for time, steps in given.asked:
        steps = min(steps, len(run.rewards) - time)
        last = run.states[time + steps]
        worth = 0.0 if last in run.terminal else at(given.values[last])
        for reward, gamma in reversed([*zip(run.rewards, gammas, strict=True)][time : time + steps]):
            worth = at(reward) + at(gamma) * worth
        answers.append(worth)
    return answers
