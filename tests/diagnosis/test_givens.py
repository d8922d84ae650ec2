"""One thing of what is given read wrongly, on a run that is small enough to list by hand."""

from fractions import Fraction
from typing import Any

import rldrill
from rldrill.solutions.diagnosis.givens import misread

# V(cave) = 8, V(floor) = 10, V(rim) = 6, rewards 7, −3 and 5, α = 1/4, γ = 1/2.
RUN = {
    "family": "td-zero",
    "given": {
        "trajectory": {"states": ["cave", "floor", "cave", "rim"], "rewards": [7, -3, 5]},
        "values": {"cave": 8, "floor": 10, "rim": 6},
        "alpha": "1/4",
        "gamma": "1/2",
    },
}


def read_as(kind: str) -> list[Any]:
    """The givens that are read so, in their order."""
    return [each.given for each in misread(rldrill.read(RUN).problem.given) if each.kind == kind]


def test_a_share_is_taken_for_its_complement() -> None:
    assert {(given.alpha, given.gamma) for given in read_as("complement")} == {
        (Fraction(3, 4), Fraction(1, 2)),
        (Fraction(1, 4), Fraction(1, 2)),  # 1 − γ is γ
    }


def test_neighbours_in_a_list_are_exchanged_and_the_rest_stays() -> None:
    assert [given.trajectory.rewards for given in read_as("entries-exchanged")][-2:] == [(-3, 7, 5), (7, 5, -3)]


def test_rows_and_rates_are_exchanged() -> None:
    values = [tuple(given.values[state] for state in ("cave", "floor", "rim")) for given in read_as("rows-exchanged")]
    assert values == [(10, 8, 6), (6, 10, 8), (8, 6, 10)]
    assert [(given.alpha, given.gamma) for given in read_as("givens-exchanged")] == [(Fraction(1, 2), Fraction(1, 4))]


def test_a_minus_is_lost() -> None:
    assert [given.trajectory.rewards for given in read_as("minus-lost")] == [(7, 3, 5)]
