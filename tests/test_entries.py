"""The entries of a vector are called what the question calls them, wherever something is said of them."""

from pathlib import Path

import rldrill
from rldrill.entries import by_name
from rldrill.export.asked import wrong_answers
from rldrill.grading.verification import verify
from rldrill.problems.parts import Number, Numbers

#: A robot at 0 ± 1 moves by −2 with the variance 5 of noise, to −2 ± 6; seen at −3 with 3, K = 2/3: −8/3 ± 2.
KALMAN = "kalman-filter/2/1"


def test_an_entry_is_called_what_the_question_calls_it() -> None:
    deltas = Numbers(("δ_0", "δ_1"))
    assert by_name("Not right at entry 2; the rest is right.", deltas) == "Not right at δ₁; the rest is right."
    assert by_name("Not right at entry 2.", Number()) == "Not right at entry 2."
    assert by_name("entry 3: 'x' is not understood.", deltas) == "entry 3: 'x' is not understood."  # two are asked for


def test_reports_call_it_so(tmp_path: Path) -> None:
    path = tmp_path / "answers.csv"
    path.write_text(f'student,problem,part,answer\nAnn,{KALMAN},a,"6, -2"\nAnn,{KALMAN},b,"-8/3, 3"\n')
    exchanged, wrong, _ = verify([path]).parts
    assert exchanged.judged.reason == "Not right. It looks as if the answers for μ̄₁ and Σ̄₁ are exchanged."
    assert wrong.judged.reason.startswith("Not right at Σ₁; the rest is right.")


def test_pages_for_other_programs_call_it_so() -> None:
    exercise = rldrill.load(KALMAN)
    said = [wrong.says for part in exercise.parts for wrong in wrong_answers(exercise, part)]
    assert any("μ₁" in says for says in said)
    assert not any("entry" in says for says in said)
