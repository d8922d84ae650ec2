"""Batch Monte Carlo averages returns; batch TD(0) averages one-step targets, for all states at once."""

from typing import Any

import numpy as np

from rldrill.problems.temporal_difference.batch_td_and_mc import Given, Observed, run_text
from rldrill.solutions.exact import ZERO, Value, exact
from rldrill.solutions.formula.formula import fork
from rldrill.solutions.formula.notation import V
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.fundamentals import RETURN_RECURSIVE
from rldrill.solutions.sheet.temporal_difference import BATCH_MONTE_CARLO, BATCH_TD
from rldrill.solutions.work import Work


def _leads_on(given: Given) -> bool:
    return any(len(episode.states) > 1 for episode in given.episodes)


TD_FOR_MC = fork(
    "td-for-monte-carlo",
    "Batch Monte Carlo averages the whole returns that were seen after a state; it builds on no other state's value.",
    when=_leads_on,
)
MC_FOR_TD = fork(
    "monte-carlo-for-td",
    "Batch TD(0) builds on the value of the next state, so what other episodes say about that state counts too.",
    when=_leads_on,
)
MISCONCEPTIONS = (TD_FOR_MC, MC_FOR_TD)

#: The state in which every episode ends; no state of a problem can have this name.
END = "–"


def solve(given: Given, work: Work) -> None:
    """Both answers; who takes one method for the other gives its answer twice."""
    known = _known(given)
    work.answer(_td(given, work, known) if work.makes(TD_FOR_MC) else _monte_carlo(given, work, known))
    work.answer(_monte_carlo(given, work, known) if work.makes(MC_FOR_TD) else _td(given, work, known))


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
    everything: list[Value] = []  # the returns on the clock of all episodes, with a 0 wherever one ends
    for episode in given.episodes:
        returns = _returns(episode, work, known["gamma"])
        everything += [*returns, ZERO] * episode.times
    G = dict(enumerate(everything))
    work.say("The mean over all visits of each state:")
    return {state: work.step(BATCH_MONTE_CARLO, s=state, G=G, **known) for state in given.states}


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
    solution = work.system(BATCH_TD, V, [{"s": state} for state in given.states], V={END: ZERO}, **known)
    return {state: solution[state] for state in given.states}


def oracle(given: Given) -> Answers:
    """Least squares: returns on indicators of the states for Monte Carlo, the equations of LSTD for TD."""
    states = given.states
    gamma = at(given.gamma)
    rows, after, rewards, returns = [], [], [], []
    for episode in _one_by_one(given):
        features = np.array([[float(state == visited) for state in states] for visited in episode.states])
        earned = np.array([at(reward) for reward in episode.rewards])
        discounts = gamma ** np.arange(len(earned))
        rows.append(features)
        after.append(np.vstack([features[1:], np.zeros((1, len(states)))]))
        rewards.append(earned)
        returns.append([discounts[: len(earned) - t] @ earned[t:] for t in range(len(earned))])
    X, following = np.vstack(rows), np.vstack(after)
    fit = np.linalg.lstsq(X, np.concatenate(returns), rcond=None)[0]
    return (fit, np.linalg.solve(X.T @ (X - gamma * following), X.T @ np.concatenate(rewards)))
