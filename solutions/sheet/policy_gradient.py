"""Section 6 of the sheet: policy gradient methods.

Weights, features and gradients are vectors; weights and features are also known by their entries.
"""

from typing import Any

from sympy import Integer, Pow, evaluate, exp, log

from rldrill.problems.mathematics import (
    Accent,
    Fence,
    Fraction,
    Glyph,
    Math,
    Script,
    listed,
    own,
    punctuation,
    row,
    variable,
    word,
)
from rldrill.solutions.formula.formula import Formula, Misconception, Place
from rldrill.solutions.formula.notation import (
    DOTS,
    A,
    Actions,
    ArgMaxOver,
    Cases,
    Choices,
    Clipped,
    Counting,
    Expected,
    Features,
    Greatest,
    Indicator,
    Least,
    MeanOver,
    P,
    Qpi,
    S,
    Size,
    Successors,
    SumOver,
    T,
    V,
    Vpi,
    a,
    a1,
    alpha,
    called,
    epsilon,
    gamma,
    i,
    lam,
    letter,
    n,
    pi,
    quantity,
    r,
    s,
    s1,
    subscripted,
    t,
)
from rldrill.solutions.ratios import keeps_the_worse
from rldrill.solutions.sheet.bellman import FORGOT_GAMMA, OWN_VALUE_DISCOUNTED

_NABLA = Script(Glyph("∇", "variable"), variable("θ"))


def _feature(index: Math, *arguments: Math) -> Math:
    return row(Script(variable("f"), index), Fence(listed(arguments)))


def _odds(action: Math, other: Math, state: Math) -> Math:
    above, below = (row(variable("π"), Fence(row(each, punctuation("|"), state))) for each in (action, other))
    return Fraction(above, below)


def _score(action: Math, state: Math) -> Math:
    chance = row(variable("π"), Fence(row(action, punctuation("|"), state)))
    return row(_NABLA, word("log"), chance)


theta = quantity("theta", subscripted("θ"))
f = quantity("f", _feature)
H = quantity("H", called("h"))
Qhat = quantity("Qhat", called(Accent(variable("Q"), "hat")))
#: The same weights and features as vectors; f(s, a) has one entry for every weight.
theta_vector = letter("theta_vector", "θ", matrix=True)
f_vector = quantity("f_vector", called("f"), matrix=True)
ones = letter("ones", "1", matrix=True)
odds = quantity("odds", _odds)
score = quantity("score", _score, matrix=True)
gradient = letter("gradient", row(_NABLA, variable("J"), Fence(variable("θ"))), matrix=True)
G_t = quantity("G", subscripted("R"))
beta = letter("beta", "β")
delta = quantity("delta", subscripted("δ"))
Adv = quantity("Adv", called(Script(variable("A"), above=variable("π"))))
b_of = quantity("baseline", called("b"))
A_t = quantity("A_t", subscripted("A"))
GAE_t = quantity("GAE_t", subscripted(Accent(variable("A"), "hat")))
rho = quantity("rho", subscripted("ρ"))
new_chance = quantity("new_chance", lambda action, state: _chance("θ", action, state))
old_chance = quantity("old_chance", lambda action, state: _chance("old", action, state))
unclipped = quantity("unclipped", subscripted("u"))
clipped = quantity("clipped", subscripted("c"))
L_t = quantity("L_t", subscripted(own("L")))
L = letter("L", own("L"))
entropy = letter("entropy", "H")
Samples = letter("samples", "B")


def _chance(which: str, action: Math, state: Math) -> Math:
    mark = variable(which) if which == "θ" else word(which)
    return row(Script(variable("π"), mark), Fence(row(action, punctuation("|"), state)))


def _several_steps(given: Any) -> bool:
    """Whether there is more than one step, so that one can be taken for another."""
    return len(given.trajectory.rewards) > 1


def _two_actions(given: Any) -> bool:
    """Whether there are two actions to choose from, in one state or in every state."""
    rows = [*given.features.values()]
    return all(len(row) == 2 for row in rows) if isinstance(rows[0], dict) else len(rows) == 2


def _has_later_errors(given: Any) -> bool:
    """Whether an advantage is estimated along a run of several steps."""
    return given.run is not None and len(given.run.trajectory.rewards) > 1


with evaluate(False):
    _LOG_GRADIENT = score(A(t), S(t))
    _EPISODE = Counting(0, T - 1)

    REINFORCE = Formula(
        "reinforce",
        gradient,
        Expected(SumOver(_LOG_GRADIENT * G_t(t), t, _EPISODE)),
        title="REINFORCE",
        source="Williams 1992; Sutton & Barto 2018, section 13.3",
        hint="The score of every action taken, weighted by the return from its own step on, summed over the episode.",
        note="$R_t$ is the discounted return from step $t$ on; the further factor $γ^t$ of Sutton & Barto's box is "
        "left out, as it mostly is.",
    )
    RETURN_FROM_A_STEP = Formula(
        "return-from-a-step",
        G_t(t),
        r(t + 1) + gamma * G_t(t + 1),
        title="Return from a step on",
        source="Sutton & Barto 2018, eq. 3.9",
        hint="Begin at the end: the last reward, then each reward before it plus γ times the return that follows.",
        place=Place.WORKING,
    )
    FIRST_RETURN_EVERYWHERE = Misconception(
        "first-return-everywhere",
        "Each score is weighted by the return from its own step on; rewards before it say nothing about the action.",
        when=_several_steps,
    )
    REWARD_FOR_RETURN = Misconception(
        "reward-for-return",
        "The score is weighted by the whole discounted return from its step on, not by the next reward alone.",
        when=_several_steps,
    )
    DISCOUNTED_AGAIN = Misconception(
        "discounted-again",
        "The question leaves out the further factor γᵗ: the return from a step on is not discounted once more.",
        when=lambda given: given.gamma != 1 and _several_steps(given),
    )
    MEAN_OVER_STEPS = Misconception(
        "mean-over-steps",
        "The gradient is the sum over the steps of the episode; it is not divided by their number.",
        when=_several_steps,
    )
    REINFORCE_ESTIMATE = Formula(
        "reinforce-estimate",
        gradient,
        SumOver(_LOG_GRADIENT * G_t(t), t, _EPISODE),
        title="REINFORCE, from one episode",
        source="Sutton & Barto 2018, eq. 13.8",
        hint="Multiply the score of each step by the return from that step on, and add.",
        sign="≈",
        place=Place.WORKING,
        misread={
            FIRST_RETURN_EVERYWHERE: SumOver(_LOG_GRADIENT * G_t(0), t, _EPISODE),
            REWARD_FOR_RETURN: SumOver(_LOG_GRADIENT * r(t + 1), t, _EPISODE),
            DISCOUNTED_AGAIN: SumOver(gamma**t * _LOG_GRADIENT * G_t(t), t, _EPISODE),
            MEAN_OVER_STEPS: Pow(T, -1) * SumOver(_LOG_GRADIENT * G_t(t), t, _EPISODE),
        },
    )
    DESCENT = Misconception(
        "descent", "The expected return is maximised: the step goes up the gradient, with a plus sign."
    )
    GRADIENT_ASCENT = Formula(
        "gradient-ascent",
        theta_vector,
        theta_vector + alpha * gradient,
        title="Gradient ascent",
        source="Sutton & Barto 2018, eq. 13.1",
        hint="The return is to grow, so take a step α along the gradient.",
        sign="←",
        misread={
            DESCENT: theta_vector - alpha * gradient,
        },
    )

    WEIGHTS_FORGOTTEN = Misconception(
        "weights-forgotten", "Each feature counts with its own weight θᵢ.", when=lambda given: given.at is None
    )
    LINEAR_ACTION_VALUE = Formula(
        "linear-action-value",
        Qhat(s, a),
        SumOver(theta(i) * f(i, s, a), i, Features),
        title="Value of an action, linear in features",
        source="Sutton & Barto 2018, eq. 10.3",
        hint="Multiply each weight by the action's own feature, and add.",
        also=(theta(1) * f(1, s, a) + DOTS + theta(n) * f(n, s, a),),
        place=Place.WORKING,
        misread={
            WEIGHTS_FORGOTTEN: SumOver(f(i, s, a), i, Features),
        },
    )
    LINEAR_POLICY = Formula(
        "linear-policy",
        pi(s),
        ArgMaxOver(Qhat(s, a), a, Actions(s)),
        title="Greedy policy, linear in features",
        source="Sutton & Barto 2018, section 10.1",
        hint="Take the action whose weighted sum of features is the greatest.",
        also=(ArgMaxOver(theta(1) * f(1, s, a) + DOTS + theta(n) * f(n, s, a), a, Actions(s)),),
    )

    PREFERENCE = Formula(
        "action-preference",
        H(s, a),
        SumOver(theta(i) * f(i, s, a), i, Features),
        title="Preference of an action",
        source="Sutton & Barto 2018, eq. 13.3",
        hint="Multiply each weight by the action's own feature, and add.",
    )
    NOT_NORMALISED = Misconception("not-normalised", "Probabilities sum to 1: divide by the sum over all actions.")
    WITHOUT_EXP = Misconception(
        "normalised-without-exp",
        "The preferences are exponentiated before they are normalised.",
        when=lambda given: given.odds is None and not given.parameters(),  # quotients of logarithms are not compared
    )
    SOFTMAX_POLICY = Formula(
        "softmax-policy",
        pi(a, s),
        exp(H(s, a)) / SumOver(exp(H(s, a1)), a1, Choices),
        title="Softmax policy",
        source="Sutton & Barto 2018, eq. 13.2",
        hint="Exponentiate every action's preference, then divide by the sum of them all.",
        misread={
            NOT_NORMALISED: exp(H(s, a)),
            WITHOUT_EXP: H(s, a) / SumOver(H(s, a1), a1, Choices),
        },
    )

    SOFTMAX_ODDS = Formula(
        "softmax-odds",
        odds(a, a1, s),
        exp(H(s, a)) / exp(H(s, a1)),
        title="How many times as often a softmax policy takes an action as another",
        source="Sutton & Barto 2018, eq. 13.2",
        hint="The sum in the denominator is the same for both actions: it cancels.",
        place=Place.WORKING,
    )
    FEATURES_ALONE = Misconception(
        "features-alone",
        "The features expected under the policy are subtracted: they come from the softmax's denominator.",
    )
    EXPECTED_ADDED = Misconception(
        "expected-features-added",
        "The expected features are subtracted: the denominator of the softmax enters log π with a minus sign.",
    )
    LOG_FORGOTTEN = Misconception(
        "log-forgotten", "The score is the gradient of log π, not that of π itself: ∇ log π = ∇π/π."
    )
    FEATURES_ALIKE = Misconception(
        "features-averaged-alike",
        "In the expected features each action counts with its probability π(a′|s), not all with the same weight.",
    )
    OWN_SHARE_ALONE = Misconception(
        "own-share-alone",
        "The expected features are those of all actions, each with its own; not π(a|s) f(s, a) alone.",
    )
    OTHER_SUBTRACTED = Misconception(
        "other-action-subtracted",
        "The expected features are subtracted, in which each action counts with its probability, the one taken, too; "
        "not the features of the other action.",
        when=_two_actions,
    )
    SCORE_FUNCTION = Formula(
        "score-function",
        score(a, s),
        f_vector(s, a) - SumOver(pi(a1, s) * f_vector(s, a1), a1, Choices),
        title="Score function of the softmax policy",
        source="Sutton & Barto 2018, eq. 13.9",
        hint="The action's own features minus the features expected under the policy.",
        note="For preferences that are linear in features, $h(s, a) = θ^⊤ f(s, a)$.",
        misread={
            FEATURES_ALONE: f_vector(s, a),
            EXPECTED_ADDED: f_vector(s, a) + SumOver(pi(a1, s) * f_vector(s, a1), a1, Choices),
            LOG_FORGOTTEN: pi(a, s) * (f_vector(s, a) - SumOver(pi(a1, s) * f_vector(s, a1), a1, Choices)),
            OWN_SHARE_ALONE: (1 - pi(a, s)) * f_vector(s, a),
            OTHER_SUBTRACTED: f_vector(s, a) - SumOver((1 - Indicator(a1, a)) * f_vector(s, a1), a1, Choices),
            FEATURES_ALIKE: f_vector(s, a) - Pow(Size(Choices), -1) * SumOver(f_vector(s, a1), a1, Choices),
        },
    )

    NEXT_VALUE_FORGOTTEN = Misconception(
        "next-value-forgotten",
        "The target is the reward plus γ times the value of the next state.",
        when=lambda given: any(state not in given.trajectory.terminal for state in given.trajectory.states[1:]),
    )
    TD_ERROR = Formula(
        "td-error",
        delta(t),
        r(t + 1) + gamma * V(S(t + 1)) - V(S(t)),
        title="TD error",
        source="Sutton & Barto 2018, eq. 6.5",
        hint="Reward plus the discounted value of the next state, minus the value of the state that is left.",
        misread={
            NEXT_VALUE_FORGOTTEN: r(t + 1) - V(S(t)),
            FORGOT_GAMMA: r(t + 1) + V(S(t + 1)) - V(S(t)),
            OWN_VALUE_DISCOUNTED: r(t + 1) + V(S(t + 1)) - gamma * V(S(t)),
        },
    )
    CRITIC_WITHOUT_ALPHA = Misconception(
        "critic-without-alpha", "The critic moves its value by α times the TD error, not by all of it."
    )
    CRITIC = Formula(
        "critic",
        V(S(t)),
        V(S(t)) + alpha * delta(t),
        title="The critic's step",
        source="Sutton & Barto 2018, section 13.5",
        hint="The critic learns by TD(0): its value moves by α times the TD error.",
        sign="←",
        misread={
            CRITIC_WITHOUT_ALPHA: V(S(t)) + delta(t),
        },
    )
    WEIGHTED_BY_REWARD = Misconception(
        "actor-weighted-by-reward", "The actor's step is weighted by the critic's TD error, not by the reward."
    )
    ACTOR_CRITIC = Formula(
        "actor-critic",
        theta_vector,
        theta_vector + beta * delta(t) * _LOG_GRADIENT,
        title="Actor-critic: the actor's step",
        source="Sutton & Barto 2018, eq. 13.14",
        hint="The actor follows the score of the action taken, weighted by the critic's TD error.",
        sign="←",
        note="The critic learns by TD, $V(s_t) ← V(s_t) + αδ_t$; the TD error stands for the advantage.",
        misread={
            WEIGHTED_BY_REWARD: theta_vector + beta * r(t + 1) * _LOG_GRADIENT,
            DESCENT: theta_vector - beta * delta(t) * _LOG_GRADIENT,
        },
    )
    BASELINE_ADDED = Misconception(
        "baseline-added",
        "The baseline is subtracted from the return: what counts is how much better it was than usual.",
    )
    BASELINE_FORGOTTEN = Misconception(
        "baseline-forgotten", "The return is taken relative to the baseline: Rₜ − b(sₜ)."
    )
    BASELINE_BOOTSTRAPPED = Misconception(
        "baseline-bootstrapped",
        "δₜ is the return, with all rewards to the end, minus the baseline; r + γb(s′) − b(s) is an actor-critic's.",
    )
    BASELINE = Formula(
        "baseline",
        delta(t),
        G_t(t) - b_of(S(t)),
        title="Return relative to a baseline",
        source="Sutton & Barto 2018, section 13.4",
        hint="What counts is how much better the return was than the state's baseline.",
        misread={
            BASELINE_ADDED: G_t(t) + b_of(S(t)),
            BASELINE_FORGOTTEN: G_t(t),
            BASELINE_BOOTSTRAPPED: Cases(
                Indicator(t, T - 1),
                r(t + 1) - b_of(S(t)),
                r(t + 1) + gamma * b_of(S(t + 1)) - b_of(S(t)),
            ),
        },
    )
    BASELINE_ON_THE_POLICY = Misconception(
        "baseline-on-the-policy", "The baseline is subtracted from the return Rₜ, not from the gradient of log π."
    )
    REINFORCE_BASELINE = Formula(
        "reinforce-baseline",
        gradient,
        SumOver(_LOG_GRADIENT * delta(t), t, _EPISODE),
        title="REINFORCE with a baseline, from one episode",
        source="Sutton & Barto 2018, eq. 13.11",
        hint="Multiply the score of each step by its return minus the baseline, and add.",
        sign="≈",
        also=(SumOver(_LOG_GRADIENT * (G_t(t) - b_of(S(t))), t, _EPISODE),),
        place=Place.WORKING,
        misread={
            BASELINE_ON_THE_POLICY: SumOver((_LOG_GRADIENT - b_of(S(t)) * ones) * G_t(t), t, _EPISODE),
            DISCOUNTED_AGAIN: SumOver(gamma**t * _LOG_GRADIENT * delta(t), t, _EPISODE),
            MEAN_OVER_STEPS: Pow(T, -1) * SumOver(_LOG_GRADIENT * delta(t), t, _EPISODE),
        },
    )
    ADVANTAGE_SIGN = Misconception(
        "sign-of-advantage",
        "A good action has a positive advantage: its own value minus the state's.",
        when=lambda given: given.lookahead is not None,
    )
    NEXT_STATES_VALUE = Misconception(
        "value-of-next-state",
        "The action value is compared with V(s) of the state itself, not with the value of what follows.",
        when=lambda given: given.lookahead is not None,
    )
    MEAN_FOR_STATE = Misconception(
        "mean-for-state-value",
        "The action value is compared with V(s), in which each action counts with its probability π(a|s), not with "
        "the plain mean of the action values.",
        when=lambda given: given.lookahead is not None,
    )
    ADVANTAGE = Formula(
        "advantage",
        Adv(s, a),
        Qpi(s, a) - Vpi(s),
        title="Advantage",
        source="Sutton & Barto 2018, section 13.4; Schulman et al. 2016, section 2",
        hint="How much better the action is than what the policy does on average in this state.",
        misread={
            ADVANTAGE_SIGN: Vpi(s) - Qpi(s, a),
            MEAN_FOR_STATE: Qpi(s, a) - MeanOver(Qpi(s, a1), a1, Actions(s)),
            NEXT_STATES_VALUE: Qpi(s, a) - SumOver(P(s, a, s1) * Vpi(s1), s1, Successors(s, a)),
        },
    )
    GAE_WITHOUT_LAMBDA = Misconception(
        "lambda-forgotten",
        "Each further TD error gets a factor γλ; with γ alone it is the Monte Carlo estimate.",
        when=lambda given: _has_later_errors(given) and given.run.lam != 1,
    )
    GAE_WITHOUT_GAMMA = Misconception(
        "gamma-forgotten",
        "Each further TD error gets a factor γλ, not λ alone.",
        when=lambda given: _has_later_errors(given) and given.gamma != 1,
    )
    NEXT_ERROR_ALONE = Misconception(
        "next-error-alone",
        "The sum goes on to the end of the run: every later TD error counts, not the next one alone.",
        when=lambda given: _has_later_errors(given) and len(given.run.trajectory.rewards) > 2,
    )
    GAE = Formula(
        "gae",
        GAE_t(t),
        SumOver((gamma * lam) ** i * delta(t + i), i, Counting(0, T - t - 1)),
        title="Generalised advantage estimate",
        source="Schulman et al. 2016, eq. 16",
        hint="Add the TD errors from this step on, each with a further factor γλ.",
        note="$λ = 0$ gives the TD error, $λ = 1$ the return minus $V(s_t)$.",
        place=Place.BEYOND,
        misread={
            GAE_WITHOUT_LAMBDA: SumOver(gamma**i * delta(t + i), i, Counting(0, T - t - 1)),
            GAE_WITHOUT_GAMMA: SumOver(lam**i * delta(t + i), i, Counting(0, T - t - 1)),
            NEXT_ERROR_ALONE: SumOver((gamma * lam) ** i * delta(t + i), i, Counting(0, Least(Integer(1), T - t - 1))),
        },
    )

    RATIO_INVERTED = Misconception(
        "ratio-inverted", "The new policy stands above, the old one, which collected the data, below."
    )
    PPO_RATIO = Formula(
        "ppo-ratio",
        rho(t),
        new_chance(A(t), S(t)) / old_chance(A(t), S(t)),
        title="Probability ratio",
        source="Schulman et al. 2017, section 3",
        hint="How much more likely the new policy makes the action than the policy that took it.",
        misread={
            RATIO_INVERTED: old_chance(A(t), S(t)) / new_chance(A(t), S(t)),
        },
    )
    PPO_UNCLIPPED = Formula(
        "ppo-unclipped",
        unclipped(t),
        rho(t) * A_t(t),
        title="The unclipped term",
        source="Schulman et al. 2017, eq. 6",
        hint="The ratio times the advantage.",
        place=Place.WORKING,
    )
    TERM_CLIPPED = Misconception(
        "term-clipped", "It is the ratio that is clipped; the advantage is multiplied with it afterwards."
    )
    CLIPPED_ABOVE_ALONE = Misconception(
        "clipped-above-alone", "The ratio is clipped on both sides: it is not below 1 − ε either."
    )
    CLIPPED_BELOW_ALONE = Misconception(
        "clipped-below-alone", "The ratio is clipped on both sides: it is not above 1 + ε either."
    )
    PPO_CLIPPED = Formula(
        "ppo-clipped",
        clipped(t),
        Clipped(rho(t), 1 - epsilon, 1 + epsilon) * A_t(t),
        title="The clipped term",
        source="Schulman et al. 2017, eq. 7",
        hint="Bring the ratio between 1 − ε and 1 + ε, then multiply by the advantage.",
        place=Place.WORKING,
        misread={
            TERM_CLIPPED: Clipped(rho(t) * A_t(t), 1 - epsilon, 1 + epsilon),
            CLIPPED_ABOVE_ALONE: Least(rho(t), 1 + epsilon) * A_t(t),
            CLIPPED_BELOW_ALONE: Greatest(rho(t), 1 - epsilon) * A_t(t),
        },
    )
    CLIP_WITHOUT_MIN = Misconception(
        "clip-without-min",
        "The objective is the smaller of the unclipped and the clipped term, not always the clipped one.",
        when=lambda given: any(keeps_the_worse(sample, given) for sample in given.samples),
    )
    GREATER_TERM = Misconception(
        "greater-term", "The objective is the smaller of the unclipped and the clipped term, not the greater."
    )
    PPO = Formula(
        "ppo",
        L_t(t),
        Least(unclipped(t), clipped(t)),
        title="PPO: the clipped objective",
        source="Schulman et al. 2017, eq. 7",
        hint="The smaller of the two terms: the objective never looks better than without clipping.",
        also=(Least(rho(t) * A_t(t), Clipped(rho(t), 1 - epsilon, 1 + epsilon) * A_t(t)),),
        hidden=True,
        misread={
            CLIP_WITHOUT_MIN: clipped(t),
            GREATER_TERM: Greatest(unclipped(t), clipped(t)),
        },
    )
    PPO_AT_THE_UPPER_BOUND = Formula(
        "ppo-upper-bound",
        L_t(t),
        (1 + epsilon) * A_t(t),
        title="PPO: a gradient that is cut off above",
        source="Schulman et al. 2017, figure 1",
        hint="Where a good action has become too likely, 1 + ε stands for the ratio.",
        place=Place.WORKING,
    )
    PPO_AT_THE_LOWER_BOUND = Formula(
        "ppo-lower-bound",
        L_t(t),
        (1 - epsilon) * A_t(t),
        title="PPO: a gradient that is cut off below",
        source="Schulman et al. 2017, figure 1",
        hint="Where a bad action has become too unlikely, 1 − ε stands for the ratio.",
        place=Place.WORKING,
    )
    NOT_AVERAGED = Misconception("not-averaged", "A batch has the mean of its samples' objectives, not their sum.")
    PPO_BATCH = Formula(
        "ppo-batch",
        L,
        MeanOver(L_t(t), t, Samples),
        title="PPO: the objective of a batch",
        source="Schulman et al. 2017, eq. 7",
        hint="Average the objective over the samples.",
        place=Place.WORKING,
        misread={
            NOT_AVERAGED: SumOver(L_t(t), t, Samples),
        },
    )
    ENTROPY_IN_BITS = Misconception(
        "entropy-in-bits", "The logarithms are natural, to the base e; those to the base 2 give the entropy in bits."
    )
    ENTROPY = Formula(
        "entropy",
        entropy,
        -SumOver(pi(a, s) * log(pi(a, s)), a, Choices),
        title="Entropy of a policy",
        source="Cover & Thomas 2006, section 2.1",
        hint="Weight the logarithm of every probability by the probability itself, add, and change the sign.",
        place=Place.WORKING,
        misread={
            ENTROPY_IN_BITS: -SumOver(pi(a, s) * log(pi(a, s)), a, Choices) / log(2),
        },
    )
