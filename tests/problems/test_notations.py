"""Other notations, held against how their books print the formulas."""

import pytest

import rldrill
from rldrill.problems.document import Paragraph
from rldrill.problems.errors import UsageError
from rldrill.problems.notations import in_use, notations, used
from rldrill.render.unicode import unicode_text
from rldrill.solutions.sheet import formulas


def text_in(notation: str, text: str) -> str:
    with used(notation):
        return unicode_text(Paragraph(text))


@pytest.mark.parametrize(
    ("lecture", "book"),
    [
        ("$R_t = r_{t+1} + γ R_{t+1}$", "Gₜ = Rₜ₊₁ + γGₜ₊₁"),  # equation 3.9
        ("$R_0^{(3)}$", "G₀⁽³⁾"),  # which the book writes G₀:₃
        ("$R_t^{(n)}$", "Gₜ⁽ⁿ⁾"),
        ("$V^π(s)$", "v_π(s)"),  # section 3.5
        ("$Q^*(s, a)$", "q_*(s, a)"),  # section 3.6
        ("$P_{s s'}^a (R_{s s'}^a + γ V^π(s'))$", "p(s′|s, a)(r(s, a, s′) + γv_π(s′))"),  # equations 3.4 and 3.6
        ("$V(s_t)$", "V(Sₜ)"),  # equation 6.2
        ("$s_{t+1} = A_t s_t + B_t a_t$", "sₜ₊₁ = Aₜsₜ + Bₜaₜ"),  # a matrix stays one
        ("$a_t^⊤ R_t a_t$", "aₜᵀRₜaₜ"),
    ],
)
def test_sutton_and_barto(lecture: str, book: str) -> None:
    assert text_in("sutton-barto", lecture) == book


@pytest.mark.parametrize(
    ("lecture", "control"),
    [("$s_{t+1} = A_t s_t + B_t a_t$", "xₜ₊₁ = Aₜxₜ + Bₜuₜ"), ("$a_t = −L_t s_t$", "uₜ = −Kₜxₜ"), ("$V(s')$", "V(x′)")],
)
def test_optimal_control(lecture: str, control: str) -> None:
    assert text_in("control", lecture) == control


@pytest.mark.parametrize("name", notations())
def test_an_equation_is_rewritten_once_however_often_it_is_taken_up(name: str) -> None:
    with used(name):
        for formula in formulas().values():
            equation = formula.equation()
            again = type(equation)(equation.left, equation.rights, equation.signs, equation.label, equation.notation)
            assert again == equation


def test_the_lectures_notation_is_untouched() -> None:
    assert in_use() == "lecture"
    exercise = rldrill.load("td-zero/1/1")
    before = str(exercise.hint())
    with used("sutton-barto"):
        assert str(exercise.hint()) != before
    assert str(exercise.hint()) == before


def test_names_and_answers_stay() -> None:
    with used("control"):
        exercise = rldrill.load("td-zero/2/7")
        assert exercise.id == "td-zero/2/7@" + str(exercise.id).partition("@")[2]
        assert exercise.check("10, -9, -21/5").accepted


def test_an_unknown_notation_is_said() -> None:
    with (
        pytest.raises(UsageError, match="There is no notation 'bertsekas'; there are lecture, sutton-barto, control"),
        used("bertsekas"),
    ):
        pass
