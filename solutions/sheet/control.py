"""Section 5 of the sheet: TD control."""

from sympy import evaluate

from rldrill.solutions.formula.formula import Formula, misread
from rldrill.solutions.formula.notation import A, Actions, MaxOver, MeanOver, Q, S, a, alpha, gamma, r, t

with evaluate(False):
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
