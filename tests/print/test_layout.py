"""Pages of a sample of families look as they should; ``tests/print/measure.py`` looks at those of all."""

import pytest

from layout import measured
from rldrill.exam.exam import Exam, Head, Layout, Version
from rldrill.exercise import draw
from rldrill.print.key import key_source
from rldrill.print.paper import pdf
from rldrill.print.worksheet import worksheet_source

#: Families with wide tables, large pictures, long equations, many parts.
SAMPLE = [
    ("optimal-value", 3),
    ("ddp-backward", 2),
    ("backup-diagram-name", 3),
    ("denavit-hartenberg", 3),
    ("bayes-filter", 2),
]


@pytest.mark.parametrize("paper", ["a4", "letter"])
@pytest.mark.parametrize(("family", "level"), SAMPLE)
def test_pages_are_filled_and_nothing_sticks_out(family: str, level: int, paper: str) -> None:
    version = Version("A", (draw(family, level, 1),), (0,))
    exam = Exam(Head(), 1, (version,), layout=Layout(paper=paper))
    for source in (worksheet_source, key_source):
        pages = measured(pdf(source(exam, version), accessible=True))
        assert not any(page.overfull for page in pages)
        assert min(page.smallest for page in pages) >= 4.5
        assert all(page.filled >= 0.5 for page in pages[:-1])
        title = version.exercises[0].problem.family.title
        assert not any(title in page.last for page in pages), "a heading ends a page"
