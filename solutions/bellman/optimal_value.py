"""The values of the best policy, held against the optimality equation; then best actions and Q*."""

from fractions import Fraction

from flint import fmpq

from rldrill.problems.bellman.optimal_value import Given
from rldrill.problems.document import joined
from rldrill.problems.models import Policy, equiprobable
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, exact
from rldrill.solutions.formula.formula import fork
from rldrill.solutions.optimality import optimum
from rldrill.solutions.oracle import Answers, at, best_actions, lookahead, optimal_values, tensors
from rldrill.solutions.policy_values import TERMINAL_VALUE, evaluate_policy, of_states
from rldrill.solutions.sheet.bellman import (
    BELLMAN_OPTIMALITY_V,
    OWN_VALUE,
    Q_FORGOT_GAMMA,
    Q_STAR_FROM_V,
)
from rldrill.solutions.sheet.dynamic_programming import GREEDY_FROM_V
from rldrill.solutions.work import Work

GREEDY_ON_REWARD = fork(
    "greedy-on-reward",
    "The action with the greatest immediate reward need not be best: what can be earned after it counts too.",
    when=lambda given: given.gamma != 0,
)
FIRST_ACTIONS = fork(
    "wrong-fixed-policy",
    "These are the values of the policy that always takes the first action; in some state another one is better.",
)
RANDOM_POLICY = fork(
    "mean-for-max",
    "These are the values of choosing at random; the optimal value takes the best action in every state.",
)
MISCONCEPTIONS = (
    GREEDY_ON_REWARD, FIRST_ACTIONS, RANDOM_POLICY, TERMINAL_VALUE, Q_FORGOT_GAMMA, OWN_VALUE
)  # fmt: skip


def solve(given: Given, work: Work) -> None:
    """The equations of the best policy, their solution put into the optimality equation, and what follows."""
    mdp, gamma = given.mdp, exact(given.gamma)
    policy = _policy(given, work)
    work.say(f"Suppose that these actions are best (policy iteration finds them): {_told(policy)}. Their values:")
    values = evaluate_policy(mdp, policy, gamma, work)
    known = knowns.model(mdp) | {"gamma": gamma}
    if work.misconception is None:  # values of another policy do not solve the equation
        work.say("Put into the optimality equation, no other action is better, so these are the optimal values:")
        for state in mdp.states:
            work.step(BELLMAN_OPTIMALITY_V, s=state, V=values, **known)
    values = values | work.answer(of_states(mdp, values))
    if work.makes(TERMINAL_VALUE):
        values |= knowns.last_rewards(mdp)
    best = {state: work.step(GREEDY_FROM_V, s=state, V=values, **known) for state in mdp.states}
    if work.makes(GREEDY_ON_REWARD) or work.makes(FIRST_ACTIONS):
        best = {state: tuple(chances) for state, chances in policy.items()}
    work.answer(best)
    work.answer({(s, a): work.step(Q_STAR_FROM_V, s=s, a=a, V=values, **known) for s, a in mdp.pairs})


def _policy(given: Given, work: Work) -> Policy:
    """The policy whose values are found: the best one, or the one that a mistake takes for it."""
    mdp = given.mdp
    if work.makes(RANDOM_POLICY):
        return equiprobable(mdp)
    if work.makes(GREEDY_ON_REWARD):
        chosen = {state: _most_paid(given, state) for state in mdp.states}
    elif work.makes(FIRST_ACTIONS):
        chosen = {state: actions[0] for state, actions in mdp.actions.items()}
    else:
        chosen = optimum(mdp, given.gamma).policy
    return {state: {action: Fraction(1)} for state, action in chosen.items()}


def _most_paid(given: Given, state: str) -> str:
    """The action with the greatest expected reward."""

    def reward(action: str) -> fmpq:
        return sum((exact(row.probability) * exact(row.reward) for row in given.mdp.outcomes[state, action]), ZERO)

    return max(given.mdp.actions[state], key=reward)


def _told(policy: Policy) -> str:
    return joined([f"in {state} {' or '.join(chances)}" for state, chances in policy.items()])


def oracle(given: Given) -> Answers:
    """Sweeps of value iteration until nothing changes; the best actions by trying all."""
    mdp = given.mdp
    states = (*mdp.states, *mdp.terminal)
    P, R = tensors(mdp, states)
    n = len(mdp.states)
    V = optimal_values(P, R, at(given.gamma), n)
    Q = lookahead(P, R, V, at(given.gamma))
    names = tuple(dict.fromkeys(action for _, action in mdp.outcomes))
    return (
        V[:n],
        best_actions(mdp, Q[:n]),
        [Q[states.index(state), names.index(action)] for state, action in mdp.pairs],
    )
