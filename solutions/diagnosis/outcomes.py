"""What causes make of the answer to one part: worked out once, and looked up by what was typed."""

from bisect import bisect_left, bisect_right
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import combinations
from math import isclose, isnan, nan
from typing import Any

from msgspec import Struct, field
from msgspec.structs import replace

from rldrill.problems.parts import Part, Policy
from rldrill.solutions.answers.judging import wrong_cells
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.diagnosis import weights
from rldrill.solutions.diagnosis.alternatives import LIKELY, hashable, likely, numbers, plain
from rldrill.solutions.diagnosis.causes import Again, Candidate, Cause
from rldrill.solutions.diagnosis.clock import Clock
from rldrill.solutions.diagnosis.replay import UNDONE, Application, Change, Traced
from rldrill.solutions.diagnosis.search import Search
from rldrill.solutions.diagnosis.typed import Typed, approximate, cells_of, equal, may_mean, near, reach
from rldrill.solutions.diagnosis.written_down import as_a_whole, written_down

#: Where an answer is no straight line in a value, so many other values of one application are gone on from.
_REPLAYS = 150
#: Two slips in turn: the first is one of so many, and so many pairs of places are tried.
_FIRST, _TRIES = 12, 150
#: So exactly a straight line is one, and a cell is that of the key.
_STRAIGHT = 1e-9


def _alike(one: float, other: float) -> bool:
    return isclose(one, other, rel_tol=_STRAIGHT, abs_tol=_STRAIGHT)


class Outcome(Struct, eq=False):
    """A cause, and what it makes of the cells of an answer.

    Args:
        cause: what was done.
        sizes: what the cells are worth, roughly; nan where that is not known.
        spoilt: the cells that are others than those of the key.
        change: what to replay for the cells themselves.
        cells: these, where they are worked out.
        again: how to get the answers from other earlier ones, where that is no change.
    """

    cause: Cause
    sizes: tuple[float, ...]
    spoilt: frozenset[str]
    change: Change | None = None
    cells: Mapping[str, Any] | None = None
    again: Again | None = None


class _Sorted(Struct):
    """Outcomes by what they make of one cell; those for which that is not known are apart."""

    place: int
    taken: int = 0
    known: list[tuple[float, int]] = field(default_factory=list)
    unknown: list[int] = field(default_factory=list)

    def take(self, outcomes: Sequence[Outcome]) -> None:
        if self.taken == len(outcomes):
            return
        for number in range(self.taken, len(outcomes)):
            size = outcomes[number].sizes[self.place]
            if isnan(size):
                self.unknown.append(number)
            else:
                self.known.append((size, number))
        self.known.sort()
        self.taken = len(outcomes)

    def near(self, size: float) -> Iterator[int]:
        yield from self.unknown
        lowest, highest = reach(size)
        start, end = bisect_left(self.known, (lowest,)), bisect_right(self.known, (highest,))
        yield from sorted(number for _, number in self.known[start:end])


class Kept:
    """Outcomes, found by what was typed."""

    def __init__(self, names: Sequence[str]) -> None:
        self.every: list[Outcome] = []
        self.spoiling: dict[frozenset[str], list[Outcome]] = defaultdict(list)
        self._names = names
        self._sorted = {name: _Sorted(place) for place, name in enumerate(names)}

    def add(self, outcome: Outcome) -> None:
        """Keep one; what spoils nothing is none."""
        if outcome.spoilt:
            self.every.append(outcome)
            self.spoiling[outcome.spoilt].append(outcome)

    def near(self, typed: Typed) -> Iterator[Outcome]:
        """Those that make of every cell roughly what was typed."""
        for outcome in self.near_at(typed, next((name for name in typed.wrong if name in typed.sizes), None)):
            if all(
                near(size, typed.sizes[name])
                for name, size in zip(self._names, outcome.sizes, strict=True)
                if name in typed.sizes
            ):
                yield outcome

    def near_at(self, typed: Typed, name: str | None) -> Iterator[Outcome]:
        """Those that make of one cell roughly what was typed; all, where that is no number."""
        if name is None or isnan(typed.sizes[name]):
            yield from list(self.every)
            return
        self._sorted[name].take(self.every)
        for number in self._sorted[name].near(typed.sizes[name]):
            yield self.every[number]


class Outcomes:
    """What causes make of the answer to one part, as far as there was time to work it out."""

    def __init__(self, search: Search, part: Part, key: Mapping[str, Any]) -> None:
        self.search, self.part, self.key = search, part, key
        self.names = tuple(key)
        self.sizes = tuple(_size(value) for value in key.values())
        self.single, self.double = Kept(self.names), Kept(self.names)
        self.finished = False
        self._taken = 0
        self._bearing: list[Application] = []
        self._growth = self._at_applications()
        self._pairs = self._in_turn()
        of_two = search.solution.is_one_of_two_shares(part.label)
        for cause, cells in (*written_down(part, key, search.applications, of_two=of_two), *self._of_parts_before()):
            self._keep(cause, cells)

    def _of_parts_before(self) -> Iterator[tuple[Cause, Mapping[str, Any]]]:
        """The answers to the parts before that have the same cells."""
        for other in self.search.problem.parts:
            if other.label == self.part.label:
                return
            answer = self.search.work.answers.get(other.label)
            cells = {} if answer is None else answer_kind(other.kind).cells(answer)
            if tuple(cells) == self.names and all(map(plain, cells.values())):
                weight = weights.ANSWERS["another-part"]
                yield Cause("another-part", weight, what=f"({other.label})", on_paper=True), cells

    # Growing ----------------------------------------------------------------------------------------
    def grow(self, clock: Clock) -> bool:
        """Work out what one cause alone leads to, as far as there is time; whether that is all now."""
        while not self.finished:
            whole = self.search.whole(clock)
            for candidate in whole[self._taken :]:
                if clock.over:
                    return False
                self._taken += 1
                cells = self.cells_of(candidate.answers)
                if cells is not None:
                    self._keep(candidate.cause, cells, again=candidate.again)
                    self._here_alone(candidate, cells)
            while not clock.over and not self.finished:
                self.finished = next(self._growth, True)
            if clock.over:
                break
        return self.finished

    def grow_pairs(self, clock: Clock) -> bool:
        """Work out what two slips in turn lead to, as far as there is time; whether that is all now."""
        while not clock.over:
            if next(self._pairs, True):
                return True
        return False

    def cells_of(self, answers: Mapping[str, Any] | None) -> Mapping[str, Any] | None:
        """The cells of this part among some answers; None where they have no such part, or another one."""
        return cells_of(self.part, self.key, answers)

    def _here_alone(self, candidate: Candidate, cells: Mapping[str, Any]) -> None:
        """The same done here alone, by somebody who had the right answers to the parts before."""
        right = {label: value for label, value in self.search.solution.answers.items() if label < self.part.label}
        if self.search.carried or all(candidate.answers.get(label) == value for label, value in right.items()):
            return
        alone = self.cells_of(self.search.alone(candidate))
        if alone is not None and alone != cells:
            weight = candidate.cause.weight * weights.HERE_ALONE
            cause = replace(candidate.cause, weight=weight, here=self.part.label)
            self._keep(cause, alone, again=candidate.again)

    def _keep(
        self, cause: Cause, cells: Mapping[str, Any], change: Change | None = None, again: Again | None = None
    ) -> None:
        sizes = tuple(_size(cells[name]) for name in self.names)
        self.single.add(Outcome(cause, sizes, self._spoilt(sizes, cells), change, cells, again))

    def _spoilt(self, sizes: Sequence[float], cells: Mapping[str, Any] | None = None) -> frozenset[str]:
        return frozenset(
            name
            for name, size, right in zip(self.names, sizes, self.sizes, strict=True)
            if size != right
            and (
                not _alike(size, right)
                if not isnan(size - right)
                else cells is None or not equal(cells[name], self.key[name])
            )
        )

    def _at_applications(self) -> Iterator[bool]:
        """What else can come out of every application, one after the other."""
        for application in self.search.applications:
            answered = [
                (other, cells)
                for other, answers in self.search.responses(application)
                if (cells := self.cells_of(answers)) is not None
            ]
            yield False
            line = None
            if len(answered) == len(self.search.responses(application)):
                line = _Line.through(application, answered, self.sizes, self.names)
            if line is None and answered and all(self._unspoilt(cells) for _, cells in answered):
                continue
            if line is not None and line.flat:
                continue
            self._bearing.append(application)
            for _ in self.search.working_out(application):
                yield False
            if line is None:
                yield from self._replayed(application)
                continue
            for cause in self.search.alternatives(application):
                sizes = line.at(cause.became)
                change = Change(values={application.number: cause.became})
                self.single.add(Outcome(cause, sizes, self._spoilt(sizes), change))
            yield False

    def _unspoilt(self, cells: Mapping[str, Any]) -> bool:
        return all(equal(cells[name], right) for name, right in self.key.items())

    def _replayed(self, application: Application) -> Iterator[bool]:
        """The likeliest values of an application, each gone on from."""
        done: dict[Any, Mapping[str, Any] | None] = {}
        for cause in self.search.alternatives(application):
            same, change = hashable(cause.became), Change(values={application.number: cause.became})
            if same not in done:
                if len(done) >= _REPLAYS:
                    return
                done[same] = self.cells_of(self.search.replay(change))
                yield False
            if (cells := done[same]) is not None:
                self._keep(cause, cells, change)

    def _in_turn(self) -> Iterator[bool]:
        """Two slips, the second one in a working that goes on from the first; the likeliest first ones first."""
        places = {each.number for each in self._bearing}
        firsts = [
            (first, application)
            for application in self._bearing
            for first in self.search.alternatives(application)[:_FIRST]
            if first.weight >= LIKELY
        ]
        firsts.sort(key=lambda each: -each[0].weight)
        tries = 0
        for first, application in firsts:
            trace: list[Traced] = []
            if self.search.replay(Change(values={application.number: first.became}), trace) is None:
                continue
            yield False
            for traced in trace:
                if traced[0] > application.number and traced[0] in places and plain(traced[3]):
                    self._second(application, first, traced)
                    tries += 1
                    if tries >= _TRIES:
                        return
                    yield False

    def _second(self, application: Application, first: Cause, traced: Traced) -> None:
        number, right, known, value = traced
        values = {application.number: first.became}
        heights = []
        for other in (value, value + 1, value - 3):
            cells = self.cells_of(self.search.replay(Change(values={**values, number: other})))
            if cells is None:
                return
            heights.append([_size(cells[name]) for name in self.names])
        slopes = [one - at for at, one, _ in zip(*heights, strict=True)]
        for at, slope, minus in zip(heights[0], slopes, heights[2], strict=True):
            if not _alike(at - 3 * slope, minus):
                return
        if not any(slopes):
            return
        second = self.search.applications[number]
        start = approximate(value)
        for kind, weight, edit, other in likely(right, known, value):
            way = approximate(other) - start
            sizes = tuple(at + slope * way for at, slope in zip(heights[0], slopes, strict=True))
            then = Cause(kind, weight, second, second.formula, edit, was=value, became=other)
            both = replace(first, weight=first.weight * weight / 100, then=then)
            self.double.add(Outcome(both, sizes, self._spoilt(sizes), Change(values={**values, number: other})))

    # Looking up -------------------------------------------------------------------------------------
    def stands(self, outcome: Outcome, settled: Mapping[str, Any]) -> bool:
        """Whether a cause gives the same to somebody whose earlier answers are settled, since they were right."""
        again = outcome.again
        if outcome.change is not None:
            again = partial(self.search.replay, outcome.change, None)
        if not settled or again is None:
            return True
        cells = self.cells_of(again(settled))
        return cells is not None and all(equal(cells[name], right) for name, right in (outcome.cells or {}).items())

    def made_here(self, outcome: Outcome, settled: Mapping[str, Any]) -> Outcome:
        """An outcome; of an edit that gives wrong answers to parts before, which were right, one of this part alone."""
        cause = outcome.cause
        if not settled or cause.edit is None or cause.application is not None or cause.here or outcome.again is None:
            return outcome
        answers = outcome.again({}) or {}
        if all(label in answers and equal(answers[label], right) for label, right in settled.items()):
            return outcome
        return replace(outcome, cause=replace(cause, here=self.part.label))

    def anew(self, outcome: Outcome, settled: Mapping[str, Any]) -> Outcome | None:
        """A formula misread by somebody who works the part out anew, and does not go on from a right answer before.

        A slip of arithmetic, and a number read wrongly, would have spoilt that answer: of these there is none.
        """
        cause = outcome.cause
        if cause.mistake is None and cause.edit is None:
            return None
        denying = [label for label in settled if not self.stands(outcome, {label: settled[label]})] or [max(settled)]
        weight = cause.weight * weights.ANEW ** (len(denying) if cause.mistake is None else 1)
        return replace(outcome, cause=replace(cause, weight=weight, anew=max(denying)))

    def gives_before(self, outcome: Outcome, wrong: Mapping[str, Any]) -> bool:
        """Whether a cause gives these wrong answers to parts before, and with them what it is said to give here."""
        again = outcome.again if outcome.change is None else partial(self.search.replay, outcome.change, None)
        answers = None if again is None else again({})
        cells = self.cells_of(answers)
        if (
            answers is None
            or cells is None
            or any(not equal(cells[name], value) for name, value in (outcome.cells or {}).items())
        ):
            return False
        try:
            return not any(self.search.solution.differ(label, answers[label], value) for label, value in wrong.items())
        except (*UNDONE, KeyError):
            return False

    def giving(self, typed: Typed) -> list[Outcome]:
        """The causes that give what was typed."""
        found = [outcome for outcome in self.single.near(typed) if self._gives(outcome, typed)]
        found = [outcome for outcome in found if not self._decides_nothing(outcome)]
        for cause, cells in as_a_whole(typed):
            sizes = tuple(_size(cells[name]) for name in self.names)
            found.append(Outcome(cause, sizes, frozenset(self.names), None, cells))
        return found

    def _decides_nothing(self, outcome: Outcome) -> bool:
        """Whether it leaves every choice open that there is, which nobody takes for an answer."""
        if not isinstance(self.part.kind, Policy) or outcome.cells is None:
            return False
        possible = self.part.kind.actions
        return all(len(outcome.cells[state]) == len(actions) for state, actions in possible.items())

    def giving_in_turn(self, typed: Typed) -> list[Outcome]:
        """The pairs of slips in turn that do."""
        return [outcome for outcome in self.double.near(typed) if self._gives(outcome, typed)]

    def giving_apart(self, typed: Typed) -> Iterator[Outcome]:
        """Two causes, each of other cells, that together do."""
        wrong = frozenset(typed.wrong)
        partly: dict[frozenset[str], Outcome] = {}
        for name in typed.wrong if wrong <= typed.sizes.keys() else ():
            for outcome in self.single.near_at(typed, name):
                if outcome.cause.application is None or outcome.change is None:
                    continue
                cells = self._explained(outcome, typed)
                if cells and cells < wrong and partly.get(cells, outcome).cause.weight <= outcome.cause.weight:
                    partly[cells] = outcome
        for (one, first), (two, second) in combinations(partly.items(), 2):
            if one | two != wrong or one & two or first.change is None or second.change is None:
                continue
            change = Change(values={**first.change.values, **second.change.values})
            sizes = tuple(
                own if name in one else other
                for name, own, other in zip(self.names, first.sizes, second.sizes, strict=True)
            )
            both = Outcome(_together(first.cause, second.cause), sizes, wrong, change)
            if self._gives(both, typed):
                yield both

    def _explained(self, outcome: Outcome, typed: Typed) -> frozenset[str]:
        """The wrong cells that come out as typed, if no right one is spoilt."""
        still = {
            name
            for name, size in zip(self.names, outcome.sizes, strict=True)
            if not near(size, typed.sizes.get(name, nan))
        }
        wrong = frozenset(typed.wrong)
        return wrong - still if still <= wrong else frozenset()

    def _gives(self, outcome: Outcome, typed: Typed) -> bool:
        if outcome.cells is None and outcome.change is not None:
            outcome.cells = self.cells_of(self.search.replay(outcome.change))
        if outcome.cells is None:
            outcome.change = None
            return False
        try:
            if wrong_cells(typed.cells, outcome.cells):
                return False
            return all(may_mean(typed.cells[name], outcome.cells[name]) for name in typed.wrong)
        except UNDONE:
            return False


def _together(first: Cause, second: Cause) -> Cause:
    weight = first.weight * second.weight / 100
    one, two = sorted((first, second), key=lambda cause: cause.application.number if cause.application else -1)
    return replace(one, weight=weight, then=two)


def _size(value: Any) -> float:
    return nan if isinstance(value, str | tuple) else approximate(value)


class _Line(Struct, frozen=True):
    """How the cells depend on the numbers of a value, where that is a straight line."""

    start: Sequence[float]
    base: Sequence[float]
    slopes: Sequence[Sequence[float]]

    @classmethod
    def through(
        cls,
        application: Application,
        answered: Sequence[tuple[Sequence[Any] | None, Mapping[str, Any]]],
        base: Sequence[float],
        names: Sequence[str],
    ) -> "_Line | None":
        """The line through the answers for a few values; None where there is none."""
        own = numbers(application.value)
        if own is None or not answered or answered[0][0] is None:
            return None
        start = list(map(approximate, own))
        heights = [[_size(cells[name]) for name in names] for _, cells in answered]
        slopes = [[height - at for height, at in zip(row, base, strict=True)] for row in heights[: len(own)]]
        line = cls(start, base, list(zip(*slopes, strict=True)))
        for (other, _), row in zip(answered[len(own) :], heights[len(own) :], strict=True):
            expected = line._from([approximate(each) - at for each, at in zip(other or (), start, strict=True)])
            if not all(map(_alike, expected, row)):
                return None
        return line

    @property
    def flat(self) -> bool:
        """Whether the cells do not depend on it."""
        return not any(any(slopes) for slopes in self.slopes)

    def at(self, value: Any) -> tuple[float, ...]:
        """The cells for another value."""
        others = numbers(value) or ()
        return self._from([approximate(other) - at for other, at in zip(others, self.start, strict=True)])

    def _from(self, ways: Sequence[float]) -> tuple[float, ...]:
        if len(ways) == 1:
            way = ways[0]
            return tuple(at + slopes[0] * way for at, slopes in zip(self.base, self.slopes, strict=True))
        return tuple(
            at + sum(slope * way for slope, way in zip(slopes, ways, strict=True))
            for at, slopes in zip(self.base, self.slopes, strict=True)
        )
