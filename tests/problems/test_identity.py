"""IDs: seeds are whole numbers of at most twelve digits; a family may be named with its level."""

import pytest

from rldrill.problems.errors import UsageError
from rldrill.problems.identity import with_level
from rldrill.solutions.drawing import draw


def test_the_largest_seed_has_twelve_digits() -> None:
    assert draw("return", 1, 999_999_999_999).problem.identity is not None
    with pytest.raises(UsageError, match="out of range; take a whole number from 0 to 999999999999"):
        draw("return", 1, 1_000_000_000_000)
    with pytest.raises(UsageError, match="out of range"):
        draw("return", 1, -1)


def test_a_name_may_have_a_level() -> None:
    assert with_level("td-zero/2") == ("td-zero", 2)
    assert with_level("td-zero") == ("td-zero", None)
    assert with_level("td-zero/4") == ("td-zero/4", None)
    assert with_level("td-zero/2/7") == ("td-zero/2/7", None)
