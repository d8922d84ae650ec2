"""The search: everything that is changed in a working, and what comes out of it, once for every problem."""

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import combinations
from threading import Event
from time import perf_counter
from typing import Any

import sympy
from flint import fmpq
from sympy import Expr

from rldrill.problems.parts import Matrix, Number, Part
from rldrill.solutions.answers.judging import matches, wrong_cells
from rldrill.solutions.answers.kinds import Cell, answer_kind
from rldrill.solutions.answers.text import Reading
from rldrill.solutions.diagnosis import weights
from rldrill.solutions.diagnosis.arithmetic import slips
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
from rldrill.solutions.exact import enclosure, is_rational
from rldrill.solutions.formula.compiling import value_of
from rldrill.solutions.formula.edits import IN_ONE_TERM, SCALE, SHIFT, Edit, Probe, edits, element, probes
from rldrill.solutions.formula.formula import Formula, Misconception
from rldrill.solutions.formula.nodes.sets import Over
from rldrill.solutions.formula.notation import Cases, Indicator, Quantity
from rldrill.solutions.matrices import is_matrix
from rldrill.solutions.solution import Solution
from rldrill.solutions.vector import Vector

#: Where answers with an open parameter are compared at first.
_POINT = fmpq(37, 101)
#: No two answers that a marker takes for the same are further apart, by their size or near 0.
_NEAR, _NEAR_ZERO = 0.012, 0.0011
#: A place whose quantity has more values than this elsewhere is not tried with all of them.
_ELSEWHERE = 12
#: A sum of more terms than this is not edited term by term.
_TERMS = 8
#: So many causes of the same value are told apart.
_ALIKE = 4
#: Two slips are each of at least this weight, and the first is one of so many.
_LIKELY, _FIRST = 1.5, 12
#: So many pairs of places are tried.
_TRIES = 100
#: So many other values of one application are gone on from, for one answer.
_REPLAYS = 30
_NOT_COMPUTED = float("nan")


@dataclass(frozen=True, eq=False)
class Cause:
    """One way to err, at one place or everywhere.

    Args:
        kind: what was done, a name.
        weight: how likely it is.
        application: where it was done; None where it was done all along.
        formula: the formula that it was done to, if any.
        edit: how that was edited, if it was.
        probe: the place in it whose value is another one, if there is one.
        term: the term of a sum that it was done in alone, its letters' values.
        nth: the number of that term, from 0, where it was done in every sum.
        was: the value that was right, of the place in the formula if there is one, else of the application.
        other: the value that was put in for it.
        became: the value that came out of the application.
        what: of what else is said what it was.
        mistake: the listed mistake that it is, if it is one.
        then: what was done besides.
    """

    kind: str
    weight: float
    application: Application | None = None
    formula: Formula | None = None
    edit: Edit | None = None
    probe: Probe | None = None
    term: tuple[Any, ...] = ()
    was: Any = None
    other: Any = None
    became: Any = None
    what: str = ""
    nth: int | None = None
    mistake: Misconception | None = None
    then: "Cause | None" = None


@dataclass(frozen=True, eq=False)
class Candidate:
    """A cause, and the answers that it leads to."""

    cause: Cause
    answers: Mapping[str, Any]


@dataclass
class Typed:
    """What was typed for a part, beside what is right."""

    part: Part
    cells: Mapping[str, Cell]
    key: Mapping[str, Any]

    @cached_property
    def wrong(self) -> tuple[str, ...]:
        """The cells that are wrong."""
        return wrong_cells(self.cells, self.key)

    @cached_property
    def sizes(self) -> dict[str, float]:
        """What the typed cells are worth, roughly; words are left out."""
        return {name: approximate(cell.value) for name, cell in self.cells.items() if isinstance(cell, Reading)}

    def cells_of(self, answers: Mapping[str, Any] | None) -> dict[str, Any] | None:
        """The cells of this part among some answers; None where they have no such part, or another one."""
        if answers is None or self.part.label not in answers:
            return None
        try:
            cells = answer_kind(self.part.kind).cells(answers[self.part.label])
        except UNDONE:
            return None
        return cells if cells.keys() == self.key.keys() else None

    def differing(self, cells: Mapping[str, Any]) -> set[str]:
        """The cells that are not those of the key."""
        return {name for name, right in self.key.items() if not _equal(cells[name], right)}

    def near(self, values: Mapping[str, Any]) -> bool:
        """Whether an answer is roughly what was typed, so that it is worth a proof."""
        return all(near(approximate(values[name]), size) for name, size in self.sizes.items())


def near(one: float, two: float) -> bool:
    """Whether two numbers could be the same, rounded; what could not be computed could."""
    if one != one or two != two:
        return True
    return abs(one - two) <= _NEAR * abs(one) + _NEAR_ZERO


def approximate(value: Any) -> float:
    """What a value is worth, roughly; nan where that is not known."""
    if is_rational(value):
        try:
            return int(value.p) / int(value.q)
        except OverflowError:
            return _NOT_COMPUTED
    try:
        return float(enclosure(value, _POINT).mid())
    except UNDONE:
        return _NOT_COMPUTED


@dataclass
class Clock:
    """How long there is to search: some seconds, or until somebody says stop; without either, without end."""

    seconds: float | None = None
    stop: Event | None = None
    _begun: float = field(default_factory=perf_counter)

    @property
    def over(self) -> bool:
        """Whether the time is over."""
        if self.stop is not None and self.stop.is_set():
            return True
        return self.seconds is not None and perf_counter() - self._begun > self.seconds


class Search:
    """All that can be changed in the working of one problem; made once, asked for every wrong answer."""

    def __init__(self, solution: Solution, carried: Mapping[str, Any] | None = None) -> None:
        self.solution = solution
        self.problem = solution.problem
        self.carried = dict(carried or {})
        self._whole: list[Candidate] = []
        self._unfinished: Iterator[Candidate] | None = None
        self._alternatives: dict[int, list[Cause]] = {}
        self._rivals: dict[Any, list[float]] = {}
        self._responses: dict[int, list[tuple[Any, Mapping[str, Any] | None]]] = {}

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
        return replayed(self.problem, change, self.carried, len(self.applications), trace)

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
                terms = [[term for term, _ in _terms(edit.within, place.known)] for place in places]
                for nth in range(max(map(len, terms))):
                    same = {each[nth] for each in terms if len(each) > nth}
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
                for term, at in _terms(edit.within, application.known):
                    yield replace(cause, weight=weight * weights.IN_ONE_TERM, term=term), once, {**case, **at}
        for probe in probes(right):
            changed = Cases(here, probe.right, right)
            for cause, letters_ in self._at(application, probe):
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
            for cause in sorted(self._at_one(application), key=lambda cause: -cause.weight):
                alike = found[_hashable(cause.became)]
                if len(alike) < _ALIKE and not any(other.kind == cause.kind for other in alike[1:]):
                    alike.append(cause)
            found.pop(_hashable(application.value), None)
            every = (cause for alike in found.values() for cause in alike)
            self._alternatives[number] = sorted(every, key=lambda cause: -cause.weight)
        return self._alternatives[number]

    def _at_one(self, application: Application) -> Iterator[Cause]:
        formula, right, known, value = application.formula, application.right, application.known, application.value
        base = Cause("", 0.0, application, formula, was=value)
        for kind, other in slips(value):
            yield replace(base, kind=kind, weight=weights.VALUES[kind], became=other)
        if (old := application.old()) is not None and _same_form(old, value):
            yield replace(base, kind="kept", weight=weights.VALUES["kept"], became=old)
            yield from self._repeated(application, base)
        if application.equation:
            return
        for edit in edits(right):
            weight = weights.IDEAS[edit.kind] * weights.AT_ONE
            if edit.kind in IN_ONE_TERM:
                pass
            elif (other := _value(edit.right, known)) is not None and _same_form(other, value):
                yield replace(
                    base, kind=edit.kind, weight=weight * _likely_there(edit, (), known), edit=edit, became=other
                )
            if edit.once is not None:
                for term, at in list(_terms(edit.within, known))[:_TERMS]:
                    other = _value(edit.once, {**known, **at})
                    if other is not None and _same_form(other, value):
                        in_term = weight * weights.IN_ONE_TERM * _likely_there(edit, term, known)
                        yield replace(base, kind=edit.kind, weight=in_term, edit=edit, term=term, became=other)
        for probe in probes(right):
            for cause, letters in self._at(application, probe):
                other = _value(probe.right, {**known, **letters})
                if other is not None and _same_form(other, value):
                    yield replace(cause, became=other)

    def _repeated(self, application: Application, base: Cause) -> Iterator[Cause]:
        """The same update once more, from the value that it gave."""
        left, known = application.formula.left, application.known
        try:
            arguments = tuple(value_of(argument, known) for argument in left.args)
        except UNDONE:
            return
        key = arguments[0] if len(arguments) == 1 else arguments
        again = {**known, left.func.code: {**known[left.func.code], key: application.value}}
        if (other := _value(application.right, again)) is not None:
            yield replace(base, kind="repeated", weight=weights.VALUES["repeated"], became=other)

    def _at(self, application: Application, probe: Probe) -> Iterator[tuple[Cause, dict[str, Any]]]:
        """What another value of one place in a formula could be."""
        known = application.known
        terms = list(_terms(probe.within, known)) if probe.within else [((), {})]
        for term, at in terms:
            here = {**known, **dict(zip((over.index.name for over in probe.within), term, strict=True))}
            was = _value(probe.part, here)
            if was is None or is_matrix(was) or isinstance(was, Vector) or not hasattr(was, "__add__"):
                continue
            for kind, other in self._others(probe.part, was, here):
                weight = weights.INSIDE[kind] * (weights.IN_ONE_TERM if len(terms) > 1 else 1)
                cause = Cause(
                    kind, weight, application, application.formula, probe=probe, term=term, was=was, other=other
                )
                yield cause, {**at, SCALE.name: fmpq(0), SHIFT.name: other}

    def _others(self, part: Expr, was: Any, known: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
        leaf = isinstance(part, Quantity) or part.is_Symbol
        if part.is_Add and len(part.args) == 2 and (crosswise := _crosswise(part, known)) is not None:
            yield "crosswise", crosswise
        for kind, other in slips(was):
            lost = kind == "sign" and leaf and is_rational(was) and was < 0
            yield "minus-lost" if lost else kind, other
        if isinstance(part, Quantity) and isinstance(known.get(part.code), Mapping):
            elsewhere = _distinct(known[part.code].values())
            if len(elsewhere) <= _ELSEWHERE:
                yield from (("elsewhere", other) for other in elsewhere if other != was)
        if leaf:
            scalars = _distinct(known.values())
            yield from (("elsewhere", other) for other in scalars if other != was)

    # How answers depend on one value ----------------------------------------------------------------
    def responses(self, application: Application) -> list[tuple[Any, Mapping[str, Any] | None]]:
        """The answers for a few other values of an application: how they depend on it."""
        number = application.number
        if number not in self._responses:
            value = application.value
            if _plain(value):
                others = [value + 1, value - 3, value * 4 + 7]
            elif is_matrix(value) or isinstance(value, Vector):
                others = [value * 3]
            else:
                others = []
            self._responses[number] = [(other, self.replay(Change(values={number: other}))) for other in others]
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
                same = _hashable(cause.became)
                if same not in done:
                    done[same] = self.replay(Change(values={application.number: cause.became}))
                answers = done[same]
                cells = typed.cells_of(answers)
                if answers is None or cells is None:
                    continue
                if all(near(approximate(cells[name]), typed.sizes[name]) for name in changed & set(typed.sizes)):
                    yield Candidate(cause, answers)

    def _predicted(
        self, application: Application, typed: Typed
    ) -> tuple[set[str], Callable[[Any], dict[str, float]] | None] | None:
        """The cells that depend on a value, and how, where it is a straight line; None where none of them is wrong."""
        points: list[tuple[float, dict[str, Any]]] = [(approximate(application.value), dict(typed.key))]
        if not _plain(application.value):
            points = [(_NOT_COMPUTED, dict(typed.key))]
        for other, answers in self.responses(application):
            if (cells := typed.cells_of(answers)) is not None:
                points.append((approximate(other) if _plain(other) else _NOT_COMPUTED, cells))
        changed = {
            name for name in typed.key for _, cells in points[1:] if not _equal(cells.get(name), typed.key[name])
        }
        if len(points) > 1 and not changed & set(typed.wrong):
            return None
        if len(points) < 4 or any(x != x for x, _ in points) or set(typed.sizes) != set(typed.key):
            return changed or set(typed.wrong), None
        lines: dict[str, tuple[float, float]] = {}
        start = points[0][0]
        for name in changed:
            heights = [approximate(cells[name]) for _, cells in points]
            slope = (heights[1] - heights[0]) / (points[1][0] - start)
            for (x, _), height in zip(points[2:], heights[2:], strict=True):
                if not abs(heights[0] + slope * (x - start) - height) <= 1e-9 * (abs(height) + 1):
                    return changed, None
            lines[name] = heights[0], slope

        def predict(value: Any) -> dict[str, float]:
            by = approximate(value) - start
            return {name: height + slope * by for name, (height, slope) in lines.items()}

        return changed, predict

    def in_turn(self, typed: Typed, clock: Clock) -> Iterator[Candidate]:
        """Two slips, the second one in a working that goes on from the first."""
        bearing = [each for each in self.applications if self._predicted(each, typed) is not None]
        numbers = {each.number for each in bearing}
        tries = _TRIES
        for application in bearing:
            for first in self.alternatives(application)[:_FIRST]:
                if clock.over or tries < 0:
                    return
                if first.weight < _LIKELY:
                    break
                trace: list[Traced] = []
                if self.replay(Change(values={application.number: first.became}), trace) is None:
                    continue
                for traced in trace:
                    if traced[0] > application.number and traced[0] in numbers and _plain(traced[3]):
                        tries -= 1
                        yield from self._then(typed, application, first, traced)

    def _then(self, typed: Typed, application: Application, first: Cause, traced: Traced) -> Iterator[Candidate]:
        number, right, known, value = traced
        values = {application.number: first.became}
        wanted = self._wanted(typed, values, number, value)
        if wanted is None:
            return
        second = self.applications[number] if number < len(self.applications) else None
        for kind, weight, edit, other in _likely(right, known, value):
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

    def rivals(self, typed: Typed) -> list[float]:
        """How likely the causes are that spoil just the cells that are wrong, one for each answer that they give."""
        spoilt = frozenset(typed.wrong)
        key = typed.part.label, spoilt
        if key not in self._rivals:
            found: dict[str, float] = {}
            for candidate in self._whole:
                cells = typed.cells_of(candidate.answers)
                if cells is not None and typed.differing(cells) == spoilt:
                    answer = str([str(cells[name]) for name in typed.wrong])
                    found[answer] = max(candidate.cause.weight, found.get(answer, 0.0))
            rivals = list(found.values())
            for application in self.applications:
                predicted = self._predicted(application, typed)
                if predicted is not None and predicted[0] == spoilt and application.number in self._alternatives:
                    rivals += [cause.weight for cause in self.alternatives(application)]
            self._rivals[key] = rivals
        return self._rivals[key]

    # The answer itself ------------------------------------------------------------------------------
    def written_down(self, typed: Typed) -> Iterator[Candidate]:
        """What can go wrong between the working and the answer."""
        kind = answer_kind(typed.part.kind)
        key = dict(typed.key)
        if any(isinstance(value, tuple) for value in key.values()):
            return

        def made(name: str, cells: dict[str, Any], what: str = "", of: str = "") -> Iterator[Candidate]:
            if typed.near(cells):
                cause = Cause(of or name, weights.ANSWERS[of or name], what=what)
                yield Candidate(cause, {typed.part.label: kind.value(cells)})

        if len(key) > 1:
            for one, two in combinations(typed.wrong, 2):
                what = f"{one} and {two}"
                yield from made("exchanged-cells", {**key, one: key[two], two: key[one]}, what)
            yield from made("all-signs", {name: -value for name, value in key.items()})
        for name, value in key.items():
            if typed.wrong == (name,) or len(key) == 1:
                for slip, other in slips(value):
                    yield from made(slip, {**key, name: other}, name)
        if len(key) == 1:
            ((name, value),) = key.items()
            yield from made("one-minus", {name: 1 - value})
            yield from made("percent", {name: value * 100})
            for application in self.applications:
                if _plain(application.value):
                    for candidate in made("another-quantity", {name: application.value}):
                        yield replace(candidate, cause=replace(candidate.cause, application=application))
        shape = typed.part.kind
        if isinstance(shape, Matrix) and shape.rows == shape.columns > 1:
            cells = {
                f"row {row}, column {column}": key[f"row {column}, column {row}"]
                for row in range(1, shape.rows + 1)
                for column in range(1, shape.columns + 1)
            }
            yield from made("answer-transposed", cells)
        if not isinstance(shape, Number) and len(key) > 2:
            yield from self._scaled(typed, key)

    def _scaled(self, typed: Typed, key: Mapping[str, Any]) -> Iterator[Candidate]:
        """All entries by the same factor too large: not normalised."""
        ratios = {
            cell.value / key[name]
            for name, cell in typed.cells.items()
            if isinstance(cell, Reading) and key[name] != 0 and is_rational(cell.value) and is_rational(key[name])
        }
        if len(ratios) == 1 and all(value != 0 and is_rational(value) for value in key.values()):
            factor = next(iter(ratios))
            cells = {name: value * factor for name, value in key.items()}
            yield Candidate(
                Cause("answer-scaled", weights.ANSWERS["answer-scaled"], was=factor),
                {typed.part.label: answer_kind(typed.part.kind).value(cells)},
            )

    def fits(self, typed: Typed, answers: Mapping[str, Any]) -> bool:
        """Whether these answers are what was typed."""
        cells = typed.cells_of(answers)
        if cells is None or not typed.near(cells):
            return False
        try:
            return matches(typed.part, typed.cells, answers)
        except UNDONE:
            return False


def _likely(right: Expr, known: Mapping[str, Any], value: Any) -> Iterator[tuple[str, float, Edit | None, Any]]:
    """The likeliest other values of an application in a changed working."""
    for kind, other in slips(value):
        if (weight := weights.VALUES[kind]) >= _LIKELY:
            yield kind, weight, None, other
    for edit in edits(right):
        weight = weights.IDEAS[edit.kind] * weights.AT_ONE
        if weight >= _LIKELY and edit.kind not in IN_ONE_TERM:
            other = _value(edit.right, known)
            if other is not None and _plain(other) and other != value:
                yield edit.kind, weight, edit, other


def _crosswise(part: Expr, known: Mapping[str, Any]) -> fmpq | None:
    """Two fractions added top to top and bottom to bottom."""
    one, two = (_value(term, known) for term in part.args)
    if not is_rational(one) or not is_rational(two) or 1 in (one.q, two.q) or one.q == two.q:
        return None
    return fmpq(one.p + two.p, one.q + two.q)


def _value(right: Expr, known: Mapping[str, Any]) -> Any:
    try:
        return value_of(right, known)
    except UNDONE:
        return None


def _terms(within: Sequence[Over], known: Mapping[str, Any]) -> Iterator[tuple[tuple[Any, ...], dict[str, Any]]]:
    """The terms of sums in one another: the values of their letters, and what says so to an edit."""
    found: list[tuple[Any, ...]] = [()]
    names = [over.index.name for over in within]
    try:
        for depth, over in enumerate(within):
            found = [
                (*term, item)
                for term in found
                for item in value_of(over.domain, {**known, **dict(zip(names[:depth], term, strict=True))})
            ]
    except UNDONE:
        return
    for term in found:
        yield term, {element(depth): item for depth, item in enumerate(term)}


def _nth(within: Sequence[Over], nth: int) -> Callable[[Mapping[str, Any]], Mapping[str, Any]]:
    """The letters of the nth term, whatever the application; of none where there are fewer."""

    def letters(known: Mapping[str, Any]) -> Mapping[str, Any]:
        for number, (_, at) in enumerate(_terms(within, known)):
            if number == nth:
                return at
        return {element(depth): None for depth in range(len(within))}

    return letters


def _likely_there(edit: Edit, term: tuple[Any, ...], known: Mapping[str, Any]) -> float:
    """How likely an edit is for these values: 1 − x is taken for a share of 1."""
    if edit.kind != "complement-of-value" or len(term) != len(edit.within):
        return 1.0
    here = {over.index.name: item for over, item in zip(edit.within, term, strict=True)}
    share = approximate(_value(edit.part, {**known, **here}))
    return 1.0 if 0 < share < 1 else weights.NO_SHARE


def _plain(value: Any) -> bool:
    """Whether a value is one number, of any form."""
    return is_rational(value) or (
        not isinstance(value, str | int | tuple | Mapping | Vector)
        and not is_matrix(value)
        and hasattr(value, "__add__")
    )


def _distinct(values: Iterable[Any]) -> list[Any]:
    """The numbers among some values, each once."""
    return list({str(value): value for value in values if _plain(value)}.values())


def _same_form(other: Any, value: Any) -> bool:
    if is_matrix(value):
        return is_matrix(other) and (other.nrows(), other.ncols()) == (value.nrows(), value.ncols())
    if isinstance(value, tuple):
        return isinstance(other, tuple)
    return isinstance(other, Vector) if isinstance(value, Vector) else _plain(other)


def _equal(one: Any, two: Any) -> bool:
    try:
        return bool(one == two)
    except UNDONE:
        return False


def _hashable(value: Any) -> Any:
    return tuple(map(str, value.entries())) if is_matrix(value) else str(value)
