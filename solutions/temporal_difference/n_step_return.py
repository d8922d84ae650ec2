"""The n-step returns asked for, each from its formula."""

from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

from rldrill.problems.exact import Scalar
from rldrill.problems.fractions import Fraction
from rldrill.problems.runs import Trajectory, per_step
from rldrill.problems.temporal_difference.n_step_return import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, Value, exact
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.reversible import find, reading, tried, with_letter
from rldrill.solutions.sheet.fundamentals import STEP_UNDISCOUNTED, UNDISCOUNTED
from rldrill.solutions.sheet.temporal_difference import (
    BOOTSTRAP_AT_START,
    BOOTSTRAP_ONE_SHORT,
    BOOTSTRAP_ONE_STATE_SHORT,
    BOOTSTRAP_UNDISCOUNTED,
    FROM_TIME_0,
    N_STEP_RETURN,
    N_STEP_RETURN_STEP_BY_STEP,
    ONE_REWARD_TOO_MANY,
)
from rldrill.solutions.work import Work

#: How a number of the problem is read: as it is, or with what was found for a letter.
Reading: TypeAlias = Callable[[Scalar], Value]


def solve(given: Given, work: Work) -> None:
    """One application for every part; where the first return is known, what was left open comes before the others."""
    _returns(given, work, _known)


def _returns(given: Given, work: Work, known_from: Callable[[Given, Reading], dict[str, Any]]) -> None:
    read: Reading = exact
    asked, end = given.asked, len(given.trajectory.rewards)
    if given.known is not None:
        time, steps = asked[0]
        first = n_step(work, known_from(given, exact), time, steps)
        letter = find(given, work, first, f"R_{{{time}}}^{{({steps})}}")
        read, asked = reading(letter), asked[1:]
    known = known_from(given, read)
    for time, steps in asked:
        if time + steps > end:
            work.say(f"The episode ends at $t = {end}$. All later rewards are $0$, so this is the whole return:")
        work.answer(n_step(work, known, time, steps))


def _known(given: Given, read: Reading) -> dict[str, Any]:
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


@slip(
    "value-after-the-end",
    "In a terminal state the episode is over: no value is added to the rewards, that of the state before it neither.",
    when=lambda given: given.trajectory.ends and max(map(sum, given.asked)) >= len(given.trajectory.rewards),
)
def value_after_the_end(given: Given, work: Work) -> None:
    """The end as if it were worth what the state before it is; longer returns than to the end are those to it."""
    end = len(given.trajectory.rewards)
    asked = tuple((time, min(steps, end - time)) for time, steps in given.asked)
    to_the_end = given.model_copy(update={"asked": asked})
    _returns(to_the_end, work, lambda given, read: worth_as_before(given.trajectory, _known(given, read)))


def worth_as_before(run: Trajectory, known: Mapping[str, Any]) -> dict[str, Any]:
    """What is known of a run, with the value of the last state that is left for that of its end."""
    return {**known, "V": known["V"] | dict.fromkeys(run.terminal, known["V"][run.states[-2]])}


MISCONCEPTIONS = (
    BOOTSTRAP_UNDISCOUNTED,
    BOOTSTRAP_ONE_SHORT,
    ONE_REWARD_TOO_MANY,
    STEP_UNDISCOUNTED,
    UNDISCOUNTED.where_it_shows(),
    BOOTSTRAP_AT_START.where_it_shows(),
    BOOTSTRAP_ONE_STATE_SHORT.where_it_shows(),
    FROM_TIME_0.where_it_shows(),
    value_after_the_end.where_it_shows(),
)


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
