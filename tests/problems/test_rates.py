"""Step size, discount, λ and ε of a drawn problem differ: where two are equal, nobody sees that they were exchanged."""

from itertools import combinations

import pytest

from rldrill.problems.catalogue import chosen, family
from rldrill.problems.exact import Parameter
from rldrill.solutions.drawing import draw

#: td-zero draws as it always did: problems worked out by hand hang on it.
FAMILIES = [name for name in chosen(("temporal-difference", "control")) if name != "td-zero"]
RATES = ("alpha", "gamma", "lam", "epsilon")


@pytest.mark.parametrize("name", FAMILIES)
def test_no_two_rates_are_equal(name: str) -> None:
    for level in family(name).levels:
        for seed in range(8):
            given = draw(name, level, seed).problem.given
            known = {rate: getattr(given, rate, None) for rate in RATES}
            numbers = {rate: value for rate, value in known.items() if value and not isinstance(value, Parameter)}
            assert not [pair for pair in combinations(numbers, 2) if numbers[pair[0]] == numbers[pair[1]]]
