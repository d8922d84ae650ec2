"""TD(λ) in the backward view: after every transition all traces, then all values."""

import numpy as np

from rldrill.problems.temporal_difference.td_lambda_backward import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, exact
from rldrill.solutions.formula.formula import fork
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.temporal_difference import ELIGIBILITY_TRACE, LITERAL_VALUE, TD_LAMBDA_BACKWARD
from rldrill.solutions.work import Work

VISITED_ONLY = fork(
    "only-visited-state-updated",
    "Every state with a trace learns from the TD error, not only the one that was just left.",
    when=lambda given: len(given.visited) > 1,
)
TRACE_LATE = fork(
    "trace-updated-after-value",
    "The traces are updated before the values: the state that was just left must be counted in its own trace.",
)
MISCONCEPTIONS = (LITERAL_VALUE, VISITED_ONLY, TRACE_LATE)


def solve(given: Given, work: Work) -> None:
    """For every transition the traces and values of all states visited by then; the others have trace 0."""
    run = given.trajectory
    known = knowns.trajectory(run) | {name: exact(getattr(given, name)) for name in ("alpha", "gamma", "lam")}
    values = knowns.state_values(given.values, run.terminal)
    traces = dict.fromkeys(given.visited, ZERO)
    for time, state in enumerate(run.states[:-1]):
        work.say(f"Transition from $t = {time}$ to ${time + 1}$:")
        reached = tuple(dict.fromkeys(run.states[: time + 1]))
        before = traces
        traces = traces | {s: work.step(ELIGIBILITY_TRACE, s=s, t=time, e=before, **known) for s in reached}
        used = before if work.makes(TRACE_LATE) else traces
        updated = (state,) if work.makes(VISITED_ONLY) else reached
        values = values | {s: work.step(TD_LAMBDA_BACKWARD, s=s, t=time, V=values, e=used, **known) for s in updated}
    work.answer({state: values[state] for state in given.visited})


def oracle(given: Given) -> Answers:
    """On arrays; the traces at every time anew, from all visits until then."""
    run, states = given.trajectory, given.visited
    V = {state: at(value) for state, value in given.values.items()} | dict.fromkeys(run.terminal, 0.0)
    decay = at(given.gamma) * at(given.lam)
    visits = np.array([[state == visited for visited in run.states[:-1]] for state in states], dtype=float)
    for time, reward in enumerate(run.rewards):
        error = at(reward) + at(given.gamma) * V[run.states[time + 1]] - V[run.states[time]]
        change = at(given.alpha) * error * (visits[:, : time + 1] @ decay ** np.arange(time, -1, -1))
        V |= {state: V[state] + step for state, step in zip(states, change, strict=True)}
    return ([V[state] for state in states],)
