"""Known values of whole environments: a drawn grid world, and Gymnasium's toy-text environments."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from flint import fmpq

import rldrill
from rldrill.problems.models import Model
from rldrill.solutions.oracle import optimal_values, tensors

EXAMPLES = Path(__file__).parent.parent.parent / "examples"


def optimal(**given: Any) -> Any:
    return rldrill.read({"family": "optimal-value", "given": given}).solve()["a"]


def test_the_4_by_3_world_of_aima() -> None:
    # Russell & Norvig 2010, figure 17.3, three decimals, row by row from above.
    figure = ["0.812", "0.868", "0.918", "0.762", "0.660", "0.705", "0.655", "0.611", "0.388"]
    values = rldrill.load(EXAMPLES / "aima-4x3.toml").solve()["a"]
    assert [f"{float(int(v.numerator) / int(v.denominator)):.3f}" for v in values.values()] == figure


def test_the_frozen_lake() -> None:
    pytest.importorskip("gymnasium")
    # The values at γ = 0.9 that tutorials of value iteration print for the slippery 4×4 lake, to three decimals.
    known = {"0": "0.069", "1": "0.061", "2": "0.074", "4": "0.092", "8": "0.145", "9": "0.247", "10": "0.300",
             "13": "0.380", "14": "0.639"}  # fmt: skip
    values = optimal(gamma="9/10", mdp={"gymnasium": "FrozenLake-v1"})
    assert {
        state: f"{float(int(values[state].numerator) / int(values[state].denominator)):.3f}" for state in known
    } == known


def test_the_frozen_lake_without_discount() -> None:
    pytest.importorskip("gymnasium")
    # Optimal play comes over the slippery ice to the goal with probability 14/17, the 0.8235 of many tutorials. The
    # upper row is worth the same everywhere, and no hole needs a value.
    assert optimal(gamma=1, mdp={"gymnasium": "FrozenLake-v1"})["0"] == fmpq(14, 17)


def test_the_cliff() -> None:
    pytest.importorskip("gymnasium")
    # Sutton & Barto 2018, example 6.6: the optimal path runs along the edge: up, eleven steps right, down.
    assert optimal(gamma=1, mdp={"gymnasium": "CliffWalking-v1"})["36"] == -13


def test_the_taxi() -> None:
    pytest.importorskip("gymnasium")
    given = {"gymnasium": "Taxi-v4", "options": {}}
    try:
        model = Model.model_validate(given)
    except ValueError:  # older releases of gymnasium have version 3
        given["gymnasium"] = "Taxi-v3"
        model = Model.model_validate(given)
    values = optimal(gamma="9/10", mdp=given)
    P, R = tensors(model)
    swept = optimal_values(P, R, 0.9, len(model.states))[: len(model.states)]
    exact = [int(value.numerator) / int(value.denominator) for value in values.values()]
    assert np.allclose(exact, swept, atol=1e-9)


def rounded(values: Any, digits: int) -> list[str]:
    return [f"{float(int(value.numerator) / int(value.denominator)):.{digits}f}" for value in values.values()]


@pytest.mark.parametrize("convention", [{"rewards_on": "leaving"}, {"exit": True}])
def test_the_book_grid_of_berkeley(convention: dict[str, Any]) -> None:
    # CS188, project 3 and the lecture on MDPs: BookGrid, discount 0.9, noise 0.2, no living reward, row by row.
    figure = ["0.64", "0.74", "0.85", "1.00", "0.57", "0.57", "-1.00", "0.49", "0.43", "0.48", "0.28"]
    grid = {"grid": "...G\n.#.P\n....", "rewards": {"G": 1, "P": -1}, "slip": "0.2"} | convention
    assert rounded(optimal(gamma="0.9", mdp=grid), 2) == figure


def test_the_rewards_of_aima_are_those_of_the_state() -> None:
    # Russell & Norvig 2010, figure 17.3 with R(s): an end is worth its own reward, and the others as before.
    figure = ["0.812", "0.868", "0.918", "1.000", "0.762", "0.660", "-1.000", "0.705", "0.655", "0.611", "0.388"]
    grid = {"grid": "...G\n.#.P\n....", "rewards": {"G": 1, "P": -1}, "slip": "0.2", "step": "-0.04"}
    assert rounded(optimal(gamma=1, mdp=grid | {"rewards_on": "leaving"}), 3) == figure


# Sutton & Barto 2018, example 3.5: every move from A leads to a and earns 10, from B to b and earns 5; off the grid -1.
GRIDWORLD = {"grid": ".A.B.\n.....\n...b.\n.....\n.a...", "rewards": {"A": 10, "B": 5}, "returns": {"A": "a", "B": "b"},
             "rewards_on": "leaving", "bump": -1}  # fmt: skip


def test_the_gridworld_of_sutton_and_barto() -> None:
    figure_3_2 = "3.3 8.8 4.4 5.3 1.5 1.5 3.0 2.3 1.9 0.5 0.1 0.7 0.7 0.4 -0.4 -1.0 -0.4 -0.4 -0.6 -1.2"
    figure_3_2 += " -1.9 -1.3 -1.2 -1.4 -2.0"
    given = {"mdp": GRIDWORLD, "gamma": "0.9", "policy": "uniform"}
    assert rounded(rldrill.read({"family": "policy-value", "given": given}).solve()["a"], 1) == figure_3_2.split()
    figure_3_5 = "22.0 24.4 22.0 19.4 17.5 19.8 22.0 19.8 17.8 16.0 17.8 19.8 17.8 16.0 14.4 16.0 17.8 16.0 14.4 13.0"
    figure_3_5 += " 14.4 16.0 14.4 13.0 11.7"
    assert rounded(optimal(gamma="0.9", mdp=GRIDWORLD), 1) == figure_3_5.split()
