"""The incremental mean, visit by visit; or with a constant step size the weighted sum of all returns."""

from math import prod

from rldrill.problems.document import Equation
from rldrill.problems.temporal_difference.sample_average import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import ONE, exact, parameters
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.formula.typesetting import typeset
from rldrill.solutions.multiplied_out import side_by_side
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.reversible import find, tried
from rldrill.solutions.sheet.temporal_difference import (
    CONSTANT_STEP_SIZE,
    COUNTED_TWICE,
    EQUAL_WEIGHTS,
    MEAN_OF_TWO,
    MONTE_CARLO,
    NEW_RETURN_NOT_COUNTED,
    NOT_COUNTED,
    OLD_MEAN_ONCE,
    OLDEST_FIRST,
    ONE_POWER_MORE,
    RECENCY_WEIGHT,
    SAMPLE_AVERAGE,
    START_FORGOTTEN,
    SUM_NOT_DIVIDED,
    VISIT_COUNT,
    of_a_visit,
)
from rldrill.solutions.work import Step, Work


def solve(given: Given, work: Work) -> None:
    """Count, then average in; or the weights first."""
    if given.alpha is None:
        _averaged(given, work)
    else:
        _weighted(given, work)


def _averaged(given: Given, work: Work) -> None:
    values = knowns.values(given.values)
    counts = {state: exact(count) for state, count in given.counts.items()}
    for number, (state, observed) in enumerate(given.visits, start=1):
        known = {"s": state, "label": f"visit {number}" if len(given.visits) > 1 else None}
        counts = counts | {state: work.step(of_a_visit(VISIT_COUNT), count=counts, **known)}
        value = work.step(of_a_visit(SAMPLE_AVERAGE), count=counts, observed=exact(observed), V=values, **known)
        values = values | {state: value}
    if given.known is None:
        work.answer({state: values[state] for state in given.visited})
    else:
        find(given, work, values[given.visited[0]], f'V("{given.visited[0]}")')


def _weighted(given: Given, work: Work) -> None:
    assert given.alpha is not None
    if given.known is not None and len(given.visits) == 1:
        ((state, observed),) = given.visits
        known = {"s": state, "observed": exact(observed), "V": knowns.values(given.values)}
        moved = work.step(of_a_visit(MONTE_CARLO), alpha=exact(given.alpha), **known)
        find(given, work, moved, f'V("{state}")')
        return
    count, alpha = len(given.visits), exact(given.alpha)
    work.say(
        "An update is $V ← (1 − α) V + α R$: a return enters with the weight $α$, and each of the $n − i$ updates "
        "after it leaves $1 − α$ of this:"
    )
    weights = tuple(work.step(RECENCY_WEIGHT, i=i, n=count, alpha=alpha) for i in range(1, count + 1))
    if given.known is None:
        carried = work.answer(weights[0] if count == 1 else weights)
        weights = (carried,) if count == 1 else carried
    w = dict(enumerate(weights, start=1))
    G = {visit: exact(value) for visit, (_, value) in enumerate(given.visits, start=1)}
    start = exact(given.values[given.visited[0]])
    value = work.step(CONSTANT_STEP_SIZE, n=count, alpha=alpha, w=w, G=G, Vn={0: start})
    if parameters(alpha) and count > 2 and work.lines and isinstance(last := work.lines[-1], Step):
        work.lines[-1] = _MultipliedOut(*last)
    if given.known is None:
        work.answer(value)
    else:
        find(given, work, value, f'V("{given.visited[0]}")')


class _MultipliedOut(Step):
    """The weighted sum with α left open: every term multiplied out, before they are collected."""

    def _written(self) -> Equation:
        plain = super()._written()
        kept = prod([ONE - self.known["alpha"]] * self.known["n"], start=ONE)
        returns = (self.known["w"][i] * G for i, G in self.known["G"].items())
        apart = typeset(side_by_side((kept * self.known["Vn"][0], *returns)))
        return Equation(plain.left, (*plain.rights[:-1], apart, plain.rights[-1]), (*plain.signs, "="))


@slip(
    "old-value-as-one-return",
    "The old value is the mean of n(s) returns; it counts as often, not as a single one.",
    when=lambda given: any(given.counts.get(state, 0) > 1 for state in given.visited),
)
def counts_forgotten(given: Given, work: Work) -> None:
    """Every state as if it had been visited once at most."""
    solve(given.model_copy(update={"counts": {state: min(count, 1) for state, count in given.counts.items()}}), work)


@slip(
    "counted-from-this-run",
    "The old value is the mean of n(s) returns already: counting goes on from there, not from 0.",
    when=lambda given: given.alpha is None and any(given.counts.get(state, 0) for state in given.visited),
)
def counted_anew(given: Given, work: Work) -> None:
    """Every state as if it had never been visited."""
    solve(given.model_copy(update={"counts": dict.fromkeys(given.counts, 0)}), work)


MISCONCEPTIONS = (
    NOT_COUNTED,
    COUNTED_TWICE,
    MEAN_OF_TWO.where_it_shows(),
    OLD_MEAN_ONCE.where_it_shows(),
    SUM_NOT_DIVIDED.where_it_shows(),
    NEW_RETURN_NOT_COUNTED.where_it_shows(),
    counts_forgotten.where_it_shows(),
    counted_anew.where_it_shows(),
    OLDEST_FIRST,
    ONE_POWER_MORE,
    EQUAL_WEIGHTS,
    START_FORGOTTEN,
)


def oracle(given: Given) -> Answers:
    """The plain mean of old and new returns; with a constant step size the updates one by one, on unit vectors too."""
    if given.known is not None:
        return (tried(given, _first),)
    if given.alpha is None:
        means = []
        for state in given.visited:
            count = given.counts[state]
            new = [at(value) for visited, value in given.visits if visited == state]
            means.append(np.mean([at(given.values[state])] * count + new))
        return (means,)
    start, returns = at(given.values[given.visited[0]]), np.array([at(value) for _, value in given.visits])
    weights = [_updated(0.0, unit, at(given.alpha)) for unit in np.eye(len(returns))]
    return (weights, _updated(start, returns, at(given.alpha)))


def _updated(value: float, returns: Array, alpha: float) -> float:
    for observed in returns:
        value = (1 - alpha) * value + alpha * observed
    return value


def _first(given: Given) -> float:
    """The value of the first visited state after all visits."""
    last = oracle(given)[-1]
    return float(last if given.alpha is not None else last[0])
