"""One average over outcomes for every action; what is left open follows where two of them are to be equal."""

from collections.abc import Callable
from operator import attrgetter

from msgspec.structs import replace

from rldrill.problems.bellman.action_value import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import ONE, NoSolution, Value, exact, sign
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.oracle import OPEN, Answers, at, root
from rldrill.solutions.rational import generator
from rldrill.solutions.sheet.bellman import (
    BELLMAN_Q,
    OWN_VALUE,
    Q_FORGOT_GAMMA,
    Q_REWARD_UNWEIGHTED,
    V_FROM_Q,
)
from rldrill.solutions.work import Work


def solve(given: Given, work: Work, told: Callable[[Value], Value] = lambda chance: chance) -> None:
    """Reward plus discounted value of the next state, averaged over where the action leads."""
    known = knowns.model(given.dynamics) | {"gamma": exact(given.gamma), "V": knowns.values(given.values)}
    worth = {(s, a): work.step(BELLMAN_Q, s=s, a=a, **known) for s, a in given.dynamics.pairs}
    if given.find:
        (letter,) = given.unknown
        work.say("Both are to be equal:")
        work.answer(work.equate(letter, *worth.values()))
        return
    worth = work.answer(worth)
    if given.chance:
        (state, first), (_, second) = given.dynamics.pairs
        p, own = generator("p"), exact(given.values[state])
        pi = {(first, state): p, (second, state): ONE - p}
        mean = work.step(V_FROM_Q, s=state, Q=worth, pi=pi, actions=given.dynamics.actions)
        work.say(f"This must equal the given value of {state}:")
        chance = work.equate("p", mean, own)
        if sign(chance) < 0 or sign(ONE - chance) < 0:
            raise NoSolution(f"the value of {state!r} does not lie between those of its actions; no policy gives it")
        work.answer(told(chance))


@slip(
    "chance-of-the-other-action",
    "That is the probability of the other action; the two sum to 1.",
    when=attrgetter("chance"),
)
def other_chance(given: Given, work: Work) -> None:
    """The probability with which the policy does not take the action that is asked for."""
    solve(given, work, lambda chance: ONE - chance)


MISCONCEPTIONS = (
    replace(Q_REWARD_UNWEIGHTED, when=lambda given: any(row.probability != 1 for row in given.dynamics.transitions)),
    replace(Q_FORGOT_GAMMA, when=lambda given: given.gamma != 1 and given.unknown != ("gamma",)),
    OWN_VALUE,
    other_chance.where_it_shows(),
)


def possible(given: Given) -> bool:
    """Whether the value of the state lies between those of its actions, and what is found is what it can be."""
    if given.find:
        return given.unknown == ("x",) or 0 < oracle(given)[0] < 1
    if given.state not in given.values or given.parameters():
        return True
    worth = oracle(given)[0]
    return bool(min(worth) - 1e-9 <= at(given.values[given.state]) <= max(worth) + 1e-9)


def oracle(given: Given) -> Answers:
    """A weighted sum over the rows of the table, action by action; a linear function's root; a lever between two."""
    if given.find:

        def gap(left_open: float) -> float:
            first, second = _worth(given, left_open)
            return first - second

        return (root(gap),)
    worth = _worth(given, float(OPEN))
    if not given.chance:
        return (worth,)
    first, second = worth
    return (worth, (at(given.values[given.state]) - second) / (first - second))


def _worth(given: Given, left_open: float) -> list[float]:
    totals = dict.fromkeys(given.dynamics.pairs, 0.0)
    for row in given.dynamics.transitions:
        ahead = at(given.gamma, left_open) * at(given.values[row.next], left_open)
        totals[row.state, row.action] += at(row.probability, left_open) * (at(row.reward, left_open) + ahead)
    return list(totals.values())
