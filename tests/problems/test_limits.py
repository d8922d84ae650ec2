"""How large a problem in a file may be: the largest is read, and the next refused with the limit named."""

import tracemalloc
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from rldrill.problems.catalogue import families, family
from rldrill.problems.errors import FileError
from rldrill.problems.exact import read_fraction
from rldrill.problems.pomdp_format import read_pomdp


def cycle(states: int) -> dict[str, Any]:
    return {"transitions": [[f"s{n}", "a", f"s{(n + 1) % states}", 1, 1] for n in range(states)]}


def unit(size: int) -> list[list[int]]:
    return [[int(row == column) for column in range(size)] for row in range(size)]


def lqr(states: int, horizon: int) -> dict[str, Any]:
    return {
        "A": unit(states), "B": [[1]] * states, "Q": unit(states), "R": 1, "start": [1] * states, "horizon": horizon,
    }  # fmt: skip


def kalman(states: int, steps: int) -> dict[str, Any]:
    return {
        "mean": [[0]] * states, "covariance": unit(states), "A": unit(states), "B": [[1]] * states,
        "C": [[1] * states], "process": unit(states), "sensor": 1, "steps": [{"z": 1}] * steps,
    }  # fmt: skip


def run(steps: int) -> dict[str, Any]:
    return {"states": ["a"] * steps + ["end"], "rewards": [1] * steps, "terminal": ["end"]}


#: The family, its givens by their size, the largest, and what is said of the next.
LIMITS: dict[str, tuple[str, Callable[[int], dict[str, Any]], int, str]] = {
    "states": (
        "policy-value", lambda size: {"mdp": cycle(size), "gamma": "1/2"}, 1024,
        "there are 1025 states; at most 1024 can be solved exactly",
    ),
    "cells": (
        "policy-value", lambda size: {"mdp": {"grid": "." * size}, "gamma": "1/2"}, 1000,
        "the grid has 1001 cells; 1000 are the most",
    ),
    "letters of a name": (
        "policy-value", lambda size: {"mdp": {"transitions": [["s" * size, "a", "s" * size, 1, 1]]}, "gamma": "1/2"},
        40, "has 41 characters, 40 are the most; shorten it",
    ),
    "outcomes of all sweeps": (
        "policy-evaluation", lambda size: {"mdp": cycle(size), "gamma": "1/2", "sweeps": 1000}, 300,
        "sweeps: 1000 sweeps over 301 transitions take too long; at most 996 are possible here",
    ),
    "horizon": ("lqr-backward", lambda size: lqr(1, size), 100, "it must be at most 100"),
    "horizon with two states": (
        "lqr-backward", lambda size: lqr(2, size), 25, "horizon is 26; with 2 states and 1 action, 25 is the most",
    ),
    "horizon with three states": (
        "lqr-backward", lambda size: lqr(3, size), 12, "horizon is 13; with 3 states and 1 action, 12 is the most",
    ),
    "steps of a filter": ("kalman-filter", lambda size: kalman(1, size), 100, "it may have at most 100 entries"),
    "steps of a filter with two components": (
        "kalman-filter", lambda size: kalman(2, size), 25,
        "steps has 26 entries; with 2 components of the state, 25 are the most",
    ),
    "steps of a filter with six components": (
        "kalman-filter", lambda size: kalman(6, size), 5,
        "steps has 6 entries; with 6 components of the state, 5 are the most",
    ),
    "n of an n-step return": (
        "n-step-return",
        lambda size: {"trajectory": run(3), "values": {"a": 1}, "gamma": "1/2", "asked": [[0, size]]},
        1000, "number of steps 1001 from 1 to 1000",
    ),
    "rows of a system": (
        "lqr-infinite", lambda size: {"A": unit(size), "B": unit(size), "Q": unit(size), "R": unit(size)}, 6,
        "A has 7 rows; 6 are the most",
    ),
    "actions of a softmax": (
        "linear-policy",
        lambda size: {"features": {"cool": {f"a{number}": [number] for number in range(size)}}, "theta": [1]},
        100,
        "given.features.cool: has 101 entries; it may have at most 100",
    ),
    "states of a table": (
        "expected-sarsa",
        lambda size: {
            "trajectory": run(3) | {"actions": ["a"] * 3},
            "values": {state: {"a": 1} for state in ["a", *(f"s{number}" for number in range(size - 1))]},
            "policy": {"a": "a"}, "alpha": "1/2", "gamma": "1/2",
        },
        1024,
        "given.values: has 1025 entries; it may have at most 1024",
    ),
    "steps with traces": (
        "td-lambda-backward",
        lambda size: {"trajectory": run(size), "values": {"a": 1}, "alpha": "1/2", "gamma": "1/2", "lam": "1/2"},
        300,
        "given.trajectory: has 301 steps; it may have at most 300",
    ),
    "steps of an actor whose chances stand in each other's exponents": (
        "actor-critic",
        lambda size: {
            "trajectory": run(size) | {"actions": ["left"] * size}, "values": {"a": 1}, "theta": [1],
            "features": {"a": {"left": [1], "right": [2]}}, "alpha": "1/2", "beta": "1/2", "gamma": "1/2",
        },
        3,
        "given.trajectory: the weights of 4 steps would stand in each other's exponents, 3 can be written exactly",
    ),
    "predictions": (
        "bayes-predict",
        lambda size: {
            "belief": {f"s{number}": int(number == 0) for number in range(512)}, "actions": ["stay"] * size,
            "motion": {"stay": {f"s{number}": {f"s{number}": 1} for number in range(512)}},
        },
        4,
        "given.actions: 5 actions among 512 states take too long; at most 4 are possible here",
    ),
    "steps of a run": (
        "td-zero",
        lambda size: {"trajectory": run(size - 1), "values": {"a": 1}, "alpha": "1/2", "gamma": "1/2"},
        10_000,
        "given.trajectory.states: has 10001 entries; it may have at most 10000",
    ),
    "features of a state": (
        "feature-expectations",
        lambda size: {"features": {"a": [1] * size}, "trajectories": [["a"]], "gamma": "1/2"},
        100,
        "given.features.a: has 101 entries; it may have at most 100",
    ),
    "states of a trajectory": (
        "feature-expectations",
        lambda size: {"features": {"a": [1]}, "trajectories": [["a"] * size], "gamma": "1/2"},
        300,
        "given.trajectories[1]: has 301 entries; it may have at most 300",
    ),
    "arms with preferences": (
        "bandit",
        lambda size: {
            "pulls": [["a0", 1]], "preferences": {f"a{number}": 0 for number in range(size)}, "alpha": "1/2",
            "pulled": ["a1", 2],
        },
        100,
        "given.preferences: has 101 entries; it may have at most 100",
    ),
}  # fmt: skip


#: Models are bounded by their states, whatever form they come in.
_MODELS = ("Model.", "Grid.")


def unbounded(schema: dict[str, Any], known: dict[str, Any], where: str, above: frozenset[str]) -> Iterator[str]:
    """Every list and table of a schema for which nothing says how many entries it may have."""
    if (name := schema.get("$ref", "").rpartition("/")[2]) and name not in above:
        yield from unbounded(known[name], known, name, above | {name})
    for kind, bound in (("array", "maxItems"), ("object", "maxProperties")):
        entries = schema.get("items" if kind == "array" else "additionalProperties")
        if schema.get("type") == kind and isinstance(entries, dict):
            if bound not in schema:
                yield where
            yield from unbounded(entries, known, f"{where}[]", above)
    for word in ("anyOf", "oneOf", "allOf", "prefixItems"):
        for inner in schema.get(word, ()):
            yield from unbounded(inner, known, where, above)
    for name, inner in schema.get("properties", {}).items():
        yield from unbounded(inner, known, f"{where}.{name}", above)


@pytest.mark.parametrize("name", [*families()])
def test_no_list_or_table_of_a_file_grows_without_end(name: str) -> None:
    schema = family(name).schema()
    found = unbounded(schema, schema.get("$defs", {}), "given", frozenset())
    assert [where for where in found if not where.startswith(_MODELS)] == [], "Field(max_length=…) bounds them"


@pytest.mark.parametrize("limit", LIMITS)
def test_the_largest_is_read_and_the_next_is_refused(limit: str) -> None:
    name, given, largest, said = LIMITS[limit]
    family(name).read(given(largest))
    with pytest.raises(FileError) as refused:
        family(name).read(given(largest + 1))
    assert said in str(refused.value)


def test_an_actor_with_weights_for_each_state_may_go_on() -> None:
    states = [f"s{number}" for number in range(10)]
    # The first weight is the same for both actions, so that it stands in no exponent.
    weights = {state: [1, *(int(other == state) for other in states)] for state in states}
    family("actor-critic").read(
        {
            "trajectory": {"states": states, "actions": ["left"] * 9, "rewards": [1] * 9, "terminal": ["s9"]},
            "values": dict.fromkeys(states, 0), "theta": [0] * 11, "alpha": "1/2", "beta": "1/2", "gamma": "1/2",
            "features": {state: {"left": weights[state], "right": [1] + [0] * 10} for state in states[:9]},
        }
    )  # fmt: skip


def test_a_weight_that_was_never_moved_does_not_hide_one_that_was() -> None:
    def given(*states: str) -> dict[str, Any]:
        features = {"a": {"left": [1, 0], "right": [2, 0]}, "b": {"left": [1, 1], "right": [2, 2]}}
        steps = len(states)
        run = {"states": [*states, "end"], "actions": ["left"] * steps, "rewards": [1] * steps, "terminal": ["end"]}
        values = dict.fromkeys(set(states), 1)
        rates = {"alpha": "1/2", "beta": "1/2", "gamma": "1/2"}
        return {"trajectory": run, "values": values, "theta": [0, 0], "features": features} | rates

    family("actor-critic").read(given("a", "a", "b"))
    with pytest.raises(FileError, match="the weights of 4 steps would stand in each other's exponents"):
        family("actor-critic").read(given("a", "a", "a", "b"))


def test_two_hundred_characters_of_a_number_are_read() -> None:
    assert read_fraction(" " * 199 + "1") == 1
    with pytest.raises(ValueError, match="longer than 200 characters"):
        read_fraction(" " * 200 + "1")


def test_more_than_a_million_transitions_of_a_pomdp_file_are_not_written_out() -> None:
    # 1001 states, each with a way to each: 1 002 001.
    with pytest.raises(ValueError, match="line 5: T: there are more than 1000000 transitions; write a smaller model"):
        read_pomdp("discount: 0.5\nvalues: reward\nstates: 1001\nactions: 1\nT: * uniform\nR: * : * : * 1\n")


def test_they_are_counted_before_they_are_written_out() -> None:
    tracemalloc.start()  # 5 · 9999² would take more memory than there is
    with pytest.raises(ValueError, match="more than 1000000 transitions"):
        read_pomdp("discount: 0.5\nvalues: reward\nstates: 9999\nactions: 5\nT: * uniform\nR: * : * : * 1\n")
    assert tracemalloc.get_traced_memory()[1] < 10**8
    tracemalloc.stop()


@pytest.mark.parametrize(("horizon", "asked"), [(1, 1), (2, 2), (12, 12), (13, 12), (20, 12)])
def test_matrices_are_asked_for_as_long_as_there_are_letters(horizon: int, asked: int) -> None:
    # Of 26 letters two go to each of twelve times, and one to the first action.
    given = family("lqr-backward").read(lqr(1, horizon))
    assert [*given.asked] == [*reversed(range(asked))]  # type: ignore[attr-defined]
    assert len(family("lqr-backward").question(given).parts) == 2 * asked + 1
