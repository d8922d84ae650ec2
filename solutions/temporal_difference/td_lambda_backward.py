"""TD(λ) in the backward view: after every transition all traces, then all values."""

from collections.abc import Callable

from rldrill.problems.temporal_difference.td_lambda_backward import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, Value, exact
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.reversible import find_and_finish, found_and_finished
from rldrill.solutions.sheet.bellman import FORGOT_GAMMA
from rldrill.solutions.sheet.policy_gradient import TD_ERROR
from rldrill.solutions.sheet.temporal_difference import (
    ACCUMULATING,
    DECAY_WITHOUT_GAMMA,
    DECAY_WITHOUT_LAMBDA,
    ELIGIBILITY_TRACE,
    LITERAL_VALUE,
    REPLACING_TRACE,
    TD_LAMBDA_BACKWARD,
    TD_LAMBDA_BY_ERROR,
)
from rldrill.solutions.work import Work

Traces = dict[str, Value]
Values = dict[str, Value]


def solve(given: Given, work: Work) -> None:
    """For every transition the traces and values of all states visited by then; the others have trace 0."""
    _learn(given, work, lambda _state, _before, after: after)


def _lambda_given(given: Given) -> bool:
    """Whether λ is not what is asked for: with these mistakes the first value says nothing of it."""
    return given.known is None or given.letter != "lambda"


@slip(
    "only-visited-state-updated",
    "Every state with a trace learns from the TD error, not only the one that was just left.",
    when=lambda given: len(given.visited) > 1 and _lambda_given(given),
)
def visited_only(given: Given, work: Work) -> None:
    """The value of the state just left alone, by its trace."""
    _learn(given, work, lambda state, _before, after: {state: after[state]})


@slip(
    "trace-updated-after-value",
    "The traces are updated before the values: the state that was just left must be counted in its own trace.",
    when=_lambda_given,
)
def trace_late(given: Given, work: Work) -> None:
    """The values by the traces from before the transition."""
    _learn(given, work, lambda _state, before, _after: before)


@slip(
    "errors-from-the-start",
    "Each TD error reads the values as the earlier transitions have left them, not those from before the run.",
    when=lambda given: len(given.trajectory.rewards) > 1,
)
def errors_stale(given: Given, work: Work) -> None:
    """All TD errors by the values from before the run."""
    _learn(given, work, lambda _state, _before, after: after, lambda start, _values: start)


MISCONCEPTIONS = (
    LITERAL_VALUE,
    visited_only,
    trace_late,
    ACCUMULATING,
    errors_stale.where_it_shows(),
    FORGOT_GAMMA.where_it_shows(),
    DECAY_WITHOUT_GAMMA.where_it_shows(),
    DECAY_WITHOUT_LAMBDA.where_it_shows(),
)


def _learn(
    given: Given,
    work: Work,
    moving: Callable[[str, Traces, Traces], Traces],
    seen: Callable[[Values, Values], Values] = lambda _start, values: values,
) -> None:
    """Every transition moves the values by the traces that ``moving`` makes of those before it and after it.

    The TD errors read what ``seen`` makes of the values before the run and those of their time.
    """
    run = given.trajectory
    known = knowns.trajectory(run) | {name: exact(getattr(given, name)) for name in ("alpha", "gamma", "lam")}
    values = {state: exact(value) for state, value in given.values.items()} | dict.fromkeys(run.terminal, ZERO)
    start, traces = values, Traces()
    formula = REPLACING_TRACE if given.replacing else ELIGIBILITY_TRACE
    work.recall(TD_LAMBDA_BACKWARD)
    if len(given.visited) > 1:
        work.say("The trace of a state that was not visited yet is $0$; its lines are left out.")
    for time, state in enumerate(run.states[:-1]):
        work.say(f"The transition from {state} to {run.states[time + 1]}:")
        before = traces | {state: traces.get(state, ZERO)}
        traces = {s: work.step(formula, s=s, t=time, e=before, **known) for s in before}
        e = moving(state, before, traces)
        known["delta"] = {time: work.step(TD_ERROR, t=time, V=seen(start, values), **known)}
        values = values | {s: work.step(TD_LAMBDA_BY_ERROR, s=s, t=time, V=values, e=e, **known) for s in e}
    learned = {state: values[state] for state in given.visited}
    if given.known is None:
        work.answer(learned)
    else:
        find_and_finish(given, work, learned)


def oracle(given: Given) -> Answers:
    """On arrays; the traces of every time from all visits until then."""
    if given.known is not None:
        return found_and_finished(given, lambda trial: oracle(trial)[0])
    run, states = given.trajectory, given.visited
    V = {state: at(value) for state, value in given.values.items()} | dict.fromkeys(run.terminal, 0.0)
    decay = at(given.gamma) * at(given.lam)
    visits = np.array([[state == visited for visited in run.states[:-1]] for state in states], dtype=float)
    for time, reward in enumerate(run.rewards):
        error = at(reward) + at(given.gamma) * V[run.states[time + 1]] - V[run.states[time]]
        left = visits[:, : time + 1] * decay ** np.arange(time, -1, -1)
        change = at(given.alpha) * error * (left.max(axis=1) if given.replacing else left.sum(axis=1))
        V |= {state: V[state] + step for state, step in zip(states, change, strict=True)}
    return ([V[state] for state in states],)
