"""Documents that are read aloud."""

from rldrill.problems.document import Paragraph, Table
from rldrill.problems.pictures import Timeline
from rldrill.render.linear import linear


def test_a_run_is_a_sentence_a_step() -> None:
    run = Timeline(times=("t = 0", "t = 1", "t = 2"), states=("cool", "warm", "hot"), actions=("fast", "", "slow"),
                   rewards=("r₁ = 2", "r₂ = 3"))  # fmt: skip
    assert linear([run]) == (
        Paragraph("t = 0: state cool, action fast, then r₁ = 2."),
        Paragraph("t = 1: state warm, then r₂ = 3."),
        Paragraph("t = 2: state hot, action slow."),
    )
    assert linear([Timeline(times=("t = 0", "t = 1"), states=("a", "b"), actions=(), rewards=())]) == (
        Paragraph("t = 0: state a."),
        Paragraph("t = 1: state b."),
    )


def test_a_table_is_a_sentence_a_row() -> None:
    assert linear([Table(header=("s", ""), rows=(("cool", "fast"), ("warm", "slow")))]) == (
        Paragraph("s: cool, fast."),
        Paragraph("s: warm, slow."),
    )
