"""One look ahead with every action, from the values of the policy."""

from typing import Any

from rldrill.problems.document import joined
from rldrill.problems.dynamic_programming.policy_improvement import Given
from rldrill.problems.mathematics import mathematics
from rldrill.solutions import knowns
from rldrill.solutions.formula.notation import conditioned, quantity
from rldrill.solutions.greedy import taken
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
from rldrill.solutions.sheet.bellman import BELLMAN_Q, BELLMAN_V, FORGOT_GAMMA, Q_FORGOT_GAMMA
from rldrill.solutions.sheet.dynamic_programming import (
    IMPROVEMENT_BY_REWARD,
    IMPROVEMENT_BY_VALUE,
    IMPROVEMENT_FROM_Q,
    POLICY_IMPROVEMENT,
    SMALLEST_Q,
)
from rldrill.solutions.work import Work

#: The greedy policy, beside the one that is given.
_Improved = quantity("pi", conditioned(mathematics("π'")))


def solve(given: Given, work: Work, evaluation: Evaluation = evaluated) -> None:
    """The policy's values if they are not given, the greedy actions, and whether they are the policy's own."""
    mdp = given.mdp
    known = knowns.model_and_policy(mdp, given.policy, given.gamma)
    if given.values is None:
        values = evaluation(work, BELLMAN_V, mdp, known)
        values |= work.answer(of_states(mdp, values))
    else:
        values = knowns.state_values(given.values, mdp.terminal)
    if given.action_values:
        Q = work.answer({(s, a): work.step(BELLMAN_Q, s=s, a=a, V=values, **known) for s, a in mdp.pairs})
        best = {s: work.step(IMPROVEMENT_FROM_Q, s=s, Q=Q, into=_Improved, **known) for s in mdp.states}
    else:
        best = {s: work.step(POLICY_IMPROVEMENT, s=s, V=values, into=_Improved, **known) for s in mdp.states}
    work.say(f"So these actions are greedy: {taken(best)}.")
    greedy = work.answer(best)
    own = {state: [action for action, chance in row.items() if chance] for state, row in given.policy.items()}
    better = [state for state in mdp.states if not set(own[state]) <= set(greedy[state])]
    stable = not better
    optimal = stable and is_optimal(mdp, given.gamma, values)
    if stable and not optimal:
        work.say(ONLY_GREEDY)
    else:
        work.say(
            "In every state the action of $π$ is greedy, so no action is better: $π$ is optimal."
            if optimal
            else f"In {joined(better)} another action is better than that of $π$, so $π$ is not optimal."
        )
    work.answer(optimal)


MISCONCEPTIONS = (
    FORGOT_GAMMA.where_it_shows(),
    IMPROVEMENT_BY_VALUE,
    IMPROVEMENT_BY_REWARD,
    one_sweep(solve),
    Q_FORGOT_GAMMA,
    SMALLEST_Q.where_it_shows(),
)


def oracle(given: Given) -> Answers:
    """Sweeps until nothing changes, then every action tried; optimal if no action beats the policy's values."""
    states = given.mdp.every_state
    n = len(given.mdp.states)
    P, R = tensors(given.mdp)
    V = policy_values(P, R, chances(given.policy, given.mdp), at(given.gamma))
    worth = lookahead(P, R, V, at(given.gamma))[:n]
    answers: list[Any] = [V[:n]] if given.values is None else []
    if given.action_values:
        names = given.mdp.every_action
        answers.append([worth[states.index(s), names.index(a)] for s, a in given.mdp.pairs])
    best = optimal_values(P, R, 1.0, n)[:n] if given.gamma == 1 else worth.max(axis=1)
    answers += [best_actions(given.mdp, worth), bool((best < V[:n] + 1e-9).all())]
    return answers
