"""The working of a problem: the solver's notebook, in which every step is data."""

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import Any, NamedTuple, TypeVar

from flint import fmpq
from msgspec import Struct
from msgspec.structs import replace
from sympy import Expr

from rldrill.problems.document import Equation
from rldrill.problems.exact import PARAMETERS
from rldrill.problems.mathematics import Math, listed, mathematics, name, punctuation, row, signs
from rldrill.problems.notations import LECTURE, Writing, in_use, is_linear
from rldrill.problems.parts import label as part_label
from rldrill.problems.pictures import Picture
from rldrill.solutions.exact import ZERO, NoSolution, Value, sign, simplest, tidy, told
from rldrill.solutions.formula.collecting import collected_next
from rldrill.solutions.formula.compiling import DivisionError, value_of
from rldrill.solutions.formula.elimination import MOST_UNKNOWNS, elimination
from rldrill.solutions.formula.equations import Affine, solve_linear
from rldrill.solutions.formula.formula import Formula, Misconception
from rldrill.solutions.formula.lines import lines_between
from rldrill.solutions.formula.notation import Quantity
from rldrill.solutions.formula.putting_in import indexed, put_in, without_slots
from rldrill.solutions.formula.typesetting import alone, tabular, typeset, typeset_value, vector
from rldrill.solutions.limits import bounded
from rldrill.solutions.matrices import is_matrix
from rldrill.solutions.rational import generator, linear, without_quotients
from rldrill.solutions.roots import as_zeros, degree, only_root
from rldrill.solutions.vector import Vector

Known = TypeVar("Known")


class _Applied(NamedTuple):
    formula: Formula
    right: Expr
    known: Mapping[str, Any]
    value: Any
    sign: str
    into: Callable[..., Expr] | None = None
    own: bool = False
    label: str | None = None


class Step(_Applied):
    """One application of a formula: what was put in, and the exact value that came out.

    ``into`` names the quantity that comes out, where it is not the formula's own; ``own`` says that the right side is
    the problem's own (a derivative of its dynamics), not the formula's; ``label`` which of many steps it is,
    ``$t = 2$``: an update that knows its t says it unasked.
    """

    @cached_property
    def named(self) -> Expr:
        """The quantity that comes out, in letters: ``V_2(s)``."""
        return self.formula.left if self.into is None else self.into(*self.formula.left.args)

    @cached_property
    def left(self) -> Expr:
        """The name of the quantity, its indices put in: ``V(cool)``."""
        return indexed(self.named, self.known)

    @cached_property
    def put_in(self) -> Expr:
        """The right side with the numbers put in, unevaluated."""
        return put_in(self.right, self.known)

    def general(self) -> Equation:
        """The formula before the numbers are put in; a policy by the name that it has here, π₁ or π′."""
        formula = self.formula
        plain = formula.equation(formula.right)
        codes = {node.code for node in formula.right.atoms(Quantity)}
        if (
            self.own or getattr(formula.left, "code", None) in codes
        ):  # what is updated has a name for the old and the new
            return plain
        left = self.named if self.named.is_Symbol else self.named.func(*formula.left.args)
        return replace(formula, left=left).equation(formula.right)

    def equation(self) -> Equation:
        """The step as one writes it: numbers put in, brackets worked out, result."""
        writing = in_use()
        if writing not in self._equations:
            self._equations[writing] = self._written()
        return self._equations[writing]

    @cached_property
    def _equations(self) -> dict[Writing, Equation]:
        """The equation in every way in which it was asked for; the same steps are written again and again."""
        return {}

    def _written(self) -> Equation:
        written = self.put_in
        rights = [typeset(self.right)] if self.own else []
        rights.append(alone(written))
        if self.value is not None:  # an equation of a system has no value of its own
            rights += [*map(alone, lines_between(written, own=self.own)), shown_value(self.value)]
        distinct = _without_detours(rights)
        left = typeset(self.left)
        if label := self._label():
            left = row(mathematics(label), punctuation(":"), left)
        # With the numbers put in, it does not tell any more whether it is of a linear system.
        linear = in_use().notation != LECTURE and any(map(is_linear, (left, typeset(self.formula.right))))
        return Equation(left, distinct, (self.sign, *["="] * (len(distinct) - 1)), linear=linear)

    def _label(self) -> str:
        if self.label is not None:
            return self.label
        return f"t = {self.known['t']}" if self.sign == "←" and "t" in self.known else ""


def _without_detours(rights: Iterable[Math]) -> tuple[Math, ...]:
    """The right sides without those that lead back to one before, which has the same signs in another order.

    Of two that differ in the order only, the later one is kept, unless the former is the first, with all its places.
    """
    kept: dict[tuple[str, ...], Math] = {}
    for right in rights:
        spelled = tuple(sorted(sign for sign in signs(right) if sign != "+"))
        if spelled in kept:
            while next(reversed(kept)) != spelled:
                kept.popitem()
            if len(kept) > 1:
                kept[spelled] = right
        else:
            kept[spelled] = right
    return tuple(kept.values())


class Note(Struct, frozen=True, dict=True):
    """A sentence between the steps; one that takes long to make is made when somebody looks."""

    said: str | Callable[[], str]

    @cached_property
    def text(self) -> str:
        """The sentence."""
        return self.said if isinstance(self.said, str) else self.said()


class Recalled(Struct, frozen=True):
    """A formula as it stands: what the steps that follow are there for."""

    formula: Formula

    def equation(self) -> Equation:
        """The formula, nothing put in."""
        return self.formula.equation()


class Drawn(Struct, frozen=True):
    """Pictures between the steps, which are made when somebody looks."""

    pictures: Callable[[], Iterable[Picture]]


class Result(Struct, frozen=True):
    """Values that a procedure gives together: the solution of a system, a table at its end."""

    lefts: tuple[Expr, ...]
    values: tuple[Any, ...]

    def equations(self) -> tuple[Equation, ...]:
        """One line for every value."""
        return tuple(
            Equation(typeset(left), (shown_value(value),), ("=",))
            for left, value in zip(self.lefts, self.values, strict=True)
        )


@dataclass(frozen=True)
class Equality:
    """An equation that follows from the ones before: both sides values, or expressions in what is not known yet."""

    left: Any
    rights: tuple[Any, ...]

    def equation(self) -> Equation:
        """The equation typeset, without what it repeats."""
        left, *rights = dict.fromkeys(map(_side, (self.left, *self.rights)))
        return Equation(left, tuple(rights), ("=",) * len(rights))


class Elimination(Struct, frozen=True):
    """How a system of equations is solved by hand."""

    names: Mapping[Hashable, Expr]
    equations: Mapping[Hashable, Any]
    values: tuple[Any, ...]
    steps: tuple[Step, ...] = ()

    def lines(self) -> "Iterator[Note | Equality]":
        """The lines of it."""
        terms = {key: _terms(step) for key, step in zip(self.names, self.steps, strict=False)}
        try:
            lines = list(elimination(self.names, self.equations, terms))
        except ZeroDivisionError:  # an unknown falls out of its own equation
            together = zip(self.names.values(), self.values, strict=True)
            lines = ["Together these equations give:", *((name, (value,)) for name, value in together)]
        for line in lines:
            yield Note(line) if isinstance(line, str) else Equality(*line)


def _terms(step: Step) -> tuple[Expr, ...]:
    """An equation of a system multiplied out, where its terms are still to be collected."""
    line = collected_next(without_slots(step.put_in))
    return () if line is None else (line,)


class Found(NamedTuple):
    """A letter and the value that solves its equation; whether it is known to be a share, or above 0."""

    letter: str
    value: Any
    share: bool
    positive: bool

    @property
    def sign(self) -> str:
        """The letter as questions have it."""
        return PARAMETERS.get(self.letter, self.letter)


Line = Step | Note | Recalled | Drawn | Result | Equality | Elimination


def _side(value: Any) -> Math:
    return typeset(value) if isinstance(value, Expr) else shown_value(value)


def shown_value(value: Any) -> Math:
    """A value of any kind as mathematics: a number, a matrix, the actions that are best."""
    if isinstance(value, tuple):
        return listed(name(str(item)) for item in value)
    if isinstance(value, Vector):
        return vector(value)
    if is_matrix(value):
        return typeset_value(value[0, 0]) if value.nrows() == value.ncols() == 1 else tabular(value.tolist())
    return typeset_value(value)


@dataclass
class Work:
    """What a solver writes into.

    Args:
        misconception: the mistake to make, if any.
        carried: for follow-through, a person's own answers to earlier parts.
        same: what came out on the right way, application by application: up to the formula that is misread, the same
            comes out here.
        right: for a slip, the answers of the right way, where they are known.
        sound: how many parts are answered before formulas are misread.
        otherwise: where somebody who goes on from an own answer may go another way, whether that one is gone.
    """

    misconception: Misconception | None = None
    carried: Mapping[str, Any] = field(default_factory=dict)
    same: Sequence[Any] = ()
    right: Sequence[Any] = ()
    sound: int = 0
    otherwise: bool = False
    forks: bool = False
    values: list[Any] = field(default_factory=list)
    lines: list[Line] = field(default_factory=list)
    answers: dict[str, Any] = field(default_factory=dict)
    ends: dict[str, int] = field(default_factory=dict)
    read: dict[Formula, None] = field(default_factory=dict)
    letters: list[Found] = field(default_factory=list)

    def misreads(self, formula: Formula) -> bool:
        """Whether the mistake to make is in this formula: what follows from it need not follow now."""
        misread = len(self.answers) >= self.sound and self.misconception in formula.misread
        if misread:
            self.same = ()
        return misread

    def reading(self, formula: Formula) -> Expr:
        """The right side of a formula, as it is read here: misread, if that is the mistake to make."""
        mistake = self.misconception
        if mistake is None:
            self.read[formula] = None
            return formula.right
        misread = formula.readings.get(mistake.key)
        if misread is None or len(self.answers) < self.sound:
            return formula.right
        self.same = ()
        return misread

    def step(
        self,
        formula: Formula,
        *,
        into: Any = None,  # these four are Any so that **known may come from a mapping of anything
        sign: Any = None,
        right: Any = None,
        label: Any = None,
        **known: Any,
    ) -> Any:
        """Apply a formula to known quantities; the value is exact, the writing is done when asked for.

        Args:
            formula: a formula of the sheet.
            into: the quantity to name the result by, where it is not the formula's own (V₂ for V).
            sign: the relation, a text, that holds here, where it is not the formula's own (an inequality that fails).
            right: what stands on the right in this problem, where the formula only says which function's
                derivative it is.
            label: which of many steps this is, in mathematics (``i = 2``).
            **known: the values by the formula's letters; quantities are mappings from their arguments.
        """
        own = right is not None
        right = self.reading(formula) if right is None else right
        value = self._next(_applied, formula, right, known)
        if self.misconception is None:  # nobody reads the working of a mistake
            sign = sign or (formula.sign if into is None else "=")
            self.lines.append(Step(formula, right, known, value, sign, into, own, label))
        return value

    def value(self, formula: Formula, **known: Any) -> Any:
        """What a formula, as it is read here, gives for known quantities, without a step in the working."""
        right = self.reading(formula)
        return self._next(value_of, right, known)

    def _next(self, found: Callable[..., Any], *arguments: Any) -> Any:
        """What comes out next, looked up while it must be what came out on the right way."""
        values = self.values
        number = len(values)
        if number < len(self.same) and (value := self.same[number]) is not None:
            values.append(value)
            return value
        values.append(None)  # its place is taken even where nothing comes out
        values[number] = value = found(*arguments)
        return value

    def system(
        self,
        formula: Formula,
        unknown: type[Quantity],
        cases: Iterable[Mapping[str, Any]],
        *,
        instead: Formula | None = None,
        **known: Any,
    ) -> dict[Any, Value]:
        """Solve the linear equations that a formula states, one for every case.

        Args:
            formula: a formula that gives the unknown quantity, linear in it.
            unknown: the quantity to solve for.
            cases: the indices of every equation, such as ``{"s": "cool"}``.
            instead: an equation between a number and what is linear in the unknown, in place of that of the last case.
            **known: everything else; values of the unknown that are fixed may be among it.

        Raises:
            NoSolution: there is no unique solution.
        """
        right, other = self.reading(formula), None if instead is None else self.reading(instead)
        fixed = dict(known.get(unknown.code, {}))
        keys = [(tuple(case.values()) if len(case) > 1 else next(iter(case.values())), case) for case in cases]
        lookup: dict[Hashable, Any] = {key: Affine({key: ZERO + 1}) for key, _ in keys}
        bound = {**known, unknown.code: _Unknowns({**lookup, **fixed}, ZERO)}
        equations = {}

        def solved() -> dict[Any, Value]:
            for key, case in keys:
                equations[key] = value_of(right, {**bound, **case})
            if instead is not None:
                last = keys[-1][0]
                equations[last] = lookup[last] + value_of(instead.left, {}) + value_of(other, bound) * (ZERO - 1)
            return bounded(solve_linear(equations))

        solution = self._next(solved)
        if self.misconception is None:
            steps = [Step(formula, right, {**known, unknown.code: fixed, **case}, None, "=") for _, case in keys]
            if instead is not None:
                steps[-1] = Step(instead, other, {**known, unknown.code: fixed}, None, "=")
            self.lines += steps
            names = {key: indexed(formula.left, case) for key, case in keys}
            self._write_solution(names, equations, solution, steps[: len(keys) - (instead is not None)])
        return {**fixed, **solution}

    def _write_solution(
        self,
        names: Mapping[Hashable, Expr],
        equations: Mapping[Hashable, Any],
        solution: Mapping[Hashable, Value],
        steps: Sequence[Step],
    ) -> None:
        values = tuple(solution[key] for key in names)
        if len(names) <= MOST_UNKNOWNS:
            self.lines.append(Elimination(names, equations, values, tuple(steps)))
        else:
            self.lines += (Note("Solving these equations:"), Result(tuple(names.values()), values))

    def equate(self, letter: str, left: Any, right: Any, *, share: bool = False, positive: bool = False) -> Value:
        """Solve an equation in one letter, in front of the reader; the letter's value.

        One of higher degree is solved on the right way alone, where one root is all that the letter can be.

        Args:
            letter: the letter, ``gamma``; the sides were worked out with ``generator("gamma")`` in its place.
            left: the one side, a value.
            right: the other side.
            share: whether the letter lies between 0 and 1, whatever it is called.
            positive: whether it is above 0.

        Raises:
            NoSolution: every value solves the equation, or none, or one that the letter cannot have.
        """
        difference = left - right
        if self.misconception is None and degree(difference, letter) > 1:
            return self._equate_in_factors(left, right, difference, share=share, positive=positive)
        slope, constant = linear(difference, letter)
        cleared = without_quotients(left, right, letter)
        if cleared:
            slope, constant = linear(cleared[0] - cleared[1], letter)
        if sign(slope) < 0:
            slope, constant = ZERO - slope, ZERO - constant
        value = bounded(simplest(tidy(ZERO - constant / slope)))
        self.letters.append(Found(letter, value, share, positive))
        if self.misconception is None and ((share and not 0 <= value <= 1) or (positive and value <= 0)):
            between = "lies between 0 and 1" if share else "is above 0"
            raise NoSolution(f"{PARAMETERS.get(letter, letter)} would have to be {told(value)}, and it {between}")
        unknown = generator(letter)
        self.lines.append(Equality(left, (right,)))
        if cleared:
            self.lines.append(Equality(cleared[0], (cleared[1],)))
            left = cleared[0]
        if slope != 1 and unknown * slope not in (left, cleared[1] if cleared else right):
            self.lines.append(Equality(unknown * slope, (ZERO - constant,)))
        if (left, right) != (unknown, value):
            self.lines.append(Equality(unknown, (value,)))
        return value

    def _equate_in_factors(self, left: Any, right: Any, difference: Any, *, share: bool, positive: bool) -> Value:
        letter = difference.parameter
        value, where = only_root(difference, share=share, positive=positive)
        self.letters.append(Found(letter, value, share, positive))
        self.lines += [Equality(left, (right,)), *(Equality(zero, (ZERO,)) for zero in as_zeros(difference))]
        self.say(f"Only one ${PARAMETERS.get(letter, letter)}${where} solves this:")
        self.lines.append(Equality(generator(letter), (value,)))
        return value

    def recall(self, formula: Formula) -> None:
        """Write a formula down as it stands: a definition that steps by other formulas serve."""
        self.lines.append(Recalled(formula))

    def picture(self, pictures: Callable[..., Iterable[Picture]], *of: Any) -> None:
        """Draw pictures between the steps: what a function makes of these values."""
        self.lines.append(Drawn(partial(pictures, *of)))

    def give(self, formula: Formula, value: Any, **indices: Any) -> None:
        """Write down what comes out for the quantity of a formula, by other means than putting in."""
        self.lines.append(Result((indexed(formula.left, indices),), (value,)))

    @property
    def is_read(self) -> bool:
        """Whether anybody reads the sentences of the working: nobody does those of a mistake."""
        return self.misconception is None

    def say(self, said: str | Callable[[], str]) -> None:
        """Write a sentence between the steps, or what makes it; mathematics stands between ``$`` signs."""
        if self.is_read:
            self.lines.append(Note(said))

    def answer(self, value: Any) -> Any:
        """Give the answer of the next part, and get back what to go on with.

        That is the value itself, or in follow-through the answer that the person gave to this part.
        """
        value = bounded(_simplest(value))
        label = part_label(len(self.answers))
        self.answers[label] = value
        self.ends[label] = len(self.lines)
        return self.carried.get(label, value)

    def either(self, usual: Known, other: Callable[[], Known]) -> Known:
        """What to go on with after a letter was found: what the question states, or what follows from the letter.

        Both are the same on the right way, and as good for somebody who found another letter.
        """
        self.forks |= bool(self.carried)
        return other() if self.otherwise else usual


def _applied(formula: Formula, right: Expr, known: Mapping[str, Any]) -> Any:
    """What a formula gives, as one writes it."""
    try:
        value = value_of(right, known)
    except DivisionError as error:
        raise NoSolution(f"in the formula “{formula.title}” {error}; change what is given for it") from None
    return bounded(value if type(value) is fmpq else tidy(value))


def _simplest(value: Any) -> Any:
    """Numbers, alone or in a vector or table, as plain rationals where no parameter is left in them."""
    if isinstance(value, dict):
        return {key: number if type(number) is fmpq else simplest(number) for key, number in value.items()}
    if isinstance(value, tuple):
        return tuple([number if type(number) is fmpq else simplest(number) for number in value])
    return simplest(value)


class _Unknowns(dict[Hashable, Any]):
    """The unknowns of a system; a state that is not among them is worth nothing."""

    def __init__(self, values: Mapping[Hashable, Any], missing: Any) -> None:
        super().__init__(values)
        self._missing = missing

    def __missing__(self, key: Hashable) -> Any:
        return self._missing
