"""What everybody forgets is a listed mistake wherever it can be forgotten: else a rarer one is told in its place."""

import pytest

from rldrill.problems.catalogue import families, family
from rldrill.solutions.drawing import draw
from rldrill.solutions.solution import solver

#: How the names of such mistakes begin: a forgotten discount, decay or step size, the smallest value for the greatest.
EVERYDAY = ("forgot-gamma", "no-discount", "next-not-discounted", "decay-without-", "forgot-alpha", "smallest-")


def everyday(name: str) -> str:
    """The beginning that a name has; empty if none."""
    return next((beginning for beginning in EVERYDAY if name.startswith(beginning)), "")


@pytest.mark.parametrize("name", families())
def test_what_is_often_forgotten_is_listed_wherever_its_formula_is_read(name: str) -> None:
    listed = {everyday(mistake.name) for mistake in solver(family(name)).misconceptions}
    for level in family(name).levels:
        for seed in range(2):
            for formula in draw(name, level, seed).work.read:
                for mistake in formula.misread:
                    assert everyday(mistake.name) in {"", *listed}, (level, seed, formula, mistake)
