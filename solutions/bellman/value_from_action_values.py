"""The policy's mean of the action values, and their greatest; what is left open follows from the mean."""

from collections import defaultdict
from typing import Any

from msgspec.structs import replace

from rldrill.problems.bellman.value_from_action_values import Given
from rldrill.problems.exact import PARAMETERS, Parameter, Scalar
from rldrill.solutions.exact import ONE, ZERO, Value, equals, exact
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import OPEN, Answers, at, root
from rldrill.solutions.sheet.bellman import (
    ACTIONS_ALIKE,
    MAX_FOR_MEAN,
    MEAN_OF_Q_STAR,
    POLICY_FOR_MAX,
    V_FROM_Q,
    V_STAR_FROM_Q,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (
    MAX_FOR_MEAN,
    replace(ACTIONS_ALIKE, when=lambda given: any(len(set(row.values())) > 1 for row in given.policy.values())),
    MEAN_OF_Q_STAR,
    POLICY_FOR_MAX,
)


def solve(given: Given, work: Work) -> None:
    """Both from the same table; or an equation for what is left open."""
    known = _known(given)
    if given.finds:
        _find(given, work, known)
        return
    work.answer({state: work.step(V_FROM_Q, s=state, **known) for state in given.values})
    if not given.parameters():
        work.answer({state: work.step(V_STAR_FROM_Q, s=state, **known) for state in given.values})


def _known(given: Given, found: Value | None = None) -> dict[str, Any]:
    """What is known; what was left open is put in when it has been found."""

    def number(scalar: Scalar) -> Value:
        if found is None or not isinstance(scalar, Parameter):
            return exact(scalar)
        return ONE - found if scalar.complement else found

    return {
        "Q": {(state, action): number(value) for state, row in given.values.items() for action, value in row.items()},
        "actions": {state: tuple(row) for state, row in given.values.items()},
        "pi": defaultdict(lambda: ZERO, {(a, s): number(p) for s, row in given.policy.items() for a, p in row.items()}),
    }


def _find(given: Given, work: Work, known: dict[str, Any]) -> None:
    (letter,) = given.unknown
    if given.known is None:
        values = [work.step(V_FROM_Q, s=state, **known) for state in given.values]
        work.say("Both are to be equal:")
        work.answer(work.equate(letter, *values))
        return
    ((state, value),) = given.known.items()
    mean = work.step(V_FROM_Q, s=state, **known)
    work.say(f"This must equal the given value of {state}:")
    found = work.answer(work.equate(letter, mean, exact(value)))
    if others := [other for other in given.values if other != state]:
        chances = [chance for other in others for chance in given.policy[other].values()]
        if any(isinstance(chance, Parameter) and chance.complement for chance in chances):
            sign = PARAMETERS[letter]
            work.say(f"With ${sign} {equals(found)}$, $1 − {sign} {equals(ONE - found)}$.")
        work.answer({other: work.step(V_FROM_Q, s=other, **_known(given, found)) for other in others})


def possible(given: Given) -> bool:
    """Whether what is found can be what it is: a probability lies between 0 and 1."""
    return not given.finds or given.unknown != ("p",) or 0 < oracle(given)[0] < 1


def oracle(given: Given) -> Answers:
    """Row by row, a product of vectors; the greatest by sorting; what is open as the root of a linear function."""

    def mean(state: str, left_open: float) -> float:
        row, chances = given.values[state], given.policy[state]
        weights = [at(chances.get(action, 0), left_open) for action in row]
        return float(np.dot([at(value, left_open) for value in row.values()], weights))

    if given.known is not None:
        ((state, value),) = given.known.items()
        found = root(lambda left_open: mean(state, left_open) - at(value))
        others = [mean(other, found) for other in given.values if other != state]
        return (found, others) if others else (found,)
    if given.equal:
        first, second = given.values
        return (root(lambda left_open: mean(first, left_open) - mean(second, left_open)),)
    means = [mean(state, float(OPEN)) for state in given.values]
    if given.parameters():
        return (means,)
    return (means, [sorted(map(at, row.values()))[-1] for row in given.values.values()])
