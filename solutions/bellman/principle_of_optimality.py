"""Backwards from the goal: the best tail of every state from the best tails of the states after it."""

from collections.abc import Mapping, Sequence
from typing import Any

from rldrill.problems.bellman.principle_of_optimality import Given
from rldrill.problems.document import joined
from rldrill.problems.fractions import Fraction
from rldrill.solutions.exact import ZERO, NoSolution, Value, absolute, exact, is_zero, sign
from rldrill.solutions.formula.compiling import arg_max
from rldrill.solutions.formula.formula import Formula, slip
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.bellman import BEST_WAY_TO, PRINCIPLE_OF_OPTIMALITY, TAIL_LEFT_OUT
from rldrill.solutions.slips import right_answers
from rldrill.solutions.work import Work

Rewards = Mapping[tuple[str, str], Value]
Ways = Mapping[str, tuple[str, ...]]


def solve(given: Given, work: Work) -> None:
    """The best totals, then where they lead, then two best parts put together."""
    _along(given, work, given.onward)


def _along(given: Given, work: Work, ways: Ways) -> None:
    R = _rewards(given)
    work.say(f'Backwards from the goal, where $V^*("{given.goal}") = 0$:')
    values = _totals(given.goal, given.backwards, ways, R, work)
    values = {given.goal: ZERO} | work.answer({state: values[state] for state in ways})
    best = {state: _best(state, after, R, values, work) for state, after in ways.items()}
    if given.forks:
        told = joined([f"{state} → {best[state][0]}" for state in given.forks])
        work.say(f"The maxima above are reached by {told}.")
    work.say(f"An optimal path from {given.start} is {_path(given.start, best)}.")
    work.say("Each tail of it is an optimal path from where the tail begins: this is the principle of optimality.")
    if given.forks:
        work.answer({state: best[state] for state in given.forks})
    if given.through is not None:
        work.answer(_through(given, given.through, R, values, work))


def _rewards(given: Given) -> Rewards:
    return {(edge.state, edge.next): exact(edge.reward) for edge in given.edges}


def _totals(
    goal: str, before: Sequence[str], ways: Ways, R: Rewards, work: Work, formula: Formula = PRINCIPLE_OF_OPTIMALITY
) -> dict[str, Value]:
    """The best totals to the goal from those states before it that lead there."""
    values: dict[str, Value] = {goal: ZERO}
    for state in before:
        after = tuple(name for name in ways[state] if name in values)
        known: dict[str, Any] = {"successors": {state: after}, "edge_reward": R, "V": values}
        if after:
            values = values | {state: work.step(formula, s=state, **known)}
    return values


def _best(state: str, after: tuple[str, ...], R: Rewards, values: Mapping[str, Value], work: Work) -> tuple[str, ...]:
    """The next states that are best: each of them alone, in the formula, is worth most."""
    known: dict[str, Any] = {"edge_reward": R, "V": values}
    worth = [
        work.value(PRINCIPLE_OF_OPTIMALITY, s=state, towards=name, successors={state: (name,)}, **known)
        for name in after
    ]
    return arg_max(after, worth)


def _path(start: str, best: Mapping[str, tuple[str, ...]]) -> str:
    path = [start]
    while path[-1] in best:
        path.append(best[path[-1]][0])
    return " → ".join(path)


def _through(given: Given, through: str, R: Rewards, values: Mapping[str, Value], work: Work) -> Value:
    """The best way to a state, by the same formula with that state for the goal, and the best way on from it."""
    before = given.backwards[given.backwards.index(through) + 1 :]
    leading = [through]
    for state in before:
        leading += [state] * any(after in leading for after in given.onward[state])
    onwards = dict.fromkeys(after for state in leading[1:] for after in given.onward[state] if after not in leading)
    work.say(
        f"The part up to {through} must be optimal. $W(s)$ is the greatest return of a path from $s$ to {through}, "
        f'so $W("{through}") = 0$, and from there it goes backwards as before'
        f"{f', without the edges to {joined([*onwards])}, from where no path leads to {through}' if onwards else ''}:"
    )
    there = _totals(through, before, given.onward, R, work, BEST_WAY_TO)
    total = there[given.start] + values[through]
    onward = f"{'−' if sign(values[through]) < 0 else '+'} {absolute(values[through])}"
    sum_ = f"{there[given.start]} {onward} = {total}".replace("-", "−")
    work.say(f'Both parts together: $W("{given.start}") + V^*("{through}") = {sum_}$.')
    return total


@slip(
    "greedy-path",
    "The way that earns most at once need not begin the best path: what can be earned after it counts too.",
)
def greedy(given: Given, work: Work) -> None:
    """From every state only the way that earns most at once."""
    _along(given, work, _earning_most(given))


def _earning_most(given: Given) -> Ways:
    """From every state the way that earns most at once."""
    R = _rewards(given)
    return {s: arg_max(after, [R[s, name] for name in after])[:1] for s, after in given.onward.items()}


@slip(
    "greedy-first-step",
    "The first step that earns most at once need not be the best one: what can be earned after it counts too.",
)
def greedy_first(given: Given, work: Work) -> None:
    """From the start the way that earns most at once, and only there, although it is not the best elsewhere, too."""
    R, most = _rewards(given), _earning_most(given)
    values = _totals(given.goal, given.backwards, given.onward, R, Work())
    wrong = [
        state for state, after in given.onward.items() if most[state][0] not in _best(state, after, R, values, work)
    ]
    if given.start not in wrong or len(wrong) == 1:
        raise NoSolution("it is no mistake, or the same as to go that way from every state")
    _along(given, work, {**given.onward, given.start: most[given.start]})


@slip(
    "smallest-total",
    "What the edges pay is earned, so the path with the greatest total is best; only costs are minimised.",
)
def smallest(given: Given, work: Work) -> None:
    """The smallest total for the greatest."""
    paid = tuple(edge._replace(reward=-Fraction(edge.reward)) for edge in given.edges)
    opposite = Work(carried={part: _negated(answer) for part, answer in work.carried.items()})
    solve(given.model_copy(update={"edges": paid}), opposite)
    for answer in opposite.answers.values():
        work.answer(_negated(answer))


def _negated(answer: Any) -> Any:
    """Totals with the other sign; next states as they are."""
    if isinstance(answer, Mapping):
        return {state: _negated(each) for state, each in answer.items()}
    return answer if isinstance(answer, tuple) else -answer


def _through_another(given: Given) -> bool:
    return given.through not in (None, given.start)


@slip(
    "through-ignored",
    "That is the best path of all; the path that is asked for must go through the state that is named.",
    when=_through_another,
)
def through_ignored(given: Given, work: Work) -> None:
    """Every path goes through the start."""
    solve(given.model_copy(update={"through": given.start}), work)


@slip(
    "head-left-out",
    "That is the best way on from the state that is named; the best way there earns something too.",
    when=_through_another,
)
def head_left_out(given: Given, work: Work) -> None:
    """As if the path began in the state that is named."""
    solve(given.model_copy(update={"start": given.through}), work)


@slip(
    "way-on-left-out",
    "That is the best way to the state that is named; what is earned from there to the goal counts too.",
    when=_through_another,
)
def way_on_left_out(given: Given, work: Work) -> None:
    """The path ends in the state that is named."""
    values, *between, total = right_answers(solve, given, work)
    values = work.answer(values)
    for answer in between:
        work.answer(answer)
    if is_zero(onward := values[given.through]):
        raise NoSolution("nothing is earned there")
    work.answer(total - onward)


MISCONCEPTIONS = (
    greedy,
    greedy_first,
    smallest.where_it_shows(),
    TAIL_LEFT_OUT,
    through_ignored,
    head_left_out,
    way_on_left_out,
)


def oracle(given: Given) -> Answers:
    """Every path, one by one."""
    rewards = {(edge.state, edge.next): at(edge.reward) for edge in given.edges}

    def paths(state: str) -> list[tuple[float, tuple[str, ...]]]:
        if state == given.goal:
            return [(0.0, (state,))]
        return [
            (rewards[state, after] + total, (state, *path))
            for after in given.onward[state]
            for total, path in paths(after)
        ]

    every = {state: paths(state) for state in given.onward}
    best = {state: max(total for total, _ in found) for state, found in every.items()}
    answers: list[Any] = [list(best.values())]
    if given.forks:
        answers.append(
            {
                state: {path[1] for total, path in found if abs(total - best[state]) < 1e-9}
                for state, found in every.items()
                if state in given.forks
            }
        )
    if given.through is not None:
        answers.append(max(total for total, path in every[given.start] if given.through in path))
    return answers
