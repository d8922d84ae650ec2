"""Section 9 of the sheet: Bayesian methods."""

from typing import Any

from sympy import evaluate

from rldrill.problems.mathematics import Script, number, variable
from rldrill.solutions.formula.formula import Formula, misread
from rldrill.solutions.formula.notation import (
    Hypotheses,
    States,
    SumOver,
    a,
    conditioned,
    h,
    h1,
    letter,
    quantity,
    s,
    s1,
    z,
)

#: What stands beside the formulas that the sheet itself does not have.
BEYOND = "Beyond the sheet."

p = quantity("p", conditioned("p"))
likelihood = quantity("likelihood", conditioned("p"))
motion = quantity("motion", conditioned("p"))
first = letter("first", Script(variable("s"), number(1)))
second = letter("second", Script(variable("s"), number(2)))


def _may_stay(given: Any) -> bool:
    """Whether some state is believed in that every action may leave as it is."""
    return any(
        chance and all(given.motion[action][state].get(state) for action in given.actions)
        for state, chance in given.belief.items()
    )


with evaluate(False):
    BAYES = Formula(
        "bayes",
        p(h, z),
        likelihood(z, h) * p(h) / SumOver(likelihood(z, h1) * p(h1), h1, Hypotheses),
        title="Bayes' rule",
        source="Thrun, Burgard & Fox 2005, eq. 2.24",
        hint="Multiply each hypothesis's probability with its likelihood, then divide by the sum of these.",
        also=(likelihood(z, h) * p(h) / p(z),),
    )
    NOT_NORMALISED = misread(
        BAYES,
        "not-normalised",
        likelihood(z, h) * p(h),
        "The posterior sums to 1: divide by p(z), the sum over all hypotheses.",
    )
    BASE_RATE_IGNORED = misread(
        BAYES,
        "base-rate-ignored",
        likelihood(z, h) / SumOver(likelihood(z, h1), h1, Hypotheses),
        "The prior counts: each likelihood is weighted with the probability of its hypothesis.",
    )
    LIKELIHOOD_FOR_POSTERIOR = misread(
        BAYES,
        "likelihood-for-posterior",
        likelihood(z, h),
        "p(z|h) is the probability of the measurement given the hypothesis, not the other way round.",
    )

    BAYES_TWO_STATES = Formula(
        "bayes-two-states",
        p(first, z),
        likelihood(z, first) * p(first) / (likelihood(z, first) * p(first) + likelihood(z, second) * p(second)),
        title="Bayes' rule for two states",
        source="Thrun, Burgard & Fox 2005, eq. 2.24, with two states",
        hint="The two products of likelihood and prior stand below the line, the one asked for above it.",
    )

    PREDICT = Formula(
        "predict",
        p(s1),
        SumOver(motion(s1, s, a) * p(s), s, States),
        title="Belief after an action",
        source="Thrun, Burgard & Fox 2005, table 4.1, line 3",
        hint="Add up over all states that the robot may come from: to have been there, times to get here.",
    )
    MOTION_TRANSPOSED = misread(
        PREDICT,
        "motion-transposed",
        SumOver(motion(s, s1, a) * p(s), s, States),
        "p(s′|s, a) leads from s to s′: add up over where the robot comes from, not over where it goes.",
    )
    MOTION_AS_LIKELIHOOD = misread(
        PREDICT,
        "motion-as-likelihood",
        motion(s1, s1, a) * p(s1) / SumOver(motion(s, s, a) * p(s), s, States),
        "An action is no measurement: nothing is weighed and normalised, probability flows from state to state.",
        when=_may_stay,
    )
