"""Section 9 of the sheet: Bayesian methods."""

from sympy import evaluate

from rldrill.solutions.formula.formula import Formula, misread
from rldrill.solutions.formula.notation import Hypotheses, SumOver, conditioned, h, h1, quantity, z

p = quantity("p", conditioned("p"))
likelihood = quantity("likelihood", conditioned("p"))

with evaluate(False):
    BAYES = Formula(
        "bayes",
        p(h, z),
        likelihood(z, h) * p(h) / SumOver(likelihood(z, h1) * p(h1), h1, Hypotheses),
        title="Bayes' rule",
        source="Thrun, Burgard & Fox 2005, eq. 2.24",
        hint="Multiply each hypothesis's probability with its likelihood, then divide by the sum of these.",
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
