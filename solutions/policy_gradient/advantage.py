"""Q and V by one step ahead, then their difference; or TD errors, then their discounted sums."""

from typing import Any

from rldrill.problems.exact import Parameter
from rldrill.problems.policy_gradient.advantage import (
    AlongRun,
    Given,
    OfPolicy,
    OfValue,
    PolicyLookahead,
    Run,
    ValueLookahead,
)
from rldrill.solutions import knowns
from rldrill.solutions.exact import exact
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.bellman import BELLMAN_Q, FORGOT_GAMMA, Q_FORGOT_GAMMA, V_FROM_Q
from rldrill.solutions.sheet.policy_gradient import (
    ADVANTAGE,
    ADVANTAGE_SIGN,
    GAE,
    GAE_WITHOUT_GAMMA,
    GAE_WITHOUT_LAMBDA,
    MEAN_FOR_STATE,
    NEXT_STATES_VALUE,
    TD_ERROR,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (
    ADVANTAGE_SIGN,
    NEXT_STATES_VALUE,
    MEAN_FOR_STATE.where_it_shows(),
    GAE_WITHOUT_LAMBDA,
    GAE_WITHOUT_GAMMA,
    FORGOT_GAMMA.where_it_shows(),
    Q_FORGOT_GAMMA.where_it_shows(),
)


def solve(given: Given, work: Work) -> None:
    """One state's actions, or a run."""
    match given:
        case AlongRun():
            _estimate(given, work)
        case OfValue() | OfPolicy():
            _compare(given, work)


def _compare(given: OfValue | OfPolicy, work: Work) -> None:
    ahead, state = given.lookahead, given.lookahead.state
    pairs = tuple((state, action) for action in ahead.dynamics.actions[state])
    known: dict[str, Any] = knowns.model(ahead.dynamics) | {
        "s": state,
        "gamma": exact(given.gamma),
        "V": knowns.values(ahead.values),
    }
    known["Q"] = work.answer({pair: work.step(BELLMAN_Q, a=pair[1], **known) for pair in pairs})
    if isinstance(ahead, PolicyLookahead):
        value = work.answer(work.step(V_FROM_Q, pi=knowns.policy(ahead.policy), **known))
        known["V"] = known["V"] | {state: value}
    work.answer({pair: work.step(ADVANTAGE, a=pair[1], **known) for pair in pairs})


def _estimate(given: AlongRun, work: Work) -> None:
    run = given.run
    times = range(len(run.trajectory.rewards))
    known = knowns.trajectory(run.trajectory) | {
        "gamma": exact(given.gamma),
        "lam": exact(run.lam),
        "T": len(times),
        "V": knowns.state_values(run.values, run.trajectory.terminal),
    }
    errors = tuple(work.step(TD_ERROR, t=time, **known) for time in times)
    if not isinstance(run.lam, Parameter):
        errors = work.answer(errors)
    known["delta"] = dict(enumerate(errors))
    work.answer(tuple(work.step(GAE, t=time, **known) for time in times))


def oracle(given: Given) -> Answers:
    """One step ahead by a loop over outcomes; estimates as a weighted mean of n-step advantages."""
    match given:
        case AlongRun():
            return _estimates(given.run, at(given.gamma))
        case OfValue() | OfPolicy():
            return _advantages(given.lookahead, at(given.gamma))


def possible(given: Given) -> bool:
    """A policy's value of the state is a mean of its action values."""
    match given:
        case OfValue(lookahead=ahead):
            Q, _ = _advantages(ahead, at(given.gamma))
            return bool(Q.min() <= at(ahead.values[ahead.state]) <= Q.max())
    return True


def _advantages(ahead: ValueLookahead | PolicyLookahead, gamma: float) -> Answers:
    worth = dict.fromkeys(ahead.dynamics.actions[ahead.state], 0.0)
    for row in ahead.dynamics.transitions:
        worth[row.action] += at(row.probability) * (at(row.reward) + gamma * at(ahead.values[row.next]))
    Q = np.array(list(worth.values()))
    match ahead:
        case ValueLookahead():
            return (Q, Q - at(ahead.values[ahead.state]))
        case PolicyLookahead():
            V = sum(at(ahead.policy[ahead.state].get(action, 0)) * value for action, value in worth.items())
            return (Q, V, Q - V)


def _estimates(run: Run, gamma: float) -> Answers:
    """GAE by its definition: n-step advantages with weights (1 − λ)λⁿ⁻¹, the last one with all that is left."""
    lam = at(run.lam)
    rewards = [at(reward) for reward in run.trajectory.rewards]
    values = [0.0 if s in run.trajectory.terminal else at(run.values[s]) for s in run.trajectory.states]
    end = len(rewards)

    def advantage(time: int, steps: int) -> float:
        earned = sum(gamma**k * rewards[time + k] for k in range(steps))
        return earned + gamma**steps * values[time + steps] - values[time]

    def estimate(time: int) -> float:
        left = end - time
        weights = [(1 - lam) * lam ** (n - 1) for n in range(1, left)] + [lam ** (left - 1)]
        return sum(weight * advantage(time, n) for n, weight in enumerate(weights, 1))

    estimates = [estimate(time) for time in range(end)]
    if isinstance(run.lam, Parameter):
        return (estimates,)
    return ([advantage(time, 1) for time in range(end)], estimates)
