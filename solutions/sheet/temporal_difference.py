"""Section 4 of the sheet: temporal difference learning."""

from sympy import evaluate

from rldrill.solutions.formula.formula import Formula, misread
from rldrill.solutions.formula.notation import DOTS, Counting, Gn, S, SumOver, V, alpha, gamma, i, n, r, t

with evaluate(False):
    _REWARDS = SumOver(gamma**i * r(t + 1 + i), i, Counting(0, n - 1))

    N_STEP_RETURN = Formula(
        "n-step-return",
        Gn(t, n),
        _REWARDS + gamma**n * V(S(t + n)),
        title="n-step return",
        source="Sutton & Barto 2018, eq. 7.1",
        hint="n rewards, each discounted, then the value of the state reached after n steps, times γⁿ.",
        also=(r(t + 1) + DOTS + gamma ** (n - 1) * r(t + n) + gamma**n * V(S(t + n)),),
    )
    BOOTSTRAP_UNDISCOUNTED = misread(
        N_STEP_RETURN,
        "bootstrap-not-discounted",
        _REWARDS + V(S(t + n)),
        "The value at the end of the n steps is discounted too, by γⁿ.",
    )
    BOOTSTRAP_ONE_SHORT = misread(
        N_STEP_RETURN,
        "bootstrap-one-power-short",
        _REWARDS + gamma ** (n - 1) * V(S(t + n)),
        "The last reward has the factor γⁿ⁻¹; the value after it is one step later, so it has γⁿ.",
    )
    ONE_REWARD_TOO_MANY = misread(
        N_STEP_RETURN,
        "one-reward-too-many",
        SumOver(gamma**i * r(t + 1 + i), i, Counting(0, n)) + gamma**n * V(S(t + n)),
        "n steps earn n rewards; the next reward is already inside the value.",
    )

    TD_ZERO = Formula(
        "td-zero",
        V(S(t)),
        V(S(t)) + alpha * (r(t + 1) + gamma * V(S(t + 1)) - V(S(t))),
        title="TD(0) update",
        source="Sutton & Barto 2018, eq. 6.2",
        hint="Move the old value a step α towards the one-step target.",
        sign="←",
    )
    FORGOT_GAMMA = misread(
        TD_ZERO,
        "forgot-gamma",
        V(S(t)) + alpha * (r(t + 1) + V(S(t + 1)) - V(S(t))),
        "The value of the next state is discounted by γ.",
    )
    TARGET_ONLY = misread(
        TD_ZERO,
        "alpha-on-target-only",
        V(S(t)) + alpha * (r(t + 1) + gamma * V(S(t + 1))) - V(S(t)),
        "α multiplies the whole TD error, the old value inside it too.",
    )
    WRONG_SIGN = misread(
        TD_ZERO,
        "sign-of-td-error",
        V(S(t)) + alpha * (V(S(t)) - (r(t + 1) + gamma * V(S(t + 1)))),
        "The TD error is target minus old value, so that the value moves towards the target.",
    )
