"""A geometric series for the rewards that repeat, then the first rewards before it."""

from collections.abc import Callable
from functools import partial
from typing import Any

from rldrill.problems.exact import Parameter, Scalar, needed, shown
from rldrill.problems.fractions import Fraction
from rldrill.problems.fundamentals.return_infinite import Given
from rldrill.solutions.exact import Value, equals, exact, told
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.rational import generator
from rldrill.solutions.reversible import find, reading, tried, with_letter
from rldrill.solutions.sheet.fundamentals import (
    FIRST_DISCOUNTED,
    FIRST_OF_ROUND,
    GEOMETRIC_SERIES,
    PLUS_FOR_MINUS,
    RETURN_UNROLLED,
    ROUND_OF_ONE,
    TAIL_FORGOTTEN,
    TAIL_UNDISCOUNTED,
)
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """One round over 1 − γⁿ; the return from the start has the first rewards and the discounted rest."""
    k = len(given.first)
    if given.known is None:
        tail = work.answer(_tail(given, work, exact))
        if k:
            work.answer(_from_start(given, work, exact, tail))
    elif k and _is_open(given.repeated) and _is_open(given.first):
        value = _from_start(given, work, exact, _tail(given, work, exact))
        work.say(f"$R_0$ must be ${shown(given.known)}$:")
        found = work.equate(given.letter, value, exact(given.known))
        work.answer(_tail(given, work, reading(found)))
        work.answer(found)
    elif k and _is_open(given.repeated):
        _in_the_round(given, work, exact(given.known))
    elif k and given.letter != "gamma":
        find(given, work, _from_start(given, work, exact, work.answer(_tail(given, work, exact))), "R_0")
    else:
        letter = find(given, work, _from_start(given, work, exact, _tail(given, work, exact)), "R_0")
        if k:
            work.answer(work.either(_tail(given, work, reading(letter)), partial(_rest, given, reading(letter))))


def _is_open(rewards: tuple[Scalar, ...]) -> bool:
    return any(isinstance(reward, Parameter) for reward in rewards)


def _in_the_round(given: Given, work: Work, known: Value) -> None:
    """The return of the rewards that repeat from that of all, and the reward among them from it."""
    work.say(f"Let $y = R_{{{len(given.first)}}}$.")
    value = _from_start(given, work, exact, generator("y"))
    work.say(f"$R_0$ must be ${told(known)}$:")
    tail = work.answer(work.equate("y", value, known))
    value = _tail(given, work, exact)
    work.say(f"This must be $y {equals(tail)}$:")
    work.answer(work.equate(given.letter, value, tail))


def _tail(given: Given, work: Work, read: Callable[[Scalar], Value]) -> Value:
    k, n = len(given.first), len(given.repeated)
    work.say(
        f"The rewards repeat after ${n}$ {'step' if n == 1 else 'steps'}, $n = {n}$, so $R_{{{k + n}}} = R_{{{k}}}$, "
        "and this return is one round of rewards plus $γ^n$ times itself, a geometric series. Solved for the return:"
    )
    return work.step(GEOMETRIC_SERIES, t=k, n=n, **_known(given, read))


def _from_start(given: Given, work: Work, read: Callable[[Scalar], Value], tail: Value) -> Value:
    k = len(given.first)
    if not k:
        return tail
    work.say(f"The first {'reward' if k == 1 else f'{k} rewards'} and the rest, $n = {k}$:")
    return work.step(RETURN_UNROLLED, t=0, n=k, G={k: tail}, **_known(given, read))


def _rest(given: Given, read: Callable[[Scalar], Value]) -> Value:
    """The return of the rewards that repeat, from that of all and the first rewards."""
    spare = Work()
    return spare.equate("y", _from_start(given, spare, read, generator("y")), exact(needed(given.known)))


def _known(given: Given, read: Callable[[Scalar], Value]) -> dict[str, Any]:
    rewards = enumerate((*given.first, *given.repeated), 1)
    return {"gamma": read(given.gamma), "r": {time: read(reward) for time, reward in rewards}}


MISCONCEPTIONS = (
    TAIL_FORGOTTEN,
    TAIL_UNDISCOUNTED,
    PLUS_FOR_MINUS,
    ROUND_OF_ONE,
    FIRST_OF_ROUND.where_it_shows(),
    FIRST_DISCOUNTED.where_it_shows(),
)


def oracle(given: Given) -> Answers:
    """The rewards one by one, until what is left is too small to count."""
    if given.known is not None:
        number = _found(given)
        later = oracle(with_letter(given, Fraction(number).limit_denominator(10**6)))[:-1]
        return (number, *later) if given.letter == "gamma" else (*later, number)
    gamma = at(given.gamma)
    enough = 1 if gamma == 0 else int(min(2_000_000, -36 / np.log(gamma)))  # γ to that power is below 1e-15
    repeated = np.resize([at(reward) for reward in given.repeated], enough)
    tail = float(np.polynomial.polynomial.polyval(gamma, repeated))
    value = tail
    for reward in reversed(given.first):
        value = at(reward) + gamma * value
    return (tail, value) if given.first else (tail,)


def _found(given: Given) -> float:
    """The letter by halving an interval or, for a reward, by two trials."""
    if given.letter != "gamma":
        return tried(given, lambda trial: oracle(trial)[-1])
    low, high = 0.0, 1.0
    rising = oracle(with_letter(given, Fraction(1, 2)))[-1] < oracle(with_letter(given, Fraction(3, 4)))[-1]
    for _ in range(50):
        middle = (low + high) / 2
        below = oracle(with_letter(given, Fraction(middle)))[-1] < at(needed(given.known))
        low, high = (middle, high) if below == rising else (low, middle)
    return low
