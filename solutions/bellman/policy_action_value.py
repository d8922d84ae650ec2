"""The values of the states as a linear system, then one average for every action."""

from rldrill.problems.bellman.policy_action_value import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import exact
from rldrill.solutions.oracle import Answers, swept
from rldrill.solutions.policy_values import ONE_BACKUP, TERMINAL_VALUE, evaluate_policy, of_states
from rldrill.solutions.sheet.bellman import (
    BELLMAN_Q,
    OWN_VALUE,
    Q_FORGOT_GAMMA,
    Q_REWARD_UNWEIGHTED,
    TRANSPOSED,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (ONE_BACKUP, TERMINAL_VALUE, TRANSPOSED, Q_FORGOT_GAMMA, OWN_VALUE, Q_REWARD_UNWEIGHTED)


def solve(given: Given, work: Work) -> None:
    """Q follows from V: the action is free, and the policy is followed after it."""
    mdp, gamma = given.mdp, exact(given.gamma)
    values = evaluate_policy(mdp, given.chances, gamma, work)
    values = values | work.answer(of_states(mdp, values))
    known = knowns.model(mdp) | {"gamma": gamma}
    work.answer({(s, a): work.step(BELLMAN_Q, s=s, a=a, V=values, **known) for s, a in mdp.pairs})


def oracle(given: Given) -> Answers:
    """Sweeps of evaluation until nothing changes, on arrays; the worth of all actions comes with them."""
    V, Q = swept(given)
    names = tuple(dict.fromkeys(action for _, action in given.mdp.outcomes))
    states = given.mdp.states
    return (V[: len(states)], [Q[states.index(s), names.index(a)] for s, a in given.mdp.pairs])
