"""One application of the Bellman equation for V; what is left open follows from its two sides."""

from msgspec.structs import replace

from rldrill.problems.bellman.bellman_backup import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import exact
from rldrill.solutions.formula.notation import V, numbered
from rldrill.solutions.oracle import OPEN, Answers, at, root
from rldrill.solutions.sheet.bellman import (
    ACTIONS_ALIKE,
    BELLMAN_V,
    DISCOUNTED_REWARD,
    FORGOT_GAMMA,
    FORGOT_POLICY,
    MAX_FOR_MEAN,
)
from rldrill.solutions.sheet.dynamic_programming import POLICY_EVALUATION, synchronous
from rldrill.solutions.work import Work


def _comparable(given: Given) -> bool:
    return not given.find and not given.parameters()


def solve(given: Given, work: Work) -> None:
    """The average over actions, and over where each leads."""
    known = knowns.model(given.dynamics) | {
        "s": given.state,
        "gamma": exact(given.gamma),
        "pi": knowns.policy(given.policy),
        "V": knowns.values(given.values),
    }
    if given.current:
        work.answer(work.step(synchronous(POLICY_EVALUATION), into=numbered(V, 1), **known))
        return
    value = work.step(BELLMAN_V, **known)
    if given.find:
        (letter,) = given.unknown
        work.say(f"This must equal the given value of {given.state}:")
        value = work.equate(letter, value, exact(given.values[given.state]))
    work.answer(value)


MISCONCEPTIONS = (
    FORGOT_POLICY,
    ACTIONS_ALIKE.where_it_shows(),
    DISCOUNTED_REWARD,
    replace(FORGOT_GAMMA, when=lambda given: given.gamma != 1 and given.unknown != ("gamma",)),
    replace(MAX_FOR_MEAN, when=_comparable),
)


def possible(given: Given) -> bool:
    """Whether what is left open has a value that it can have; without it, no value that is printed follows another."""
    return not given.find or given.unknown == ("x",) or 0 < oracle(given)[0] < 1


def oracle(given: Given) -> Answers:
    """A weighted sum over the outcomes, one array for each column of the table; the root of a linear function."""
    rows = given.dynamics.transitions

    def backed_up(left_open: float) -> float:
        gamma = at(given.gamma, left_open)
        weight = [at(given.policy[row.state].get(row.action, 0), left_open) * at(row.probability, left_open)
                  for row in rows]  # fmt: skip
        worth = [at(row.reward, left_open) + gamma * at(given.values[row.next], left_open) for row in rows]
        return sum(w * v for w, v in zip(weight, worth, strict=True))

    if not given.find:
        return (backed_up(float(OPEN)),)
    return (root(lambda left_open: backed_up(left_open) - at(given.values[given.state])),)
