"""Which letters are keys, and which may begin an answer."""

import pytest

import rldrill
from rldrill.problems.parts import Choice, Number, Policy
from rldrill.quiz.keys import alone, command


def test_a_letter_with_which_a_late_answer_may_begin_needs_its_enter() -> None:
    loop = [["cool", "fast", "warm", 1, 4], ["cool", "slow", "cool", 1, 1], ["warm", "slow", "cool", 1, 1]]
    mdp = rldrill.read({"family": "optimal-value", "given": {"mdp": {"transitions": loop}, "gamma": "1/2"}})
    number = rldrill.read({"family": "return", "given": {"gamma": "1/2", "rewards": [1, 4], "time": 1}})
    assert alone("pwvq", mdp) == "pvq"  # warm is a state
    assert alone("pwvq", number) == "pwvq"


NUMBER = rldrill.load("td-zero/1/7")


@pytest.mark.parametrize(
    ("text", "key"),
    [
        ("s", "s"), ("S", "s"), ("skip", "s"), ("Working", "w"), ("my", "m"), ("?", "?"), ("help", "?"), (":s", "s"),
        (":Quit", "q"), (":x", ":x"), ("3/4", "3/4"),
    ],
)  # fmt: skip
def test_what_is_typed_is_a_key_or_an_answer(text: str, key: str) -> None:
    assert command(text, NUMBER, Number()) == key


def test_a_word_that_is_an_answer_here_is_no_key_unless_a_colon_says_so() -> None:
    policy, choice = Policy({"a": ("skip", "Hint")}, "π"), Choice({"Skip": "this", "B": "that"})
    for kind in (policy, choice):
        assert command("Skip", NUMBER, kind) == "Skip"
        assert command(":skip", NUMBER, kind) == "s"
        assert command("quit", NUMBER, kind) == "q"
    assert command("hint", NUMBER, policy) == "hint"
    assert command("hint", NUMBER, choice) == "h"


def test_a_letter_that_is_left_open_is_an_answer() -> None:
    rows = [["a", "go", "a", 1, 4], ["a", "end", "b", 1, 1]]
    given = {"mdp": {"transitions": rows, "terminal": ["b"]}, "policy": {"a": {"go": "p", "end": "1-p"}}}
    letter = rldrill.read({"family": "policy-value", "given": given | {"gamma": "1/2"}})
    assert command("p", letter, Number()) == "p"
    assert command("P", letter, Number()) == "P"
    assert command(":p", letter, Number()) == "p"
    assert command("P", NUMBER, Number()) == "p"
