"""Eligibility traces along a run: every trace at every time."""

from collections.abc import Callable, Sequence

from rldrill.problems.exact import Parameter, Scalar, needed, shown
from rldrill.problems.fractions import Fraction
from rldrill.problems.temporal_difference.eligibility_trace import Given
from rldrill.solutions.exact import ZERO, Value, exact, to_sympy, value_at
from rldrill.solutions.formula.nodes.leaves import put_in_name
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.reversible import find, reading, tried, with_letter
from rldrill.solutions.sheet.temporal_difference import (
    ACCUMULATING,
    DECAY_WITHOUT_GAMMA,
    DECAY_WITHOUT_LAMBDA,
    ELIGIBILITY_TRACE,
    INCREMENT_FIRST,
    REPLACING,
    REPLACING_TRACE,
    e,
)
from rldrill.solutions.work import Result, Work

MISCONCEPTIONS = (DECAY_WITHOUT_GAMMA, DECAY_WITHOUT_LAMBDA, REPLACING, INCREMENT_FIRST, ACCUMULATING)


def solve(given: Given, work: Work) -> None:
    """Step by step; where a trace is known, first what was left open, then the traces with it."""
    read: Callable[[Scalar], Value] = exact
    asked: Sequence[int] = given.asked
    traces, start = dict.fromkeys(given.visited, ZERO), 0
    if given.known is not None:
        first, *asked = given.asked
        found = _traces(given, work, exact, range(first + 1), {})
        letter = find(given, work, found[given.states[0]], f'e("{given.states[0]}")')
        read, start = reading(letter), first + 1
        traces |= {state: value_at(value, letter) for state, value in found.items()}
        work.say(f"With ${shown(Parameter(given.letter))} = {to_sympy(letter)}$, after the update at $t = {first}$:")
        work.lines.append(Result(tuple(e(put_in_name(state)) for state in found), tuple(traces[s] for s in found)))
        known = {given.states[0]: exact(needed(given.known))}
        traces = work.either(traces, lambda: traces | known)
    for time in asked:
        traces = work.answer(_traces(given, work, read, range(start, time + 1), traces))
        start = time + 1


def _traces(
    given: Given, work: Work, read: Callable[[Scalar], Value], times: range, traces: dict[str, Value]
) -> dict[str, Value]:
    """One step for every time and every state that was visited by then; the other traces are still 0."""
    formula = REPLACING_TRACE if given.replacing else ELIGIBILITY_TRACE
    known = {"S": dict(enumerate(given.states)), "gamma": read(given.gamma), "lam": read(given.lam)}
    if times.start == 0:
        work.say("The trace of a state that was not visited yet is $0$; its lines are left out.")
    for time in times:
        reached = dict.fromkeys(given.states[: time + 1], ZERO)
        before = reached | traces
        traces = before | {s: work.step(formula, s=s, t=time, e=before, **known) for s in reached}
    return traces


def oracle(given: Given) -> Answers:
    """Every visit on its own: what is left of its 1 after as many steps, summed; or of the last visit alone."""
    if given.known is not None:
        letter = tried(given, lambda trial: float(oracle(trial)[0][0]))
        return (letter, *oracle(with_letter(given, Fraction(letter).limit_denominator(10**6)))[1:])
    decay = at(given.gamma) * at(given.lam)
    answers = []
    for time in given.asked:
        left = decay ** np.arange(time, -1, -1)
        visits = np.array([[state == visited for visited in given.states[: time + 1]] for state in given.visited])
        answers.append((visits * left).max(axis=1) if given.replacing else visits @ left)
    return answers
