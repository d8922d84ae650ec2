"""A typed answer in the one spelling, without what people put around it."""

import re

from rldrill.problems.latex import typed
from rldrill.problems.spelling import Source, Unreadable

__all__ = ["Unreadable", "bare", "clean"]

_LONGEST = 2000
_ABOUT = re.compile(r"\s*(?:[≈~]|(?:approx|approximately|about|circa|ca|roughly)\b\.?)\s*", re.IGNORECASE)
_QUOTES = "'\"`"


def clean(text: str) -> Source:
    """A typed answer in the one spelling, without LaTeX, quotes around it all, and the sign for "about".

    Raises:
        Unreadable: it is empty, too long, or holds characters that cannot be seen.
    """
    source = bare(typed(text, _LONGEST))
    if not source.text:
        raise Unreadable("Nothing was typed.")
    return source


def bare(source: Source) -> Source:
    """A stretch without the quotes around it, and without the sign or word for "about" before it."""
    text = source.text
    if len(text) > 1 and text[0] == text[-1] and text[0] in _QUOTES and text[0] not in text[1:-1]:
        source = source.part(1, len(text) - 1)
    about = _ABOUT.match(source.text)
    return source.part(about.end(), len(source.text)) if about else source
