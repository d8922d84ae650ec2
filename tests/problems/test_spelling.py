"""The one spelling of typed signs: what becomes of them, what is refused, and where."""

import re

import pytest

from rldrill.problems.spelling import Source, Unreadable, quoted, respelled, spelled


@pytest.mark.parametrize(
    ("text", "position", "said"),
    [
        ("1 + 2٢", 4, "'2٢' mixes the digits of two scripts; write it in one."),
        ("x + 1₂", 4, "'1₂' has a lowered digit; write all digits of a number on one line."),
        ("0·25", 0, "'0·25' may be '0.25' or 0 times '25'; write '0.25' or 0."),
        ("3\u200b", 1, "It holds an invisible character (U+200B); retype it."),
        ("ab\u202ec", 2, "It holds an invisible character (U+202E); retype it."),
        ("2 ¹⁄₄", 2, "Is '¹⁄₄' added or a factor? Write + or * before 1/4."),
        ("x" * 11, 10, "It is longer than 10 characters; shorten it."),
    ],
)
def test_what_is_refused_and_where(text: str, position: int, said: str) -> None:
    with pytest.raises(Unreadable) as refused:
        respelled(text, 10)
    assert (refused.value.message, refused.value.position) == (said, position)


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("  x − y ", "x - y"), ("２＋３", "2+3"), ("٣", "3"), ("a × b", "a * b"), ("¹⁄₄", "(1/4)"),
        ("1 + ³⁄₁₀", "1 + (3/10)"),
        ("①", "①"), ("x" * 10, "x" * 10),
    ],
)  # fmt: skip
def test_one_spelling(text: str, plain: str) -> None:
    assert respelled(text, 10).text == plain


def test_a_piece_knows_where_it_was_typed() -> None:
    source = Source("  ab, (c, d) ,e", 5)
    pieces = source.split(",")
    assert [(piece.text, piece.start) for piece in pieces] == [("ab", 7), ("(c, d)", 11), ("e", 19)]
    assert source.has(",")
    assert not Source("(a, b)").has(",")
    assert [piece.text for piece in Source("a,,b,").split(",")] == ["a", "", "b", ""]
    assert [index for index, _ in Source("a(b)c").outside()] == [0, 1, 3, 4]
    assert [index for index, _ in Source("a)b").outside()] == [0, 1, 2]


@pytest.mark.parametrize(
    ("text", "inside"),
    [
        ("(a)", "a"),
        ("[ a b ]", "a b"),
        ("()", ""),
        ("(a)(b)", None),
        ("(a", None),
        ("(", None),
        ("a", None),
        ("(a]", None),
    ],
)
def test_what_stands_in_brackets(text: str, inside: str | None) -> None:
    found = Source(text).unwrapped()
    assert (found.text if found else None) == inside


def test_a_piece_that_is_replaced_stays_in_its_column() -> None:
    source = Source("a ≈ b", 3).replaced(re.compile("≈"), lambda _: "about")
    assert source.text == "a about b"
    assert [source.column(index) for index in range(10)] == [3, 4, 5, 5, 5, 5, 5, 6, 7, 8]
    assert source.part(8, 9).column(0) == 7
    untouched = Source("a")
    assert untouched.replaced(re.compile("b"), lambda _: "c") is untouched


def test_quotes_and_names() -> None:
    assert quoted("a  b\nc") == "'a b c'"
    assert quoted("x" * 40) == f"'{'x' * 40}'"
    assert quoted("x" * 41) == f"'{'x' * 39}…'"
    assert spelled("  very\n cool −") == "very cool -"
