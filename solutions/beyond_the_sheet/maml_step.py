"""The adapted parameter of every task, then the outer step through all of them."""

import numpy as np

from rldrill.problems.beyond_the_sheet.maml_step import Given
from rldrill.solutions.exact import exact
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.beyond_the_sheet import FIRST_ORDER, MAML_INNER, MAML_OUTER, NOT_ADAPTED
from rldrill.solutions.work import Work

MISCONCEPTIONS = (FIRST_ORDER, NOT_ADAPTED)


def solve(given: Given, work: Work) -> None:
    """The outer gradient goes on from the adapted parameters as they were answered."""
    tasks = range(1, len(given.tasks) + 1)
    known = {
        "theta0": exact(given.theta),
        "alpha": exact(given.alpha),
        "beta": exact(given.beta),
        "curvature": {index: exact(task.curvature) for index, task in enumerate(given.tasks, 1)},
        "optimum": {index: exact(task.optimum) for index, task in enumerate(given.tasks, 1)},
    }
    found = tuple(work.step(MAML_INNER, i=index, **known) for index in tasks)
    adapted = work.answer(found if len(found) > 1 else found[0])
    by_task = dict(zip(tasks, adapted if len(found) > 1 else (adapted,), strict=True))
    work.answer(work.step(MAML_OUTER, tasks=tuple(tasks), adapted=by_task, **known))


def oracle(given: Given) -> Answers:
    """The outer loss as a function of θ, differentiated by a difference; exact, since it is quadratic."""
    alpha, theta = at(given.alpha), at(given.theta)
    curves, optima = (np.array([at(entry) for entry in column]) for column in zip(*given.tasks, strict=True))

    def adapted(start: float) -> np.ndarray:
        return start - alpha * curves * (start - optima)

    def loss(start: float) -> float:
        return float(np.sum(curves * (adapted(start) - optima) ** 2 / 2))

    slope = (loss(theta + 1) - loss(theta - 1)) / 2
    return (adapted(theta), theta - at(given.beta) * slope)
