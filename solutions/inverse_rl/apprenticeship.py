"""The projection method, one policy after the other; the weights point from the projected point to the expert."""

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from rldrill.problems.inverse_rl.apprenticeship import Given
from rldrill.solutions.exact import exact
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.oracle import Answers, Array, at
from rldrill.solutions.sheet.inverse_rl import (
    APPRENTICESHIP,
    DISTANCE,
    PROJECTION,
    PROJECTION_LENGTH,
    REMAINING,
    WEIGHTS,
)
from rldrill.solutions.work import Work

#: Feature expectations, or weights, by the number of the feature.
Point: TypeAlias = dict[int, Any]


def solve(given: Given, work: Work) -> None:
    """A distance; for every policy the projected point and the weights; the distance that is left."""
    _project(given, work, lambda projected, _: projected)


def _project(given: Given, work: Work, weighed_from: Callable[[Point, Point], Point]) -> None:
    """The projection method; the weights point from ``weighed_from(projected point, policy)`` to the expert."""
    features = tuple(range(1, len(given.expert) + 1))
    known: dict[str, Any] = {"features": features, "mu_expert": _vector(given.expert)}
    point, weights = _vector(given.first), {}
    policies = [_vector(mu) for mu in given.policies]
    work.recall(APPRENTICESHIP)
    work.answer(work.step(DISTANCE, mu_now=policies[0], **known))
    for mu in policies:
        known |= {"mu_now": mu, "mu_bar": point}
        length = work.step(PROJECTION_LENGTH, **known)
        moved = work.answer(
            tuple(work.step(PROJECTION, component=index, step_length=length, **known) for index in features),
        )
        point = dict(zip(features, moved, strict=True))
        known["mu_bar"] = weighed_from(point, mu)
        pointing = work.answer(tuple(work.step(WEIGHTS, component=index, **known) for index in features))
        weights = dict(zip(features, pointing, strict=True))
    work.answer(work.step(REMAINING, w=weights, features=features))


@slip(
    "not-from-the-projected-point",
    "The weights point to the expert from the projected point, not from the new policy's feature expectations.",
)
def not_projected(given: Given, work: Work) -> None:
    """Weights from the policy itself."""
    _project(given, work, lambda _, policy: policy)


MISCONCEPTIONS = (not_projected,)


def _vector(values: tuple[Any, ...]) -> Point:
    return dict(enumerate(map(exact, values), 1))


def oracle(given: Given) -> Answers:
    """The nearest point of each line by numpy's least squares."""
    expert, point, *policies = (
        np.array([at(value) for value in mu]) for mu in (given.expert, given.first, *given.policies)
    )
    answers: list[Any] = [np.linalg.norm(policies[0] - expert)]
    for mu in policies:
        point = _nearest(point, mu, expert)
        answers += [point, expert - point]
    return [*answers, np.linalg.norm(expert - point)]


def _nearest(start: Array, through: Array, to: Array) -> Array:
    share, *_ = np.linalg.lstsq((through - start)[:, None], to - start, rcond=None)
    return start + share[0] * (through - start)
