"""The values of the best policy, held against the optimality equation; or a reward, from an optimal value."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from itertools import count, product
from typing import Any, TypeAlias

from rldrill.problems.bellman.optimal_value import Given, Optimal, Sought, of_two_steps
from rldrill.problems.document import joined
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Model, equiprobable
from rldrill.problems.valued import deterministic
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, NoSolution, Value, exact, parameters, to_sympy
from rldrill.solutions.formula.formula import Formula, slip
from rldrill.solutions.formula.notation import numbered, pi
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
from rldrill.solutions.policy_values import Evaluation, evaluated, of_states, terminal_value
from rldrill.solutions.rational import generator
from rldrill.solutions.sheet.bellman import (
    BELLMAN_OPTIMALITY_V,
    BELLMAN_V,
    OWN_VALUE,
    Q_FORGOT_GAMMA,
    Q_STAR_FROM_V,
)
from rldrill.solutions.sheet.dynamic_programming import GREEDY_FROM_V, of_round
from rldrill.solutions.work import Work

#: Of so many states policy iteration is written out.
_WRITTEN_OUT = 4


#: Chooses among the values with which one action or another reaches what is known.
Chosen: TypeAlias = Callable[[Iterable[Any]], Any]


def solve(given: Given, work: Work, evaluation: Evaluation = evaluated) -> None:
    """All optimal values, or the reward that follows from one of them."""
    if isinstance(given, Sought):
        _sought(given, work, min)
    else:
        _optimal(given, work, evaluation)


def _sought(given: Sought, work: Work, chosen: Chosen) -> None:
    """The other value, with which the maximum is what is known; the reward, with which it is that value."""
    mdp, state, row = given.mdp, given.state, given.row
    target, y = exact(given.optimum[state]), generator("y")
    known = knowns.model(mdp) | {"gamma": exact(given.gamma)}
    V = dict.fromkeys(mdp.terminal, ZERO) | {state: target}
    work.say(f'Let $y = V^*("{row.state}")$. The actions in {state} have these values:')
    worths = {
        action: work.step(Q_STAR_FROM_V, s=state, a=action, **known, V=V | {row.state: y})
        for action in mdp.actions[state]
    }
    ends = {}
    for action, worth in worths.items():
        if parameters(worth):
            work.say(f'If {action} is best in {state}, this is $V^*("{state}") = {to_sympy(target)}$:')
            ends[action] = work.equate("y", worth, target)
    if not ends or any(worth >= target for action, worth in worths.items() if action not in ends):
        raise NoSolution(
            f"optimum: no value of {row.state!r} makes {target} the optimal value of {state!r}; give another"
        )
    value = chosen(ends.values())
    (best, *_) = (action for action, end in ends.items() if end == value)
    if less := [action for action in worths if action not in ends]:
        verb = "is" if len(less) == 1 else "are"
        work.say(f"{joined(less).capitalize()} {verb} worth less than ${to_sympy(target)}$.")
    if others := {end: action for action, end in ends.items() if end != value}:
        more = {}
        for end in others:
            work.say(f"With $y = {to_sympy(end)}$ {best} is worth:")
            more[end] = work.step(Q_STAR_FROM_V, s=state, a=best, **known, V=V | {row.state: end})
        told = joined([f"${to_sympy(more[end])}$ with $y = {to_sympy(end)}$" for end in others])
        too_much = f"{best.capitalize()} would be worth {told}, more than ${to_sympy(target)}$"
        work.say(f"{too_much}: so $y = {to_sympy(value)}$ is right.")
    else:
        work.say(f"So {best} is best in {state}.")
    V[row.state] = work.answer(value)
    work.say(f"The actions in {row.state} have these values:")
    worths = {
        action: work.step(Q_STAR_FROM_V, s=row.state, a=action, **known, V=V) for action in mdp.actions[row.state]
    }
    if V[row.state] == value and any(each >= value for action, each in worths.items() if action != row.action):
        raise NoSolution(
            f"the reward of {row.action!r} does not follow: another action in {row.state!r} is worth as much or more"
        )
    work.say(f'Only {row.action} can be worth $V^*("{row.state}") = {to_sympy(V[row.state])}$:')
    work.answer(work.equate(str(row.reward), worths[row.action], V[row.state]))
    rest = {}
    for action in mdp.actions[state]:
        if action != best:
            calculated = work.step if action in ends else work.value  # else it has been, for it does not depend on y
            rest[action] = calculated(Q_STAR_FROM_V, s=state, a=action, **known, V=V)
    beaten = [f"{action} (${to_sympy(number)}$)" for action, number in rest.items()]
    compared = f", more than {joined(beaten)}" if beaten else ""
    work.say(f'{best.capitalize()} is worth $V^*("{state}") = {to_sympy(target)}${compared}.')
    work.answer({state: (best,)})
    work.say(f"If {row.action} is not taken in {row.state}, the optimal values follow from the other actions.")
    rivals = [action for action in mdp.actions[row.state] if action != row.action]
    start = {state: best, row.state: max(rivals, key=worths.__getitem__)}
    policy = {each: start[each] for each in mdp.states}
    V = _iterated(Optimal(mdp=given.without, gamma=given.gamma), work, policy, "the best of the actions left")
    work.say(f"With these values {row.action} is worth in {row.state}:")
    worth = work.step(Q_STAR_FROM_V, s=row.state, a=row.action, **known, V=V)
    work.say("This is as much as the best of the others is worth there if")
    least = work.equate(str(row.reward), worth, V[row.state])
    work.say(f"What {row.action} is worth grows with ${row.reward}$, so this is the smallest one.")
    work.answer(least)


def _optimal(given: Optimal, work: Work, evaluation: Evaluation) -> None:
    """Policy iteration, its last values put into the optimality equation, and what follows."""
    mdp, best = given.mdp, optimum(given.mdp, given.gamma)
    if evaluation is evaluated and given.gamma != 1 and len(mdp.states) <= _WRITTEN_OUT:
        first = of_two_steps(mdp, Fraction(given.gamma))
        values = _iterated(given, work, first, "what would be best if two steps were left")
    else:
        values = _of_the_best(given, work, best, evaluation)
    known = knowns.model(mdp) | {"gamma": exact(given.gamma)}
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


def _iterated(given: Optimal, work: Work, policy: dict[str, str], why: str) -> dict[str, Value]:
    """Policy iteration from a policy, which takes what the words say, to the last values, held against the equation."""
    mdp = given.mdp
    known = knowns.model(mdp) | {"gamma": exact(given.gamma)}
    work.say(f"Policy iteration may start with any policy; here with $π_0$, which takes {why}: {_told(policy)}.")
    for number in count():
        evaluate, improve, _ = of_round(number)
        values = evaluated(work, evaluate, mdp, known | {"pi": policy})
        greedy = {state: work.value(improve, s=state, V=values, **known) for state in mdp.states}
        if all(policy[state] in greedy[state] for state in mdp.states):
            break
        for state in mdp.states:
            work.step(improve, s=state, V=values, into=numbered(pi, number + 1), **known)
        policy = {s: policy[s] if policy[s] in actions else actions[0] for s, actions in greedy.items()}
        work.say(f"This changes the policy, so $π_{{{number + 1}}}$ is evaluated: {_told(policy)}.")
    work.say(
        f"Is another action better than that of $π_{{{number}}}$? Its values are put into the optimality equation:"
    )
    for state in mdp.states:
        work.step(BELLMAN_OPTIMALITY_V, s=state, V=values, **known)
    work.say(f"The greatest values are those of $π_{{{number}}}$ again, so no action is better: they are optimal.")
    return values


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
    for state in mdp.states:
        work.step(BELLMAN_OPTIMALITY_V, s=state, V=values, **knowns.model(mdp), gamma=exact(given.gamma))
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
    "These are the values of the policy that always takes the first action; in some state another one is better.",
    when=lambda given: isinstance(given, Optimal),
)
def first_actions(given: Optimal, work: Work) -> None:
    """The policy that always takes the first action."""
    _settle_for(given, work, {state: actions[0] for state, actions in given.mdp.actions.items()})


@slip(
    "mean-for-max",
    "These are the values of choosing at random; the optimal value takes the best action in every state.",
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


def _at_random(work: Work, formula: Formula, mdp: Model, known: Mapping[str, Any]) -> dict[str, Value]:
    return evaluated(work, formula, mdp, {**known, "pi": knowns.policy(equiprobable(mdp))})


_END_PAID = terminal_value(_optimal)
MISCONCEPTIONS = (
    most_paid, first_actions, at_random, exceeds, Q_FORGOT_GAMMA,
    replace(_END_PAID, when=lambda given: isinstance(given, Optimal) and _END_PAID.applies(given)),
    replace(OWN_VALUE, when=lambda given: isinstance(given, Optimal)),
)  # fmt: skip


def oracle(given: Given) -> Answers:
    """Sweeps of value iteration until nothing changes; the best actions by trying all."""
    return _swept(given) if isinstance(given, Optimal) else _tried(given)


def _tried(given: Sought) -> Answers:
    """Every policy with the reward that gives it the known value; the one that sweeps find to be optimal then."""
    mdp, gamma, known = given.mdp, at(given.gamma), at(given.optimum[given.state])
    states, n = (*mdp.states, *mdp.terminal), len(mdp.states)
    place, other = states.index(given.state), states.index(given.row.state)
    for actions in product(*mdp.actions.values()):
        pi = chances(deterministic(dict(zip(mdp.states, actions, strict=True))), mdp, states)
        low, high = (policy_values(*tensors(mdp, states, x), pi, gamma)[place] for x in (0.0, 1.0))
        if abs(high - low) < 1e-9:
            continue  # the policy does not earn the reward
        P, R = tensors(mdp, states, x := (known - low) / (high - low))
        V = optimal_values(P, R, gamma, n)
        if abs(V[place] - known) < 1e-6:
            best = best_actions(mdp, lookahead(P, R, V, gamma)[:n])
            return V[other], x, {given.state: best[given.state]}, _threshold(given, P, R)
    raise AssertionError("no policy is optimal")


def _threshold(given: Sought, P: Array, R: Array) -> float:
    """Where the action starts to be worth as much as the optimum without it, from two trials."""
    mdp, gamma, states = given.mdp, at(given.gamma), (*given.mdp.states, *given.mdp.terminal)
    names = tuple(dict.fromkeys(action for _, action in mdp.outcomes))
    place = states.index(given.row.state), names.index(given.row.action)
    barred = R.copy()
    barred[place] = -np.inf
    V = optimal_values(P, barred, gamma, len(mdp.states))
    return root(lambda x: float(lookahead(*tensors(mdp, states, x), V, gamma)[place] - V[place[0]]))


def _swept(given: Optimal) -> Answers:
    """All values by sweeps."""
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
