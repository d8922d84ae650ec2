"""What is printed of every family's first problems is what was looked at when its page was written.

A digest stands for what a page cannot show: four draws of every level, and the same blocks in a narrow terminal, for
Typst and in Markdown.
"""

from pathlib import Path

import pytest

from printing import page
from rldrill.problems.catalogue import families, family

PAGES = Path(__file__).parents[1] / "golden" / "pages"


@pytest.mark.parametrize("name", families())
def test_a_family_prints_what_its_page_shows(name: str) -> None:
    path = PAGES / f"{name}.txt"
    assert path.exists(), f"Run 'python tests/golden/write.py {name}', and read what it writes."
    assert page(family(name)).splitlines() == path.read_text(encoding="utf-8").splitlines(), (
        f"{name} draws or prints something else than before. If that is meant, run 'python tests/golden/write.py "
        f"{name}' and read the difference; raise the family's REVISION where its draws have changed."
    )


def test_there_is_no_other_page() -> None:
    assert {path.stem for path in PAGES.iterdir()} == set(families())
