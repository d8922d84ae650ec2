"""The projection method, one policy after the other; the weights point from the projected point to the expert."""

from collections.abc import Callable
from typing import Any, TypeAlias

from rldrill.problems.exact import shown
from rldrill.problems.inverse_rl.apprenticeship import Given
from rldrill.solutions.exact import NoSolution, exact, near, sign
from rldrill.solutions.formula.compiling import arg_max
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.inverse_rl import (
    APPRENTICESHIP,
    DISTANCE_SQUARED,
    FROM_THE_NEW_POLICY,
    OTHER_END,
    PROJECTION,
    PROJECTION_LENGTH,
    REMAINING,
    REWARD_OF_FEATURES,
    WEIGHTS,
)
from rldrill.solutions.work import Work

#: Feature expectations, or weights, by the number of the feature.
Point: TypeAlias = dict[int, Any]


def solve(given: Given, work: Work) -> None:
    """For every policy how far to go, the projected point and the weights; the distance that is left."""
    _project(given, work)


def _project(
    given: Given,
    work: Work,
    *,
    weighed_from: Callable[[Point, Point], Point] = lambda projected, _policy: projected,
    begun_at: Callable[[Point, Point], Point] = lambda _first, last: last,
) -> None:
    """The projection method.

    The weights point from ``weighed_from(projected point, policy)`` to the expert; a projection begins at
    ``begun_at(first point, last point)``.
    """
    features = tuple(range(1, len(given.expert) + 1))
    known: dict[str, Any] = {"features": features, "mu_expert": _vector(given.expert)}
    point = first = _vector(given.first)
    weights: Point = {}
    policies = [_vector(mu) for mu in given.policies]
    several = len(policies) + bool(given.candidates and given.projected) > 1
    for number, mu in enumerate(policies, 1):
        known |= {"mu_now": mu, "mu_bar": begun_at(first, point), "label": f"π_{{{number}}}" if several else None}
        length = _length(work, known)
        if number == 1 and not given.candidates:
            length = work.answer(length)
        moved = work.answer(_moved(work, features, known, length))
        point = dict(zip(features, moved, strict=True))
        known["mu_bar"] = weighed_from(point, mu)
        pointing = work.answer(tuple(work.step(WEIGHTS, component=index, **known) for index in features))
        weights = dict(zip(features, pointing, strict=True))
    if given.candidates:
        mu = _next(given.candidates, work, weights)
    if given.candidates and given.projected:
        known |= {"mu_now": mu, "mu_bar": begun_at(first, point), "label": f"π_{{{len(policies) + 1}}}"}
        moved = work.answer(_moved(work, features, known, _length(work, known)))
        point = dict(zip(features, moved, strict=True))
        known["mu_bar"] = weighed_from(point, mu)
        weights = {index: work.step(WEIGHTS, component=index, **known) for index in features}
    work.say("What is left is the distance from the projected point to the expert:")
    left = work.answer(work.step(REMAINING, w=weights, features=features))
    if given.tolerance is not None:
        limit = exact(given.tolerance)
        stops = sign(limit - left) >= 0
        relation = "≤" if stops else ">"
        compared = f"{relation} {shown(given.tolerance)}$: {'yes, it stops' if stops else 'no, it goes on'}."
        work.say(
            f"The method stops when $‖w‖ ≤ {shown(given.tolerance)}$: the policies that it has found, mixed, then come "
            "close enough to its aim:"
        )
        work.recall(APPRENTICESHIP)
        work.say(lambda: f"$‖w‖ {near(left, 3)} {compared}")
        work.answer(stops)


def _length(work: Work, known: dict[str, Any]) -> Any:
    work.say(
        "The projection goes the share $c$ of the way from $μ̄$ to $μ(π)$, to the point from which the way on to "
        "$μ(π_E)$ is orthogonal to it:"
    )
    return work.step(PROJECTION_LENGTH, **known)


def _moved(work: Work, features: tuple[int, ...], known: dict[str, Any], length: Any) -> tuple[Any, ...]:
    return tuple(work.step(PROJECTION, component=index, step_length=length, **known) for index in features)


def _next(candidates: dict[str, Any], work: Work, weights: Point) -> Point:
    """The candidate that is best for the weights, the answer of a part, as its feature expectations."""
    mus = {(index, name): exact(value) for name, mu in candidates.items() for index, value in enumerate(mu, 1)}
    features = tuple(weights)
    worth = {
        name: work.step(REWARD_OF_FEATURES, policy=name, w=weights, features=features, mu_policy=mus)
        for name in candidates
    }
    best, *others = arg_max(tuple(worth), tuple(worth.values()))
    if others:
        raise NoSolution(f"{best} and {others[0]} are equally good for the weights; change one of them")
    work.say(f"Policy {best} has the greatest value for these weights: it comes next.")
    return _vector(candidates[work.answer(best)])


@slip(
    "not-from-the-projected-point",
    "The weights point to the expert from the projected point, not from the new policy's feature expectations.",
)
def not_projected(given: Given, work: Work) -> None:
    """Weights from the policy itself."""
    _project(given, work, weighed_from=lambda _projected, policy: policy)


@slip(
    "from-the-first-point",
    "Every projection starts from the point μ̄ that was found last, not from μ(π₀) again.",
    when=lambda given: len(given.policies) + bool(given.candidates and given.projected) > 1,
)
def from_first(given: Given, work: Work) -> None:
    """Each policy projected with the first point at the other end."""
    _project(given, work, begun_at=lambda first, _last: first)


MISCONCEPTIONS = (
    not_projected,
    from_first.where_it_shows(),
    DISTANCE_SQUARED.where_it_shows(),
    OTHER_END.where_it_shows(),
    FROM_THE_NEW_POLICY.where_it_shows(),
)


def _vector(values: tuple[Any, ...]) -> Point:
    return dict(enumerate(map(exact, values), 1))


def oracle(given: Given) -> Answers:
    """The nearest point of each line by numpy's least squares."""
    expert, point, *policies = (
        np.array([at(value) for value in mu]) for mu in (given.expert, given.first, *given.policies)
    )
    answers: list[Any] = []
    if not given.candidates:
        way = policies[0] - point
        answers.append(way @ (_nearest(point, policies[0], expert) - point) / (way @ way))
    for mu in policies:
        point = _nearest(point, mu, expert)
        answers += [point, expert - point]
    if given.candidates:
        mus = {name: np.array([at(value) for value in mu]) for name, mu in given.candidates.items()}
        best = sorted(mus, key=lambda name: float(mus[name] @ (expert - point)))[-1]
        answers.append(best)
        if given.projected:
            point = _nearest(point, mus[best], expert)
            answers.append(point)
    left = np.linalg.norm(expert - point)
    return [*answers, left] + ([bool(left <= at(given.tolerance) + 1e-12)] if given.tolerance is not None else [])


def _nearest(start: Array, through: Array, to: Array) -> Array:
    share, *_ = np.linalg.lstsq((through - start)[:, None], to - start, rcond=None)
    return start + share[0] * (through - start)
