"""What is written of a long working: the first steps of a kind and the last, and how many are left out."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby

from rldrill.solutions.work import Line, Note, Step

#: Of so many steps by one formula in a row no more are written.
_ALIKE = 100
#: Of more steps than these two together the first and the last are written.
_FIRST, _LAST = 200, 50


def abridged(lines: Sequence[Line]) -> tuple[Line, ...]:
    """A working without most of its steps where there are hundreds: each step is like one that is written."""
    short = tuple(_runs(lines))
    steps = [place for place, line in enumerate(short) if isinstance(line, Step)]
    if len(steps) <= _FIRST + _LAST:
        return short
    begin, end = steps[_FIRST - 1] + 1, steps[-_LAST]
    while isinstance(short[end - 1], Note):  # what introduces the steps
        end -= 1
    kept = [line for line in short[begin:end] if not isinstance(line, Step | Note)]
    left_out = sum(isinstance(line, Step) for line in short[begin:end])
    return (*short[:begin], _note(left_out), *kept, *short[end:])


def _runs(lines: Iterable[Line]) -> Iterator[Line]:
    for kind, run in groupby(lines, key=lambda line: (line.formula, line.right) if isinstance(line, Step) else None):
        group = list(run)
        if kind is None or len(group) <= _ALIKE:
            yield from group
        else:
            yield from group[:_ALIKE]
            yield _note(len(group) - _ALIKE)


def _note(left_out: int) -> Note:
    return Note(f"… And so on: {left_out} more steps in the same way.")
