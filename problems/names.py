"""What may be the name of a state, an action or a hypothesis."""

import re
import unicodedata
from collections import Counter
from collections.abc import Callable, Mapping
from decimal import Decimal
from functools import lru_cache
from typing import Any

from pydantic import WrapValidator

_LONGEST = 40
_ARROWS = "←↑→↓↔↕↖↗↘↙"
#: Dollar signs and backslashes would be read as mathematics, and a comma parts names unless it stands between numbers.
_NAME = re.compile(rf"(?:[^\W_]|[(+−{_ARROWS}-])(?:[\w .'()+−{_ARROWS}-]|(?<=\d),(?= ?[+−-]?\d))*")
_ALLOWED = (
    "a name begins with a letter, a digit, a sign, an arrow or a bracket, and holds letters, digits, blanks, arrows "
    "and . ' + - _ alone, brackets in pairs, and commas between numbers"
)


def once(read: Callable[[Any], object]) -> WrapValidator:
    """What demands of a table that none of its names is there twice, in two spellings, by what reads one."""

    def check(value: Any, handler: Callable[[Any], Any]) -> Any:
        table = handler(value)
        if isinstance(value, Mapping) and len(table) < len(value):
            ((name, _),) = Counter(map(read, value)).most_common(1)
            raise ValueError(f"{name!r} is given twice, in two spellings; leave one out")
        return table

    return WrapValidator(check)


def read_whole(value: object) -> int:
    """A whole number as files have it: 1, "1" or "1.0"."""
    return int(Decimal(str(value)))


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
