"""The entries of a vector by the names that the question gives them, not by their numbers."""

import re

from rldrill.problems.notations import in_notation, read_mathematics
from rldrill.problems.parts import Kind, Numbers
from rldrill.render.mathematics.unicode import unicode

_ENTRY = re.compile(r"\bentry (\d+)\b")


def entry_name(entry: str) -> str:
    """An entry of ``Numbers`` as it is written: ``δ₁``."""
    return unicode(in_notation(read_mathematics(entry)))


def by_name(says: str, kind: Kind) -> str:
    """A sentence in which the entries of a vector have their names: ``Not right at δ₁`` for ``at entry 2``.

    What was typed may have more entries than are asked for; those have no names.
    """
    if not isinstance(kind, Numbers):
        return says
    names = {str(number): entry_name(entry) for number, entry in enumerate(kind.entries, 1)}
    return _ENTRY.sub(lambda found: names.get(found[1], found[0]), says)
