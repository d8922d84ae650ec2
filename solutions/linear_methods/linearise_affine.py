"""A, B and f at the operating point, then what is left over, then the matrices with one more dimension."""

from rldrill.problems.linear_methods.linearise_affine import Given
from rldrill.solutions import dynamics, matrices
from rldrill.solutions.formula.formula import Formula, slip
from rldrill.solutions.linearisation import (
    Linearised,
    after,
    answered,
    chosen,
    held_numerically,
    linearised,
    moved_point,
    rates,
    rightly,
    slips,
)
from rldrill.solutions.matrices import AnyMatrix
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers
from rldrill.solutions.sheet.linear_methods import (
    C_IS_F,
    FORGOT_IDENTITY,
    affine_step,
)
from rldrill.solutions.work import Work


def solve(given: Given, work: Work, differentiated: Linearised = linearised) -> None:
    """Everything is taken at the operating point."""
    A, B = (
        answered(work, given.entries, which, found) if given.entries is not None else found
        for which, found in zip("AB", differentiated(given, work, "AB"), strict=True)
    )
    s_bar = matrices.column(dynamics.angle(given.state[name]) for name in given.states)
    a_bar = matrices.column(dynamics.angle(value) for value in given.action.values())
    f_bar = moved_point(given, work, s_bar, rates(work, given))
    if given.moved:
        f_bar = work.answer(f_bar)
    work.recall(affine_step().linear)
    work.say("The terms without $s$ and $a$ make up $C$:")
    _augmented(given, work, A, B, work.step(affine_step().constant, Fbar=f_bar, Ad=A, Bd=B, sbar=s_bar, abar=a_bar))


def _augmented(given: Given, work: Work, A: AnyMatrix, B: AnyMatrix, C: AnyMatrix) -> None:
    C = work.answer(C)
    larger = _put_together(work, affine_step().state, Ad=A, Cc=C)
    if given.entries is None:
        work.answer(larger)
        work.answer(_put_together(work, affine_step().action, Bd=B))
    else:
        work.answer(matrices.column(line[-1] for line in larger.tolist()))


def _put_together(work: Work, formula: Formula, **blocks: AnyMatrix) -> AnyMatrix:
    """A matrix of blocks: nothing is worked out, only copied."""
    work.recall(formula)
    whole: AnyMatrix = work.value(formula, **blocks)
    work.give(formula, whole)
    return whole


@slip(
    "c-is-the-rates",
    "Those are the rates at the operating point; C belongs to the step F, less what s̄ and ā contribute.",
)
def rates_for_c(given: Given, work: Work) -> None:
    """The rates in the place of C."""
    A, B = rightly(given)
    if given.entries is not None:
        A, B = (answered(work, given.entries, which, found) for which, found in zip("AB", (A, B), strict=True))
    found = rates(work, given)
    if given.moved:
        s_bar = matrices.column(dynamics.angle(given.state[name]) for name in given.states)
        work.answer(moved_point(given, work, s_bar, found))
    _augmented(given, work, A, B, found)


MISCONCEPTIONS = (C_IS_F, rates_for_c, *slips(solve), FORGOT_IDENTITY)


def oracle(given: Given) -> Answers:
    """Complex steps for both matrices; C is where the tangent plane stands at zero."""
    values = dynamics.numbers(given)
    step = after(given)
    if given.held:
        A, B, moved = held_numerically(given)
    else:
        A, B = (dynamics.complex_step(step, values, by) for by in (given.states, tuple(given.action)))
        moved = np.real(step(values))
    n, m = B.shape
    operating = np.real([values[name] for name in (*given.states, *given.action)])
    C = moved - np.hstack([A, B]) @ operating
    constant = [moved, C] if given.moved else [C]
    if given.entries is not None:
        return [*chosen(given.entries, A, B), *constant, np.append(C, 1.0)]
    return [*constant, np.vstack([np.column_stack([A, C]), np.eye(n + 1)[-1]]), np.vstack([B, np.zeros((1, m))])]
