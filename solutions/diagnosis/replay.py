"""The working of a problem taken down, and gone through again with something changed in it."""

from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from copy import copy
from typing import Any, TypeAlias

from flint import fmpq
from msgspec import Struct, field
from sympy import Expr

from rldrill.problems.family import Problem
from rldrill.solutions.exact import NoSolution, NotGiven, NotReal, TooLong, length, simplest, tidy
from rldrill.solutions.formula.compiling import value_of
from rldrill.solutions.formula.formula import Formula
from rldrill.solutions.formula.notation import Quantity
from rldrill.solutions.rational import RationalFunction, linear, with_found
from rldrill.solutions.solution import solver
from rldrill.solutions.work import Step, Work

#: Numbers with more binary digits than this come from no slip that anybody makes; what is only compared may be longer.
_LONGEST, _LONGEST_COMPARED = 2000, 40_000
#: A changed working is given up when it has so many times the steps of the right one, and a hundred more.
_LONGER = 3
#: What a changed problem, which need not be one, may lead to.
UNDONE = (
    NoSolution, NotGiven, NotReal, TooLong, ArithmeticError, LookupError, TypeError, ValueError, AttributeError,
    AssertionError, RuntimeError,
)  # fmt: skip


class Application(Struct, frozen=True, eq=False):
    """One application of a formula in the right working; ``nth`` says which of all its steps it is, from 0.

    The equations of a system are applications, too, each with the value that the solution gives its unknown.
    ``first`` is the table that the formula updates, as it was before its first update; None where it updates none.
    """

    number: int
    nth: int
    step: Step
    value: Any
    known: Mapping[str, Any]
    equation: bool = False
    first: Mapping[Any, Any] | None = None

    @property
    def formula(self) -> Formula:
        """The formula that was applied."""
        return self.step.formula

    @property
    def right(self) -> Expr:
        """The right side that was computed with."""
        return self.step.right

    @property
    def names(self) -> dict[str, str]:
        """The letters that stand for a name, such as a state: they tell it from others of the same formula."""
        return {letter: name for letter, name in self.known.items() if isinstance(name, str)}

    def old(self) -> Any:
        """What the quantity was worth before, where a table of its values is among what is known; else None."""
        left = self.formula.left
        if not isinstance(left, Quantity) or not isinstance(self.known.get(left.code), Mapping):
            return None
        try:
            return value_of(left, self.known)
        except UNDONE:
            return None


class Equated(Struct, frozen=True):
    """An equation that was solved for a letter, and the letter's value."""

    letter: str
    left: Any
    right: Any
    value: Any


class Recorder(Work):
    """A solver's notebook that also takes down every application with what was known."""

    def __init__(self, carried: Mapping[str, Any]) -> None:
        super().__init__(carried=carried)
        self.applications: list[Application] = []
        self.equated: list[Equated] = []
        self._first: dict[str, Mapping[Any, Any]] = {}

    def step(self, formula: Formula, **named: Any) -> Any:
        """As in any working."""
        value = super().step(formula, **named)
        self._take_down(len(self.lines) - 1, value, self.lines[-1].known, equation=False)  # type: ignore[union-attr]
        return value

    def system(
        self, formula: Formula, unknown: type[Quantity], cases: Iterable[Mapping[str, Any]], **named: Any
    ) -> Any:
        """As in any working."""
        cases, start = list(cases), len(self.lines)
        solution = super().system(formula, unknown, cases, **named)
        for place, case in enumerate(cases):
            known = {**named, unknown.code: dict(solution), **case}
            self._take_down(start + place, solution[_key(case)], known, equation=True)
        return solution

    def equate(self, letter: str, left: Any, right: Any, **of: Any) -> Any:
        """As in any working."""
        value = super().equate(letter, left, right, **of)
        self.equated.append(Equated(letter, left, right, value))
        return value

    def _take_down(self, line: int, value: Any, known: Mapping[str, Any], *, equation: bool) -> None:
        step = self.lines[line]
        assert isinstance(step, Step)
        nth = sum(isinstance(each, Step) for each in self.lines[:line])
        left, first = step.formula.left, None
        if isinstance(left, Quantity) and isinstance(table := known.get(left.code), Mapping):
            first = self._first.setdefault(left.code, table)
        self.applications.append(
            Application(len(self.applications), nth, step, simplest(value), known, equation, first)
        )


def _key(case: Mapping[str, Any]) -> Any:
    return tuple(case.values()) if len(case) > 1 else next(iter(case.values()))


#: What somebody does with what is known before every application.
Habit = Callable[["Replay", Formula, Mapping[str, Any]], Mapping[str, Any]]


class Change(Struct, frozen=True):
    """What is changed in a working.

    Args:
        rights: right sides that are exchanged for others, wherever they are read.
        values: for the numbers of applications, other values that come out.
        letters: what the exchanged right sides need besides; or what gives that for what is known.
        habit: what is done with what is known before every application.
        equated: for the numbers of equations with one unknown, other values of it.
        sweeps: how often equations are applied, from 0 on, instead of solved; 0 where they are solved.
        in_place: whether each of them then uses the values that those before have given already.
    """

    rights: Mapping[Expr, Expr] = field(default_factory=dict)
    values: Mapping[int, Any] = field(default_factory=dict)
    letters: Mapping[str, Any] | Callable[[Mapping[str, Any]], Mapping[str, Any]] = field(default_factory=dict)
    habit: Habit | None = None
    equated: Mapping[int, Any] = field(default_factory=dict)
    sweeps: int = 0
    in_place: bool = False


#: An application in a changed working: its number, the right side, what was known, and its value.
Traced: TypeAlias = tuple[int, Expr, Mapping[str, Any], Any]


class Replay(Work):
    """A notebook in which the change is made, and nothing is written down.

    The values of ``before``, the applications before the first one that is changed, are not computed again.
    """

    def __init__(
        self,
        change: Change,
        carried: Mapping[str, Any],
        limit: int,
        trace: list[Traced] | None = None,
        before: Sequence[Application] = (),
    ) -> None:
        super().__init__(carried=carried)
        self.change = change
        self.before = before
        self.trace = trace
        self.limit = limit
        self.number = self.solved = 0
        self.found: dict[str, dict[Any, Any]] = {}
        self.first: dict[str, Any] = {}
        self.settled: dict[str, Any] = {}
        self._sought = ""
        self._again: dict[Any, Any] = {}

    def reading(self, formula: Formula) -> Expr:
        """The right side, exchanged if it is among those."""
        self._count()
        if formula.right in self.change.rights:
            self.before = ()  # what comes now can depend on it, though no step says so
        return self.change.rights.get(formula.right, formula.right)

    def step(self, formula: Formula, *, right: Any = None, **known: Any) -> Any:
        """The value alone."""
        for written in ("into", "sign", "label"):
            known.pop(written, None)
        number, self.number = self.number, self.number + 1
        if number < len(self.before):
            return self.before[number].value
        if number in self.change.values:
            self._count()
            self._again[_same(formula, known)] = value = self.change.values[number]
            if self.trace is not None:
                self.trace.append((number, formula.right, known, value))
            return value
        right = self.reading(formula) if right is None else self.change.rights.get(right, right)
        if self.change.habit:
            known = dict(self.change.habit(self, formula, known))
        value = _bounded(tidy(value_of(right, {**known, **self._letters(known)})))
        if self.trace is not None:
            self.trace.append((number, right, known, value))
        if self.change.habit:
            left = formula.left
            if isinstance(left, Quantity) and left.code in known:
                arguments = tuple(value_of(argument, known) for argument in left.args)
                key = arguments[0] if len(arguments) == 1 else arguments
                self.found.setdefault(left.code, {})[key] = value
        return value

    def value(self, formula: Formula, **known: Any) -> Any:
        """The value, as it was changed where the same step was changed before."""
        same = _same(formula, known)
        if same in self._again:
            return self._again[same]
        return _bounded(super().value(formula, **known, **self._letters(known)), _LONGEST_COMPARED)

    def system(
        self, formula: Formula, unknown: type[Quantity], cases: Iterable[Mapping[str, Any]], **named: Any
    ) -> Any:
        """The solution, changed where its values are."""
        cases = list(cases)
        if 0 < self.number + len(cases) <= len(self.before):
            self.number += len(cases)
            return dict(self.before[self.number - 1].known[unknown.code])
        if self.change.sweeps and "instead" not in named:
            solution = self._applied(formula, unknown, cases, named)
        else:
            solution = super().system(formula, unknown, cases, **named, **self._letters(named))
        for case in cases:
            if self.number in self.change.values:
                solution[_key(case)] = self.change.values[self.number]
            if self.trace is not None:
                self.trace.append((self.number, formula.right, named, solution[_key(case)]))
            self.number += 1
        return solution

    def equate(self, letter: str, left: Any, right: Any, **_of: Any) -> Any:
        """The unknown, as somebody gets it who errs in solving the equation, whatever it may be."""
        number, self.solved, self._sought = self.solved, self.solved + 1, letter
        if number in self.change.equated:
            return self.change.equated[number]
        linear(left - right, letter)  # what is changed into an equation of higher degree is left
        return super().equate(letter, left, right)

    def answer(self, value: Any) -> Any:
        """What is gone on with; of an equation that was just solved, the number for its letter."""
        found = super().answer(value)
        if self._sought:
            self.settled[self._sought], self._sought = found, ""
        return found

    def with_found(self, table: Any) -> Any:
        """A table of before, with the numbers for the letters in it that were found meanwhile."""
        if not self.settled or not isinstance(table, dict):
            return table
        filled = copy(table)
        for key, value in table.items():
            if isinstance(value, RationalFunction) and value.parameter in self.settled:
                filled[key] = with_found(value, self.settled[value.parameter])
        return filled

    def _applied(
        self, formula: Formula, unknown: type[Quantity], cases: Sequence[Mapping[str, Any]], named: Mapping[str, Any]
    ) -> dict[Any, Any]:
        """What the unknowns are where the equations are applied a few times, not solved."""
        right, fixed = self.reading(formula), dict(named.get(unknown.code, {}))
        values: dict[Any, Any] = defaultdict(fmpq, {_key(case): fmpq(0) for case in cases} | fixed)
        for _ in range(self.change.sweeps):
            before = values if self.change.in_place else values.copy()
            for case in cases:
                values[_key(case)] = _bounded(tidy(value_of(right, {**named, unknown.code: before, **case})))
        return {**fixed, **{_key(case): values[_key(case)] for case in cases}}

    def _letters(self, known: Mapping[str, Any]) -> Mapping[str, Any]:
        letters = self.change.letters
        return letters(known) if callable(letters) else letters

    def _count(self) -> None:
        self.limit -= 1
        if self.limit < 0:
            raise NoSolution("it goes on and on")


def _same(formula: Formula, known: Mapping[str, Any]) -> Any:
    """What tells one application of a formula from another: its indices, and its numbers, such as another discount."""
    told = str | int | fmpq | RationalFunction
    return formula, tuple((name, str(value)) for name, value in known.items() if isinstance(value, told))


def _bounded(value: Any, longest: int = _LONGEST) -> Any:
    if length(value) > longest:
        raise NoSolution("the numbers get too long")
    return value


def recorded(problem: Problem, carried: Mapping[str, Any]) -> Recorder:
    """The right working, with all applications."""
    work = Recorder(carried)
    solver(problem.family).solve(problem.given, work)
    return work


def replayed(
    problem: Problem,
    change: Change,
    carried: Mapping[str, Any],
    right: Sequence[Application],
    trace: list[Traced] | None = None,
) -> Mapping[str, Any] | None:
    """The answers of a working that is changed, where it was ``right``; None where it leads to none.

    The applications from the first change on are added to ``trace``.
    """
    work = Replay(change, carried, _LONGER * len(right) + 100, trace, right[: _first(change, right)])
    return _answers(problem, work)


def _first(change: Change, right: Sequence[Application]) -> int:
    """The number of the first application that is changed."""
    if change.habit is not None:
        return 0
    read = (each.number for each in right if each.right in change.rights) if change.rights else ()
    swept = (each.number for each in right if each.equation) if change.sweeps else ()
    return min((*change.values, *read, *swept), default=0)


def with_givens(problem: Problem, given: Any, carried: Mapping[str, Any], steps: int) -> Mapping[str, Any] | None:
    """The answers for other givens; None where there are none."""
    work = Replay(Change(), carried, _LONGER * steps + 100)
    return _answers(Problem(problem.family, given), work)


def _answers(problem: Problem, work: Replay) -> Mapping[str, Any] | None:
    with suppress(*UNDONE):  # the parts before stand
        solver(problem.family).solve(problem.given, work)
    return work.answers or None
