"""Section 3 of the sheet: dynamic programming."""

from sympy import evaluate

from rldrill.solutions.formula.formula import Formula, misread
from rldrill.solutions.formula.notation import Actions, ArgMaxOver, MaxOver, MeanOver, V, a, pi, s
from rldrill.solutions.sheet.bellman import LOOKAHEAD, WITHOUT_GAMMA

with evaluate(False):
    VALUE_ITERATION = Formula(
        "value-iteration",
        V(s),
        MaxOver(LOOKAHEAD, a, Actions(s)),
        title="Value iteration",
        source="Sutton & Barto 2018, eq. 4.10",
        hint="For every state: work out each action's average with the old values, and keep the greatest.",
        sign="←",
    )
    MEAN_FOR_MAX = misread(
        VALUE_ITERATION,
        "mean-for-max",
        MeanOver(LOOKAHEAD, a, Actions(s)),
        "Value iteration keeps the best action's value; it does not average over the actions.",
    )
    FORGOT_GAMMA = misread(
        VALUE_ITERATION,
        "forgot-gamma",
        MaxOver(WITHOUT_GAMMA, a, Actions(s)),
        "The value of the next state is discounted by γ.",
    )

    GREEDY_FROM_V = Formula(
        "greedy-from-v",
        pi(s),
        ArgMaxOver(LOOKAHEAD, a, Actions(s)),
        title="Optimal policy given V",
        source="Sutton & Barto 2018, eq. 4.9",
        hint="Take the action whose average of reward plus γ times the next value is greatest.",
    )
