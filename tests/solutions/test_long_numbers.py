"""Numbers that grow beyond what is written: one sentence that is true, never a crash."""

import json
from typing import Any

import pytest

import rldrill
from rldrill.problems.errors import FileError

LONG = "9" * 38 + "/1" + "0" * 38  # a little below 1
WALK = {"transitions": [["a", "x", "a", "1/3", 1], ["a", "x", "b", "2/3", 2], ["b", "x", "a", 1, 3]]}
RUN = {"states": ["a"] * 200, "rewards": ["1/3"] * 199}
EPISODE = {"states": ["a"] * 200 + ["end"], "rewards": ["1/3"] * 200, "terminal": ["end"]}

TOO_LONG: list[tuple[str, dict[str, Any]]] = [
    ("return", {"rewards": [1] * 200, "gamma": "1e-39"}),
    ("return-infinite", {"first": ["1/3"] * 200, "repeated": [1], "gamma": LONG}),
    ("value-iteration", {"mdp": WALK, "sweeps": 1000, "gamma": LONG}),
    ("policy-evaluation", {"mdp": WALK, "sweeps": 1000, "gamma": LONG}),
    ("td-zero", {"trajectory": RUN, "values": {"a": 1}, "alpha": LONG, "gamma": LONG}),
    ("monte-carlo", {"trajectory": EPISODE, "values": {"a": 1}, "alpha": LONG, "gamma": LONG, "visits": "every"}),
    ("contraction", {"start": {"a": 1}, "optimum": {"a": 2}, "gamma": LONG, "sweeps": 1000}),
    ("sample-average", {"values": {"a": 1}, "visits": [["a", "1/3"]] * 200, "alpha": LONG}),
    (
        "lqr-backward",
        {"A": [[LONG, "1/3"], ["1/7", LONG]], "B": [["1/11"], ["1/13"]], "Q": [[1, 0], [0, 1]], "R": [[LONG]],
         "start": [1, 1], "horizon": 12},
    ),
    ("softmax-policy", {"theta": ["ln 3"], "features": {"a": ["1e9"], "b": [2]}}),
    ("softmax-policy", {"theta": ["1" + "0" * 30], "features": {"a": [1], "b": [2]}}),
]  # fmt: skip


@pytest.mark.parametrize(("family", "given"), TOO_LONG, ids=[family for family, _ in TOO_LONG])
def test_what_grows_too_long_is_refused_with_one_sentence(family: str, given: dict[str, Any]) -> None:
    with pytest.raises(FileError, match="more than 2000 digits") as error:
        rldrill.read({"family": family, "given": given})
    assert "no answer" not in str(error.value), "it may well have one"


def test_what_is_only_long_is_solved() -> None:
    # G_0 = Σ 10^(−20 k) for k = 0 … 89: ninety ones with nineteen zeros between them, over 10^1780.
    exercise = rldrill.read({"family": "return", "given": {"rewards": [1] * 90, "gamma": "1e-20", "time": 0}})
    above = int("1" + ("0" * 19 + "1") * 89)
    assert exercise.solve()["a"] * 10**1780 == above
    assert json.dumps(exercise.data())
    assert str(exercise.working())
