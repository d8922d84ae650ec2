"""Every episode with its probability and its return, then the mean of the returns."""

from fractions import Fraction
from typing import Any

from msgspec.structs import replace

from rldrill.problems.fundamentals.expected_return import Episode, Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import exact
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at, chances, lookahead, tensors
from rldrill.solutions.policy_values import equal_chances
from rldrill.solutions.reversible import find, tried
from rldrill.solutions.sheet.fundamentals import (
    BEST_EPISODE,
    EPISODE_PROBABILITY,
    GOAL,
    LAST_BRANCH_DROPPED,
    POLICY_DROPPED,
    RETURN,
    START_DROPPED,
    UNDISCOUNTED,
    UNWEIGHTED,
    ReturnOf,
    tau,
)
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """Probability and return of each episode of the tree, one by one."""
    known: dict[str, Any] = knowns.model(given.mdp) | {
        "start": knowns.values(given.start),
        "pi": knowns.policy(given.chances),
        "gamma": exact(given.gamma),
    }
    probabilities, returns = {}, {}
    for number, episode in enumerate(given.episodes(), 1):
        work.say(f"Episode $τ_{{{number}}}$: {_told(episode)}.")
        run: dict[str, Any] = {
            "tau": number,
            "T": len(episode.transitions),
            "S": dict(enumerate((episode.start, *(row.next for row in episode.transitions)))),
            "A": {time: row.action for time, row in enumerate(episode.transitions)},
            "r": {time + 1: exact(row.reward) for time, row in enumerate(episode.transitions)},
        }
        probabilities[number] = work.step(EPISODE_PROBABILITY, **run, **known)
        returns[number] = work.step(RETURN, t=0, **run, gamma=known["gamma"], into=lambda t: ReturnOf(t, tau))
    work.say("Over all episodes:")
    value = work.step(GOAL, episodes=tuple(probabilities), episode_pr=probabilities, episode_return=returns)
    if given.known is not None:
        find(given, work, value, "𝔼_π(R_0)")
        return
    work.answer(value)


@slip(
    "starts-in-the-first-state",
    "Episodes start in the other states, too: each start state counts with its probability.",
    when=lambda given: given.known is None and len(given.start) > 1,
)
def one_start(given: Given, work: Work) -> None:
    """Every episode starts in the state that is listed first."""
    solve(given.model_copy(update={"start": {next(iter(given.start)): Fraction(1)}}), work)


@slip(
    "starts-alike",
    "The start states need not be equally probable: each counts with its own probability.",
    when=lambda given: given.known is None and len(given.start) > 1,
)
def starts_alike(given: Given, work: Work) -> None:
    """Every start state with the same probability."""
    solve(given.model_copy(update={"start": dict.fromkeys(given.start, Fraction(1, len(given.start)))}), work)


MISCONCEPTIONS = (
    UNWEIGHTED,
    BEST_EPISODE,
    START_DROPPED,
    POLICY_DROPPED,
    LAST_BRANCH_DROPPED,
    UNDISCOUNTED.where_it_shows(),
    one_start.where_it_shows(),
    starts_alike.where_it_shows(),
    replace(equal_chances(solve), when=lambda given: given.known is None and given.policy is not None),
)


def _told(episode: Episode) -> str:
    steps = "; ".join(f"{row.action} leads to {row.next}" for row in episode.transitions)
    return f"it starts in {episode.start}; {steps}"


def oracle(given: Given) -> Answers:
    """Backwards instead: the values of all states by as many sweeps as there are states, then the mean over starts."""
    if given.known is not None:
        return (tried(given, lambda trial: oracle(trial)[0]),)
    states = given.mdp.every_state
    P, R = tensors(given.mdp)
    pi = chances(given.chances, given.mdp)
    V = np.zeros(len(states))
    for _ in states:
        worth = lookahead(P, R, V, at(given.gamma))
        V = (pi * np.where(np.isinf(worth), 0.0, worth)).sum(axis=1)
    return (sum(at(chance) * V[states.index(state)] for state, chance in given.start.items()),)
