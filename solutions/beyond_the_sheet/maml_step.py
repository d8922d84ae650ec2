"""The adapted parameter of every task, then the outer step through all of them."""

from typing import Any

import sympy
from sympy import Expr

from rldrill.problems.beyond_the_sheet.maml_step import Given
from rldrill.problems.document import Equation
from rldrill.problems.exact import needed, shown
from rldrill.solutions.exact import ONE, ZERO, exact, parameters
from rldrill.solutions.formula.nodes.leaves import leaf
from rldrill.solutions.formula.typesetting import typeset
from rldrill.solutions.multiplied_out import side_by_side
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.rational import generator
from rldrill.solutions.sheet.beyond_the_sheet import (
    FIRST_ORDER,
    FROM_ADAPTED,
    HALF_KEPT,
    MAML_DERIVATIVE,
    MAML_FIRST_ORDER,
    MAML_GRADIENT,
    MAML_INNER,
    MAML_OUTER,
    NOT_ADAPTED,
)
from rldrill.solutions.work import Step, Work

MISCONCEPTIONS = (FIRST_ORDER, NOT_ADAPTED, FROM_ADAPTED.where_it_shows(), HALF_KEPT.where_it_shows())


def solve(given: Given, work: Work) -> None:
    """The outer gradient goes on from the adapted parameters as they were answered."""
    tasks = range(1, len(given.tasks) + 1)
    known: dict[str, Any] = {
        "theta0": generator("theta") if given.theta is None else exact(given.theta),
        "alpha": exact(given.alpha),
        "beta": generator("beta") if given.beta is None else exact(given.beta),
        "curvature": {index: exact(task.curvature) for index, task in enumerate(given.tasks, 1)},
        "optimum": {index: exact(task.optimum) for index, task in enumerate(given.tasks, 1)},
        "tasks": tuple(tasks),
    }
    work.recall(MAML_INNER)
    if given.theta is None:
        _staying(work, known)
        return
    found = tuple(work.step(MAML_INNER, i=index, **known) for index in tasks)
    adapted = work.answer(found if len(found) > 1 else found[0])
    known["adapted"] = dict(zip(tasks, adapted if len(found) > 1 else (adapted,), strict=True))
    for index in tasks:
        work.step(MAML_DERIVATIVE, i=index, **known)
    work.recall(MAML_GRADIENT)
    work.say("With these factors one step of gradient descent, $θ ← θ − β dJ/dθ$, is")
    after = work.step(MAML_OUTER, **known)
    several = parameters(known["alpha"]) and len(tasks) > 1
    if several and work.lines and isinstance(last := work.lines[-1], Step):
        work.lines[-1] = _MultipliedOut(*last)
    if given.after is not None:
        work.say(f"After the step $θ$ is ${shown(given.after)}$:")
        after = work.equate("beta", after, exact(given.after), positive=True)
    work.answer(after)
    if given.first_order:
        work.answer(work.step(MAML_FIRST_ORDER, **known))


class _MultipliedOut(Step):
    """An outer step with α left open: the factors of every task, then what they make, before it is collected."""

    def _written(self) -> Equation:
        plain = super()._written()
        factors, products = [], []
        for task in self.known["tasks"]:
            curvature, adapted = (self.known[name][task] for name in ("curvature", "adapted"))
            terms = ONE - self.known["alpha"] * curvature, curvature, adapted - self.known["optimum"][task]
            factors.append(sympy.Mul(*(leaf(term) for term in terms if term != 1), evaluate=False))
            products.append(terms[0] * terms[1] * terms[2])
        lines = map(self._down, (sympy.Add(*factors, evaluate=False), side_by_side(products)))
        rights = (plain.rights[0], *map(typeset, lines), *plain.rights[1:])
        return Equation(plain.left, rights, ("←", *["="] * (len(rights) - 1)))

    def _down(self, gradient: Expr) -> Expr:
        """The parameter, moved down a gradient."""
        beta, start = (self.known[name] for name in ("beta", "theta0"))
        down = sympy.Mul(-1, *([] if beta == 1 else [leaf(beta)]), gradient, evaluate=False)
        return down if start == 0 else sympy.Add(leaf(start), down, evaluate=False)


def _staying(work: Work, known: dict[str, Any]) -> None:
    """Where the gradient of the outer loss, a straight line in θ, is zero."""
    tasks = known["tasks"]
    slopes = work.answer(tuple(work.step(MAML_DERIVATIVE, i=index, **known) for index in tasks))
    known["adaptedSlope"] = dict(zip(tasks, slopes, strict=True))
    known["adapted"] = {index: work.step(MAML_INNER, i=index, **known) for index in tasks}
    gradient = work.step(MAML_GRADIENT, **known)
    work.say("The outer step leaves $θ$ unchanged where this gradient is zero:")
    work.answer(work.equate("theta", gradient, ZERO))


def oracle(given: Given) -> Answers:
    """The outer loss as a function of θ, differentiated by differences; exact, since it is quadratic."""
    alpha = at(given.alpha)
    curves, optima = (np.array([at(entry) for entry in column]) for column in zip(*given.tasks, strict=True))

    def adapted(start: float) -> np.ndarray:
        return start - alpha * curves * (start - optima)

    def loss(start: float) -> float:
        return float(np.sum(curves * (adapted(start) - optima) ** 2 / 2))

    def slope(start: float) -> float:
        return (loss(start + 1) - loss(start - 1)) / 2

    if given.theta is None:
        return (adapted(1) - adapted(0), -slope(0) / (slope(1) - slope(0)))
    theta = at(given.theta)
    if given.beta is None:
        return (adapted(theta), (theta - at(needed(given.after))) / slope(theta))
    beta = at(given.beta)
    first_order = theta - beta * float(np.sum(curves * (adapted(theta) - optima)))
    return (adapted(theta), theta - beta * slope(theta), *([first_order] if given.first_order else []))
