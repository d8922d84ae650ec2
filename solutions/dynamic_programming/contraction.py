"""The distance at the start, what is left of it after k sweeps, and the first k at which little enough is left."""

from typing import Any

import sympy

from rldrill.problems.dynamic_programming.contraction import Given
from rldrill.problems.exact import needed
from rldrill.solutions import knowns
from rldrill.solutions.answers.kinds import text_of
from rldrill.solutions.exact import ONE, NoSolution, Value, exact, near, sign, to_sympy
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.dynamic_programming import (
    CHANGE_FOR_ERROR,
    CONTRACTION,
    ERROR_FROM_CHANGE,
    FACTOR_OF_THE_CHANGE,
    FORGOT_DISTANCE,
    MAX_NORM,
    MAX_NORM_OF_SWEEP,
    ONE_POWER_SHORT,
    SUM_FOR_MAX,
)
from rldrill.solutions.work import Work

MOST_SWEEPS = 4096
#: Up to so many sweeps the bound is written out as a fraction.
WRITTEN_OUT = 8


def solve(given: Given, work: Work) -> None:
    """The norm, then the bounds; the smallest k by exact comparisons."""
    known = _bounds(given, work)
    if given.accuracy is None:
        return
    accuracy = exact(given.accuracy)
    enough = _sweeps(work, known, accuracy)
    distance, gamma = known["distance"][0], known["gamma"]
    if enough > WRITTEN_OUT:
        least = float(sympy.log(to_sympy(distance / accuracy)) / sympy.log(to_sympy(ONE / gamma)))
        work.say(
            f"Logarithms lead to $k$ quickly: $γ^k·{text_of(distance)} ≤ {text_of(accuracy)}$ for $k ≥ "
            f"ln({text_of(distance / accuracy)})/ln({text_of(ONE / gamma)}) ≈ {least:.2f}$."
        )
    _explain(work, known, accuracy, enough)
    work.say(f"So the smallest number of sweeps is $k = {enough}$.")
    work.answer(enough)


def _bounds(given: Given, work: Work) -> dict[str, Any]:
    """The parts before the last; what the bound of any number of sweeps is made of."""
    gamma = exact(given.gamma)
    values = {"V0": knowns.values(given.start), "V" if given.first is None else "V1": knowns.values(given.other)}
    norm = MAX_NORM if given.first is None else MAX_NORM_OF_SWEEP
    distance = work.answer(work.step(norm, states=tuple(given.start), **values))
    if given.first is not None:
        work.say(
            "By the triangle inequality $‖V_0 − V^*‖_∞ ≤ ‖V_0 − V_1‖_∞ + ‖V_1 − V^*‖_∞$, and since a sweep contracts, "
            "$‖V_1 − V^*‖_∞ ≤ γ‖V_0 − V^*‖_∞$. Both together, solved for $‖V_0 − V^*‖_∞$:"
        )
        distance = work.answer(work.step(ERROR_FROM_CHANGE, change={0: distance}, gamma=gamma))
    known = {"distance": {0: distance}, "gamma": gamma}
    work.answer(work.step(CONTRACTION, k=given.sweeps, **known))
    return known


def _explain(work: Work, known: dict[str, Any], accuracy: Value, enough: int) -> None:
    """Show that the bound is met after that many sweeps, and not one sweep earlier."""
    limit = f"${text_of(accuracy)}$"
    work.say("The bound falls from sweep to sweep, so the first $k$ at which it is small enough is the smallest.")
    for k, relation in ((enough - 1, "above"), (enough, "at most")):
        if k < 0:
            continue
        if enough <= WRITTEN_OUT:
            bound = work.step(CONTRACTION, k=k, **known)
            work.say(f"That is {_rounded(bound)}{relation} {limit}.")
        else:  # the fraction has more digits than anybody reads
            value = work.value(CONTRACTION, k=k, **known)
            power = f"{_power(known['gamma'], k)}·{text_of(known['distance'][0])}"
            work.say(f"After {k} sweeps the bound is ${power} {near(value, 4)}$, {relation} {limit}.")


def _rounded(bound: Value) -> str:
    """A fraction as a decimal, to be compared; nothing for a whole number."""
    relation, written = near(bound, 4).split()
    return f"{'about ' if relation == '≈' else ''}${written}$, " if "/" in text_of(bound) else ""


def _power(gamma: Value, k: int) -> str:
    return f"({text_of(gamma)})^{{{k}}}"


def _sweeps(work: Work, known: dict[str, Any], accuracy: Value) -> int:
    """The smallest k whose bound is at most the accuracy, found by halving.

    Raises:
        NoSolution: it is out of reach.
    """
    low, high = 0, MOST_SWEEPS
    if sign(accuracy - work.value(CONTRACTION, k=high, **known)) < 0:
        raise NoSolution(f"the accuracy takes more than {MOST_SWEEPS} sweeps")
    while low < high:
        middle = (low + high) // 2
        if sign(accuracy - work.value(CONTRACTION, k=middle, **known)) >= 0:
            high = middle
        else:
            low = middle + 1
    return low


@slip(
    "one-sweep-too-few",
    "After that many sweeps the bound is still above the accuracy; round up to the next whole number of sweeps.",
    when=lambda given: given.accuracy is not None,
)
def stops_short(given: Given, work: Work) -> None:
    """Rounded down."""
    known = _bounds(given, work)
    if given.accuracy is not None:
        work.answer(max(_sweeps(work, known, exact(given.accuracy)) - 1, 0))


def _met_exactly(given: Given, known: dict[str, Any]) -> bool:
    """Whether after a few sweeps the bound is the accuracy itself."""
    accuracy, bound = exact(needed(given.accuracy)), known["distance"][0]
    return any(bound * known["gamma"] ** k == accuracy for k in range(WRITTEN_OUT + 1))


@slip(
    "strictly-below",
    "A bound that is just as large as the accuracy is enough: the error is to be at most that, not below it.",
    when=lambda given: given.accuracy is not None and _met_exactly(given, _bounds(given, Work())),
)
def strictly_below(given: Given, work: Work) -> None:
    """The bound is to be below the accuracy."""
    known = _bounds(given, work)
    if given.accuracy is not None:
        work.answer(_sweeps(work, known, exact(given.accuracy)) + _met_exactly(given, known))


MISCONCEPTIONS = (
    FORGOT_DISTANCE,
    ONE_POWER_SHORT,
    FACTOR_OF_THE_CHANGE,
    SUM_FOR_MAX,
    CHANGE_FOR_ERROR,
    stops_short,
    strictly_below.where_it_shows(),
)


def oracle(given: Given) -> Answers:
    """The worst case played out: an error that shrinks by no more than it must, sweep by sweep."""
    worst = max(abs(at(given.other[state]) - at(value)) for state, value in given.start.items())
    answers = [worst]
    if given.first is not None:
        # What the sweeps after the first can still change, added up until nothing is left.
        change = worst
        while change > 1e-14 * answers[0]:
            change *= at(given.gamma)
            worst += change
        answers.append(worst)
    after, k = worst, 0
    for _ in range(given.sweeps):
        after *= at(given.gamma)
    answers.append(after)
    if given.accuracy is not None:
        while worst > at(given.accuracy) * (1 + 1e-11):
            worst, k = worst * at(given.gamma), k + 1
        answers.append(k)
    return answers
