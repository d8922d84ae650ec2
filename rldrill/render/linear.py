"""A document to be read aloud: one thing after the other, without pictures, columns or lines drawn with signs."""

from collections.abc import Iterable, Iterator

from rldrill.problems.document import Beside, Block, Document, Paragraph, Table
from rldrill.problems.pictures import Picture, Timeline


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
                yield from (Paragraph(_step(block, time)) for time in range(len(block.states)))
            case _:
                yield block


def _row(header: tuple[str, ...], row: tuple[str, ...]) -> str:
    """``s: cool, a: fast``."""
    return ", ".join(f"{title}: {cell}" if title else cell for title, cell in zip(header, row, strict=True)) + "."


def _step(line: Timeline, time: int) -> str:
    """``t = 0: state cool, action fast, then r₁ = 2``."""
    told = [f"state {line.states[time]}"]
    if time < len(line.actions) and line.actions[time]:
        told.append(f"action {line.actions[time]}")
    if time < len(line.rewards) and line.rewards[time]:
        told.append(f"then {line.rewards[time]}")
    return f"{line.times[time]}: {', '.join(told)}."
