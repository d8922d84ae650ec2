"""One value that is said to hold for everything that is asked for: ``slow everywhere``, ``0.2 for both``."""

import re
from collections.abc import Sequence

from rldrill.problems.spelling import Source
from rldrill.solutions.answers.names import Key

_STATES = r"(?:\s+(?:states?|s|entries|pairs))?"
_TWO = "both|beide|beiden"
_ALL = f"all|every|each|any|alle|allen|{_TWO}"
#: What says, before or behind a value, that it is the same everywhere; a comma there would part two entries.
_BEFORE = re.compile(
    rf"(?:always|everywhere|immer|überall|(?:in|for|für)\s+(?:{_ALL}){_STATES}\s*[:,]?|all|alle|both|beide)\s+(?=\S)",
    re.IGNORECASE,
)
_BEHIND = re.compile(
    rf"\s*[,(]?\s*\b(?:(?:in|for|für)\s+(?:{_ALL}){_STATES}|(?<=[\w)%]\s)(?:everywhere|always|immer|überall|each|je))\s*\)?$"
    r"|\s*∀\s*s?$|\s+\((?:both|all|each|beide|alle)\)$",
    re.IGNORECASE,
)
_PAIR = re.compile(rf"\b(?:{_TWO})\b", re.IGNORECASE)


def for_all(source: Source, keys: Sequence[Key]) -> Source | None:
    """The one value that is typed for all keys; None where several are typed, or a key has such a word for a name."""
    names = {name.casefold() for key in keys for name in ([key] if isinstance(key, str) else key)}
    before, behind = _BEFORE.match(source.text), _BEHIND.search(source.text)
    said = before or behind
    if len(keys) < 2 or said is None or names & set(re.findall(r"\w+", said[0].casefold())):
        return None
    if len(keys) > 2 and _PAIR.search(said[0]):
        return None
    value = source.part(said.end(), len(source.text)) if before else source.part(0, said.start())
    return None if not value.text or value.has(",;|\n:=") else value
