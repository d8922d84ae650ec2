"""Values that are said to hold for all or for the rest of what is asked for, and other things that people say."""

from pathlib import Path

import pytest
from flint import fmpq

import rldrill
from promptness import at_once
from rldrill.problems.parts import Numbers, Policy
from rldrill.solutions.answers.kinds import Allowed, answer_kind
from rldrill.solutions.answers.text import (
    Unreadable,
    read_choice,
    read_matrix,
    read_table,
    read_vector,
    read_words,
    read_yes_no,
)

STATES = ["cool", "warm"]
ACTIONS = {"cool": ["fast", "slow"], "warm": ["fast", "slow"]}
PAIRS = [(state, action) for state in STATES for action in ("fast", "slow")]


@pytest.mark.parametrize(
    "text",
    ["both slow", "Always slow", "slow in both", "slow everywhere", "slow in every state", "slow for all s", "slow ∀s",
     "in both states: slow", "all slow", "überall slow"],
)  # fmt: skip
def test_one_action_for_all_states(text: str) -> None:
    assert read_words(text, STATES, ACTIONS) == {"cool": ("slow",), "warm": ("slow",)}


def test_a_comma_makes_an_entry_of_both_which_is_a_tie() -> None:
    assert read_words("both, slow", STATES, ACTIONS) == {"cool": ("fast", "slow"), "warm": ("slow",)}


def test_both_are_two() -> None:
    with pytest.raises(Unreadable):
        read_table("both 1/5", ["a", "b", "c"])
    with pytest.raises(Unreadable):
        read_words("slow both", ["a", "b", "c"], {key: ["fast", "slow"] for key in "abc"})


def test_a_name_is_no_word_for_all() -> None:
    assert read_table("all 1/5, warm 1", ["all", "warm"]) == read_table("1/5, 1", ["all", "warm"])
    assert list(read_table("all 1/5", ["all", "warm"])) == ["all"]


@pytest.mark.parametrize("text", ["both 0.2", "0.2 for both", "20% each", "0.2 (both)", "all 1/5", "1/5 in all states"])
def test_one_value_for_all_states(text: str) -> None:
    assert [reading.value for reading in read_table(text, STATES).values()] == [fmpq(1, 5)] * 2


@pytest.mark.parametrize("text", ["up: 2/3, others: 1/6", "up = 2/3, all others = 1/6", "up: 2/3; the rest: 1/6",
                                  "up 2/3, others 1/6", "up: 2/3, others: 1/6, goal: 0"])  # fmt: skip
def test_what_is_not_named_is_the_rest(text: str) -> None:
    read = read_table(text, ["left", "up", "right"], ends=["goal"])
    assert [reading.value for reading in read.values()] == [fmpq(1, 6), fmpq(2, 3), fmpq(1, 6)]


def test_the_rest_needs_something_before_it_and_may_be_a_name() -> None:
    with pytest.raises(Unreadable):
        read_table("others: 1/6", ["left", "up"])
    assert [each.value for each in read_table("up: 1, rest: 2", ["up", "rest"]).values()] == [1, 2]


@pytest.mark.parametrize(
    "text",
    ["-2, 3; 4, 6", "[-2, 3; 4, 6]", "cool: -2, 3; warm: 4, 6", "fast: -2, 4\nslow: 3, 6",
     r"\begin{pmatrix} -2 & 3 \\ 4 & 6 \end{pmatrix}", "Q(cool, fast) <- -2, Q(cool, slow) <- 3, warm fast: 4, "
     "warm slow: 6"],
)  # fmt: skip
def test_a_row_for_each_state(text: str) -> None:
    assert [reading.value for reading in read_table(text, PAIRS).values()] == [-2, 3, 4, 6]


@pytest.mark.parametrize("text", ["-2,3; 4", "cool: -2,3; warm: 4,6", "cool: 1, 2, 3; warm: 4"])
def test_rows_whose_commas_may_be_decimal_or_of_another_length_are_none(text: str) -> None:
    with pytest.raises(Unreadable):
        read_table(text, PAIRS)


@pytest.mark.parametrize(
    "text", ["J11 = 1, J12 = 2, J21 = 3, J22 = 4", "J_{12} = 2; J_{11} = 1; J_{22} = 4; J_{21} = 3",
             "a_11: 1\na_12: 2\na_21: 3\na_22: 4", "A[1,1] = 1, A[1,2] = 2, A[2,1] = 6/2 = 3, A[2,2] = 4"]
)  # fmt: skip
def test_the_entries_of_a_matrix_by_their_indices(text: str) -> None:
    assert [[each and each.value for each in row] for row in read_matrix(text, (2, 2))] == [[1, 2], [3, 4]]


def test_entries_by_their_indices_may_be_as_long_as_in_rows() -> None:
    entry = "sqrt(6)/4 + sqrt(2)/4"
    named = read_matrix(", ".join(f"R{i}{j} = {entry}" for i in (1, 2, 3) for j in (1, 2, 3)), (3, 3))
    assert named == read_matrix("; ".join([", ".join([entry] * 3)] * 3), (3, 3))


@pytest.mark.parametrize("text", ["J11 = 1, J12 = 2, J21 = 3", "J11 = 1, J11 = 2, J21 = 3, J22 = 4", "x = 5, v = 1"])
def test_entries_of_a_matrix_that_are_not_all_there(text: str) -> None:
    with pytest.raises(Unreadable):
        read_matrix(text, (2, 2))


@pytest.mark.parametrize("text", ["50, 30, 20 %", "50; 30; 20%"])
def test_percent_behind_the_last_number_alone_may_be_meant_of_all(text: str) -> None:
    with pytest.raises(Unreadable, match="behind the last number alone"):
        read_vector(text, 3)
    with pytest.raises(Unreadable, match="behind the last number alone"):
        read_table(text, ["a", "b", "c"])
    with pytest.raises(Unreadable, match="behind the last number alone"):
        read_table("c: 50, a: 30, b: 20 %", ["a", "b", "c"])


def test_percent_behind_each_or_among_parts_of_one() -> None:
    for text in ("50%, 30%, 20%", "0.5, 0.3, 20%", "0.5, 30%, 20%"):
        assert [each and each.value for each in read_vector(text, 3)] == [fmpq(1, 2), fmpq(3, 10), fmpq(1, 5)]


@pytest.mark.parametrize("text", ["green", "the green arm", "arm green", "green (4)", "Green!", "a = the green arm"])
def test_words_around_a_single_choice(text: str) -> None:
    kind = answer_kind(Policy({"next": ("green", "red")}, of=""))
    assert kind.read(text, Allowed()) == {"next": ("green",)}


@pytest.mark.parametrize("text", ["arm 2", "the arm 2", "The arm 2!", "next = the arm 2"])
def test_a_word_around_a_choice_may_be_a_part_of_its_name(text: str) -> None:
    kind = answer_kind(Policy({"next": ("arm 1", "arm 2")}, of=""))
    assert kind.read(text, Allowed()) == {"next": ("arm 2",)}
    assert read_choice(text.removeprefix("next = "), {"A": "arm 1", "B": "arm 2"}) == "B"


@pytest.mark.parametrize("text", ["not green", "not the green arm", "the arm", "green (red)"])
def test_what_names_no_choice(text: str) -> None:
    with pytest.raises(Unreadable):
        answer_kind(Policy({"next": ("green", "red")}, of="")).read(text, Allowed())


@pytest.mark.parametrize("text", ["model A", "the large model", "Large!", "the model A"])
def test_words_around_an_option(text: str) -> None:
    assert read_choice(text, {"A": "large", "B": "small"}) == "A"


def test_yes_and_no_in_other_words() -> None:
    assert [read_yes_no(text) for text in ("correct", "wahr", "vrai", "✓", "да")] == [True] * 5
    assert [read_yes_no(text) for text in ("incorrect", "falsch", "faux", "✗", "нет")] == [False] * 5


@pytest.mark.parametrize("text", ["0.2" + " " * 1900 + "x", "always " * 280, "0.2" + " (" * 900, "in all " * 280])
def test_what_may_be_said_of_all_takes_no_time_to_look_for(text: str) -> None:
    with at_once(), pytest.raises(Unreadable):
        read_table(text, STATES)


#: The racing car of the README: V₂(cool) = 7/2 by fast, V₂(warm) = 5/2 by slow.
CAR = rldrill.load(Path(__file__).parents[2] / "examples" / "racing-car.toml")


@pytest.mark.parametrize(
    "text",
    ["cool: 3.5 (fast), warm: 2.5 (slow)", "7/2 (fast); 5/2 (slow)", "V(cool) = 3.5 (fast)\nV(warm) = 2.5 (slow)",
     "= 1 + 5/2 = 3.5; = 1 + 3/2 = 2.5", "1/2*(2 + 2) + 3/2 = 3.5, (1 + 4)/2 = 2.5"],
)  # fmt: skip
def test_the_action_behind_a_value_and_the_working_before_it(text: str) -> None:
    assert CAR.check(text, "a").outcome.value == "right"


@pytest.mark.parametrize("text", ["cool: 3.5 (fast) 2, warm: 2.5", "(fast): 3.5, (slow): 2.5", "1 + 1 = 3.5, 2.5"])
def test_what_is_neither_an_action_behind_a_value_nor_its_working(text: str) -> None:
    assert CAR.check(text, "a").outcome.value == "unreadable"


def test_a_working_of_the_one_value_that_is_asked_for() -> None:
    assert [each.value for each in read_table("= 4 + 0.5*(0 - 2) = 3", ["floor"]).values()] == [3]
    assert [each.value for each in read_table("1 = 2, 2 = 3", ["1", "2"]).values()] == [2, 3]


@pytest.mark.parametrize("text", ["slow in all three states", "Slow for every state.", "in all 3: slow"])
def test_how_many_there_are_may_be_said(text: str) -> None:
    actions = dict.fromkeys(("cool", "warm", "hot"), ("fast", "slow"))
    assert read_words(text, tuple(actions), actions) == dict.fromkeys(actions, ("slow",))


@pytest.mark.parametrize("text", ["slow in all two states", "slow in all four", "slow in three states", "slow in both"])
def test_another_number_of_them_is_not_all(text: str) -> None:
    actions = dict.fromkeys(("cool", "warm", "hot"), ("fast", "slow"))
    with pytest.raises(Unreadable):
        read_words(text, tuple(actions), actions)


@pytest.mark.parametrize(
    "text", ["cool: fast -2, slow 3; warm: fast 4, slow 6", "cool: slow 3, fast -2; warm: slow 6, fast 4", "-2,3;4,6"]
)
def test_rows_of_a_table_may_name_their_entries(text: str) -> None:
    keys = [(state, action) for state in ("cool", "warm") for action in ("fast", "slow")]
    assert [reading.value for reading in read_table(text, keys).values()] == [-2, 3, 4, 6]


def test_decimal_commas_of_two_values_are_told() -> None:
    with pytest.raises(Unreadable, match="decimal comma"):
        read_table("8,10;8,4", ["cool", "warm"])


@pytest.mark.parametrize("text", ["C1 = 0, C2 = 3", "c_2: 3; c_1: 0", "C[1] = 0\nC[2] = 3"])
def test_a_column_may_be_typed_entry_by_entry(text: str) -> None:
    assert [[entry and entry.value for entry in row] for row in read_matrix(text, (2, 1))] == [[0], [3]]


@pytest.mark.parametrize("text", ["C1 = 0, D2 = 3", "C1 = 0, C3 = 3", "C1 = 0, C1 = 3"])
def test_entries_of_other_names_are_no_column(text: str) -> None:
    with pytest.raises(Unreadable):
        read_matrix(text, (2, 1))


@pytest.mark.parametrize("text", ["bellman equation for V^pi", "the Bellman equation for V_pi", "$V^{pi}$"])
def test_pi_may_be_typed_in_the_name_of_an_option(text: str) -> None:
    options = {"A": "the Bellman equation for $V^π$", "B": "the Bellman equation for $V^*$", "C": "TD(0)"}
    assert read_choice(text, options) == "A"


@pytest.mark.parametrize("text", ["G1 = 2, G0 = 3", "R_1 = 2, R_0 = 3", "G_0: 3; G_1: 2"])
def test_entries_have_the_names_of_any_course(text: str) -> None:
    read = answer_kind(Numbers(("R_0", "R_1"))).read(text, Allowed())
    assert [cell.value for cell in read.values()] == [3, 2]  # type: ignore[union-attr]


@pytest.mark.parametrize("text", ["G2 = 2, G1 = 3", "H1 = 2, H0 = 3"])
def test_other_names_are_none_of_them(text: str) -> None:
    with pytest.raises(Unreadable):
        answer_kind(Numbers(("R_0", "R_1"))).read(text, Allowed())


@pytest.mark.parametrize(
    "text",
    ["right right exit\nup # up", "→ → e\n↑ # ↑", "> > exit; ^ # ^", "right right exit | up # up",
     "right right exit; up up"],
)  # fmt: skip
def test_a_policy_of_a_grid_may_stand_on_one_line(text: str) -> None:
    moves = ("up", "right", "down", "left")
    cells = {"r1c1": moves, "r1c2": moves, "r1c3": ("exit",), "r2c1": moves, "r2c3": moves}
    read = read_words(text, tuple(cells), cells, ["over"])
    assert [action for (action,) in read.values()] == ["right", "right", "exit", "up", "up"]


def test_rows_of_arrows_may_stand_on_one_line() -> None:
    moves = dict.fromkeys(("r1c1", "r1c2", "r2c1"), ("up", "right", "down", "left"))
    assert [*read_words(">> ^G", tuple(moves), moves, ["r2c2"]).values()] == [("right",), ("right",), ("up",)]


@pytest.mark.parametrize("text", ["up left/right up", "up down; left", "up up up up; up"])
def test_words_of_another_number_are_no_rows(text: str) -> None:
    moves = dict.fromkeys(("r1c1", "r1c2", "r2c1", "r2c2"), ("up", "right", "down", "left"))
    with pytest.raises(Unreadable):
        read_words(text, tuple(moves), moves)


def test_a_belief_may_stand_in_angles() -> None:
    assert [reading.value for reading in read_table("<1/4, 3/4>", STATES).values()] == [fmpq(1, 4), fmpq(3, 4)]
