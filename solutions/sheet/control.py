"""Section 5 of the sheet: TD control."""

from typing import Any

from sympy import evaluate

from rldrill.solutions.formula.formula import Formula, misread
from rldrill.solutions.formula.notation import A, Actions, MaxOver, MeanOver, Q, S, a, alpha, gamma, r, t


def _next_action_is_known_here(given: Any) -> bool:
    """Whether every action that is taken next also has a value in the state that is left."""
    run = given.trajectory
    return all(
        after in run.terminal or action in given.values[state]
        for state, after, action in zip(run.states, run.states[1:], run.actions[1:], strict=False)
    )


with evaluate(False):
    SARSA = Formula(
        "sarsa",
        Q(S(t), A(t)),
        Q(S(t), A(t)) + alpha * (r(t + 1) + gamma * Q(S(t + 1), A(t + 1)) - Q(S(t), A(t))),
        title="Sarsa",
        source="Sutton & Barto 2018, eq. 6.7",
        hint="The target takes the value of the action that is taken in the next state, best or not.",
        sign="←",
    )
    MAX_FOR_TAKEN = misread(
        SARSA,
        "max-for-action-taken",
        Q(S(t), A(t)) + alpha * (r(t + 1) + gamma * MaxOver(Q(S(t + 1), a), a, Actions(S(t + 1))) - Q(S(t), A(t))),
        "Sarsa takes the value of the action taken in the next state; the greatest is Q-learning's.",
    )
    STATE_FOR_NEXT = misread(
        SARSA,
        "state-for-next-state",
        Q(S(t), A(t)) + alpha * (r(t + 1) + gamma * Q(S(t), A(t + 1)) - Q(S(t), A(t))),
        "The next action is valued in the next state s′, where it is taken, not in the state that is left.",
        when=_next_action_is_known_here,
    )
    SARSA_FORGOT_GAMMA = misread(
        SARSA,
        "forgot-gamma",
        Q(S(t), A(t)) + alpha * (r(t + 1) + Q(S(t + 1), A(t + 1)) - Q(S(t), A(t))),
        "The value of the next pair of state and action is discounted by γ.",
    )

    Q_LEARNING = Formula(
        "q-learning",
        Q(S(t), A(t)),
        Q(S(t), A(t)) + alpha * (r(t + 1) + gamma * MaxOver(Q(S(t + 1), a), a, Actions(S(t + 1))) - Q(S(t), A(t))),
        title="Q-learning",
        source="Sutton & Barto 2018, eq. 6.8",
        hint="The target takes the best action value of the next state, whatever is done there.",
        sign="←",
    )
    TAKEN_FOR_MAX = misread(
        Q_LEARNING,
        "action-taken-for-max",
        Q(S(t), A(t)) + alpha * (r(t + 1) + gamma * Q(S(t + 1), A(t + 1)) - Q(S(t), A(t))),
        "Q-learning takes the greatest action value of the next state; the action taken there is Sarsa's.",
        when=lambda given: given.last_action_known,
    )
    MEAN_FOR_MAX = misread(
        Q_LEARNING,
        "mean-for-max",
        Q(S(t), A(t)) + alpha * (r(t + 1) + gamma * MeanOver(Q(S(t + 1), a), a, Actions(S(t + 1))) - Q(S(t), A(t))),
        "Q-learning takes the greatest action value of the next state, not the mean.",
    )
    FORGOT_GAMMA = misread(
        Q_LEARNING,
        "forgot-gamma",
        Q(S(t), A(t)) + alpha * (r(t + 1) + MaxOver(Q(S(t + 1), a), a, Actions(S(t + 1))) - Q(S(t), A(t))),
        "The value of the next state is discounted by γ.",
    )
