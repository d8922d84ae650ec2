"""The diagram's equation, applied from the leaves up to the root."""

from collections.abc import Callable
from typing import Any

import numpy as np

from rldrill.problems.backup_diagrams.backup_diagram_value import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import ONE, Value, exact
from rldrill.solutions.formula.formula import fork
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.bellman import (
    BELLMAN_OPTIMALITY_Q,
    BELLMAN_OPTIMALITY_V,
    BELLMAN_Q,
    BELLMAN_V,
    V_FROM_Q,
)
from rldrill.solutions.work import Work


def _has_policy(given: Given) -> bool:
    return given.policy is not None


def _has_arcs(given: Given) -> bool:
    return given.policy is None


def _discounts(given: Given) -> bool:
    return given.gamma != 1


def _is_deep(given: Given) -> bool:
    return _discounts(given) and bool(given.inner)


MAX_FOR_MEAN = fork(
    "max-for-mean",
    "There is no arc, so the actions are averaged with the probabilities beside them; only an arc takes the maximum.",
    when=_has_policy,
)
MEAN_FOR_MAX = fork(
    "mean-for-max",
    "The arc says that only the best action counts, not the mean of all.",
    when=_has_arcs,
)
FORGOT_POLICY = fork(
    "forgot-policy",
    "Each action counts with the probability that stands beside its branch.",
    when=_has_policy,
)
FORGOT_GAMMA = fork(
    "forgot-gamma",
    "The value of a next state is discounted by γ.",
    when=_discounts,
)
GAMMA_ON_REWARD = fork(
    "gamma-on-reward",
    "The reward beside a branch is earned on the way down it: only the value below it is discounted.",
    when=_discounts,
)
ONE_LEVEL_ONLY = fork(
    "discounted-at-one-level-only",
    "Every level of states discounts once more: what lies two levels down is discounted by γ twice.",
    when=_is_deep,
)
MISCONCEPTIONS = (MAX_FOR_MEAN, MEAN_FOR_MAX, FORGOT_POLICY, FORGOT_GAMMA, GAMMA_ON_REWARD, ONE_LEVEL_ONLY)


def solve(given: Given, work: Work) -> None:
    """Averages where there is no arc, the best action where there is one."""
    known = knowns.model(given.dynamics) | {"gamma": exact(given.gamma), "pi": _chances(given, work)}
    if work.makes(FORGOT_GAMMA):
        known["gamma"] = ONE
    if work.makes(GAMMA_ON_REWARD):
        known["R"] = {key: known["gamma"] * reward for key, reward in known["R"].items()}
    best = given.policy is None
    if work.makes(MAX_FOR_MEAN) or work.makes(MEAN_FOR_MAX):
        best = not best
    root, _ = given.root
    if given.action_values:
        work.answer(_action_value(given, work, known, best=best))
        return
    formula = BELLMAN_OPTIMALITY_V if best else BELLMAN_V
    values = knowns.values(given.values)
    for state in given.inner:
        values = values | {state: work.step(formula, s=state, V=values, **known)}
    if work.makes(ONE_LEVEL_ONLY):
        known["gamma"] = ONE
    work.answer(work.step(formula, s=root, V=values, **known))


def _action_value(given: Given, work: Work, known: dict[str, Any], *, best: bool) -> Value:
    root, action = given.root
    known = known | {
        "Q": {(state, a): exact(value) for state, row in given.action_values.items() for a, value in row.items()},
        "actions": {state: tuple(row) for state, row in given.action_values.items()},
    }
    if best:
        return work.step(BELLMAN_OPTIMALITY_Q, s=root, a=action, **known)
    values = {state: work.step(V_FROM_Q, s=state, **known) for state in given.action_values}
    return work.step(BELLMAN_Q, s=root, a=action, V=values, **known)


def _chances(given: Given, work: Work) -> dict[tuple[str, str], Value]:
    """The policy; without one, every action alike, which is how an arc is misread."""
    choices = {state: tuple(row) for state, row in given.action_values.items()} or given.dynamics.actions
    if work.makes(FORGOT_POLICY):
        return {(action, state): ONE for state, actions in choices.items() for action in actions}
    if given.policy is not None:
        return knowns.policy(given.policy)
    return {(action, state): ONE / len(actions) for state, actions in choices.items() for action in actions}


def oracle(given: Given) -> Answers:
    """Down from the root, one branch after the other."""
    gamma = at(given.gamma)
    over = _over(given)

    def of_state(state: str) -> float:
        if state in given.values:
            return at(given.values[state])
        if state in given.action_values:
            return over(state, {action: at(value) for action, value in given.action_values[state].items()})
        return over(state, {action: of_action(state, action) for action in given.dynamics.actions[state]})

    def of_action(state: str, action: str) -> float:
        rows = given.dynamics.outcomes[state, action]
        worth = np.array([at(row.reward) + gamma * of_state(row.next) for row in rows])
        return float(np.array([at(row.probability) for row in rows]) @ worth)

    root, action = given.root
    return (of_action(root, action) if given.action_values else of_state(root),)


def _over(given: Given) -> Callable[[str, dict[str, float]], float]:
    """How the actions of a state are put together."""
    if given.policy is None:
        return lambda _, worth: max(worth.values())
    policy = given.policy
    return lambda state, worth: sum(at(policy[state].get(action, 0)) * value for action, value in worth.items())
