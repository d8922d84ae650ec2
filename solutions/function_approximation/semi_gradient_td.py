"""For every transition: the estimates, the TD error, and the step of the weights along the features."""

from collections.abc import Mapping, Sequence
from typing import Any

from rldrill.problems.function_approximation.semi_gradient_td import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, Value, exact
from rldrill.solutions.formula.formula import Formula, slip
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.function_approximation import (
    FEATURES_OF_NEXT,
    LINEAR_STATE_VALUE,
    LINEAR_VALUE,
    SARSA_ERROR_APPROXIMATE,
    SARSA_FEATURES_OF_NEXT,
    SARSA_THROUGH_THE_TARGET,
    SEMI_GRADIENT_SARSA,
    SEMI_GRADIENT_TD,
    TD_ERROR_APPROXIMATE,
    THROUGH_THE_TARGET,
)
from rldrill.solutions.softmax import by_number
from rldrill.solutions.vector import Vector
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """The errors first, each with the weights that the step before has left; then the last of the weights."""
    known, current, step = _known(given), _first_weights(given), _step(given)
    errors: list[Value] = []
    for time in range(len(given.trajectory.rewards)):
        known["delta"] = dict(enumerate(errors))
        if time:
            current = work.step(step, t=time - 1, theta_vector=current, **known)
        errors.append(_error(given, work, known, current, time))
    _finish(given, work, known, errors)


def _finish(given: Given, work: Work, known: Mapping[str, Any], errors: Sequence[Value]) -> None:
    """The errors, then the weights after the last of the steps that they make."""
    known = {**known, "delta": dict(enumerate(work.answer(tuple(errors))))}
    theta, step, last = _first_weights(given), _step(given), len(errors) - 1
    for time in range(last):  # these steps stand in the working of (a) already
        theta = work.value(step, t=time, theta_vector=theta, **known)
    work.answer(tuple(work.step(step, t=last, theta_vector=theta, **known)))


def _known(given: Given) -> dict[str, Any]:
    known = knowns.trajectory(given.trajectory) | {"alpha": exact(given.alpha), "gamma": exact(given.gamma)}
    return known | (_stacked if given.actions else _plain)(given)


def _first_weights(given: Given) -> Vector:
    return Vector(map(exact, given.theta))


def _step(given: Given) -> Formula:
    return SEMI_GRADIENT_SARSA if given.actions else SEMI_GRADIENT_TD


@slip(
    "stale-weights",
    "Each TD error is found with the weights that the step before has left, not with the first ones.",
    when=lambda given: len(given.trajectory.rewards) > 1,
)
def stale_weights(given: Given, work: Work) -> None:
    """All errors with the weights before the run."""
    known, theta = _known(given), _first_weights(given)
    errors = [_error(given, work, known, theta, time) for time in range(len(given.trajectory.rewards))]
    _finish(given, work, known, errors)


MISCONCEPTIONS = (
    THROUGH_THE_TARGET,
    FEATURES_OF_NEXT,
    SARSA_THROUGH_THE_TARGET,
    SARSA_FEATURES_OF_NEXT,
    stale_weights.where_it_shows(),
)


def _error(given: Given, work: Work, known: Mapping[str, Any], theta: Vector, time: int) -> Value:
    """Both estimates with the weights that are current, then the TD error."""
    run = given.trajectory
    numbered = by_number(tuple(theta))
    label = f"t = {time}" if len(run.rewards) > 1 else None
    if not given.actions:
        values = dict.fromkeys(run.terminal, ZERO)
        for state in run.states[time : time + 2]:
            if state not in values:
                values[state] = work.step(LINEAR_STATE_VALUE, s=state, label=label, **numbered, phi=known["phi"])
        return work.step(TD_ERROR_APPROXIMATE, t=time, Vhat=values, **known)
    pairs = {(state, knowns.NO_ACTION): ZERO for state in run.terminal}
    for moment in (time, time + 1):
        state, action = pair = run.states[moment], known["A"][moment]
        if pair not in pairs:
            pairs[pair] = work.step(LINEAR_VALUE, s=state, a=action, label=label, **numbered, f=known["f"])
    return work.step(SARSA_ERROR_APPROXIMATE, t=time, Qhat=pairs, **known)


def _plain(given: Given) -> dict[str, Any]:
    """The features of every state; a terminal state has none that count."""
    rows = {state: tuple(map(exact, row)) for state, row in given.features.items()}
    rows |= dict.fromkeys(given.trajectory.terminal, (ZERO,) * len(given.theta))
    return {
        "phi": {(number, state): value for state, row in rows.items() for number, value in enumerate(row, 1)},
        "phi_vector": {state: Vector(row) for state, row in rows.items()},
    }


def _stacked(given: Given) -> dict[str, Any]:
    """The features of every state and action, one block for each action."""
    run = given.trajectory
    rows: dict[tuple[str, str], Sequence[Value]] = {
        (state, knowns.NO_ACTION): (ZERO,) * len(given.theta) for state in run.terminal
    }
    for state, row in given.features.items():
        for place, action in enumerate(given.actions):
            blocks = [map(exact, row) if place == other else (ZERO,) * len(row) for other in range(len(given.actions))]
            rows[state, action] = tuple(value for block in blocks for value in block)
    actions = dict(enumerate(run.actions))
    if run.states[-1] in run.terminal:
        actions[len(run.rewards)] = knowns.NO_ACTION
    return {
        "A": actions,
        "f": {(number, *pair): value for pair, row in rows.items() for number, value in enumerate(row, 1)},
        "f_vector": {pair: Vector(row) for pair, row in rows.items()},
    }


def oracle(given: Given) -> Answers:
    """The squared error to a fixed target, differentiated by central differences, step after step."""
    run = given.trajectory
    theta = np.array([at(weight) for weight in given.theta])
    blocks = max(1, len(given.actions))

    def estimate(weights: Array, time: int) -> float:
        state = run.states[time]
        if state in run.terminal:
            return 0.0
        block = given.actions.index(run.actions[time]) if given.actions else 0
        row = np.array([at(value) for value in given.features[state]])
        return float(weights.reshape(blocks, -1)[block] @ row)

    errors = []
    for time, reward in enumerate(run.rewards):
        target = at(reward) + at(given.gamma) * estimate(theta, time + 1)

        def loss(weights: Array, time: int = time, target: float = target) -> float:
            return (target - estimate(weights, time)) ** 2 / 2

        errors.append(target - estimate(theta, time))
        # A quadratic: central differences with a whole step are exact.
        unit = np.eye(len(theta))
        slope = np.array([(loss(theta + direction) - loss(theta - direction)) / 2 for direction in unit])
        theta = theta - at(given.alpha) * slope
    return (errors, theta)
