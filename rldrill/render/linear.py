"""A document to be read aloud: one thing after the other, without pictures, columns or lines drawn with signs."""

from collections.abc import Iterable, Iterator

from rldrill.problems.document import Beside, Block, Document, Paragraph, Table
from rldrill.problems.pictures import Moment, Picture, Timeline


def linear(blocks: Iterable[Block]) -> Document:
    """The document with a sentence for every row of a table and every step of a run.

    A picture beside a table shows the same, and is left out; another one stays.
    """
    return tuple(_linear(blocks))


def _linear(blocks: Iterable[Block]) -> Iterator[Block]:
    for block in blocks:
        match block:
            case Beside(inner):
                tables = any(isinstance(each, Table) for each in inner)
                yield from _linear(each for each in inner if not (tables and isinstance(each, Picture)))
            case Table(header, rows):
                yield from (Paragraph(_row(header, row)) for row in rows)
            case Timeline():
                yield from (Paragraph(_step(moment)) for moment in block.moments())
            case _:
                yield block


def _row(header: tuple[str, ...], row: tuple[str, ...]) -> str:
    """``s: cool, a: fast``."""
    return ", ".join(f"{title}: {cell}" if title else cell for title, cell in zip(header, row, strict=True)) + "."


def _step(moment: Moment) -> str:
    """``t = 0: state cool, action fast, then r₁ = 2``."""
    action = f", action {moment.action}" if moment.action else ""
    reward = f", then {moment.reward}" if moment.reward else ""
    return f"{moment.label}: state {moment.state}{action}{reward}."
