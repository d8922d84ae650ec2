"""TD(0) along a run: each update with the values then current."""

from collections.abc import Callable

from rldrill.problems.temporal_difference.td_zero import AlongRun, Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, Value, exact
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.reversible import find_and_finish, found_and_finished
from rldrill.solutions.sheet.bellman import FORGOT_GAMMA
from rldrill.solutions.sheet.temporal_difference import TARGET_FOR_VALUE, TARGET_ONLY, TD_ZERO, WRONG_SIGN
from rldrill.solutions.work import Work

Values = dict[str, Value]


def solve(given: Given, work: Work) -> None:
    """One update for every transition."""
    _learn(given, work, lambda _start, values: values)


def _learn(given: Given, work: Work, seen_of: Callable[[Values, Values], Values]) -> None:
    """Every update reads what ``seen_of`` makes of the values before the run and those of its time."""
    start = values = {s: exact(value) for s, value in given.values.items()} | dict.fromkeys(given.terminal, ZERO)
    known = {"alpha": exact(given.alpha), "gamma": exact(given.gamma)}
    errors: list[Value] = []
    for seen in knowns.moves(given):
        current = seen_of(start, values)
        if given.td_errors:
            from rldrill.solutions.sheet.policy_gradient import TD_ERROR  # most problems need nothing of that section

            errors.append(work.step(TD_ERROR, V=current, **seen, **known))
        values = values | {seen["S"][seen["t"]]: work.step(TD_ZERO, V=current, **seen, **known)}
    if given.td_errors:
        work.answer(tuple(errors) if len(errors) > 1 else errors[0])
        work.say("The updates above give these values.")
    if isinstance(given, AlongRun) and given.known is not None:
        find_and_finish(given, work, values)
    else:
        work.answer({state: values[state] for state in given.visited})


@slip(
    "stale-values",
    "Each update uses the values that are current then, changed ones included; the old ones were kept.",
    when=lambda given: len(given.moves) > len(given.visited),
)
def stale(given: Given, work: Work) -> None:
    """Every update from the values before the run; of a state's updates the last one stands."""
    _learn(given, work, lambda start, _values: start)


MISCONCEPTIONS = (FORGOT_GAMMA, stale, TARGET_ONLY, WRONG_SIGN, TARGET_FOR_VALUE.where_it_shows())


def oracle(given: Given) -> Answers:
    """The update as a weighted mean of old value and target, on a plain dictionary of floats."""
    if isinstance(given, AlongRun) and given.known is not None:
        return found_and_finished(given, lambda trial: oracle(trial)[-1])
    values = {state: at(number) for state, number in given.values.items()} | dict.fromkeys(given.terminal, 0.0)
    errors = []
    for state, after, reward in given.moves:
        target = at(reward) + at(given.gamma) * values[after]
        errors.append(target - values[state])
        values[state] = (1 - at(given.alpha)) * values[state] + at(given.alpha) * target
    answers = ([values[state] for state in given.visited],)
    return (errors if len(errors) > 1 else errors[0], *answers) if given.td_errors else answers
