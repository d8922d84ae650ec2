"""The features stacked block by block, their weighted sums, and the action with the greatest."""

from collections.abc import Callable, Sequence

import numpy as np

from rldrill.problems.function_approximation.linear_value import Given
from rldrill.solutions.centres import distances, measured
from rldrill.solutions.exact import ZERO, Value, exact
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.function_approximation import GREEDY_LINEAR, LINEAR_VALUE, PIECEWISE_LINEAR_RBF
from rldrill.solutions.work import Work


def _own_block(given: Given, action: str) -> range:
    """The places of the weights of an action."""
    first = given.actions.index(action) * given.size
    return range(first, first + given.size)


def solve(given: Given, work: Work, places: Callable[[Given, str], range] = _own_block) -> None:
    """Features, stacked vector, values, greedy action."""
    features = tuple(map(exact, given.features or ()))
    if given.bumps is not None:
        known = distances(given.bumps, work) | {"width": exact(given.bumps.width)}
        numbers = known["distance"]
        features = work.answer(tuple(work.step(PIECEWISE_LINEAR_RBF, i=number, **known) for number in numbers))
    work.say("The features stand in the action's own block, and the other blocks are 0.")
    work.answer(_stacked(given, features, places(given, given.action)))
    stacked = {
        (number, "s", action): value
        for action in given.actions
        for number, value in enumerate(_stacked(given, features, places(given, action)), 1)
    }
    theta = dict(enumerate(map(exact, given.theta), 1))
    values = {
        ("s", a): work.step(LINEAR_VALUE, s="s", a=a, theta=theta, phi=stacked, features=tuple(theta))
        for a in given.actions
    }
    values = work.answer(values)
    work.answer({"s": work.step(GREEDY_LINEAR, s="s", Qhat=values, choices=given.actions)})


def _stacked(given: Given, features: Sequence[Value], places: range) -> tuple[Value, ...]:
    """The features at the places of the action's weights, 0 elsewhere."""
    standing = dict(zip(places, features, strict=True))
    return tuple(standing.get(place, ZERO) for place in range(len(given.theta)))


@slip(
    "block-of-the-wrong-action",
    "Every action has its own block of weights, in the order in which the actions are named; another one was used.",
)
def wrong_block(given: Given, work: Work) -> None:
    """Every action with the next one's block, the last with the first one's."""
    *others, last = given.actions
    solve(given.model_copy(update={"actions": (last, *others)}), work)


@slip(
    "weights-interleaved",
    "The first block holds all weights of the first action; the weights were read feature by feature instead.",
    when=lambda given: given.size > 1,
)
def interleaved(given: Given, work: Work) -> None:
    """For the first feature a weight of every action, then for the second, and so on."""
    solve(given, work, lambda given, a: range(given.actions.index(a), len(given.theta), len(given.actions)))


MISCONCEPTIONS = (wrong_block, interleaved)


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
