"""Whether a person's own words can be printed: with the fonts that come along, with those of the computer, or not."""

import re
from collections.abc import Sequence
from functools import cache

from rldrill.exam.exam import Head, Person
from rldrill.print.exam_page import broken
from rldrill.print.paper import pdf
from rldrill.problems.errors import UsageError

_MISSING = re.compile('the text [`‘"]*(.+?)[`’"]* could not be displayed')


def needs_system_fonts(head: Head, people: Sequence[Person], problems: str = "") -> bool:
    """Whether the words of an exam need the fonts of this computer.

    Args:
        head: of the exam.
        people: whose names are printed.
        problems: what the problems are made of, with what is named in them.

    Raises:
        UsageError: no font here has a character of them.
    """
    own = [head.title, head.course, head.date, head.instructions]
    own += [word for person in people for word in (person.name, person.number)]
    words = "".join(dict.fromkeys("".join(own)))
    names = "".join(sorted({sign for sign in problems if not sign.isascii()}))
    return False if words.isascii() and not names else _needs_system_fonts(words + names)


@cache
def _needs_system_fonts(words: str) -> bool:
    if _missing(words, system_fonts=False) is None:
        return False
    missing = _missing(words, system_fonts=True)
    if missing is None:
        return True
    raise UsageError(
        f"No font on this computer has {missing[:20]!r}, which the title, another text of the exam, a "
        "name or a problem has; install one that has it, such as Noto, or write it in other letters."
    )


def _missing(words: str, *, system_fonts: bool) -> str | None:
    """The first text that cannot be displayed."""
    page = '#set document(title: "x")\n#set text(font: "New Computer Modern", lang: "en")\n'
    source = page + "\n".join(broken(sign) for sign in words if not sign.isspace())
    try:
        pdf(source, accessible=True, system_fonts=system_fonts)
    except RuntimeError as error:
        found = _MISSING.search(str(error))
        if found is None:
            raise
        return found[1]
    return None
