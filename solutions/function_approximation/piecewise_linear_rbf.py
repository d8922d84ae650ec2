"""The distance from every centre, then its triangular bump; or backwards, from known features."""

from rldrill.problems.function_approximation.piecewise_linear_rbf import Given
from rldrill.solutions import knowns
from rldrill.solutions.centres import distances, found, measured, nearest, value_of_state
from rldrill.solutions.exact import Value, exact
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.function_approximation import (
    DISTANCE_FROM_TENT,
    NOT_CLAMPED,
    PIECEWISE_LINEAR_RBF,
    WIDTH_FORGOTTEN,
    WIDTH_FROM_TENT,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (NOT_CLAMPED.where_it_shows(), WIDTH_FORGOTTEN)


def solve(given: Given, work: Work) -> None:
    """What is missing first, then centre by centre, then the weighted sum."""
    known = knowns.values(given.known)
    features = {"phi": {(number, "s"): value for number, value in known.items()}}
    others = tuple(number for number in range(1, len(given.centres) + 1) if number not in known)
    state: tuple[Value, ...] = ()
    b = None if given.width is None else exact(given.width)
    if given.position is None:
        _inside(work, "the distance")
        far = {number: work.step(DISTANCE_FROM_TENT, s="s", i=number, width=b, **features) for number in known}
        state = (work.answer(found(given, work, far)),)
    if b is None:
        (number,) = known
        near = distances(given, work, of=known)
        _inside(work, "$b$")
        b = work.answer(work.step(WIDTH_FROM_TENT, i=number, **features, **near))
    measures = distances(given, work, state, of=others)
    values = tuple(work.step(PIECEWISE_LINEAR_RBF, i=number, width=b, **measures) for number in others)
    if values:
        values = work.answer(values)
    if given.theta:
        value_of_state(work, given.theta, values)


def _inside(work: Work, sought: str) -> None:
    """What a feature that is not 0 tells."""
    work.recall(PIECEWISE_LINEAR_RBF)
    work.say(f"A feature above $0$ is $1 − ‖s − c_i‖/b$. Solved for {sought}:")


def oracle(given: Given) -> Answers:
    """The bump as a line between its peak and its foot."""
    known = {number: at(value) for number, value in given.known.items()}
    answers: list[object] = []
    state: list[float] = []
    if given.width is None:
        ((number, value),) = known.items()
        width = measured(given)[number - 1] / (1 - value)
        answers.append(width)
    else:
        width = at(given.width)
    if given.position is None:
        state = [nearest(given, {number: width * (1 - value) for number, value in known.items()})]
    far = measured(given, state)
    answers += state
    features = np.interp(far, [0.0, width], [1.0, 0.0])
    if others := [*np.delete(features, [number - 1 for number in known])]:
        answers.append(others)
    return (*answers, *([features @ [at(weight) for weight in given.theta]] if given.theta else []))
