"""Monte Carlo from one episode: the returns backwards in time, then an update for every visit that counts."""

from collections.abc import Iterable, Iterator
from typing import Any

from rldrill.problems.exact import Scalar
from rldrill.problems.temporal_difference.monte_carlo import Given, OfActions, OfStates
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, Value, exact
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.reversible import find_and_finish, found_and_finished
from rldrill.solutions.sheet.control import TOWARDS_TARGET
from rldrill.solutions.sheet.fundamentals import RECURSION_UNDISCOUNTED, RETURN_RECURSIVE
from rldrill.solutions.sheet.temporal_difference import MONTE_CARLO
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """All returns first; then one update for every visit that counts, in their order."""
    _finish(given, work, _returns(given, work))


def _finish(
    given: Given,
    work: Work,
    returns: tuple[Value, ...],
    *,
    stale: bool = False,
    only: Iterable[int] | None = None,
) -> None:
    """The updates with these returns; ``stale`` ones all start from the values before the first, and ``only`` says
    at which times they are made, if not at those that count.
    """
    times = _counted(given, work) if only is None else only
    if isinstance(given, OfStates) and given.known is not None:
        find_and_finish(given, work, _updated(given, work, returns, times, stale=stale))
    elif isinstance(given, OfStates):
        work.answer(_updated(given, work, returns, times, stale=stale))
    else:
        work.answer(_updated_pairs(given, work, returns, times, stale=stale))


def _returns(given: Given, work: Work, *, early: bool = False) -> tuple[Value, ...]:
    """The returns, which are the first answer where they are asked for; ``early`` ones begin one reward too early,
    but for the first, before which nothing is earned: $r_t + γ R_t$ is $R_{t−1}$.
    """
    rewards = knowns.trajectory(given.trajectory)["r"]
    end = len(rewards)
    G = {end: ZERO}
    for time in reversed(range(end)):
        G = G | {time: work.step(RETURN_RECURSIVE, t=time, G=G, r=rewards, gamma=exact(given.gamma))}
    returns = tuple(G[max(0, time - early)] for time in range(end))
    if not given.in_parts:
        return returns
    carried = work.answer(returns if end > 1 else returns[0])
    return carried if end > 1 else (carried,)


def _updated_pairs(
    given: OfActions, work: Work, returns: tuple[Value, ...], times: Iterable[int], *, stale: bool
) -> dict[tuple[str, str], Value]:
    known = knowns.action_run(given)
    values = first = known.pop("Q")
    for time in times:
        pair = given.moves[time][:2]
        now = first if stale else values
        new = work.step(TOWARDS_TARGET, t=time, y=dict(enumerate(returns)), Q=now, **known)
        values = values | {pair: values[pair] + new - now[pair] if stale else new}
    return {pair: values[pair] for pair in given.updated}


def _updated(
    given: OfStates, work: Work, returns: tuple[Value, ...], times: Iterable[int], *, stale: bool
) -> dict[str, Value]:
    S = dict(enumerate(given.trajectory.states))
    values = first = {state: exact(value) for state, value in given.values.items()}
    for time in times:
        now = first if stale else values
        new = work.step(MONTE_CARLO, t=time, V=now, S=S, G=dict(enumerate(returns)), alpha=exact(given.alpha))
        values = values | {S[time]: values[S[time]] + new - now[S[time]] if stale else new}
    return {state: values[state] for state in given.visited}


def _counted(given: Given, work: Work) -> Iterator[int]:
    """The times of the visits that count; of the others it is said why they do not."""
    for time, visited in enumerate(given.occasions):
        if time in given.counted:
            yield time
        else:
            what = visited if isinstance(visited, str) else f"({', '.join(visited)})"
            first = given.occasions.index(visited)
            work.say(f"$t = {time}$ makes no update: the first visit to {what} was at $t = {first}$.")


def _last(given: Given) -> list[int]:
    """The times of the last visits."""
    return sorted({visited: time for time, visited in enumerate(given.occasions)}.values())


@slip(
    "last-visit",
    "The visit that counts is the first one in the episode, not the last.",
    when=lambda given: given.revisits and given.visits == "first",
)
def last_visit(given: Given, work: Work) -> None:
    """The return of the last visit for that of the first."""
    _finish(given, work, _returns(given, work), only=_last(given) if given.visits == "first" else None)


@slip(
    "other-visits",
    "First-visit Monte Carlo updates a state once in an episode, every-visit Monte Carlo once for each of its visits.",
    when=lambda given: given.revisits,
)
def other_visits(given: Given, work: Work) -> None:
    """First visits for every visit, or the other way round."""
    solve(given.model_copy(update={"visits": "every" if given.visits == "first" else "first"}), work)


@slip(
    "reward-before-the-state",
    "The reward that comes with the arrival in a state was earned before it; the return begins with the next reward.",
    when=lambda given: len(given.trajectory.rewards) > 1,
)
def reward_before(given: Given, work: Work) -> None:
    """Every return from one step earlier, and the updates with them."""
    _finish(given, work, _returns(given, work, early=True))


@slip(
    "stale-values",
    "What is updated a second time starts from the value that its first update left, not from the old one.",
)
def stale_values(given: Given, work: Work) -> None:
    """Every update moves by its share of the way from the value before the first one."""
    _finish(given, work, _returns(given, work), stale=True)


@slip(
    "mean-of-returns",
    "Every visit makes an update of its own, one after the other; the returns are not averaged first.",
    when=lambda given: given.revisits and given.visits == "every",
)
def mean_of_returns(given: Given, work: Work) -> None:
    """One update of everything visited, with the mean of its returns."""
    returns = _returns(given, work)
    own: dict[Any, list[Value]] = {}
    for visited, after in zip(given.occasions, returns, strict=True):
        own.setdefault(visited, []).append(after)
    means = tuple(sum(own[visited], ZERO) / len(own[visited]) for visited in given.occasions)
    _finish(given, work, means, only=sorted(map(given.occasions.index, own)))


MISCONCEPTIONS = (
    other_visits,
    RECURSION_UNDISCOUNTED,
    reward_before,
    stale_values.where_it_shows(),
    last_visit.where_it_shows(),
    mean_of_returns.where_it_shows(),
)


def _before(given: Given, what: Any) -> Scalar:
    match given:
        case OfStates():
            return given.values[what]
        case OfActions():
            state, action = what
            return given.values[state][action]


def oracle(given: Given) -> Answers:
    """The returns as a triangle of powers times the rewards; each value as old value and returns, weighted."""
    if isinstance(given, OfStates) and given.known is not None:
        return found_and_finished(given, lambda trial: oracle(trial)[-1])
    run, alpha = given.trajectory, at(given.alpha)
    times = np.arange(len(run.rewards))
    ahead = times[None, :] - times[:, None]
    returns = np.where(ahead >= 0, at(given.gamma) ** np.maximum(ahead, 0), 0.0) @ [at(r) for r in run.rewards]
    after = []
    for what in dict.fromkeys(given.occasions):
        own = np.array([returns[time] for time, visited in enumerate(given.occasions) if visited == what])
        own = own[:1] if given.visits == "first" else own
        weights = alpha * (1 - alpha) ** np.arange(len(own) - 1, -1, -1)
        after.append((1 - alpha) ** len(own) * at(_before(given, what)) + weights @ own)
    return (returns, after) if given.in_parts else (after,)
