"""Answers in strange forms: read as they are meant, or refused; never as something else, and never with a crash."""

from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest
import sympy
from flint import fmpq

import rldrill
from rldrill.problems.errors import UsageError
from rldrill.solutions.answers.judging import Outcome, judge
from rldrill.solutions.answers.names import options_named
from rldrill.solutions.answers.rule import is_right
from rldrill.solutions.answers.text import Unreadable, read_number, read_table, read_words, read_yes_no
from rldrill.solutions.drawing import draw
from rldrill.solutions.exact import magnitude, order


def table(text: str, *keys: Any) -> list[str]:
    read = read_table(text, keys)
    return [str(read[key].value) for key in keys]


@pytest.mark.parametrize("states", [("(0,1)", "(2,1)"), ("0,1", "2,1"), ("0, 1", "2, 1")])
@pytest.mark.parametrize("typed", ["({0}, up): 3, ({1}, up): 4", "Q({0}, up) = 3; Q({1}, up) = 4"])
def test_states_may_be_named_by_their_coordinates(states: tuple[str, str], typed: str) -> None:
    pairs = [(state, action) for state in states for action in ("up", "down")]
    read = read_table(typed.format(*states), pairs)
    assert {key: str(reading.value) for key, reading in read.items()} == {pairs[0]: "3", pairs[2]: "4"}


def test_an_answer_as_data_is_read_back_with_such_names() -> None:
    moves = [["(0,1)", "(1,0)", "end", 1, 2], ["(0,1)", "(0,1)", "end", 1, 5]]
    exercise = rldrill.read(
        {"family": "optimal-value", "given": {"gamma": 1, "mdp": {"transitions": moves, "terminal": ["end"]}}}
    )
    for label, answer in exercise.answers().items():
        assert exercise.check(answer, label).accepted, label


@pytest.mark.parametrize("name", ["ca", "about", "approx", "circa", "roughly", "exactly"])
def test_a_state_may_be_called_about(name: str) -> None:
    assert table(f"{name}: 18/7, tx: 30/7", name, "tx") == ["18/7", "30/7"]


@pytest.mark.parametrize(
    "text",
    ["V(1) = 1 + 1 = 2\nV(2) = 2 + 1 = 3\nV(3) = 4", "1: 1 + 1/2 * 2 = 2, 2: 3, 3: 4", "1: 4 - 2 = 2, 3: 4, 2: 3",
     "(3) 4\n(1) 2\n(2) 3", "3) 4\n1) 2\n2) 3", "(1) 2\n(2) 3\n(3) 4"],
)  # fmt: skip
def test_states_called_by_numbers(text: str) -> None:
    assert {key: str(reading.value) for key, reading in read_table(text, ["3", "2", "1"]).items()} == {
        "1": "2",
        "2": "3",
        "3": "4",
    }


def test_states_called_by_letters_in_a_list() -> None:
    assert table("a) 3\nb) 5/2", "b", "a") == ["5/2", "3"]
    assert read_words("(a) left\n(b) right", ["b", "a"], {"a": ["left", "right"], "b": ["left", "right"]}) == {
        "b": ("right",), "a": ("left",),
    }  # fmt: skip


@pytest.mark.parametrize("text", ["+: 2/5, −: 3/5", "+ = 2/5; - = 3/5", "−: 3/5, +: 2/5"])
def test_hypotheses_may_be_called_by_signs(text: str) -> None:
    assert table(text, "+", "−") == ["2/5", "3/5"]


def test_states_may_be_called_by_arrows() -> None:
    assert table("→: 18/7, ←: 1", "→", "←") == ["18/7", "1"]


@pytest.mark.parametrize("text", [r"\left|-3\right|", r"\vert -3 \vert", r"$\left| -3 \right|$", "|-3|", "$|-3|$"])
def test_the_bars_of_an_absolute_value_are_not_lost(text: str) -> None:
    with pytest.raises(Unreadable):
        read_number(text)


@pytest.mark.parametrize("text", ["5.5\n-1", "5\n-1/2", "4\n+1/2", "(2)\n - 3"])
def test_two_numbers_on_two_lines_are_no_sum(text: str) -> None:
    with pytest.raises(Unreadable, match="a sum on one line"):
        read_number(text)


@pytest.mark.parametrize("text", ["5 +\n1", "3 - 1\n= 2", "V = 1/2 +\n 3"])
def test_a_sign_at_the_end_of_a_line_goes_on(text: str) -> None:
    assert str(read_number(text).value) in ("2", "6", "7/2")


@pytest.mark.parametrize("text", ["t.b.d.", "t.b.a.", "n.a.", "y.z"])
def test_an_abbreviation_is_neither_yes_nor_no(text: str) -> None:
    with pytest.raises(Unreadable):
        read_yes_no(text)


@pytest.mark.parametrize(("text", "yes"), [("yes. It is", True), ("No.", False), ("n. b", False), ("y.", True)])
def test_a_full_stop_ends_yes_and_no(text: str, yes: bool) -> None:
    assert read_yes_no(text) is yes


RETURN = {"family": "return", "given": {"rewards": [4, 1], "gamma": "1/2", "time": 0}}


@pytest.mark.parametrize(("text", "outcome"), [("R0 = 4.5\nR1 = 1", "unreadable"), ("R_0 = 4.5\nR_1 = 1", "unreadable"),
                                               ("R\N{SUBSCRIPT ZERO} = 4.5\nR\N{SUBSCRIPT ONE} = 1", "unreadable"),
                                               ("R1 = 1\nR0 = 4.5", "right")])  # fmt: skip
def test_of_two_lines_the_one_that_is_asked_for_is_last(text: str, outcome: str) -> None:
    assert rldrill.read(RETURN).check(text).outcome.value == outcome


@pytest.mark.parametrize(
    ("key", "typed", "cut"), [("2/3", "0.666", True), ("2/3", "0.6659", False), ("9/2", "4.49", False),
                              ("9/2", "4.4949", False), ("1999/1000", "1.99", True), ("-2/3", "-0.666", True)],
)  # fmt: skip
def test_digits_are_cut_off_where_they_are_the_keys_own(key: str, typed: str, cut: bool) -> None:
    exercise = rldrill.read({"family": "return", "given": {"rewards": [key], "gamma": 1, "time": 0}})
    assert ("cut off" in exercise.check(typed).says) is cut


@pytest.mark.parametrize(
    "text",
    ["1.005 + sqrt(pi^2+2pi+1)-pi-1", "1.005 + sqrt(2+2cos(1))-2cos(1/2)", "1.005 + sqrt(sin(2)+1)-sin(1)-cos(1)",
     "1.005+sqrt(2^(1/6)+3^(1/6)+2*2^(1/12)*3^(1/12))-2^(1/12)-3^(1/12)"],
)  # fmt: skip
def test_the_bound_is_included_where_nobody_can_tell(text: str) -> None:
    assert is_right(read_number(text).value, read_number("1").value)


@pytest.mark.parametrize("typed", ["→→\n,\n↑←↑", ",,\n→→\n↑↑↑", "→ → G\n, , ,\n↑ ← ←"])
def test_an_empty_row_of_a_grid_is_told(typed: str) -> None:
    mdp = {"grid": "..G\n...\n...", "rewards": {"G": 1}}
    exercise = rldrill.read({"family": "optimal-value", "given": {"gamma": "1/2", "mdp": mdp}})
    assert exercise.check(typed, "b").outcome is Outcome.UNREADABLE


@pytest.mark.parametrize("typed", ["a != gravel", "!= gravel", "not: gravel", "anything but: gravel", "a ≠ gravel"])
def test_what_is_ruled_out_is_not_chosen(typed: str) -> None:
    assert judge(draw("bandit", 1, 1), "b", typed).outcome is Outcome.UNREADABLE


@pytest.mark.parametrize("typed", ["gravel", "a: gravel", "a_7 = gravel", "The best arm: gravel"])
def test_a_choice_may_be_named(typed: str) -> None:
    assert judge(draw("bandit", 1, 1), "b", typed).outcome is Outcome.RIGHT


def test_names_are_the_same_however_their_accents_are_written() -> None:
    apart = "Ko\N{COMBINING DIAERESIS}ln"
    moves = [[apart, "go", "end", 1, 2], ["K\N{LATIN SMALL LETTER O WITH DIAERESIS}ln", "stay", "end", 1, 1]]
    exercise = rldrill.read(
        {"family": "optimal-value", "given": {"gamma": 1, "mdp": {"transitions": moves, "terminal": ["end"]}}}
    )
    assert exercise.check(f"{apart}: 2", "a").accepted
    assert options_named("go", ["go", "stay"]) == ["go"]


def test_a_number_of_five_thousand_digits_is_told() -> None:
    with pytest.raises(UsageError, match="more digits than anybody writes"):
        rldrill.read(RETURN).check(10**5000)


def test_an_exponent_of_five_thousand_digits_is_told() -> None:
    with pytest.raises(Unreadable, match="is too large"):
        read_number(f"1e{'9' * 5000}", longest=6000)


def test_two_threads_compare_at_their_own_precision() -> None:
    def compare(_: int) -> bool:
        apart = sympy.sqrt(2) - fmpq(1, 10**30)
        return order(apart, sympy.sqrt(2)) < 0 and magnitude(sympy.sqrt(10)) == 0

    with ThreadPoolExecutor(4) as pool:
        assert all(pool.map(compare, range(400)))


@pytest.mark.parametrize("typed", [
    "(0,0): (0,1) or (1,0)", "(0,1) or (1,0)", "(0,0): [(0,1), (1,0)]", "(0,0): (1, 0) / (0, 1)", "(0,0): (1,0)",
])  # fmt: skip
def test_names_that_are_places_of_a_grid_are_tied(typed: str) -> None:
    edges = [["(0,0)", "(0,1)", 1], ["(0,1)", "(1,1)", 1], ["(0,0)", "(1,0)", 1], ["(1,0)", "(1,1)", 1]]
    given = {"edges": edges, "start": "(0,0)", "goal": "(1,1)"}
    exercise = rldrill.read({"family": "principle-of-optimality", "given": given})
    assert exercise.check(typed, part="b").accepted
    assert exercise.grade(exercise.answers()).points == sum(part.points for part in exercise.parts)
