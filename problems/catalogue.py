"""The catalogue is the tree: every file in a topic's folder is a family.

Packages add trees of their own: an entry point of the group ``rldrill.families`` names a package with the folders
``problems`` and ``solutions``, laid out as rldrill's own are.
"""

import difflib
from collections.abc import Sequence
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from rldrill.problems.errors import BrokenFamily, UsageError
from rldrill.problems.headers import Header, header

if TYPE_CHECKING:
    from rldrill.problems.family import Family

_ROOT = Path(__file__).parent
#: The package whose families are rldrill's own.
OWN = "rldrill"
_GROUP = "rldrill.families"

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
def trees() -> dict[str, Path]:
    """By package the folders that hold topics: rldrill's own, then those of other packages.

    Raises:
        BrokenFamily: an entry point names no package with a folder ``problems``.
    """
    from importlib.metadata import entry_points

    found = {OWN: _ROOT}
    for point in sorted(entry_points(group=_GROUP), key=lambda point: point.value):
        spec = find_spec(point.value) if point.value.isidentifier() else None
        places = (spec.submodule_search_locations if spec else None) or ()
        folder = next((Path(place, "problems") for place in places if Path(place, "problems").is_dir()), None)
        if folder is None:
            raise BrokenFamily(
                f"The entry point {point.name!r} of {_GROUP} names {point.value!r}, which is no package with a folder "
                "'problems'; correct it, or uninstall what declares it."
            )
        found[point.value] = folder
    return found


@cache
def packages() -> dict[str, str]:
    """For every family the package that it is of.

    Raises:
        BrokenFamily: two packages have a family of the same name.
    """
    found: dict[str, str] = {}
    for package, tree in trees().items():
        for name in (name for names in _topics(tree).values() for name in names):
            if found.setdefault(name, package) != package:
                raise BrokenFamily(f"{package}: there is a family {name!r} in {found[name]}; call this one otherwise.")
    return found


def _topics(tree: Path) -> dict[str, tuple[str, ...]]:
    return {
        folder.name: tuple(
            sorted(file.stem.replace("_", "-") for file in folder.glob("*.py") if file.stem != "__init__")
        )
        for folder in tree.iterdir()
        if (folder / "__init__.py").is_file()
    }


@cache
def _own() -> dict[str, tuple[str, ...]]:
    return _topics(_ROOT)


@cache
def topics() -> dict[str, tuple[str, ...]]:
    """Every topic with the names of its families, read from the folders without importing anything."""
    found: dict[str, tuple[str, ...]] = {}
    for tree in trees().values():
        for topic, names in _topics(tree).items():
            found[topic] = (*found.get(topic, ()), *names)
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

    topic, wanted = _place(name)
    return Family.load(topic, wanted, OWN if wanted in _own().get(topic, ()) else packages()[wanted])


def headers(names: Sequence[str] = ()) -> tuple[Header, ...]:
    """What is said of the families that topics and families name, in the order of the catalogue; of all without names.

    Raises:
        UsageError: a name is neither a topic nor a family.
    """
    placed = (_place(name) for name in chosen(names))
    return tuple(header(topic, name, trees()[packages()[name]]) for topic, name in placed)


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
        wanted.update(topics()[topic] if topic in topics() else (_place(name, "topic or family")[1],))
    return tuple(name for name in families() if name in wanted)


def _place(name: str, wanted_is: str = "family") -> tuple[str, str]:
    """The topic and the name of the family so called."""
    wanted = name.strip().lower().replace("_", "-")
    for known in (_own, topics):  # who is asked for one of ours need not wait for the others
        for topic, names in known().items():
            if wanted in names:
                return topic, wanted
    if wanted in (topic.replace("_", "-") for topic in topics()):
        within = ", ".join(chosen([wanted])[:5])
        raise UsageError(f"{name[:40]!r} is a topic, not a family; name one of its families, such as {within}.")
    raise UsageError(
        f"There is no {wanted_is} {name[:40]!r}{_similar(wanted)}; 'rldrill list' and rldrill.families() tell."
    )


def _similar(wanted: str) -> str:
    known = [*families(), *(topic.replace("_", "-") for topic in topics())]
    close = difflib.get_close_matches(wanted, known, n=1)
    return f" (did you mean {close[0]!r}?)" if close else ""
