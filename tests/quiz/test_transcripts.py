"""A whole quiz, line by line, in narrow and wide terminals and for those to whom it is read out."""

from pathlib import Path

import pytest

from rldrill.render.compact import WIDEST
from screens import WIDTHS, transcript

SCREENS = Path(__file__).parents[1] / "golden" / "screens"


@pytest.mark.parametrize("kind", WIDTHS)
def test_a_quiz_looks_as_it_did_when_it_was_looked_at(kind: str) -> None:
    expected = (SCREENS / f"{kind}.txt").read_text(encoding="utf-8")
    assert transcript(kind).splitlines() == expected.splitlines(), (
        "The screens of the quiz have changed. If that is meant, run 'python tests/golden/write.py return', and read "
        "the difference."
    )


@pytest.mark.parametrize("kind", WIDTHS)
def test_no_line_is_wider_than_the_terminal_or_than_is_read_well(kind: str) -> None:
    assert max(map(len, transcript(kind).splitlines())) <= min(WIDTHS[kind], WIDEST)


def test_what_is_read_out_is_ascii() -> None:
    assert transcript("plain").isascii()
