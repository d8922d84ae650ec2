"""Section 2 of the sheet: the Bellman equations."""

from sympy import evaluate

from rldrill.solutions.formula.formula import Formula, misread
from rldrill.solutions.formula.notation import (
    Actions,
    MaxOver,
    P,
    Qpi,
    Qstar,
    R,
    States,
    Successors,
    SumOver,
    V,
    Vpi,
    Vstar,
    a,
    a1,
    gamma,
    pi,
    s,
    s1,
)

with evaluate(False):
    #: What one action earns on average, and the ways to get it wrong; shared by all backups.
    LOOKAHEAD = SumOver(P(s, a, s1) * (R(s, a, s1) + gamma * V(s1)), s1, Successors(s, a))
    LOOKAHEAD_PI = SumOver(P(s, a, s1) * (R(s, a, s1) + gamma * Vpi(s1)), s1, Successors(s, a))
    LOOKAHEAD_STAR = SumOver(P(s, a, s1) * (R(s, a, s1) + gamma * Vstar(s1)), s1, Successors(s, a))
    WITHOUT_GAMMA = SumOver(P(s, a, s1) * (R(s, a, s1) + V(s1)), s1, Successors(s, a))
    GAMMA_ON_REWARD = SumOver(P(s, a, s1) * (gamma * (R(s, a, s1) + V(s1))), s1, Successors(s, a))

    BELLMAN_V = Formula(
        "bellman-v",
        Vpi(s),
        SumOver(pi(a, s) * LOOKAHEAD_PI, a, Actions(s)),
        title="Bellman equation for V",
        source="Sutton & Barto 2018, eq. 3.14",
        hint="Average over the actions, then over where each leads: reward plus γ times the value there.",
    )
    FORGOT_POLICY = misread(
        BELLMAN_V,
        "forgot-policy",
        SumOver(LOOKAHEAD_PI, a, Actions(s)),
        "Each action counts with the probability π(a|s) with which the policy takes it.",
    )
    DISCOUNTED_REWARD = misread(
        BELLMAN_V,
        "gamma-on-reward",
        SumOver(pi(a, s) * GAMMA_ON_REWARD, a, Actions(s)),
        "γ discounts the value of the next state only, not the reward on the way there.",
    )
    FORGOT_GAMMA = misread(
        BELLMAN_V,
        "forgot-gamma",
        SumOver(pi(a, s) * WITHOUT_GAMMA, a, Actions(s)),
        "The value of the next state is discounted by γ.",
    )
    MAX_FOR_MEAN = misread(
        BELLMAN_V,
        "max-for-mean",
        MaxOver(LOOKAHEAD_PI, a, Actions(s)),
        "The value of a policy averages over its actions; only the optimal value takes the maximum.",
    )
    TRANSPOSED = misread(
        BELLMAN_V,
        "transposed-model",
        SumOver(pi(a, s) * SumOver(P(s1, a, s) * (R(s1, a, s) + gamma * Vpi(s1)), s1, States), a, Actions(s)),
        "P is the probability to go from s to s′; it was read from s′ to s.",
    )

    BELLMAN_Q = Formula(
        "bellman-q",
        Qpi(s, a),
        LOOKAHEAD_PI,
        title="Bellman equation for Q",
        source="Sutton & Barto 2018, exercise 3.13",
        hint="The action is fixed: average only over where it leads.",
    )
    V_FROM_Q = Formula(
        "v-from-q",
        Vpi(s),
        SumOver(pi(a, s) * Qpi(s, a), a, Actions(s)),
        title="V from Q",
        source="Sutton & Barto 2018, exercise 3.12",
        hint="Average the action values with the policy's probabilities.",
    )
    BELLMAN_OPTIMALITY_V = Formula(
        "bellman-optimality-v",
        Vstar(s),
        MaxOver(LOOKAHEAD_STAR, a, Actions(s)),
        title="Bellman optimality equation for V",
        source="Sutton & Barto 2018, eq. 3.19",
        hint="Take the best action: the greatest of the actions' averages.",
        also=(MaxOver(Qstar(s, a), a, Actions(s)),),
    )
    BELLMAN_OPTIMALITY_Q = Formula(
        "bellman-optimality-q",
        Qstar(s, a),
        SumOver(
            P(s, a, s1) * (R(s, a, s1) + gamma * MaxOver(Qstar(s1, a1), a1, Actions(s1))),
            s1,
            Successors(s, a),
        ),
        title="Bellman optimality equation for Q",
        source="Sutton & Barto 2018, eq. 3.20",
        hint="The first action is fixed; from the next state on the best action is taken.",
        note="It conditions on the state and on the action.",
    )
