"""Parts are lettered in their order."""

from string import ascii_lowercase

import pytest

from rldrill.problems.parts import Number, Part, label, lettered


def test_parts_have_the_letters_of_the_alphabet() -> None:
    parts = lettered([Part("?", Number())] * 26)
    assert "".join(part.label for part in parts) == ascii_lowercase


def test_no_problem_has_more_parts_than_there_are_letters() -> None:
    with pytest.raises(ValueError, match="at most 26 parts"):
        label(26)
