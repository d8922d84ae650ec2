"""Which problems a run asks: a deterministic sequence from a selection, a level and a seed."""

import secrets
import sys
from collections.abc import Iterator, Sequence
from itertools import count

from rldrill.problems.catalogue import selection
from rldrill.problems.draws import Draws
from rldrill.problems.family import Family

#: The levels that are mixed when none is asked for, as often as they stand here.
MIXED = (1, 2, 2, 3)
#: The seeds of drawn problems stay below this, so that their IDs can be typed from paper.
MAX_DRAWN = 10**6


def fresh_seed() -> int:
    """A seed for a run that was not given one; small enough to type again."""
    return secrets.randbelow(10**6)


def sequence(names: Sequence[str], level: int | None, seed: int) -> Iterator[tuple[Family, int, int]]:
    """Family, level and seed of one problem after the other, without end.

    Families come round in an order that the seed shuffles, so that each is asked before one comes again.
    """
    chosen = selection(tuple(names))
    order = Draws(f"order {seed}")
    problems = Draws(f"problems {seed} version 0")
    for _ in count():
        for family in order.shuffled(chosen):
            yield family, level_of(family.levels, level, order), problems.below(MAX_DRAWN)


def level_of(levels: Sequence[int], wanted: int | None, draws: Draws) -> int:
    """The level that is wanted, or one of the mix; the highest of these where it is none of them."""
    level = wanted if wanted is not None else draws.choice(MIXED)
    return level if level in levels else levels[-1]


def announced_seed(seed: int | None) -> int:
    """The seed asked for, or a fresh one; said on stderr, so that the run can be repeated."""
    chosen = fresh_seed() if seed is None else seed
    print(f"seed {chosen}", file=sys.stderr)
    return chosen
