"""Monte Carlo from one episode: the returns backwards in time, then an update for every visit that counts."""

from collections.abc import Callable, Iterable, Iterator
from typing import Any, TypeAlias

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

Values = dict[Any, Value]
#: The new value of what is visited at a time, by the values that are current.
New: TypeAlias = Callable[[int, Values], Value]
#: Times, and what is visited at them.
Visits: TypeAlias = Iterable[tuple[int, Any]]


def solve(given: Given, work: Work) -> None:
    """All returns first; then one update for every visit that counts, in their order."""
    _finish(given, work, _answered(given, work, _returns(given, work)))


def _one_by_one(values: Values, visits: Visits, new: New) -> Values:
    for time, visited in visits:
        values = values | {visited: new(time, values)}
    return values


def _finish(
    given: Given,
    work: Work,
    returns: tuple[Value, ...],
    updated: Callable[[Values, Visits, New], Values] = _one_by_one,
    *,
    only: Iterable[int] | None = None,
) -> None:
    """The updates with these returns; ``only`` says at which times they are made, if not at those that count."""
    values, new = _of_states(given, work, returns) if isinstance(given, OfStates) else _of_actions(given, work, returns)
    times = _counted(given, work) if only is None else only
    values = updated(values, ((time, given.occasions[time]) for time in times), new)
    after: Values = {visited: values[visited] for visited in given.updated}
    if isinstance(given, OfStates) and given.known is not None:
        find_and_finish(given, work, after)
    else:
        work.answer(after)


def _returns(given: Given, work: Work) -> tuple[Value, ...]:
    rewards = knowns.trajectory(given.trajectory)["r"]
    end = len(rewards)
    G = {end: ZERO}
    for time in reversed(range(end)):
        G = G | {time: work.step(RETURN_RECURSIVE, t=time, G=G, r=rewards, gamma=exact(given.gamma))}
    return tuple(G[time] for time in range(end))


def _answered(given: Given, work: Work, returns: tuple[Value, ...]) -> tuple[Value, ...]:
    """The returns to go on with, which are the first answer where they are asked for."""
    if not given.in_parts:
        return returns
    several = len(returns) > 1
    carried = work.answer(returns if several else returns[0])
    return carried if several else (carried,)


def _of_states(given: OfStates, work: Work, returns: tuple[Value, ...]) -> tuple[Values, New]:
    known: dict[str, Any] = {"S": dict(enumerate(given.trajectory.states)), "G": dict(enumerate(returns))}
    known["alpha"] = exact(given.alpha)
    values = {state: exact(value) for state, value in given.values.items()}
    return values, lambda time, V: work.step(MONTE_CARLO, t=time, V=V, **known)


def _of_actions(given: OfActions, work: Work, returns: tuple[Value, ...]) -> tuple[Values, New]:
    known = knowns.action_run(given) | {"y": dict(enumerate(returns))}
    values = known.pop("Q")
    return values, lambda time, Q: work.step(TOWARDS_TARGET, t=time, Q=Q, **known)


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
    _finish(
        given,
        work,
        _answered(given, work, _returns(given, work)),
        only=_last(given) if given.visits == "first" else None,
    )


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
    """Every return from one step earlier, $r_t + γ R_t = R_{t−1}$, but for the first: nothing is earned before it."""
    first, *others = _returns(given, work)
    _finish(given, work, _answered(given, work, (first, first, *others[:-1])))


@slip(
    "stale-values",
    "What is updated a second time starts from the value that its first update left, not from the old one.",
)
def stale_values(given: Given, work: Work) -> None:
    """Every update moves by its share of the way from the value before the first one."""

    def updated(first: Values, visits: Visits, new: New) -> Values:
        values = first
        for time, visited in visits:
            values = values | {visited: values[visited] + new(time, first) - first[visited]}
        return values

    _finish(given, work, _answered(given, work, _returns(given, work)), updated)


@slip(
    "target-of-td",
    "Monte Carlo takes all rewards up to the episode's end; r + γV(s′), with a value of the table, is TD's target.",
    when=lambda given: len(given.trajectory.rewards) > 1,
)
def target_of_td(given: Given, work: Work) -> None:
    """The reward and the discounted value of what is visited next, as the table has it, for every return."""
    values = [exact(_before(given, visited)) for visited in given.occasions]
    rewards, gamma = map(exact, given.trajectory.rewards), exact(given.gamma)
    targets = tuple(r + gamma * after for r, after in zip(rewards, (*values[1:], ZERO), strict=True))
    _finish(given, work, _answered(given, work, targets))


@slip(
    "mean-of-returns",
    "Every visit makes an update of its own, one after the other; the returns are not averaged first.",
    when=lambda given: given.revisits and given.visits == "every",
)
def mean_of_returns(given: Given, work: Work) -> None:
    """One update of everything visited, with the mean of its returns."""
    returns = _answered(given, work, _returns(given, work))
    own: dict[Any, list[Value]] = {}
    for visited, after in zip(given.occasions, returns, strict=True):
        own.setdefault(visited, []).append(after)
    means = tuple(sum(own[visited], ZERO) / len(own[visited]) for visited in given.occasions)
    _finish(given, work, means, only=sorted(map(given.occasions.index, own)))


MISCONCEPTIONS = (
    other_visits,
    RECURSION_UNDISCOUNTED,
    reward_before,
    target_of_td.where_it_shows(),
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
