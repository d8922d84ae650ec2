"""Random draws that are the same on every machine, Python and release."""

import hashlib
import random
from collections.abc import Callable, Sequence
from functools import lru_cache
from operator import sub
from typing import TypeVar

from rldrill.problems.fractions import Fraction, fraction_of

Item = TypeVar("Item")


#: The same numbers are drawn over and over, and making a Fraction takes longer than drawing it.
_whole: Callable[[int], Fraction] = lru_cache(maxsize=2048)(Fraction)
_read: Callable[[str], Fraction] = lru_cache(maxsize=2048)(fraction_of)


class Draws:
    """A stream of choices that depends on its key alone.

    It rests on ``random.Random.random()`` after seeding with an integer, which Python's documentation
    promises to keep, and on nothing else of that module.
    """

    def __init__(self, key: str) -> None:
        digest = hashlib.sha256(key.encode()).digest()
        self._random = random.Random(int.from_bytes(digest, "big")).random

    def below(self, bound: int) -> int:
        """A whole number from 0 to ``bound - 1``."""
        if bound < 1:
            raise ValueError(f"nothing to choose from below {bound}")
        return int(self._random() * bound)

    def whole(self, low: int, high: int) -> Fraction:
        """A whole number from ``low`` to ``high``, both included."""
        return _whole(low + int(self._random() * (high - low + 1)))

    def nonzero(self, low: int, high: int) -> Fraction:
        """A whole number from ``low`` to ``high`` that is not 0."""
        random, numbers = self._random, high - low + 1
        while True:
            if number := low + int(random() * numbers):
                return _whole(number)

    def fitting(self, low: int, high: int, fits: Callable[[int], bool]) -> Fraction:
        """A whole number from ``low`` to ``high`` that is not 0 and fits; where none does, any of them."""
        numbers = [number for number in range(low, high + 1) if number]
        return _whole(self.choice([number for number in numbers if fits(number)] or numbers))

    def choice(self, items: Sequence[Item]) -> Item:
        """One of the items."""
        if not items:
            raise ValueError("there is nothing to choose from")
        return items[int(self._random() * len(items))]

    def fraction(self, *texts: str) -> Fraction:
        """One of the given fractions, written ``"1/2"``."""
        return _read(self.choice(texts))

    def chance(self, probability: Fraction) -> bool:
        """True with the given probability."""
        return self.below(probability.denominator) < probability.numerator

    def shuffled(self, items: Sequence[Item]) -> tuple[Item, ...]:
        """The items in another order."""
        return tuple(self._shuffled(items, len(items)))

    def _shuffled(self, items: Sequence[Item], count: int) -> list[Item]:
        """The first of the items in another order; what the others take of the stream is taken, too."""
        random, rest = self._random, list(items)
        first = [rest.pop(int(random() * size)) for size in range(len(rest), max(len(rest) - count, 0), -1)]
        for _ in rest:
            random()
        return first

    def sample(self, items: Sequence[Item], count: int) -> tuple[Item, ...]:
        """``count`` different items, in the order in which they stand."""
        return tuple([items[index] for index in sorted(self._shuffled(range(len(items)), count))])

    def distinct(self, count: int, low: int, high: int) -> tuple[Fraction, ...]:
        """``count`` different whole numbers from ``low`` to ``high``."""
        return tuple(map(_whole, self.integers(count, low, high)))

    def integers(self, count: int, low: int, high: int) -> tuple[int, ...]:
        """The same as Python's integers."""
        return tuple(self._shuffled(range(low, high + 1), count))

    def split(self, parts: int, denominators: Sequence[int]) -> tuple[Fraction, ...]:
        """Positive probabilities that sum to 1, over one of the denominators that is large enough."""
        return _over(*self.shares(parts, denominators))

    def shares(self, parts: int, denominators: Sequence[int]) -> tuple[tuple[int, ...], int]:
        """The same in whole numbers: how many parts of the whole each gets, and how many there are."""
        whole = self.choice([number for number in denominators if number >= parts])
        edges = (0, *sorted(self._shuffled(range(1, whole), parts - 1)), whole)
        return tuple(map(sub, edges[1:], edges)), whole


@lru_cache(maxsize=2048)
def _over(shares: tuple[int, ...], whole: int) -> tuple[Fraction, ...]:
    return tuple([Fraction(share, whole) for share in shares])
