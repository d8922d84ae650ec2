"""Features of states: what inverse reinforcement learning is given instead of rewards."""

from collections.abc import Iterable, Mapping, Sequence
from math import gcd

from rldrill.problems.draws import Draws
from rldrill.problems.features import FeatureVector
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Named, check_keys

#: The features of every state, as many for each.
FeaturesField = Named[FeatureVector]


def check_features(features: Mapping[str, tuple[Fraction, ...]], states: Iterable[str]) -> None:
    """Demand as many features, one at least, of every state.

    Raises:
        ValueError: they are missing, given for an unknown state, or not as many as for the others.
    """
    needed = tuple(dict.fromkeys(states))
    check_keys(features, needed, "the feature vector", needed=needed)
    check_lengths(features)


def check_lengths(vectors: Mapping[str, Sequence[object]]) -> None:
    """Demand vectors of one length, with one component at least.

    Raises:
        ValueError: they are not.
    """
    lengths = {len(vector) for vector in vectors.values()}
    if len(lengths) > 1 or 0 in lengths:
        told = ", ".join(f"{name!r} has {len(vector)}" for name, vector in vectors.items())
        raise ValueError(f"features: all must have the same number of components, one at least, but {told}")


def draw_features(rng: Draws, states: tuple[str, ...]) -> dict[str, tuple[Fraction, ...]]:
    """Two whole numbers from 0 to 4; no state's are a multiple of another's, and no feature is one of another."""
    while True:
        columns = [tuple([rng.below(5) for _ in states]) for _ in range(2)]
        rows = list(zip(*columns, strict=True))
        if all(len(set(column)) > 1 for column in columns) and apart(rows) and apart(columns):
            return {state: tuple(map(Fraction, row)) for state, row in zip(states, rows, strict=True)}


def apart(vectors: Sequence[tuple[int, ...]]) -> bool:
    """Whether none is a multiple of another, and none 0."""
    shapes = {tuple([value // gcd(*vector) for value in vector]) for vector in vectors if any(vector)}
    return len(shapes) == len(vectors)
