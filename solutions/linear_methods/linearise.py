"""Every derivative in letters, then at the operating point; sines and cosines stay exact."""

from rldrill.problems.linear_methods.linearise import Given
from rldrill.solutions import dynamics
from rldrill.solutions.exact import exact
from rldrill.solutions.linearisation import Linearised, after, answered, chosen, held_numerically, linearised, slips
from rldrill.solutions.matrices import column
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.linear_methods import FORGOT_IDENTITY, deviation
from rldrill.solutions.work import Work


def solve(given: Given, work: Work, matrices: Linearised = linearised) -> None:
    """A, then B; then what a deviation leads to, and for it alone A, if no entry of A is asked for."""
    only_B = given.entries is not None and not given.entries.A and not given.held
    order = "BA" if only_B else "AB"
    found = zip(order, matrices(given, work, order), strict=True)
    answers = {which: answered(work, given.entries, which, matrix) for which, matrix in found}
    A, B = answers["A"], answers["B"]
    if given.deviation is not None:
        n = len(given.state)
        ds, da = (column(map(exact, numbers)) for numbers in (given.deviation[:n], given.deviation[n:]))
        change = work.step(deviation(discretised=given.step is not None), Ad=A, Bd=B, Ai=A, Bi=B, ds=ds, da=da)
        work.answer(tuple(change.entries()))


MISCONCEPTIONS = (*slips(solve), FORGOT_IDENTITY)


def oracle(given: Given) -> Answers:
    """Complex steps through the dynamics, or through their Euler step."""
    if given.held:
        A, B, _ = held_numerically(given)
    else:
        values, step = dynamics.numbers(given), after(given)
        A, B = (np.real(dynamics.complex_step(step, values, by)) for by in (given.states, tuple(given.action)))
    answers = chosen(given.entries, A, B)
    if given.deviation is not None:
        answers.append(np.hstack([A, B]) @ [at(number) for number in given.deviation])
    return answers
