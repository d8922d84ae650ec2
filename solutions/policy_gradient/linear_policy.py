"""The value of every action, then the action with the greatest."""

import numpy as np

from rldrill.problems.policy_gradient.linear_policy import Given
from rldrill.solutions.exact import exact
from rldrill.solutions.formula.formula import fork
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.policy_gradient import LINEAR_ACTION_VALUE, LINEAR_POLICY, WEIGHTS_FORGOTTEN
from rldrill.solutions.softmax import action_features, by_number
from rldrill.solutions.work import Work

WRONG_ACTION = fork(
    "features-of-the-wrong-action",
    "Every action is valued with its own features f(s, a); those of another action were used.",
    when=lambda given: any(len(row) > 1 for row in given.features.values()),
)
SMALLEST = fork(
    "smallest-for-greatest",
    "The greedy policy takes the action with the greatest value, not with the smallest.",
    when=WRONG_ACTION.when,
)
MISCONCEPTIONS = (WRONG_ACTION, WEIGHTS_FORGOTTEN, SMALLEST)


def solve(given: Given, work: Work) -> None:
    """All values, then the greedy policy for them."""
    known = by_number([exact(weight) for weight in given.theta]) | action_features(given.features)
    read = {
        (state, action): _next(action, tuple(row)) if work.makes(WRONG_ACTION) else action
        for state, row in given.features.items()
        for action in row
    }
    values = work.answer({(s, a): work.step(LINEAR_ACTION_VALUE, s=s, a=row, **known) for (s, a), row in read.items()})
    if work.makes(SMALLEST):
        values = {pair: -value for pair, value in values.items()}
    actions = {state: tuple(row) for state, row in given.features.items()}
    policy = {state: work.step(LINEAR_POLICY, s=state, Qhat=values, actions=actions) for state in actions}
    work.answer(policy)


def _next(action: str, actions: tuple[str, ...]) -> str:
    """The action in the line below, from the last the first."""
    return actions[(actions.index(action) + 1) % len(actions)]


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
