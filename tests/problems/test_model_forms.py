"""Models in other forms than a list of transitions: grids drawn as text, and Gymnasium's tables."""

from fractions import Fraction
from typing import Any

import pytest
from pydantic import ValidationError

from rldrill.problems.gymnasium import from_table
from rldrill.problems.models import Model

# The 4×3 world of Russell & Norvig, AIMA, section 17.1: moves succeed with 0.8 and slip to either side with 0.1.
AIMA = {"grid": "...G\n.#.P\n....", "rewards": {"G": 1, "P": -1}, "step": "-0.04", "slip": "0.2"}


def outcomes(model: Model, state: str, action: str) -> dict[str, tuple[Fraction, Fraction]]:
    return {row.next: (row.probability, row.reward) for row in model.outcomes[state, action]}  # type: ignore[misc]


def test_a_grid_drawn_as_text() -> None:
    model = Model.model_validate(AIMA)
    assert model.terminal == ("r1c4", "r2c4")
    assert len(model.states) == 9  # 12 cells, one wall, two ends
    # From (3, 3) of the book, to the right: the goal with 0.8, down with 0.1, and up against the edge with 0.1.
    step = Fraction(-4, 100)
    assert outcomes(model, "r1c3", "right") == {
        "r1c4": (Fraction(4, 5), 1 + step),
        "r2c3": (Fraction(1, 10), step),
        "r1c3": (Fraction(1, 10), step),
    }
    # Beside the wall: left and right of an upward move from r3c2 are free, above it is the wall.
    assert outcomes(model, "r3c2", "up") == {
        "r3c2": (Fraction(4, 5), step),
        "r3c3": (Fraction(1, 10), step),
        "r3c1": (Fraction(1, 10), step),
    }


def test_a_cliff_leads_back_to_the_start() -> None:
    cliff = {"grid": "...\nSCG", "rewards": {"C": -99}, "step": -1, "ends": ["G"], "returns": {"C": "S"}}
    model = Model.model_validate(cliff)
    assert outcomes(model, "r2c1", "right") == {"r2c1": (1, -100)}
    assert outcomes(model, "r1c2", "down") == {"r2c1": (1, -100)}
    assert model.terminal == ("r2c3",)
    assert "r2c2" not in model.states


@pytest.mark.parametrize(
    ("given", "fragment"),
    [
        ({"grid": "..\n."}, "differ in length"),
        ({"grid": "..", "rewards": {"G": 1}}, "'G', but no cell"),
        ({"grid": "..", "slip": 3}, "slip: 3 is not between"),
        ({"grid": "..", "sleep": 3}, "sleep"),
        ({"grid": "SC\n..", "returns": {"C": "."}}, "must stand for one cell"),
        ({"grid": ("." * 60 + "\n") * 20}, "1200 cells"),
        ({"gymnasium": "FrozenLake-v1", "gamma": 1}, "'gamma' is not understood"),
    ],
)
def test_what_does_not_fit_is_one_sentence(given: dict[str, Any], fragment: str) -> None:
    with pytest.raises(ValidationError, match=fragment):
        Model.model_validate(given)


def test_a_table_with_doubled_rows_and_ends() -> None:
    # Two ways into state 1 by one action: 1/3 with reward 0 and 1/3 with reward 3 are 2/3 with 3/2 on average.
    table = {0: {0: [(1 / 3, 1, 0.0, False), (1 / 3, 1, 3.0, False), (1 / 3, 2, 1.0, True)]},
             1: {0: [(1.0, 0, 0.0, False)]}, 2: {0: [(1.0, 2, 0.0, True)]}}  # fmt: skip
    model = Model.model_validate(from_table(table))
    assert outcomes(model, "0", "0") == {"1": (Fraction(2, 3), Fraction(3, 2)), "2": (Fraction(1, 3), 1)}
    assert model.terminal == ("2",)


def test_gymnasiums_environments() -> None:
    pytest.importorskip("gymnasium")
    lake = Model.model_validate({"gymnasium": "FrozenLake-v1"})
    assert len(lake.states) == 11  # 16 cells, four holes and a goal
    assert lake.terminal == ("5", "7", "11", "12", "15")
    assert outcomes(lake, "14", "2") == {
        "14": (Fraction(1, 3), 0), "15": (Fraction(1, 3), 1), "10": (Fraction(1, 3), 0)
    }  # fmt: skip
    with pytest.raises(ValidationError, match="no table of transitions"):
        Model.model_validate({"gymnasium": "CartPole-v1"})
    with pytest.raises(ValidationError, match="cannot make 'NoSuch-v0'"):
        Model.model_validate({"gymnasium": "NoSuch-v0"})
