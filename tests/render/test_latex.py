"""LaTeX that every engine reads: it has no sign that only Unicode has."""

from rldrill.problems.mathematics import mathematics
from rldrill.render.mathematics.latex import latex_plain, latex_typed, typed


def test_what_only_unicode_has_is_spelled_and_what_everybody_has_is_not() -> None:
    assert typed(r"V^\pi(s)≤2") == r"V^\pi(s){\ensuremath{\le}}2"
    assert latex_typed(mathematics("γ V(s) ≤ α")).isascii()


def test_raised_and_lowered_signs_of_a_sentence_are_mathematics() -> None:
    assert latex_plain("r₁ ≤ 2γ") == r"r\ensuremath{_1} \ensuremath{\le} 2\ensuremath{\gamma}"
