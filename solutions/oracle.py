"""What the independent solvers are made of: floating point, numpy, none of the formulas.

Every family's ``oracle`` gets its answers by other means than its ``solve``: it iterates, simulates or
tries everything. Open parameters are replaced by ``OPEN``; exact answers are evaluated there too.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias

from rldrill.problems.exact import Logarithm, Parameter, Weight
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Dynamics, Model, ModelAndPolicy, Policy
from rldrill.solutions.numerics import Array, np

#: Answers in floating point, in the order of the parts; tables and vectors in the order of the part's keys, policies by
#: state.
Answers: TypeAlias = Sequence[Any]

#: The number at which expressions in an open parameter are compared.
OPEN = Fraction(7, 19)

#: Where a polynomial is looked at, whether it is a straight line; of how high a degree it may be; and how far off
#: a root may be, which counts twice.
_TRIALS, _HIGHEST, _NEAR = (0.25, 0.5, 0.75), 24, 1e-5


def at(number: Weight | int, left_open: float = float(OPEN)) -> float:
    """A given number as a float; an open parameter takes the value ``OPEN``, or another."""
    if isinstance(number, Logarithm):
        return math.log(at(number.of, left_open))
    if isinstance(number, Parameter):
        return 1 - left_open if number.complement else left_open
    return float(number)


def root(gap: Callable[[float], float]) -> float:
    """Where a linear function is 0."""
    first, last = gap(0.0), gap(1.0)
    return first / (first - last)


def root_between(gap: Callable[[float], float]) -> float:
    """Where a polynomial is 0, between 0 and 1 if it is so there; it is looked at in between only."""
    low, middle, high = map(gap, _TRIALS)
    if math.isclose(low + high, 2 * middle, rel_tol=1e-9, abs_tol=1e-9):
        return _TRIALS[0] - (_TRIALS[2] - _TRIALS[0]) * low / (high - low)
    from numpy.polynomial import Chebyshev

    line = Chebyshev.interpolate(np.vectorize(gap), _HIGHEST, domain=[0, 1]).trim(1e-10)
    roots = np.asarray(line.roots(), dtype=complex)
    real = roots.real[np.abs(roots.imag) < _NEAR]
    between = real[np.abs(real - 0.5) < 0.5 + _NEAR]
    return float(np.mean(between if between.size else real))


def tensors(model: Model, left_open: float = float(OPEN)) -> tuple[Array, Array]:
    """The model as arrays P and R of shape (states, actions, states).

    Actions that a state does not have are rows of zeros in P and −∞ in R.
    """
    states, names = model.every_state, model.every_action
    P = np.zeros((len(states), len(names), len(states)))
    R = np.full(P.shape, -np.inf)
    for state, action in model.outcomes:
        R[states.index(state), names.index(action)] = 0.0
    for row in model.transitions:
        cell = states.index(row.state), names.index(row.action), states.index(row.next)
        P[cell] = at(row.probability, left_open)
        R[cell] = at(row.reward, left_open)
    return P, R


def lookahead(P: Array, R: Array, V: Array, gamma: float) -> Array:
    """The worth of every action in every state, shape (states, actions); −∞ where there is no such action."""
    worth: Array = np.einsum("ijk,ijk->ij", P, np.where(np.isinf(R), 0.0, R) + gamma * V)
    worth[np.isinf(R).all(axis=2)] = -np.inf
    return worth


def chances(policy: Policy, model: Model) -> Array:
    """The policy as an array of shape (states, actions)."""
    states, names = model.every_state, model.every_action
    result = np.zeros((len(states), len(names)))
    for state, actions in policy.items():
        for action, chance in actions.items():
            result[states.index(state), names.index(action)] = at(chance)
    return result


def policy_values(P: Array, R: Array, pi: Array, gamma: float) -> Array:
    """The values of a policy, by sweeps until nothing changes."""
    V = np.zeros(len(P))
    for _ in range(100_000):
        worth = lookahead(P, R, V, gamma)
        after = np.where(pi > 0, pi * np.where(np.isinf(worth), 0.0, worth), 0.0).sum(axis=1)
        if np.abs(after - V).max() < 1e-13:
            break
        V = after
    return V


def swept(given: ModelAndPolicy) -> tuple[Array, Array]:
    """The values of all states under the given policy, and the worth of all actions then."""
    P, R = tensors(given.mdp)
    V = policy_values(P, R, chances(given.chances, given.mdp), at(given.gamma))
    return V, lookahead(P, R, V, at(given.gamma))


def optimal_values(P: Array, R: Array, gamma: float, states: int) -> Array:
    """The optimal values by sweeps until nothing changes; only the first states act, the others are terminal.

    Without discount sweeps from 0 need not come to them. There they are the values of the policy that is best for a
    discount close to 1 (Blackwell 1962): for it, too, a loop that pays nothing is worth 0.
    """
    V = np.zeros(len(P))
    if gamma == 1:
        return policy_values(P, R, _patient(P, R, states), 1.0)
    for _ in range(100_000):
        after = np.concatenate([lookahead(P, R, V, gamma)[:states].max(axis=1), V[states:]])
        change = np.abs(after - V).max()
        V = after
        if change < 1e-13:
            break
    return V


def _patient(P: Array, R: Array, states: int) -> Array:
    """The policy that is best for a discount close to 1, by policy iteration."""
    gamma, rows = 1 - 1e-6, np.arange(states)
    pay = np.einsum("ijk,ijk->ij", P, np.where(np.isinf(R), 0.0, R))
    chosen = lookahead(P, R, np.zeros(len(P)), gamma)[:states].argmax(axis=1)
    while True:
        chain = np.eye(states) - gamma * P[rows, chosen][:, :states]
        V = np.concatenate([np.linalg.solve(chain, pay[rows, chosen]), np.zeros(len(P) - states)])
        worth = lookahead(P, R, V, gamma)[:states]
        better = np.where(
            worth.max(axis=1) > worth[rows, chosen] + 1e-9 * (1 + np.abs(V[:states])), worth.argmax(axis=1), chosen
        )
        if (better == chosen).all():
            break
        chosen = better
    policy = np.zeros(P.shape[:2])
    policy[rows, chosen] = 1.0
    return policy


def best_actions(model: Dynamics, worth: Array) -> dict[str, set[str]]:
    """The best actions of every state, from an array of shape (states, actions)."""
    names = model.every_action
    return {
        state: {names[j] for j in np.flatnonzero(np.isclose(row, row.max(), rtol=1e-12))}
        for state, row in zip(model.states, worth, strict=True)
    }


def without_loss(model: Model, best: Mapping[str, set[str]]) -> dict[str, set[str]]:
    """Of best actions, undiscounted, those that may be taken each time: all optimal values stay as they are."""
    states, count = model.every_state, len(model.states)
    P, R = tensors(model)
    names = model.every_action
    V = optimal_values(P, R, 1.0, count)

    def kept(state: str, action: str) -> bool:
        others = R.copy()
        others[states.index(state), [index for index, name in enumerate(names) if name != action]] = -np.inf
        return np.allclose(optimal_values(P, others, 1.0, count), V, atol=1e-6)

    return {state: {action for action in row if kept(state, action)} for state, row in best.items()}
