"""Sarsa(λ): the traces along the run, which depend on the visits alone; then the updates of all pairs.

Watkins's Q(λ) goes step by step, since its traces depend on the values.
"""

from collections.abc import Callable, Mapping
from typing import Any

from rldrill.problems.control.sarsa_lambda import Given
from rldrill.solutions import knowns
from rldrill.solutions.asking_back import answer_along, oracle_along
from rldrill.solutions.exact import ZERO, Value, exact, largest
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.control import (
    ACCUMULATING_ACTION_TRACE,
    ACTION_TRACE,
    NOT_DISCOUNTED,
    Q_LEARNING_TD_ERROR,
    REPLACING_ACTION_TRACE,
    SARSA_LAMBDA,
    SARSA_TD_ERROR,
    TAKEN_FOR_MAX,
    TRACE_WITHOUT_GAMMA,
    TRACE_WITHOUT_LAMBDA,
)
from rldrill.solutions.work import Work

Pair = tuple[str, str]
Traces = dict[Pair, Value]


def solve(given: Given, work: Work) -> None:
    """All traces first; then for every transition the TD error, and every pair that has a trace."""
    if given.watkins:
        _watkins(given, work, _cut)
    else:
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
        trace = _visited(given, work, known, left(trace, time), time, visited)
        found.append(trace)
    if given.outcome:
        return found
    return [*found[:-1], trace | work.answer({pair: trace[pair] for pair in given.eligible})]


def _visited(given: Given, work: Work, known: Mapping[str, Any], trace: Traces, time: int, visited: Pair) -> Traces:
    """The traces after a visit."""
    work.say(f"Traces after the visit to {visited[0]} at $t = {time}$:")
    formula = REPLACING_ACTION_TRACE if given.replacing else ACTION_TRACE
    return trace | {
        pair: work.step(formula, s=pair[0], a=pair[1], t=time, e=trace, **known)
        for pair in given.eligible
        if pair == visited or trace[pair] != 0
    }


def _moved(
    given: Given, work: Work, known: Mapping[str, Any], error: Value, trace: Traces, time: int
) -> dict[Pair, Value]:
    """All action values after a transition."""
    old: dict[Pair, Value] = known["Q"]
    return old | {
        pair: work.step(SARSA_LAMBDA, s=pair[0], a=pair[1], t=time, alpha=known["alpha"], Q=old, e=trace,
                        delta={time: error})
        for pair in given.eligible
        if trace[pair] != 0
    }  # fmt: skip


def _cut(work: Work, trace: Traces, time: int, state: str, action: str) -> Traces:
    """No trace is left."""
    if any(trace.values()):
        work.say(f"At $t = {time}$ in {state} the action {action} is not greedy, so all traces are set to $0$.")
    return dict.fromkeys(trace, ZERO)


def _watkins(given: Given, work: Work, left: Callable[[Work, Traces, int, str, str], Traces]) -> None:
    """Transition by transition: what is ``left`` of the traces where the action is not greedy; then traces, error and
    values.
    """
    known = knowns.action_run(given) | {"lam": exact(given.lam)}
    trace = dict.fromkeys(given.eligible, ZERO) | _before(given)
    judged_by = known["Q"]
    for time, (state, action) in enumerate(_visits(given)):
        greatest = largest([judged_by[state, other] for other in given.values[state]])
        if judged_by[state, action] != greatest:
            trace = left(work, trace, time, state, action)
        trace = _visited(given, work, known, trace, time, (state, action))
        error = work.step(Q_LEARNING_TD_ERROR, t=time, **known)
        judged_by = known["Q"]
        known["Q"] = _moved(given, work, known, error, trace, time)
    work.answer({pair: trace[pair] for pair in given.eligible})
    work.say("The updates above give these action values.")
    work.answer({pair: known["Q"][pair] for pair in given.eligible})


def _move(given: Given, work: Work, traces: list[Traces]) -> None:
    """Every transition moves the values of all pairs by their traces after it."""
    known = knowns.action_run(given)
    for time, trace in enumerate(traces):
        error = work.step(SARSA_TD_ERROR, t=time, **known)
        known["Q"] = _moved(given, work, known, error, trace, time)
    answer_along(given, work, known["Q"], given.eligible)


def _explores(given: Given, time: int) -> bool:
    """Whether a state is first visited at this time, so with its values untouched, and left by another than the best
    action, while other pairs have traces.
    """
    run = given.trajectory
    state = run.states[time]
    row = given.values[state]
    traced = time > 0 or given.traces is not None
    return traced and state not in run.states[:time] and row[run.actions[time]] < max(row.values())


def _explores_at_times(given: Given) -> bool:
    return any(_explores(given, time) for time in range(len(given.trajectory.rewards)))


def _comes_back(given: Given) -> bool:
    """Whether a pair is visited that has a trace."""
    visits = _visits(given)
    traced = [pair for pair, trace in _before(given).items() if trace != 0]
    return len({*visits, *traced}) < len(visits) + len(traced)


@slip(
    "traces-cut",
    "Sarsa(λ) keeps its traces when an exploratory action is taken; it is Watkins's Q(λ) that cuts them there.",
    when=lambda given: not given.outcome and not given.watkins and _explores_at_times(given),
)
def traces_cut(given: Given, work: Work) -> None:
    """No traces are left where an exploratory action is taken."""

    def left(trace: Traces, time: int) -> Traces:
        return dict.fromkeys(trace, ZERO) if _explores(given, time) else trace

    _move(given, work, _traces(given, work, left))


@slip(
    "replacing-traces",
    "Accumulating traces add 1 to what is left of the trace; replacing traces would set it to 1.",
    when=lambda given: not given.outcome and not given.watkins and not given.replacing and _comes_back(given),
)
def replacing(given: Given, work: Work) -> None:
    """Nothing is left of the trace of the pair that is visited."""
    visits = _visits(given)
    _move(given, work, _traces(given, work, lambda trace, time: trace | {visits[time]: ZERO}))


@slip(
    "only-the-visited-pair",
    "Every pair with a trace is moved by the TD error, not only the pair that was just left.",
    when=lambda given: not given.outcome and not given.watkins and len(given.eligible) > 1,
)
def only_visited(given: Given, work: Work) -> None:
    """All traces are right, but only the pair just left is moved by its trace."""
    traces = _traces(given, work)
    own = [{visited: trace[visited]} for visited, trace in zip(_visits(given), traces, strict=True)]
    _move(given, work, [dict.fromkeys(given.eligible, ZERO) | trace for trace in own])


@slip(
    "traces-kept",
    "Watkins's Q(λ) looks ahead only as far as greedy actions are taken: another action sets all traces to 0.",
    when=lambda given: given.watkins,
)
def traces_kept(given: Given, work: Work) -> None:
    """The traces outlast actions that are not greedy."""
    _watkins(given, work, lambda _work, trace, _time, _state, _action: trace)


MISCONCEPTIONS = (
    traces_cut, only_visited, replacing, TRACE_WITHOUT_LAMBDA, TRACE_WITHOUT_GAMMA, traces_kept,
    ACCUMULATING_ACTION_TRACE, TAKEN_FOR_MAX, NOT_DISCOUNTED,
)  # fmt: skip


def oracle(given: Given) -> Answers:
    """Traces and values; or where a value is known in the end, the parameter that leads there."""
    return oracle_along(given, _learned, given.eligible)


def _learned(given: Given) -> Answers:
    """Traces as sums of powers over past visits; values as vectors, all pairs at once."""
    run = given.trajectory
    pairs = [(state, action) for state, row in given.values.items() for action in row]
    Q = np.array([at(given.values[state][action]) for state, action in pairs])
    before = np.array([at((given.traces or {}).get(state, {}).get(action, 0)) for state, action in pairs])
    visits = [pairs.index(pair) for pair in zip(run.states, run.actions, strict=False)]
    decay = at(given.gamma) * at(given.lam)
    rows = {state: [pairs.index((state, action)) for action in row] for state, row in given.values.items()}
    begin, judged_by = 0, Q  # the time since which traces are kept
    for time, reward in enumerate(run.rewards):
        if given.watkins and judged_by[visits[time]] < judged_by[rows[run.states[time]]].max():
            begin, before = time, before * 0
        powers = decay ** np.arange(time - begin, -1, -1)
        seen = np.array(visits[begin : time + 1])[:, None] == np.arange(len(pairs))
        left = np.vstack([before * decay ** (time + 1), seen * powers[:, None]])
        if given.replacing:
            left[0, visits[begin : time + 1]] = 0
        e = left[1:].max(axis=0) + left[0] if given.replacing else left.sum(axis=0)
        after = run.states[time + 1]
        ahead = 0.0 if after in run.terminal else Q[rows[after]].max() if given.watkins else Q[visits[time + 1]]
        judged_by = Q
        Q = Q + at(given.alpha) * (at(reward) + at(given.gamma) * ahead - Q[visits[time]]) * e
    asked = [pairs.index(pair) for pair in given.eligible]
    return (e[asked], Q[asked])
