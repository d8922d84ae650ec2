"""TD(λ) in the forward view: a step towards the λ-return of every time asked for."""

from rldrill.problems.temporal_difference.td_lambda_forward import Given
from rldrill.solutions.exact import Value, exact
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.reversible import find_and_finish, found_and_finished
from rldrill.solutions.sheet.fundamentals import UNDISCOUNTED
from rldrill.solutions.sheet.temporal_difference import FORGOT_ALPHA, NOT_KEPT, NOT_SUBTRACTED, TD_LAMBDA
from rldrill.solutions.temporal_difference.lambda_return import average, averaged, backwards, known_episode
from rldrill.solutions.work import Work

MISCONCEPTIONS = (FORGOT_ALPHA, NOT_SUBTRACTED, NOT_KEPT, UNDISCOUNTED.where_it_shows())


def solve(given: Given, work: Work) -> None:
    """The λ-returns, then one update for each, all from the values before the run."""
    if given.known is not None:
        find_and_finish(given, work, _updated(given, work, _returns(given, work)))
        return
    returns = _returns(given, work)
    single = len(returns) == 1
    carried = work.answer(returns[0] if single else returns)
    work.answer(_updated(given, work, (carried,) if single else carried))


def _returns(given: Given, work: Work) -> tuple[Value, ...]:
    known = known_episode(given)
    work.say(f"The {'episode' if known['ends'] else 'run'} ends at $T = {known['T']}$.")
    return tuple(average(work, known, time, averaged(work, known, time)) for time in given.asked)


def _updated(given: Given, work: Work, returns: tuple[Value, ...]) -> dict[str, Value]:
    known = known_episode(given) | {"Glam": dict(zip(given.asked, returns, strict=True))}
    updates = (work.step(TD_LAMBDA, t=time, alpha=exact(given.alpha), **known) for time in given.asked)
    return dict(zip(given.updated, updates, strict=True))


def oracle(given: Given) -> Answers:
    """The λ-returns backwards in time; each value as a weighted mean of the old one and its return."""
    if given.known is not None:
        return found_and_finished(given, lambda trial: oracle(trial)[-1])
    returns = backwards(given)[list(given.asked)]
    before = [at(given.values[state]) for state in given.updated]
    after = [
        (1 - at(given.alpha)) * old + at(given.alpha) * target for old, target in zip(before, returns, strict=True)
    ]
    return (returns, after)
