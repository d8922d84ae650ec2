"""The features stacked block by block, their weighted sums, and the action with the greatest."""

from collections.abc import Sequence

import numpy as np

from rldrill.problems.function_approximation.linear_value import Given
from rldrill.solutions.centres import distances, measured
from rldrill.solutions.exact import ZERO, Value, exact
from rldrill.solutions.formula.formula import fork
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.function_approximation import GREEDY_LINEAR, LINEAR_VALUE, PIECEWISE_LINEAR_RBF
from rldrill.solutions.work import Work

WRONG_BLOCK = fork(
    "block-of-the-wrong-action",
    "Every action has its own block of weights, in the order in which the actions are named; another one was used.",
)
INTERLEAVED = fork(
    "weights-interleaved",
    "The first block holds all weights of the first action; the weights were read feature by feature instead.",
    when=lambda given: given.size > 1,
)
MISCONCEPTIONS = (WRONG_BLOCK, INTERLEAVED)


def solve(given: Given, work: Work) -> None:
    """Features, stacked vector, values, greedy action."""
    features = tuple(map(exact, given.features or ()))
    if given.bumps is not None:
        known = distances(given.bumps, work) | {"width": exact(given.bumps.width)}
        numbers = known["distance"]
        features = work.answer(tuple(work.step(PIECEWISE_LINEAR_RBF, i=number, **known) for number in numbers))
    work.say("The features stand in the action's own block, and the other blocks are 0.")
    work.answer(_stacked(given, features, given.action, work))
    stacked = {
        (number, "s", action): value
        for action in given.actions
        for number, value in enumerate(_stacked(given, features, action, work), 1)
    }
    theta = dict(enumerate(map(exact, given.theta), 1))
    values = {
        ("s", a): work.step(LINEAR_VALUE, s="s", a=a, theta=theta, phi=stacked, features=tuple(theta))
        for a in given.actions
    }
    values = work.answer(values)
    work.answer({"s": work.step(GREEDY_LINEAR, s="s", Qhat=values, choices=given.actions)})


def _stacked(given: Given, features: Sequence[Value], action: str, work: Work) -> tuple[Value, ...]:
    """The features at the places of the action's weights, 0 elsewhere."""
    size, count = given.size, len(given.actions)
    block = given.actions.index(action)
    if work.makes(WRONG_BLOCK):
        block = (block + 1) % count
    step = count if work.makes(INTERLEAVED) else 1
    first = block if work.makes(INTERLEAVED) else block * size
    places = {first + step * number: value for number, value in enumerate(features)}
    return tuple(places.get(place, ZERO) for place in range(size * count))


def oracle(given: Given) -> Answers:
    """Kronecker products with unit vectors, and a matrix of weights with one row for each action."""
    answers: list[object] = []
    if given.bumps is None:
        features = np.array([at(value) for value in given.features or ()])
    else:
        features = np.interp(measured(given.bumps), [0.0, at(given.bumps.width)], [1.0, 0.0])
        answers.append(features)
    unit = np.eye(len(given.actions))[given.actions.index(given.action)]
    values = np.array([at(weight) for weight in given.theta]).reshape(len(given.actions), -1) @ features
    best = {action for action, value in zip(given.actions, values, strict=True) if value > values.max() - 1e-9}
    answers += [np.kron(unit, features), values, {"s": best}]
    return answers
