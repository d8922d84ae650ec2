"""Models whose values come out readable."""

import pytest

from rldrill.problems.fractions import Fraction
from rldrill.problems.valued import UNITS


@pytest.mark.parametrize("gamma", UNITS)
def test_multiples_of_its_unit_are_whole_when_they_are_discounted(gamma: Fraction) -> None:
    assert 0 < gamma < 1
    assert UNITS[gamma] == gamma.denominator
