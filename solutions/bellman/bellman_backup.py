"""One application of the Bellman equation for V."""

from rldrill.problems.bellman.bellman_backup import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import exact
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.bellman import (
    BELLMAN_V,
    DISCOUNTED_REWARD,
    FORGOT_GAMMA,
    FORGOT_POLICY,
    MAX_FOR_MEAN,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (FORGOT_POLICY, DISCOUNTED_REWARD, FORGOT_GAMMA, MAX_FOR_MEAN)


def solve(given: Given, work: Work) -> None:
    """The average over actions, and over where each leads."""
    value = work.step(
        BELLMAN_V,
        s=given.state,
        gamma=exact(given.gamma),
        pi=knowns.policy(given.policy),
        V=knowns.values(given.values),
        **knowns.model(given.dynamics),
    )
    work.answer(value)


def oracle(given: Given) -> Answers:
    """A weighted sum over the outcomes, one array for each column of the table."""
    rows = given.dynamics.transitions
    weight = [at(given.policy[row.state].get(row.action, 0)) * at(row.probability) for row in rows]
    worth = [at(row.reward) + at(given.gamma) * at(given.values[row.next]) for row in rows]
    return (sum(w * v for w, v in zip(weight, worth, strict=True)),)
