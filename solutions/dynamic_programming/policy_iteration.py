"""Evaluation and improvement in turn; when improvement changes nothing, the policy is optimal."""

from collections.abc import Mapping
from typing import Any

from msgspec.structs import replace

from rldrill.problems.document import joined
from rldrill.problems.dynamic_programming.policy_iteration import Given, Rounds, Threshold
from rldrill.problems.exact import Parameter, shown
from rldrill.problems.models import Model
from rldrill.problems.valued import deterministic, policy_values, with_reward, worth
from rldrill.solutions import knowns
from rldrill.solutions.exact import NoSolution, Value, exact, to_sympy, told, value_at
from rldrill.solutions.formula.formula import Formula, slip
from rldrill.solutions.formula.notation import numbered, pi
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.optimality import ONLY_GREEDY, is_optimal
from rldrill.solutions.oracle import (
    Answers,
    at,
    best_actions,
    chances,
    lookahead,
    optimal_values,
    root,
    tensors,
)
from rldrill.solutions.oracle import policy_values as values_of
from rldrill.solutions.policy_values import Evaluation, evaluated, of_states, one_sweep, swept_once
from rldrill.solutions.sheet.bellman import FORGOT_GAMMA, Q_FORGOT_GAMMA
from rldrill.solutions.sheet.dynamic_programming import (
    IMPROVEMENT_BY_REWARD,
    IMPROVEMENT_BY_VALUE,
    SMALLEST_Q,
    of_round,
)
from rldrill.solutions.work import Work


def solve(given: Given, work: Work, evaluation: Evaluation = evaluated) -> None:
    """Round after round, or the reward up to which the first policy is optimal."""
    if isinstance(given, Threshold):
        _of_threshold(given, work, evaluation)
    else:
        _of_rounds(given, work, evaluation)


def _of_rounds(given: Rounds, work: Work, evaluation: Evaluation) -> None:
    """In every round the values of the policy, then the greedy actions for them."""
    mdp = given.mdp
    known = knowns.model(mdp) | {"gamma": exact(given.gamma)}
    policy, changed = given.start, True
    values: dict[str, Value] = {}
    for number in range(given.rounds):
        before = policy
        work.say(f"Evaluation of $π_{{{number}}}$:")
        evaluate, improve, _ = of_round(number)
        values = evaluation(work, evaluate, mdp, known | {"pi": policy, "V": values})
        values |= work.answer(of_states(mdp, values))
        work.say(f"Improvement to $π_{{{number + 1}}}$:")
        improved_to = numbered(pi, number + 1)
        best = {state: work.step(improve, s=state, V=values, into=improved_to, **known) for state in mdp.states}
        for state, actions in best.items():
            if policy[state] in actions and len(actions) > 1:
                work.say(f"In {state} there is a tie: the old action, {policy[state]}, is kept.")
        found = _improved(policy, best)
        work.say(f"So $π_{{{number + 1}}}$ is {joined([f'{actions[0]} in {s}' for s, actions in found.items()])}.")
        improved = work.answer(found)
        policy = {state: actions[0] for state, actions in improved.items()}
        changed = policy != before
    optimal = not changed and is_optimal(mdp, given.gamma, values)
    last = f"π_{{{given.rounds - 1}}}"
    if changed:
        state = next(state for state in mdp.states if policy[state] != before[state])
        worth = work.value(of_round(given.rounds - 1)[2], s=state, a=policy[state], V=values, **known)
        more = f"{policy[state]} is worth ${told(worth)}$ by $V^{{{last}}}$, more than ${told(values[state])}$"
        work.say(f"In {state}, {more}: so ${last}$ is not optimal.")
    elif optimal:
        work.say(f"The last improvement changed nothing: ${last}$ is greedy for its own values, so it is optimal.")
    else:
        work.say(ONLY_GREEDY)
    work.answer(optimal)


def _of_threshold(given: Threshold, work: Work, evaluation: Evaluation) -> None:
    """The values of the first policy, what the other actions are worth by them, and the values of the next policy."""
    _demand_sense(given)
    mdp, start, row = given.mdp, given.start, given.row
    known = knowns.model(mdp) | {"gamma": exact(given.gamma)}
    evaluate, _, value_of_action = of_round(0)
    values = evaluation(work, evaluate, mdp, known | {"pi": start})
    values |= work.answer(of_states(mdp, values))
    letter, pair = shown(Parameter(row.reward)), (row.state, row.action)
    others = [each for each in mdp.pairs if start[each[0]] != each[1]]
    work.say("$π_0$ is optimal as long as no other action is worth more than that of $π_0$. The other actions:")
    worths = {each: work.step(value_of_action, s=each[0], a=each[1], V=values, **known) for each in others}
    if rest := [f"{action} in {state}" for state, action in others if (state, action) != pair]:
        less = all(worths[each] < values[each[0]] for each in others if each != pair)
        compared = f"{'is' if len(rest) == 1 else 'are'} worth {'less' if less else 'no more'} than $V^{{π_0}}$"
        work.say(f"Whatever ${letter}$ is, {joined(rest)} {compared}.")
    work.say(f"In {row.state}, {row.action} is worth as much as {start[row.state]} if")
    bound = work.equate(str(row.reward), worths[pair], values[row.state])
    more = f"With a larger ${letter}$, {row.action} is better there"
    work.say(f"{more}, so $π_0$ is optimal for all ${letter} ≤ {to_sympy(bound)}$.")
    work.answer(bound)
    policy = given.improved
    now, before = value_at(worths[pair], exact(given.reward)), values[row.state]
    chosen = joined([f'$π_1("{state}")$ = {action}' for state, action in policy.items()])
    work.say(
        f"With ${letter} = {shown(given.reward)}$, {row.action} in {row.state} is worth ${told(now)}$, more than "
        f"${told(before)}$, so improvement changes the action there, and no other: {chosen}."
    )
    closed = knowns.model(with_reward(mdp, given.reward)) | {"gamma": exact(given.gamma)}
    values = evaluation(work, of_round(1)[0], mdp, closed | {"pi": policy, "V": {}})
    work.answer(of_states(mdp, values))


def _demand_sense(given: Threshold) -> None:
    """Demand that the first policy is optimal for some rewards, and not for the one that is taken then.

    Raises:
        NoSolution: it is not so.
    """
    mdp, row = with_reward(given.mdp, given.reward), given.row
    values = policy_values(mdp, deterministic(given.start), given.gamma)
    for state, action in mdp.pairs:
        better = worth(mdp, (state, action), values, given.gamma) > values[state]
        if better and (state, action) != (row.state, row.action):
            raise NoSolution(f"start is optimal for no reward, for {action!r} is better in {state!r}; start with it")
        if not better and (state, action) == (row.state, row.action):
            raise NoSolution(f"reward: with {given.reward} {action!r} is not better in {state!r}; give a larger one")


def _improved(policy: Mapping[str, str], best: Mapping[str, Any]) -> dict[str, tuple[str, ...]]:
    """The greedy actions; an old action that is among them is kept."""
    return {state: (policy[state],) if policy[state] in actions else actions for state, actions in best.items()}


@slip(
    "goes-on-from-old-values",
    "The values of the new policy must solve all its equations; one sweep from the old values is not enough.",
    when=lambda given: isinstance(given, Rounds) and given.rounds > 1,
)
def goes_on(given: Given, work: Work) -> None:
    """The first policy's values are found, those of a later one by a sweep from the values before."""
    solve(given, work, _gone_on)


def _gone_on(work: Work, formula: Formula, mdp: Model, known: Mapping[str, Any]) -> dict[str, Value]:
    return (swept_once if known["V"] else evaluated)(work, formula, mdp, known)


@slip(
    "stops-after-one-round",
    "The new policy is evaluated and improved in its turn; it ends only when improvement changes nothing.",
    when=lambda given: isinstance(given, Rounds) and given.rounds > 1,
)
def stops(given: Given, work: Work) -> None:
    """Whatever comes next has the values of the first policy."""
    solve(given, work, _evaluated_once)


def _evaluated_once(work: Work, formula: Formula, mdp: Model, known: Mapping[str, Any]) -> dict[str, Value]:
    return known["V"] or evaluated(work, formula, mdp, known)


MISCONCEPTIONS = (
    stops, goes_on.where_it_shows(), one_sweep(solve), IMPROVEMENT_BY_VALUE, IMPROVEMENT_BY_REWARD,
    # In rounds one action value is told beside the answers: it shows that a policy is not optimal, and changes nothing.
    replace(Q_FORGOT_GAMMA, when=lambda given: isinstance(given, Threshold)),
    FORGOT_GAMMA.where_it_shows(), SMALLEST_Q.where_it_shows(),
)  # fmt: skip


def oracle(given: Given) -> Answers:
    """In floating point, each evaluation by sweeps until nothing changes."""
    return _rounds_tried(given) if isinstance(given, Rounds) else _threshold_tried(given)


def _threshold_tried(given: Threshold) -> Answers:
    """The reward at which another action starts to pay, from two trials; all values with it, and with the number."""
    mdp, gamma = given.mdp, at(given.gamma)
    states = mdp.every_state
    names = mdp.every_action
    place, n = (states.index(given.row.state), names.index(given.row.action)), len(mdp.states)
    first = chances(deterministic(given.start), mdp)

    def tried(x: float) -> tuple[Array, float]:
        P, R = tensors(mdp, x)
        V = values_of(P, R, first, gamma)
        return V, float(lookahead(P, R, V, gamma)[place] - V[place[0]])

    P, R = tensors(mdp, at(given.reward))
    after = values_of(P, R, chances(deterministic(given.improved), mdp), gamma)
    return tried(0.0)[0][:n], root(lambda x: tried(x)[1]), after[:n]


def _rounds_tried(given: Rounds) -> Answers:
    """The rounds one after the other."""
    n = len(given.mdp.states)
    P, R = tensors(given.mdp)
    policy, answers, stable = dict(given.start), [], False
    for _ in range(given.rounds):
        V = values_of(P, R, chances(deterministic(policy), given.mdp), at(given.gamma))
        best = best_actions(given.mdp, lookahead(P, R, V, at(given.gamma))[:n])
        best = {state: {policy[state]} & actions or actions for state, actions in best.items()}
        answers += [np.array(V[:n]), best]
        stable = all(policy[state] in actions for state, actions in best.items())
        if given.gamma == 1:
            stable = stable and np.allclose(V, optimal_values(P, R, 1.0, n), atol=1e-9)
        policy = {state: next(a for a in given.mdp.actions[state] if a in best[state]) for state in given.mdp.states}
    return [*answers, bool(stable)]
