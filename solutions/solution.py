"""A solver for every family, and the solution of a problem: answers, working, what mistakes give."""

import importlib.util
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import cache, cached_property, lru_cache
from types import ModuleType
from typing import Any

from flint import fmpq
from msgspec import Struct

from rldrill.problems.errors import BrokenFamily
from rldrill.problems.exact import ALWAYS_SHARES, Parameter
from rldrill.problems.family import Family, Problem
from rldrill.solutions.answers.kinds import Answer, answer_kind
from rldrill.solutions.answers.rule import apart
from rldrill.solutions.exact import ONE, NoSolution, NotGiven, NotReal, Value, sign, told
from rldrill.solutions.formula.formula import Formula, Misconception
from rldrill.solutions.work import Found, Line, Recalled, Step, Work


class Solver(Struct, frozen=True):
    """The twin of a family: the module ``solutions/<topic>/<name>.py`` as an object.

    ``oracle`` gives the same answers by other means (numpy, simulation, brute force), in floating point,
    as what ``numpy.asarray`` reads; tables and vectors in the order of the part's keys. ``possible`` says, by other
    means too, whether what is stated can be true together: that values printed as those of a policy are its values.
    """

    family: Family
    solve: Callable[[Any, Work], None]
    misconceptions: tuple[Misconception, ...]
    oracle: Callable[[Any], Sequence[Any]]
    possible: Callable[[Any], bool]


@cache
def solver(family: Family) -> Solver:
    """The solver of a family.

    Raises:
        BrokenFamily: there is none, or it lacks something that a solver must have.
    """
    name = f"{family.package}.solutions.{family.topic}.{family.name.replace('-', '_')}"
    if not _exists(name):
        path = name.removeprefix(f"{family.package}.").replace(".", "/")
        raise BrokenFamily(f"{family.name}: there is no {path}.py to solve it; write its solver there.")
    module = importlib.import_module(name)
    return Solver(
        family,
        _demanded(module, "solve"),
        tuple(_demanded(module, "MISCONCEPTIONS")),
        _demanded(module, "oracle"),
        getattr(module, "possible", _anything),
    )


def _exists(name: str) -> bool:
    try:
        return importlib.util.find_spec(name) is not None
    except ModuleNotFoundError:
        return False  # nor is there its topic's folder


def _anything(_: Any) -> bool:
    """A family that states nothing but givens of its own choice."""
    return True


def _demanded(module: ModuleType, name: str) -> Any:
    try:
        return getattr(module, name)
    except AttributeError:
        raise BrokenFamily(f"{module.__file__}: a solver must have {name}; add it.") from None


@lru_cache(maxsize=1024)
def _made(family: Family, read: tuple[Formula, ...]) -> tuple[Misconception, ...]:
    """The misconceptions of a family that can be made where these formulas are read."""
    in_reading = {mistake for formula in read for mistake in formula.misread}
    return tuple([each for each in solver(family).misconceptions if each.is_slip or each in in_reading])


#: The fields whose numbers lie between 0 and 1.
_SHARES = ("gamma", "alpha", "lam", "epsilon")
#: These, and letters that are such numbers wherever they stand; others are where their complement is given, too.
_RANGED = ALWAYS_SHARES.union(_SHARES)
#: Of a longer working no mistakes are made: nobody does it by hand, and each takes as long as the solution.
_MOST_LINES = 2000


class Solution(Struct, frozen=True, dict=True):
    """The solution of one problem; ``attempts`` says how many draws it took to find a good one."""

    problem: Problem
    work: Work
    attempts: int

    @property
    def answers(self) -> Mapping[str, Any]:
        """The exact answer of every part."""
        return self.work.answers

    @cached_property
    def kinds(self) -> Mapping[str, Answer[Any]]:
        """How the answers of every part are handled."""
        return {part.label: answer_kind(part.kind) for part in self.problem.parts}

    @cached_property
    def cells(self) -> Mapping[str, Mapping[str, Any]]:
        """The exact answer of every part, taken apart into what is judged one by one."""
        return {label: kind.cells(self.answers[label]) for label, kind in self.kinds.items()}

    def tells_apart(self, answers: Mapping[str, Any]) -> bool:
        """Whether a marker can tell these answers from the right ones, in one part at least."""
        return any(self.differ(label, self.answers[label], answers[label]) for label in self.kinds if label in answers)

    def differ(self, label: str, one: Any, other: Any) -> bool:
        """Whether a marker can tell two answers to a part from each other."""
        kind = self.kinds[label]
        return _differ(self.cells[label] if one is self.answers[label] else kind.cells(one), kind.cells(other))

    @cached_property
    def sought(self) -> Mapping[str, Found]:
        """The letters that parts ask for, by the parts."""
        asks = {part.label: part.ask for part in self.problem.parts}
        return {
            label: found
            for label, answer in self.answers.items()
            for found in self.work.letters
            if type(answer) is type(found.value)
            and answer == found.value
            and re.search(rf"(?<!\w){found.sign}(?!\w)", asks[label])
        }

    def is_one_of_two_shares(self, label: str) -> bool:
        """Whether a part asks for a letter beside which 1 minus the letter is given, the probability of the other."""
        found = self.sought.get(label)
        return found is not None and _has_complement(found.letter, self.problem)

    def can_be(self, found: Found, value: Value) -> bool:
        """Whether a letter that was found can have a value, too."""
        return _is_in_range(found, value, self.problem)

    @property
    def lines(self) -> tuple[Line, ...]:
        """The whole working."""
        return tuple(self.work.lines)

    def lines_of(self, label: str) -> tuple[Line, ...]:
        """The lines of the working that come after the part before and lead to this part's answer."""
        start = max((end for end in self.work.ends.values() if end < self.work.ends[label]), default=0)
        return tuple(self.work.lines[start : self.work.ends[label]])

    def formulas(self, label: str | None = None) -> tuple[Formula, ...]:
        """The formulas that were used or recalled, in their order; those of one part, where it uses any of its own."""
        lines = self.lines if label is None else self.lines_of(label)
        used = dict.fromkeys(line.formula for line in lines if isinstance(line, Step | Recalled))
        return tuple(used) if used or label is None else self.formulas()

    @cached_property
    def mistakes(self) -> tuple[tuple[Misconception, Mapping[str, Any]], ...]:
        """Every misconception that applies here and leads to an answer, with the answers that it gives.

        None are looked for where the working is so long that nobody does it by hand: each takes a solution of its own.
        """
        return self.mistaken({})

    def mistaken(self, carried: Mapping[str, Any]) -> tuple[tuple[Misconception, Mapping[str, Any]], ...]:
        """The same, going on from a person's own answers to earlier parts."""
        if len(self.work.lines) > _MOST_LINES:
            return ()
        made = ((misconception, self.answers_with(misconception, carried)) for misconception in self.applicable)
        return tuple((misconception, answers) for misconception, answers in made if answers is not None)

    @cached_property
    def applicable(self) -> tuple[Misconception, ...]:
        """The misconceptions of the family that can be made here: slips, and misreadings of what is read here."""
        given = self.problem.given
        return tuple([each for each in _made(self.problem.family, tuple(self.work.read)) if each.applies(given)])

    def misread(self, mistake: Misconception) -> Formula | None:
        """The formula of the working that a mistake reads otherwise, the first of them; None if it is a slip."""
        return next((formula for formula in self.work.read if mistake in formula.misread), None)

    def answers_with(
        self, misconception: Misconception, carried: Mapping[str, Any] | None = None
    ) -> Mapping[str, Any] | None:
        """The answers that a mistake gives; None where it leads to none, so that nobody can give it."""
        made = self._made(misconception, carried) if carried else self._all_along(misconception)
        if made is None and not misconception.is_slip and (sound := self._found_first):
            # The letter was found without the mistake, which is made from the next part on.
            later = self._made(misconception, carried or {}, sound)
            made = later if later is not None and self.tells_apart(later) else None
        return made

    def hides(self, misconception: Misconception) -> bool:
        """Whether a mistake that is made all along gives the right answers."""
        made = None if misconception.may_hide else self._all_along(misconception)
        return made is not None and not self.tells_apart(made)

    def _all_along(self, misconception: Misconception) -> Mapping[str, Any] | None:
        key = misconception.key
        if key not in self._mistaken:
            self._mistaken[key] = self._made(misconception, {})
        return self._mistaken[key]

    @cached_property
    def _mistaken(self) -> dict[tuple[str, str], Mapping[str, Any] | None]:
        """What the mistakes give all along that somebody has asked for, by their keys."""
        return {}

    @cached_property
    def _found_first(self) -> int:
        """How many parts there are up to the one that asks for a letter which the others are answered with, or 0."""
        labels = list(self.answers)
        return next((number for number, label in enumerate(labels[:-1], 1) if label in self.sought), 0)

    def _made(
        self, misconception: Misconception, carried: Mapping[str, Any], sound: int = 0
    ) -> Mapping[str, Any] | None:
        same: Sequence[Any] = () if carried or misconception.is_slip else self.work.values
        right = () if carried else tuple(self.answers.values())
        try:
            made = run(self.problem, misconception, carried, same, right, sound).answers
            hidden = misconception.may_hide and not carried and not self.tells_apart(made)
        except (NoSolution, NotGiven, NotReal):  # such as the logarithm of nothing, which nobody writes down
            return None
        return None if hidden else made

    def following(self, carried: Mapping[str, Any]) -> Mapping[str, Any]:
        """The answers of somebody who goes on correctly from own answers to earlier parts, as far as they lead."""
        return self._followed(carried).answers

    def ways(self, carried: Mapping[str, Any]) -> tuple[Mapping[str, Any], ...]:
        """The same; also from what the question states, where that does not agree with an own answer."""
        usual = self._followed(carried)
        return (usual.answers, self._followed(carried, otherwise=True).answers) if usual.forks else (usual.answers,)

    def _followed(self, carried: Mapping[str, Any], *, otherwise: bool = False) -> Work:
        work = Work(carried=carried, otherwise=otherwise)
        with suppress(NoSolution):  # nothing more follows from what was typed
            solver(self.problem.family).solve(self.problem.given, work)
        return work


def _differ(right: Mapping[str, Any], wrong: Mapping[str, Any]) -> bool:
    return any(
        not set(content) & set(wrong[name]) if isinstance(content, tuple) else apart(content, wrong[name])
        for name, content in right.items()
    )


def run(
    problem: Problem,
    misconception: Misconception | None = None,
    carried: Mapping[str, Any] | None = None,
    same: Sequence[Any] = (),
    right: Sequence[Any] = (),
    sound: int = 0,
) -> Work:
    """Let the family's solver work, with a mistake or somebody's earlier answers if given.

    Args:
        problem: the problem.
        misconception: the mistake.
        carried: the earlier answers.
        same: what comes out on the right way, up to the formula that is misread.
        right: the answers of the right way.
        sound: how many parts are answered before formulas are misread.

    Raises:
        NoSolution: the problem has no answer.
        NotGiven: the mistake asks for something that the problem does not give.
        BrokenFamily: the right way does, or it answers other parts than those that are asked.
    """
    work = Work(misconception, carried or {}, same, right, sound)
    slipping = None if misconception is None else misconception.solve
    try:
        (slipping or solver(problem.family).solve)(problem.given, work)
    except NotGiven as error:
        if misconception is None:
            raise BrokenFamily(f"{problem.family.name}: its solver asks for more than is given: {error}.") from error
        raise
    asked = [part.label for part in problem.parts]
    if list(work.answers) != asked:
        whose = "its solver" if slipping is None else f"the slip {misconception}"
        raise BrokenFamily(
            f"{problem.family.name}: the question has the parts {', '.join(asked)}, and {whose} answers "
            f"{', '.join(work.answers) or 'none'}; both need the same parts in the same order."
        )
    return work


def solve(problem: Problem, attempts: int = 1) -> Solution:
    """Solve a problem exactly.

    Args:
        problem: the problem.
        attempts: how many draws it took to find it.

    Raises:
        NoSolution: the problem has no answer (a value that does not exist, a singular matrix).
    """
    work = run(problem)
    _check_found(problem, work)
    return Solution(problem, work, attempts)


def _check_found(problem: Problem, work: Work) -> None:
    """Refuse a letter that is asked for, and has no value in its range.

    Raises:
        NoSolution: a discount, a chance or a step size would be below 0 or above 1.
    """
    answers = list(work.answers.values())
    for found in work.letters:
        value = found.value
        if type(value) is fmpq and value in answers and not _is_in_range(found, value, problem):
            where = "lies between 0 and 1" if value else "is above 0"
            raise NoSolution(f"{found.sign} would have to be {told(value)}, and it {where}; change what is known")


def _is_in_range(found: Found, value: Value, problem: Problem) -> bool:
    """Whether a letter can have a value: it is held by what it stands for, whatever it is called."""
    above = sign(value)
    if found.positive or (above > 0 and sign(value - ONE) <= 0):
        return above > 0
    letter = found.letter
    stands_for = {letter, *(name for name in _SHARES if letter in _letters(getattr(problem.given, name, None)))}
    if above == 0:
        return "alpha" not in stands_for
    ranged = found.share or stands_for & _RANGED
    return not ranged and not _has_complement(letter, problem)


def _has_complement(letter: str, problem: Problem) -> bool:
    """Whether 1 minus a letter is given, too."""
    return repr(f"1-{letter}") in str(problem.given.model_dump())


def _letters(field: object) -> Iterator[str]:
    """The letters that a field leaves open: a number, or one for every step."""
    for number in field if isinstance(field, tuple) else (field,):
        if isinstance(number, Parameter):
            yield number.symbol
