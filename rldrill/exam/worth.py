"""Points: what every part of an exam earns, by the minutes, as its blueprint sets them, or scaled to a total."""

from collections.abc import Sequence
from fractions import Fraction

from rldrill.exam.slots import Slot, error
from rldrill.exercise import Exercise
from rldrill.solutions.effort import minutes_of, points


def worth(slots: Sequence[Slot], exercises: Sequence[Exercise], total: int | None, where: str) -> list[dict[str, int]]:
    """The points of every part of every problem.

    Args:
        slots: the places, with the points that are set.
        exercises: a problem for each of them.
        total: what all of them together shall earn, if that is set.
        where: what complaints about the total begin with.

    Raises:
        FileError: the points of a blueprint do not add up.
        UsageError: those of a command line do not.
    """
    result = [_set(slot, exercise) for slot, exercise in zip(slots, exercises, strict=True)]
    if total is None:
        return [given or points(exercise.solution) for given, exercise in zip(result, exercises, strict=True)]
    spent = sum(sum(given.values()) for given in result)
    waiting = [
        (index, label, minutes_of(exercise.solution, label))
        for index, (given, exercise) in enumerate(zip(result, exercises, strict=True))
        if not given
        for label in points(exercise.solution)
    ]
    rest = total - spent
    if not waiting and rest:
        raise error(where, f"the problems' points add up to {spent}, not to {total}; change one of them or the total.")
    if waiting and rest < len(waiting):
        raise error(
            where,
            f"of {total} points {max(0, rest)} are left for {len(waiting)} part{'s' * (len(waiting) > 1)} without "
            "points of their own, and each needs one; raise the total.",
        )
    for (index, label, _), share in zip(waiting, shared([amount for *_, amount in waiting], rest), strict=True):
        result[index][label] = share
    return result


def partial(slots: Sequence[Slot], exercises: Sequence[Exercise]) -> list[dict[str, str]]:
    """The rules for wrong entries of every problem's parts, where the blueprint sets others than the exam's.

    Raises:
        FileError: there are more or fewer of them than parts.
    """
    return [_rules(slot, exercise) for slot, exercise in zip(slots, exercises, strict=True)]


def _rules(slot: Slot, exercise: Exercise) -> dict[str, str]:
    labels = [part.label for part in exercise.problem.parts]
    if slot.partial is None:
        return {}
    rules = [slot.partial] * len(labels) if isinstance(slot.partial, str) else slot.partial
    if len(rules) != len(labels):
        raise error(
            slot.where,
            f"partial is given for {len(rules)} part{'s' * (len(rules) > 1)}, and {slot.family} has {len(labels)} "
            "here; give so many, or one rule for the problem.",
        )
    return dict(zip(labels, rules, strict=True))


def shared(weights: Sequence[Fraction | int], total: int) -> list[int]:
    """A total in whole shares that follow the weights, each at least 1; what is left over goes to the largest rests."""
    spare = total - len(weights)
    exact = [Fraction(spare) * weight / sum(weights) for weight in weights]
    shares = [int(share) for share in exact]
    order = sorted(range(len(weights)), key=lambda index: shares[index] - exact[index])
    for index in order[: spare - sum(shares)]:
        shares[index] += 1
    return [share + 1 for share in shares]


def _set(slot: Slot, exercise: Exercise) -> dict[str, int]:
    """The points that are set for the parts of a problem; none where they are not."""
    labels = [part.label for part in exercise.problem.parts]
    match slot.points:
        case None:
            return {}
        case int(amount):
            if amount < len(labels):
                raise error(
                    slot.where,
                    f"{slot.family} has {len(labels)} parts, each of which needs a point, and is given {amount}.",
                )
            times = [minutes_of(exercise.solution, label) for label in labels]
            return dict(zip(labels, shared(times, amount), strict=True))
        case several:
            if len(several) != len(labels):
                raise error(
                    slot.where,
                    f"points are given for {len(several)} part{'s' * (len(several) > 1)}, and {slot.family} has "
                    f"{len(labels)} here; give so many, or one number for the problem.",
                )
            return dict(zip(labels, several, strict=True))
