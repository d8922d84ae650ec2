"""Sarsa(λ): the traces along the run, which depend on the visits alone; then the updates of all pairs."""

from collections.abc import Callable

import numpy as np

from rldrill.problems.control.sarsa_lambda import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, Value, exact
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.control import (
    ACTION_TRACE,
    SARSA_LAMBDA,
    SARSA_TD_ERROR,
    TRACE_WITHOUT_GAMMA,
    TRACE_WITHOUT_LAMBDA,
)
from rldrill.solutions.work import Work

Pair = tuple[str, str]
Traces = dict[Pair, Value]


def solve(given: Given, work: Work) -> None:
    """All traces first; then for every transition the TD error, and every pair that has a trace."""
    _move(given, work, _traces(given, work))


def _visits(given: Given) -> list[Pair]:
    return list(zip(given.trajectory.states[:-1], given.trajectory.actions, strict=False))


def _before(given: Given) -> Traces:
    return {
        (state, action): exact(trace) for state, row in (given.traces or {}).items() for action, trace in row.items()
    }


def _traces(given: Given, work: Work, left: Callable[[Traces, int], Traces] = lambda trace, _: trace) -> list[Traces]:
    """The traces after every visit, the last of them as answered; those that are 0 and stay so are not written down.

    All that is ``left`` of the traces decays: everything, unless a slip says otherwise.
    """
    known = knowns.action_run(given) | {"lam": exact(given.lam)}
    trace = dict.fromkeys(given.eligible, ZERO) | _before(given)
    found = []
    for time, visited in enumerate(_visits(given)):
        trace = left(trace, time)
        work.say(f"Traces after the visit to {visited[0]} at $t = {time}$:")
        trace = trace | {
            pair: work.step(ACTION_TRACE, s=pair[0], a=pair[1], t=time, e=trace, **known)
            for pair in given.eligible
            if pair == visited or trace[pair] != 0
        }
        found.append(trace)
    return [*found[:-1], trace | work.answer({pair: trace[pair] for pair in given.eligible})]


def _move(given: Given, work: Work, traces: list[Traces]) -> None:
    """Every transition moves the values of all pairs by their traces after it."""
    known = knowns.action_run(given)
    for time, trace in enumerate(traces):
        error = work.step(SARSA_TD_ERROR, t=time, **known)
        old = known["Q"]
        known["Q"] = old | {
            pair: work.step(SARSA_LAMBDA, s=pair[0], a=pair[1], t=time, alpha=known["alpha"], Q=old, e=trace,
                            delta={time: error})
            for pair in given.eligible
            if trace[pair] != 0
        }  # fmt: skip
    work.answer({pair: known["Q"][pair] for pair in given.eligible})


def _explores(given: Given, time: int) -> bool:
    """Whether a state is first visited at this time, so with its values untouched, and left by another than the best
    action, while other pairs have traces.
    """
    run = given.trajectory
    state = run.states[time]
    row = given.values[state]
    traced = time > 0 or given.traces is not None
    return traced and state not in run.states[:time] and row[run.actions[time]] < max(row.values())


def _comes_back(given: Given) -> bool:
    """Whether a pair is visited that has a trace."""
    visits = _visits(given)
    traced = [pair for pair, trace in _before(given).items() if trace != 0]
    return len({*visits, *traced}) < len(visits) + len(traced)


@slip(
    "traces-cut",
    "Sarsa(λ) keeps its traces when an exploratory action is taken; it is Watkins's Q(λ) that cuts them there.",
    when=lambda given: any(_explores(given, time) for time in range(len(given.trajectory.rewards))),
)
def traces_cut(given: Given, work: Work) -> None:
    """No traces are left where an exploratory action is taken."""

    def left(trace: Traces, time: int) -> Traces:
        return dict.fromkeys(trace, ZERO) if _explores(given, time) else trace

    _move(given, work, _traces(given, work, left))


@slip(
    "replacing-traces",
    "Accumulating traces add 1 to what is left of the trace; replacing traces would set it to 1.",
    when=_comes_back,
)
def replacing(given: Given, work: Work) -> None:
    """Nothing is left of the trace of the pair that is visited."""
    visits = _visits(given)
    _move(given, work, _traces(given, work, lambda trace, time: trace | {visits[time]: ZERO}))


@slip(
    "only-the-visited-pair",
    "Every pair with a trace is moved by the TD error, not only the pair that was just left.",
    when=lambda given: len(given.eligible) > 1,
)
def only_visited(given: Given, work: Work) -> None:
    """All traces are right, but only the pair just left is moved by its trace."""
    traces = _traces(given, work)
    own = [{visited: trace[visited]} for visited, trace in zip(_visits(given), traces, strict=True)]
    _move(given, work, [dict.fromkeys(given.eligible, ZERO) | trace for trace in own])


MISCONCEPTIONS = (traces_cut, only_visited, replacing, TRACE_WITHOUT_LAMBDA, TRACE_WITHOUT_GAMMA)


def oracle(given: Given) -> Answers:
    """Traces as sums of powers over past visits; values as vectors, all pairs at once."""
    run = given.trajectory
    pairs = [(state, action) for state, row in given.values.items() for action in row]
    Q = np.array([at(given.values[state][action]) for state, action in pairs])
    before = np.array([at((given.traces or {}).get(state, {}).get(action, 0)) for state, action in pairs])
    visits = [pairs.index(pair) for pair in zip(run.states, run.actions, strict=False)]
    decay = at(given.gamma) * at(given.lam)
    for time, reward in enumerate(run.rewards):
        powers = decay ** np.arange(time, -1, -1)
        e = before * decay ** (time + 1) + np.bincount(visits[: time + 1], powers, len(pairs))
        ahead = 0.0 if run.states[time + 1] in run.terminal else Q[visits[time + 1]]
        Q = Q + at(given.alpha) * (at(reward) + at(given.gamma) * ahead - Q[visits[time]]) * e
    asked = [pairs.index(pair) for pair in given.eligible]
    return (e[asked], Q[asked])
