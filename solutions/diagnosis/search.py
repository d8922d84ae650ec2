"""The search: everything that is changed in a working, and what comes out of it, once for every problem."""

from collections import Counter, defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any

import sympy
from sympy import Expr

from rldrill.solutions.answers.judging import matches
from rldrill.solutions.diagnosis import weights
from rldrill.solutions.diagnosis.alternatives import (
    LIKELY,
    at_one,
    at_place,
    hashable,
    likely,
    numbers,
    of_numbers,
    plain,
    terms,
)
from rldrill.solutions.diagnosis.causes import Candidate, Cause
from rldrill.solutions.diagnosis.clock import Clock
from rldrill.solutions.diagnosis.givens import misread
from rldrill.solutions.diagnosis.replay import (
    UNDONE,
    Application,
    Change,
    Recorder,
    Replay,
    Traced,
    recorded,
    replayed,
    with_givens,
)
from rldrill.solutions.diagnosis.typed import Typed, approximate, equal, near
from rldrill.solutions.diagnosis.written_down import written_down
from rldrill.solutions.formula.edits import IN_ONE_TERM, Edit, edits, element, probes
from rldrill.solutions.formula.formula import Formula
from rldrill.solutions.formula.nodes.sets import Over
from rldrill.solutions.formula.notation import Cases, Indicator, Quantity
from rldrill.solutions.solution import Solution

#: Two slips: the first is one of so many.
_FIRST = 12
#: So many pairs of places are tried.
_TRIES = 100
#: So many other values of one application are gone on from, for one answer.
_REPLAYS = 30
#: A value of more numbers than this is not taken apart; a straight line is checked at so many other values.
_NUMBERS, _CHECKS = 9, 2
#: So many causes of the same value are told apart.
_ALIKE = 4


#: What wrong cells come to, for another value of an application.
Predict = Callable[[Any], dict[str, float]]


#: How likely a cause is, and what it makes of the wrong cells; None where that is not known.
Rival = tuple[float, tuple[float, ...] | None]


class Search:
    """All that can be changed in the working of one problem; made once, asked for every wrong answer."""

    def __init__(self, solution: Solution, carried: Mapping[str, Any] | None = None) -> None:
        self.solution = solution
        self.problem = solution.problem
        self.carried = dict(carried or {})
        self._whole: list[Candidate] = []
        self._unfinished: Iterator[Candidate] | None = None
        self._alternatives: dict[int, list[Cause]] = {}
        self._rivals: dict[Any, list[Rival]] = {}
        self._responses: dict[int, list[tuple[list[Any] | None, Mapping[str, Any] | None]]] = {}

    @cached_property
    def work(self) -> Recorder:
        """The right working."""
        return recorded(self.problem, self.carried)

    @property
    def applications(self) -> Sequence[Application]:
        """All applications of formulas in it."""
        return self.work.applications

    def replay(self, change: Change, trace: list[Traced] | None = None) -> Mapping[str, Any] | None:
        """The answers of a changed working."""
        return replayed(self.problem, change, self.carried, self.applications, trace)

    # The whole working ------------------------------------------------------------------------------
    def whole(self, clock: Clock) -> list[Candidate]:
        """What is done all along, with the answers; as much of it as there is time for, and the rest the next time."""
        if self._unfinished is None:
            self._unfinished = self._all()
        while not clock.over:
            candidate = next(self._unfinished, None)
            if candidate is None:
                break
            self._whole.append(candidate)
        return self._whole

    def _all(self) -> Iterator[Candidate]:
        for mistake, answers in self.solution.mistaken(self.carried):
            yield Candidate(Cause("listed", weights.LISTED, mistake=mistake), answers)
        yield from self._ideas()
        yield from self._habits()
        yield from self._misread()
        yield from self._equations()

    def _candidate(self, cause: Cause, change: Change) -> Iterator[Candidate]:
        answers = self.replay(change)
        if answers is not None:
            yield Candidate(cause, answers)

    def _ideas(self) -> Iterator[Candidate]:
        """Every edit of every formula, wherever it is read; an edit that several formulas have, in all of them."""
        uses: dict[Expr, list[Application]] = defaultdict(list)
        for application in self.applications:
            uses[application.right].append(application)
        alike: dict[Any, list[tuple[Expr, Edit]]] = defaultdict(list)
        for right in uses:
            seen: Counter[Any] = Counter()
            for edit in edits(right):
                if edit.kind in IN_ONE_TERM:
                    continue
                key = edit.kind, edit.part, edit.instead
                alike[key, seen[key]].append((right, edit))
                seen[key] += 1
        groups = sorted(alike.values(), key=lambda group: -weights.IDEAS[group[0][1].kind])
        for group in groups:
            for chosen in [group] if len(group) == 1 else [group, *([one] for one in group)]:
                right, edit = chosen[0]
                places = [application for each, _ in chosen for application in uses[each]]
                weight = weights.IDEAS[edit.kind]
                cause = Cause(
                    edit.kind,
                    weight,
                    places[0] if len(places) == 1 else None,
                    uses[right][0].formula,
                    edit,
                )
                yield from self._candidate(cause, Change({each: one.right for each, one in chosen}))
        yield from self._in_terms(uses)

    def _in_terms(self, uses: Mapping[Expr, Sequence[Application]]) -> Iterator[Candidate]:
        """Every edit in the same term of a sum, wherever it is read."""
        for right, places in uses.items():
            if len(places) == 1 or any(place.equation for place in places):
                continue
            for edit in edits(right):
                if edit.once is None:
                    continue
                weight = weights.IDEAS[edit.kind] * weights.IN_ONE_TERM
                every = [[term for term, _ in terms(edit.within, place.known)] for place in places]
                for nth in range(max(map(len, every))):
                    same = {each[nth] for each in every if len(each) > nth}
                    term = next(iter(same)) if len(same) == 1 else ()
                    cause = Cause(edit.kind, weight, None, places[0].formula, edit, term=term, nth=nth)
                    yield from self._candidate(cause, Change({right: edit.once}, letters=_nth(edit.within, nth)))

    def _habits(self) -> Iterator[Candidate]:
        """Old tables kept, new values used too early, the last round left out."""
        codes = {
            application.formula.left.code
            for application in self.applications
            if isinstance(application.formula.left, Quantity) and application.formula.left.code in application.known
        }
        if not codes or len(self.applications) < 2:
            return

        def stale(replay: Replay, _: Formula, known: Mapping[str, Any]) -> Mapping[str, Any]:
            return {name: replay.first.setdefault(name, value) if name in codes else value
                    for name, value in known.items()}  # fmt: skip

        def early(replay: Replay, _: Formula, known: Mapping[str, Any]) -> Mapping[str, Any]:
            return {name: {**value, **replay.found.get(name, {})} if name in codes else value
                    for name, value in known.items()}  # fmt: skip

        yield from self._candidate(Cause("stale", weights.PROCEDURE["stale"]), Change(habit=stale))
        yield from self._candidate(Cause("early", weights.PROCEDURE["early"]), Change(habit=early))
        yield from self._rounds()

    def _rounds(self) -> Iterator[Candidate]:
        """The last or the first round of updates left out: every quantity keeps what it was."""
        seen: dict[Any, list[Application]] = defaultdict(list)
        for application in self.applications:
            if application.old() is not None:
                seen[application.formula.left.func.code, str(application.step.left.args)].append(application)
        rounds = max(map(len, seen.values()), default=0)
        if rounds < 2:
            return
        for which in (rounds - 1, 0):
            left_out = [group[which] for group in seen.values() if len(group) > which]
            if len(left_out) > 1:
                cause = Cause("round-left-out", weights.PROCEDURE["round-left-out"], what="last" if which else "first")
                values = {application.number: application.old() for application in left_out}
                yield from self._candidate(cause, Change(values=values))

    def _misread(self) -> Iterator[Candidate]:
        for other in misread(self.problem.given):
            answers = with_givens(self.problem, other.given, self.carried, len(self.applications))
            if answers is not None and list(answers) == list(self.work.answers):
                yield Candidate(Cause(other.kind, weights.PROCEDURE[other.kind], what=other.what), answers)

    def _equations(self) -> Iterator[Candidate]:
        """Edits of one equation of a system."""
        equations = [application for application in self.applications if application.equation]
        for application in equations:
            for cause, right, letters in self._in_equation(application):
                yield from self._candidate(cause, Change({application.right: right}, letters=letters))

    def _in_equation(self, application: Application) -> Iterator[tuple[Cause, Expr, dict[str, Any]]]:
        letters = [name for name, value in application.known.items() if isinstance(value, str)]
        case = {f"case_{name}": application.known[name] for name in letters}
        here = Indicator(*(sympy.Symbol(name) for letter in letters for name in (letter, f"case_{letter}")))
        right = application.right
        for edit in edits(right):
            weight = weights.IDEAS[edit.kind] * weights.AT_ONE
            cause = Cause(edit.kind, weight, application, application.formula, edit)
            if edit.kind not in IN_ONE_TERM:
                yield cause, Cases(here, edit.right, right), case
            if edit.once is not None:
                once = Cases(here, edit.once, right)
                for term, at in terms(edit.within, application.known):
                    yield replace(cause, weight=weight * weights.IN_ONE_TERM, term=term), once, {**case, **at}
        for probe in probes(right):
            changed = Cases(here, probe.right, right)
            for cause, letters_ in at_place(application, probe):
                yield cause, changed, {**case, **letters_}

    @property
    def known_alternatives(self) -> Mapping[int, list[Cause]]:
        """The alternatives that were looked at, by the numbers of their applications."""
        return self._alternatives

    # One application --------------------------------------------------------------------------------
    def alternatives(self, application: Application) -> list[Cause]:
        """What may come out of one application instead of its value, the likeliest first."""
        number = application.number
        if number not in self._alternatives:
            found: dict[Any, list[Cause]] = defaultdict(list)
            for cause in sorted(at_one(application), key=lambda cause: -cause.weight):
                alike = found[hashable(cause.became)]
                if len(alike) < _ALIKE and not any(other.kind == cause.kind for other in alike[1:]):
                    alike.append(cause)
            found.pop(hashable(application.value), None)
            every = (cause for alike in found.values() for cause in alike)
            self._alternatives[number] = sorted(every, key=lambda cause: -cause.weight)
        return self._alternatives[number]

    # How answers depend on one value ----------------------------------------------------------------
    def responses(self, application: Application) -> list[tuple[list[Any] | None, Mapping[str, Any] | None]]:
        """The answers for a few other values of an application, number by number: how they depend on it."""
        number, value = application.number, application.value
        if number not in self._responses:
            own = numbers(value)
            others: list[tuple[list[Any] | None, Any]] = []
            if own is not None and len(own) > _NUMBERS:
                others = [(None, value * 3)]
            elif own is not None:
                one_more = [[*own[:place], own[place] + 1, *own[place + 1 :]] for place in range(len(own))]
                checks = [each - 3 - place for place, each in enumerate(own)], [each * 4 + 7 for each in own]
                others = [(each, of_numbers(value, each)) for each in (*one_more, *checks)]
            self._responses[number] = [(each, self.replay(Change(values={number: other}))) for each, other in others]
        return self._responses[number]

    def local(self, typed: Typed, clock: Clock, within: Callable[[set[str]], bool]) -> Iterator[Candidate]:
        """What can be done at one application so that some of the wrong cells, those that depend on it, come out.

        Args:
            typed: what was typed.
            clock: the time there is.
            within: whether a cause that changes these cells is of interest.
        """
        for application in self.applications:
            if clock.over:
                return
            predicted = self._predicted(application, typed)
            if predicted is None:
                continue
            changed, predict = predicted
            if not within(changed):
                continue
            done: dict[Any, Mapping[str, Any] | None] = {}
            for cause in self.alternatives(application):
                if clock.over:
                    return
                if len(done) >= _REPLAYS:
                    break
                if predict is not None and not all(
                    near(size, typed.sizes[name]) for name, size in predict(cause.became).items()
                ):
                    continue
                same = hashable(cause.became)
                if same not in done:
                    done[same] = self.replay(Change(values={application.number: cause.became}))
                answers = done[same]
                cells = typed.cells_of(answers)
                if answers is None or cells is None:
                    continue
                if all(near(approximate(cells[name]), typed.sizes[name]) for name in changed & set(typed.sizes)):
                    yield Candidate(cause, answers)

    def _predicted(self, application: Application, typed: Typed) -> tuple[set[str], Predict | None] | None:
        """The cells that depend on a value, and how, where it is a straight line; None where none of them is wrong."""
        answered = [
            (other, cells)
            for other, answers in self.responses(application)
            if (cells := typed.cells_of(answers)) is not None
        ]
        changed = {name for name in typed.key for _, cells in answered if not equal(cells.get(name), typed.key[name])}
        if answered and not changed & set(typed.wrong):
            return None
        own = numbers(application.value)
        if own is None or len(answered) != len(own) + _CHECKS or set(typed.sizes) != set(typed.key):
            return changed or set(typed.wrong), None
        start = list(map(approximate, own))
        points = [
            [approximate(each) - at for each, at in zip(other or [], start, strict=True)] for other, _ in answered
        ]
        lines: dict[str, tuple[float, list[float]]] = {}
        for name in changed:
            base, *heights = (approximate(cells[name]) for cells in (typed.key, *(cells for _, cells in answered)))
            slopes = [height - base for height in heights[: len(own)]]
            for by, height in zip(points[len(own) :], heights[len(own) :], strict=True):
                if not abs(base + _along(slopes, by) - height) <= 1e-9 * (abs(height) + 1):
                    return changed, None
            lines[name] = base, slopes

        def predict(value: Any) -> dict[str, float]:
            others = numbers(value) or []
            by = [approximate(other) - at for other, at in zip(others, start, strict=True)]
            return {name: base + _along(slopes, by) for name, (base, slopes) in lines.items()}

        return changed, predict

    def in_turn(self, typed: Typed, clock: Clock) -> Iterator[Candidate]:
        """Two slips, the second one in a working that goes on from the first."""
        bearing = [each for each in self.applications if self._predicted(each, typed) is not None]
        places = {each.number for each in bearing}
        tries = _TRIES
        for application in bearing:
            for first in self.alternatives(application)[:_FIRST]:
                if clock.over or tries < 0:
                    return
                if first.weight < LIKELY:
                    break
                trace: list[Traced] = []
                if self.replay(Change(values={application.number: first.became}), trace) is None:
                    continue
                for traced in trace:
                    if traced[0] > application.number and traced[0] in places and plain(traced[3]):
                        tries -= 1
                        yield from self._then(typed, application, first, traced)

    def _then(self, typed: Typed, application: Application, first: Cause, traced: Traced) -> Iterator[Candidate]:
        number, right, known, value = traced
        values = {application.number: first.became}
        wanted = self._wanted(typed, values, number, value)
        if wanted is None:
            return
        second = self.applications[number] if number < len(self.applications) else None
        for kind, weight, edit, other in likely(right, known, value):
            if near(approximate(other), wanted):
                answers = self.replay(Change(values={**values, number: other}))
                if answers is not None:
                    formula = second.formula if second else None
                    then = Cause(kind, weight, second, formula, edit, was=value, became=other)
                    yield Candidate(replace(first, weight=first.weight * weight / 100, then=then), answers)

    def _wanted(self, typed: Typed, values: Mapping[int, Any], number: int, value: Any) -> float | None:
        """What a later value would have to be for the typed answer to come out, if a straight line leads there."""
        heights = []
        for other in (value, value + 1, value - 3):
            cells = typed.cells_of(self.replay(Change(values={**values, number: other})))
            if cells is None:
                return None
            heights.append({name: approximate(cells[name]) for name in typed.sizes})
        wanted: float | None = None
        for name, size in typed.sizes.items():
            at, one, minus = (height[name] for height in heights)
            slope = one - at
            if not abs(at - 3 * slope - minus) <= 1e-9 * (abs(minus) + 1):
                return None
            if slope == 0:
                if not near(at, size):
                    return None
            elif wanted is None:
                wanted = (size - at) / slope
            elif not near(at + slope * wanted, size):
                return None
        return None if wanted is None else approximate(value) + wanted

    def rivals(self, typed: Typed) -> list[Rival]:
        """What the causes make of the wrong cells, those that spoil just these."""
        spoilt = frozenset(typed.wrong)
        key = typed.part.label, spoilt
        if key not in self._rivals:
            candidates = [*self._whole, *written_down(typed, self.applications)]
            found: list[Rival] = []
            for candidate in candidates:
                cells = typed.cells_of(candidate.answers)
                if cells is not None and typed.differing(cells) == spoilt:
                    found.append((candidate.cause.weight, tuple(approximate(cells[name]) for name in typed.wrong)))
            for application in self.applications:
                predicted = self._predicted(application, typed)
                if predicted is not None and predicted[0] == spoilt and application.number in self._alternatives:
                    found += self._rivals_at(application, typed.wrong, predicted[1])
            self._rivals[key] = found
        return self._rivals[key]

    def _rivals_at(self, application: Application, wrong: Sequence[str], predict: Predict | None) -> Iterator[Rival]:
        for cause in self.alternatives(application):
            sizes = None if predict is None else predict(cause.became)
            yield cause.weight, None if sizes is None else tuple(sizes[name] for name in wrong)

    def fits(self, typed: Typed, answers: Mapping[str, Any]) -> bool:
        """Whether these answers are what was typed."""
        cells = typed.cells_of(answers)
        if cells is None or not typed.near(cells):
            return False
        try:
            return matches(typed.part, typed.cells, answers)
        except UNDONE:
            return False


def _along(slopes: Sequence[float], by: Sequence[float]) -> float:
    return sum(slope * way for slope, way in zip(slopes, by, strict=True))


def _nth(within: Sequence[Over], nth: int) -> Callable[[Mapping[str, Any]], Mapping[str, Any]]:
    """The letters of the nth term, whatever the application; of none where there are fewer."""

    def letters(known: Mapping[str, Any]) -> Mapping[str, Any]:
        for number, (_, at) in enumerate(terms(within, known)):
            if number == nth:
                return at
        return {element(depth): None for depth in range(len(within))}

    return letters
