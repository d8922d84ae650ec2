"""The ratio of every episode, then its return, then both estimates."""

from typing import Any

from rldrill.problems.control.importance_sampling import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import ONE, ZERO, exact
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.control import (
    FIRST_ACTION_ALONE,
    IMPORTANCE_RATIO,
    ORDINARY_FOR_WEIGHTED,
    ORDINARY_IMPORTANCE_SAMPLING,
    RATIO_INVERTED,
    RATIOS_ADDED,
    RATIOS_FORGOTTEN,
    SUM_OF_EPISODES,
    WEIGHTED_FOR_ORDINARY,
    WEIGHTED_IMPORTANCE_SAMPLING,
)
from rldrill.solutions.sheet.fundamentals import RETURN, UNDISCOUNTED
from rldrill.solutions.slips import right_answers
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """Ratios; returns; the mean of their products, and with the ratios as weights."""
    acted = knowns.policy(given.behaviour)
    known: dict[str, Any] = {"pi": dict.fromkeys(acted, ZERO) | knowns.policy(given.target), "behaviour": acted}
    runs = [knowns.trajectory(episode) | {"T": len(episode.rewards)} for episode in given.episodes]
    ratios = tuple(work.step(IMPORTANCE_RATIO, i=number, **run, **known) for number, run in enumerate(runs, 1))
    answer = work.answer(ratios if len(ratios) > 1 else ratios[0])
    ratios = answer if len(ratios) > 1 else (answer,)
    returns = {}
    for number, run in enumerate(runs, 1):
        label = f"episode {number}"
        returns[number] = work.step(RETURN, t=0, gamma=exact(given.gamma), r=run["r"], T=run["T"], label=label)
    episodes = f"the $n = {len(runs)}$ episodes" if len(runs) > 1 else "this one, $n = 1$"
    work.say(f"$R_{{0, i}}$ is the return $R_0$ of episode $i$. Over {episodes}:")
    weighing: dict[str, Any] = {"rho": dict(enumerate(ratios, 1)), "Ri": returns, "n": len(runs), "S": {0: given.start}}
    work.answer(work.step(ORDINARY_IMPORTANCE_SAMPLING, **weighing))
    if len(runs) > 1:
        work.answer(work.step(WEIGHTED_IMPORTANCE_SAMPLING, **weighing))


@slip(
    "per-decision",
    "Here the ratio of the whole episode weights its return; weighting each reward with the ratio up to it is another "
    "estimator, per-decision importance sampling.",
)
def per_decision(given: Given, work: Work) -> None:
    """Every reward with the ratio of the actions up to it, in the ordinary estimate."""
    ratios, _, *weighted = right_answers(solve, given, work)
    work.answer(ratios)
    target, behaviour = knowns.policy(given.target), knowns.policy(given.behaviour)
    total = ZERO
    for episode in given.episodes:
        weight = ONE
        for state, action, reward in zip(episode.states, episode.actions, episode.rewards, strict=False):
            weight = weight * target[action, state] / behaviour[action, state]
            total += weight * exact(reward)
            weight = weight * exact(given.gamma)
    work.answer(total / len(given.episodes))
    for other in weighted:
        work.answer(other)


MISCONCEPTIONS = (
    RATIO_INVERTED,
    RATIOS_ADDED,
    WEIGHTED_FOR_ORDINARY,
    ORDINARY_FOR_WEIGHTED,
    RATIOS_FORGOTTEN,
    FIRST_ACTION_ALONE.where_it_shows(),
    SUM_OF_EPISODES.where_it_shows(),
    per_decision.where_it_shows(),
    UNDISCOUNTED.where_it_shows(),
)


def oracle(given: Given) -> Answers:
    """Ratios by logarithms, which add up; returns by polynomials in γ; numpy's weighted mean."""
    target = {(s, a): at(chance) for s, row in given.target.items() for a, chance in row.items()}
    ratios, returns = [], []
    for episode in given.episodes:
        pairs = list(zip(episode.states, episode.actions, strict=False))
        wanted = np.prod([target.get(pair, 0.0) for pair in pairs])
        acted = np.exp(sum(np.log(at(given.behaviour[state][action])) for state, action in pairs))
        ratios.append(wanted / acted)
        returns.append(np.polynomial.Polynomial([at(reward) for reward in episode.rewards])(at(given.gamma)))
    ordinary = np.dot(ratios, returns) / len(returns)
    if len(ratios) == 1:
        return (ratios[0], ordinary)
    return (ratios, ordinary, np.average(returns, weights=ratios) if sum(ratios) else np.nan)
