"""Models whose values come out readable."""

import pytest

from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Model, Transition
from rldrill.problems.valued import UNITS, check_optimal_values


@pytest.mark.parametrize("gamma", UNITS)
def test_multiples_of_its_unit_are_whole_when_they_are_discounted(gamma: Fraction) -> None:
    assert 0 < gamma < 1
    assert UNITS[gamma] == gamma.denominator


@pytest.mark.parametrize(
    ("reward", "rounded", "beyond"),
    [(Fraction(1, 2), "51/100", "52/100"), (Fraction(6), "606/100", "607/100"), (Fraction(-6), "-606/100", "-607/100")],
)
def test_values_may_be_rounded_to_a_hundredth_of_themselves_and_small_ones_to_a_hundredth(
    reward: Fraction, rounded: str, beyond: str
) -> None:
    model = Model(transitions=(Transition("a", "x", "end", Fraction(1), reward),), terminal=("end",))
    check_optimal_values({"a": Fraction(rounded)}, model, Fraction(1, 2))
    with pytest.raises(ValueError, match=f"but its best action is worth {reward}"):
        check_optimal_values({"a": Fraction(beyond)}, model, Fraction(1, 2))
