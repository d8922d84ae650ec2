"""One average over outcomes for every action."""

from rldrill.problems.bellman.action_value import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import exact
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.bellman import BELLMAN_Q, OWN_VALUE, Q_FORGOT_GAMMA, Q_REWARD_UNWEIGHTED
from rldrill.solutions.work import Work

MISCONCEPTIONS = (Q_REWARD_UNWEIGHTED, Q_FORGOT_GAMMA, OWN_VALUE)


def solve(given: Given, work: Work) -> None:
    """Reward plus discounted value of the next state, averaged over where the action leads."""
    known = knowns.model(given.dynamics) | {"gamma": exact(given.gamma), "V": knowns.values(given.values)}
    work.answer({(s, a): work.step(BELLMAN_Q, s=s, a=a, **known) for s, a in given.dynamics.pairs})


def oracle(given: Given) -> Answers:
    """A weighted sum over the rows of the table, action by action."""
    totals = dict.fromkeys(given.dynamics.pairs, 0.0)
    for row in given.dynamics.transitions:
        worth = at(row.reward) + at(given.gamma) * at(given.values[row.next])
        totals[row.state, row.action] += at(row.probability) * worth
    return (list(totals.values()),)
