"""Dynamic programming in books and lectures: published numbers as literals, others worked out in a comment."""

import tomllib
from itertools import product
from pathlib import Path
from typing import Any

import pytest
from flint import fmpq

from asking import solved
from rldrill.problems.errors import FileError

EXAMPLES = Path(__file__).parent.parent.parent / "examples"


def model(example: str) -> Any:
    return tomllib.loads((EXAMPLES / example).read_text("utf-8"))["given"]["mdp"]


GRID = model("gridworld-4-1.toml")
RACING = model("racing-car.toml")
SLOW = {"cool": "slow", "warm": "slow"}
FAST_WHEN_COOL = {"cool": "fast", "warm": "slow"}


@pytest.mark.parametrize(
    ("sweeps", "figure"),
    [
        # Sutton & Barto 2018, Figure 4.1, left column: the grid without its two corners, row by row.
        (1, [-1.0] * 14),
        (2, [-1.7, -2.0, -2.0, -1.7, *[-2.0] * 6, -1.7, -2.0, -2.0, -1.7]),
        (3, [-2.4, -2.9, -3.0, -2.4, -2.9, -3.0, -2.9, -2.9, -3.0, -2.9, -2.4, -3.0, -2.9, -2.4]),
        (10, [-6.1, -8.4, -9.0, -6.1, -7.7, -8.4, -8.4, -8.4, -8.4, -7.7, -6.1, -9.0, -8.4, -6.1]),
    ],
)
def test_figure_4_1_of_sutton_and_barto(sweeps: int, figure: list[float]) -> None:
    values = solved("policy-evaluation", mdp=GRID, gamma=1, sweeps=sweeps)["a"]
    # The book rounds some numbers and cuts others off: −1.75 is printed as −1.7.
    assert [float(value.p) / float(value.q) for value in values.values()] == pytest.approx(figure, abs=0.0501)


def test_the_first_sweeps_of_figure_4_1_by_hand() -> None:
    # State 1 leads to the end, to itself, to 2 and to 5: −1 + 1/4·(0 − 1 − 1 − 1) = −7/4, then
    # −1 + 1/4·(0 − 7/4 − 2 − 2) = −39/16; state 5 leads to 1, 4 (−7/4 each), 6 and 9 (−2 each): −23/8.
    assert solved("policy-evaluation", mdp=GRID, gamma=1, sweeps=2)["a"]["1"] == fmpq(-7, 4)
    third = solved("policy-evaluation", mdp=GRID, gamma=1, sweeps=3)["a"]
    assert (third["1"], third["5"], third["6"]) == (fmpq(-39, 16), fmpq(-23, 8), -3)


def test_a_sweep_in_place_by_hand() -> None:
    # The same grid, in place, states in their order: V(1) = −1; V(2) = −1 + 1/4·(0 − 1 + 0 + 0) = −5/4, as its left
    # neighbour is new; V(3) = −1 + 1/4·(−5/4) = −21/16; V(4) = −1 (up is the end); V(5) = −1 + 1/4·(−1 − 1) = −3/2.
    values = solved("policy-evaluation", mdp=GRID, gamma=1, sweeps=1, in_place=True)["a"]
    assert [values[state] for state in "12345"] == [-1, fmpq(-5, 4), fmpq(-21, 16), -1, fmpq(-3, 2)]


def test_the_greedy_policy_of_figure_4_1() -> None:
    # Right column, k = ∞: the arrows in the states 1 … 14.
    arrows = ["left", "left", "left down", "up", "up left", "left down", "down", "up", "up right", "right down",
              "down", "up right", "right", "right"]  # fmt: skip
    quarter = dict.fromkeys(("up", "down", "right", "left"), "1/4")
    answers = solved("policy-improvement", mdp=GRID, gamma=1, policy={str(s): quarter for s in range(1, 15)})
    assert list(answers["a"].values()) == [-14, -20, -22, -14, -18, -20, -20, -20, -20, -18, -14, -22, -20, -14]
    assert [set(best) for best in answers["b"].values()] == [set(some.split()) for some in arrows]
    assert answers["c"] is False


def test_policy_iteration_of_the_racing_car_by_hand() -> None:
    # The car of Berkeley's CS 188 with γ = 1/2. Always slow: V(cool) = 1 + 1/2·V(cool) = 2, V(warm) = 2.
    # Fast in cool earns 2 + 1/2·2 = 3 > 2; fast in warm −10. Then V(cool) = 2 + 1/4·(V(cool) + V(warm)) and
    # V(warm) = 1 + 1/4·(V(cool) + V(warm)): 7/2 and 5/2. Slow in cool earns 1 + 1/2·7/2 = 11/4 < 7/2: the end.
    better = {"cool": ("fast",), "warm": ("slow",)}
    answers = solved("policy-iteration", mdp=RACING, gamma="1/2", start=SLOW, rounds=2)
    assert answers == {
        "a": {"cool": 2, "warm": 2}, "b": better, "c": {"cool": fmpq(7, 2), "warm": fmpq(5, 2)}, "d": better, "e": True,
    }  # fmt: skip
    optimum = {"cool": "7/2", "warm": "5/2"}
    assert solved("optimal-policy-from-v", mdp=RACING, gamma="1/2", values=optimum)["a"] == better


def test_the_improvement_theorem_for_the_racing_car_by_hand() -> None:
    # From the values above: fast once in cool is worth 3 ≥ 2, slow in warm 2 ≥ 2. The other way round,
    # slow once in cool is worth 1 + 1/2·7/2 = 11/4 < 7/2, and the theorem says nothing.
    given = {"mdp": RACING, "gamma": "1/2"}
    up = solved("policy-improvement-theorem", **given, policy=SLOW, other=FAST_WHEN_COOL)
    assert (list(up["b"].values()), up["c"]) == ([3, 2], True)
    down = solved("policy-improvement-theorem", **given, policy=FAST_WHEN_COOL, other=SLOW)
    assert (list(down["b"].values()), down["c"]) == ([fmpq(11, 4), fmpq(5, 2)], False)


MOVES = {"up": (-1, 0), "down": (1, 0), "right": (0, 1), "left": (0, -1)}


def test_the_optimal_policy_of_figure_3_5() -> None:
    # Sutton & Barto 2018, Example 3.8: a grid of 5 × 5, γ = 0.9. Every action in A earns 10 and leads to A′, in B 5
    # and to B′; leaving the grid costs 1. v* is given as Figure 3.5 prints it, rounded to one digit.
    figure = (
        *("22.0", "24.4", "22.0", "19.4", "17.5"),
        *("19.8", "22.0", "19.8", "17.8", "16.0"),
        *("17.8", "19.8", "17.8", "16.0", "14.4"),
        *("16.0", "17.8", "16.0", "14.4", "13.0"),
        *("14.4", "16.0", "14.4", "13.0", "11.7"),
    )
    cells = list(product(range(5), repeat=2))
    jumps = {(0, 1): ((4, 1), 10), (0, 3): ((2, 3), 5)}
    rows = []
    for cell, (action, step) in product(cells, MOVES.items()):
        there = (cell[0] + step[0], cell[1] + step[1])
        after, reward = jumps.get(cell) or ((there, 0) if there in cells else (cell, -1))
        rows.append([f"{cell[0]}{cell[1]}", action, f"{after[0]}{after[1]}", 1, reward])
    values = {f"{line}{column}": value for (line, column), value in zip(cells, figure, strict=True)}
    best = solved("optimal-policy-from-v", mdp={"transitions": rows}, values=values, gamma=0.9)["a"]
    # The cells in which the figure has one arrow only.
    arrows = {"00": "right", "02": "left", "04": "left", "11": "up", "13": "left", "14": "left", "21": "up", "31": "up"}
    assert {cell: best[cell] for cell in arrows} == {cell: (arrow,) for cell, arrow in arrows.items()}
    assert set(best["01"]) == set(best["03"]) == set(MOVES)


def test_the_4_by_3_world_of_russell_and_norvig() -> None:
    # Artificial Intelligence: A Modern Approach, 3rd ed., Figures 17.2 and 17.3: utilities for γ = 1 and R = −0.04,
    # columns 1 to 4, rows from the bottom; the wall is at (2, 2). A move goes to either side with probability 0.1.
    utilities = {
        (1, 1): "0.705", (2, 1): "0.655", (3, 1): "0.611", (4, 1): "0.388", (1, 2): "0.762", (3, 2): "0.660",
        (1, 3): "0.812", (2, 3): "0.868", (3, 3): "0.918",
    }  # fmt: skip
    ends = {(4, 2): -1, (4, 3): 1}
    steps = {"up": (0, 1), "right": (1, 0), "down": (0, -1), "left": (-1, 0)}
    chances: dict[tuple[str, str, str], int] = {}
    for cell, (index, action) in product(utilities, enumerate(steps)):
        for turn, tenths in ((0, 8), (1, 1), (3, 1)):
            step = list(steps.values())[(index + turn) % 4]
            there = (cell[0] + step[0], cell[1] + step[1])
            after = there if there in utilities or there in ends else cell
            key = named(cell), action, named(after)
            chances[key] = chances.get(key, 0) + tenths
    pays = {named(cell): end for cell, end in ends.items()}
    rows = [[*key, f"{tenths}/10", f"{pays.get(key[2], 0) * 100 - 4}/100"] for key, tenths in chances.items()]
    best = solved(
        "optimal-policy-from-v",
        mdp={"transitions": rows, "terminal": list(pays)},
        values={named(cell): value for cell, value in utilities.items()},
        gamma=1,
    )["a"]
    policy = {"11": "up", "21": "left", "31": "left", "41": "left", "12": "up", "32": "up", "13": "right",
              "23": "right", "33": "right"}  # fmt: skip
    assert best == {cell: (action,) for cell, action in policy.items()}


def named(cell: tuple[int, int]) -> str:
    return f"{cell[0]}{cell[1]}"


def test_how_many_sweeps_an_error_of_a_hundredth_takes_by_hand() -> None:
    # The distance is 6; 6·(1/2)⁹ = 6/512 > 1/100 ≥ 6/1024. If only the change 6 of the first sweep is known, the
    # distance is at most 6/(1 − 1/2) = 12, which takes one sweep more.
    given = {"start": {"a": 1, "b": 0}, "gamma": "1/2", "sweeps": 3, "accuracy": "1/100"}
    other = {"a": 3, "b": -6}
    assert solved("contraction", **given, optimum=other) == {"a": 6, "b": fmpq(3, 4), "c": 10}
    assert solved("contraction", **given, first=other) == {"a": 6, "b": 12, "c": fmpq(3, 2), "d": 11}


def test_q_value_iteration_on_the_racing_car() -> None:
    # Q_1 is the expected reward: 1, 2, 1, −10. Q_2(cool, slow) = 1 + 2, Q_2(cool, fast) = 2 + 1/2·2 + 1/2·1,
    # Q_2(warm, slow) = 1 + 1/2·2 + 1/2·1; the greatest of each state are 3.5 and 2.5, as value iteration has them.
    answers = solved("value-iteration", mdp=RACING, gamma=1, sweeps=2, action_values=True)
    assert answers["a"] == {
        ("cool", "slow"): fmpq(3), ("cool", "fast"): fmpq(7, 2), ("warm", "slow"): fmpq(5, 2), ("warm", "fast"): -10,
    }  # fmt: skip
    assert answers["b"] == {"cool": ("fast",), "warm": ("slow",)}


def test_value_iteration_in_place_on_the_racing_car() -> None:
    # Sweep 1: V(cool) = 2, then V(warm) = 1/2·(1 + 2) + 1/2·1 = 2. Sweep 2: V(cool) = max{1 + 2, 2 + 2} = 4, then
    # V(warm) = 1/2·(1 + 4) + 1/2·(1 + 2) = 4.
    answers = solved("value-iteration", mdp=RACING, gamma=1, sweeps=2, in_place=True)
    assert answers["a"] == {"cool": fmpq(4), "warm": fmpq(4)}


@pytest.mark.parametrize("field", [{"in_place": True}, {"start": {"cool": 1, "warm": 1}}])
def test_sweeps_over_action_values_are_synchronous_and_begin_with_0(field: dict[str, Any]) -> None:
    with pytest.raises(FileError, match=f"leave out {next(iter(field))}, or action_values"):
        solved("value-iteration", mdp=RACING, gamma=1, sweeps=2, action_values=True, **field)


def test_sweeps_start_with_0_in_a_terminal_state() -> None:
    start = {"cool": 1, "warm": 1}
    assert solved("value-iteration", mdp=RACING, gamma=1, sweeps=1, start=start | {"overheated": 0})
    with pytest.raises(FileError, match="start: the value of 'overheated' must be 0, because it is terminal"):
        solved("value-iteration", mdp=RACING, gamma=1, sweeps=1, start=start | {"overheated": 3})


def test_numbers_that_are_found_by_hand() -> None:
    # y earns x + 1/2·4, the other action 6; go is worth 2 + 1/2·4 = 4, stay for ever 1/(1 − 1/2) = 2; after one
    # sweep a is worth 2 and b 4, and 1 + 4γ = 2; with a smaller γ it is y that pays more.
    missing = {"transitions": [["a", "y", "b", 1, "x"]]}
    tied = solved("optimal-policy-from-q", values={"a": {"z": 6}, "b": {"z": 4}}, missing=missing, gamma="1/2")
    assert tied == {"a": 4, "b": {"b": ("z",)}}
    mdp = {"transitions": [["a", "go", "b", 1, 2], ["a", "stay", "a", 1, 1], ["b", "go", "end", 1, 4]]}
    found = solved("optimal-policy-from-v", mdp=mdp, values={"b": 4}, missing="a", gamma="1/2")
    assert found == {"a": 4, "b": {"a": ("go",), "b": ("go",)}}
    mdp = {"transitions": [["a", "x", "b", 1, 1], ["a", "y", "end", 1, 2], ["b", "x", "end", 1, 4]]}
    tie = solved("value-iteration", mdp=mdp, gamma="gamma", sweeps=1, tie="a")
    assert tie == {"a": {"a": 2, "b": 4}, "b": fmpq(1, 4), "c": "B"}


def test_a_reward_from_a_value_after_two_sweeps_by_hand() -> None:
    # V1(a) = max{2 + 1/2·4; 1/2·(4 + 1/2·4) + 1/2·6} = 6. With y = V1(b), go is worth 2 + 1/2·y and try 5 + 1/4·y;
    # the greater is 7 for y = 8 (go 6), not for y = 10 (try 15/2). In b x + 1/2·4 = 8, so x = 6, and quit is worth 1.
    # V2(b) = max{6 + 1/2·8; 1} = 10; then go 2 + 1/2·10 = 7, try 1/2·(4 + 1/2·10) + 3 = 15/2; stay 6 + 1/2·10.
    rows = [["a", "go", "b", 1, 2], ["a", "try", "b", "1/2", 4], ["a", "try", "end", "1/2", 6],
            ["b", "stay", "b", 1, "x"], ["b", "quit", "end", 1, 1]]  # fmt: skip
    known = {"mdp": {"transitions": rows}, "gamma": "1/2", "start": {"a": 2, "b": 4}}
    found = solved("value-iteration", **known, outcome={"a": 7})
    assert found == {"a": 8, "b": 6, "c": {"b": 10}, "d": {"a": ("try",), "b": ("stay",)}}
    with pytest.raises(FileError, match="the reward of 'stay' does not follow: another action in 'b' is worth as much"):
        solved("value-iteration", **known, outcome={"a": 1})
    with pytest.raises(FileError, match="with no value of 'b' is the best action in 'a' worth 7"):
        solved("value-iteration", **known | {"gamma": 0}, outcome={"a": 7})
    with pytest.raises(FileError, match="outcome: give the value after two sweeps of a state that is not 'b'"):
        solved("value-iteration", **known, outcome={"b": 7})
