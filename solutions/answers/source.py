"""A typed answer in the one spelling, without what people put around it."""

import re

from rldrill.problems.latex import typed
from rldrill.problems.spelling import Source, Unreadable
from rldrill.solutions.answers.pasted import laid_out

__all__ = ["LONGEST", "Unreadable", "bare", "clean"]

#: No answer is longer, unless the right one is.
LONGEST = 2000
_ABOUT = re.compile(
    r"\s*(?:[≈~]|(?:approx|approximately|about|circa|ca|roughly|exactly)\b(?:\.\s*=?|(?!\s*[:=←→|])))\s*", re.IGNORECASE
)
_BOLD = re.compile(r"\*\*[^*\s](?:[^*]*[^*\s])?\*\*")
_QUOTES = "'\"`"


def clean(text: str, longest: int = LONGEST) -> Source:
    """A typed answer in the one spelling, without LaTeX, quotes around it all, and the sign for "about".

    Raises:
        Unreadable: it is empty, longer than ``longest``, or holds characters that cannot be seen.
    """
    if len(text) > longest:
        raise Unreadable(f"It is longer than {longest} characters; shorten it.", longest)
    source = bare(typed(laid_out(text), longest))
    if not source.text:
        raise Unreadable("Nothing was typed.")
    return source


def bare(source: Source) -> Source:
    """A stretch without quotes or Markdown's stars around it, and without the sign or word for "about" before it."""
    if _BOLD.fullmatch(source.text):
        source = source.part(2, len(source.text) - 2)
    text = source.text
    if len(text) > 1 and text[0] == text[-1] and text[0] in _QUOTES and text[0] not in text[1:-1]:
        source = source.part(1, len(text) - 1)
    return source.behind(_ABOUT)
