"""Long mathematics in lines that fit: broken before its plus and minus signs, else between its factors."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import pairwise

from rldrill.problems.mathematics import Glyph, Math, Row

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
    if not isinstance(math, Row) or wide(math, False) <= most:
        return (math,)
    lines: list[Math] = []
    for line in _packed(_parted(math.items, _is_term), wide, most, further=False):
        further = bool(lines)
        fits = wide(line, further) <= most
        lines += [line] if fits else _packed(_parted(line.items, _is_factor), wide, most, further=further)
    return tuple(lines)


def _packed(pieces: Iterable[Sequence[Math]], wide: Wide, most: int, *, further: bool) -> list[Row]:
    """The pieces on as few lines as they fit, which stand by themselves or under others."""
    lines: list[Row] = []
    for piece in pieces:
        longer = Row((*lines[-1].items, *piece)) if lines else None
        if longer is not None and wide(longer, further or len(lines) > 1) <= most:
            lines[-1] = longer
        else:
            lines.append(Row(tuple(piece)))
    return lines


def _parted(items: Sequence[Math], begins: Callable[[Math, Math], bool]) -> Iterator[Sequence[Math]]:
    """The items in pieces, a new one before each that begins one."""
    starts = [0, *(index for index, pair in enumerate(pairwise(items), 1) if begins(*pair)), len(items)]
    return (items[start:stop] for start, stop in pairwise(starts))


def is_sign(item: Math, signs: Iterable[str] = ()) -> bool:
    """Whether something is an operator or a relation, or one of these."""
    return isinstance(item, Glyph) and item.style in ("operator", "relation") and (not signs or item.text in signs)


def _is_term(before: Math, item: Math) -> bool:
    return is_sign(item, _TERMS) and not is_sign(before)


def _is_factor(before: Math, item: Math) -> bool:
    """Whether an item is a factor behind another, or the sign of a product."""
    if is_sign(item):
        return not is_sign(item, _TERMS) and not is_sign(before)
    return not (isinstance(item, Glyph) or is_sign(before))
