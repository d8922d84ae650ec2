"""The notation between dollar signs: what it is read as, and what is refused."""

import pytest

from rldrill.problems.mathematics import (
    Accent,
    Big,
    Fence,
    Fraction,
    Math,
    Name,
    Root,
    Row,
    Script,
    listed,
    mathematics,
    name,
    number,
    operator,
    punctuation,
    relation,
    row,
    variable,
    word,
)

a, b, s, t = map(variable, "abst")
one, two = number(1), number(2)


@pytest.mark.parametrize(
    ("text", "read"),
    [
        ("|a| = 1", row(Fence(a, "|", "|"), relation("="), one)),
        ("2 = |a| + |b|", row(two, relation("="), Fence(a, "|", "|"), operator("+"), Fence(b, "|", "|"))),
        ("(a|b)", Fence(row(a, punctuation("|"), b))),
        ("a", a),
        ("ab", word("ab")),
        ("xy\u0304", Accent(word("xy"), "bar")),
        ("a b", row(a, b)),
        ('"a"', Name("a", "variable")),
        ('"A"', Name("A", "word")),
        ("A", variable("A")),
        ("√(a b)", Root(row(a, b))),
        ("√2", Root(two)),
        ("{a b}/{s}", Fraction(row(a, b), s)),
        ("∑_t a", row(Big("Σ", t), a)),
        ("dθ/dJ", row(variable("d"), variable("θ"), punctuation("/"), variable("d"), variable("J"))),
        ("dx", word("dx")),
        ('"smoking hot"', Name("smoking hot", "word")),
        ("s'", variable("s′")),
        ("s₁", variable("s₁")),
        ("12", number(12)),
        ("1/2", Fraction(one, two)),
        ("1.5", number("1.5")),
        ("-1", row(operator("−"), one)),
        ("a - b", row(a, operator("−"), b)),
        ("a * b", row(a, operator("·"), b)),
        ("a = b", row(a, relation("="), b)),
        ("a ≤ b", row(a, relation("≤"), b)),
        ("a, b", row(a, punctuation(","), b)),
        ("a|b", row(a, punctuation("|"), b)),
        ("(a)", Fence(a)),
        ("[a]", Fence(a, "[", "]")),
        ("‖a‖", Fence(a, "‖", "‖")),
        ("{a b}", row(a, b)),
        ("a_t", Script(a, t)),
        ("a^2", Script(a, above=two)),
        ("a_t^2", Script(a, t, two)),
        ("a^2_t", Script(a, t, two)),
        ("a_{t+1}", Script(a, row(t, operator("+"), one))),
        ("a^*", Script(a, above=operator("*"))),
        ("a_t^*", Script(a, t, operator("*"))),
        ("(a)_t", Script(Fence(a), t)),
        ("(a_t)^2", Script(Fence(Script(a, t)), above=two)),
        ("a_t_s", Script(Script(a, t), s)),
        ("_t", Script(word(""), t)),
        ("s^⊤", Script(s, above=word("T"))),
        ("a\u0302", Accent(a, "hat")),
        ("a\u0304_t", Script(Accent(a, "bar"), t)),
        ("a\u0303", Accent(a, "tilde")),
        ("", Row(())),
    ],
)
def test_what_is_read(text: str, read: Math) -> None:
    assert mathematics(text) == read


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("a_", "a script is missing"), ("a^", "a script is missing"), ("(a", r"'\)' is missing"),
        ("{a", "'}' is missing"), ("[a", r"'\]' is missing"), ("(a]", r"'\)' is missing"), ("‖a", "'‖' is missing"),
        ("a_{t", "'}' is missing"), ("√", "a script is missing"), ("∑", "a script is missing"),
    ],
)  # fmt: skip
def test_what_is_left_open(text: str, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        mathematics(text)


def test_lists_rows_names_and_numbers() -> None:
    assert listed([a, b, s]) == Row((a, punctuation(","), b, punctuation(","), s))
    assert listed([a, b], ";") == Row((a, punctuation(";"), b))
    assert listed([a]) == row(a) == a
    assert row(a, Row((b, s)), t) == Row((a, b, s, t))
    styles = {"s": "variable", "s₁": "variable", "s′": "variable", "ab": "word", "1a": "word", "s_1": "word"}
    assert [name(text) for text in styles] == [Name(*each) for each in styles.items()]
    assert name("s") != s  # which is a letter of the notation
    assert number("-3/4") == Row((operator("−"), Fraction(number(3), number(4))))
