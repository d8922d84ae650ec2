"""Which problems a run asks: levels in their shares, every family before one comes again."""

from collections import Counter
from itertools import islice

from rldrill.exam.selection import sequence
from rldrill.problems.catalogue import topics


def test_half_of_the_problems_are_of_level_2_and_a_quarter_of_each_other_level() -> None:
    levels = Counter(level for _, level, _ in islice(sequence((), None, 1), 2000))
    assert 450 < levels[1] < 550
    assert 940 < levels[2] < 1060
    assert 450 < levels[3] < 550


def test_a_level_that_is_asked_for_is_the_only_one() -> None:
    assert {level for _, level, _ in islice(sequence((), 3, 1), 100)} == {3}


def test_every_family_comes_once_before_one_comes_again() -> None:
    names = topics()["control"]
    asked = [family.name for family, _, _ in islice(sequence(("control",), None, 5), 3 * len(names))]
    for start in range(0, len(asked), len(names)):
        assert set(asked[start : start + len(names)]) == set(names)
    assert asked[: len(names)] != asked[len(names) : 2 * len(names)], "each round has an order of its own"
