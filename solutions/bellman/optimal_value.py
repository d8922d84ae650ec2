"""The values of the best policy, held against the optimality equation; then best actions and Q*."""

from collections.abc import Mapping
from typing import Any

from rldrill.problems.bellman.optimal_value import Given
from rldrill.problems.document import joined
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Model, equiprobable
from rldrill.problems.valued import deterministic
from rldrill.solutions import knowns
from rldrill.solutions.exact import Value, exact
from rldrill.solutions.formula.formula import Formula, slip
from rldrill.solutions.optimality import Optimum, optimum
from rldrill.solutions.oracle import Answers, at, best_actions, lookahead, optimal_values, tensors, without_loss
from rldrill.solutions.policy_values import Evaluation, evaluated, of_states, terminal_value
from rldrill.solutions.sheet.bellman import (
    BELLMAN_OPTIMALITY_V,
    BELLMAN_V,
    OWN_VALUE,
    Q_FORGOT_GAMMA,
    Q_STAR_FROM_V,
)
from rldrill.solutions.sheet.dynamic_programming import GREEDY_FROM_V, POLICY_IMPROVEMENT, POLICY_ITERATION
from rldrill.solutions.work import Work

#: Of so many states policy iteration is written out.
_WRITTEN_OUT = 4


def solve(given: Given, work: Work, evaluation: Evaluation = evaluated) -> None:
    """Policy iteration, its last values put into the optimality equation, and what follows."""
    mdp, best = given.mdp, optimum(given.mdp, given.gamma)
    if evaluation is evaluated and given.gamma != 1 and len(mdp.states) <= _WRITTEN_OUT:
        values = _iterated(given, work)
    else:
        values = _of_the_best(given, work, best, evaluation)
    known = knowns.model(mdp) | {"gamma": exact(given.gamma)}
    for state in mdp.states:
        work.step(BELLMAN_OPTIMALITY_V, s=state, V=values, **known)
    if best.unlike_sweeps:
        work.say(
            "Value iteration that begins with 0 does not come to them: in {} it settles at {}.".format(
                *best.unlike_sweeps
            )
        )
    values |= work.answer(of_states(mdp, values))
    greedy = {state: work.value(GREEDY_FROM_V, s=state, V=values, **known) for state in mdp.states}
    told = joined([f"{joined(list(actions))} in {state}" for state, actions in greedy.items()])
    work.say(f"The maxima of the optimality equation are reached by {told}.")
    best.tell(work)
    work.answer(best.among(greedy))
    work.answer({(s, a): work.step(Q_STAR_FROM_V, s=s, a=a, V=values, **known) for s, a in mdp.pairs})


def _iterated(given: Given, work: Work) -> dict[str, Value]:
    """Policy iteration from the policy that earns most at once, to the last values."""
    mdp = given.mdp
    known = knowns.model(mdp) | {"gamma": exact(given.gamma)}
    policy = optimum(mdp, Fraction(0)).policy
    work.say(f"Policy iteration, starting with the action that earns most at once: {_told(policy)}.")
    while True:
        values = evaluated(work, POLICY_ITERATION, mdp, known | {"pi": policy})
        greedy = {state: work.value(POLICY_IMPROVEMENT, s=state, V=values, **known) for state in mdp.states}
        if all(policy[state] in greedy[state] for state in mdp.states):
            work.say("No other action is better now: these values solve the optimality equation.")
            return values
        for state in mdp.states:
            work.step(POLICY_IMPROVEMENT, s=state, V=values, **known)
        policy = {s: policy[s] if policy[s] in actions else actions[0] for s, actions in greedy.items()}
        work.say(f"This changes the policy, so it is evaluated again: {_told(policy)}.")


def _of_the_best(given: Given, work: Work, best: Optimum, evaluation: Evaluation) -> dict[str, Value]:
    """The values of the policy with which policy iteration ends."""
    mdp, policy = given.mdp, best.policy
    work.say(f"Policy iteration ends with these actions: {_told(policy)}. Their values:")
    values = evaluation(work, BELLMAN_V, mdp, knowns.model_and_policy(mdp, deterministic(policy), given.gamma))
    endless = (
        "Going round for ever in a loop that pays nothing is worth 0, not more than the value there. "
        if given.gamma == 1
        else ""
    )
    work.say(f"{endless}Put into the optimality equation, no other action is better, so these are the optimal values:")
    return values


def _told(policy: Mapping[str, str]) -> str:
    return joined([f"{action} in {state}" for state, action in policy.items()])


def _settle_for(given: Given, work: Work, policy: Mapping[str, str]) -> None:
    """Take a policy for the best one."""
    mdp = given.mdp
    known = knowns.model_and_policy(mdp, deterministic(policy), given.gamma)
    values = evaluated(work, BELLMAN_V, mdp, known)
    values |= work.answer(of_states(mdp, values))
    work.answer({state: (action,) for state, action in policy.items()})
    work.answer({(s, a): work.step(Q_STAR_FROM_V, s=s, a=a, V=values, **known) for s, a in mdp.pairs})


@slip(
    "greedy-on-reward",
    "The action with the greatest immediate reward need not be best: what can be earned after it counts too.",
    when=lambda given: given.gamma != 0,
)
def most_paid(given: Given, work: Work) -> None:
    """The policy that is best without what comes after."""
    _settle_for(given, work, optimum(given.mdp, Fraction(0)).policy)


@slip(
    "wrong-fixed-policy",
    "These are the values of the policy that always takes the first action; in some state another one is better.",
)
def first_actions(given: Given, work: Work) -> None:
    """The policy that always takes the first action."""
    _settle_for(given, work, {state: actions[0] for state, actions in given.mdp.actions.items()})


@slip(
    "mean-for-max",
    "These are the values of choosing at random; the optimal value takes the best action in every state.",
)
def at_random(given: Given, work: Work) -> None:
    """The values of the policy that chooses at random."""
    solve(given, work, _at_random)


def _at_random(work: Work, formula: Formula, mdp: Model, known: Mapping[str, Any]) -> dict[str, Value]:
    return evaluated(work, formula, mdp, {**known, "pi": knowns.policy(equiprobable(mdp))})


MISCONCEPTIONS = (
    most_paid, first_actions, at_random, terminal_value(solve), Q_FORGOT_GAMMA, OWN_VALUE
)  # fmt: skip


def oracle(given: Given) -> Answers:
    """Sweeps of value iteration until nothing changes; the best actions by trying all."""
    mdp = given.mdp
    states = (*mdp.states, *mdp.terminal)
    P, R = tensors(mdp, states)
    n = len(mdp.states)
    V = optimal_values(P, R, at(given.gamma), n)
    Q = lookahead(P, R, V, at(given.gamma))
    names = tuple(dict.fromkeys(action for _, action in mdp.outcomes))
    best = best_actions(mdp, Q[:n])
    return (
        V[:n],
        without_loss(mdp, best) if given.gamma == 1 else best,
        [Q[states.index(state), names.index(action)] for state, action in mdp.pairs],
    )
