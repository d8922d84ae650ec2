"""The search: everything that is changed in a working, and what comes out of it, once for every problem."""

from collections import Counter, defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property, partial
from itertools import chain, product
from typing import Any

import sympy
from msgspec.structs import replace
from sympy import Expr

from rldrill.solutions.diagnosis import weights
from rldrill.solutions.diagnosis.alternatives import (
    at_one,
    at_place,
    can_be_made,
    hashable,
    is_made_of_shares,
    is_sensible,
    likely_share,
    numbers,
    of_numbers,
    plain,
    shares,
    single,
    terms,
    value_or_none,
)
from rldrill.solutions.diagnosis.causes import Candidate, Cause
from rldrill.solutions.diagnosis.clock import Clock
from rldrill.solutions.diagnosis.givens import OF_THE_ORDER, led_elsewhere, misread
from rldrill.solutions.diagnosis.replay import (
    Application,
    Change,
    Recorder,
    Replay,
    Traced,
    recorded,
    replayed,
    with_givens,
)
from rldrill.solutions.diagnosis.typed import equal
from rldrill.solutions.diagnosis.unknowns import missolved
from rldrill.solutions.formula.edits import IN_ONE_TERM, Edit, edits, element, probes
from rldrill.solutions.formula.formula import Formula, Misconception
from rldrill.solutions.formula.nodes.sets import Over
from rldrill.solutions.formula.notation import Cases, Indicator, Quantity
from rldrill.solutions.solution import Solution

#: A value of more numbers than this is not taken apart; a straight line is checked at so many other values.
_NUMBERS, _CHECKS = 9, 2
#: So many causes of the same value are told apart.
_ALIKE = 4
#: What is forgotten in all steps of one time.
_FORGOTTEN = ("factor-left-out", "term-left-out", "sign")
#: So often equations are applied by somebody who does not solve them.
_SWEEPS = 3
TIMES = ("once", "twice", "three times")


class Search:
    """All that can be changed in the working of one problem; made once, asked for every wrong answer."""

    def __init__(self, solution: Solution, carried: Mapping[str, Any] | None = None) -> None:
        self.solution = solution
        self.problem = solution.problem
        self.carried = dict(carried or {})
        self._whole: list[Candidate] = []
        self._unfinished: Iterator[Candidate | None] | None = None
        self._alternatives: dict[int, list[Cause]] = {}
        self._responses: dict[int, list[tuple[list[Any] | None, Mapping[str, Any] | None]]] = {}
        self._alone: dict[Candidate, Mapping[str, Any] | None] = {}

    @cached_property
    def work(self) -> Recorder:
        """The right working."""
        return recorded(self.problem, self.carried)

    @property
    def applications(self) -> Sequence[Application]:
        """All applications of formulas in it."""
        return self.work.applications

    def replay(
        self, change: Change, trace: list[Traced] | None = None, settled: Mapping[str, Any] | None = None
    ) -> Mapping[str, Any] | None:
        """The answers of a changed working; it goes on from what is settled, answers that were right."""
        return replayed(self.problem, change, {**self.carried, **(settled or {})}, self.applications, trace)

    # The whole working ------------------------------------------------------------------------------
    def whole(self, clock: Clock) -> list[Candidate]:
        """What is done all along, with the answers; as much of it as there is time for, and the rest the next time."""
        if self._unfinished is None:
            self._unfinished = self._all()
        while not clock.over:
            try:
                candidate = next(self._unfinished)
            except StopIteration:
                break
            if candidate is not None:
                self._whole.append(candidate)
        return self._whole

    def _all(self) -> Iterator[Candidate | None]:
        """Every candidate; None where something else took time."""
        mistakes = self.solution.mistaken(self.carried) if self.carried else self.solution.mistakes
        for mistake, answers in mistakes:
            again = partial(self._mistaken, mistake)
            yield Candidate(Cause("listed", weights.LISTED, mistake=mistake), answers, again)
        yield from self.stated()
        yield from self._ideas()
        yield from self._habits()
        yield from self._misread()
        yield from self._equations()
        yield from self._same_rows()
        yield from self._same_times()
        yield from self._unknowns()
        yield from self._unsolved()

    def alone(self, candidate: Candidate) -> Mapping[str, Any] | None:
        """The answers to each part of somebody who had the right ones to all parts before; for all parts at once."""
        if candidate not in self._alone:
            self._alone[candidate] = candidate.again(self.solution.answers)
        return self._alone[candidate]

    def _mistaken(self, mistake: Misconception, settled: Mapping[str, Any]) -> Mapping[str, Any] | None:
        return self.solution.answers_with(mistake, {**self.carried, **settled})

    def _candidate(self, cause: Cause, change: Change) -> Iterator[Candidate]:
        answers = self.replay(change)
        if answers is not None:
            yield Candidate(cause, answers, partial(self.replay, change, None))

    def stated(self) -> Iterator[Candidate]:
        """What is stated beside a formula as its mistake, though the family does not list it among its own."""
        own = {mistake.key for mistake in self.solution.applicable}
        given = self.problem.given
        read: dict[Misconception, dict[Expr, Expr]] = defaultdict(dict)
        for formula in self.solution.work.read:
            for mistake, right in formula.misread.items():
                if mistake.key not in own and can_be_made(mistake, given):
                    read[mistake][formula.right] = right
        for mistake, rights in read.items():
            yield from self._candidate(Cause("listed", weights.STATED, mistake=mistake), Change(rights))

    def _ideas(self) -> Iterator[Candidate | None]:
        """Every edit of every formula, wherever it is read; an edit that several formulas have, in all of them."""
        uses: dict[Expr, list[Application]] = defaultdict(list)
        for application in self.applications:
            uses[application.right].append(application)
        alike: dict[Any, list[tuple[Expr, Edit]]] = defaultdict(list)
        for right in uses:
            seen: Counter[Any] = Counter()
            for edit in edits(right):
                if edit.kind in IN_ONE_TERM or not is_sensible(edit):
                    continue
                key = edit.kind, edit.part, edit.instead
                alike[key, seen[key]].append((right, edit))
                seen[key] += 1
            yield None
        groups = sorted(alike.values(), key=lambda group: -weights.IDEAS[group[0][1].kind])
        for group in groups:
            for chosen in [group] if len(group) == 1 else [group, *([one] for one in group)]:
                right, edit = chosen[0]
                places = [application for each, _ in chosen for application in uses[each]]
                if not is_made_of_shares(edit, places):
                    continue
                cause = Cause(
                    edit.kind,
                    weights.IDEAS[edit.kind],
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
                    there = [(place, each[nth]) for place, each in zip(places, every, strict=True) if len(each) > nth]
                    if not any(is_made_of_shares(edit, (place,), one) for place, one in there):
                        continue
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
            return {name: replay.with_found(replay.first.setdefault(name, value)) if name in codes else value
                    for name, value in known.items()}  # fmt: skip

        def early(replay: Replay, _: Formula, known: Mapping[str, Any]) -> Mapping[str, Any]:
            return {name: {**value, **replay.with_found(replay.found.get(name, {}))} if name in codes else value
                    for name, value in known.items()}  # fmt: skip

        tables = any(application.formula.sign == "←" for application in self.applications)
        old = Cause("stale", weights.PROCEDURE["stale"], what="" if tables else "…")  # a belief has no old entries
        yield from self._candidate(old, Change(habit=stale))
        if (values := self._all_from_the_first()) is not None:
            yield from self._candidate(old, Change(values=values))
        yield from self._candidate(Cause("early", weights.PROCEDURE["early"]), Change(habit=early))
        yield from self._rounds()

    def _all_from_the_first(self) -> Mapping[int, Any] | None:
        """The values of updates that are all worked out with the first table, then made one on top of the other."""
        values: dict[int, Any] = {}
        reached: dict[Any, Any] = {}
        for application in self.applications:
            start, old = application.first, application.old()
            if start is None or not plain(old):
                continue
            left, known = application.formula.left, application.known
            key = left.func.code, str(application.step.left.args)
            first = value_or_none(left, {**known, left.func.code: start})
            moved = value_or_none(application.right, {**known, left.func.code: start})
            if not plain(first) or not plain(moved):
                return None
            reached[key] = values[application.number] = reached.get(key, first) + moved - first
        return values if len(values) > len(reached) else None

    def _rounds(self) -> Iterator[Candidate]:
        """The last or first round of updates left out, or all at the last time: every quantity keeps what it was."""
        seen: dict[Any, list[Application]] = defaultdict(list)
        for application in self.applications:
            if application.old() is not None:
                seen[application.formula.left.func.code, str(application.step.left.args)].append(application)
        rounds = len(max(seen.values(), key=len, default=()))
        if rounds < 2:
            return
        for which in (rounds - 1, 0):
            left_out = [group[which] for group in seen.values() if len(group) > which]
            if len(left_out) > 1:
                cause = Cause("round-left-out", weights.PROCEDURE["round-left-out"], what="last" if which else "first")
                yield from self._left_out(cause, left_out)
        timed = [each for group in seen.values() for each in group if isinstance(each.known.get("t"), int)]
        last = max((each.known["t"] for each in timed), default=0)
        at_the_last = [each for each in timed if each.known["t"] == last]
        tables = {id(each.known[each.formula.left.code]) for each in at_the_last}
        if last and len(tables) < len(at_the_last):
            cause = Cause("earlier-time", weights.PROCEDURE["earlier-time"], time=last - 1)
            yield from self._left_out(cause, at_the_last)

    def _left_out(self, cause: Cause, updates: Sequence[Application]) -> Iterator[Candidate]:
        """Every quantity keeps what it was where these updates are not made."""
        yield from self._candidate(cause, Change(values={each.number: each.old() for each in updates}))

    def _misread(self) -> Iterator[Candidate]:
        every = misread(self.problem.given)
        if any(application.equation for application in self.applications):
            every = chain(every, led_elsewhere(self.problem.given))
        for other in every:
            answers = self._with_givens(other.given, {})
            again = partial(self._with_givens, other.given)
            if other.kind in OF_THE_ORDER:
                again = partial(_denied_by, answers or {})
            if answers is not None and list(answers) == list(self.work.answers):
                yield Candidate(Cause(other.kind, weights.PROCEDURE[other.kind], what=other.what), answers, again)

    def _with_givens(self, given: Any, settled: Mapping[str, Any]) -> Mapping[str, Any] | None:
        return with_givens(self.problem, given, {**self.carried, **settled}, len(self.applications))

    def _equations(self) -> Iterator[Candidate]:
        """Edits of one equation of a system."""
        equations = [application for application in self.applications if application.equation]
        for application in equations:
            for cause, right, letters in self._in_equation(application):
                yield from self._candidate(cause, Change({application.right: right}, letters=letters))

    def _same_rows(self) -> Iterator[Candidate]:
        """Edits at one quantity in every round: who misreads the row of a state does so in every sweep."""
        rows: dict[Expr, dict[Any, list[Application]]] = defaultdict(lambda: defaultdict(list))
        for application in self.applications:
            if not application.equation and (letters := application.names):
                rows[application.right][tuple(letters.values())].append(application)
        for same in rows.values():
            for every in same.values() if len(same) > 1 else ():
                if len(every) > 1:
                    for cause, right, letters in self._in_equation(every[0]):
                        yield from self._candidate(
                            replace(cause, always=True), Change({every[0].right: right}, letters=letters)
                        )

    def _same_times(self) -> Iterator[Candidate]:
        """Something forgotten in all steps of one time, where there are several, and other times."""
        times: dict[Expr, dict[int, list[Application]]] = defaultdict(lambda: defaultdict(list))
        for application in self.applications:
            if isinstance(time := application.known.get("t"), int) and not application.equation:
                times[application.right][time].append(application)
        then = Indicator(sympy.Symbol("t"), sympy.Symbol("case_t"))
        for right, every in times.items():
            if len(every) < 2 or not any(len(same) > 1 for same in every.values()):
                continue
            forgotten = [edit for edit in edits(right) if edit.kind in _FORGOTTEN]
            for time, same in every.items():
                for edit in forgotten if len(same) > 1 else ():
                    weight = weights.IDEAS[edit.kind] * weights.AT_ONE
                    cause = Cause(edit.kind, weight, same[0], same[0].formula, edit, always=True, time=time)
                    yield from self._candidate(
                        cause, Change({right: Cases(then, edit.right, right)}, letters={"case_t": time})
                    )

    def _unknowns(self) -> Iterator[Candidate]:
        """Slips in solving equations with one unknown."""
        for number, equation in enumerate(self.work.equated):
            for kind, other in missolved(equation):
                if other != equation.value:
                    yield from self._candidate(Cause(kind, weights.PROCEDURE[kind]), Change(equated={number: other}))

    def _unsolved(self) -> Iterator[Candidate]:
        """Systems of equations that are applied a few times, from 0 on, instead of solved."""
        if not any(application.equation for application in self.applications):
            return
        for sweeps, in_place in product(range(1, _SWEEPS + 1), (False, True)):
            cause = Cause("unsolved", weights.PROCEDURE["unsolved"], what=TIMES[sweeps - 1])
            yield from self._candidate(cause, Change(sweeps=sweeps, in_place=in_place))

    def _in_equation(self, application: Application) -> Iterator[tuple[Cause, Expr, dict[str, Any]]]:
        letters = application.names
        case = {f"case_{name}": value for name, value in letters.items()}
        here = Indicator(*(sympy.Symbol(name) for letter in letters for name in (letter, f"case_{letter}")))
        right = application.right
        for edit in edits(right):
            weight = weights.IDEAS[edit.kind] * weights.AT_ONE
            cause = Cause(edit.kind, weight, application, application.formula, edit)
            if edit.kind not in IN_ONE_TERM and is_made_of_shares(edit, (application,)):
                yield cause, Cases(here, edit.right, right), case
            if edit.once is not None:
                once = Cases(here, edit.once, right)
                for term, at in single(edit, application.known):
                    if is_made_of_shares(edit, (application,), term):
                        yield replace(cause, weight=weight * weights.IN_ONE_TERM, term=term), once, {**case, **at}
        for probe in probes(right):
            changed = Cases(here, probe.right, right)
            for cause, letters_ in at_place(application, probe):
                yield cause, changed, {**case, **letters_}

    # One application --------------------------------------------------------------------------------
    def alternatives(self, application: Application) -> list[Cause]:
        """What may come out of one application instead of its value, the likeliest first."""
        for _ in self.working_out(application):
            pass
        return self._alternatives[application.number]

    def working_out(self, application: Application) -> Iterator[None]:
        """Work that out piece by piece, for who has little time."""
        if application.number in self._alternatives:
            return
        every = []
        for cause in at_one(application, self.problem.given):
            if application.number not in self._shares:
                every.append(cause)
            elif self._is_possible_share(cause):
                every.append(self._in_a_share(cause))
            yield
        found: dict[Any, list[Cause]] = defaultdict(list)
        for cause in sorted(every, key=lambda cause: -cause.weight):
            alike = found[hashable(cause.became)]
            same = (other for other in alike[1:] if other.kind == cause.kind)
            if len(alike) < _ALIKE and not any(other.part == cause.part for other in same):
                alike.append(cause)
            yield
        found.pop(hashable(application.value), None)
        apart = (cause for alike in found.values() for cause in alike)
        self._alternatives[application.number] = sorted(apart, key=lambda cause: -cause.weight)

    @staticmethod
    def _is_possible_share(cause: Cause) -> bool:
        """Whether somebody goes on with what came out for a share: not if it is negative or more than 1.

        That a point or a digit slipped is seen in the number itself, whatever its size.
        """
        return cause.kind in ("tenfold", "digits") or likely_share(cause.became) == 1

    @staticmethod
    def _in_a_share(cause: Cause) -> Cause:
        """A cause in one share of several: all are misread alike, and what they are divided by is worked out once."""
        if cause.mistake is None and not cause.term:
            return cause
        return replace(cause, weight=cause.weight * weights.IN_ONE_TERM)

    @cached_property
    def _shares(self) -> set[int]:
        return shares(self.applications)

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


def _denied_by(answers: Mapping[str, Any], settled: Mapping[str, Any]) -> Mapping[str, Any] | None:
    """What somebody answers who erred all along; None where that is not what is settled."""
    return answers if all(equal(answers.get(label), value) for label, value in settled.items()) else None


def _nth(within: Sequence[Over], nth: int) -> Callable[[Mapping[str, Any]], Mapping[str, Any]]:
    """The letters of the nth term, whatever the application; of none where there are fewer."""

    def letters(known: Mapping[str, Any]) -> Mapping[str, Any]:
        for number, (_, at) in enumerate(terms(within, known)):
            if number == nth:
                return at
        return {element(depth): None for depth in range(len(within))}

    return letters
