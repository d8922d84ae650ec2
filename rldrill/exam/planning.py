"""Planning an exam: a problem for every place of every version, none twice, and no answer twice in the same place."""

from collections.abc import Callable, Sequence
from fractions import Fraction

from msgspec.structs import replace

from rldrill.exam.blueprint import Blueprint
from rldrill.exam.exam import Exam, Person, Version
from rldrill.exam.pool import Candidate, Place, candidate, problems
from rldrill.exam.sealing import Secret
from rldrill.exam.selection import MAX_DRAWN, fresh_seed
from rldrill.exam.slots import Slot, error, slots
from rldrill.exam.worth import partial, worth
from rldrill.exercise import Exercise
from rldrill.problems.draws import Draws
from rldrill.problems.errors import UsageError
from rldrill.problems.identity import MAX_SEED

#: How far a problem may be from the minutes of its place, in parts of the exam's.
_TOLERANCE = Fraction(4, 100)
#: What a place may take at least of its minutes, to make up for longer ones before it.
_SHORTENED = Fraction(2, 3)


def plan(
    blueprint: Blueprint,
    *,
    roster: Sequence[Person] = (),
    secret: Secret | None = None,
    advance: Callable[[], None] = lambda: None,
) -> Exam:
    """Choose and draw the problems; the same blueprint with a seed gives the same exam.

    Args:
        blueprint: what the exam shall be.
        roster: the people; each gets a version, whatever the blueprint says.
        secret: what is mixed into every draw; the versions have codes then that say nothing.
        advance: called as often as there are versions, place by place.

    Raises:
        FileError: a line of the blueprint's file does not fit.
        UsageError: the same on a command line; or there are too few different problems.
    """
    seed = fresh_seed() if blueprint.seed is None else blueprint.seed
    if secret is not None and blueprint.ids:
        raise error(blueprint.place(), "IDs and seed are printed, and the exam is sealed; leave one of them out.")
    draws = Draws if secret is None else secret.draws
    count = len(roster) or blueprint.versions
    places = slots(blueprint, seed, count, draws)
    pools = [draws(f"problems {seed} version 0 place {index}") for index in range(len(places))]
    most = MAX_DRAWN if secret is None else MAX_SEED
    columns = _columns(places, pools, most, count, advance, steered=blueprint.minutes is not None)
    codes = version_codes(count, seed, secret)
    versions: list[Version] = []
    points: list[dict[str, int]] = []
    rules: list[dict[str, str]] = []
    for index, row in enumerate(_dealt(columns, count)):
        exercises = [each.exercise() for each in row]
        points = points or worth(places, exercises, blueprint.points, blueprint.place_of_total)
        rules = rules or partial(places, exercises)
        worthy = [replace(exercise, worth=each) for exercise, each in zip(exercises, points, strict=True)]
        order = tuple(range(len(places)))
        if blueprint.order == "shuffled":
            order = draws(f"order {seed} version {index}").shuffled(order)
        person = roster[index] if roster else None
        given = tuple(rules[slot] for slot in order)
        versions.append(Version(codes[index], tuple(worthy[slot] for slot in order), order, person, given))
    return Exam(
        blueprint.head, seed, tuple(versions), blueprint.partial, blueprint.layout, secret is not None, blueprint.scale
    )


def version_codes(count: int, seed: int, secret: Secret | None = None) -> tuple[str, ...]:
    """What the versions of an exam are called."""
    return tuple(map(version_code, range(count))) if secret is None else secret.codes(seed, count)


def version_code(index: int) -> str:
    """A, B, …, Z, AA, AB, …"""
    head, last = divmod(index, 26)
    return (version_code(head - 1) if head else "") + chr(ord("A") + last)


def _columns(
    places: Sequence[Slot],
    pools: Sequence[Draws],
    most: int,
    count: int,
    advance: Callable[[], None],
    *,
    steered: bool,
) -> list[list[Candidate]]:
    """For every place the problems of all versions, their seeds below ``most`` and drawn from its own stream.

    Where it is steered, they take the minutes that are expected.
    """
    columns = [[] if place.fixed is None else [_same(place.fixed)] * count for place in places]
    used = _fixed(places, columns)
    tolerance = _TOLERANCE * sum(place.minutes for place in places)
    ahead = Fraction(0)  # by so many minutes the versions are longer than they should be, until here
    for index, place in enumerate(places):
        if not columns[index]:
            wanted = Place(
                place.family,
                place.level or 1,
                parts=tuple(len(each) for _, each in place.by_part),
                time=max(_SHORTENED * place.minutes, place.minutes - ahead) if steered else None,
                tolerance=tolerance,
            )
            columns[index] = problems(wanted, count, pools[index], used, most)
            if len(columns[index]) < count:
                raise _too_few(place, some=bool(columns[index]))
            used.update(each.content for each in columns[index])
        ahead += sum((each.time for each in columns[index]), Fraction(0)) / count - place.minutes
        for _ in range(count * index // len(places), count * (index + 1) // len(places)):
            advance()
    return columns


def _fixed(places: Sequence[Slot], columns: Sequence[Sequence[Candidate]]) -> set[str]:
    """What is given in the fixed problems.

    Raises:
        UserError: two of them are the same, whatever they are called.
    """
    used: set[str] = set()
    for place, column in zip(places, columns, strict=True):
        if place.fixed is not None and column:
            if column[0].content in used:
                name = "this problem" if place.fixed.id is None else f"the problem {place.fixed.id}"
                raise error(place.where, f"{name} is there already; one of them is enough.")
            used.add(column[0].content)
    return used


def _same(exercise: Exercise) -> Candidate:
    return candidate(lambda: exercise)


def _too_few(place: Slot, *, some: bool) -> Exception:
    if place.by_part and not some:
        what, each = place.by_part[0]
        return error(
            place.where,
            f"{what} are given for {len(each)} parts, and no problem of {place.family} at level {place.level} has so "
            "many; give another number of them, or one for the problem.",
        )
    return UsageError(
        f"{place.family} has too few different problems at level {place.level} for this worksheet; "
        "ask for fewer versions or problems, or for more families."
    )


def _dealt(columns: Sequence[Sequence[Candidate]], count: int) -> list[list[Candidate]]:
    """The problems of each version: who has had short ones gets the next long one, so that all take as long."""
    totals = [Fraction(0)] * count
    rows: list[dict[int, Candidate]] = [{} for _ in range(count)]
    for slot in sorted(range(len(columns)), key=lambda slot: -_range(columns[slot])):
        behind = sorted(range(count), key=lambda version: totals[version])
        longest = sorted(columns[slot], key=lambda each: -each.time)
        for version, each in zip(behind, longest, strict=True):
            rows[version][slot] = each
            totals[version] += each.time
    return [[row[slot] for slot in range(len(columns))] for row in rows]


def _range(column: Sequence[Candidate]) -> Fraction:
    times = [each.time for each in column]
    return max(times) - min(times)
