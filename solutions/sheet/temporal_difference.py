"""Section 4 of the sheet: temporal difference learning."""

from collections.abc import Callable
from functools import cache
from typing import Any

from msgspec.structs import replace
from sympy import Pow, evaluate

from rldrill.problems.mathematics import Fence, Script, variable
from rldrill.solutions.formula.formula import Formula, Misconception, Place
from rldrill.solutions.formula.notation import (
    DOTS,
    INFINITY,
    Cases,
    Counting,
    G,
    Gn,
    S,
    SumOver,
    T,
    V,
    Visited,
    alpha,
    called,
    gamma,
    gammas,
    i,
    lam,
    letter,
    n,
    quantity,
    r,
    s,
    subscripted,
    t,
)
from rldrill.solutions.sheet.bellman import FORGOT_GAMMA, OWN_VALUE_DISCOUNTED
from rldrill.solutions.sheet.fundamentals import FIRST_DISCOUNTED, LINEAR_DISCOUNT, STEP_UNDISCOUNTED, UNDISCOUNTED

#: The λ-return, TD errors, eligibility traces, the count of visits, the visits and the weights of their returns.
Glam = quantity("Glam", lambda below: Script(variable("R"), below, Fence(variable("λ"))))
delta = quantity("delta", subscripted("δ"))
e = quantity("e", called("e"))
N = quantity("count", called("n"))
Visits = quantity("visits", called("T"))
Vn = quantity("Vn", subscripted("V"))
w = quantity("w", subscripted("w"))
#: The return after a visit that has no time.
observed = letter("observed", "R")


def _given(letter: str) -> Callable[[Any], bool]:
    """Whether a letter is not what is asked for: who forgets it has an equation that says nothing of it."""
    return lambda given: getattr(given, "known", None) is None or given.letter != letter


with evaluate(False):
    FORGOT_ALPHA = Misconception(
        "forgot-alpha", "The value moves only a step α towards the λ-return; without α it is replaced by it."
    )
    NOT_SUBTRACTED = Misconception(
        "old-value-not-subtracted",
        "α multiplies the difference between the λ-return and the old value, so the old value is subtracted in it.",
    )
    NOT_KEPT = Misconception("old-value-not-kept", "What α multiplies is the change: it is added to the old value.")
    TD_LAMBDA = Formula(
        "td-lambda",
        V(S(t)),
        V(S(t)) + alpha * (Glam(t) - V(S(t))),
        title="TD(λ) update, forward view",
        source="Sutton & Barto 2018, eq. 12.4, for a table",
        hint="Move the old value a step α towards the λ-return.",
        sign="←",
        misread={
            FORGOT_ALPHA: V(S(t)) + (Glam(t) - V(S(t))),
            NOT_SUBTRACTED: V(S(t)) + alpha * Glam(t),
            NOT_KEPT: alpha * (Glam(t) - V(S(t))),
        },
    )

    _WEIGHTED = SumOver(lam ** (n - 1) * Gn(t, n), n, Counting(1, T - t - 1))
    _CLOSING = lam ** (T - t - 1) * G(t)

    FORGOT_ONE_MINUS_LAMBDA = Misconception(
        "forgot-one-minus-lambda", "The factor 1 − λ makes the weights sum to 1.", when=lambda given: given.bootstraps
    )
    FORGOT_CLOSING = Misconception(
        "closing-return-left-out", "The sum does not stop before the end: the full return has the weight λᵀ⁻ᵗ⁻¹."
    )
    CLOSING_LIKE_OTHERS = Misconception(
        "closing-weight-forgotten",
        "The full return stands for all longer n-step returns too, so its weight is λᵀ⁻ᵗ⁻¹ without the factor 1 − λ.",
    )
    #: The same where a run is cut off, and the longest n-step return takes the place of the full one.
    FORGOT_LONGEST = Misconception(
        "longest-return-left-out",
        "The sum does not stop before the end: the longest n-step return has the weight λᵀ⁻ᵗ⁻¹.",
    )
    LONGEST_LIKE_OTHERS = Misconception(
        "longest-weight-forgotten",
        "The longest n-step return gets all the weight that is left: its weight is λᵀ⁻ᵗ⁻¹ without the factor 1 − λ.",
    )
    POWER_ONE_LATE = Misconception(
        "power-one-late",
        "The n-step return has the power λⁿ⁻¹: the one-step return is not weakened by λ.",
        when=lambda given: given.bootstraps,
    )
    LAMBDA_EXCHANGED = Misconception(
        "lambda-exchanged",
        "λ and 1 − λ are exchanged: the n-step return has the weight (1 − λ)λⁿ⁻¹.",
        when=lambda given: given.bootstraps,
    )
    AVERAGED_ALIKE = Misconception(
        "averaged-alike",
        "The returns do not all count alike: the n-step return has the weight (1 − λ)λⁿ⁻¹.",
        when=lambda given: given.bootstraps,
    )
    _EXCHANGED = lam * SumOver((1 - lam) ** (n - 1) * Gn(t, n), n, Counting(1, T - t - 1))
    _ALL_OF_THEM = SumOver(Gn(t, n), n, Counting(1, T - t - 1))
    _CLOSING_CUT_OFF = lam ** (T - t - 1) * Gn(t, T - t)
    LAMBDA_RETURN_CUT_OFF = Formula(
        "lambda-return-cut-off",
        Glam(t),
        (1 - lam) * _WEIGHTED + _CLOSING_CUT_OFF,
        title="λ-return of a run that is cut off",
        source="Sutton & Barto 2018, eq. 12.9",
        hint="Weight the n-step returns with (1 − λ)λⁿ⁻¹; the longest one gets all the weight that is left.",
        place=Place.WORKING,
        misread={
            FORGOT_ONE_MINUS_LAMBDA: _WEIGHTED + _CLOSING_CUT_OFF,
            FORGOT_LONGEST: (1 - lam) * _WEIGHTED,
            LONGEST_LIKE_OTHERS: (1 - lam) * _WEIGHTED + (1 - lam) * _CLOSING_CUT_OFF,
            POWER_ONE_LATE: (1 - lam) * SumOver(lam**n * Gn(t, n), n, Counting(1, T - t - 1)) + _CLOSING_CUT_OFF,
            LAMBDA_EXCHANGED: _EXCHANGED + (1 - lam) ** (T - t - 1) * Gn(t, T - t),
            AVERAGED_ALIKE: (_ALL_OF_THEM + Gn(t, T - t)) / (T - t),
        },
    )
    LAMBDA_RETURN = Formula(
        "lambda-return",
        Glam(t),
        (1 - lam) * _WEIGHTED + _CLOSING,
        title="λ-return",
        source="Sutton & Barto 2018, eqs. 12.2 and 12.3",
        hint="Weight the n-step returns with (1 − λ)λⁿ⁻¹; the full return gets all the weight that is left.",
        also=((1 - lam) * SumOver(lam ** (n - 1) * Gn(t, n), n, Counting(1, INFINITY)),),
        note="From the end $T$ of the episode on every n-step return is the return; they weigh $λ^{T−t−1}$.",
        misread={
            FORGOT_ONE_MINUS_LAMBDA: _WEIGHTED + _CLOSING,
            FORGOT_CLOSING: (1 - lam) * _WEIGHTED,
            CLOSING_LIKE_OTHERS: (1 - lam) * _WEIGHTED + (1 - lam) * _CLOSING,
            POWER_ONE_LATE: (1 - lam) * SumOver(lam**n * Gn(t, n), n, Counting(1, T - t - 1)) + _CLOSING,
            LAMBDA_EXCHANGED: _EXCHANGED + (1 - lam) ** (T - t - 1) * G(t),
            AVERAGED_ALIKE: (_ALL_OF_THEM + G(t)) / (T - t),
        },
    )

    _REWARDS = SumOver(gamma**i * r(t + 1 + i), i, Counting(0, n - 1))

    BOOTSTRAP_UNDISCOUNTED = Misconception(
        "bootstrap-not-discounted",
        "The value at the end of the n steps is discounted too, by γⁿ.",
    )
    BOOTSTRAP_ONE_SHORT = Misconception(
        "bootstrap-one-power-short",
        "The last reward has the factor γⁿ⁻¹; the value after it is one step later, so it has γⁿ.",
    )
    ONE_REWARD_TOO_MANY = Misconception(
        "one-reward-too-many", "n steps earn n rewards; the next reward is already inside the value."
    )
    BOOTSTRAP_AT_START = Misconception(
        "bootstrap-at-start",
        "The value is that of the state that is reached after n steps, not of the one that the return starts from.",
    )
    FROM_TIME_0 = Misconception("from-time-0", "The return from time t begins with the reward rₜ₊₁, not with r₁.")
    BOOTSTRAP_ONE_STATE_SHORT = Misconception(
        "bootstrap-one-state-short",
        "After n rewards the agent is in the state sₜ₊ₙ: it is its value that counts, not that of the state before it.",
    )
    N_STEP_RETURN = Formula(
        "n-step-return",
        Gn(t, n),
        _REWARDS + gamma**n * V(S(t + n)),
        title="n-step return",
        source="Sutton & Barto 2018, eq. 7.1",
        hint="n rewards, each discounted, then the value of the state reached after n steps, times γⁿ.",
        also=(r(t + 1) + DOTS + gamma ** (n - 1) * r(t + n) + gamma**n * V(S(t + n)),),
        misread={
            BOOTSTRAP_UNDISCOUNTED: _REWARDS + V(S(t + n)),
            BOOTSTRAP_ONE_SHORT: _REWARDS + gamma ** (n - 1) * V(S(t + n)),
            ONE_REWARD_TOO_MANY: SumOver(gamma**i * r(t + 1 + i), i, Counting(0, n)) + gamma**n * V(S(t + n)),
            BOOTSTRAP_AT_START: _REWARDS + gamma**n * V(S(t)),
            BOOTSTRAP_ONE_STATE_SHORT: _REWARDS + gamma**n * V(S(t + n - 1)),
            FROM_TIME_0: SumOver(gamma**i * r(1 + i), i, Counting(0, n - 1)) + gamma**n * V(S(n)),
            UNDISCOUNTED: SumOver(r(t + 1 + i), i, Counting(0, n - 1)) + V(S(t + n)),
            FIRST_DISCOUNTED: gamma * _REWARDS + gamma ** (n + 1) * V(S(t + n)),
            LINEAR_DISCOUNT: SumOver(gamma * i * r(t + 1 + i), i, Counting(0, n - 1)) + gamma * n * V(S(t + n)),
        },
    )

    N_STEP_RETURN_STEP_BY_STEP = Formula(
        "n-step-return-step-by-step",
        Gn(t, n),
        r(t + 1) + gammas(t + 1) * Gn(t + 1, n - 1),
        title="n-step return with a discount for every step",
        source="Sutton & Barto 2018, eqs. 7.1 and 17.1",
        hint="Begin with the value of the state reached after n steps, and go back in time, step by step.",
        place=Place.WORKING,
        misread={
            STEP_UNDISCOUNTED: r(t + 1) + Gn(t + 1, n - 1),
        },
    )

    _DECAYED = gamma * lam * e(s)
    _VISIT = Visited(s, S(t))

    DECAY_WITHOUT_GAMMA = Misconception("decay-without-gamma", "Traces decay by γλ, not by λ alone.")
    DECAY_WITHOUT_LAMBDA = Misconception("decay-without-lambda", "Traces decay by γλ, not by γ alone.")
    REPLACING = Misconception(
        "replacing-trace",
        "Accumulating traces add 1 to what is left of the trace; only replacing traces are set to 1.",
        when=lambda given: len(set(given.states)) < len(given.states),
    )
    INCREMENT_FIRST = Misconception(
        "increment-before-decay", "The trace decays first, and 1 is added after that: the newest visit counts in full."
    )
    VISITED_DOES_NOT_DECAY = Misconception(
        "visited-does-not-decay", "Every trace decays at every time, that of the visited state too; then 1 is added."
    )
    ELIGIBILITY_TRACE = Formula(
        "eligibility-trace",
        e(s),
        _DECAYED + _VISIT,
        title="Eligibility trace",
        source="Sutton & Barto 2018, eq. 12.5, for a table",
        hint="Every trace decays by γλ; then that of the visited state grows by 1.",
        sign="←",
        misread={
            DECAY_WITHOUT_GAMMA: lam * e(s) + _VISIT,
            DECAY_WITHOUT_LAMBDA: gamma * e(s) + _VISIT,
            REPLACING: _DECAYED * (1 - _VISIT) + _VISIT,
            INCREMENT_FIRST: gamma * lam * (e(s) + _VISIT),
            VISITED_DOES_NOT_DECAY: Cases(_VISIT, e(s) + 1, _DECAYED),
        },
    )

    ACCUMULATING = Misconception(
        "accumulating-trace",
        "A replacing trace is set to 1 at a visit; only accumulating traces add 1 to what is left.",
    )
    REPLACING_TRACE = Formula(
        "replacing-trace",
        e(s),
        Cases(_VISIT, 1, _DECAYED),
        title="Replacing eligibility trace",
        source="Sutton & Barto 1998, eq. 7.13",
        hint="The trace of the visited state is set to 1; every other one decays by γλ.",
        sign="←",
        place=Place.WORKING,
        misread={
            ACCUMULATING: _DECAYED + _VISIT,
            DECAY_WITHOUT_GAMMA: Cases(_VISIT, 1, lam * e(s)),
            DECAY_WITHOUT_LAMBDA: Cases(_VISIT, 1, gamma * e(s)),
        },
    )

    LITERAL_VALUE = Misconception(
        "own-value-in-td-error",
        "The TD error belongs to the transition: the value subtracted in it is that of the state that was left.",
        when=lambda given: len(given.visited) > 1 and _given("alpha")(given),
    )
    TD_LAMBDA_BACKWARD = Formula(
        "td-lambda-backward",
        V(s),
        V(s) + alpha * e(s) * (r(t + 1) + gamma * V(S(t + 1)) - V(S(t))),
        title="TD(λ) update, backward view",
        source="Sutton & Barto 2018, eqs. 12.6 and 12.7, for a table",
        hint="One TD error, that of the transition, goes to every state in proportion to its trace.",
        sign="←",
        note="For all $s$. Some sheets print $V(s)$ inside the TD error; it belongs to the state that was left, $s_t$.",
    )
    TD_LAMBDA_BY_ERROR = Formula(
        "td-lambda-by-error",
        V(s),
        V(s) + alpha * delta(t) * e(s),
        title="TD(λ) update by the TD error",
        source="Sutton & Barto 2018, eqs. 12.6 and 12.7, for a table",
        hint="The TD error is worked out once, with the values before the transition; every state takes its share.",
        sign="←",
        place=Place.WORKING,
        misread={
            LITERAL_VALUE: V(s) + alpha * e(s) * (r(t + 1) + gamma * V(S(t + 1)) - V(s)),
        },
    )

    TARGET_ONLY = Misconception("alpha-on-target-only", "α multiplies the whole TD error, the old value inside it too.")
    WRONG_SIGN = Misconception(
        "sign-of-td-error", "The TD error is target minus old value, so that the value moves towards the target."
    )
    TARGET_FOR_VALUE = Misconception(
        "target-for-value",
        "The target is not the new value: the old value moves only the step α of the way to it.",
        when=_given("alpha"),
    )
    TD_ZERO = Formula(
        "td-zero",
        V(S(t)),
        V(S(t)) + alpha * (r(t + 1) + gamma * V(S(t + 1)) - V(S(t))),
        title="TD(0) update",
        source="Sutton & Barto 2018, eq. 6.2",
        hint="Move the old value a step α towards the one-step target.",
        sign="←",
        misread={
            FORGOT_GAMMA: V(S(t)) + alpha * (r(t + 1) + V(S(t + 1)) - V(S(t))),
            TARGET_ONLY: V(S(t)) + alpha * (r(t + 1) + gamma * V(S(t + 1))) - V(S(t)),
            WRONG_SIGN: V(S(t)) + alpha * (V(S(t)) - (r(t + 1) + gamma * V(S(t + 1)))),
            TARGET_FOR_VALUE: r(t + 1) + gamma * V(S(t + 1)),
            OWN_VALUE_DISCOUNTED: V(S(t)) + alpha * (r(t + 1) + V(S(t + 1)) - gamma * V(S(t))),
        },
    )

    MONTE_CARLO = Formula(
        "monte-carlo",
        V(S(t)),
        V(S(t)) + alpha * (G(t) - V(S(t))),
        title="Monte Carlo update",
        source="Sutton & Barto 2018, eq. 6.1",
        hint="Work out the return after the visit, then move the old value a step α towards it.",
        sign="←",
    )

    VISIT_COUNT = Formula(
        "visit-count",
        N(S(t)),
        N(S(t)) + 1,
        title="Number of visits",
        source="Sutton & Barto 2018, section 2.4",
        hint="Count the visit before it is averaged in.",
        sign="←",
        place=Place.WORKING,
    )
    NOT_COUNTED = Misconception(
        "one-over-n-minus-1",
        "The visit that is being averaged in counts too: divide by n(s) after it.",
        when=lambda given: given.visited_before,
    )
    COUNTED_TWICE = Misconception("one-over-n-plus-1", "n(s) counts this visit already, so nothing is added to it.")
    MEAN_OF_TWO = Misconception(
        "mean-of-old-and-new",
        "The old value stands for all returns before; the new one counts 1/n(s), 1/2 only at the second visit.",
    )
    OLD_MEAN_ONCE = Misconception(
        "old-mean-counted-once",
        "The old value stands for all n(s) − 1 returns before, so it counts n(s) − 1 times before everything is "
        "divided by n(s).",
    )
    SUM_NOT_DIVIDED = Misconception(
        "sum-not-divided", "An average is the sum of all returns divided by their number: divide by n(s)."
    )
    NEW_RETURN_NOT_COUNTED = Misconception(
        "new-return-not-counted",
        "The new return is one of those that are averaged: the sum of all is divided by n(s), this visit included.",
        when=lambda given: given.visited_before,
    )
    SAMPLE_AVERAGE = Formula(
        "sample-average",
        V(S(t)),
        V(S(t)) + Pow(N(S(t)), -1) * (G(t) - V(S(t))),
        title="Sample average",
        source="Sutton & Barto 2018, eq. 2.3",
        hint="Count the visit first; then the step size is one over the number of visits.",
        sign="←",
        note="The Monte Carlo update with $α = 1/n(s)$; $n(s)$ counts the visits of $s$, this one included.",
        misread={
            NOT_COUNTED: V(S(t)) + Pow(N(S(t)) - 1, -1) * (G(t) - V(S(t))),
            COUNTED_TWICE: V(S(t)) + Pow(N(S(t)) + 1, -1) * (G(t) - V(S(t))),
            MEAN_OF_TWO: (V(S(t)) + G(t)) * Pow(2, -1),
            OLD_MEAN_ONCE: (V(S(t)) + G(t)) / N(S(t)),
            SUM_NOT_DIVIDED: (N(S(t)) - 1) * V(S(t)) + G(t),
            NEW_RETURN_NOT_COUNTED: ((N(S(t)) - 1) * V(S(t)) + G(t)) / (N(S(t)) - 1),
        },
    )

    OLDEST_FIRST = Misconception(
        "weights-reversed",
        "The newest return has the greatest weight, α; the older one is, the more often it was weakened by 1 − α.",
        when=lambda given: len(given.visits) > 1,
    )
    ONE_POWER_MORE = Misconception(
        "weakened-once-too-often", "The newest return has not been weakened yet: its weight is α."
    )
    EQUAL_WEIGHTS = Misconception(
        "equal-weights", "Only the sample average weights all returns alike; a constant step size favours the newest."
    )
    RECENCY_WEIGHT = Formula(
        "recency-weight",
        w(i),
        alpha * (1 - alpha) ** (n - i),
        title="Weight of the i-th of n returns",
        source="Sutton & Barto 2018, eq. 2.6",
        hint="A return enters with weight α, and every later return weakens it by the factor 1 − α.",
        place=Place.WORKING,
        misread={
            OLDEST_FIRST: alpha * (1 - alpha) ** (i - 1),
            ONE_POWER_MORE: alpha * (1 - alpha) ** (n - i + 1),
            EQUAL_WEIGHTS: Pow(n, -1),
        },
    )

    START_FORGOTTEN = Misconception(
        "first-value-forgotten",
        "With a constant step size the first value never leaves the average: its weight is (1 − α)ⁿ.",
    )
    CONSTANT_STEP_SIZE = Formula(
        "constant-step-size",
        Vn(n),
        (1 - alpha) ** n * Vn(0) + SumOver(w(i) * G(i), i, Counting(1, n)),
        title="Constant step size, after n updates",
        source="Sutton & Barto 2018, eq. 2.6",
        hint="Weight every return, and the first value with what is left: (1 − α)ⁿ.",
        also=((1 - alpha) ** n * Vn(0) + SumOver(alpha * (1 - alpha) ** (n - i) * G(i), i, Counting(1, n)),),
        place=Place.BEYOND,
        hidden=True,
        misread={
            START_FORGOTTEN: SumOver(w(i) * G(i), i, Counting(1, n)),
        },
    )

    BATCH_MONTE_CARLO = Formula(
        "batch-monte-carlo",
        V(s),
        Pow(N(s), -1) * SumOver(G(t), t, Visits(s)),
        title="Batch Monte Carlo",
        source="Sutton & Barto 2018, section 6.3",
        hint="Average the returns that were seen after all visits of the state.",
        note="The sum runs over the times with $s_t = s$.",
        place=Place.BEYOND,
    )
    BATCH_TD = Formula(
        "batch-td",
        V(s),
        Pow(N(s), -1) * SumOver(r(t + 1) + gamma * V(S(t + 1)), t, Visits(s)),
        title="Batch TD(0)",
        source="Sutton & Barto 2018, section 6.3",
        hint="Average the one-step targets after all visits of the state; begin with states that only lead to the end.",
        note="These are the values of the most likely Markov process behind the data (the certainty equivalence).",
        place=Place.BEYOND,
        misread={
            FORGOT_GAMMA: Pow(N(s), -1) * SumOver(r(t + 1) + V(S(t + 1)), t, Visits(s)),
        },
    )


@cache
def of_a_visit(formula: Formula) -> Formula:
    """A formula for the visit to s, after which the return is R, where visits have no times."""
    plain = {S(t): s, G(t): observed}
    with evaluate(False):
        return replace(
            formula,
            left=formula.left.xreplace(plain),
            right=formula.right.xreplace(plain),
            misread={mistake: right.xreplace(plain) for mistake, right in formula.misread.items()},
        )
