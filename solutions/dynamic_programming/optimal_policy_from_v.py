"""One look ahead with every action, from the optimal values."""

from rldrill.problems.dynamic_programming.optimal_policy_from_v import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import exact
from rldrill.solutions.optimality import optimum
from rldrill.solutions.oracle import Answers, at, best_actions, tensors, without_loss
from rldrill.solutions.sheet.dynamic_programming import GREEDY_BY_REWARD, GREEDY_BY_VALUE, GREEDY_FROM_V
from rldrill.solutions.work import Work

MISCONCEPTIONS = (GREEDY_BY_VALUE, GREEDY_BY_REWARD)


def solve(given: Given, work: Work) -> None:
    """The best action of every state."""
    known = knowns.model(given.mdp) | {
        "gamma": exact(given.gamma),
        "V": knowns.state_values(given.values, given.mdp.terminal),
    }
    greedy = {state: work.step(GREEDY_FROM_V, s=state, **known) for state in given.mdp.states}
    if given.gamma != 1:
        work.answer(greedy)
        return
    best = optimum(given.mdp, given.gamma)
    best.tell(work)
    work.answer(best.among(greedy))


def oracle(given: Given) -> Answers:
    """Every action's mean reward and mean next value, as two arrays; the best by trying all."""
    states = (*given.mdp.states, *given.mdp.terminal)
    P, R = tensors(given.mdp, states)
    ahead = P @ [at(given.values.get(state, 0)) for state in states]
    worth = (P * R.clip(min=-1e300)).sum(axis=2) + at(given.gamma) * ahead
    best = best_actions(given.mdp, worth[: len(given.mdp.states)])
    return (without_loss(given.mdp, best) if given.gamma == 1 else best,)
