"""The λ-return as its definition has it: all n-step returns, weighted."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from rldrill.problems.runs import Trajectory
from rldrill.problems.temporal_difference.lambda_return import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import Value, exact
from rldrill.solutions.oracle import Answers, Array, at
from rldrill.solutions.sheet.fundamentals import RETURN
from rldrill.solutions.sheet.temporal_difference import (
    CLOSING_LIKE_OTHERS,
    FORGOT_CLOSING,
    FORGOT_ONE_MINUS_LAMBDA,
    LAMBDA_RETURN,
    N_STEP_RETURN,
    POWER_ONE_LATE,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (FORGOT_ONE_MINUS_LAMBDA, FORGOT_CLOSING, CLOSING_LIKE_OTHERS, POWER_ONE_LATE)


def solve(given: Given, work: Work) -> None:
    """First what is averaged, then the average."""
    known = known_episode(given)
    returns = averaged(work, known, given.time)
    if given.in_parts:
        returns = work.answer(returns)
    work.answer(average(work, known, given.time, returns))


def known_episode(given: Any) -> dict[str, Any]:
    """A run with its values, γ, λ and the time of its end."""
    run: Trajectory = given.trajectory
    return knowns.trajectory(run) | {
        "V": knowns.state_values(given.values, run.terminal),
        "gamma": exact(given.gamma),
        "lam": exact(given.lam),
        "T": len(run.rewards),
        "ends": run.ends,
    }


def averaged(work: Work, known: Mapping[str, Any], time: int) -> tuple[Value, ...]:
    """The n-step returns from a time on; the longest is the full return, if the run comes to its end."""
    left = known["T"] - time
    steps = range(1, left if known["ends"] else left + 1)
    returns = tuple(work.step(N_STEP_RETURN, t=time, n=n, **known) for n in steps)
    return (*returns, work.step(RETURN, t=time, **known)) if known["ends"] else returns


def average(work: Work, known: Mapping[str, Any], time: int, returns: Sequence[Value]) -> Value:
    """The λ-return from a time on."""
    *shorter, whole = returns
    Gn = {(time, n): value for n, value in enumerate(shorter, start=1)}
    return work.step(LAMBDA_RETURN, t=time, Gn=Gn, G={time: whole}, T=known["T"], lam=known["lam"])


def backwards(given: Any) -> Array:
    """The λ-returns of all times by the recursion from the end: what follows is λ times the next one, else V."""
    run: Trajectory = given.trajectory
    gamma, lam = at(given.gamma), at(given.lam)
    returns = np.zeros(len(run.states))
    returns[-1] = 0.0 if run.ends else at(given.values[run.states[-1]])
    for time in reversed(range(len(run.rewards))):
        after = run.states[time + 1]
        value = 0.0 if after in run.terminal else at(given.values[after])
        returns[time] = at(run.rewards[time]) + gamma * ((1 - lam) * value + lam * returns[time + 1])
    return returns[:-1]


def oracle(given: Given) -> Answers:
    """The n-step returns from a table of discounted rewards; the λ-return backwards in time."""
    run, gamma = given.trajectory, at(given.gamma)
    earned = np.cumsum([gamma**k * at(reward) for k, reward in enumerate(run.rewards[given.time :])])
    ends = run.states[given.time + 1 :]
    worth = [0.0 if s in run.terminal else gamma ** (k + 1) * at(given.values[s]) for k, s in enumerate(ends)]
    whole = float(backwards(given)[given.time])
    return (earned + worth, whole) if given.in_parts else (whole,)
