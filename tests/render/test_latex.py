"""LaTeX that every engine reads: it has no sign that only Unicode has."""

from rldrill.problems.mathematics import Fence, Glyph, Row, Script, mathematics
from rldrill.render.mathematics.latex import latex, latex_plain, latex_typed, typed
from rldrill.render.pictures.scene import Curve, Scene
from rldrill.render.pictures.tikz import drawn


def test_what_only_unicode_has_is_spelled_and_what_everybody_has_is_not() -> None:
    assert typed(r"V^\pi(s)≤2") == r"V^\pi(s){\ensuremath{\le}}2"
    assert latex_typed(mathematics("γ V(s) ≤ α")).isascii()


def test_a_word_has_a_space_beside_what_follows_and_an_operator_its_own() -> None:
    letter, word = Glyph("a", "variable"), Glyph("if", "word")
    assert latex(mathematics('"step" 1')) == r"\text{step} \ 1"
    assert latex(Row((word, letter))) == r"\text{if} \ a"
    assert latex(Row((Glyph("ln", "word"), letter))) == r"\ln a"
    assert latex(mathematics('"cool"(s)')) == r"\text{cool} (s)"


def test_raised_and_lowered_signs_of_a_sentence_are_mathematics() -> None:
    assert latex_plain("r₁ ≤ 2γ") == r"r\ensuremath{_1} \ensuremath{\le} 2\ensuremath{\gamma}"


def test_a_quadratic_curve_is_the_cubic_one_that_tikz_draws() -> None:
    # both ends two thirds of the way to the control point: (2, 4) from (0, 0) and (4, 4) from (6, 0)
    assert "(0.00,0.00) .. controls (2.00,4.00) and (4.00,4.00) .. (6.00,0.00)" in drawn(
        Scene((Curve((0, 0), (3, 6), (6, 0)),))
    )


def test_brackets_grow_only_around_what_is_tall() -> None:
    """``\\left`` leaves a space before itself, which no V(s) has."""
    assert latex(mathematics("V(s)")) == "V (s)"
    assert latex(mathematics("‖w‖")) == r"\Vert w \Vert"
    assert latex(mathematics("|A|")) == "| A |"
    assert latex(mathematics("(1/2)^2")) == r"{\left( \frac{1}{2} \right)}^{2}"
    assert latex(Fence(Glyph("a", "variable"), "{", "}")) == r"\{ a \}"
    assert latex(Fence(Glyph("a", "variable"), "{", "")) == r"\{ a "


def test_an_index_that_belongs_to_a_letter_is_one_in_latex() -> None:
    assert latex(mathematics("π₁")) == r"\pi_{1}"
    assert latex(mathematics("s₁′")) == "s'_{1}"
    assert latex(mathematics("s₁^2")) == "s_{1}^{2}"
    assert latex(Script(Glyph("μ₂", "variable"), Glyph("t", "variable"))) == r"\mu_{2 , t}"
