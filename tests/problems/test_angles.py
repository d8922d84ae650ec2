"""Angles: multiples of π and plain numbers, in degrees for pictures."""

import pytest

from rldrill.problems.angles import Angle, degrees
from rldrill.problems.fractions import Fraction


@pytest.mark.parametrize(
    ("angle", "wanted"),
    [
        (Angle(Fraction(1, 2), of_pi=True), 90.0),
        (Angle(Fraction(-1, 6), of_pi=True), -30.0),
        (Angle(Fraction(1), of_pi=False), 57.29577951308232),  # 180/π
        (Angle(Fraction(0), of_pi=False), 0.0),
    ],
)
def test_degrees(angle: Angle, wanted: float) -> None:
    assert degrees(angle) == pytest.approx(wanted, rel=1e-12)
