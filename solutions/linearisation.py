"""Linearising the dynamics of a problem: derivatives in letters, then exact values at the operating point."""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

from sympy import Expr

from rldrill.problems.angles import Angle
from rldrill.problems.document import joined
from rldrill.problems.exact import needed
from rldrill.problems.expressions import letters
from rldrill.problems.fractions import Fraction
from rldrill.problems.robots import Entries, System
from rldrill.solutions import dynamics, matrices
from rldrill.solutions.exact import ZERO, NoSolution, Value, exact, is_zero
from rldrill.solutions.formula.compiling import value_of
from rldrill.solutions.formula.formula import Formula, Misconception, slip
from rldrill.solutions.knowns import kept
from rldrill.solutions.matrices import AnyMatrix
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.sheet.linear_methods import (
    EULER_A,
    EULER_B,
    EULER_F,
    INPUT_JACOBIAN,
    LINEARISE,
    PART_VALUE,
    STATE_JACOBIAN,
    Ai,
    Bi,
    f_alone,
    f_value,
    part_value,
    partial,
    partial_part,
)
from rldrill.solutions.work import Equality, Work
from rldrill.solutions.zero_order_hold import ZeroOrderHold

#: The derivative of an expression by a letter, with the named parts in it that depend on the letter.
Rule = Callable[[str, str, tuple[str, ...]], Expr]
#: How somebody gets from a system to its matrices, in the order "AB" or "BA".
Linearised = Callable[[System, Work, str], Iterator[AnyMatrix]]


def linearised(given: System, work: Work, order: str = "AB", rule: Rule = dynamics.chained) -> Iterator[AnyMatrix]:
    """The matrices in this order, of the Euler step if the system has one; a zero-order hold takes A first."""
    work.recall(LINEARISE)
    work.say("Here $∇_s f$ is the matrix $A$ with the entries $A_{i j}$, and $∇_a f$ is $B$, likewise.")
    known = _point(work, given)
    found: dict[str, AnyMatrix] = {}
    for which in order:
        found[which] = _jacobian(work, given, STATE_JACOBIAN if which == "A" else INPUT_JACOBIAN, known, rule)
        yield _discretised(work, given, which, found)


def _discretised(work: Work, given: System, which: str, found: Mapping[str, AnyMatrix]) -> AnyMatrix:
    if given.held:
        holding = hold(given, found["A"])
        return holding.state(work) if which == "A" else holding.action(work, found["B"])
    return _euler(work, given, EULER_A if which == "A" else EULER_B, found[which])


def answered(work: Work, entries: Entries | None, which: str, found: AnyMatrix) -> AnyMatrix:
    """Answer with a matrix, or with those of its entries that are asked for; what to go on with."""
    if entries is None:
        whole: AnyMatrix = work.answer(found)
        return whole
    places = [(row - 1, column - 1) for row, column in getattr(entries, which)]
    if not places:
        return found
    numbers = work.answer(tuple(found[place] for place in places) if len(places) > 1 else found[places[0]])
    rows = found.tolist()
    for (row, column), number in zip(places, numbers if len(places) > 1 else (numbers,), strict=True):
        rows[row][column] = number
    return matrices.matrix(rows)


def chosen(entries: Entries | None, A: Array, B: Array) -> list[Any]:
    """The answers about both matrices, for the independent solvers."""
    if entries is None:
        return [A, B]
    places = [[(row - 1, column - 1) for row, column in asked] for asked in (entries.A, entries.B)]
    return [[matrix[place] for place in asked] for matrix, asked in zip((A, B), places, strict=True) if asked]


def hold(given: System, A: AnyMatrix) -> ZeroOrderHold:
    """The zero-order hold of a system with this matrix of its rates."""
    return ZeroOrderHold(A, exact(needed(given.step)))


def moved_point(given: System, work: Work, state: AnyMatrix, rates: AnyMatrix) -> AnyMatrix:
    """Where the operating point goes in one step."""
    if not given.held:
        moved: AnyMatrix = work.step(EULER_F, sbar=state, dt=exact(needed(given.step)), fbar=rates)
        return moved
    undiscretised = given.model_copy(update={"step": None, "discretisation": "euler"})
    return hold(given, next(linearised(undiscretised, Work()))).point(work, state, rates)


@kept
def rightly(given: System) -> list[AnyMatrix]:
    """The right matrices, with which those of both mistakes are compared."""
    return list(linearised(given, Work()))


@kept
def _at_zero(given: System) -> list[AnyMatrix]:
    """The derivatives where every state and every action is zero."""
    zero = {field: dict.fromkeys(getattr(given, field), Angle(Fraction(0))) for field in ("state", "action")}
    return list(linearised(given.model_copy(update=zero), Work()))


@kept
def _exchanged(given: System) -> list[AnyMatrix]:
    """Sines for cosines in all derivatives, and the other way round."""
    return list(linearised(given, Work(), rule=lambda *of: dynamics.exchanged(dynamics.chained(*of))))


@kept
def _without_halves(given: System) -> list[AnyMatrix]:
    """Roots differentiated without the factor 1/2."""

    def rule(text: str, by: str, parts: tuple[str, ...]) -> Expr:
        return dynamics.whole_roots(dynamics.chained(text, by, parts), by)

    return list(linearised(given, Work(), rule=rule))


@kept
def _without_squares(given: System) -> list[AnyMatrix]:
    """Tangents differentiated to 1/cos."""
    return list(linearised(given, Work(), rule=lambda *of: dynamics.plain_cosines(dynamics.chained(*of))))


def _holds(given: System, function: str) -> bool:
    """Whether the dynamics hold a function."""
    return any(f"{function}(" in text for text in (*given.dynamics.values(), *given.where.values()))


def slips(solve: Callable[[Any, Work, Linearised], None]) -> tuple[Misconception, ...]:
    """What goes wrong in differentiating, made in a solver."""
    return (
        slip(
            "derivative-at-zero",
            "The derivatives are taken at the operating point (s̄, ā), not at zero: put its values in.",
            when=lambda given: _changes(given, _at_zero),
        )(lambda given, work: solve(given, work, _in_order(_at_zero))),
        slip(
            "sine-for-cosine",
            "The derivative of the sine is the cosine, and that of the cosine is minus the sine: they were exchanged.",
            when=lambda given: _changes(given, _exchanged),
        )(lambda given, work: solve(given, work, _in_order(_exchanged))),
        slip(
            "half-of-the-root-forgotten",
            "The derivative of √x is 1/(2√x), with its factor 1/2.",
            when=lambda given: _holds(given, "sqrt") and _changes(given, _without_halves),
        )(lambda given, work: solve(given, work, _in_order(_without_halves))).where_it_shows(),
        slip(
            "tangent-without-square",
            "The derivative of tan φ is 1/cos² φ = 1 + tan² φ: the cosine is squared.",
            when=lambda given: _holds(given, "tan") and _changes(given, _without_squares),
        )(lambda given, work: solve(given, work, _in_order(_without_squares))).where_it_shows(),
    )


def _in_order(mistaken: Callable[[System], list[AnyMatrix]]) -> Linearised:
    """Matrices that were made with a mistake, in the order in which they are wanted."""
    return lambda given, _, order: (mistaken(given)["AB".index(which)] for which in order)


def _changes(given: System, mistaken: Callable[[System], list[AnyMatrix]]) -> bool:
    """Whether a mistake can be made at this operating point, and leads to other derivatives."""
    try:
        return rightly(given) != mistaken(given)
    except (NoSolution, ZeroDivisionError):
        return False


@dynamics.at_operating_point()
def _point(work: Work, given: System) -> dict[str, Value]:
    """The values of all letters at the operating point, named parts included."""
    known = dynamics.known(given)
    for name, text in given.where.items():
        known[dynamics.code(name)] = work.step(PART_VALUE, into=part_value, right=_right(text), i=name, **known)
    return known


def _right(text: str) -> Expr:
    """What a text says, in its own order."""
    (expression,) = dynamics.expressions((("", text),), evaluate=False)
    return expression


@dynamics.at_operating_point()
def rates(work: Work, given: System) -> AnyMatrix:
    """f at the operating point, a column."""
    known = dynamics.known(given)
    for name, text in given.where.items():
        known[dynamics.code(name)] = value_of(_right(text), known)
    several = len(given.dynamics) > 1
    return matrices.column(
        work.step(PART_VALUE, into=f_value if several else f_alone, right=_right(text), i=index, **known)
        for index, text in enumerate(given.dynamics.values(), 1)
    )


@dynamics.at_operating_point()
def _jacobian(work: Work, given: System, formula: Formula, known: dict[str, Value], rule: Rule) -> AnyMatrix:
    """The derivatives of the dynamics by the state or by the action; those that are zero are not written down."""
    by = given.states if formula is STATE_JACOBIAN else tuple(given.action)
    if to_know := [*_to_know(given, by)]:
        work.say(f"The derivative of {', that of '.join(to_know)}.")
    columns = [_column(work, given, formula, name, known, rule) for name in by]
    if any(entry is None for column in columns for entry in column):
        work.say("The other derivatives are zero.")
    return matrices.matrix(zip(*(map(written_or_zero, column) for column in columns), strict=True))


#: The derivatives that are not seen at a glance: a function, how it is written, and its derivative.
_TO_KNOW = (("sqrt", "√({})", "1/(2√({}))"), ("tan", "tan({})", "1/cos^2({})"))


def _to_know(given: System, by: Sequence[str]) -> Iterator[str]:
    """The functions of these letters whose derivatives are not seen at a glance, with their derivatives."""
    rates = " ".join(given.dynamics.values())
    for function, worth, derivative in _TO_KNOW:
        for name in dict.fromkeys(re.findall(rf"{function}\((\w+)\)", rates)):
            if name in by:
                yield f"${worth.format(name)}$ is ${derivative.format(name)}$"


def written_or_zero(derivative: Value | None) -> Value:
    """A derivative; one that is not written down, since nothing depends on the letter, is zero."""
    return ZERO if derivative is None else derivative


def _column(
    work: Work, given: System, formula: Formula, by: str, known: dict[str, Any], rule: Rule
) -> list[Value | None]:
    """The derivatives of all components by one letter; those of named parts first, as far as they play a part."""
    needed = _needed(work, given, by, known, rule)
    known = {**known, "j": by}
    constant = []
    for part in needed:
        right = rule(given.where[part], by, _within(given.where[part], needed))
        value = work.step(formula, into=partial_part, right=right, i=part, **known)
        known[dynamics.part_derivative(part, by).name] = value
        if value == 0:
            constant.append(f"${part}$")
    if constant:
        work.say(f"So {joined(constant)} {'count as constants' if len(constant) > 1 else 'counts as a constant'} here.")
    moving = tuple(part for part in needed if known[dynamics.part_derivative(part, by).name] != 0)

    def derivative(text: str, index: int) -> Value | None:
        right = rule(text, by, _within(text, moving))
        if right == 0:
            return None
        if len(given.dynamics) == 1:
            return work.step(formula, into=partial_part, right=right, i="f", **known)
        return work.step(formula, into=partial, right=right, i=index, **known)

    return [derivative(text, index) for index, text in enumerate(given.dynamics.values(), 1)]


def _within(text: str, parts: Iterable[str]) -> tuple[str, ...]:
    inside = letters(text)
    return tuple(part for part in parts if part in inside)


def _needed(work: Work, given: System, by: str, known: Mapping[str, Any], rule: Rule) -> tuple[str, ...]:
    """The named parts whose derivative by a letter is multiplied by something that is not 0, in their order."""
    rights: dict[str, Expr] = {}
    for part, text in given.where.items():  # what depends on the letter, itself or through parts before it
        right = rule(text, by, _within(text, rights))
        if right != 0:
            rights[part] = right
    components = [rule(text, by, _within(text, rights)) for text in given.dynamics.values()]
    names = {part: dynamics.part_derivative(part, by).name for part in rights}
    without = {**known, **dict.fromkeys(names.values(), ZERO)}
    needed: list[str] = []
    for part in reversed(rights):
        with_part = {**without, names[part]: ZERO + 1}
        if any(
            not is_zero(value_of(right, with_part) - value_of(right, without))
            for right in (*components, *(rights[later] for later in needed))
        ):
            needed.append(part)
    if idle := [part for part in rights if part not in needed]:
        for part in idle:  # 0 times what does not exist is not 0
            value_of(rights[part], without)
        rest = [f"${part} = 0$" for part in given.where if known[dynamics.code(part)] == 0]
        rest = rest or [
            f"$f_{{{index}}} = 0$"
            for index, text in enumerate(given.dynamics.values(), 1)
            if _within(text, idle) and is_zero(value_of(_right(text), known))
        ]
        since = f", since {joined(rest)}" if rest else ""
        work.say(
            f"What multiplies {joined([f'$∂{part}/∂{by}$' for part in idle])} is $0$ at the operating point{since}: "
            f"the derivatives there are those with {joined([f'${part}$' for part in idle])} held fixed."
        )
    return tuple(part for part in rights if part in needed)


def _euler(work: Work, given: System, formula: Formula, value: AnyMatrix) -> AnyMatrix:
    """The matrix of the Euler step, if the system has one."""
    if given.step is None:
        work.lines.append(Equality(Ai if formula is EULER_A else Bi, (value,)))
        return value
    letters = {"dt": exact(given.step), "Ai": value, "Bi": value, "unit": matrices.identity(len(given.state))}
    return work.step(formula, **letters)


def after(given: System) -> Callable[[Mapping[str, complex]], list[complex]]:
    """The dynamics, or their Euler step, in floating point: for the independent solvers."""
    of, where = dynamics.texts(given.dynamics), dynamics.texts(given.where)
    step = None if given.step is None else float(given.step)

    def function(values: Mapping[str, complex]) -> list[complex]:
        rates = dynamics.numeric(of, where, values)
        if step is None:
            return rates
        return [values[name] + step * rate for name, rate in zip(given.states, rates, strict=True)]

    return function


def held_numerically(given: System) -> tuple[Array, Array, Array]:
    """A and B of a zero-order hold, and where the operating point goes in it, for the independent solvers."""
    values, n = dynamics.numbers(given), len(given.state)
    rates = after(given.model_copy(update={"step": None}))
    A, B = (np.real(dynamics.complex_step(rates, values, by)) for by in (given.states, tuple(given.action)))
    f = np.real(rates(values))[:, None]
    larger = np.zeros((n + B.shape[1] + 1,) * 2)
    larger[:n] = np.hstack([A, B, f])
    # Squaring a step that is 2²⁰ times shorter, for which three terms of the series are enough.
    short = larger * float(needed(given.step)) / 2**20
    power = short + short @ short / 2 + short @ short @ short / 6
    for _ in range(20):
        power = 2 * power + power @ power
    A_held, B_held, moved = np.split((np.eye(len(larger)) + power)[:n], [n, n + B.shape[1]], axis=1)
    return A_held, B_held, np.real([values[name] for name in given.states]) + moved[:, 0]
