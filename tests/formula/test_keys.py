"""The keys of the lecture's sheet, kept in ``keys.txt``: each is a formula here."""

from pathlib import Path

import pytest

from rldrill.solutions.sheet import formulas

KEYS = (Path(__file__).parent / "keys.txt").read_text(encoding="utf-8").split()


@pytest.mark.parametrize("key", KEYS)
def test_every_key_of_the_sheet_is_a_formula(key: str) -> None:
    assert key in formulas()
