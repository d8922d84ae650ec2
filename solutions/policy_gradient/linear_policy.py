"""The value of every action, then the action with the greatest."""

from collections.abc import Mapping
from typing import Any

from rldrill.problems.exact import Parameter, needed
from rldrill.problems.policy_gradient.linear_policy import Given
from rldrill.solutions.exact import Value, equals, exact, sign, told
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.greedy import greedy
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.rational import linear
from rldrill.solutions.sheet.policy_gradient import LINEAR_ACTION_VALUE, LINEAR_POLICY, WEIGHTS_FORGOTTEN
from rldrill.solutions.slips import right_answers
from rldrill.solutions.softmax import action_features, by_number
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """All values, then the greedy policy for them; with w open, where two values are equal comes first."""
    known = by_number([exact(weight) for weight in given.theta]) | action_features(given.features)
    if given.at is None:
        _greedy(given, work, work.answer(_values(given, work, known)))
        return
    edges, gains = {}, {}
    for state, row in given.features.items():
        first, second = (work.step(LINEAR_ACTION_VALUE, s=state, a=action, **known) for action in row)
        work.say(f"In {state} the two are equal where")
        edges[state] = work.equate("w", first, second)
        gains[state] = linear(first - second, "w")[0]
    _by_the_edges(given, work, work.answer(edges), gains)


def _by_the_edges(given: Given, work: Work, edges: Mapping[str, Value], gains: Mapping[str, Value]) -> None:
    """The greedy policy at a weight, from the weight of equal values in every state and the side of it."""
    work.recall(LINEAR_POLICY)
    weight, best = exact(needed(given.at)), {}
    for state, edge in edges.items():
        rows = tuple(given.features[state])
        behind, ahead = rows if sign(gains[state]) < 0 else rows[::-1]
        place = sign(weight - edge)
        here, found = f"In {state}, $w {equals(weight)}$", f"${told(edge)}$"
        if place > 0:
            work.say(f"{here} is above {found}, where {ahead} is greedy: as $w$ grows, it gains on {behind}.")
        elif place < 0:
            work.say(f"{here} is below {found}, where {behind} is greedy: as $w$ grows, {ahead} gains on it.")
        else:
            work.say(f"{here}, where both actions have the same value: both are greedy.")
        best[state] = (ahead,) if place > 0 else (behind,) if place < 0 else rows
    work.answer(best)


def _values(given: Given, work: Work, known: Mapping[str, Any]) -> dict[tuple[str, str], Value]:
    pairs = ((state, action) for state, row in given.features.items() for action in row)
    return {(s, a): work.step(LINEAR_ACTION_VALUE, s=s, a=a, **known) for s, a in pairs}


def _greedy(given: Given, work: Work, values: Mapping[tuple[str, str], Value]) -> None:
    actions = {state: tuple(row) for state, row in given.features.items()}
    best = {state: work.step(LINEAR_POLICY, s=state, Qhat=values, actions=actions) for state in actions}
    for state, row in best.items():
        work.say(f"In {state}, {greedy(row, len(actions[state]))}.")
    work.answer(best)


@slip(
    "features-of-the-wrong-action",
    "Every action is valued with its own features f(s, a); those of another action were used.",
    when=lambda given: any(len(row) > 1 for row in given.features.values()),
)
def wrong_action(given: Given, work: Work) -> None:
    """Every action with the features in the line below, the last with those in the first."""
    below = {
        state: dict(zip((last, *others), row.values(), strict=True))
        for state, row in given.features.items()
        for *others, last in [row]
    }
    solve(given.model_copy(update={"features": below}), work)


@slip(
    "smallest-for-greatest",
    "The greedy policy takes the action with the greatest value, not with the smallest.",
    when=wrong_action.when,
)
def smallest(given: Given, work: Work) -> None:
    """Everything right but the greedy policy, which is that for the negative weights."""
    work.answer(right_answers(solve, given, work)[0])
    known = by_number([-exact(weight) for weight in given.numbers]) | action_features(given.features)
    _greedy(given, work, _values(given, work, known))


MISCONCEPTIONS = (smallest, wrong_action, WEIGHTS_FORGOTTEN)


def oracle(given: Given) -> Answers:
    """A product of a matrix with a vector in every state; lines through two points each, and where they meet."""
    theta = np.array([at(weight) for weight in given.numbers])
    tables = {s: np.array([[at(x) for x in line] for line in row.values()]) for s, row in given.features.items()}
    worth = {state: table @ theta for state, table in tables.items()}
    best = {
        state: {action for action, value in zip(given.features[state], values, strict=True)
                if value > values.max() - 1e-9}
        for state, values in worth.items()
    }  # fmt: skip
    if given.at is None:
        return (np.concatenate(list(worth.values())), best)
    opened = np.array([isinstance(weight, Parameter) for weight in given.theta])
    edges = []
    for table in tables.values():
        low, high = (np.subtract(*(table @ np.where(opened, w, theta))) for w in (0.0, 1.0))
        edges.append(low / (low - high))
    return (edges, best)
