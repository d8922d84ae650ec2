"""What an answer comes from: the causes that give it, weighed against each other and against chance."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import exp, inf, isnan, log
from typing import Any

from rldrill.solutions.answers.text import Reading
from rldrill.solutions.diagnosis import weights
from rldrill.solutions.diagnosis.causes import Cause
from rldrill.solutions.diagnosis.clock import Clock
from rldrill.solutions.diagnosis.outcomes import Outcome, Outcomes
from rldrill.solutions.diagnosis.typed import Typed, approximate
from rldrill.solutions.diagnosis.weights import ALIKE
from rldrill.solutions.exact import is_rational

#: How much must speak for a cause, before it is told: the logarithm of a ratio of chances, see ``_evidence``. Chosen so
#: that one number from nowhere in twenty is accused of something.
ENOUGH = 1.4
#: What is less likely than this is not spoken of at all.
FAINT = 0.25
#: What it says for a cause that it leaves right cells right, where nearly all of them are.
RIGHT_CELLS = 2.0
#: Of the causes whose answers are not computed so many lead to numbers of the form that was typed.
_OF_THE_FORM = 0.3
#: How much it counts how many answers any causes lead to, beside how many causes as likely lead to.
_UNLIKELY_TOO = 0.3
#: Where the time did not suffice, something likelier may have been missed: less than this is not spoken of.
SURE_ENOUGH = 4.0
#: A cause so much less likely than the likeliest is not spoken of; nor are more causes than this.
NEAR, MOST = 0.2, 2
#: As many answers there must be that could have been typed, before two causes together are believed.
ROOM_FOR_TWO = 20_000
#: Of so few answers one proves nothing: yes or no, a choice, an action or two.
_FEW = 4
#: A decimal has no more places than this.
_PLACES = 8
#: Numbers with parameters, and those of large denominators, are told apart so finely; and when one is on a grid.
_FINE, _FINEST, _PRECISE = 1e6, 10_000, 1e-6
#: A decimal tells no more numbers apart than this, where it is a rounded one.
_ROUNDED = 900


@dataclass(frozen=True)
class Explained:
    """The causes that an answer is put down to, the likeliest first, and how sure that is, 0 to 1.

    Args:
        causes: what is told.
        confidence: how sure it is one of them.
        evidence: how much speaks for them.
        every: all that lead to the answer, told or not.
    """

    causes: tuple[Cause, ...]
    confidence: float
    evidence: float = 0.0
    every: tuple[Cause, ...] = ()


def explained(outcomes: Outcomes, typed: Typed, clock: Clock) -> Explained:
    """What a wrong answer comes from; nothing, where that could be anything."""
    room = _room(typed, exact=True)
    if room < _FEW:
        return Explained((), 0.0)
    finished = outcomes.grow(clock)
    found = outcomes.giving(typed)
    if not found and room >= ROOM_FOR_TWO and finished:
        found = [*outcomes.giving_apart(typed)]
        if not found:
            finished = outcomes.grow_pairs(clock)
            found = outcomes.giving_in_turn(typed)
    if not found:
        return Explained((), 0.0)
    interrupted = not finished
    found = [_weighed(typed, candidate) for candidate in found]
    found.sort(key=lambda candidate: -candidate.cause.weight)
    best = found[0]
    evidence = _evidence(outcomes, typed, best)
    every = tuple(_distinct([each.cause for each in found]))
    if best.cause.weight < FAINT or evidence < ENOUGH or (interrupted and best.cause.weight < SURE_ENOUGH):
        return Explained((), 0.0, evidence, every)
    near = tuple(cause for cause in every[:MOST] if cause.weight >= NEAR * best.cause.weight)
    return Explained(near, 1 / (1 + exp(-evidence)), evidence, every)


def _weighed(typed: Typed, candidate: Outcome) -> Outcome:
    """A candidate, less likely where it agrees with what was typed in three digits only, and more were typed."""
    cells = candidate.cells or {}
    wrong = ((typed.cells[name], cells[name]) for name in typed.wrong)
    if all(_to_the_last_digit(cell, value) for cell, value in wrong if isinstance(cell, Reading)):
        return candidate
    cause = replace(candidate.cause, weight=candidate.cause.weight * weights.LOOSE)
    return replace(candidate, cause=cause)


def _to_the_last_digit(cell: Reading, value: Any) -> bool:
    """Whether a typed number is a value, rounded where its own digits end."""
    if not is_rational(cell.value):
        return True
    places = next((places for places in range(_PLACES) if 10**places % int(cell.value.q) == 0), _PLACES)
    return abs(approximate(cell.value) - approximate(value)) <= 0.51 * 10.0**-places


def _evidence(outcomes: Outcomes, typed: Typed, best: Outcome) -> float:
    """How much speaks for causes, and against chance, as a logarithm.

    Of all answers of the typed form and size each is as likely, if it comes from nowhere, and some of them are those
    that causes lead to. A whole number among twenty that could have been typed proves nothing if causes lead to ten
    of them; one with seven digits proves nearly everything. Nobody leaves right cells right by chance.
    """
    exact = _exactly(typed, best)
    room = _room(typed, exact=exact)
    if best.cause.then is not None:
        return ENOUGH + log(room / ROOM_FOR_TWO)
    causes = _of_the_form(outcomes, typed, best.cause.weight, exact=exact)
    right_cells = 1 - len(typed.wrong) / len(typed.key)
    return log(room / causes) + RIGHT_CELLS * right_cells


def _of_the_form(outcomes: Outcomes, typed: Typed, weight: float, *, exact: bool) -> float:
    """How many answers of the form and size that was typed causes lead to, if they spoil the same cells.

    Those that are less likely than this weight count little.
    """
    steps = [_step(typed, name, exact=exact) for name in typed.wrong]
    found: dict[tuple[int | None, ...], float] = {}
    others = 0
    places = [place for place, name in enumerate(outcomes.names) if name in typed.wrong]
    for rival in outcomes.single.spoiling.get(frozenset(typed.wrong), ()):
        heaviness, sizes = rival.cause.weight, [rival.sizes[place] for place in places]
        if any(map(isnan, sizes)):
            others += 1
            continue
        point = tuple(_on_grid(size, *step, exact=exact) for size, step in zip(sizes, steps, strict=True))
        if None not in point:
            found[point] = max(heaviness, found.get(point, 0.0))
    likely = sum(heaviness >= weight for heaviness in found.values())
    more = _OF_THE_FORM * others
    every = max(1, len(found)) + more
    return float(every**_UNLIKELY_TOO * (max(1, likely) + more) ** (1 - _UNLIKELY_TOO))


def _step(typed: Typed, name: str, *, exact: bool) -> tuple[float, float]:
    """How many numbers of the form of a cell there are between 0 and 1, and how large they may be."""
    cell = typed.cells[name]
    if not isinstance(cell, Reading) or not is_rational(cell.value):
        return _FINE, inf
    size = max(abs(approximate(cell.value)), abs(approximate(typed.key[name])), 1.0)
    return (min(int(cell.value.q), _FINEST) if exact else min(int(cell.value.q), _ROUNDED / (4 * size))), 2 * size


def _on_grid(size: float, step: float, most: float, *, exact: bool) -> int | None:
    """Which number of a form this is; None if it is none, or too large."""
    if not abs(size) <= most:
        return None
    place = size * step
    if exact and most < inf and abs(place - round(place)) > _PRECISE * max(1.0, abs(place)):
        return None
    return round(place)


def _room(typed: Typed, *, exact: bool) -> float:
    """How many answers could have been typed as well as this one."""
    room = 1.0
    for name in typed.wrong:
        cell = typed.cells[name]
        if not isinstance(cell, Reading):
            room *= 2
            continue
        value, key = cell.value, typed.key[name]
        if not is_rational(value):
            room *= 10_000 if exact else _ROUNDED
            continue
        size = max(abs(approximate(value)), abs(approximate(key)), 1.0)
        grid = 4 * size * int(value.q)
        room *= max(4.0, grid if exact else min(grid, _ROUNDED))
    return min(room, 1e15)


def _exactly(typed: Typed, candidate: Outcome) -> bool:
    """Whether what was typed is the candidate's answer to the last digit."""
    cells = candidate.cells or {}
    return all(
        bool(cell.value == cells[name]) for name in typed.wrong if isinstance(cell := typed.cells[name], Reading)
    )


def _distinct(causes: Sequence[Cause]) -> list[Cause]:
    """The causes that differ in what is done or where: of those that say the same, the likeliest."""
    found: list[Cause] = []
    for cause in causes:
        if not any(_alike(cause, other) for other in found):
            found.append(cause)
    return found


def _alike(one: Cause, two: Cause) -> bool:
    if one.application is not two.application and None not in (one.application, two.application):
        return False
    for zero, other in ((one, two), (two, one)):
        if zero.kind == "elsewhere" and zero.other == 0 and other.kind.endswith("left-out"):
            return True
    if one.mistake or two.mistake:
        return bool(one.mistake and two.mistake and one.mistake.says == two.mistake.says)
    return one.kind == two.kind or any({one.kind, two.kind} <= group for group in ALIKE)
