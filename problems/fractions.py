"""The rational numbers of givens: those of Python's ``fractions``, compiled, which takes an eighth of the time."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fractions import Fraction as Fraction
else:
    from quicktions import Fraction as Fraction


def plain(number: Fraction) -> int | Fraction:
    """A whole number as Python's, which is computed with three times as fast; others as they are."""
    return number.numerator if number.denominator == 1 else number
