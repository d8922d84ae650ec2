"""The values of the best policy, held against the optimality equation; or a reward, from an optimal value."""

from collections.abc import Mapping
from itertools import product
from math import prod
from typing import Any, NamedTuple

from msgspec.structs import replace

from rldrill.problems.bellman.optimal_value import Given, Optimal, Sought, of_two_steps
from rldrill.problems.document import begun, joined
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Model, equiprobable
from rldrill.problems.valued import deterministic
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, NoSolution, Value, exact
from rldrill.solutions.formula.formula import Formula, slip
from rldrill.solutions.formula.nodes.leaves import put_in_name
from rldrill.solutions.formula.notation import Qstar, numbered, pi
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.optimality import Optimum, optimum
from rldrill.solutions.oracle import (
    Answers,
    at,
    best_actions,
    chances,
    lookahead,
    optimal_values,
    policy_values,
    root,
    tensors,
    without_loss,
)
from rldrill.solutions.policy_values import Evaluation, evaluated, of_states
from rldrill.solutions.reaching import Chosen, Known, reached, rewarded
from rldrill.solutions.sheet.bellman import (
    BELLMAN_V,
    FORGOT_GAMMA,
    OPTIMAL_Q_BY_REWARD,
    OWN_VALUE,
    Q_FORGOT_GAMMA,
    Q_REWARD_UNWEIGHTED,
    Q_STAR_FROM_V,
    V_STAR_FROM_Q,
)
from rldrill.solutions.sheet.dynamic_programming import GREEDY_FROM_V, SMALLEST_Q, of_round
from rldrill.solutions.work import Result, Work

#: Of so many states policy iteration is written out.
_WRITTEN_OUT = 4


def solve(given: Given, work: Work, evaluation: Evaluation = evaluated) -> None:
    """All optimal values, or the reward that follows from one of them."""
    if isinstance(given, Sought):
        _sought(given, work, min)
    else:
        _optimal(given, work, evaluation)


def _sought(given: Sought, work: Work, chosen: Chosen) -> None:
    """What one of the optimal values says of the model, then how small the reward may be."""
    found = _found(given, work, chosen)
    start = {given.state: found.best, given.row.state: found.rival}
    known = knowns.model(given.mdp) | {"gamma": exact(given.gamma)}
    work.answer(_least(given, work, known, {each: start[each] for each in given.mdp.states}))


class _Found(NamedTuple):
    """The best action where the value is known, the best other one where the reward is earned, and what the actions
    are worth there.
    """

    best: str
    rival: str
    worths: Mapping[str, Value]


def _found(given: Sought, work: Work, chosen: Chosen) -> _Found:
    """The other value, with which the maximum is what is known; the reward, with which it is that value."""
    mdp, state, row = given.mdp, given.state, given.row
    known = knowns.model(mdp) | {"gamma": exact(given.gamma)}
    V = dict.fromkeys(mdp.terminal, ZERO) | {state: exact(given.optimum[state])}
    value, best = reached(work, Q_STAR_FROM_V, Known("V^*", state, V[state], "V^*", row.state), V, chosen, **known)
    V[row.state] = work.answer(value)
    certain = V[row.state] == value
    reward, worths = rewarded(work, Q_STAR_FROM_V, row, "V^*", V[row.state], V, demanding=certain, **known)
    work.answer(reward)
    rivals = [action for action in mdp.actions[row.state] if action != row.action]
    return _Found(best, max(rivals, key=worths.__getitem__), worths)


def _least(given: Sought, work: Work, known: Mapping[str, Any], policy: dict[str, str]) -> Value:
    """The reward with which its action is worth as much as the best policy without it, found from a first policy."""
    mdp, row = given.mdp, given.row
    work.say(f"Which policy is optimal if {row.action} is not taken in {row.state}?")
    last = _iterated(Optimal(mdp=given.without, gamma=given.gamma), work, policy, "the best actions so far")
    value_of_action = of_round(last.number)[2]
    others = [pair for pair in mdp.pairs if last.policy[pair[0]] != pair[1]]
    work.say(f"What are the other actions worth if $π_{{{last.number}}}$ is followed after them?")
    worths = {(s, a): work.step(value_of_action, s=s, a=a, **known, V=last.values) for s, a in others}
    instead = f"{row.action} in {row.state}"
    if beaten := [f"{action} in {state}" for state, action in others if (state, action) != row[:2]]:
        verb = "is" if len(beaten) == 1 else "are"
        work.say(
            f"{begun(joined(beaten))} {verb} worth no more than the action of $π_{{{last.number}}}$, so without "
            f"{instead} it is optimal."
        )
    work.say(f"So {instead} is a best action as soon as it is worth as much as {last.policy[row.state]}:")
    least = work.equate(str(row.reward), worths[row[:2]], last.values[row.state])
    work.say(f"What {row.action} is worth grows with ${row.reward}$, so this is the smallest one.")
    return least


def _optimal(given: Optimal, work: Work, evaluation: Evaluation) -> None:
    """Policy iteration, its last values put into the optimality equation, and what follows."""
    mdp, best = given.mdp, optimum(given.mdp, given.gamma)
    if evaluation is evaluated and given.gamma != 1 and len(mdp.states) <= _WRITTEN_OUT:
        last = _iterated(given, work, of_two_steps(mdp, Fraction(given.gamma)), "what earns most in two steps")
        values, of = last.values, f"$π_{{{last.number}}}$"
        work.say(f"Is another action better than that of {of}? Suppose that the values of {of} are $V^*$:")
        Q = _worths(given, work, values)
        work.say(f"The greatest values are those of {of} again, so no action is better: they are optimal.")
    else:
        values = _of_the_best(given, work, best, evaluation)
        Q = _worths(given, work, values)
    known = knowns.model(mdp) | {"gamma": exact(given.gamma)}
    if best.unlike_sweeps:
        work.say(
            "Value iteration that begins with 0 does not come to them: in {} it settles at {}.".format(
                *best.unlike_sweeps
            )
        )
    own = values | work.answer(of_states(mdp, values))
    greedy = {state: work.value(GREEDY_FROM_V, s=state, V=own, **known) for state in mdp.states}
    told = joined([f"{joined(list(actions))} in {state}" for state, actions in greedy.items()])
    work.say(f"The maxima of the optimality equation are reached by {told}.")
    best.tell(work)
    work.answer(best.among(greedy))
    work.say("These values stand in part (a):")
    work.lines.append(Result(tuple(Qstar(*map(put_in_name, pair)) for pair in Q), tuple(Q.values())))
    if own != values:  # whoever has other values goes on with them
        Q = {(s, a): work.value(Q_STAR_FROM_V, s=s, a=a, V=own, **known) for s, a in mdp.pairs}
    work.answer(Q)


def _worths(given: Optimal, work: Work, values: Mapping[str, Value]) -> dict[tuple[str, str], Value]:
    """The optimality equation in two steps: what every action is worth, and the greatest of it."""
    mdp, gamma = given.mdp, exact(given.gamma)
    Q = {(s, a): work.step(Q_STAR_FROM_V, s=s, a=a, V=values, **knowns.model(mdp), gamma=gamma) for s, a in mdp.pairs}
    for state in mdp.states:
        work.step(V_STAR_FROM_Q, s=state, Q=Q, actions=mdp.actions)
    return Q


class _Last(NamedTuple):
    """The policy with which policy iteration ends, its number and its values."""

    number: int
    policy: dict[str, str]
    values: dict[str, Value]


def _iterated(given: Optimal, work: Work, policy: dict[str, str], why: str) -> _Last:
    """Policy iteration from a policy, which is taken for a reason, to the one that it ends with."""
    mdp = given.mdp
    known = knowns.model(mdp) | {"gamma": exact(given.gamma)}
    work.say(f"Start with the guess $π_0$, {why}: {_told(policy)}.")
    number, most = 0, prod(map(len, mdp.actions.values()))
    while number < most:
        evaluate, improve, _ = of_round(number)
        values = evaluated(work, evaluate, mdp, known | {"pi": policy})
        greedy = {state: work.value(improve, s=state, V=values, **known) for state in mdp.states}
        if all(policy[state] in greedy[state] for state in mdp.states):
            return _Last(number, policy, values)
        for state in mdp.states:
            work.step(improve, s=state, V=values, into=numbered(pi, number + 1), **known)
        policy = {s: policy[s] if policy[s] in actions else actions[0] for s, actions in greedy.items()}
        number += 1
        work.say(f"This changes the policy, so $π_{{{number}}}$ is evaluated: {_told(policy)}.")
    raise NoSolution("with this mistake the policies go round in a circle")


def _of_the_best(given: Optimal, work: Work, best: Optimum, evaluation: Evaluation) -> dict[str, Value]:
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


def _settle_for(given: Optimal, work: Work, policy: Mapping[str, str]) -> None:
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
    when=lambda given: isinstance(given, Optimal) and given.gamma != 0,
)
def most_paid(given: Optimal, work: Work) -> None:
    """The policy that is best without what comes after."""
    _settle_for(given, work, optimum(given.mdp, Fraction(0)).policy)


@slip(
    "wrong-fixed-policy",
    "This comes of the policy that always takes the first action; in some state another one is better.",
    when=lambda given: isinstance(given, Optimal),
)
def first_actions(given: Optimal, work: Work) -> None:
    """The policy that always takes the first action."""
    _settle_for(given, work, {state: actions[0] for state, actions in given.mdp.actions.items()})


@slip(
    "mean-for-max",
    "This comes of choosing at random; the optimal value takes the best action in every state.",
    when=lambda given: isinstance(given, Optimal),
)
def at_random(given: Optimal, work: Work) -> None:
    """The values of the policy that chooses at random."""
    _optimal(given, work, _at_random)


@slip(
    "exceeds-the-maximum",
    "V* is the greatest of the actions' values, so none may exceed it: the smallest value that reaches it is right.",
    when=lambda given: isinstance(given, Sought),
)
def exceeds(given: Sought, work: Work) -> None:
    """The greatest of the values that reach what is known."""
    _sought(given, work, max)


@slip(
    "value-kept",
    "With another reward the optimal values can be others: those found before belong to the reward that was found.",
    when=lambda given: isinstance(given, Sought),
)
def value_kept(given: Sought, work: Work) -> None:
    """The smallest reward with the optimal values of the other one."""
    _, rival, worths = _found(given, work, min)
    work.answer(work.equate(str(given.row.reward), worths[given.row.action], worths[rival]))


def _at_random(work: Work, formula: Formula, mdp: Model, known: Mapping[str, Any]) -> dict[str, Value]:
    return evaluated(work, formula, mdp, {**known, "pi": knowns.policy(equiprobable(mdp))})


@slip(
    "terminal-value",
    "A terminal state is worth 0: the reward for reaching it is already earned on the way there.",
    when=lambda given: isinstance(given, Optimal) and knowns.pays_at_the_end(given.mdp),
)
def end_paid(given: Optimal, work: Work) -> None:
    """The optimum where every end is worth what reaching it earns, so that an end is reached for more."""
    mdp, gamma = given.mdp, Fraction(given.gamma)
    ends = {row.next: Fraction(row.reward) for row in mdp.transitions if row.next in mdp.terminal}
    rows = [row._replace(reward=Fraction(row.reward) + gamma * ends.get(row.next, 0)) for row in mdp.transitions]
    paid = Model(transitions=tuple(rows), terminal=mdp.terminal)
    _optimal(given.model_copy(update={"mdp": paid}), work, evaluated)


MISCONCEPTIONS = (
    most_paid, first_actions, at_random, exceeds, value_kept.where_it_shows(), Q_FORGOT_GAMMA,
    replace(OPTIMAL_Q_BY_REWARD.where_it_shows(), when=lambda given: isinstance(given, Optimal)),
    end_paid, SMALLEST_Q.where_it_shows(), Q_REWARD_UNWEIGHTED.where_it_shows(), FORGOT_GAMMA.where_it_shows(),
    OWN_VALUE,
)  # fmt: skip


def oracle(given: Given) -> Answers:
    """Sweeps of value iteration until nothing changes; the best actions by trying all."""
    return _swept(given) if isinstance(given, Optimal) else _tried(given)


def _tried(given: Sought) -> Answers:
    """Every policy with the reward that gives it the known value; the one that sweeps find to be optimal then."""
    mdp, gamma, known = given.mdp, at(given.gamma), at(given.optimum[given.state])
    states, n = mdp.every_state, len(mdp.states)
    place, other = states.index(given.state), states.index(given.row.state)
    for actions in product(*mdp.actions.values()):
        pi = chances(deterministic(dict(zip(mdp.states, actions, strict=True))), mdp)
        low, high = (policy_values(*tensors(mdp, x), pi, gamma)[place] for x in (0.0, 1.0))
        if abs(high - low) < 1e-9:
            continue  # the policy does not earn the reward
        P, R = tensors(mdp, x := (known - low) / (high - low))
        V = optimal_values(P, R, gamma, n)
        if abs(V[place] - known) < 1e-6:
            return V[other], x, _threshold(given, P, R)
    raise AssertionError("no policy is optimal")


def _threshold(given: Sought, P: Array, R: Array) -> float:
    """Where the action starts to be worth as much as the optimum without it, from two trials."""
    mdp, gamma, states = given.mdp, at(given.gamma), given.mdp.every_state
    names = mdp.every_action
    place = states.index(given.row.state), names.index(given.row.action)
    barred = R.copy()
    barred[place] = -np.inf
    V = optimal_values(P, barred, gamma, len(mdp.states))
    return root(lambda x: float(lookahead(*tensors(mdp, x), V, gamma)[place] - V[place[0]]))


def _swept(given: Optimal) -> Answers:
    """All values by sweeps."""
    mdp = given.mdp
    states = mdp.every_state
    P, R = tensors(mdp)
    n = len(mdp.states)
    V = optimal_values(P, R, at(given.gamma), n)
    Q = lookahead(P, R, V, at(given.gamma))
    names = mdp.every_action
    best = best_actions(mdp, Q[:n])
    return (
        V[:n],
        without_loss(mdp, best) if given.gamma == 1 else best,
        [Q[states.index(state), names.index(action)] for state, action in mdp.pairs],
    )
