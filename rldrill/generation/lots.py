"""Which problems a run draws: lots of a family and a level, cut so that any process can draw any of them alone."""

from collections.abc import Sequence
from enum import Enum

from msgspec import Struct

from rldrill.problems.catalogue import headers
from rldrill.problems.draws import Draws
from rldrill.problems.errors import UsageError
from rldrill.problems.identity import MAX_SEED

#: Quizzes and worksheets draw seeds below this; neither split holds one of them.
_BELOW = 10**6
_MIDDLE = MAX_SEED // 2


class Split(Enum):
    """Seeds that no other split has: to train on, and to be held out for tests."""

    TRAIN = "train"
    HELD_OUT = "held-out"

    @property
    def seeds(self) -> range:
        """The seeds of the split."""
        return range(_BELOW, _MIDDLE) if self is Split.TRAIN else range(_MIDDLE, MAX_SEED)


class Lot(Struct, frozen=True):
    """So many different problems of a family and level, with the seeds from ``first`` on."""

    family: str
    level: int
    count: int
    first: int

    @property
    def name(self) -> str:
        """What the lot's file is called, without its ending."""
        return f"{self.family}-{self.level}"


def lots(
    names: Sequence[str], level: int | None, number: int, seed: int, split: Split = Split.TRAIN
) -> tuple[Lot, ...]:
    """Share a number of problems out among families and levels as evenly as it goes.

    Args:
        names: topics and families; all, if there are none.
        level: 1 to 3, or None for all that a family has.
        number: how many problems, together.
        seed: what the seeds of the problems depend on, and which lots get one problem more than others.
        split: which seeds may be drawn.

    Raises:
        UsageError: a name does not exist, or there are more problems than a lot has seeds.
    """
    kinds = [(head.name, each) for head in headers(names) for each in head.levels if level in (None, each)]
    if not kinds:
        raise UsageError(f"None of these families has level {level}.")
    each, more = divmod(number, len(kinds))
    if each >= 10**10:
        raise UsageError(f"{number} problems are too many; at most {10**10 * len(kinds)} can be drawn of these.")
    order = Draws(f"generate {seed}").shuffled(kinds)
    counts = [each + (place < more) for place in range(len(order))]
    return tuple(
        Lot(family, of_level, count, _first(seed, family, of_level, split))
        for (family, of_level), count in zip(order, counts, strict=True)
        if count
    )


def _first(seed: int, family: str, level: int, split: Split) -> int:
    seeds = split.seeds
    return seeds.start + Draws(f"generate {seed} {family} {level}").below(len(seeds) // 2)
