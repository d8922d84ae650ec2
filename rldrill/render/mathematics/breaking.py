"""Long mathematics in lines that fit: broken before its relations, else its plus and minus signs, else its factors."""

from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise

from rldrill.problems.mathematics import Glyph, Math, Row, is_sign

#: How wide something is, by itself or as a further line, whose sign has a space behind it.
Wide = Callable[[Math, bool], int]
_TERMS = frozenset("+−-")


def broken(math: Math, wide: Wide, most: int) -> tuple[Math, ...]:
    """Mathematics as lines that are at most so wide, where it can be broken; all but the first may begin with a sign.

    Args:
        math: what is written.
        wide: how wide something is, and whether it is a further line.
        most: how wide a line may be.
    """
    if not isinstance(math, Row):
        return (math,)
    lines = [math]
    for begins in (begins_side, _is_term, _is_factor):
        shorter: list[Row] = []
        for line in lines:
            further = bool(shorter)
            fits = wide(line, further) <= most
            shorter += [line] if fits else packed(grouped(line.items, begins), wide, most, further=further)
        lines = shorter
    return tuple(lines)


def packed(pieces: Iterable[Sequence[Math]], wide: Wide, most: int, *, further: bool = False) -> list[Row]:
    """The pieces on as few lines as they fit, which stand by themselves or under others."""
    lines: list[Row] = []
    for piece in pieces:
        longer = Row((*lines[-1].items, *piece)) if lines else None
        if longer is not None and wide(longer, further or len(lines) > 1) <= most:
            lines[-1] = longer
        else:
            lines.append(Row(tuple(piece)))
    return lines


def grouped(items: tuple[Math, ...], begins: Callable[[Math, Math], bool]) -> list[tuple[Math, ...]]:
    """The items in groups, a new one where ``begins(before, item)`` holds."""
    starts = [0, *(index for index, pair in enumerate(pairwise(items), 1) if begins(*pair)), len(items)]
    return [items[start:stop] for start, stop in pairwise(starts)]


def begins_side(_: Math, item: Math) -> bool:
    """Whether a side of an equation begins here, with its relation."""
    return isinstance(item, Glyph) and item.style == "relation"


def _is_term(before: Math, item: Math) -> bool:
    return isinstance(item, Glyph) and item.style == "operator" and item.text in _TERMS and not is_sign(before)


def _is_factor(before: Math, item: Math) -> bool:
    """Whether an item is a factor behind another, or the sign of a product."""
    if isinstance(item, Glyph):
        return item.style == "operator" and item.text not in _TERMS
    return not is_sign(before)
