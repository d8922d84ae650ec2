"""Whether the versions of an exam are equally hard and nobody can copy: what they share, and how long they take."""

import json
from collections import Counter
from collections.abc import Iterator, Mapping

from msgspec import Struct
from msgspec.structs import asdict

from rldrill.exam.exam import Exam, Version
from rldrill.exercise import Exercise
from rldrill.problems.parts import Choice, Part, Policy, YesNo
from rldrill.solutions.answers.kinds import answer_kind

#: How far an exam's minutes may be from those that are wanted, in parts of these, without a word.
_NEAR = 0.1


class Fairness(Struct, frozen=True):
    """The figures of an exam's versions.

    Args:
        shared_problems: how many problems a version has in common with another one, fixed ones aside.
        shared_answers: how many answers to the same part of the same place a version has in common with another one.
        minutes: the least and the most expected minutes of a version.
        spread: how much more the longest version takes than the shortest, in parts of the shortest.
        scarce: where answers are shared, how many different ones there are, as ``3 b: 10``.
        balance: how often each answer is right where there are only a few to choose from, as ``3 b: yes 15, no 15``.
        families: the family and level of those places, by their number.
        fixed: how many places hold the same problem in every version.
    """

    shared_problems: int
    shared_answers: int
    minutes: tuple[int, int]
    spread: float
    scarce: Mapping[str, int]
    balance: Mapping[str, Mapping[str, int]]
    families: Mapping[str, str]
    fixed: int = 0

    def says(self) -> str:
        """The figures in a sentence."""
        aside = f", {self.fixed} the same in all" if self.fixed else ""
        return (
            f"shared problems {self.shared_problems}{aside}, shared answers {self.shared_answers}, "
            f"{self.minutes[0]} to {self.minutes[1]} minutes (spread {100 * self.spread:.1f} %)"
        )

    def says_what_is_missed(self, wanted: int) -> str:
        """How many minutes there are, in a sentence, where they miss those that are wanted; nothing where not."""
        if all(abs(minutes - wanted) <= _NEAR * wanted for minutes in self.minutes):
            return ""
        return (
            f"the problems take {self._found} minutes, not {wanted}; ask for other minutes, or name more topics or "
            "problems"
        )

    def says_what_is_printed(self, duration: int) -> str:
        """That the minutes at the head are fewer than the problems take, or more than twice as many; or nothing."""
        if max(self.minutes) <= duration <= 2 * max(self.minutes):
            return ""
        return (
            f"the problems take {self._found} minutes, and the head says {duration}; correct 'duration' or the problems"
        )

    @property
    def _found(self) -> str:
        least, most = self.minutes
        return f"{least}" if least == most else f"{least} to {most}"

    def says_what_is_scarce(self, versions: int) -> str:
        """Where answers are shared, and why, in a sentence; nothing where none are."""
        told: dict[str, list[str]] = {}
        for place, count in self.scarce.items():
            number, _, label = place.partition(" ")
            told.setdefault(number, []).append(f"{count} to ({label})")
        each = "; ".join(
            f"problem {number} ({self.families[number]}): {', '.join(all_)}" for number, all_ in told.items()
        )
        return f"fewer different answers than {versions} versions: {each}" if told else ""

    def data(self) -> dict[str, object]:
        """The figures as JSON has them."""
        figures = asdict(self) | {"spread": round(self.spread, 4)}
        del figures["families"], figures["fixed"]
        return figures


def fairness(exam: Exam) -> Fairness:
    """The figures of an exam."""
    fixed = fixed_slots(exam)
    contents: Counter[str] = Counter()
    answers: Counter[tuple[int, str, str]] = Counter()
    balance: dict[str, Counter[str]] = {}
    families: dict[str, str] = {}
    for version in exam.versions:
        for slot, exercise in placed(version):
            if slot in fixed:
                continue
            contents[content(exercise)] += 1
            families[str(slot + 1)] = f"{exercise.problem.family.name} at level {exercise.problem.level}"
            answers.update((slot, label, answer) for label, answer in told(exercise))
            for label, answer in chosen(exercise):
                balance.setdefault(f"{slot + 1} {label}", Counter())[answer] += 1
    different = Counter((slot, label) for slot, label, _ in answers)
    scarce = {
        f"{slot + 1} {label}": count
        for (slot, label), count in sorted(different.items())
        if count < sum(found for (where, part, _), found in answers.items() if (where, part) == (slot, label))
    }
    times = [version.time for version in exam.versions]
    return Fairness(
        sum(count - 1 for count in contents.values()),
        sum(count - 1 for count in answers.values()),
        (min(version.minutes for version in exam.versions), max(version.minutes for version in exam.versions)),
        float(max(times) / min(times) - 1),
        scarce,
        balance,
        families,
        len(fixed),
    )


def fixed_slots(exam: Exam) -> frozenset[int]:
    """The places that hold the same problem in every version, because the blueprint says so."""
    if len(exam.versions) == 1:
        return frozenset()
    first, second = (dict(placed(version)) for version in exam.versions[:2])
    return frozenset(slot for slot in first if content(first[slot]) == content(second[slot]))


def placed(version: Version) -> Iterator[tuple[int, Exercise]]:
    """The problems of a version with their places."""
    return zip(version.slots, version.exercises, strict=True)


def content(exercise: Exercise) -> str:
    """What is given in a problem, as text: two problems are the same if this is."""
    return json.dumps(exercise.problem.data(), sort_keys=True)


def told(exercise: Exercise) -> Iterator[tuple[str, str]]:
    """The answers that are worth copying: all but those that are chosen from a few."""
    for part in exercise.problem.parts:
        if not _is_chosen(part):
            yield part.label, _text(exercise, part)


def chosen(exercise: Exercise) -> Iterator[tuple[str, str]]:
    """The answers that are chosen from a few."""
    for part in exercise.problem.parts:
        if _is_chosen(part) and not isinstance(part.kind, Policy):
            yield part.label, _text(exercise, part)


def _is_chosen(part: Part) -> bool:
    return isinstance(part.kind, Choice | YesNo | Policy)


def _text(exercise: Exercise, part: Part) -> str:
    data = answer_kind(part.kind).data(exercise.solution.answers[part.label])
    if isinstance(part.kind, YesNo):
        return "yes" if data in (True, "yes") else "no"
    return data if isinstance(data, str) else json.dumps(data, ensure_ascii=False)
