"""A typed answer in the one spelling, without what people put around it."""

from rldrill.problems.spelling import Source, Unreadable, respelled

__all__ = ["Unreadable", "clean"]

_LONGEST = 2000


def clean(text: str) -> Source:
    """A typed answer in the one spelling, without the signs that set mathematics off, and the sign for "about".

    Raises:
        Unreadable: it is empty, too long, or holds characters that cannot be seen.
    """
    source = respelled(text, _LONGEST)
    while len(source.text) > 1 and source.text[0] == source.text[-1] == "$":
        source = source.part(1, len(source.text) - 1)
    if source.text[:1] in ("≈", "~"):
        source = source.part(1, len(source.text))
    if not source.text:
        raise Unreadable("Nothing was typed.")
    return source
