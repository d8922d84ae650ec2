"""Which letters are keys, and which may begin an answer."""

import rldrill
from rldrill.quiz.keys import alone


def test_a_letter_with_which_a_late_answer_may_begin_needs_its_enter() -> None:
    loop = [["cool", "fast", "warm", 1, 4], ["cool", "slow", "cool", 1, 1], ["warm", "slow", "cool", 1, 1]]
    mdp = rldrill.read({"family": "optimal-value", "given": {"mdp": {"transitions": loop}, "gamma": "1/2"}})
    number = rldrill.read({"family": "return", "given": {"gamma": "1/2", "rewards": [1, 4], "time": 1}})
    assert alone("pwvq", mdp) == "pvq"  # warm is a state
    assert alone("pwvq", number) == "pwvq"
