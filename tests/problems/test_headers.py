"""The head of a family's file, read alone, says what the imported module says."""

from pathlib import Path

import pytest

from rldrill.problems import catalogue
from rldrill.problems.errors import BrokenFamily
from rldrill.problems.headers import header


def test_a_head_says_what_the_family_says() -> None:
    said = [
        (head.name, head.topic, head.summary, head.title, head.source, head.revision, head.levels)
        for head in catalogue.headers()
    ]
    assert said == [
        (family.name, family.topic, family.summary, family.title, family.source, family.revision, family.levels)
        for family in catalogue.selection(())
    ]


def test_every_family_has_three_levels() -> None:
    assert {head.levels for head in catalogue.headers()} == {(1, 2, 3)}


def test_a_head_that_lacks_something_says_what(tmp_path: Path) -> None:
    (tmp_path / "new.py").write_text('"""Something."""\n\nTITLE = "New"\nSOURCE = "a book"\n\n\ndef draw(): ...\n')
    with pytest.raises(BrokenFamily, match=r"new\.py: a family must have REVISION, above its first class; add it\."):
        header(".", "new", tmp_path)
