"""Section 3 of the sheet: dynamic programming."""

from functools import cache

from msgspec.structs import replace
from sympy import Abs, Expr, evaluate

from rldrill.problems.mathematics import Fence, Math, Script, number, operator, row, variable
from rldrill.solutions.formula.formula import Formula, Misconception, Place
from rldrill.solutions.formula.notation import (
    Actions,
    ArgMaxOver,
    MaxOver,
    MeanOver,
    P,
    Q,
    Qpi,
    Qstar,
    Quantity,
    R,
    States,
    Successors,
    SumOver,
    V,
    Vpi,
    Vstar,
    a,
    a1,
    called,
    gamma,
    letter,
    numbered,
    pi,
    quantity,
    s,
    s1,
)
from rldrill.solutions.sheet import bellman
from rldrill.solutions.sheet.bellman import (
    ACTIONS_ALIKE,
    BEST_OUTCOME,
    DISCOUNTED_REWARD,
    FORGOT_GAMMA,
    FORGOT_POLICY,
    LOOKAHEAD,
    LOOKAHEAD_PI,
    LOOKAHEAD_STAR,
    MAX_FOR_MEAN,
    MAXIMA_APART,
    NEXT_VALUE,
    OPTIMAL_Q_BY_REWARD,
    Q_REWARD_UNWEIGHTED,
    REWARD_UNWEIGHTED,
    WITHOUT_GAMMA,
    WITHOUT_GAMMA_PI,
)


def _values(mark: Math) -> Math:
    return Script(variable("V"), mark)


def _distance(first: Math, second: Math) -> Math:
    return Script(Fence(row(first, operator("−"), second), "‖", "‖"), variable("∞"))


k = letter("k")
_V_STAR = Script(variable("V"), above=operator("*"))
_V_0, _V_1 = (_values(variable(number)) for number in "01")

pi1 = quantity("pi1", called("π′"))
pi_star = quantity("pi", called(Script(variable("π"), above=operator("*"))))
#: The values before the first sweep, after it and in the end, and how far they are from each other.
V_start, V_swept, V_end = (quantity(code, called(name)) for code, name in (("V0", _V_0), ("V1", _V_1), ("V", _V_STAR)))
StartNorm = quantity("norm", lambda: _distance(_V_0, _V_STAR))
SweepNorm = quantity("norm", lambda: _distance(_V_1, _V_0))
#: ‖V_k − V*‖∞ and ‖V_{k+1} − V_k‖∞ by k.
Distance = quantity("distance", lambda index: _distance(_values(index), _V_STAR))
Change = quantity("change", lambda _: _distance(_V_1, _V_0))

with evaluate(False):
    _NEXT_POLICY_VALUE = SumOver(P(s, a, s1) * Vpi(s1), s1, Successors(s, a))
    _NEXT_OPTIMAL_VALUE = SumOver(P(s, a, s1) * Vstar(s1), s1, Successors(s, a))
    _REWARD = SumOver(P(s, a, s1) * R(s, a, s1), s1, Successors(s, a))
    _WITHOUT_GAMMA_STAR = SumOver(P(s, a, s1) * (R(s, a, s1) + Vstar(s1)), s1, Successors(s, a))
    _UNWEIGHTED_PI, _UNWEIGHTED_STAR = (
        SumOver(R(s, a, s1) + P(s, a, s1) * gamma * values(s1), s1, Successors(s, a)) for values in (Vpi, Vstar)
    )

    SMALLEST_Q = Misconception("smallest-q", "Q is a return, so the greatest is best; only costs are minimised.")

    POLICY_EVALUATION = Formula(
        "policy-evaluation",
        V(s),
        SumOver(pi(a, s) * LOOKAHEAD, a, Actions(s)),
        title="Iterative policy evaluation",
        source="Sutton & Barto 2018, eq. 4.5",
        hint="Average over the actions, then over where each leads, with the values that are current.",
        sign="←",
        misread={
            FORGOT_POLICY: SumOver(LOOKAHEAD, a, Actions(s)),
            DISCOUNTED_REWARD: SumOver(
                pi(a, s) * SumOver(P(s, a, s1) * (gamma * (R(s, a, s1) + V(s1))), s1, Successors(s, a)), a, Actions(s)
            ),
            FORGOT_GAMMA: SumOver(pi(a, s) * WITHOUT_GAMMA, a, Actions(s)),
            MAX_FOR_MEAN: MaxOver(LOOKAHEAD, a, Actions(s)),
            ACTIONS_ALIKE: MeanOver(LOOKAHEAD, a, Actions(s)),
            Q_REWARD_UNWEIGHTED: SumOver(pi(a, s) * REWARD_UNWEIGHTED, a, Actions(s)),
        },
    )

    POLICY_IMPROVEMENT_THEOREM = Formula(
        "policy-improvement-theorem",
        Qpi(s, pi1(s)),
        Vpi(s),
        title="Policy improvement theorem",
        source="Sutton & Barto 2018, eq. 4.7",
        hint="Take π′ for one step and π from then on; compare with π from the start, in every state.",
        sign="≥",
        note="If this holds for all $s$, with deterministic $π$ and $π′$, then $π′$ is at least as good as $π$.",
    )

    POLICY_ITERATION = Formula(
        "policy-iteration",
        V(s),
        SumOver(P(s, pi(s), s1) * (R(s, pi(s), s1) + gamma * V(s1)), s1, Successors(s, pi(s))),
        title="Policy iteration: evaluation",
        source="Sutton & Barto 2018, section 4.3",
        hint="Write one equation for every state, with the policy's action in it, and solve them together.",
        misread={
            FORGOT_GAMMA: SumOver(P(s, pi(s), s1) * (R(s, pi(s), s1) + V(s1)), s1, Successors(s, pi(s))),
            Q_REWARD_UNWEIGHTED: SumOver(R(s, pi(s), s1) + P(s, pi(s), s1) * gamma * V(s1), s1, Successors(s, pi(s))),
        },
    )
    IMPROVEMENT_BY_VALUE = Misconception(
        "by-next-value-alone", "The reward on the way counts too: compare reward plus γ times the next value."
    )
    IMPROVEMENT_BY_REWARD = Misconception(
        "by-reward-alone", "What comes after the reward counts too: compare reward plus γ times the next value."
    )
    POLICY_IMPROVEMENT = Formula(
        "policy-iteration-improvement",
        pi(s),
        ArgMaxOver(LOOKAHEAD_PI, a, Actions(s)),
        title="Policy iteration: improvement",
        source="Sutton & Barto 2018, eq. 4.9",
        hint="In every state take the action whose average of reward plus γ times the old policy's value is greatest.",
        also=(ArgMaxOver(Qpi(s, a), a, Actions(s)),),
        misread={
            IMPROVEMENT_BY_VALUE: ArgMaxOver(_NEXT_POLICY_VALUE, a, Actions(s)),
            IMPROVEMENT_BY_REWARD: ArgMaxOver(_REWARD, a, Actions(s)),
            SMALLEST_Q: ArgMaxOver(-LOOKAHEAD_PI, a, Actions(s)),
            FORGOT_GAMMA: ArgMaxOver(WITHOUT_GAMMA_PI, a, Actions(s)),
            Q_REWARD_UNWEIGHTED: ArgMaxOver(_UNWEIGHTED_PI, a, Actions(s)),
        },
    )

    MEAN_FOR_MAX = Misconception(
        "mean-for-max", "Value iteration keeps the best action's value; it does not average over the actions."
    )
    VALUE_ITERATION = Formula(
        "value-iteration",
        V(s),
        MaxOver(LOOKAHEAD, a, Actions(s)),
        title="Value iteration",
        source="Sutton & Barto 2018, eq. 4.10",
        hint="For every state: work out each action's average with the old values, and keep the greatest.",
        sign="←",
        misread={
            MEAN_FOR_MAX: MeanOver(LOOKAHEAD, a, Actions(s)),
            FORGOT_GAMMA: MaxOver(WITHOUT_GAMMA, a, Actions(s)),
            Q_REWARD_UNWEIGHTED: MaxOver(REWARD_UNWEIGHTED, a, Actions(s)),
            BEST_OUTCOME: MaxOver(MaxOver(R(s, a, s1) + gamma * V(s1), s1, Successors(s, a)), a, Actions(s)),
            MAXIMA_APART: MaxOver(_REWARD, a, Actions(s)) + gamma * MaxOver(NEXT_VALUE, a, Actions(s)),
        },
    )

    Q_OF_VALUES = Formula(
        "q-of-values",
        Q(s, a),
        LOOKAHEAD,
        title="Value of an action by current values",
        source="Sutton & Barto 2018, section 4.4",
        hint="The action is fixed: average over where it leads, reward plus γ times the value there.",
        place=Place.WORKING,
        misread={
            FORGOT_GAMMA: WITHOUT_GAMMA,
        },
    )
    GREEDY_BY_VALUE = Misconception(
        "by-next-value-alone", "The reward on the way counts too: compare reward plus γ times the next value."
    )
    GREEDY_BY_REWARD = Misconception(
        "by-reward-alone", "What comes after the reward counts too: compare reward plus γ times the next value."
    )
    GREEDY_FROM_V = Formula(
        "greedy-from-v",
        pi_star(s),
        ArgMaxOver(LOOKAHEAD_STAR, a, Actions(s)),
        title="Optimal policy given V",
        source="Sutton & Barto 2018, eq. 4.9",
        hint="Take the action whose average of reward plus γ times the next value is greatest.",
        misread={
            GREEDY_BY_VALUE: ArgMaxOver(_NEXT_OPTIMAL_VALUE, a, Actions(s)),
            GREEDY_BY_REWARD: ArgMaxOver(_REWARD, a, Actions(s)),
            SMALLEST_Q: ArgMaxOver(-LOOKAHEAD_STAR, a, Actions(s)),
            FORGOT_GAMMA: ArgMaxOver(_WITHOUT_GAMMA_STAR, a, Actions(s)),
            Q_REWARD_UNWEIGHTED: ArgMaxOver(_UNWEIGHTED_STAR, a, Actions(s)),
        },
    )
    IMPROVEMENT_FROM_Q = Formula(
        "policy-improvement-from-q",
        pi(s),
        ArgMaxOver(Qpi(s, a), a, Actions(s)),
        title="Policy improvement from action values",
        source="Sutton & Barto 2018, eq. 4.9",
        hint="In every state take the action whose value under the old policy is greatest.",
        place=Place.WORKING,
        misread={
            SMALLEST_Q: ArgMaxOver(-Qpi(s, a), a, Actions(s)),
        },
    )
    SWEEP_OVER_ACTIONS = Formula(
        "value-iteration-over-actions",
        Q(s, a),
        SumOver(P(s, a, s1) * (R(s, a, s1) + gamma * MaxOver(Q(s1, a1), a1, Actions(s1))), s1, Successors(s, a)),
        title="Value iteration over action values",
        source="Sutton & Barto 2018, section 4.4",
        hint="The first action is fixed; from the next state on the best action is taken.",
        sign="←",
        place=Place.WORKING,
        misread={
            OPTIMAL_Q_BY_REWARD: _REWARD,
        },
    )
    GREEDY_FROM_Q = Formula(
        "greedy-from-q",
        pi_star(s),
        ArgMaxOver(Qstar(s, a), a, Actions(s)),
        title="Optimal policy given Q",
        source="Sutton & Barto 2018, section 3.6",
        hint="In every state take the action with the greatest value; no model is needed.",
        misread={
            SMALLEST_Q: ArgMaxOver(-Qstar(s, a), a, Actions(s)),
        },
    )

    SUM_FOR_MAX = Misconception(
        "sum-for-max",
        "The distance of two value functions is their greatest difference in any one state, not the sum over all.",
        when=lambda given: len(given.start) > 1,
    )
    MAX_NORM = Formula(
        "max-norm",
        StartNorm(),
        MaxOver(Abs(V_start(s) - V_end(s)), s, States),
        title="Distance from the optimal values in the maximum norm",
        source="Puterman 1994, chapter 6",
        hint="Take the greatest difference of all states, without its sign.",
        place=Place.WORKING,
        misread={
            SUM_FOR_MAX: SumOver(Abs(V_start(s) - V_end(s)), s, States),
        },
    )
    MAX_NORM_OF_SWEEP = Formula(
        "max-norm-of-sweep",
        SweepNorm(),
        MaxOver(Abs(V_swept(s) - V_start(s)), s, States),
        title="Change in a sweep in the maximum norm",
        source="Puterman 1994, chapter 6",
        hint="Take the greatest difference of all states, without its sign.",
        place=Place.WORKING,
        misread={
            SUM_FOR_MAX: SumOver(Abs(V_swept(s) - V_start(s)), s, States),
        },
    )
    FORGOT_DISTANCE = Misconception(
        "forgot-initial-distance",
        "γᵏ says by how much the error shrinks; it is multiplied with the error at the start.",
    )
    ONE_POWER_SHORT = Misconception(
        "one-power-short", "V₀ has seen no sweep, so the first one shrinks the error already: k sweeps give γᵏ."
    )
    FACTOR_OF_THE_CHANGE = Misconception(
        "factor-of-the-change",
        "γᵏ/(1 − γ) is the factor of what the first sweep changes; of the distance from V* γᵏ is left.",
    )
    CONTRACTION = Formula(
        "contraction",
        Distance(k),
        gamma**k * Distance(0),
        title="Contraction of value iteration",
        source="Puterman 1994, section 6.3",
        hint="Every sweep shrinks the greatest error to at most γ times what it was.",
        sign="≤",
        place=Place.BEYOND,
        misread={
            FORGOT_DISTANCE: gamma**k,
            ONE_POWER_SHORT: gamma ** (k - 1) * Distance(0),
            FACTOR_OF_THE_CHANGE: gamma**k / (1 - gamma) * Distance(0),
        },
    )
    CHANGE_FOR_ERROR = Misconception(
        "change-for-error",
        "Later sweeps change the values too, by γ, γ², … times as much: together that is the change divided by 1 − γ.",
    )
    ERROR_FROM_CHANGE = Formula(
        "contraction-first-sweep",
        Distance(0),
        Change(0) / (1 - gamma),
        title="Distance to V* from one sweep",
        source="Puterman 1994, chapter 6",
        hint="The error at the start is at most what the first sweep changed, divided by 1 − γ.",
        sign="≤",
        place=Place.BEYOND,
        misread={
            CHANGE_FOR_ERROR: Change(0),
        },
    )


def _after(values: type[Quantity], index: Math) -> type[Quantity]:
    return quantity(values.code, called(Script(variable(values.code), index)))


#: The values of states or of actions before a sweep, V_k, and after it, V_{k+1}.
_SWEPT = {
    kind: (_after(kind, variable("k")), _after(kind, row(variable("k"), operator("+"), number(1)))) for kind in (V, Q)
}


@cache
def synchronous(formula: Formula) -> Formula:
    """An update as a sweep makes it that uses the values of the sweep before only: V_{k+1}(s) = … V_k(s′)."""
    kind = type(formula.left)
    old, new = _SWEPT[kind]

    def read(right: Expr) -> Expr:
        return right.xreplace({value: old(*value.args) for value in right.atoms(kind)})

    with evaluate(False):
        return replace(
            formula,
            left=new(*formula.left.args),
            right=read(formula.right),
            sign="=",
            misread={mistake: read(right) for mistake, right in formula.misread.items()},
        )


@cache
def greedy(sweeps: int) -> tuple[Formula, Formula]:
    """The greedy policy for the values of states after so many sweeps, and for those of actions."""
    V_k, Q_k = numbered(V, sweeps), numbered(Q, sweeps)
    with evaluate(False):
        ahead = SumOver(P(s, a, s1) * (R(s, a, s1) + gamma * V_k(s1)), s1, Successors(s, a))
        after = SumOver(P(s, a, s1) * V_k(s1), s1, Successors(s, a))
        undiscounted = SumOver(P(s, a, s1) * (R(s, a, s1) + V_k(s1)), s1, Successors(s, a))
        unweighted = SumOver(R(s, a, s1) + P(s, a, s1) * gamma * V_k(s1), s1, Successors(s, a))
        return (
            replace(
                GREEDY_FROM_V,
                left=pi(s),
                right=ArgMaxOver(ahead, a, Actions(s)),
                misread={
                    GREEDY_BY_VALUE: ArgMaxOver(after, a, Actions(s)),
                    GREEDY_BY_REWARD: ArgMaxOver(_REWARD, a, Actions(s)),
                    SMALLEST_Q: ArgMaxOver(-ahead, a, Actions(s)),
                    FORGOT_GAMMA: ArgMaxOver(undiscounted, a, Actions(s)),
                    Q_REWARD_UNWEIGHTED: ArgMaxOver(unweighted, a, Actions(s)),
                },
            ),
            replace(
                GREEDY_FROM_Q,
                left=pi(s),
                right=ArgMaxOver(Q_k(s, a), a, Actions(s)),
                misread={SMALLEST_Q: ArgMaxOver(-Q_k(s, a), a, Actions(s))},
            ),
        )


@cache
def ahead_of(sweeps: int) -> Formula:
    """The value of an action by the values of states after so many sweeps."""
    V_k = numbered(V, sweeps)
    with evaluate(False):
        ahead = SumOver(P(s, a, s1) * (R(s, a, s1) + gamma * V_k(s1)), s1, Successors(s, a))
        return replace(Q_OF_VALUES, right=ahead)


@cache
def of_round(number: int) -> tuple[Formula, Formula, Formula]:
    """Evaluation, improvement and the values of actions in the symbols of a round of policy iteration: V^{π₀}, π₀."""
    policy = numbered(pi, number)
    mark = Script(variable("π"), variable(str(number)))
    values, worth = (quantity(code, called(Script(variable(code), above=mark))) for code in "VQ")
    with evaluate(False):
        ahead = R(s, policy(s), s1) + gamma * values(s1)
        lookahead = SumOver(P(s, a, s1) * (R(s, a, s1) + gamma * values(s1)), s1, Successors(s, a))
        return (
            replace(
                POLICY_ITERATION,
                left=values(s),
                right=SumOver(P(s, policy(s), s1) * ahead, s1, Successors(s, policy(s))),
            ),
            replace(POLICY_IMPROVEMENT, right=ArgMaxOver(lookahead, a, Actions(s)), also=()),
            replace(bellman.BELLMAN_Q, left=worth(s, a), right=lookahead),
        )
