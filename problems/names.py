"""What may be the name of a state, an action or a hypothesis."""

import re
import unicodedata
from functools import lru_cache

_LONGEST = 40
_ARROWS = "←↑→↓↔↕↖↗↘↙"
#: Dollar signs and backslashes would be read as mathematics, and a comma parts names unless it stands between numbers.
_NAME = re.compile(rf"(?:[^\W_]|[(+−{_ARROWS}-])(?:[\w .'()+−{_ARROWS}-]|(?<=\d),(?= ?[+−-]?\d))*")
_ALLOWED = (
    "a name begins with a letter, a digit, a sign, an arrow or a bracket, and holds letters, digits, blanks, arrows "
    "and . ' + - _ alone, brackets in pairs, and commas between numbers"
)


def read_name(value: object) -> object:
    """A name as it is; a whole number is one, too.

    Raises:
        ValueError: it is too long, or holds what no name may hold.
    """
    if isinstance(value, int) and not isinstance(value, bool):
        return str(value)
    if not isinstance(value, str):
        return value
    return _checked(unicodedata.normalize("NFC", value))


@lru_cache(maxsize=1024)
def _checked(value: str) -> str:
    """The names of states are the same again and again."""
    brief = repr(value if len(value) <= _LONGEST else f"{value[: _LONGEST - 1]}…")
    if len(value) > _LONGEST:
        raise ValueError(f"the name {brief} has {len(value)} characters, {_LONGEST} are the most; shorten it")
    if not _NAME.fullmatch(value) or value.endswith(" ") or value.count("(") != value.count(")"):
        raise ValueError(f"{brief} is no name; {_ALLOWED}")
    return value
