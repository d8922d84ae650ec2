"""The diagram's equation, applied from the leaves up to the root."""

from collections.abc import Callable
from typing import Any

from rldrill.problems.backup_diagrams.backup_diagram_value import Given
from rldrill.problems.fractions import Fraction
from rldrill.solutions import knowns
from rldrill.solutions.exact import ONE, Value, exact
from rldrill.solutions.formula.formula import Formula, slip
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.reversible import find, tried
from rldrill.solutions.sheet.bellman import (
    ACTIONS_ALIKE,
    BELLMAN_OPTIMALITY_Q,
    BELLMAN_OPTIMALITY_V,
    BELLMAN_Q,
    BELLMAN_V,
    MAXIMA_APART,
    V_FROM_Q,
)
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """Averages where there is no arc, the best action where there is one."""
    known = _known(given)
    _answer(given, work, _root(given, work, known, _inner(given, work, known)))


def _answer(given: Given, work: Work, value: Value) -> None:
    if given.known is None:
        work.answer(value)
    else:
        find(given, work, value, given.asked)


def _known(given: Given) -> dict[str, Any]:
    Q = {(state, a): exact(value) for state, row in given.action_values.items() for a, value in row.items()}
    known = knowns.model(given.dynamics) | {"gamma": exact(given.gamma), "pi": knowns.policy(given.policy or {})}
    return known | {"Q": Q, "actions": _choices(given)}


def _choices(given: Given) -> dict[str, tuple[str, ...]]:
    return {state: tuple(row) for state, row in given.action_values.items()} or given.dynamics.actions


def _inner(given: Given, work: Work, known: dict[str, Any]) -> dict[str, Value]:
    """The values of all states below the root."""
    if given.action_values and given.policy is not None:
        return {state: work.step(V_FROM_Q, s=state, **known) for state in given.action_values}
    values = knowns.values(given.values)
    for state in given.inner:
        values = values | {state: work.step(_backup(given), s=state, V=values, **known)}
    return values


def _backup(given: Given) -> Formula:
    return BELLMAN_OPTIMALITY_V if given.policy is None else BELLMAN_V


def _root(given: Given, work: Work, known: dict[str, Any], values: dict[str, Value]) -> Value:
    state, action = given.root
    if not given.action_values:
        return work.step(_backup(given), s=state, V=values, **known)
    formula = BELLMAN_OPTIMALITY_Q if given.policy is None else BELLMAN_Q
    return work.step(formula, s=state, a=action, V=values, **known)


def _has_policy(given: Given) -> bool:
    return given.policy is not None and "p" not in given.letters


def _compares(given: Given) -> bool:
    """Whether the actions that are averaged could be compared, since nothing is left open."""
    return given.policy is not None and not given.letters


@slip(
    "max-for-mean",
    "There is no arc, so the actions are averaged with the probabilities beside them; only an arc takes the maximum.",
    when=_compares,
)
def maximum(given: Given, work: Work) -> None:
    """As if there were arcs."""
    solve(given.model_copy(update={"policy": None}), work)


@slip(
    "mean-for-max",
    "The arc says that only the best action counts, not the mean of all.",
    when=lambda given: given.policy is None,
)
def mean(given: Given, work: Work) -> None:
    """As if every action were equally probable."""
    policy = {state: dict.fromkeys(row, Fraction(1, len(row))) for state, row in _choices(given).items()}
    solve(given.model_copy(update={"policy": policy}), work)


@slip(
    "forgot-policy",
    "Each action counts with the probability that stands beside its branch.",
    when=_has_policy,
)
def total(given: Given, work: Work) -> None:
    """As if every action had the probability 1."""
    policy = {state: dict.fromkeys(row, Fraction(1)) for state, row in _choices(given).items()}
    solve(given.model_copy(update={"policy": policy}), work)


def _discounts(given: Given) -> bool:
    return given.gamma != 1


@slip("forgot-gamma", "The value of a next state is discounted by γ.", when=_discounts)
def forgot_gamma(given: Given, work: Work) -> None:
    """As if γ were 1."""
    solve(given.model_copy(update={"gamma": Fraction(1)}), work)


@slip(
    "gamma-on-reward",
    "The reward beside a branch is earned on the way down it: only the value below it is discounted.",
    when=_discounts,
)
def gamma_on_reward(given: Given, work: Work) -> None:
    """As if every reward were γ times as much."""
    known = _known(given)
    known["R"] = {key: known["gamma"] * reward for key, reward in known["R"].items()}
    _answer(given, work, _root(given, work, known, _inner(given, work, known)))


@slip(
    "discounted-at-one-level-only",
    "Every level of states discounts once more: what lies two levels down is discounted by γ twice.",
    when=lambda given: _discounts(given) and bool(given.inner),
)
def one_level(given: Given, work: Work) -> None:
    """As if γ were 1 at the root."""
    known = _known(given)
    _answer(given, work, _root(given, work, known | {"gamma": ONE}, _inner(given, work, known)))


MISCONCEPTIONS = (
    maximum,
    mean,
    total,
    ACTIONS_ALIKE.where_it_shows(),
    forgot_gamma,
    gamma_on_reward,
    one_level,
    MAXIMA_APART.where_it_shows(),
)


def oracle(given: Given) -> Answers:
    """Down from the root, one branch after the other."""
    if given.known is not None:
        return (tried(given, lambda trial: float(oracle(trial)[0])),)
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
