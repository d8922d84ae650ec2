"""Beliefs as bars."""

from collections.abc import Mapping

from rldrill.problems.exact import shown
from rldrill.problems.fractions import Fraction
from rldrill.problems.pictures import Bars


def belief_bars(**beliefs: Mapping[str, Fraction]) -> Bars:
    """Beliefs over the same hypotheses as bars, called by their keywords; a single one goes without a name."""
    first = next(iter(beliefs.values()))
    series = tuple(name.replace("_", " ") for name in beliefs) if len(beliefs) > 1 else ("",)
    return Bars(
        names=tuple(first),
        series=series,
        shares=tuple(tuple(float(belief[name]) for name in first) for belief in beliefs.values()),
        labels=tuple(tuple(f"${shown(belief[name])}$" for name in first) for belief in beliefs.values()),
    )
