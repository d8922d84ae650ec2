"""Linearising the dynamics of a problem: derivatives in letters, then exact values at the operating point."""

from collections.abc import Callable, Mapping
from typing import Any

from sympy import Expr

from rldrill.problems.expressions import letters
from rldrill.problems.robots import System
from rldrill.solutions import dynamics, matrices
from rldrill.solutions.exact import ZERO, NoSolution, Value, exact, is_zero
from rldrill.solutions.formula.compiling import value_of
from rldrill.solutions.formula.formula import Formula, Misconception, slip
from rldrill.solutions.matrices import AnyMatrix
from rldrill.solutions.sheet.linear_methods import (
    INPUT_JACOBIAN,
    PART_VALUE,
    STATE_JACOBIAN,
    f_value,
    part_value,
    partial,
    partial_part,
)
from rldrill.solutions.work import Work


def _changes(given: System, mistake: Misconception) -> bool:
    """Whether a mistake can be made at this operating point, and leads to other derivatives."""
    try:
        return _derivatives(given, Work()) != _derivatives(given, Work(mistake))
    except (NoSolution, ZeroDivisionError):
        return False


def _derivatives(given: System, work: Work) -> tuple[AnyMatrix, AnyMatrix]:
    known = point(work, given)
    return jacobian(work, given, STATE_JACOBIAN, known), jacobian(work, given, INPUT_JACOBIAN, known)


AT_ZERO: Misconception = slip(
    "derivative-at-zero",
    "The derivatives are taken at the operating point (s̄, ā), not at zero: put its values in.",
    when=lambda given: _changes(given, AT_ZERO),
)
SINE_FOR_COSINE: Misconception = slip(
    "sine-for-cosine",
    "The derivative of the sine is the cosine, and that of the cosine is minus the sine: they were exchanged.",
    when=lambda given: _changes(given, SINE_FOR_COSINE),
)


@dynamics.at_operating_point()
def point(work: Work, given: System) -> dict[str, Value]:
    """The values of all letters at the operating point, named parts included."""
    known = dynamics.known(given)
    if work.makes(AT_ZERO):
        known |= dict.fromkeys(map(dynamics.code, (*given.state, *given.action)), ZERO)
    for name, text in given.where.items():
        known[dynamics.code(name)] = work.step(PART_VALUE, into=part_value, right=_right(text), i=name, **known)
    return known


def _right(text: str) -> Expr:
    (expression,) = dynamics.expressions((("", text),))
    return dynamics.readable(expression)


@dynamics.at_operating_point()
def rates(work: Work, given: System) -> AnyMatrix:
    """f at the operating point, a column."""
    known = dynamics.known(given)
    for name, text in given.where.items():
        known[dynamics.code(name)] = value_of(_right(text), known)
    return matrices.column(
        work.step(PART_VALUE, into=f_value, right=_right(text), i=index, **known)
        for index, text in enumerate(given.dynamics.values(), 1)
    )


@dynamics.at_operating_point()
def jacobian(work: Work, given: System, formula: Formula, known: dict[str, Value]) -> AnyMatrix:
    """The derivatives of the dynamics by the state or by the action; those that are zero are not written down."""
    by = given.states if formula is STATE_JACOBIAN else tuple(given.action)
    columns = [_column(work, given, formula, name, known) for name in by]
    if any(entry == 0 for column in columns for entry in column):
        work.say("The other derivatives are zero.")
    return matrices.matrix(zip(*columns, strict=True))


def _column(work: Work, given: System, formula: Formula, by: str, known: dict[str, Any]) -> list[Value]:
    """The derivatives of all components by one letter; those of named parts first."""
    moving: list[str] = []
    known = {**known, "j": by}

    def derivative(text: str, index: int | str) -> Value:
        within = letters(text)
        right = dynamics.chained(text, by, tuple(part for part in moving if part in within))
        if work.makes(SINE_FOR_COSINE):
            right = dynamics.exchanged(right)
        if right == 0:
            return ZERO
        if isinstance(index, str) and is_zero(value_of(right, known)):
            work.say(f"The derivative of ${index}$ by ${by}$ is $0$ here.")
            return ZERO
        into = partial if isinstance(index, int) else partial_part
        return work.step(formula, into=into, right=right, i=index, **known)

    for part, text in given.where.items():
        value = derivative(text, part)
        if value != 0:
            moving.append(part)
            known[dynamics.part_derivative(part, by).name] = value
    return [derivative(text, index) for index, text in enumerate(given.dynamics.values(), 1)]


def euler(work: Work, given: System, formula: Formula, value: AnyMatrix) -> AnyMatrix:
    """The matrix of the Euler step, if the system has one."""
    if given.step is None:
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
