"""Hints are a ladder: the formula, its symbols, the first line with the numbers in, and then what comes out of it."""

import rldrill
from rldrill.exercise import Exercise
from rldrill.problems.document import Paragraph
from rldrill.quiz.hints import ladder
from rldrill.render.terminal import plain


def rungs(exercise: Exercise, label: str) -> list[str]:
    return [plain(rung.blocks) for rung in ladder(exercise, label)]


def test_the_first_line_has_the_numbers_in_and_the_next_one_what_comes_out() -> None:
    # R₁ = 4 and R₀ = 1 + 1/2·4 = 3.
    exercise = rldrill.read({"family": "return", "given": {"gamma": "1/2", "rewards": [1, 4], "time": 1}})
    formula, symbols, first, whole = rungs(exercise, "b")
    assert formula.strip() == "Rₜ = rₜ₊₁ + γRₜ₊₁"
    assert "γ = 1/2" in symbols
    assert first.split() == ["R₀", "=", "1", "+", "1/2·4"]
    assert whole.split() == ["R₀", "=", "1", "+", "1/2·4", "=", "3"]


def test_what_is_found_on_the_way_is_no_symbol_that_is_told_before() -> None:
    # H = 1·(−2)·1 − 3 = −5 is the first of the steps.
    matrices = {"A": [[1]], "B": [[1]], "R": [[3]], "P": [[-2]]}
    exercise = rldrill.read({"family": "lqr-gain", "given": matrices})
    _, symbols, *working = rungs(exercise, "a")
    assert "Rₜ" in symbols
    assert "Hₜ" not in symbols
    assert "−5" not in symbols
    assert "−5" in "".join(working)


def test_states_that_a_sum_runs_over_are_no_symbol_to_tell() -> None:
    # d(a) = d(b) and d(b) = d(a): every state is reached from the other one.
    mdp = {"transitions": [["a", "go", "b", 1, 2], ["b", "go", "a", 1, 4]]}
    exercise = rldrill.read({"family": "policy-value", "given": {"mdp": mdp, "average": True}})
    for part in exercise.parts:
        assert len(rungs(exercise, part.label)) > 1


def test_every_family_has_hints_to_every_part_and_sentences_stand_with_what_they_introduce() -> None:
    for name in rldrill.families():
        for level in (1, 2, 3):
            exercise = rldrill.draw(name, level, 5015)
            for part in exercise.parts:
                hints = ladder(exercise, part.label)
                assert hints
                working = [rung.blocks for rung in hints if rung.is_working]
                assert not any(isinstance(blocks[-1], Paragraph) for blocks in working[:-1])
