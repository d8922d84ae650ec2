"""Batch Monte Carlo averages returns; batch TD(0) averages one-step targets, for all states at once."""

from collections.abc import Callable
from typing import Any

from rldrill.problems.temporal_difference.batch_td_and_mc import Given, Observed, run_text
from rldrill.solutions.exact import ZERO, Value, exact
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.formula.notation import V
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.bellman import FORGOT_GAMMA
from rldrill.solutions.sheet.fundamentals import RECURSION_UNDISCOUNTED, RETURN_RECURSIVE
from rldrill.solutions.sheet.temporal_difference import BATCH_MONTE_CARLO, BATCH_TD
from rldrill.solutions.work import Work

#: The state in which every episode ends; no state of a problem can have this name.
END = "–"


Method = Callable[[Given, Work, dict[str, Any]], dict[str, Value]]


def solve(given: Given, work: Work) -> None:
    """Monte Carlo's answer, then that of TD(0)."""
    _answer(given, work, _monte_carlo, _td)


def _answer(given: Given, work: Work, *methods: Method) -> None:
    known = _known(given)
    for method in methods:
        work.answer(method(given, work, known))


def _known(given: Given) -> dict[str, Any]:
    """All episodes one after the other on one clock: what was visited and earned when, and the visits of each state."""
    S: dict[int, str] = {}
    r: dict[int, Value] = {}
    time = 0
    for episode in _one_by_one(given):
        for state, reward in zip(episode.states, episode.rewards, strict=True):
            S[time], r[time + 1] = state, exact(reward)
            time += 1
        S[time] = END
        time += 1
    visits = {state: tuple(time for time, visited in S.items() if visited == state) for state in given.states}
    counts = {state: exact(len(times)) for state, times in visits.items()}
    return {"S": S, "r": r, "visits": visits, "count": counts, "gamma": exact(given.gamma)}


def _one_by_one(given: Given) -> list[Observed]:
    return [episode for episode in given.episodes for _ in range(episode.times)]


def _monte_carlo(given: Given, work: Work, known: dict[str, Any]) -> dict[str, Value]:
    if given.visits == "first":
        known = known | _first_visits(given)
    return _averaged(given, work, known)


def _averaged(given: Given, work: Work, known: dict[str, Any]) -> dict[str, Value]:
    """The means of the returns after the visits that are known."""
    everything: list[Value] = []  # the returns on the clock of all episodes, with a 0 wherever one ends
    for episode in given.episodes:
        returns = _returns(episode, work, known["gamma"])
        everything += [*returns, ZERO] * episode.times
    G = dict(enumerate(everything))
    if given.visits == "first":
        work.say("Here the sum runs over the first visits to $s$, one in every episode that visits it, $n(s)$ in all:")
    else:
        work.say("The sum runs over all visits to $s$, the times $t$ with $s_t = s$, $n(s)$ in all:")
    return {state: work.step(BATCH_MONTE_CARLO, s=state, G=G, **known) for state in given.states}


def _first_visits(given: Given) -> dict[str, Any]:
    """The times of the first visit of each state in every episode, and how many those are."""
    visits: dict[str, tuple[int, ...]] = dict.fromkeys(given.states, ())
    start = 0
    for episode in _one_by_one(given):
        for state in dict.fromkeys(episode.states):
            visits[state] += (start + episode.states.index(state),)
        start += len(episode.states) + 1
    return {"visits": visits, "count": {state: exact(len(times)) for state, times in visits.items()}}


def _returns(episode: Observed, work: Work, gamma: Value) -> list[Value]:
    """The returns of one episode, on its own clock."""
    work.say(f"The episode {run_text(episode)}:")
    end = len(episode.states)
    r = {time + 1: exact(reward) for time, reward in enumerate(episode.rewards)}
    G = {end: ZERO}
    for time in reversed(range(end)):
        G = G | {time: work.step(RETURN_RECURSIVE, t=time, G=G, r=r, gamma=gamma)}
    return [G[time] for time in range(end)]


def _td(given: Given, work: Work, known: dict[str, Any]) -> dict[str, Value]:
    work.say(
        "TD(0) changes nothing any more when the TD errors of each state sum to $0$ over all its visits, so when its "
        "value is the mean of its targets, over all $n(s)$ times $t$ with $s_t = s$:"
    )
    solution = work.system(BATCH_TD, V, [{"s": state} for state in given.states], V={END: ZERO}, **known)
    return {state: solution[state] for state in given.states}


def _leads_on(given: Given) -> bool:
    return any(len(episode.states) > 1 for episode in given.episodes)


@slip(
    "td-for-monte-carlo",
    "Batch Monte Carlo averages the whole returns that were seen after a state; it builds on no other state's value.",
    when=_leads_on,
)
def td_for_monte_carlo(given: Given, work: Work) -> None:
    """The answer of TD(0) twice."""
    _answer(given, work, _td, _td)


@slip(
    "monte-carlo-for-td",
    "Batch TD(0) builds on the value of the next state, so what other episodes say about that state counts too.",
    when=_leads_on,
)
def monte_carlo_for_td(given: Given, work: Work) -> None:
    """Monte Carlo's answer twice."""
    _answer(given, work, _monte_carlo, _monte_carlo)


@slip(
    "monte-carlo-value-ahead",
    "The targets of batch TD(0) take the value that TD(0) itself gives the next state, not Monte Carlo's.",
    when=_leads_on,
)
def monte_carlo_ahead(given: Given, work: Work) -> None:
    """One-step targets from the values of the first part."""
    known = _known(given)
    seen = work.answer(_monte_carlo(given, work, known)) | {END: ZERO}
    work.answer({state: work.step(BATCH_TD, s=state, V=seen, **known) for state in given.states})


@slip(
    "other-visits",
    "First-visit Monte Carlo counts a state once in an episode, every-visit Monte Carlo once for each of its visits.",
    when=lambda given: given.visits == "first",
)
def other_visits(given: Given, work: Work) -> None:
    """Every visit instead of the first."""
    solve(given.model_copy(update={"visits": "every"}), work)


@slip(
    "first-states-alone",
    "An episode says something of every state in it: a return is counted after each of them, not after its first one "
    "alone.",
    when=lambda given: any(
        episode.states[0] in later.states[1:] for later in given.episodes for episode in given.episodes
    ),
)
def first_states(given: Given, work: Work) -> None:
    """Of the states in which episodes begin, only the returns of those episodes, from their beginning."""
    known = _known(given)
    starts: dict[str, tuple[int, ...]] = {}
    time = 0
    for episode in _one_by_one(given):
        starts[episode.states[0]] = (*starts.get(episode.states[0], ()), time)
        time += len(episode.states) + 1
    visits = (known | _first_visits(given) if given.visits == "first" else known)["visits"] | starts
    counted = {"visits": visits, "count": {state: exact(len(times)) for state, times in visits.items()}}
    _answer(given, work, lambda *_: _averaged(given, work, known | counted), _td)


@slip(
    "times-ignored",
    "An episode that was observed several times counts as often as it was observed.",
    when=lambda given: len({episode.times for episode in given.episodes}) > 1,
)
def times_ignored(given: Given, work: Work) -> None:
    """Every row of the table as one episode."""
    once = tuple(episode.model_copy(update={"times": 1}) for episode in given.episodes)
    solve(given.model_copy(update={"episodes": once}), work)


MISCONCEPTIONS = (
    td_for_monte_carlo,
    monte_carlo_for_td,
    monte_carlo_ahead.where_it_shows(),
    other_visits,
    first_states.where_it_shows(),
    times_ignored.where_it_shows(),
    RECURSION_UNDISCOUNTED.where_it_shows(),
    FORGOT_GAMMA.where_it_shows(),
)


def oracle(given: Given) -> Answers:
    """Least squares: returns on indicators of the states for Monte Carlo, the equations of LSTD for TD."""
    states = given.states
    gamma = at(given.gamma)
    rows, after, rewards, returns, counted = [], [], [], [], []
    for episode in _one_by_one(given):
        features = np.array([[float(state == visited) for state in states] for visited in episode.states])
        earned = np.array([at(reward) for reward in episode.rewards])
        discounts = gamma ** np.arange(len(earned))
        rows.append(features)
        after.append(np.vstack([features[1:], np.zeros((1, len(states)))]))
        rewards.append(earned)
        counted.append([given.visits == "every" or s not in episode.states[:t] for t, s in enumerate(episode.states)])
        returns.append([discounts[: len(earned) - t] @ earned[t:] for t in range(len(earned))])
    X, following = np.vstack(rows), np.vstack(after)
    count = np.concatenate(counted)
    fit = np.linalg.lstsq(X[count], np.concatenate(returns)[count], rcond=None)[0]
    return (fit, np.linalg.solve(X.T @ (X - gamma * following), X.T @ np.concatenate(rewards)))
