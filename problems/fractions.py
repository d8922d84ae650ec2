"""The rational numbers of givens: those of Python's ``fractions``, compiled, which takes an eighth of the time."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fractions import Fraction as Fraction
else:
    from quicktions import Fraction as Fraction
