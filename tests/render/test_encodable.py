"""Texts where the encoding lacks signs: ASCII spellings, and never two names that become one."""

import pytest

from rldrill.problems.models import Model, state_diagram
from rldrill.problems.pictures import Timeline
from rldrill.render.encodable import UNICODE, Spelling

ASCII = Spelling("ascii")


@pytest.mark.parametrize(
    ("text", "spelled"),
    [
        ("$γ$", "gamma"),
        ("$γ V_2(s)$", "gamma V_2(s)"),
        ("$V_{12}(s')$", "V_12(s')"),
        ("$x^{-1}$", "x^-1"),
        ("$x^{k+1}$", "x^(k+1)"),
        ("$s_{t+1}$", "s_(t+1)"),
        ("$s ← 2 γ$", "s <- 2 gamma"),
        ("$π(a|s) ≤ 1/2$", "pi(a|s) <= 1/2"),
        ("$√2$", "sqrt(2)"),
        ("$θ̂$", "theta_hat"),
        ("$2 · 3$", "2*3"),
        ("half: ½, three dots: …", "half: 1/2, three dots: ..."),
        ("$2 γ$", "2 gamma"),
        ("$γ^2$", "gamma^2"),
        ("$α γ$", "alpha gamma"),
        ("$V^π(s)$", "V^pi(s)"),
        ("$γ λ δ_t$", "gamma lambda delta_t"),
        ("$Δ Λ$", "Delta Lambda"),
        ("$Σ_a π(a|s)$", "sum_a pi(a|s)"),
        ("$Σ_{i=1}^n x_i$", "sum_(i=1)^n x_i"),
        ("$2 Σ$", "2 Sigma"),
        ("ΣΣ_b", "Sigma Sigma_b"),
        ("2γ3", "2 gamma 3"),
        ("aγ", "a gamma"),
        ("$−3$", "-3"),
        ("$s ∈ S$", "s in S"),
        ("⠁⠂⡀⣀⣿⠀", "''..: "),
        ("→ ←", "-> <-"),
        ("日", "\\u65e5"),
    ],
)
def test_ascii_spellings(text: str, spelled: str) -> None:
    assert ASCII.inline(text) == spelled
    assert "?" not in spelled


def test_what_the_encoding_has_stays() -> None:
    assert Spelling("latin-1").plain("zürich²") == "zürich²"
    assert Spelling("cp1252").plain("zürich: γ") == "zürich: gamma"
    assert UNICODE.plain("α alpha s_1") == "α alpha s_1"


@pytest.mark.parametrize(
    ("one", "other"), [("α", "alpha"), ("s₁", "s_1"), ("zürich", "zurich"), ("Γ", "Gamma"), ("é", "è"), ("日", "月")]
)
def test_two_names_never_become_one(one: str, other: str) -> None:
    assert ASCII.inline(one).isascii()
    assert ASCII.inline(one) != ASCII.inline(other)
    assert ASCII.inline(f'$V("{one}")$') != ASCII.inline(f'$V("{other}")$')


def test_what_was_typed_keeps_its_names_where_nothing_is_like_them() -> None:
    assert ASCII.plain("alpha = 1") == "alpha = 1"
    assert ASCII.plain("α: 1, alpha: 2") == 'alpha: 1, "alpha": 2'


def test_the_labels_of_a_picture_are_spelled_before_they_are_placed() -> None:
    line = Timeline(("$t = 0$", "$t = 1$"), ("α", "γ"), (), ("$r_1 = 2$",), ended=True)
    assert ASCII.lines(line) == [
        "t = 0             t = 1",
        "o alpha --------> # gamma",
        "        r_1 = 2",
    ]


def test_a_state_diagram_is_drawn_with_plus_bar_and_minus() -> None:
    model = Model.model_validate({"transitions": [["α", "go", "end", 1, 2]], "terminal": ["end"]})
    assert ASCII.lines(state_diagram(model)) == ["o alpha", "+-* go --> # end  1, 2"]
