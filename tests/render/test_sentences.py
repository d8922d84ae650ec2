"""Plain sentences that name quantities, in other courses' letters."""

import pytest

import rldrill
from rldrill.exam.blueprint import Blueprint, Entry
from rldrill.exam.planning import plan
from rldrill.print.key import key_source
from rldrill.problems.notations import used
from rldrill.render.sentences import in_letters


@pytest.mark.parametrize(
    ("notation", "sentence", "wanted"),
    [
        ("sutton-barto", "minus the baseline: Rₜ − b(sₜ).", "minus the baseline: Gₜ − b(Sₜ)."),
        ("sutton-barto", "begins with the reward rₜ₊₁, not with r₁.", "begins with the reward Rₜ₊₁, not with R₁."),
        ("sutton-barto", "Q^π(s, π′(s)) and V* take a step.", "q_π(s, π′(s)) and v_* take a step."),
        ("sutton-barto", "R is a variance; so is Rₜ = sᵀPs.", "R is a variance; so is Rₜ = sᵀPs."),
        ("control", "A reward is −(sᵀQs + aᵀRa).", "A reward is −(xᵀQx + uᵀRu)."),
        ("control", "The next state is A s + B a, with s̄ and ā.", "The next state is A x + B u, with x̄ and ū."),
        ("control", "A − BL and Lₜ: a gain, the state's.", "A − BK and Kₜ: a gain, the state's."),
        ("control", "From s to s′ with π(a|s′), as Qₐₐ⁻¹ Qₐ.", "From x to x′ with π(u|x′), as Qᵤᵤ⁻¹ Qᵤ."),
        ("control", "A good action has a positive advantage.", "A good action has a positive advantage."),
        ("lecture", "Rₜ − b(sₜ) and sᵀQs", "Rₜ − b(sₜ) and sᵀQs"),
    ],
)  # fmt: skip
def test_letters_are_those_of_the_notation(notation: str, sentence: str, wanted: str) -> None:
    with used(notation):
        assert in_letters(sentence) == wanted


#: From 2 the action is −1·2: the reward is −(1·2² + 3·(−2)²) = −16, and the cost 16 a typical mistake.
COST = {"family": "lqr-reward", "given": {"A": 1, "B": 1, "Q": 1, "R": 3, "start": 2, "horizon": 1, "L": 1}}


def test_verdicts_and_diagnoses_speak_in_them() -> None:
    exercise = rldrill.read(COST)
    assert exercise.check("16").says == "A reward is the cost with a minus sign: −(sᵀQs + aᵀRa)."
    with used("control"):
        says = exercise.check("16").says
        assert says == "A reward is the cost with a minus sign: −(xᵀQx + uᵀRu)."
        assert exercise.grade({"a": "16"})["a"].verdict.says == exercise.diagnose("16").sentence == says


def test_so_do_keys() -> None:
    blueprint = Blueprint(problems=(Entry(family="reinforce-baseline", level=1),), seed=3, notation="sutton-barto")
    exam = plan(blueprint)
    with used("sutton-barto"):
        source = key_source(exam, exam.versions[0])
    assert "Gₜ − b(Sₜ)" in source
    assert "Rₜ − b" not in source
