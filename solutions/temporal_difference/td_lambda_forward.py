"""TD(λ) in the forward view: a step towards the λ-return of every time asked for."""

from rldrill.problems.temporal_difference.td_lambda_forward import Given
from rldrill.solutions.exact import exact
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.temporal_difference import FORGOT_ALPHA, NOT_KEPT, NOT_SUBTRACTED, TD_LAMBDA
from rldrill.solutions.temporal_difference.lambda_return import average, averaged, backwards, known_episode
from rldrill.solutions.work import Work

MISCONCEPTIONS = (FORGOT_ALPHA, NOT_SUBTRACTED, NOT_KEPT)


def solve(given: Given, work: Work) -> None:
    """The λ-returns, then one update for each, all from the values before the run."""
    known = known_episode(given)
    returns = tuple(average(work, known, time, averaged(work, known, time)) for time in given.asked)
    single = len(returns) == 1
    carried = work.answer(returns[0] if single else returns)
    Glam = dict(zip(given.asked, (carried,) if single else carried, strict=True))
    updates = {time: work.step(TD_LAMBDA, t=time, Glam=Glam, alpha=exact(given.alpha), **known) for time in given.asked}
    work.answer(dict(zip(given.updated, updates.values(), strict=True)))


def oracle(given: Given) -> Answers:
    """The λ-returns backwards in time; each value as a weighted mean of the old one and its return."""
    returns = backwards(given)[list(given.asked)]
    before = [at(given.values[state]) for state in given.updated]
    after = [
        (1 - at(given.alpha)) * old + at(given.alpha) * target for old, target in zip(before, returns, strict=True)
    ]
    return (returns, after)
