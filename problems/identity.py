"""Problem IDs: ``value-iteration/2/7@1`` is family, level, seed and the family's revision."""

import re
from pathlib import Path

from msgspec import Struct

from rldrill.problems.errors import UsageError

LEVELS = (1, 2, 3)
MAX_SEED = 10**12
_ID = re.compile(r"(?P<family>[a-z0-9-]+)/(?P<level>[1-3])/(?P<seed>\d{1,12})(?:@(?P<revision>\d{1,6}))?")


class Identity(Struct, frozen=True):
    """The name of one problem: the same ID is the same problem, to the letter, everywhere."""

    family: str
    level: int
    seed: int
    revision: int

    def __str__(self) -> str:
        return f"{self.family}/{self.level}/{self.seed}@{self.revision}"


def looks_like_id(text: str) -> bool:
    """Whether the text has the form of a problem ID, with or without its revision."""
    return _ID.fullmatch(text) is not None


def split_id(text: str) -> tuple[str, int, int, int | None]:
    """Take an ID apart into family, level, seed and revision (None where it is left out).

    Raises:
        UsageError: the text is not an ID.
    """
    match = _ID.fullmatch(text)
    if match is None:
        raise UsageError(
            f"{text[:60]!r} is not a problem ID; IDs look like value-iteration/2/7 (family/level 1-3/seed)."
        )
    revision = match["revision"]
    return (
        match["family"],
        int(match["level"]),
        int(match["seed"]),
        None if revision is None else int(revision),
    )


def with_level(name: str) -> tuple[str, int | None]:
    """What is named, and its level where the name has one: ``td-zero/2`` is of level 2."""
    family, _, level = name.partition("/")
    return (family, int(level)) if level in {"1", "2", "3"} else (name, None)


def names_a_problem(name: str) -> bool:
    """Whether a name is that of one problem: an ID, or a file."""
    return looks_like_id(name) or Path(name).suffix.lower() in (".toml", ".json")
