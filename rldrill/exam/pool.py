"""The problems for one place of an exam, one for every version: none twice, and no answer twice if there are enough."""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import lru_cache, partial
from itertools import islice

from msgspec import Struct
from msgspec.structs import replace

from rldrill.exam.fairness import chosen, content, told
from rldrill.exam.selection import MAX_DRAWN
from rldrill.exercise import Exercise, draw
from rldrill.problems.draws import Draws
from rldrill.problems.parts import Choice, Part
from rldrill.solutions.effort import minutes

#: So many problems are drawn for a place at most, and so many more a version; and so many in a row that are known.
_ATTEMPTS, _EACH, _STALE = 400, 20, 200
#: Drawing goes on while twice as many problems serve so many more versions, and to so many problems altogether or a
#: version.
_GROWTH, _ENOUGH, _ENOUGH_EACH = Fraction(11, 10), 100, 16
#: An answer is rather shared than versions unequally long: a problem may be off by so many tolerances then.
_CLOSE = Fraction(5, 4)
#: So many are looked at to find one that keeps yes and no in balance.
_BALANCED = 6


class Candidate(Struct, frozen=True, eq=False):
    """A problem that could stand in a place, with what fairness asks of it.

    Thousands wait for a place of a large exam, and with its solution each would take many times the memory: those that
    are taken are drawn once more.

    Args:
        exercise: what makes the problem.
        content: what is given, as text.
        told: the answers that are worth copying, with their parts.
        chosen: the answers that are chosen from a few.
        options: what those are chosen from.
        time: the minutes that it takes.
        form: what it asks for: problems of one form are worth the same points part by part.
    """

    exercise: Callable[[], Exercise]
    content: str
    told: frozenset[tuple[str, str]]
    chosen: tuple[tuple[str, str], ...]
    options: Mapping[str, tuple[str, ...]]
    time: Fraction
    form: tuple[tuple[str, str], ...]


def candidate(made: Callable[[], Exercise]) -> Candidate:
    """The problem that is made so, as a candidate."""
    exercise = made()
    parts = {part.label: part for part in exercise.problem.parts}
    answers = tuple(chosen(exercise))
    return Candidate(
        made,
        content(exercise),
        frozenset(told(exercise)),
        answers,
        {label: _options(parts[label]) for label, _ in answers},
        minutes(exercise.solution),
        tuple((label, part.kind.name) for label, part in parts.items()),
    )


#: Of a small exam nothing is drawn twice.
_remembered = lru_cache(maxsize=256)(draw)


class Place(Struct, frozen=True):
    """What is wanted in a place.

    Args:
        family: the name of the family.
        level: the level.
        tolerance: by so many minutes a problem may take more or less.
        parts: how many parts a problem has, as often as that is set.
        time: the minutes that are wanted; None for those of the first problem that is drawn.
    """

    family: str
    level: int
    tolerance: Fraction
    parts: tuple[int, ...] = ()
    time: Fraction | None = None


def problems(place: Place, count: int, draws: Draws, used: set[str], most: int = MAX_DRAWN) -> list[Candidate]:
    """Problems for a place; fewer than ``count`` if the family has no more, and none if none fits.

    Those of one form are taken that have the most different answers. Where they are too few, as little is shared as can
    be among those that take about as long, and no answer more often than it must.

    Args:
        place: what is wanted.
        count: how many.
        draws: what the seeds are drawn from.
        used: the contents of problems that are not drawn again.
        most: the seeds are below it.
    """
    best, groups = _searched(place, count, (draws.below(most) for _ in range(_ATTEMPTS + _EACH * count)), used)
    if len(best) == count or not groups:
        return best
    nearest = [(_nearest_first(group, centre := _centred(place, group)), centre) for group in groups]
    far = _CLOSE * place.tolerance
    close = [([each for each in group if _excess(each, group, centre) <= far], centre) for group, centre in nearest]
    for some in (close, nearest):
        apart = max((_apart(group, count) for group, _ in some), key=len)
        if len(apart) == count:
            return apart
    large = next(filter(None, ([each for each in some if len(each[0]) >= count] for some in (close, nearest))), None)
    largest = max(nearest, key=lambda each: len(each[0]))
    return min((_spread(group, centre, count) for group, centre in large or [largest]), key=_shared)


def _centred(place: Place, group: Sequence[Candidate]) -> Place:
    """The place with the minutes that most of its problems take, where none are wanted."""
    times = sorted(each.time for each in group)
    return place if place.time is not None else replace(place, time=times[len(times) // 2])


def variety(family: str, level: int, most: int) -> int:
    """How many versions may have such a problem and share no answer, as far as is counted."""
    whatever = Place(family, level, tolerance=Fraction(10**6))
    draws = Draws(f"variety of {family} at {level}")
    best, _ = _searched(whatever, most, (draws.below(MAX_DRAWN) for _ in range(_ATTEMPTS + _EACH * most)), set())
    return len(best)


def _searched(
    place: Place, count: int, seeds: Iterable[int], used: set[str]
) -> tuple[list[Candidate], list[list[Candidate]]]:
    """The problems that share nothing, as many as were found, and all that were drawn, by their form."""
    drawn = _drawn(place, seeds, used)
    pool: list[Candidate] = []
    best: list[Candidate] = []
    while more := list(islice(drawn, len(pool) or 2 * count - 1)):
        pool += more
        before, best = best, max((_fair(group, place, count) for group in _by_form(pool)), key=len)
        grown = len(pool) <= 4 * count or not before or len(best) >= _GROWTH * len(before)
        if len(best) == count or not grown or len(pool) >= max(_ENOUGH, _ENOUGH_EACH * count):
            break
    return best, _by_form(pool)


def _drawn(place: Place, seeds: Iterable[int], used: set[str]) -> Iterator[Candidate]:
    seen = set(used)
    stale = 0
    for seed in seeds:
        if stale == _STALE:
            return
        stale += 1
        found = candidate(partial(_remembered, place.family, place.level, seed))
        if found.content not in seen and set(place.parts) <= {len(found.form)}:
            seen.add(found.content)
            stale = 0
            yield found


def _by_form(pool: Sequence[Candidate]) -> list[list[Candidate]]:
    groups: dict[tuple[tuple[str, str], ...], list[Candidate]] = {}
    for each in pool:
        groups.setdefault(each.form, []).append(each)
    return list(groups.values())


def _fair(group: Sequence[Candidate], place: Place, count: int) -> list[Candidate]:
    """Problems that share no answer and take as long as is wanted: in the order drawn, or the rarest answers first."""
    fitting = [each for each in group if _excess(each, group, place) <= place.tolerance]
    found = _apart(fitting, count)
    if len(found) == count:
        return found
    known = Counter(answer for each in fitting for answer in each.told)
    rare = sorted(fitting, key=lambda each: sum(known[answer] for answer in each.told))
    return max(found, _apart(rare, count), key=len)


def _nearest_first(group: Sequence[Candidate], place: Place) -> list[Candidate]:
    return sorted(group, key=lambda each: _excess(each, group, place))


def _excess(each: Candidate, group: Sequence[Candidate], place: Place) -> Fraction:
    return abs(each.time - (group[0].time if place.time is None else place.time))


def _apart(group: Sequence[Candidate], count: int) -> list[Candidate]:
    """One after the other what shares no answer with those before, the choices in balance."""
    result: list[Candidate] = []
    answers: set[tuple[str, str]] = set()
    balance: Counter[tuple[str, str]] = Counter()
    waiting = list(group)
    while len(result) < count:
        waiting = [each for each in waiting if answers.isdisjoint(each.told)]
        if not waiting:
            break
        taken = min(waiting[:_BALANCED], key=lambda each: _one_sided(each, balance))
        waiting.remove(taken)
        result.append(taken)
        answers |= taken.told
        balance.update(taken.chosen)
    return result


def _spread(group: Sequence[Candidate], place: Place, count: int) -> list[Candidate]:
    """As many as are wanted, or all: each time what shares least with those before."""
    known: Counter[tuple[str, str]] = Counter()
    balance: Counter[tuple[str, str]] = Counter()
    waiting, result = list(group), list[Candidate]()

    def price(each: Candidate) -> tuple[int, int, Fraction, int]:
        late = max(Fraction(0), _excess(each, group, place) - place.tolerance)
        times = [known[answer] for answer in each.told]
        return max(times, default=0), sum(times), late, _one_sided(each, balance)

    while waiting and len(result) < count:
        taken = min(waiting, key=price)
        waiting.remove(taken)
        result.append(taken)
        known.update(taken.told)
        balance.update(taken.chosen)
    return result


def _shared(found: Sequence[Candidate]) -> int:
    """How many answers are somebody else's already."""
    return sum(len(each.told) for each in found) - len({answer for each in found for answer in each.told})


def _one_sided(each: Candidate, balance: Counter[tuple[str, str]]) -> int:
    """How much more often than the rarest its choices are right already."""
    if not each.chosen:
        return 0
    return sum(
        balance[label, answer] - min(balance[label, option] for option in each.options[label])
        for label, answer in each.chosen
    )


def _options(part: Part) -> tuple[str, ...]:
    return tuple(part.kind.options) if isinstance(part.kind, Choice) else ("yes", "no")
