"""Pages of a sample of families look as they should; ``tests/print/measure.py`` looks at those of all."""

import io

import pytest
from pypdf import PdfReader

from layout import measured
from rldrill.exam.exam import Exam, Head, Layout, Version
from rldrill.exercise import draw, load
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


def _pages(*problems: str) -> list[list[str]]:
    """The lines of every page of a worksheet."""
    version = Version("A", tuple(map(load, problems)), tuple(range(len(problems))))
    data = pdf(worksheet_source(Exam(Head(), 1, (version,)), version), accessible=True)
    return [page.extract_text().splitlines() for page in PdfReader(io.BytesIO(data)).pages]


_RUNS = ("td-zero/2/1", "td-zero/2/2", "td-zero/2/3")


def test_a_page_that_goes_on_with_a_problem_says_with_which() -> None:
    pages = _pages(*_RUNS, "value-iteration/2/1", "lqr-infinite/3/1")
    assert [any(line == "Problem 4" for line in page) for page in pages] == [False, False, True]
    assert any(line.startswith("(b) Which action") for line in pages[2][:4])


def test_the_last_part_of_all_stays_with_the_one_before() -> None:
    pages = _pages(*_RUNS, "value-iteration/2/1")
    parts = [[line[:3] for line in page if "sweeps?" in line or "Which action" in line] for page in pages]
    assert parts == [[], [], ["(a)", "(b)"]]
