"""A rollout, one time after the other: action, reward, next state."""

import numpy as np

from rldrill.problems.linear_methods.lqr_reward import Given
from rldrill.problems.linear_quadratic import by_time
from rldrill.solutions import linear_quadratic, matrices
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.linear_methods import (
    ACTION_FIRST,
    COST_FOR_REWARD,
    DYNAMICS,
    LQR_ACTION,
    LQR_REWARD,
    LQR_TOTAL,
    REWARD_WITHOUT_R,
    at_the_end,
    rollout,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (COST_FOR_REWARD, REWARD_WITHOUT_R, ACTION_FIRST)


def solve(given: Given, work: Work) -> None:
    """The first reward is asked for on the way."""
    reward_of, total = (LQR_REWARD, LQR_TOTAL) if given.plain else rollout(crossed=given.N is not None)
    known = linear_quadratic.known(given)
    known["Lt"] = {time: matrices.given(by_time(given.L, time)) for time in range(given.horizon + given.plain)}
    known["St"] = {0: linear_quadratic.start(given)}
    known["Ut"], rewards = {}, {}
    for time in range(given.horizon + given.plain):
        known["Ut"] = known["Ut"] | {time: work.step(LQR_ACTION, t=time, **known)}
        reward = linear_quadratic.number(work.step(reward_of, t=time, **known))
        rewards[time] = work.answer(reward) if time == 0 else reward
        if time < given.horizon:
            known["St"] = known["St"] | {time + 1: work.step(DYNAMICS, t=time, **known)}
    if not given.plain:
        rewards[given.horizon] = linear_quadratic.number(work.step(at_the_end(), T=given.horizon, **known))
    work.answer(work.step(total, T=given.horizon, gamma=known["gamma"], rt=rewards))


def oracle(given: Given) -> Answers:
    """States and actions from powers of the closed loop, rewards entry by entry."""
    state = np.array([at(entry) for entry in given.start])
    rewards = []
    for time in range(given.horizon + 1):
        now = linear_quadratic.arrays(given, time)
        ended = time == given.horizon and not given.plain
        feedback = -linear_quadratic.array(by_time(given.L, 0 if ended else time)) * (not ended)
        both = np.concatenate([state, feedback @ state])
        weights = np.block([[now["Q"], now["N"]], [now["N"].T, now["R"]]])
        rewards.append(-(at(given.gamma) ** time) * float(np.einsum("i,ij,j", both, weights, both)))
        state = np.hstack([now["A"], now["B"]]) @ both
    return (rewards[0], sum(rewards))
