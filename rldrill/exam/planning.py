"""Planning an exam: a problem for every place of every version, none twice, and no answer twice in the same place."""

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction

from rldrill.exam.blueprint import Blueprint
from rldrill.exam.exam import Exam, Person, Version
from rldrill.exam.fairness import chosen, content, told
from rldrill.exam.sealing import Secret
from rldrill.exam.selection import MAX_DRAWN, fresh_seed
from rldrill.exam.slots import Slot, slots
from rldrill.exam.worth import error, partial, worth
from rldrill.exercise import Exercise, draw
from rldrill.problems.draws import Draws
from rldrill.problems.errors import UsageError
from rldrill.problems.identity import MAX_SEED
from rldrill.problems.parts import Choice, Part
from rldrill.solutions.effort import minutes

#: How many problems are drawn for one place of an exam before the family counts as used up.
_ATTEMPTS = 400
#: How many are looked at to find one whose answers nobody else has, and one that keeps yes and no in balance.
_FRESH, _BALANCED = 100, 6
#: How far the minutes of a version may be from those of the first one.
_TOLERANCE = Fraction(4, 100)


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
        advance: called after each version.

    Raises:
        FileError: a line of the blueprint's file does not fit.
        UsageError: the same on a command line; or there are too few different problems.
    """
    seed = fresh_seed() if blueprint.seed is None else blueprint.seed
    if secret is not None and blueprint.ids:
        raise error(blueprint.place(), "IDs and seed are printed, and the exam is sealed; leave one of them out.")
    draws = Draws if secret is None else secret.draws
    places = slots(blueprint, seed, draws)
    steered = blueprint.minutes is not None
    times = tuple(Fraction(slot.minutes) for slot in places) if steered else ()
    planner = _Planner(places, seed, draws, MAX_DRAWN if secret is None else MAX_SEED, times=times)
    count = len(roster) or blueprint.versions
    codes = version_codes(count, seed, secret)
    versions: list[Version] = []
    points: list[dict[str, int]] = []
    rules: list[dict[str, str]] = []
    for index in range(count):
        exercises = planner.version(index)
        points = points or worth(places, exercises, blueprint.points, blueprint.place_of_total)
        rules = rules or partial(places, exercises)
        worthy = [replace(exercise, worth=each) for exercise, each in zip(exercises, points, strict=True)]
        order = tuple(range(len(places)))
        if blueprint.order == "shuffled":
            order = draws(f"order {seed} version {index}").shuffled(order)
        person = roster[index] if roster else None
        given = tuple(rules[slot] for slot in order)
        versions.append(Version(codes[index], tuple(worthy[slot] for slot in order), order, person, given))
        advance()
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


@dataclass
class _Planner:
    """Draws version after version, and knows what the earlier ones have."""

    slots: tuple[Slot, ...]
    seed: int
    draws: Callable[[str], Draws] = Draws
    most: int = MAX_DRAWN  # the seeds of problems stay below it
    used: set[str] = field(default_factory=set)
    answers: Counter[tuple[int, str, str]] = field(default_factory=Counter)
    patience: dict[int, int] = field(default_factory=dict)
    first: tuple[Exercise, ...] = ()
    times: tuple[Fraction, ...] = ()  # how long the place of every version takes; none for whatever it takes

    def __post_init__(self) -> None:
        self.used.update(content(place.fixed) for place in self.slots if place.fixed is not None)

    def version(self, index: int) -> tuple[Exercise, ...]:
        ahead = Fraction(0)  # by so many minutes this version is longer than it should be, until here
        result: list[Exercise] = []
        for slot, place in enumerate(self.slots):
            exercise = place.fixed or self._best(slot, index, ahead)
            if place.fixed is None:
                self.used.add(content(exercise))
                self.answers.update((slot, *answer) for answer in (*told(exercise), *chosen(exercise)))
            ahead += self._excess(slot, exercise)
            result.append(exercise)
        if not self.first:
            self.first = tuple(result)
            self.times = tuple(map(_minutes, result))
        return tuple(result)

    def _best(self, slot: int, index: int, ahead: Fraction) -> Exercise:
        """The first problem that shares nothing; where none is found soon, the one that shares least."""
        best: tuple[tuple[Fraction, int, int], Exercise] | None = None
        for tried, exercise in enumerate(self._possible(slot, index), 1):
            price = self._price(slot, exercise, ahead)
            if best is None or price < best[0]:
                best = price, exercise
            if not any(best[0]) or tried >= (self.patience.get(slot, _FRESH) if any(best[0][:2]) else _BALANCED):
                break
        if best is not None:  # what was in vain is tried half as long the next time
            vain = any(best[0][:2])
            self.patience[slot] = max(_BALANCED, self.patience.get(slot, _FRESH) // 2) if vain else _FRESH
        if best is None:
            place = self.slots[slot]
            name, level = place.family, place.level
            if place.by_part and not self.first:
                what, each = place.by_part[0]
                raise error(
                    place.where,
                    f"{what} are given for {len(each)} parts, and no problem of {name} at level {level} has so "
                    "many; give another number of them, or one for the problem.",
                )
            raise UsageError(
                f"{name} has too few different problems at level {level} for this worksheet; "
                "ask for fewer versions or problems, or for more families."
            )
        return best[1]

    def _possible(self, slot: int, index: int) -> Iterator[Exercise]:
        """Problems that nobody has yet, with the parts that the first version has here."""
        place = self.slots[slot]
        seeds = self.draws(f"problems {self.seed} version {index} place {slot}")
        for _ in range(_ATTEMPTS):
            exercise = draw(place.family, place.level or 1, seeds.below(self.most))
            wanted = self.first[slot].problem.parts if self.first else None
            if content(exercise) not in self.used and _fits(exercise, place, wanted):
                yield exercise

    def _price(self, slot: int, exercise: Exercise, ahead: Fraction) -> tuple[Fraction, int, int]:
        """Minutes too many or too few, answers that somebody has here already, and how one-sided the choices are."""
        same = sum(self.answers[slot, label, answer] for label, answer in told(exercise))
        excess = abs(ahead + self._excess(slot, exercise)) - _TOLERANCE * sum(self.times)
        return max(Fraction(0), excess), same, self._one_sided(slot, exercise)

    def _excess(self, slot: int, exercise: Exercise) -> Fraction:
        """By so many minutes a problem takes longer than its place should."""
        return _minutes(exercise) - self.times[slot] if self.times else Fraction(0)

    def _one_sided(self, slot: int, exercise: Exercise) -> int:
        result = 0
        kinds = {part.label: part.kind for part in exercise.problem.parts}
        for label, answer in chosen(exercise):
            kind = kinds[label]
            options = tuple(kind.options) if isinstance(kind, Choice) else ("yes", "no")
            result += self.answers[slot, label, answer] - min(self.answers[slot, label, each] for each in options)
        return result


def _minutes(exercise: Exercise) -> Fraction:
    return minutes(exercise.solution)


def _fits(exercise: Exercise, place: Slot, like: Sequence[Part] | None) -> bool:
    """Whether a problem has as many parts as there are points and rules, and such parts as the first version has."""
    parts = exercise.problem.parts
    if any(len(each) != len(parts) for _, each in place.by_part):
        return False
    return like is None or [part.kind.name for part in parts] == [part.kind.name for part in like]
