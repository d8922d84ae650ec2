"""The distance from every centre, then its bump; or backwards, from known features. Exponentials stay as they are."""

from collections.abc import Mapping
from typing import Any

from rldrill.problems.function_approximation.rbf import Given
from rldrill.solutions import knowns
from rldrill.solutions.centres import distances, found, measured, nearest, value_of_state
from rldrill.solutions.exact import Value, exact, simplest, to_sympy
from rldrill.solutions.formula.formula import Formula, slip
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.function_approximation import (
    DISTANCE_FROM_RBF,
    HALF_FORGOTTEN,
    NORM_NOT_SQUARED,
    RBF,
    SIGMA_NOT_SQUARED,
    WIDTH_FROM_RBF,
    logarithm_of_rbf,
)
from rldrill.solutions.slips import right_answers
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """What is missing first, then centre by centre, then the weighted sum."""
    logarithms = knowns.values(given.logarithms)
    known: dict[str, Any] = {"s": "s", "log_phi": {(number, "s"): value for number, value in logarithms.items()}}
    if given.sigma is not None:
        known["sigma"] = exact(given.sigma)
    others = tuple(number for number in range(1, len(given.centres) + 1) if number not in logarithms)
    state: tuple[Value, ...] = ()
    if given.position is None:
        far = _solved(work, DISTANCE_FROM_RBF, "the distance", logarithms, known)
        state = (work.answer(found(given, work, far)),)
    if given.sigma is None:
        known |= distances(given, work, of=logarithms)
        (sigma,) = _solved(work, WIDTH_FROM_RBF, "$σ$", logarithms, known).values()
        known["sigma"] = work.answer(sigma)
    known |= distances(given, work, state, of=others)
    values = tuple(work.step(RBF, i=number, **known) for number in others)
    if values:
        values = work.answer(values)
    if given.theta:
        value_of_state(work, given.theta, values)


def _solved(
    work: Work, formula: Formula, sought: str, logarithms: Mapping[int, Value], known: dict[str, Any]
) -> dict[int, Value]:
    """What the equation of every feature that is known gives for the one thing in it that is not."""
    work.recall(RBF)
    work.say("The logarithm of both sides:")
    work.recall(logarithm_of_rbf())
    work.say(f"Solved for {sought}:")
    return {number: work.step(formula, i=number, **known) for number in logarithms}


@slip(
    "divided-by-their-sum",
    "Radial basis functions are no probabilities: each is what it is, and is not divided by the sum of all.",
    when=lambda given: not given.logarithms and len(given.centres) > 1,
)
def divided_by_their_sum(given: Given, work: Work) -> None:
    """Features that sum to 1."""
    features = tuple(map(to_sympy, right_answers(solve, given, work)[0]))
    values = work.answer(tuple(simplest(feature / sum(features)) for feature in features))
    if given.theta:
        value_of_state(work, given.theta, values)


MISCONCEPTIONS = (HALF_FORGOTTEN, SIGMA_NOT_SQUARED, NORM_NOT_SQUARED, divided_by_their_sum.where_it_shows())


def oracle(given: Given) -> Answers:
    """A normal density, relative to its height at the centre."""
    answers: list[object] = []
    known = {number: at(value) for number, value in given.logarithms.items()}
    state: list[float] = []
    if given.sigma is None:
        ((number, value),) = known.items()
        sigma = float(measured(given)[number - 1] / np.sqrt(-2 * value))
        answers.append(sigma)
    else:
        sigma = at(given.sigma)
    if given.position is None:
        state = [nearest(given, {number: sigma * np.sqrt(2 * -value) for number, value in known.items()})]
    far = measured(given, state)
    answers += state

    def density(x: float) -> float:
        return float(np.exp(-((x / sigma) ** 2) / 2) / (sigma * np.sqrt(2 * np.pi)))

    height = density(0.0)
    features = np.array([density(distance) / height for distance in far])
    if others := [*np.delete(features, [number - 1 for number in known])]:
        answers.append(others)
    return (*answers, *([features @ [at(weight) for weight in given.theta]] if given.theta else []))
