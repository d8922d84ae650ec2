"""The λ-return as its definition has it: all n-step returns, weighted."""

from collections.abc import Mapping, Sequence
from typing import Any

from rldrill.problems.runs import Trajectory, per_step
from rldrill.problems.temporal_difference.lambda_return import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, Value, exact
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.reversible import find, tried
from rldrill.solutions.sheet.fundamentals import RETURN, RETURN_STEP_BY_STEP, STEP_UNDISCOUNTED, UNDISCOUNTED
from rldrill.solutions.sheet.temporal_difference import (
    AVERAGED_ALIKE,
    CLOSING_LIKE_OTHERS,
    FORGOT_CLOSING,
    FORGOT_LONGEST,
    FORGOT_ONE_MINUS_LAMBDA,
    LAMBDA_EXCHANGED,
    LAMBDA_RETURN,
    LAMBDA_RETURN_CUT_OFF,
    LONGEST_LIKE_OTHERS,
    POWER_ONE_LATE,
)
from rldrill.solutions.temporal_difference.n_step_return import n_step, worth_as_before
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """First what is averaged, then the average."""
    known = known_episode(given)
    _weighted(given, work, known, averaged(work, known, given.time))


def _weighted(given: Given, work: Work, known: Mapping[str, Any], returns: tuple[Value, ...]) -> None:
    if given.in_parts:
        returns = work.answer(returns)
    work.say(f"The {'episode' if known['ends'] else 'run'} ends at $T = {known['T']}$.")
    value = average(work, known, given.time, returns)
    if given.known is None:
        work.answer(value)
    else:
        find(given, work, value, f"R_{{{given.time}}}^{{(λ)}}")


def known_episode(given: Any) -> dict[str, Any]:
    """A run with its values, γ, λ and the time of its end."""
    run: Trajectory = given.trajectory
    return (
        knowns.trajectory(run)
        | knowns.discounts(given.gamma)
        | {
            "V": {s: exact(value) for s, value in given.values.items()} | dict.fromkeys(run.terminal, ZERO),
            "lam": exact(given.lam),
            "T": len(run.rewards),
            "ends": run.ends,
        }
    )


def averaged(work: Work, known: Mapping[str, Any], time: int) -> tuple[Value, ...]:
    """The n-step returns from a time on; the longest is the full return, if the run comes to its end."""
    left = known["T"] - time
    returns = tuple(n_step(work, known, time, n) for n in range(1, left if known["ends"] else left + 1))
    return (*returns, _whole(work, known, time)) if known["ends"] else returns


def _whole(work: Work, known: Mapping[str, Any], time: int) -> Value:
    if "gamma" in known:
        return work.step(RETURN, t=time, **known)
    value: Value = ZERO
    for start in reversed(range(time, known["T"])):
        value = work.step(RETURN_STEP_BY_STEP, t=start, G={start + 1: value}, **known)
    return value


def average(work: Work, known: Mapping[str, Any], time: int, returns: Sequence[Value]) -> Value:
    """The λ-return from a time on."""
    Gn = {(time, n): value for n, value in enumerate(returns, start=1)}
    if not known["ends"]:
        return work.step(LAMBDA_RETURN_CUT_OFF, t=time, Gn=Gn, T=known["T"], lam=known["lam"])
    *_, whole = returns
    return work.step(LAMBDA_RETURN, t=time, Gn=Gn, G={time: whole}, T=known["T"], lam=known["lam"])


@slip(
    "value-after-the-end",
    "In a terminal state the episode is over: no value is added to the return, that of the state before it neither.",
    when=lambda given: given.trajectory.ends,
)
def value_after_the_end(given: Given, work: Work) -> None:
    """The end as if it were worth what the state before it is."""
    known = known_episode(given)
    *returns, _ = averaged(work, known, given.time)
    last = n_step(work, worth_as_before(given.trajectory, known), given.time, known["T"] - given.time)
    _weighted(given, work, known, (*returns, last))


MISCONCEPTIONS = (
    FORGOT_ONE_MINUS_LAMBDA,
    FORGOT_CLOSING,
    CLOSING_LIKE_OTHERS,
    FORGOT_LONGEST,
    LONGEST_LIKE_OTHERS,
    POWER_ONE_LATE,
    STEP_UNDISCOUNTED,
    UNDISCOUNTED.where_it_shows(),
    LAMBDA_EXCHANGED.where_it_shows(),
    AVERAGED_ALIKE.where_it_shows(),
    value_after_the_end.where_it_shows(),
)


def backwards(given: Any) -> Array:
    """The λ-returns of all times by the recursion from the end: what follows is λ times the next one, else V."""
    run: Trajectory = given.trajectory
    gammas, lam = per_step(given.gamma, len(run.rewards)), at(given.lam)
    returns = np.zeros(len(run.states))
    returns[-1] = 0.0 if run.ends else at(given.values[run.states[-1]])
    for time in reversed(range(len(run.rewards))):
        after = run.states[time + 1]
        value = 0.0 if after in run.terminal else at(given.values[after])
        returns[time] = at(run.rewards[time]) + at(gammas[time]) * ((1 - lam) * value + lam * returns[time + 1])
    return returns[:-1]


def oracle(given: Given) -> Answers:
    """The n-step returns from a table of discounted rewards; the λ-return backwards in time."""
    if given.known is not None:
        return (tried(given, lambda trial: float(backwards(trial)[trial.time])),)
    run = given.trajectory
    left = np.cumprod([1.0, *map(at, per_step(given.gamma, len(run.rewards))[given.time :])])
    earned = np.cumsum(left[:-1] * [at(reward) for reward in run.rewards[given.time :]])
    ends = run.states[given.time + 1 :]
    worth = left[1:] * [0.0 if s in run.terminal else at(given.values[s]) for s in ends]
    whole = float(backwards(given)[given.time])
    return (earned + worth, whole) if given.in_parts else (whole,)
