"""Seeds: whole numbers of at most twelve digits."""

import pytest

from rldrill.problems.errors import UsageError
from rldrill.solutions.drawing import draw


def test_the_largest_seed_has_twelve_digits() -> None:
    assert draw("return", 1, 999_999_999_999).problem.identity is not None
    with pytest.raises(UsageError, match="out of range; take a whole number from 0 to 999999999999"):
        draw("return", 1, 1_000_000_000_000)
    with pytest.raises(UsageError, match="out of range"):
        draw("return", 1, -1)
