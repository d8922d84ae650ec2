"""Values of the grid worlds of the textbooks, as literals."""

from typing import Any

import pytest
from flint import fmpq

import rldrill
from asking import solved
from rldrill.problems.errors import FileError

# Sutton & Barto 2018, example 3.5: every action in A earns +10 and leads to A', in B +5 and to B'; a move off the
# grid earns −1 and changes nothing; γ = 0.9.
MOVES = {"north": (-1, 0), "south": (1, 0), "east": (0, 1), "west": (0, -1)}
JUMPS = {(0, 1): ((4, 1), 10), (0, 3): ((2, 3), 5)}
CELLS = [(row, column) for row in range(5) for column in range(5)]


def name(cell: tuple[int, int]) -> str:
    return f"r{cell[0]}c{cell[1]}"


def gridworld() -> dict[str, Any]:
    rows: list[list[Any]] = []
    for cell in CELLS:
        for move, (down, right) in MOVES.items():
            after, reward = JUMPS.get(cell, ((cell[0] + down, cell[1] + right), 0))
            if after not in CELLS:
                after, reward = cell, -1
            rows.append([name(cell), move, name(after), 1, reward])
    return {"transitions": rows}


def as_float(value: Any) -> float:
    return int(value.p) / int(value.q)


def test_figure_3_2_of_sutton_and_barto() -> None:
    figure = [
        3.3, 8.8, 4.4, 5.3, 1.5,
        1.5, 3.0, 2.3, 1.9, 0.5,
        0.1, 0.7, 0.7, 0.4, -0.4,
        -1.0, -0.4, -0.4, -0.6, -1.2,
        -1.9, -1.3, -1.2, -1.4, -2.0,
    ]  # fmt: skip
    values = solved("policy-value", mdp=gridworld(), gamma="0.9")["a"]
    assert [as_float(values[name(cell)]) for cell in CELLS] == pytest.approx(figure, abs=0.0501)


def test_figure_3_5_of_sutton_and_barto() -> None:
    figure = [
        22.0, 24.4, 22.0, 19.4, 17.5,
        19.8, 22.0, 19.8, 17.8, 16.0,
        17.8, 19.8, 17.8, 16.0, 14.4,
        16.0, 17.8, 16.0, 14.4, 13.0,
        14.4, 16.0, 14.4, 13.0, 11.7,
    ]  # fmt: skip
    answers = solved("optimal-value", mdp=gridworld(), gamma="0.9")
    assert [as_float(answers["a"][name(cell)]) for cell in CELLS] == pytest.approx(figure, abs=0.0501)
    # The figure's arrows: in A all four actions are best, to the right of A west alone, below A north alone.
    assert answers["b"]["r0c1"] == tuple(MOVES)
    assert answers["b"]["r0c2"] == ("west",)
    assert answers["b"]["r1c1"] == ("north",)
    assert set(answers["b"]["r4c4"]) == {"north", "west"}


def test_the_utilities_of_russell_and_norvigs_4_by_3_world() -> None:
    # AIMA, 3rd edition, figure 17.3: γ = 1, −0.04 for every step, +1 and −1 in the two ends.
    world = {"grid": "...G\n.#.P\n....", "rewards": {"G": 1, "P": -1}, "step": "-0.04", "slip": "0.2"}
    values = solved("optimal-value", mdp=world, gamma=1)["a"]
    figure = {
        "r1c1": 0.812, "r1c2": 0.868, "r1c3": 0.918, "r2c1": 0.762, "r2c3": 0.660,
        "r3c1": 0.705, "r3c2": 0.655, "r3c3": 0.611, "r3c4": 0.388,
    }  # fmt: skip
    assert {state: as_float(value) for state, value in values.items()} == pytest.approx(figure, abs=0.000501)


def test_the_example_of_the_bellman_equation_at_the_centre_of_figure_3_2() -> None:
    # Sutton & Barto 2018, exercise 3.14: the centre, +0.7, from its neighbours +2.3, +0.4, −0.4 and +0.7:
    # 1/4·0.9·(2.3 + 0.4 − 0.4 + 0.7) = 0.675.
    moves = [["centre", move, f"{move} of it", 1, 0] for move in MOVES]
    neighbours = {"north of it": "2.3", "west of it": "0.7", "south of it": "-0.4", "east of it": "0.4"}
    pairs = solved("action-value", dynamics={"transitions": moves}, values=neighbours, gamma="0.9")["a"]
    assert sum(map(as_float, pairs.values())) / 4 == pytest.approx(0.675)


def test_a_process_without_actions() -> None:
    # γ = 1/2. V(b) = 3/4·(4 + 0) + 1/4·(0 + 1/2·V(a)) and V(a) = 2 + 1/2·V(b): V(b) = 3 + 1/8·(2 + 1/2·V(b)), so
    # 15/16·V(b) = 13/4, V(b) = 52/15 and V(a) = 2 + 26/15 = 56/15.
    rows = [["a", "b", 1, 2], ["b", "end", "3/4", 4], ["b", "a", "1/4", 0]]
    mdp = {"transitions": rows, "terminal": ["end"]}
    assert solved("policy-value", mdp=mdp, gamma="1/2")["a"] == {"a": fmpq(56, 15), "b": fmpq(52, 15)}
    # Two sweeps from 0: V_1 = 2, 3; V_2(a) = 2 + 3/2, V_2(b) = 3 + 1/4·1/2·2.
    assert solved("policy-evaluation", mdp=mdp, gamma="1/2", sweeps=2)["a"] == {"a": fmpq(7, 2), "b": fmpq(13, 4)}


def test_the_random_walk_of_example_6_2_is_a_reward_process() -> None:
    # Sutton & Barto 2018, example 6.2: the true values of A to E are 1/6, 2/6, 3/6, 4/6, 5/6.
    line = ["left", "A", "B", "C", "D", "E", "right"]
    rows = [[s, line[i + step], 0.5, int(line[i + step] == "right")] for i, s in enumerate(line[1:-1], 1)
            for step in (-1, 1)]  # fmt: skip
    values = solved("policy-value", mdp={"transitions": rows, "terminal": ["left", "right"]}, gamma=1)["a"]
    assert values == {state: fmpq(number, 6) for number, state in enumerate("ABCDE", 1)}


def test_the_average_reward_of_a_policy() -> None:
    # To a lead a (1/2) and b (1): d(a) = 1/2·d(a) + d(b), so d(a) = 2·d(b) = 2/3. A step from a earns 1, from b 3.
    rows = [["a", "x", "a", "1/2", 2], ["a", "x", "b", "1/2", 0], ["b", "x", "a", 1, 3]]
    exercise = rldrill.read({"family": "policy-value", "given": {"mdp": {"transitions": rows}, "average": True}})
    assert exercise.solve() == {"a": {"a": fmpq(2, 3), "b": fmpq(1, 3)}, "b": fmpq(5, 3)}
    # A policy that stays in a with probability p = 3/4: d(a) = 4/5, reward 4/5·(3/4·2 + 1/4·0) + 1/5·3 = 9/5.
    rows = [["a", "stay", "a", 1, 2], ["a", "go", "b", 1, 0], ["b", "go", "a", 1, 3]]
    policy = {"a": {"stay": "3/4", "go": "1/4"}, "b": "go"}
    answers = solved("policy-value", mdp={"transitions": rows}, policy=policy, average=True)
    assert answers == {"a": {"a": fmpq(4, 5), "b": fmpq(1, 5)}, "b": fmpq(9, 5)}


def test_the_average_reward_of_a_period_and_of_a_start_that_is_never_come_back_to() -> None:
    # After the start, worth 100 once, a and b take turns for ever: half of the steps each, (4 + 1)/2 on average.
    rows = [["start", "a", 1, 100], ["a", "b", 1, 4], ["b", "a", 1, 1]]
    answers = solved("policy-value", mdp={"transitions": rows}, average=True)
    assert answers == {"a": {"start": 0, "a": fmpq(1, 2), "b": fmpq(1, 2)}, "b": fmpq(5, 2)}


@pytest.mark.parametrize(
    ("rows", "more", "says"),
    [
        ([["a", "x", "end", 1, 1]], {}, "'end' is terminal; give it an action that goes on"),
        ([["a", "x", "a", 1, 1]], {"gamma": "1/2"}, "γ plays no part; leave out gamma"),
    ],
)
def test_an_average_reward_needs_a_long_run_without_discount(rows: list[Any], more: dict[str, Any], says: str) -> None:
    with pytest.raises(FileError, match=says):
        solved("policy-value", mdp={"transitions": rows}, average=True, **more)


def test_an_average_reward_that_depends_on_the_start_is_refused() -> None:
    rows = [["s", "x", "a", "1/2", 0], ["s", "x", "b", "1/2", 0], ["a", "x", "a", 1, 1], ["b", "x", "b", 1, 2]]
    with pytest.raises(FileError, match=r"whoever comes to a stays there for ever, and so does .* b; rldrill"):
        solved("policy-value", mdp={"transitions": rows}, average=True)


def test_the_print_of_a_reward_process_names_no_action() -> None:
    mdp = {"transitions": [["a", "a", "1/2", 1], ["a", "end", "1/2", 0]], "terminal": ["end"]}
    for name, more in (("policy-value", {}), ("policy-evaluation", {"sweeps": 1})):
        page = str(rldrill.read({"family": name, "given": {"mdp": mdp, "gamma": "1/2"} | more}).question())
        assert "Markov reward process" in page
        assert "action" not in page
        assert "policy is" not in page


def test_where_actions_are_asked_for_a_reward_process_has_one_called_step() -> None:
    mdp = {"transitions": [["a", "end", 1, 1]], "terminal": ["end"]}
    answers = solved("optimal-value", mdp=mdp, gamma="1/2")
    assert answers["a"] == {"a": 1}
    assert answers["b"] == {"a": ("step",)}


@pytest.mark.parametrize(
    ("name", "more"),
    [
        ("bellman-residual", {}),
        ("optimal-policy-from-v", {}),
        ("policy-improvement", {"policy": {"a": "go"}}),
        ("policy-improvement-theorem", {"policy": {"a": "go"}, "other": {"a": "stay"}}),
    ],
)
def test_a_terminal_state_may_have_its_0_among_given_values(name: str, more: dict[str, Any]) -> None:
    mdp = {"transitions": [["a", "go", "end", 1, 4], ["a", "stay", "a", 1, 1]], "terminal": ["end"]}
    known = {"mdp": mdp, "gamma": "1/2", "values": {"a": 4}} | more
    assert solved(name, **{**known, "values": {"a": 4, "end": 0}}) == solved(name, **known)
    with pytest.raises(FileError, match="the value of 'end' must be 0, because it is terminal; give 0, or make it the"):
        solved(name, **{**known, "values": {"a": 4, "end": 2}})


def test_the_reward_with_which_values_are_optimal_by_hand() -> None:
    # In b: max{4; 3} = 4. In a: x + 1/2·4 = 5, so x = 3. With x = −2: max{−2 + 2; 1} − 5 = −4.
    rows = [["a", "go", "b", 1, "x"], ["a", "stay", "end", 1, 1], ["b", "go", "end", 1, 4], ["b", "stay", "end", 1, 3]]
    claim = {
        "mdp": {"transitions": rows, "terminal": ["end"]},
        "values": {"a": 5, "b": 4},
        "gamma": "1/2",
        "reward": -2,
    }
    assert solved("bellman-residual", **claim) == {"a": 3, "b": {"a": -4, "b": 0}}
    with pytest.raises(FileError, match="with no reward are they optimal, for 'b' is worth 4 by the others"):
        solved("bellman-residual", **claim | {"values": {"a": 5, "b": 6}})
    with pytest.raises(FileError, match="the reward does not follow, for another action in 'a' is worth as much"):
        solved("bellman-residual", **claim | {"values": {"a": 1, "b": 4}})


def test_numbers_found_from_a_backup_by_hand() -> None:
    # x + 1/2·4 = 5; 2 + 4γ = 3 + 2γ; 4p + 2(1 − p) = 7/2.
    def rows(first: str, second: str) -> dict[str, Any]:
        return {"transitions": [["a", "go", "b", 1, first], ["a", "stay", "c", 1, second]]}

    one = {"transitions": [["a", "go", "b", 1, "x"]]}
    known: dict[str, Any] = {"dynamics": one, "policy": {"a": "go"}, "values": {"a": 5, "b": 4}, "gamma": "1/2"}
    assert solved("bellman-backup", find=True, **known) == {"a": 3}
    tied = {"dynamics": rows("2", "3"), "values": {"b": 4, "c": 2}, "gamma": "gamma", "find": True}
    assert solved("action-value", **tied) == {"a": fmpq(1, 2)}
    mixed = {"dynamics": rows("2", "1"), "values": {"a": "7/2", "b": 4, "c": 2}, "gamma": "1/2", "chance": True}
    assert solved("action-value", **mixed)["b"] == fmpq(3, 4)


def test_a_value_that_no_policy_gives_is_refused() -> None:
    rows = [["a", "go", "b", 1, 2], ["a", "stay", "b", 1, 0]]  # worth 4 and 2
    with pytest.raises(FileError, match="no policy gives it"):
        solved("action-value", dynamics={"transitions": rows}, values={"a": 5, "b": 4}, gamma="1/2", chance=True)


def test_what_action_values_leave_open_by_hand() -> None:
    # 8p + 4(1 − p) = 5, and so 0·p + 4(1 − p) = 3; 8p + 2(1 − p) = 5.
    policy = {"a": {"x": "p", "y": "1-p"}, "b": {"x": "p", "y": "1-p"}}
    values = {"a": {"x": 8, "y": 4}, "b": {"x": 0, "y": 4}}
    found = solved("value-from-action-values", values=values, policy=policy, known={"a": 5})
    assert found == {"a": fmpq(1, 4), "b": {"b": 3}}
    even = {"a": {"x": 8, "y": 2}, "b": {"x": 5}}
    equal = solved("value-from-action-values", values=even, policy=policy | {"b": "x"}, equal=True)
    assert equal == {"a": fmpq(1, 2)}
