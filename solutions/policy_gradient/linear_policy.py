"""The value of every action, then the action with the greatest."""

from collections.abc import Mapping

import numpy as np

from rldrill.problems.policy_gradient.linear_policy import Given
from rldrill.solutions.exact import Value, exact
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.policy_gradient import LINEAR_ACTION_VALUE, LINEAR_POLICY, WEIGHTS_FORGOTTEN
from rldrill.solutions.slips import right_answers
from rldrill.solutions.softmax import action_features, by_number
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """All values, then the greedy policy for them."""
    known = by_number([exact(weight) for weight in given.theta]) | action_features(given.features)
    pairs = ((state, action) for state, row in given.features.items() for action in row)
    values = work.answer({(s, a): work.step(LINEAR_ACTION_VALUE, s=s, a=a, **known) for s, a in pairs})
    _greedy(given, work, values)


def _greedy(given: Given, work: Work, values: Mapping[tuple[str, str], Value]) -> None:
    actions = {state: tuple(row) for state, row in given.features.items()}
    work.answer({state: work.step(LINEAR_POLICY, s=state, Qhat=values, actions=actions) for state in actions})


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
    """The right values, and the greedy policy for their negatives."""
    values = work.answer(right_answers(solve, given, work)[0])
    _greedy(given, work, {pair: -value for pair, value in values.items()})


MISCONCEPTIONS = (wrong_action, WEIGHTS_FORGOTTEN, smallest)


def oracle(given: Given) -> Answers:
    """A product of a matrix with a vector in every state."""
    theta = np.array([at(weight) for weight in given.theta])
    worth = {s: np.array([[at(x) for x in line] for line in row.values()]) @ theta for s, row in given.features.items()}
    best = {
        state: {action for action, value in zip(given.features[state], values, strict=True)
                if value > values.max() - 1e-9}
        for state, values in worth.items()
    }  # fmt: skip
    return (np.concatenate(list(worth.values())), best)
