"""Two lines of mathematics that are nearly the same, and where they differ."""

import re
from difflib import SequenceMatcher
from typing import TypeAlias

from rldrill.render.mathematics.unicode import ABOVE, BELOW

#: A piece of a line, and whether the other line has another one there, or none.
Piece: TypeAlias = tuple[str, bool]

_SMALL = re.escape("".join((*BELOW.values(), *ABOVE.values(), "′")))
#: What is not torn apart: a letter with its mark, indices and powers, a number, a word.
_TOKEN = re.compile(rf"\s+|\d+(?:[./]\d+)*|(?:[A-Za-z]+|\w)[\u0300-\u036f]*[{_SMALL}]*|.", re.DOTALL)


def differences(one: str, two: str) -> tuple[tuple[Piece, ...], tuple[Piece, ...]]:
    """Both lines in pieces, those marked that the other one has not."""
    before, after = _TOKEN.findall(one), _TOKEN.findall(two)
    changes = SequenceMatcher(None, before, after, autojunk=False).get_opcodes()
    return (
        tuple(("".join(before[start:end]), tag != "equal") for tag, start, end, _, _ in changes if start < end),
        tuple(("".join(after[start:end]), tag != "equal") for tag, _, _, start, end in changes if start < end),
    )
