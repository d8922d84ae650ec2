"""What speaks for a cause, and what for chance: what is looked at, each a number with a name.

How much each of it counts is ``learnt.py``, which ``tests/diagnosis/learn.py`` writes anew. What comes of causes is
weighed against chance: of all answers of the typed form and size each is as likely, if it comes from nowhere, and some
of them are those that causes lead to. A whole number among twenty that could have been typed proves nothing if causes
lead to ten of them; one with seven digits proves nearly everything. Nobody leaves right cells right by chance.
"""

from bisect import bisect_left
from collections.abc import Mapping, Sequence
from functools import cached_property
from math import exp, inf, isnan, log
from typing import Any, TypeAlias

from msgspec import Struct, field

from rldrill.solutions.answers.text import Reading
from rldrill.solutions.diagnosis import weights
from rldrill.solutions.diagnosis.causes import Cause
from rldrill.solutions.diagnosis.learnt import COUNTS
from rldrill.solutions.diagnosis.outcomes import Outcome, Outcomes
from rldrill.solutions.diagnosis.typed import Typed, approximate
from rldrill.solutions.exact import is_rational

#: What is looked at: a number for each name.
Features: TypeAlias = Mapping[str, float]

#: A decimal has no more places than this.
_PLACES = 8
#: Numbers with parameters, and those of large denominators, are told apart so finely; and when one is on a grid.
_FINE, _FINEST, _PRECISE = 1e6, 10_000, 1e-6
#: A decimal tells no more numbers apart than this, where it is a rounded one.
_ROUNDED = 900
#: So many answers are as good as any number of them.
_MUCH_ROOM = 10**15
#: The logarithm of so many answers that could have been typed is many.
_MANY = log(400)
#: What counts otherwise where the answer is one number alone.
_OTHERWISE = frozenset(
    (
        "chance", "room", "room of many", "causes", "steps", "small", "fits the key", "way from the key",
        "far from the key", "other sign",
    )
)  # fmt: skip
#: Slips of arithmetic, which are the same in the last step as in the answer.
_ARITHMETIC = frozenset(weights.VALUES) - {"sign", "inverse"}
#: No number is further from the key than this, as a logarithm.
_FURTHEST = 3.0
#: A whole number is small up to this.
_SMALL = 12


class Weighing(Struct, dict=True):
    """The causes that give an answer, beside one another and beside chance."""

    outcomes: Outcomes
    typed: Typed
    found: Sequence[Outcome]
    _forms: dict[bool, list[float]] = field(default_factory=dict)

    def shares(self) -> list[float]:
        """How likely each of the causes is; what is missing to 1 is chance."""
        scores = [score(features) for features in self.causes]
        highest = max(*scores, chance := score(self.chance))
        shares = [exp(each - highest) for each in scores]
        whole = sum(shares) + exp(chance - highest)
        return [share / whole for share in shares]

    @cached_property
    def causes(self) -> list[Features]:
        """What speaks for each cause."""
        return [self._of(outcome) for outcome in self.found]

    @cached_property
    def chance(self) -> Features:
        """What speaks for chance."""
        typed, key = self.typed, self.typed.key
        room_ = log(room(typed, exact=self._any_exact))
        wrong, every = len(typed.wrong), len(key)
        numbers = [(cell.value, key[name]) for name in typed.wrong if isinstance(cell := typed.cells[name], Reading)]
        rational = [(value, right) for value, right in numbers if is_rational(value) and is_rational(right)]
        ways = [_way(approximate(value), approximate(right)) for value, right in numbers]
        turned = [approximate(value) * approximate(right) < 0 for value, right in numbers]
        seen = {
            "chance": 1.0,
            "room": room_,
            "room of many": max(0.0, room_ - _MANY),
            "room of one": room_ if wrong == 1 else 0.0,
            "causes": log(1 + len(self._rivals)),
            "steps": log(1 + len(self.outcomes.search.applications)),
            "several wrong": float(wrong > 1),
            "some right": float(wrong < every),
            "one of several wrong": float(wrong == 1 < every),
            "share wrong": wrong / every if every > 1 else 0.0,
            "two slips": float(all(outcome.cause.then is not None for outcome in self.found)),
            "small": float(all(is_rational(value) and value.q == 1 and abs(value) <= _SMALL for value, _ in numbers)),
            "fits the key": float(len(rational) == wrong and all(right.q % value.q == 0 for value, right in rational)),
            "way from the key": sum(ways) / wrong,
            "far from the key": sum(max(0.0, way - 1) for way in ways) / wrong,
            "other sign": sum(turned) / wrong,
        }
        alone = {f"alone: {name}": value for name, value in seen.items() if name in _OTHERWISE}
        return seen | alone if every == 1 else seen

    def _of(self, outcome: Outcome) -> Features:
        cause = outcome.cause
        exact = exactly(self.typed, outcome)
        to_the_last = _to_the_last_digit(self.typed, outcome)
        weight = cause.weight if to_the_last else cause.weight * weights.LOOSE
        likelier = self._of_the_form(exact=exact)
        return {
            "weight": log(cause.weight),
            f"scope {scope(cause)}": 1.0,
            f"kind {cause.kind}": 1.0,
            "rounded": float(not exact),
            "loose": float(not to_the_last),
            "likelier": log(1 + len(likelier) - bisect_left(likelier, weight)),
        }

    @cached_property
    def _any_exact(self) -> bool:
        return any(exactly(self.typed, outcome) for outcome in self.found)

    @cached_property
    def _rivals(self) -> Sequence[Outcome]:
        """The causes that spoil just these cells."""
        return self.outcomes.single.spoiling.get(frozenset(self.typed.wrong), ())

    def _of_the_form(self, *, exact: bool) -> list[float]:
        """How likely the answers of the typed form and size are that causes lead to, the likeliest last."""
        if exact not in self._forms:
            steps = [_step(self.typed, name, exact=exact) for name in self.typed.wrong]
            places = [place for place, name in enumerate(self.outcomes.names) if name in self.typed.wrong]
            found: dict[tuple[int, ...], float] = {}
            for rival in self._rivals:
                point = _point([rival.sizes[place] for place in places], steps, exact=exact)
                if point is not None:
                    found[point] = max(rival.cause.weight, found.get(point, 0.0))
            self._forms[exact] = sorted(found.values())
        return self._forms[exact]


def score(features: Features) -> float:
    """How much speaks for something, as a logarithm."""
    return sum(COUNTS.get(name, 0.0) * value for name, value in features.items())


def scope(cause: Cause) -> str:
    """Where a cause does its harm, in one word or two."""
    if cause.then is not None:
        return "two"
    if cause.mistake is not None:
        return "listed"
    if cause.on_paper:
        return "one value" if is_last_slip(cause) else "answer"
    term = " term" if cause.term or cause.nth is not None else ""
    where = "equation" if cause.application is not None and cause.application.equation else "one"
    if cause.probe is not None:
        return f"{where} inside{term}"
    if cause.edit is not None:
        return f"everywhere{term}" if cause.application is None else f"{where}{term}"
    return f"{where} value" if cause.application is not None else "procedure"


def is_last_slip(cause: Cause) -> bool:
    """Whether it is a slip of arithmetic in the answer: the same as in the last step."""
    return cause.on_paper and cause.kind in _ARITHMETIC


def room(typed: Typed, *, exact: bool) -> float:
    """How many answers could have been typed as well as this one."""
    many = 1.0
    for name in typed.wrong:
        cell = typed.cells[name]
        if not isinstance(cell, Reading):
            many *= 2
            continue
        value, key = cell.value, typed.key[name]
        if not is_rational(value):
            many *= 10_000 if exact else _ROUNDED
            continue
        size = max(abs(approximate(value)), abs(approximate(key)), 1.0)
        grid = 4 * size * min(int(value.q), _MUCH_ROOM)
        many *= max(4.0, grid if exact else min(grid, _ROUNDED))
    return min(many, _MUCH_ROOM)


def exactly(typed: Typed, outcome: Outcome) -> bool:
    """Whether what was typed is what a cause leads to, to the last digit."""
    cells = outcome.cells or {}
    return all(
        bool(cell.value == cells[name]) for name in typed.wrong if isinstance(cell := typed.cells[name], Reading)
    )


def _to_the_last_digit(typed: Typed, outcome: Outcome) -> bool:
    """Whether the typed numbers are those of a cause, rounded where their own digits end."""
    cells = outcome.cells or {}
    return all(
        _is_rounded(cell.value, cells[name])
        for name in typed.wrong
        if isinstance(cell := typed.cells[name], Reading) and is_rational(cell.value)
    )


def _is_rounded(number: Any, value: Any) -> bool:
    places = next((places for places in range(_PLACES) if 10**places % int(number.q) == 0), _PLACES)
    return abs(approximate(number) - approximate(value)) <= 0.51 * 10.0**-places


def _way(size: float, key: float) -> float:
    """How far a number is from the key, as the logarithm of their ratio."""
    if not size or not key:
        return 0.0 if size == key else _FURTHEST
    way = abs(log(abs(size / key)))
    return way if way < _FURTHEST else _FURTHEST


def _step(typed: Typed, name: str, *, exact: bool) -> tuple[float, float]:
    """How many numbers of the form of a cell there are between 0 and 1, and how large they may be."""
    cell = typed.cells[name]
    if not isinstance(cell, Reading) or not is_rational(cell.value):
        return _FINE, inf
    size = max(abs(approximate(cell.value)), abs(approximate(typed.key[name])), 1.0)
    return (min(int(cell.value.q), _FINEST) if exact else min(int(cell.value.q), _ROUNDED / (4 * size))), 2 * size


def _point(sizes: Sequence[float], steps: Sequence[tuple[float, float]], *, exact: bool) -> tuple[int, ...] | None:
    """Which numbers of a form these are; None if one is none, or too large, or not known."""
    point = []
    for size, (step, most) in zip(sizes, steps, strict=True):
        if isnan(size) or abs(size) > most:
            return None
        place = size * step
        if exact and most < inf and abs(place - round(place)) > _PRECISE * max(1.0, abs(place)):
            return None
        point.append(round(place))
    return tuple(point)
