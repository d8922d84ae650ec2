"""Beliefs of workings: pictures before and after a step, and probabilities that are found."""

from collections.abc import Callable, Iterable, Mapping

from flint import fmpq

from rldrill.problems.bars import belief_bars
from rldrill.problems.beliefs import Outcome
from rldrill.problems.exact import Parameter, Scalar
from rldrill.problems.fractions import Fraction
from rldrill.problems.pictures import Bars
from rldrill.solutions.exact import ONE, Value, exact, is_rational


def before_and_after(before: Mapping[str, Value], after: Mapping[str, Value]) -> tuple[Bars, ...]:
    """Two bars for every state or hypothesis; none where a number is left open or is no probability."""
    if not all(is_rational(chance) and 0 <= chance <= 1 for chance in (*before.values(), *after.values())):
        return ()
    return (belief_bars(before=_fractions(before), after=_fractions(after)),)


def stated(outcome: Outcome, states: Iterable[str]) -> dict[str, Value]:
    """The belief that is known with the one probability of two."""
    share = exact(outcome.probability)
    return {name: share if name == outcome.state else ONE - share for name in states}


def number(chance: Scalar, q: float) -> float:
    """A probability in floating point, if what is left open is q: for the independent solvers."""
    if isinstance(chance, Parameter):
        return 1 - q if chance.complement else q
    return float(chance)


def root(missed: Callable[[float], float]) -> float:
    """Where a monotone function is 0 between 0 and 1, by bisection: for the independent solvers."""
    low, high = 0.0, 1.0
    rising = missed(high) > missed(low)
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (low, middle) if (missed(middle) > 0) == rising else (middle, high)
    return (low + high) / 2


def _fractions(belief: Mapping[str, fmpq]) -> dict[str, Fraction]:
    return {name: Fraction(int(chance.p), int(chance.q)) for name, chance in belief.items()}
