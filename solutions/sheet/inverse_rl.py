"""Section 10 of the sheet: inverse reinforcement learning."""

from typing import Any

from sympy import Abs, Integer, Pow, evaluate, sqrt

from rldrill.problems.mathematics import EMPTY, Accent, Fence, Math, Script, listed, name, row, variable, word
from rldrill.solutions.formula.formula import Formula, Misconception, Place
from rldrill.solutions.formula.notation import (
    INFINITY,
    Actions,
    Counting,
    Features,
    Greatest,
    MaxOver,
    MeanOver,
    P,
    SampleMean,
    States,
    Successors,
    SumOver,
    a,
    called,
    conditioned,
    gamma,
    i,
    letter,
    pi,
    quantity,
    s,
    s1,
    t,
)

_PI = variable("π")
_EXPERT = Script(_PI, variable("E"))
_MU = variable("μ")
_BAR = Accent(_MU, "bar")


def _component(head: Math, index: Math) -> Math:
    """A vector is written without an index until one of its components is put in."""
    return head if index == EMPTY else Script(head, index)


def _along(index: Math, number: Math) -> Math:
    """What belongs to a trajectory has its number above, in brackets."""
    return Script(_MU, None if index == EMPTY else index, Fence(number))


def _called(policy: Math) -> Math:
    """The expert's own policy is written as formulas write it."""
    return _EXPERT if policy == name("expert") else policy


#: The last time of a trajectory.
Last = quantity("last", called(variable("T")))
#: The component that is computed.
j = letter("component", EMPTY)
tau = letter("trajectory", "τ")
Trajectories = letter("trajectories", "D")
s_t = quantity("visited", lambda time, _: Script(variable("s"), time))
#: A trajectory by its number, how many there are, its states, and its discounted features.
run, count = letter("run", "i"), letter("runs", "m")
s_of = quantity("visited", lambda time, number: Script(variable("s"), time, Fence(number)))
mu_along = quantity("mu_along", lambda index, number: _along(index, number))
phi = quantity("phi", lambda index, state: row(_component(variable("φ"), index), Fence(state)))
mu = quantity("feature_mu", lambda index: row(_component(_MU, index), Fence(_PI)))
mu_of = quantity("mu_of", lambda index, state: row(_component(_MU, index), Fence(state)))
mu_expert = quantity("mu_expert", lambda index: row(_component(_MU, index), Fence(_EXPERT)))
mu_bar = quantity("mu_bar", lambda index: _component(_BAR, index))
mu_now = quantity("mu_now", lambda index: row(_component(_MU, index), Fence(_PI)))
w = quantity("w", lambda index: _component(variable("w"), index))
start = quantity("start_chance", conditioned("p"))
policy = letter("policy", "π")
Policies = letter("policies", "Π")
Violated = letter("violated", "Π′")
mu_policy = quantity("mu_policy", lambda index, of: row(_component(_MU, index), Fence(_called(of))))
worth = quantity("worth", lambda of: row(Script(variable("w"), above=word("T")), _MU, Fence(_called(of))))
worth_expert = letter("worth_expert", row(Script(variable("w"), above=word("T")), _MU, Fence(_EXPERT)))
margin = quantity("margin", lambda of: row(variable("m"), Fence(listed((_EXPERT, of)))))
xi = letter("xi", "ξ")
bound = quantity("bound", lambda of: row(variable("b"), Fence(of)))
step_length = letter("step_length", "c")
remaining = letter("remaining", Fence(variable("w"), "‖", "‖"))


def several_violated(given: Any) -> bool:
    """Whether more than one constraint is violated, so that a sum is more than the maximum."""
    return sum(missing > 0 for missing in given.missing.values()) > 1


with evaluate(False):
    _DISCOUNTED = SumOver(gamma**t * phi(j, s_t(t, tau)), t, Counting(0, Last(tau), INFINITY))

    FEATURES_UNDISCOUNTED = Misconception("undiscounted", "The features at time t count with γᵗ.")
    FEATURES_EARLY = Misconception(
        "gamma-one-step-early", "The features of the first state are not discounted: γ⁰ = 1."
    )
    FEATURES_SUMMED = Misconception(
        "sum-for-mean",
        "An expectation is estimated by the mean of the trajectories, not by their sum.",
        when=lambda given: len(given.trajectories) > 1,
    )
    FEATURE_EXPECTATIONS = Formula(
        "feature-expectations",
        mu(j),
        SampleMean(_DISCOUNTED, tau, Trajectories),
        title="Feature expectations",
        source="Abbeel & Ng 2004, section 2",
        hint="Discount the features of the states along every trajectory from t = 0 on, then average the trajectories.",
    )
    FEATURES_AVERAGED = Misconception(
        "averaged-along", "Along a trajectory the discounted features are added up, not averaged over its states."
    )
    FEATURES_ALONG = Formula(
        "features-along",
        mu_along(j, run),
        SumOver(gamma**t * phi(j, s_of(t, run)), t, Counting(0, Last(run), INFINITY)),
        title="Discounted features along a trajectory",
        source="Abbeel & Ng 2004, section 5: estimated from demonstrations",
        hint="Discount the features of the states from t = 0 on, and add them.",
        place=Place.WORKING,
        misread={
            FEATURES_UNDISCOUNTED: SumOver(phi(j, s_of(t, run)), t, Counting(0, Last(run), INFINITY)),
            FEATURES_EARLY: SumOver(gamma ** (t + 1) * phi(j, s_of(t, run)), t, Counting(0, Last(run), INFINITY)),
            FEATURES_AVERAGED: 1
            / (Last(run) + 1)
            * SumOver(gamma**t * phi(j, s_of(t, run)), t, Counting(0, Last(run), INFINITY)),
        },
    )
    STATES_COUNTED = Misconception(
        "states-counted",
        "Each trajectory counts once, however long it is: divide by the number of trajectories, not by that of states.",
    )
    FEATURES_ESTIMATED = Formula(
        "features-estimated",
        mu(j),
        1 / count * SumOver(mu_along(j, run), run, Trajectories),
        title="Estimate of the feature expectations",
        source="Abbeel & Ng 2004, section 5: estimated from demonstrations",
        hint="Average over the trajectories.",
        sign="≈",
        place=Place.WORKING,
        misread={
            FEATURES_SUMMED: SumOver(mu_along(j, run), run, Trajectories),
            STATES_COUNTED: 1
            / SumOver(Last(run) + 1, run, Trajectories)
            * SumOver(mu_along(j, run), run, Trajectories),
        },
    )
    START_NOT_COUNTED = Misconception(
        "start-not-counted", "The sum begins with the features of s₀ itself, undiscounted, not with those of s₁."
    )
    WAYS_TRANSPOSED = Misconception(
        "ways-transposed", "π and P give the probability to go from s to s′; it was read from s′ to s."
    )
    FEATURES_FROM = Formula(
        "feature-expectations-from",
        mu_of(j, s),
        phi(j, s)
        + gamma * SumOver(pi(a, s) * SumOver(P(s, a, s1) * mu_of(j, s1), s1, Successors(s, a)), a, Actions(s)),
        title="Feature expectations from a state",
        source="Abbeel & Ng 2004, section 2, with the Bellman equation for V",
        hint="It is a Bellman equation with the feature in place of the reward, one system for every feature.",
        place=Place.BEYOND,
        misread={
            START_NOT_COUNTED: gamma
            * SumOver(
                pi(a, s) * SumOver(P(s, a, s1) * (phi(j, s1) + mu_of(j, s1)), s1, Successors(s, a)), a, Actions(s)
            ),
            WAYS_TRANSPOSED: phi(j, s)
            + gamma * SumOver(SumOver(pi(a, s1) * P(s1, a, s), a, Actions(s1)) * mu_of(j, s1), s1, States),
        },
    )
    START_IGNORED = Misconception(
        "start-ignored",
        "Weight the states by the probabilities that an episode starts there, not equally.",
        when=lambda given: len(set(given.start_chances.values())) > 1,
    )
    FEATURES_FROM_START = Formula(
        "feature-expectations-start",
        mu(j),
        SumOver(start(s) * mu_of(j, s), s, States),
        title="Feature expectations from the start distribution",
        source="Abbeel & Ng 2004, section 2",
        hint="Average over the states in which an episode may start, with their probabilities.",
        place=Place.WORKING,
        misread={
            START_IGNORED: MeanOver(mu_of(j, s), s, States),
        },
    )

    REWARD_OF_FEATURES = Formula(
        "feature-value",
        worth(policy),
        SumOver(w(i) * mu_policy(i, policy), i, Features),
        title="Value of a policy from its feature expectations",
        source="Abbeel & Ng 2004, section 2",
        hint="With the reward wᵀφ(s) the value is the same weighted sum of the feature expectations.",
        place=Place.WORKING,
    )
    MAX_MARGIN = Formula(
        "max-margin",
        worth_expert,
        worth(policy) + margin(policy) - xi,
        title="Max-margin constraint, for all π",
        source="Ratliff, Bagnell & Zinkevich 2006",
        hint="The expert must be better than every policy by the margin, or the slack ξ has to make up for it.",
        sign="≥",
    )
    MAX_MARGIN_BOUND = Formula(
        "max-margin-bound",
        bound(policy),
        worth(policy) + margin(policy) - xi,
        title="Max-margin constraint: its right side",
        source="Ratliff, Bagnell & Zinkevich 2006",
        hint="The other policy's value, and the margin, less the slack.",
        place=Place.WORKING,
    )
    SUM_FOR_MAXIMUM = Misconception(
        "sum-for-maximum",
        "One slack ξ serves all constraints: it is the largest violation, not their sum.",
        when=several_violated,
    )
    SLACK = Formula(
        "slack",
        xi,
        Greatest(Integer(0), MaxOver(worth(policy) + margin(policy) - worth_expert, policy, Policies)),
        title="Smallest slack for all constraints",
        source="Ratliff, Bagnell & Zinkevich 2006",
        hint="One ξ serves all constraints, so it is as large as the worst violation, and 0 if there is none.",
        place=Place.BEYOND,
        misread={
            SUM_FOR_MAXIMUM: SumOver(worth(policy) + margin(policy) - worth_expert, policy, Violated),
        },
    )

    APPRENTICESHIP = Formula(
        "apprenticeship",
        mu(j),
        mu_expert(j),
        title="Apprenticeship learning",
        source="Abbeel & Ng 2004, section 3",
        hint="Close to the expert's feature expectations a policy earns nearly as much, whatever the weights.",
        sign="≈",
    )
    _TOWARDS = mu_now(i) - mu_bar(i)
    OTHER_END = Misconception(
        "share-from-the-other-end", "The share c is counted from the old point μ̄, not from the new policy's μ(π)."
    )
    BY_WAY_TO_EXPERT = Misconception(
        "divided-by-way-to-expert", "Below the line stands the square of the way to the new policy, not to the expert."
    )
    PROJECTION_LENGTH = Formula(
        "projection-length",
        step_length,
        SumOver(_TOWARDS * (mu_expert(i) - mu_bar(i)), i, Features) * Pow(SumOver(_TOWARDS**2, i, Features), -1),
        title="Projection step: its length",
        source="Abbeel & Ng 2004, section 3.1",
        hint="Project the way to the expert onto the way to the new policy.",
        place=Place.BEYOND,
        misread={
            OTHER_END: SumOver(_TOWARDS * (mu_now(i) - mu_expert(i)), i, Features)
            * Pow(SumOver(_TOWARDS**2, i, Features), -1),
            BY_WAY_TO_EXPERT: SumOver(_TOWARDS * (mu_expert(i) - mu_bar(i)), i, Features)
            * Pow(SumOver((mu_expert(i) - mu_bar(i)) ** 2, i, Features), -1),
        },
    )
    FROM_THE_NEW_POLICY = Misconception(
        "from-the-new-policy", "The share c of the way is gone from the old point μ̄ on, not from the new policy's μ(π)."
    )
    PROJECTION = Formula(
        "projection",
        mu_bar(j),
        mu_bar(j) + step_length * (mu_now(j) - mu_bar(j)),
        title="Projection step",
        source="Abbeel & Ng 2004, section 3.1",
        hint="Go the share c of the way from the old point to the feature expectations of the new policy.",
        sign="←",
        place=Place.BEYOND,
        misread={
            FROM_THE_NEW_POLICY: mu_now(j) + step_length * (mu_now(j) - mu_bar(j)),
        },
    )
    WEIGHTS = Formula(
        "apprenticeship-weights",
        w(j),
        mu_expert(j) - mu_bar(j),
        title="Weights of the next reward",
        source="Abbeel & Ng 2004, section 3.1",
        hint="The next reward points from the projected point to the expert.",
        place=Place.BEYOND,
    )
    DISTANCE_SQUARED = Misconception(
        "distance-squared", "That is the square of the distance; the length of w is the root of the sum of squares."
    )
    DISTANCE_AS_SUM = Misconception(
        "distance-as-sum", "The length of w is the root of the sum of its squared entries, not their sum."
    )
    REMAINING = Formula(
        "remaining-distance",
        remaining,
        sqrt(SumOver(w(i) ** 2, i, Features)),
        title="Remaining distance",
        source="Abbeel & Ng 2004, section 3.1",
        hint="It is the length of w; the algorithm stops when it is small.",
        place=Place.WORKING,
        misread={
            DISTANCE_SQUARED: SumOver(w(i) ** 2, i, Features),
            DISTANCE_AS_SUM: SumOver(Abs(w(i)), i, Features),
        },
    )
