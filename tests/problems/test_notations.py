"""Other notations, held against how their books print the formulas."""

import re

import pytest

import rldrill
from rldrill.problems.document import Paragraph
from rldrill.problems.errors import UsageError
from rldrill.problems.notations import PLAIN, in_use, notations, used
from rldrill.quiz.shapes import how_to_type
from rldrill.render.html import Html
from rldrill.render.markdown import markdown_text
from rldrill.render.mathematics.typst import text as typst_text
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
        ("$R^{(i)}$", "G⁽ⁱ⁾"),
        ("$P_{s_t, s_{t+1}}^{a_t}$", "p(Sₜ₊₁|Sₜ, Aₜ)"),
        ("$V^π(s)$", "v_π(s)"),  # section 3.5
        ("$Q^*(s, a)$", "q_*(s, a)"),  # section 3.6
        ("$P_{s s'}^a (R_{s s'}^a + γ V^π(s'))$", "p(s′|s, a)(r(s, a, s′) + γv_π(s′))"),  # equations 3.4 and 3.6
        ("$V(s_t)$", "V(Sₜ)"),  # equation 6.2
        ("$R'_0 = r_1$", "G′₀ = R₁"),
        ("$s_t^{(i)}$", "Sₜ⁽ⁱ⁾"),
        ("$V̂^π(s_0)$", "v̂_π(S₀)"),
        ("$!R_t = r_{t+1} + V^π(s_t)$", "Rₜ = rₜ₊₁ + V^π(sₜ)"),  # what is to stay
        ("$s_{t+1} = A_t s_t + B_t a_t$", "sₜ₊₁ = Aₜsₜ + Bₜaₜ"),  # a matrix stays one
        ("$a_t^⊤ R_t a_t$", "aₜᵀRₜaₜ"),
    ],
)
def test_sutton_and_barto(lecture: str, book: str) -> None:
    assert text_in("sutton-barto", lecture) == book


@pytest.mark.parametrize(
    ("lecture", "control"),
    [
        ("$s_{t+1} = A_t s_t + B_t a_t$", "xₜ₊₁ = Aₜxₜ + Bₜuₜ"),
        ("$a_t = −L_t s_t$", "uₜ = −Kₜxₜ"),
        ("$V(s')$", "V(x′)"),
        ("$!a_t = −L_t s̄$", "aₜ = −Lₜs̄"),
    ],
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


def test_the_gain_alone_is_another_letter_in_optimal_control() -> None:
    with used("control"):
        told = {key: unicode_text(formula.equation()) for key, formula in formulas().items()}
    assert told["lqr-action"] == "uₜ = −Kₜxₜ"
    assert told["ppo"].startswith("Lₜ = ")
    assert "∇_θLᵢ(θ)" in told["maml-inner"]


def test_what_is_one_letter_of_a_linear_system_is_told_by_what_stands_around_it() -> None:
    """R_t = 3 is a matrix of costs there, s_0 = 2 a given state; a return and a random state elsewhere."""
    with used("sutton-barto"):
        system = rldrill.load("lqr-backward/2/1")
        told = [unicode_text(block) for block in system.question()]
        assert any(line.startswith("Rₜ = ") for line in told)
        assert any(line.startswith("s₀ = ") for line in told)
        assert not any(line.startswith(("Gₜ", "S₀")) for line in told)
        steps = [unicode_text(block) for block in rldrill.load("lqr-reward/2/1").working("b")]
        assert any(line.startswith("s₁ = ") for line in steps)


@pytest.mark.parametrize("family", ["lqr-backward", "lqr-gain", "lqr-infinite", "lqr-reward", "ddp-backward"])
@pytest.mark.parametrize("level", [1, 2, 3])
def test_what_is_asked_of_a_linear_system_keeps_its_states_and_actions(family: str, level: int) -> None:
    with used("sutton-barto"):
        for part in rldrill.draw(family, level, 3).parts:
            assert not re.search("[SARG][₀₁ₜ]", unicode_text(Paragraph(part.ask)))


def test_a_formula_in_a_working_is_rewritten_on_both_sides() -> None:
    with used("sutton-barto"):
        steps = [unicode_text(block) for block in rldrill.load("n-step-return/2/1").working("a")]
    assert any(line.startswith("Gₜ⁽ⁿ⁾ = ") for line in steps)
    assert not any(line.startswith("R") for line in steps)


@pytest.mark.parametrize("family", ["return", "policy-value", "q-learning", "n-step-return", "importance-sampling"])
def test_nothing_of_the_lectures_notation_is_left(family: str) -> None:
    with used("sutton-barto"):
        exercise = rldrill.load(f"{family}/2/1")
        every = [*exercise.question(), *(block for part in exercise.parts for block in exercise.working(part.label))]
        lines = "\n".join(map(unicode_text, (*every, *map(exercise.answer, exercise.parts))))
    assert not re.search(r"V\^|Q\^|Pₛₛ|Rₛₛ|\b[ras][ₜ₀₁₂]|R₀|R⁽", lines)


def test_the_lectures_notation_is_untouched() -> None:
    assert in_use() == PLAIN
    exercise = rldrill.load("td-zero/1/1")
    before = str(exercise.hint())
    with used("sutton-barto"):
        assert str(exercise.hint()) != before
    assert str(exercise.hint()) == before


def written(exercise: rldrill.Exercise) -> str:
    """Everything that is asked, hinted, worked out and answered."""
    blocks = [*exercise.question()]
    for part in exercise.parts:
        asked = (Paragraph(part.ask), exercise.answer(part))
        blocks += [*asked, *exercise.hint(part.label), *exercise.working(part.label)]
    return "\n".join(map(unicode_text, blocks))


ONE = {"states": ["s", "end"], "actions": ["a"], "rewards": [1], "terminal": ["end"]}
TWO = {"states": ["a", "u", "end"], "rewards": [1, 2], "terminal": ["end"]}


def test_the_names_of_states_and_actions_are_no_letters_of_a_notation() -> None:
    given = {"trajectory": ONE, "values": {"s": {"a": 1, "u": 0}}, "alpha": "1/2", "gamma": 1}
    with used("control"):
        exercise = rldrill.read({"family": "q-learning", "given": given})
        assert "Q(s, a)" in unicode_text(Paragraph(exercise.parts[0].ask))  # Q(x, u) is another action's
        assert "Q(s, a) ← 1 + 1/2·(1 + 1·0 − 1)" in written(exercise)
        given = {"trajectory": TWO, "values": {"a": 4, "u": 8}, "alpha": "1/2", "gamma": 1}
        told = written(rldrill.read({"family": "td-zero", "given": given}))
        assert "V(a) ← 4 + 1/2·(1 + 1·8 − 4)" in told
        assert "V(u) ← 8 + 1/2·(2 + 1·0 − 8)" in told


@pytest.mark.parametrize(
    ("notation", "id", "kept", "never"),
    [
        ("control", "optimal-value/3/3", ["The reward x of fast", "V*(warm) = 4", "Q*(s, a)"], r"x′|\(x, u\)"),
        ("control", "linear-value/3/1", ["its position, s = x", "Q̂(s, a) = θᵀf(s, a)"], r"φ\(x\)|x = x"),
        ("control", "linearise/3/1", ["x is the position of the cart", "s = (x, θ, v, ω)ᵀ and a = u"], r"f\(x, u\)"),
        ("control", "denavit-hartenberg/1/1", ["aᵢ", "Transₓ(aᵢ)"], "uᵢ"),
        ("control", "ppo-clip/2/5", ["uₜ = ρₜAₜ", "is called Lₜ", "π_θ(aₜ|sₜ)", "Lₜ = min(uₜ, cₜ)"], "K|uₜ[|]"),
        ("control", "maml-step/1/5", ["the loss L₁(θ)"], "K"),
        ("control", "model-fitting/1/1", ["the prior Beta(a, b)"], r"Beta\(u"),
        ("sutton-barto", "ppo-clip/1/3", ["Aₜ is the estimated advantage of the action aₜ"], "Sₜ"),
        ("sutton-barto", "importance-sampling/3/3", ["p is left open", "v̂_π(medium)"], r"V|p\("),
        ("sutton-barto", "lqr-backward/3/45", ["a₀ = 2/5", "Aₜ"], "A₀ = 2/5"),
        ("sutton-barto", "action-value/2/24", ["p = π(fast|warm)", "Pₛₛ′ᵃ"], r"p\(s′"),
    ],
)
def test_no_notation_takes_a_letter_of_the_problems_own(notation: str, id: str, kept: list[str], never: str) -> None:
    with used(notation):
        exercise = rldrill.load(id)
        told = written(exercise)
    assert not [each for each in kept if each not in told]
    assert not re.search(never, told)


def test_a_letter_left_open_is_typed_as_it_is_asked_for() -> None:
    with used("control"):
        exercise = rldrill.load("optimal-value/3/3")
        # V*(warm) = 4 = −2 + 1/2·V*(cool), so V*(cool) = 12 = x + 1/2·4
        assert "What is $!x$?" in exercise.parts[1].ask
        assert exercise.check("x = 10", "b").accepted


def test_a_question_that_was_seen_before_is_written_anew() -> None:
    exercise = rldrill.load("lqr-backward/2/6")
    assert "s₀ = 2" in written(exercise)
    with used("control"):
        assert "x₀ = 2" in written(exercise)
        assert "s₀" not in written(exercise)


def test_names_and_answers_stay() -> None:
    with used("control"):
        exercise = rldrill.load("td-zero/2/7")
        assert exercise.id == "td-zero/2/7@" + str(exercise.id).partition("@")[2]
        # V(medium) = 10 + 1/2·(8 + 6 − 10) = 12, V(high) = 12 + 1/2·(−3 + 6 − 12) = 15/2, 12 + 1/2·(−6 + 6 − 12) = 6
        assert exercise.check("6, 15/2").accepted


@pytest.mark.parametrize(
    ("text", "written"),
    [
        ("$V(s) = 0.5$", "V(s) = 0,5"),
        ("$−0.25, 3/4, 0.125…$", "−0,25; 3/4; 0,125…"),
        ("$(0.5, 1)$ and $Q(s, a) = 0.5$", "(0,5; 1) and Q(s, a) = 0,5"),
        ("$(3, 1)$ of about 13.86.", "(3, 1) of about 13,86."),
        ("on 26.11.2026, in v1.5 of 3.4.1", "on 26.11.2026, in v1.5 of 3.4.1"),
    ],
)
def test_decimal_commas(text: str, written: str) -> None:
    with used("lecture", ","):
        assert unicode_text(Paragraph(text)) == written


def test_decimal_commas_in_another_notation() -> None:
    with used("sutton-barto", ","):
        assert unicode_text(Paragraph("$r_{t+1} = 0.5$")) == "Rₜ₊₁ = 0,5"


def test_a_decimal_comma_takes_no_more_room_than_a_point() -> None:
    with used("lecture", ","):
        assert markdown_text("$0.25 x$") == "$0{,}25 x$"
        assert Html().text("$0.25$") == "<math><mn>0,25</mn></math>"
        assert typst_text("$0.25$") == r'#kept("0,25", $0 class("normal", \,) 25$)'


def test_an_unknown_notation_is_said() -> None:
    with (
        pytest.raises(UsageError, match="There is no notation 'bertsekas'; there are lecture, sutton-barto, control"),
        used("bertsekas"),
    ):
        pass


def test_entries_are_asked_for_and_read_by_their_names_in_the_notation() -> None:
    # G₄ = 4, G₃ = −4 + 4/2, G₂ = 8 − 2/2, G₁ = −3 + 7/2, G₀ = −2 + 1/4; R₁ is the first reward here.
    given = {"rewards": [-2, -3, 8, -4, 4], "gamma": "1/2"}
    with used("sutton-barto"):
        exercise = rldrill.read({"family": "return", "given": given})
        assert how_to_type(exercise.parts[0].kind).startswith("G₀, G₁, G₂, G₃, G₄ in this order")
        assert exercise.check("G4 = 4, G3 = -2, G2 = 7, G1 = 1/2, G0 = -7/4")
        assert exercise.check("G4 = 4, G3 = -2, G2 = 7, G1 = 1/2, G0 = 7/4").wrong_cells == ("entry 1",)
        first, second = exercise.follow(["R1 = -2", "G1 = 1/2"]).lines
        assert (first.standing, second.standing) == ("right", "right")
    assert rldrill.read({"family": "return", "given": given}).check("R4 = 4, R3 = -2, R2 = 7, R1 = 1/2, R0 = -7/4")
