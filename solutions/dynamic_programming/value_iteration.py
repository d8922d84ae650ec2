"""Sweeps of value iteration, over states or over actions, then the greedy actions."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from rldrill.problems.document import joined
from rldrill.problems.dynamic_programming.value_iteration import Given
from rldrill.problems.models import Model
from rldrill.solutions import knowns
from rldrill.solutions.exact import ONE, ZERO, NoSolution, Value, exact, sign, to_sympy
from rldrill.solutions.formula.formula import Formula, slip
from rldrill.solutions.formula.notation import Q as ActionValue
from rldrill.solutions.formula.notation import V, numbered
from rldrill.solutions.greedy import taken
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at, best_actions, lookahead, tensors
from rldrill.solutions.sheet.bellman import FORGOT_GAMMA, OPTIMAL_Q_BY_REWARD
from rldrill.solutions.sheet.dynamic_programming import (
    MEAN_FOR_MAX,
    SWEEP_OVER_ACTIONS,
    VALUE_ITERATION,
    ahead_of,
    greedy,
    synchronous,
)
from rldrill.solutions.sweeps import order_slips
from rldrill.solutions.work import Work


def solve(
    given: Given,
    work: Work,
    ends: Callable[[Model], dict[str, Value]] = lambda mdp: dict.fromkeys(mdp.terminal, ZERO),
) -> None:
    """Each sweep from the values of the one before, or with the newest in place; an end is worth nothing."""
    mdp = given.mdp
    known = knowns.model(mdp) | {"gamma": exact(given.gamma)}
    if given.action_values:
        _over_actions(given, work, known, ends(mdp))
        return
    values = dict.fromkeys(mdp.states, ZERO) | knowns.values(given.start or {}) | ends(mdp)
    formula = VALUE_ITERATION if given.in_place else synchronous(VALUE_ITERATION)
    for sweep in range(1, given.sweeps + 1):
        work.say(f"Sweep {sweep}:")
        before = values
        for state in mdp.states:
            V_k = values if given.in_place else before
            values = values | {state: work.step(formula, s=state, V=V_k, into=numbered(V, sweep), **known)}
    values |= work.answer({state: values[state] for state in mdp.states})
    if given.tie:
        _tie(given.tie, work, ahead_of(given.sweeps), known | {"V": values})
        return
    work.say(f"The greedy policy $π$ for $V_{{{given.sweeps}}}$, which need not be an optimal policy yet:")
    best = {state: work.step(greedy(given.sweeps)[0], s=state, V=values, **known) for state in mdp.states}
    work.say(f"So these actions are greedy: {taken(best)}.")
    work.answer(best)


def _tie(state: str, work: Work, worth_of: Formula, known: dict[str, Any]) -> None:
    """The discount with which both actions of a state are worth the same, and which is worth more below it."""
    actions = known["actions"][state]
    worth = [work.step(worth_of, s=state, a=action, **known) for action in actions]
    work.say("Both are greedy where these are equal:")
    gamma = work.equate("gamma", *worth)
    if sign(gamma) <= 0 or sign(ONE - gamma) < 0:
        raise NoSolution(f"with no discount from 0 to 1 are both actions in {state!r} greedy; change a reward")
    below = work.answer(gamma) / 2
    first, second = (work.value(worth_of, s=state, a=action, **known | {"gamma": below}) for action in actions)
    letter = "A" if sign(first - second) > 0 else "B"
    at_once = [work.value(worth_of, s=state, a=action, **known | {"gamma": ZERO}) for action in actions]
    told = joined([f"{action} ${to_sympy(value)}$" for action, value in zip(actions, at_once, strict=True)])
    work.say(
        f"With $γ = 0$ the actions would be worth their rewards, {told}. Both values are linear in $γ$ and equal only "
        f"at $γ = {to_sympy(gamma)}$: so {actions['AB'.index(letter)]} is greedy for every smaller $γ$."
    )
    work.answer(letter)


def _over_actions(given: Given, work: Work, known: dict[str, Any], ends: Mapping[str, Value]) -> None:
    """The same for the values of states with actions; an end has one action, worth nothing."""
    mdp = given.mdp
    known["actions"] = mdp.actions | dict.fromkeys(mdp.terminal, (knowns.NO_ACTION,))
    Q = dict.fromkeys(mdp.pairs, ZERO) | {(state, knowns.NO_ACTION): value for state, value in ends.items()}
    for sweep in range(1, given.sweeps + 1):
        work.say(f"Sweep {sweep}:")
        name, before = numbered(ActionValue, sweep), Q
        Q = before | {
            (s, a): work.step(synchronous(SWEEP_OVER_ACTIONS), s=s, a=a, Q=before, into=name, **known)
            for s, a in mdp.pairs
        }
    Q |= work.answer({pair: Q[pair] for pair in mdp.pairs})
    work.say(f"The greedy policy $π$ for $Q_{{{given.sweeps}}}$, which need not be an optimal policy yet:")
    best = {state: work.step(greedy(given.sweeps)[1], s=state, Q=Q, **known) for state in mdp.states}
    work.say(f"So these actions are greedy: {taken(best)}.")
    work.answer(best)


@slip(
    "terminal-reward-twice",
    "A terminal state is worth 0: the reward for reaching it is earned once, on the way there.",
    when=lambda given: given.tie is None and knowns.pays_at_the_end(given.mdp),
)
def paid_twice(given: Given, work: Work) -> None:
    """An end is worth what the way there earned."""
    solve(given, work, ends=knowns.last_rewards)


MISCONCEPTIONS = (
    *order_slips(solve, lambda given: not given.in_place and not given.action_values and given.tie is None),
    paid_twice, MEAN_FOR_MAX,
    replace(FORGOT_GAMMA, when=lambda given: given.gamma != 1 and given.tie is None), OPTIMAL_Q_BY_REWARD
)  # fmt: skip


def oracle(given: Given) -> Answers:
    """The same sweeps as array operations; the greedy action by trying all."""
    states = (*given.mdp.states, *given.mdp.terminal)
    P, R = tensors(given.mdp, states)
    V = np.array([at((given.start or {}).get(state, 0)) for state in states])
    n = len(given.mdp.states)
    V[n:] = 0
    for _ in range(given.sweeps):
        worth = lookahead(P, R, V, at(given.gamma))[:n]
        for line in range(n):
            source = lookahead(P, R, V, at(given.gamma)) if given.in_place else worth
            V[line] = source[line].max()
    if given.action_values:
        names = tuple(dict.fromkeys(action for _, action in given.mdp.outcomes))
        values = [worth[states.index(state), names.index(action)] for state, action in given.mdp.pairs]
        return (values, best_actions(given.mdp, worth))
    if given.tie:
        line, gains = states.index(given.tie), [lookahead(P, R, V, gamma) for gamma in (0.0, 1.0)]
        first, last = ((gain[line] * [1, -1]).sum() for gain in gains)
        return (V[:n], first / (first - last), "A" if first > 0 else "B")
    return (V[:n], best_actions(given.mdp, lookahead(P, R, V, at(given.gamma))[:n]))
