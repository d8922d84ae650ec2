"""Pages of a sample of families look as they should; ``tests/print/measure.py`` looks at those of all."""

import io
from pathlib import Path

import pytest
from pypdf import PdfReader

from layout import measured
from printed import words
from rldrill.exam.exam import Exam, Head, Layout, Version
from rldrill.exercise import Exercise, draw, load, read
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


def _long(states: int, family: str) -> Exercise:
    """A walk from state to state, for ever, in which every state may also be kept: two rows a state, and a policy's."""
    names = [f"s{number}" for number in range(states)]
    rows = [[here, act, there, 1, 1] for here, after in zip(names, names[1:] + names[:1], strict=True)
            for act, there in (("go", after), ("stay", here))]  # fmt: skip
    policy = {"policy": {name: {"go": "1/2", "stay": "1/2"} for name in names}} if family == "policy-evaluation" else {}
    return read({"family": family, "given": {"gamma": "1/2", "sweeps": 1, "mdp": {"transitions": rows}, **policy}})


@pytest.mark.parametrize("family", ["policy-evaluation", "value-iteration"])
def test_what_is_longer_than_a_page_goes_on_on_the_next(family: str, tmp_path: Path) -> None:
    """Rows of tables below a repeated head, places for answers, and the answers of a key."""
    exercise = _long(60, family)
    version = Version("A", (exercise,), (0,))
    for source in (worksheet_source, key_source):
        data = pdf(source(Exam(Head(), 1, (version,)), version), accessible=True)
        pages = measured(data)
        assert not any(page.overfull for page in pages)
        assert all(page.filled >= 0.5 for page in pages[:-1])
        (tmp_path / "x.pdf").write_bytes(data)
        found = list(words(tmp_path / "x.pdf"))
        if source is worksheet_source:
            assert {word.page for word in found if word.text == "stay"} <= {w.page for w in found if w.text == "𝑎"}
        assert len({(word.page, word.left, word.top) for word in found}) == len(found), "words are printed over words"
