"""The catalogue is the tree: every file in a topic's folder is a family."""

import difflib
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from rldrill.problems.errors import UsageError
from rldrill.problems.headers import Header, header

if TYPE_CHECKING:
    from rldrill.problems.family import Family

_ROOT = Path(__file__).parent

#: The order of the sheet; a topic that is not named here comes after these.
_ORDER = (
    "fundamentals",
    "bellman",
    "dynamic_programming",
    "temporal_difference",
    "control",
    "policy_gradient",
    "linear_methods",
    "backup_diagrams",
    "bayes",
    "inverse_rl",
    "function_approximation",
    "beyond_the_sheet",
)


@cache
def topics() -> dict[str, tuple[str, ...]]:
    """Every topic with the names of its families, read from the folders without importing anything."""
    found = {
        folder.name: tuple(
            sorted(file.stem.replace("_", "-") for file in folder.glob("*.py") if file.stem != "__init__")
        )
        for folder in _ROOT.iterdir()
        if (folder / "__init__.py").is_file()
    }
    order = [*[topic for topic in _ORDER if topic in found], *sorted(set(found) - set(_ORDER))]
    return {topic: found[topic] for topic in order}


def families() -> tuple[str, ...]:
    """The names of all families, topic by topic."""
    return tuple(name for names in topics().values() for name in names)


@cache
def family(name: str) -> "Family":
    """The family of that name (``td-zero`` or ``td_zero``).

    Raises:
        UsageError: there is none.
    """
    from rldrill.problems.family import Family

    return Family.load(*_place(name))


def headers(names: Sequence[str] = ()) -> tuple[Header, ...]:
    """What is said of the families that topics and families name, in the order of the catalogue; of all without names.

    Raises:
        UsageError: a name is neither a topic nor a family.
    """
    return tuple(header(*_place(name)) for name in chosen(names))


def selection(names: Sequence[str]) -> tuple["Family", ...]:
    """The families that topics and families name, in the order of the catalogue; all where none is named.

    Raises:
        UsageError: a name is neither a topic nor a family.
    """
    return tuple(family(name) for name in chosen(names))


def chosen(names: Sequence[str]) -> tuple[str, ...]:
    """Their names alone.

    Raises:
        UsageError: a name is neither a topic nor a family.
    """
    if not names:
        return families()
    wanted: set[str] = set()
    for name in names:
        topic = name.strip().lower().replace("-", "_")
        wanted.update(topics()[topic] if topic in topics() else (_place(name)[1],))
    return tuple(name for name in families() if name in wanted)


def _place(name: str) -> tuple[str, str]:
    """The topic and the name of the family so called."""
    wanted = name.strip().lower().replace("_", "-")
    for topic, names in topics().items():
        if wanted in names:
            return topic, wanted
    raise UsageError(f"There is no family {name[:40]!r}{_similar(wanted)}; rldrill.families() and 'rldrill list' tell.")


def _similar(wanted: str) -> str:
    known = [*families(), *(topic.replace("_", "-") for topic in topics())]
    close = difflib.get_close_matches(wanted, known, n=1)
    return f" (did you mean {close[0]!r}?)" if close else ""
