"""A rollout, one time after the other: action, reward, next state."""

from msgspec.structs import replace

from rldrill.problems.exact import shown
from rldrill.problems.fractions import Fraction
from rldrill.problems.linear_methods.lqr_reward import Given
from rldrill.problems.linear_quadratic import by_time
from rldrill.solutions import linear_quadratic, matrices
from rldrill.solutions.exact import exact, to_sympy
from rldrill.solutions.formula.finding import with_number
from rldrill.solutions.formula.formula import Formula
from rldrill.solutions.formula.putting_in import indexed
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.rational import with_found
from rldrill.solutions.sheet.linear_methods import (
    ACTION_FIRST,
    ACTION_NOT_SQUARED,
    ACTION_SIGN,
    COST_FOR_REWARD,
    DYNAMICS,
    LQR_ACTION,
    LQR_REWARD,
    LQR_TOTAL,
    REWARD_WITHOUT_R,
    at_the_end,
    rollout,
)
from rldrill.solutions.work import Equality, Work

#: Without the price in it, the reward says nothing of a price that is to be found.
MISCONCEPTIONS = (
    COST_FOR_REWARD,
    replace(REWARD_WITHOUT_R, when=lambda given: given.total is None),
    ACTION_FIRST,
    ACTION_SIGN.where_it_shows(),
    ACTION_NOT_SQUARED.where_it_shows(),
)


def solve(given: Given, work: Work) -> None:
    """The first reward is asked for on the way; a price that is left open is found from the total before."""
    reward_of, total = (LQR_REWARD, LQR_TOTAL) if given.plain else _rollout(given)
    known = linear_quadratic.known(given)
    known["Lt"] = {time: matrices.given(by_time(given.L, time)) for time in range(given.horizon + given.plain)}
    known["St"] = {0: linear_quadratic.start(given)}
    known["Ut"], rewards = {}, {}
    for time in range(given.horizon + given.plain):
        known["Ut"] = known["Ut"] | {time: work.step(LQR_ACTION, t=time, **known)}
        reward = linear_quadratic.number(work.step(reward_of, t=time, **known))
        rewards[time] = work.answer(reward) if time == 0 and given.total is None else reward
        if time < given.horizon:
            known["St"] = known["St"] | {time + 1: work.step(DYNAMICS, t=time, **known)}
    if not given.plain:
        last = linear_quadratic.number(work.step(at_the_end(), T=given.horizon, **known))
        known["lastReward"] = {given.horizon: last}
    J = work.step(total, T=given.horizon, rt=rewards, **known)
    if given.total is None:
        work.answer(J)
        return
    work.say(f"$J$ must be ${shown(given.total)}$:")
    price = work.answer(work.equate("rho", J, exact(given.total), positive=True))
    work.say(f"With $ρ = {to_sympy(price)}$ the first reward is:")
    first = with_found(rewards[0], price)
    put_in = with_number([[rewards[0]]], "rho", price)
    work.lines.append(Equality(indexed(reward_of.left, {"t": 0}), (put_in, first)))
    work.answer(first)


def _rollout(given: Given) -> tuple[Formula, Formula]:
    return rollout(discounted=given.gamma != 1, crossed=given.N is not None)


def oracle(given: Given) -> Answers:
    """What the rewards are without a price, and with 1; in between they are linear in it."""
    if given.total is None:
        return _summed(given)
    free, dear = (_summed(given.model_copy(update={"R": (((price,),),)})) for price in (Fraction(0), Fraction(1)))
    price = (at(given.total) - free[1]) / (dear[1] - free[1])
    return (price, free[0] + price * (dear[0] - free[0]))


def _summed(given: Given) -> tuple[float, float]:
    """States and actions from powers of the closed loop, rewards entry by entry."""
    state = np.array([at(entry) for entry in given.start])
    rewards = []
    for time in range(given.horizon + 1):
        now = linear_quadratic.arrays(given, time)
        ended = time == given.horizon and not given.plain
        feedback = np.zeros(now["B"].T.shape) if ended else -linear_quadratic.array(by_time(given.L, time))
        both = np.concatenate([state, feedback @ state])
        weights = np.block([[now["Q"], now["N"]], [now["N"].T, now["R"]]])
        rewards.append(-(at(given.gamma) ** time) * float(np.einsum("i,ij,j", both, weights, both)))
        state = np.hstack([now["A"], now["B"]]) @ both
    return (rewards[0], sum(rewards))
