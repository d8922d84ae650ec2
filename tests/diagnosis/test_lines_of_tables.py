"""A line of a table, or a column of it, is read for another: what is said of the answers that come of it."""

from typing import Any

import pytest

import rldrill

HARBOUR: dict[str, Any] = {
    "mdp": {"transitions": [["cape", "reef", 1, 4], ["reef", "harbour", 1, -3]], "terminal": ["harbour"]},
    "gamma": "1/2",
}
#: δ(cape) = 4 + 1/2·10 − 6 = 3 and δ(reef) = −3 − 10 = −13.
RESIDUAL = {"family": "bellman-residual", "given": {**HARBOUR, "values": {"cape": 6, "reef": 10}}}
#: new → worn → old → new, so V(new) = 4 + 1/2·V(worn), V(worn) = 2 + 1/2·V(old), V(old) = 6 + 1/2·V(new).
ROUND = {
    "family": "policy-value",
    "given": {
        "mdp": {"transitions": [["new", "worn", 1, 4], ["worn", "old", 1, 2], ["old", "new", 1, 6]]},
        "gamma": "1/2",
    },
}
#: V(door) = 1/5·10 + 4/5·2 = 18/5 and V(hall) = 1/2·(−4) + 1/2·10 = 3.
POLICY = {
    "family": "value-from-action-values",
    "given": {
        "values": {"door": {"roll": 10, "back": 2}, "hall": {"roll": -4, "back": 10}},
        "policy": {"door": {"roll": "1/5", "back": "4/5"}, "hall": {"roll": "1/2", "back": "1/2"}},
    },
}
#: V*(high) = 4 + 1/2·8 and V*(low) = 0 + 1/2·8; the other actions are worth 2 + 1/2·4 = 4 and 3.
LOOKAHEAD = {
    "family": "optimal-policy-from-v",
    "given": {
        "mdp": {
            "transitions": [
                ["high", "search", "high", 1, 4],
                ["high", "wait", "low", 1, 2],
                ["low", "search", "empty", 1, 3],
                ["low", "wait", "high", 1, 0],
            ],
            "terminal": ["empty"],
        },
        "values": {"high": 8, "low": 4},
        "gamma": "1/2",
        "action_values": True,
    },
}
#: 8 + 1/2·(−3 + 1/4·12 − 8) = 4: in bay the first table prefers sail, which the second one values at 12.
TWO_TABLES = {
    "family": "double-q-learning",
    "given": {
        "trajectory": {"states": ["reef", "bay"], "actions": ["sail"], "rewards": [-3]},
        "values": {"reef": {"sail": 8, "drift": 4}, "bay": {"sail": 10, "drift": -4}},
        "second": {"reef": {"sail": -5, "drift": 9}, "bay": {"sail": 12, "drift": 7}},
        "updates": [1],
        "alpha": "1/2",
        "gamma": "1/4",
    },
}


@pytest.mark.parametrize(
    ("given", "typed", "says"),
    [
        # −3 + 1/2·10 − 6 = −4 and 4 − 10 = −6
        (RESIDUAL, "-4, -6", "two entries are exchanged: reward of the first and the second of the transitions"),
        # 1/2·4 + 10 − 6 = 6 and −3/2 − 10 = −23/2
        (RESIDUAL, "6, -23/2", "γRₛₛ′ + V(s′) stands where Rₛₛ′ + γV(s′) belongs every time"),
        # old → worn: worn = 2 + 3 + 1/4·worn = 20/3, old = 6 + 10/3 = 28/3, new = 4 + 10/3 = 22/3
        (ROUND, "22/3, 20/3, 28/3", "old is taken to lead to worn, not to new"),
        # 1/5·(−4) + 4/5·10 = 36/5
        (POLICY, "18/5, 36/5", "the row of door is read for that of hall in policy"),
        # V*(high) = 4 and V*(low) = 8: 4 + 2, 2 + 4, 3 and 0 + 2; no policy has these values, and nobody looks
        (LOOKAHEAD, "6, 6, 3, 2", "two entries are exchanged: values of high and low"),
        # 8 + 1/2·(−3 + 3 + 5)
        (TWO_TABLES, "21/2", "Qⱼ(sₜ, aₜ) stands where Qᵢ(sₜ, aₜ) belongs in the update"),
    ],
)
def test_another_line_is_read(given: dict[str, Any], typed: str, says: str) -> None:
    assert says in rldrill.read(given).diagnose(typed).sentence


def test_an_episode_is_counted_twice() -> None:
    # warm (4 + 4 + 0)/3 = 8/3, and cool (4 + 1 + 1 + 7)/4 = 13/4 for (4 + 1 + 7)/3 = 4
    episodes = [(["warm", "cool"], [2, 4]), (["warm"], [4]), (["warm"], [0]), (["cool"], [1]), (["cool"], [7])]
    given = {"episodes": [{"states": states, "rewards": rewards} for states, rewards in episodes], "gamma": "1/2"}
    said = rldrill.read({"family": "batch-td-and-mc", "given": given}).diagnose("8/3, 13/4").sentence
    assert said.startswith("It looks as if the fourth of the episodes is counted twice")


def test_two_causes_at_once_are_told_only_where_that_is_sure() -> None:
    # φ₁ = exp(−1/(2·3²)) and φ₂ = exp(−3²/(2·3²)), with 1 added to both: one error, and not two slips of arithmetic.
    given = {"position": [6], "centres": [[5], [3]], "sigma": 3}
    exercise = rldrill.read({"family": "rbf", "given": given})
    assert not exercise.diagnose("1 + exp(-1/18), 1 + exp(-1/2)").explains


def test_whole_lines_that_are_exchanged_change_nothing_and_are_not_tried() -> None:
    search = rldrill.read(RESIDUAL).diagnosing.search({})
    assert "entries-exchanged" not in [candidate.cause.kind for candidate in search._misread()]


def test_one_of_two_shares_that_is_asked_for_is_given_as_the_other() -> None:
    # 8p = 8/3·(1 − p) for p = 1/4
    given = {
        "values": {"door": {"roll": 8, "back": 0}, "hall": {"roll": "8/3", "back": 0}},
        "policy": {"door": {"roll": "p", "back": "1-p"}, "hall": {"roll": "1-p", "back": "p"}},
        "equal": True,
    }
    exercise = rldrill.read({"family": "value-from-action-values", "given": given})
    assert exercise.diagnose("3/4").sentence.startswith("It looks as if you gave 1 minus the answer")
