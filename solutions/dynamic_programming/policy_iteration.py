"""Evaluation and improvement in turn; when improvement changes nothing, the policy is optimal."""

from collections.abc import Mapping
from typing import Any

from rldrill.problems.dynamic_programming.policy_iteration import Given
from rldrill.problems.models import Model
from rldrill.problems.valued import deterministic
from rldrill.solutions import knowns
from rldrill.solutions.exact import Value, exact
from rldrill.solutions.formula.formula import Formula, slip
from rldrill.solutions.formula.notation import numbered, pi
from rldrill.solutions.numerics import np
from rldrill.solutions.optimality import ONLY_GREEDY, is_optimal
from rldrill.solutions.oracle import (
    Answers,
    at,
    best_actions,
    chances,
    lookahead,
    optimal_values,
    policy_values,
    tensors,
)
from rldrill.solutions.policy_values import Evaluation, evaluated, of_states, one_sweep
from rldrill.solutions.sheet.dynamic_programming import (
    IMPROVEMENT_BY_REWARD,
    IMPROVEMENT_BY_VALUE,
    POLICY_IMPROVEMENT,
    POLICY_ITERATION,
)
from rldrill.solutions.work import Work


def solve(given: Given, work: Work, evaluation: Evaluation = evaluated) -> None:
    """Round after round: the values of the policy, then the greedy actions for them."""
    mdp = given.mdp
    known = knowns.model(mdp) | {"gamma": exact(given.gamma)}
    policy, changed = given.start, True
    values: dict[str, Value] = {}
    for number in range(given.rounds):
        before = policy
        work.say(f"Evaluation of $π_{{{number}}}$:")
        values = evaluation(work, POLICY_ITERATION, mdp, known | {"pi": policy, "V": values})
        values |= work.answer(of_states(mdp, values))
        work.say(f"Improvement to $π_{{{number + 1}}}$:")
        improved_to = numbered(pi, number + 1)
        best = {
            state: work.step(POLICY_IMPROVEMENT, s=state, V=values, into=improved_to, **known) for state in mdp.states
        }
        for state, actions in best.items():
            if policy[state] in actions and len(actions) > 1:
                work.say(f"In {state} there is a tie: the old action, {policy[state]}, is kept.")
        improved = work.answer(_improved(policy, best))
        policy = {state: actions[0] for state, actions in improved.items()}
        changed = policy != before
    optimal = not changed and is_optimal(mdp, given.gamma, values)
    last = f"π_{{{given.rounds - 1}}}"
    if changed:
        work.say(f"The last improvement gave a better policy, so ${last}$ is not optimal.")
    elif optimal:
        work.say(f"The last improvement changed nothing: ${last}$ is greedy for its own values, so it is optimal.")
    else:
        work.say(ONLY_GREEDY)
    work.answer(optimal)


def _improved(policy: Mapping[str, str], best: Mapping[str, Any]) -> dict[str, tuple[str, ...]]:
    """The greedy actions; an old action that is among them is kept."""
    return {state: (policy[state],) if policy[state] in actions else actions for state, actions in best.items()}


@slip(
    "stops-after-one-round",
    "The new policy is evaluated and improved in its turn; it ends only when improvement changes nothing.",
    when=lambda given: given.rounds > 1,
)
def stops(given: Given, work: Work) -> None:
    """Whatever comes next has the values of the first policy."""
    solve(given, work, _evaluated_once)


def _evaluated_once(work: Work, formula: Formula, mdp: Model, known: Mapping[str, Any]) -> dict[str, Value]:
    return known["V"] or evaluated(work, formula, mdp, known)


MISCONCEPTIONS = (stops, one_sweep(solve), IMPROVEMENT_BY_VALUE, IMPROVEMENT_BY_REWARD)


def oracle(given: Given) -> Answers:
    """The rounds in floating point, each evaluation by sweeps until nothing changes."""
    states = (*given.mdp.states, *given.mdp.terminal)
    n = len(given.mdp.states)
    P, R = tensors(given.mdp, states)
    policy, answers, stable = dict(given.start), [], False
    for _ in range(given.rounds):
        V = policy_values(P, R, chances(deterministic(policy), given.mdp, states), at(given.gamma))
        best = best_actions(given.mdp, lookahead(P, R, V, at(given.gamma))[:n])
        best = {state: {policy[state]} & actions or actions for state, actions in best.items()}
        answers += [np.array(V[:n]), best]
        stable = all(policy[state] in actions for state, actions in best.items())
        if given.gamma == 1:
            stable = stable and np.allclose(V, optimal_values(P, R, 1.0, n), atol=1e-9)
        policy = {state: next(a for a in given.mdp.actions[state] if a in best[state]) for state in given.mdp.states}
    return [*answers, bool(stable)]
