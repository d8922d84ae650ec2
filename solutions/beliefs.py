"""Beliefs before and after a step as a picture, for workings."""

from collections.abc import Iterable, Mapping

from flint import fmpq

from rldrill.problems.pictures import Bars
from rldrill.solutions.exact import Value, decimal

#: Signs above a bar; a longer fraction is given in decimals.
_LABEL = 7


def before_and_after(before: Mapping[str, Value], after: Mapping[str, Value]) -> tuple[Bars, ...]:
    """Two bars for every state or hypothesis; none where a number is left open or is no probability."""
    series = (tuple(before.values()), tuple(after[name] for name in before))
    if not all(isinstance(chance, fmpq) and 0 <= chance <= 1 for row in series for chance in row):
        return ()
    shares = tuple(tuple(_float(chance) for chance in row) for row in series)
    return (Bars(tuple(before), ("before", "after"), shares, tuple(tuple(_labels(row)) for row in series)),)


def _float(chance: fmpq) -> float:
    return int(chance.p) / int(chance.q)


def _labels(row: Iterable[fmpq]) -> Iterable[str]:
    return (f"${chance}$" if len(str(chance)) <= _LABEL else f"$≈ {decimal(chance, 3)}$" for chance in row)
