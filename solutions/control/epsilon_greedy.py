"""The probability of every action, then their average of the action values."""

from typing import Any

from sympy import evaluate

from rldrill.problems.control.epsilon_greedy import Given
from rldrill.problems.exact import PARAMETERS, shown
from rldrill.problems.fractions import Fraction
from rldrill.solutions import knowns
from rldrill.solutions.exact import ONE, ZERO, NoSolution, Value, equals, exact, sign, to_sympy, value_at
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.formula.letters import letter
from rldrill.solutions.greedy import epsilon_greedy
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.bellman import V_FROM_Q
from rldrill.solutions.sheet.control import (
    EPSILON_GREEDY,
    NOT_SPLIT,
    SHARE_FORGOTTEN,
    SHARED_AMONG_OTHERS,
    TIED_SHARE_FORGOTTEN,
    TIED_SHARED_AMONG_OTHERS,
)
from rldrill.solutions.slips import right_answers
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """The probabilities; then, where it is asked for, the state's value. Or ε from the one or the other."""
    _answer(given, work, knowns.values(given.values))


def _answer(given: Given, work: Work, values: dict[str, Value]) -> None:
    """The answers, with the probabilities that follow from these values."""
    if given.backwards:
        _back(given, work, values)
    else:
        chances: dict[str, Value] = work.answer(epsilon_greedy(work, given.state, values, exact(given.epsilon)))
        _average(given, work, chances)


def _back(given: Given, work: Work, values: dict[str, Value]) -> None:
    """ε from a probability or from the state's value; where that is asked for, too, the value with this ε."""
    needed = (given.taken.action,) if given.taken else ()
    chances = epsilon_greedy(work, given.state, values, exact(given.epsilon), only=needed)
    if given.taken:
        work.say(f"{given.taken.action} is taken with probability ${shown(given.taken.probability)}$:")
        epsilon = work.answer(_rate(given, work, chances[given.taken.action], given.taken.probability))
        if given.valued:
            _average(given, work, epsilon_greedy(work, given.state, values, epsilon, again=True))
    elif given.state_value is not None:
        worth = _value(given, work, chances)
        work.say(f"This value is ${shown(given.state_value)}$:")
        epsilon = work.answer(_rate(given, work, worth, given.state_value))
        work.answer(_with_rate(given, work, chances, epsilon))


def _with_rate(given: Given, work: Work, chances: dict[str, Value], epsilon: Value) -> dict[str, Value]:
    """The probabilities, which were found in terms of ε, with a number for it."""
    name = given.left_open[0]
    found = {}
    for action, chance in chances.items():
        greedy = value_at(chance, ZERO)
        rises = to_sympy(value_at(chance, ONE) - greedy)
        with evaluate(False):
            share = rises * letter(name, PARAMETERS[name])
            right = to_sympy(greedy) + share if greedy != 0 else share
        found[action] = work.step(EPSILON_GREEDY, right=right, s=given.state, a=action, **{name: epsilon})
    return found


def _rate(given: Given, work: Work, found: Value, wanted: Fraction) -> Value:
    """The ε with which what was found is what is wanted.

    Raises:
        NoSolution: it is no probability.
    """
    epsilon = work.equate(given.left_open[0], found, exact(wanted))
    if work.misconception is None and (sign(epsilon) < 0 or sign(epsilon - 1) > 0):
        raise NoSolution(f"no ε from 0 to 1 leads to {shown(wanted)}, only ε {equals(epsilon)}; change what is given")
    return epsilon


def _average(given: Given, work: Work, chances: dict[str, Value]) -> None:
    if given.valued:
        work.answer(_value(given, work, chances))


def _value(given: Given, work: Work, chances: dict[str, Value]) -> Value:
    known: dict[str, Any] = {
        "pi": {(action, given.state): chance for action, chance in chances.items()},
        "Q": {(given.state, action): value for action, value in knowns.values(given.values).items()},
        "actions": {given.state: tuple(given.values)},
    }
    value: Value = work.step(V_FROM_Q, s=given.state, **known)
    return value


@slip(
    "first-of-the-tied",
    "All actions that are tied for the best are greedy; the probability 1 − ε is shared among them.",
    when=lambda given: len(given.best) > 1,
)
def first_of_tied(given: Given, work: Work) -> None:
    """The probabilities as if the other best actions were worth less."""
    values = knowns.values(given.values)
    _answer(given, work, values | {other: values[other] - 1 for other in given.best[1:]})


@slip(
    "value-of-the-best-action",
    "The policy explores, so its value averages over all actions; the greatest action value alone is too much.",
    when=lambda given: given.valued,
)
def value_of_best(given: Given, work: Work) -> None:
    """The probabilities, or ε; then the greatest action value."""
    first, *others = right_answers(solve, given, work)
    work.answer(first)
    for other in others:
        work.answer(exact(given.values[given.best[0]]) if given.valued else other)


MISCONCEPTIONS = (
    SHARE_FORGOTTEN,
    SHARED_AMONG_OTHERS,
    TIED_SHARE_FORGOTTEN,
    TIED_SHARED_AMONG_OTHERS,
    NOT_SPLIT,
    first_of_tied,
    value_of_best,
)


def oracle(given: Given) -> Answers:
    """The uniform distribution mixed with that of the greedy choice, as vectors."""
    Q = np.array([at(value) for value in given.values.values()])
    greedy = (max(Q) == Q) / np.count_nonzero(max(Q) == Q)
    explored = np.full(len(Q), 1 / len(Q))
    epsilon = at(given.epsilon)
    if given.taken:
        place = list(given.values).index(given.taken.action)
        epsilon = float((at(given.taken.probability) - greedy[place]) / (explored[place] - greedy[place]))
    if given.state_value is not None:
        epsilon = (Q.max() - at(given.state_value)) / (Q.max() - Q.mean())
    chances = epsilon * explored + (1 - epsilon) * greedy
    if given.state_value is not None:
        return (epsilon, chances)
    return (epsilon if given.taken else chances, chances @ Q)[: 1 + given.valued]


def possible(given: Given) -> bool:
    """Whether some ε from 0 to 1 leads to the probability or to the value of the state that is printed."""
    return not given.backwards or bool(-1e-9 <= float(oracle(given)[0]) <= 1 + 1e-9)
