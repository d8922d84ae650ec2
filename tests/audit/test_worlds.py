"""Worlds that cannot be: what is printed contradicts itself, although each given is well formed."""

from typing import Any

import pytest

from rldrill.problems.catalogue import family
from rldrill.solutions.solution import solver

MOVES = {"transitions": [["a", "x", "b", 1, 3], ["a", "y", "a", 1, 12]]}
EVEN = {"a": {"x": "1/2", "y": "1/2"}}


def found_discount(value: int) -> dict[str, Any]:
    # (3 + 8γ)/2 + (12 + vγ)/2 = v: γ = (v − 15/2)/(4 + v/2)
    return {"dynamics": MOVES, "values": {"a": value, "b": 8}, "gamma": "gamma", "find": True, "policy": EVEN}


def found_chance(first: int) -> dict[str, Any]:
    # 5p + 6(1 − p) = v(1 − p) − 3p: p = (v − 6)/(v + 2)
    values = {"a": {"x": 5, "y": 6}, "b": {"x": first, "y": -3}}
    return {"values": values, "policy": {"a": {"x": "p", "y": "1-p"}, "b": {"x": "1-p", "y": "p"}}, "equal": True}


def valued(value: int) -> dict[str, Any]:
    return {"dynamics": MOVES, "values": {"a": value, "b": 8}, "gamma": "1/2"}  # 3 + 4 and 12 + v/2


def explored(worth: object) -> dict[str, Any]:
    return {"state": "a", "values": {"x": 1, "y": 6}, "epsilon": "epsilon", "state_value": worth}  # 6 − 5/2·ε


def estimated(first: int) -> dict[str, Any]:
    return {
        "features": {"a": [4, 1], "b": [3, 3]}, "trajectories": [["a", "b"]], "gamma": "gamma", "estimate": first,
    }  # fmt: skip  # 4 + 3γ


def matched(expected: int) -> dict[str, Any]:
    motion = {"x": {"a": {"end": 1}}, "y": {"a": {"a": "1/2", "end": "1/2"}}}
    return {
        "motion": motion, "policy": {"a": {"x": "q", "y": "1-q"}}, "features": {"a": [4]}, "start": {"a": 1},
        "terminal": ["end"], "gamma": "1/2", "matched": expected,
    }  # fmt: skip  # 4/(1 − (1 − q)/4)


def ahead(value: int) -> dict[str, Any]:
    rows = {"transitions": [["a", "x", "b", 1, -3], ["a", "y", "c", 1, 6]]}
    return {"lookahead": {"dynamics": rows, "values": {"a": value, "b": 6, "c": 2}}, "gamma": 1}  # 3 and 8


@pytest.mark.parametrize(
    ("name", "given", "possible"),
    [
        ("bellman-backup", found_discount(10), True), ("bellman-backup", found_discount(7), False),
        ("bellman-backup", found_discount(25), False),
        ("bellman-backup", found_discount(7) | {"gamma": "1/2", "find": False}, True),
        ("bellman-backup", found_discount(7) | {"gamma": "1/2", "dynamics": {
            "transitions": [["a", "x", "b", 1, 3], ["a", "y", "a", 1, "x"]]}}, True),
        ("value-from-action-values", found_chance(10), True), ("value-from-action-values", found_chance(1), False),
        ("value-from-action-values", found_chance(6), False), ("value-from-action-values", found_chance(-4), False),
        ("action-value", valued(10), True), ("action-value", valued(6), False), ("action-value", valued(26), False),
        ("action-value", valued(7), True), ("action-value", valued(24), True),
        ("action-value", {"dynamics": MOVES, "values": {"a": 99, "b": 8}, "gamma": "gamma"}, True),
        ("epsilon-greedy", explored(5), True), ("epsilon-greedy", explored(7), False),
        ("epsilon-greedy", explored(3), False), ("epsilon-greedy", explored("7/2"), True),
        ("epsilon-greedy", explored(6), True),
        ("feature-expectations", estimated(5), True), ("feature-expectations", estimated(3), False),
        ("feature-expectations", estimated(8), False), ("feature-expectations", estimated(4), True),
        ("feature-expectations", estimated(7), True),
        ("feature-expectations-policy", matched(5), True), ("feature-expectations-policy", matched(6), False),
        ("feature-expectations-policy", matched(3), False),
        ("advantage", ahead(6), True), ("advantage", ahead(2), False), ("advantage", ahead(9), False),
        ("advantage", ahead(3), True), ("advantage", ahead(8), True),
    ],
)  # fmt: skip
def test_what_can_be_and_what_cannot(name: str, given: dict[str, Any], possible: bool) -> None:
    assert solver(family(name)).possible(family(name).read(given)) is possible


def test_where_a_family_says_nothing_everything_is_possible() -> None:
    given = family("return").read({"rewards": [1], "gamma": "1/2"})
    assert solver(family("return")).possible(given)
