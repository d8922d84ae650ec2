"""Long equations are broken before their signs, and nothing is lost."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rldrill.problems.mathematics import Glyph, Math, Row, mathematics
from rldrill.render.mathematics.breaking import broken
from rldrill.render.mathematics.unicode import unicode


def wide(math: Math, further: bool) -> int:
    return len(unicode(math)) + (1 if further else 0)


def lines(text: str, most: int) -> list[str]:
    return [unicode(line).strip() for line in broken(mathematics(text), wide, most)]


def test_what_fits_stays_in_one_piece() -> None:
    assert lines("a + b − c", 9) == ["a + b − c"]


@pytest.mark.parametrize(
    ("text", "most", "expected"),
    [
        ("a + b − c", 8, ["a + b", "−c"]),
        ("a + b − c", 4, ["a", "+b", "−c"]),
        ("−a + b", 5, ["−a", "+b"]),  # the first sign stays with its term
        ("a·(−b) + c", 7, ["a·(−b)", "+c"]),  # as does the sign of a factor
    ],
)
def test_lines_begin_with_the_signs_of_terms(text: str, most: int, expected: list[str]) -> None:
    assert lines(text, most) == expected


def test_relations_come_first() -> None:
    assert lines("x = a + b ≈ 3", 9) == ["x = a + b", "≈ 3"]


def test_a_long_term_is_broken_between_its_factors() -> None:
    assert lines("a + bbbb·(c + d)·(e + f)", 14) == ["a", "+bbbb·(c + d)", "·(e + f)"]


@given(st.lists(st.sampled_from("ab+−·3"), min_size=1, max_size=20), st.integers(1, 30))
def test_nothing_is_lost_and_lines_fit_where_they_can(signs: list[str], most: int) -> None:
    items = tuple(Glyph(sign, "operator" if sign in "+−·" else "variable") for sign in signs)
    parts = broken(Row(items), wide, most)
    assert [item for part in parts for item in (part.items if isinstance(part, Row) else ())] == list(items)
    whole = wide(Row(items), False)
    assert (len(parts) == 1) or whole > most
