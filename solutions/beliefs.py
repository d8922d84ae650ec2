"""Beliefs before and after a step as a picture, for workings."""

from collections.abc import Mapping
from fractions import Fraction

from flint import fmpq

from rldrill.problems.bars import belief_bars
from rldrill.problems.pictures import Bars
from rldrill.solutions.exact import Value, is_rational


def before_and_after(before: Mapping[str, Value], after: Mapping[str, Value]) -> tuple[Bars, ...]:
    """Two bars for every state or hypothesis; none where a number is left open or is no probability."""
    if not all(is_rational(chance) and 0 <= chance <= 1 for chance in (*before.values(), *after.values())):
        return ()
    return (belief_bars(before=_fractions(before), after=_fractions(after)),)


def _fractions(belief: Mapping[str, fmpq]) -> dict[str, Fraction]:
    return {name: Fraction(int(chance.p), int(chance.q)) for name, chance in belief.items()}
