"""The places of an exam: which family and level, or which fixed problem, stands where."""

from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from contextlib import contextmanager
from functools import cache
from itertools import chain, islice, zip_longest

from msgspec import Struct
from msgspec.structs import replace

from rldrill.exam.blueprint import MOST_PROBLEMS, MOST_VERSIONS, Blueprint, Entry
from rldrill.exam.expected import COUNTED, variety
from rldrill.exam.expected import minutes as expected
from rldrill.exam.selection import level_of
from rldrill.exercise import Exercise, draw, load
from rldrill.problems.catalogue import chosen, headers
from rldrill.problems.catalogue import family as family_of
from rldrill.problems.draws import Draws
from rldrill.problems.errors import FileError, UsageError, UserError
from rldrill.problems.headers import Header
from rldrill.solutions.effort import minutes as time_of

#: So many random choices are made to fill a time; the one that fits best is taken.
_TRIALS = 200
#: Topics without a count share the time as if it were this.
_SHARE = 3


class Slot(Struct, frozen=True):
    """A place of an exam.

    Args:
        family: the name of the family that is drawn from.
        level: at which level; None for a fixed problem.
        fixed: the problem, where it is the same in every version.
        points: of the problem or of its parts, where they are set.
        partial: the rule for wrong entries, of the problem or of its parts, where it is another than the exam's.
        where: where the blueprint says so; what complaints begin with.
    """

    family: str
    level: int | None
    fixed: Exercise | None = None
    points: int | tuple[int, ...] | None = None
    partial: str | tuple[str, ...] | None = None
    where: str = ""

    @property
    def by_part(self) -> list[tuple[str, tuple[int, ...] | tuple[str, ...]]]:
        """What is set for every part: a problem has to have as many."""
        found = (("points", self.points), ("rules for partial points", self.partial))
        return [(what, each) for what, each in found if isinstance(each, tuple)]

    @property
    def minutes(self) -> int:
        """How many minutes such a problem takes about."""
        return self._of_its_level(expected()) or _estimated(self.family, self.level)

    @property
    def variety(self) -> int:
        """How many versions may have such a problem and share no answer, as far as that is counted."""
        counted = self._of_its_level(variety())
        return MOST_VERSIONS if counted in (None, COUNTED) else counted

    def _of_its_level(self, figures: Mapping[str, Sequence[int]]) -> int | None:
        """What is known of our own families; None for those of other packages."""
        levels = figures.get(self.family)
        return None if levels is None else levels[min(self.level or 2, len(levels)) - 1]


@cache
def _estimated(family: str, level: int | None) -> int:
    """The minutes of a problem of a family of which no file tells them."""
    exercise = draw(family, level or family_of(family).levels[0])
    return max(1, round(time_of(exercise.solution)))


def slots(
    blueprint: Blueprint, seed: int, versions: int = 1, draws: Callable[[str], Draws] = Draws
) -> tuple[Slot, ...]:
    """The places of a blueprint's exam; the same seed makes the same choice, if the same is drawn by the same key.

    Args:
        blueprint: what the exam shall be.
        seed: what the choice depends on.
        versions: how many versions there are: of topics those families come first that have as many different answers.
        draws: the stream of choices by its key.

    Raises:
        FileError: a name in a file does not exist, or a family has no such level; with the line.
        UsageError: the same on a command line.
    """
    left_out = frozenset(chosen(blueprint.exclude)) if blueprint.exclude else frozenset()
    keys = [f"order {seed} {index}" for index in range(len(blueprint.problems))]
    named = {index: _named(blueprint, index, left_out, draws(key)) for index, key in enumerate(keys)}
    rest = (blueprint.minutes or 0) - sum(slot.minutes for found in named.values() for slot in found or ())
    topics = [index for index, found in named.items() if found is None]
    if blueprint.minutes and topics and rest < 1:
        raise error(
            blueprint.place(), "The problems that are named take all of the time already; leave some out or allow more."
        )
    for index in topics:
        weights = [blueprint.problems[other].count or _SHARE for other in topics if other >= index]
        time = None if blueprint.minutes is None else rest * weights[0] // sum(weights)
        found = _of_topics(blueprint, index, left_out, draws(keys[index]), time, versions)
        rest -= sum(slot.minutes for slot in found)
        named[index] = found
    return tuple(
        replace(slot, points=entry.points, partial=entry.partial, where=blueprint.place(index))
        for index, entry in enumerate(blueprint.problems)
        for slot in named[index] or ()
    )


def error(where: str, sentence: str) -> UserError:
    """What is said of what does not fit, in a file or on a command line."""
    return FileError(f"{where}{sentence}") if where else UsageError(f"{sentence[:1].upper()}{sentence[1:]}")


@contextmanager
def _told(where: str) -> Iterator[None]:
    try:
        yield
    except UserError as error:
        if where:
            raise FileError(f"{where}{error}") from None
        raise


def _named(blueprint: Blueprint, index: int, left_out: Set[str], draws: Draws) -> list[Slot] | None:
    """The places of an entry that names its problem or family; None for one that names topics."""
    entry = blueprint.problems[index]
    with _told(blueprint.place(index)):
        if entry.is_fixed:
            exercise = load(entry.id or blueprint.folder / (entry.file or ""))
            return [Slot(exercise.problem.family.name, None, exercise)]
        if entry.family is None:
            return None
        (header,) = headers([family_of(entry.family).name])
        if header.name in left_out:
            raise UsageError(f"{header.name} is left out by exclude; take it out there, or here.")
        if entry.level is not None and entry.level not in header.levels:
            raise UsageError(f"{header.name} has no level {entry.level}; it has {', '.join(map(str, header.levels))}.")
        return [Slot(header.name, level_of(header.levels, entry.level, draws)) for _ in range(entry.count or 1)]


def _of_topics(
    blueprint: Blueprint, index: int, left_out: Set[str], draws: Draws, time: int | None, versions: int
) -> list[Slot]:
    entry = blueprint.problems[index]
    with _told(blueprint.place(index)):
        candidates = tuple(header for header in headers(entry.topic or ()) if header.name not in left_out)
        if not candidates:
            names, less = ", ".join(entry.topic or ("all families",)), ", ".join(blueprint.exclude)
            raise UsageError(f"Nothing is left of {names} without {less}; take it out of exclude, or name another.")
    if time is None:
        return list(islice(_endless(candidates, entry.level, draws, versions), entry.count or 1))
    trials = (_filled(candidates, entry, draws, time, versions) for _ in range(_TRIALS))
    return min(trials, key=lambda found: abs(time - sum(slot.minutes for slot in found)))


def _endless(candidates: Sequence[Header], level: int | None, draws: Draws, versions: int) -> Iterator[Slot]:
    """Topic by topic in turn, every family before one comes again; first those with an answer for each version.

    Those that have hardly more are as good as none: not all of their answers take about the same minutes.
    """
    versions += versions // 3
    while True:
        poor: list[Slot] = []
        for header in _interleaved(candidates, draws):
            slot = Slot(header.name, level_of(header.levels, level, draws))
            if slot.variety < versions and level is None:
                others = [replace(slot, level=other) for other in header.levels]
                slot = max((slot, *others), key=lambda each: min(each.variety, versions))
            if slot.variety < versions:
                poor.append(slot)
            else:
                yield slot
        yield from sorted(poor, key=lambda slot: -slot.variety)


def _interleaved(candidates: Sequence[Header], draws: Draws) -> Iterator[Header]:
    topics: dict[str, list[Header]] = {}
    for header in draws.shuffled(candidates):
        topics.setdefault(header.topic, []).append(header)
    rounds = zip_longest(*(topics[name] for name in draws.shuffled(sorted(topics))))
    return (header for header in chain.from_iterable(rounds) if header is not None)


def _filled(candidates: Sequence[Header], entry: Entry, draws: Draws, time: int, versions: int) -> list[Slot]:
    """One random choice: so many as are asked for, or as many as the time has room for; topics in turn."""
    endless = _endless(candidates, entry.level, draws, versions)
    if entry.count is not None:
        return list(islice(endless, entry.count))
    result: list[Slot] = []
    for slot in islice(endless, max(MOST_PROBLEMS, 2 * len(candidates))):
        if slot.minutes <= time or not result:
            result.append(slot)
            time -= slot.minutes
        if time <= 0 or len(result) == MOST_PROBLEMS:
            break
    return result
