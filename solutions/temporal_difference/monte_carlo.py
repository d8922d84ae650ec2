"""Monte Carlo from one episode: the returns backwards in time, then an update for every visit that counts."""

import numpy as np

from rldrill.problems.temporal_difference.monte_carlo import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, Value, exact
from rldrill.solutions.formula.formula import fork
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.fundamentals import RECURSION_UNDISCOUNTED, RETURN_RECURSIVE
from rldrill.solutions.sheet.temporal_difference import MONTE_CARLO
from rldrill.solutions.work import Work

OTHER_VISITS = fork(
    "other-visits",
    "First-visit Monte Carlo updates a state once in an episode, every-visit Monte Carlo once for each of its visits.",
    when=lambda given: given.revisits,
)
REWARD_BEFORE = fork(
    "reward-before-the-state",
    "The reward that comes with the arrival in a state was earned before it; the return begins with the next reward.",
    when=lambda given: len(given.trajectory.rewards) > 1,
)
MISCONCEPTIONS = (OTHER_VISITS, RECURSION_UNDISCOUNTED, REWARD_BEFORE)


def solve(given: Given, work: Work) -> None:
    """All returns first; then one update for every visit that counts, in their order."""
    run = given.trajectory
    known = knowns.trajectory(run)
    gamma = exact(given.gamma)
    returns = _returns(given, work, known["r"], gamma)
    if given.in_parts:
        single = len(run.rewards) == 1
        carried = work.answer(returns[0] if single else returns)
        returns = (carried,) if single else carried
    G = dict(enumerate(returns))
    if work.makes(REWARD_BEFORE):  # r_t + γ R_t is the return from one step earlier
        G = {time: G[max(time - 1, 0)] for time in G}
    values = knowns.state_values(given.values, run.terminal)
    other = {"first": "every", "every": "first"}[given.visits]
    for time in given.counted(other if work.makes(OTHER_VISITS) else given.visits):
        value = work.step(MONTE_CARLO, t=time, V=values, G=G, alpha=exact(given.alpha), S=known["S"])
        values = values | {run.states[time]: value}
    work.answer({state: values[state] for state in given.visited})


def _returns(given: Given, work: Work, rewards: dict[int, Value], gamma: Value) -> tuple[Value, ...]:
    end = len(given.trajectory.rewards)
    G = {end: ZERO}
    for time in reversed(range(end)):
        G = G | {time: work.step(RETURN_RECURSIVE, t=time, G=G, r=rewards, gamma=gamma)}
    return tuple(G[time] for time in range(end))


def oracle(given: Given) -> Answers:
    """The returns as a triangle of powers times the rewards; each value as old value and returns, weighted."""
    run, alpha = given.trajectory, at(given.alpha)
    times = np.arange(len(run.rewards))
    ahead = times[None, :] - times[:, None]
    returns = np.where(ahead >= 0, at(given.gamma) ** np.maximum(ahead, 0), 0.0) @ [at(r) for r in run.rewards]
    after = []
    for state in given.visited:
        own = np.array([returns[time] for time, visited in enumerate(run.states[:-1]) if visited == state])
        own = own[:1] if given.visits == "first" else own
        weights = alpha * (1 - alpha) ** np.arange(len(own) - 1, -1, -1)
        after.append((1 - alpha) ** len(own) * at(given.values[state]) + weights @ own)
    return (returns, after) if given.in_parts else (after,)
