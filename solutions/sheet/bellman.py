"""Section 2 of the sheet: the Bellman equations."""

from typing import Any

from sympy import Integer, evaluate

from rldrill.problems.mathematics import Fence, Math, row, variable
from rldrill.problems.models import Transition
from rldrill.solutions.formula.formula import Formula, Misconception, Place
from rldrill.solutions.formula.notation import (
    Actions,
    MaxOver,
    MeanOver,
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
    beside,
    called,
    gamma,
    letter,
    pi,
    quantity,
    s,
    s1,
    subscripted,
)


def _edge(here: Math, after: Math) -> Math:
    return subscripted("R")(beside(here, after))


Residual = quantity("residual", called("δ"))
#: What an edge of a graph earns, where nothing is left to chance.
EdgeReward = quantity("edge_reward", _edge)
#: The greatest return of a path to a state on the way.
Head = quantity("V", called("W"))
#: The share of all steps that begin in a state in the long run, and the states from which another may be reached.
Share = quantity("visited", called("d"))
Predecessors = quantity("predecessors", called("S"))
average = letter("average", row(variable("r"), Fence(variable("π"))))


def _rows(given: Any) -> tuple[Transition, ...]:
    """The transitions of a model or of a single state's actions."""
    rows: tuple[Transition, ...] = (given.mdp if hasattr(given, "mdp") else given.dynamics).transitions
    return rows


with evaluate(False):
    #: What one action earns on average, and the ways to get it wrong; shared by all backups.
    LOOKAHEAD = SumOver(P(s, a, s1) * (R(s, a, s1) + gamma * V(s1)), s1, Successors(s, a))
    LOOKAHEAD_PI = SumOver(P(s, a, s1) * (R(s, a, s1) + gamma * Vpi(s1)), s1, Successors(s, a))
    LOOKAHEAD_STAR = SumOver(P(s, a, s1) * (R(s, a, s1) + gamma * Vstar(s1)), s1, Successors(s, a))
    WITHOUT_GAMMA = SumOver(P(s, a, s1) * (R(s, a, s1) + V(s1)), s1, Successors(s, a))
    WITHOUT_GAMMA_PI = SumOver(P(s, a, s1) * (R(s, a, s1) + Vpi(s1)), s1, Successors(s, a))
    GAMMA_ON_REWARD = SumOver(P(s, a, s1) * (gamma * (R(s, a, s1) + Vpi(s1))), s1, Successors(s, a))

    Q_REWARD_UNWEIGHTED = Misconception(
        "reward-not-weighted",
        "Each reward counts with the probability of its transition, as the value of the next state does.",
        when=lambda given: any(row.probability != 1 and row.reward for row in _rows(given)),
    )
    BEST_OUTCOME = Misconception(
        "best-outcome",
        "The agent chooses the action, chance the next state: the ways of one action are averaged with P.",
        when=lambda given: any(row.probability != 1 for row in _rows(given)),
    )
    REWARD_UNWEIGHTED = SumOver(R(s, a, s1) + P(s, a, s1) * gamma * V(s1), s1, Successors(s, a))
    FORGOT_POLICY = Misconception(
        "forgot-policy", "Each action counts with the probability π(a|s) with which the policy takes it."
    )
    ACTIONS_ALIKE = Misconception(
        "unweighted-mean",
        "Each action counts with the probability π(a|s), not all with the same weight.",
    )
    DISCOUNTED_REWARD = Misconception(
        "gamma-on-reward", "γ discounts the value of the next state only, not the reward on the way there."
    )
    OWN_VALUE_DISCOUNTED = Misconception(
        "own-value-discounted",
        "γ discounts the value of the next state, which is one step away, not that of the state that is left.",
    )
    FORGOT_GAMMA = Misconception(
        "forgot-gamma", "The value of the next state is discounted by γ.", when=lambda given: given.gamma != 1
    )
    MAX_FOR_MEAN = Misconception(
        "max-for-mean", "The value of a policy averages over its actions; only the optimal value takes the maximum."
    )
    TRANSPOSED = Misconception("transposed-model", "P is the probability to go from s to s′; it was read from s′ to s.")
    CHANCES_TRANSPOSED = Misconception(
        "chances-transposed",
        "P is the probability to go from s to s′, the way that earns the reward; it was read from s′ to s.",
    )
    BELLMAN_V = Formula(
        "bellman-v",
        Vpi(s),
        SumOver(pi(a, s) * LOOKAHEAD_PI, a, Actions(s)),
        title="Bellman equation for V",
        source="Sutton & Barto 2018, eq. 3.14",
        hint="Average over the actions, then over where each leads: reward plus γ times the value there.",
        misread={
            FORGOT_POLICY: SumOver(LOOKAHEAD_PI, a, Actions(s)),
            DISCOUNTED_REWARD: SumOver(pi(a, s) * GAMMA_ON_REWARD, a, Actions(s)),
            FORGOT_GAMMA: SumOver(pi(a, s) * WITHOUT_GAMMA_PI, a, Actions(s)),
            MAX_FOR_MEAN: MaxOver(LOOKAHEAD_PI, a, Actions(s)),
            ACTIONS_ALIKE: MeanOver(LOOKAHEAD_PI, a, Actions(s)),
            Q_REWARD_UNWEIGHTED: SumOver(
                pi(a, s) * SumOver(R(s, a, s1) + P(s, a, s1) * gamma * Vpi(s1), s1, Successors(s, a)), a, Actions(s)
            ),
            TRANSPOSED: SumOver(
                pi(a, s) * SumOver(P(s1, a, s) * (R(s1, a, s) + gamma * Vpi(s1)), s1, States), a, Actions(s)
            ),
            CHANCES_TRANSPOSED: SumOver(
                pi(a, s) * SumOver(P(s1, a, s) * (R(s, a, s1) + gamma * Vpi(s1)), s1, States), a, Actions(s)
            ),
        },
    )

    Q_FORGOT_GAMMA = Misconception(
        "forgot-gamma-in-q", "The value of the next state is discounted by γ.", when=lambda given: given.gamma != 1
    )
    OWN_VALUE = Misconception(
        "own-value-for-next",
        "After the action the agent is in the next state s′: its value counts, not that of the state left behind.",
        when=lambda given: hasattr(given, "mdp") or given.state in given.values,
    )
    BELLMAN_Q = Formula(
        "bellman-q",
        Qpi(s, a),
        LOOKAHEAD_PI,
        title="Bellman equation for Q",
        source="Sutton & Barto 2018, exercise 3.13",
        hint="The action is fixed: average only over where it leads.",
        misread={
            Q_REWARD_UNWEIGHTED: SumOver(R(s, a, s1) + P(s, a, s1) * gamma * Vpi(s1), s1, Successors(s, a)),
            Q_FORGOT_GAMMA: WITHOUT_GAMMA_PI,
            OWN_VALUE: SumOver(P(s, a, s1) * (R(s, a, s1) + gamma * Vpi(s)), s1, Successors(s, a)),
        },
    )
    V_FROM_Q = Formula(
        "v-from-q",
        Vpi(s),
        SumOver(pi(a, s) * Qpi(s, a), a, Actions(s)),
        title="V from Q",
        source="Sutton & Barto 2018, exercise 3.12",
        hint="Average the action values with the policy's probabilities.",
        misread={
            MAX_FOR_MEAN: MaxOver(Qpi(s, a), a, Actions(s)),
            ACTIONS_ALIKE: MeanOver(Qpi(s, a), a, Actions(s)),
        },
    )
    RESIDUAL_SIGN = Misconception(
        "sign-of-residual", "The residual is the right side of the equation minus V(s), not V(s) minus the right side."
    )
    BELLMAN_RESIDUAL = Formula(
        "bellman-residual",
        Residual(s),
        SumOver(pi(a, s) * LOOKAHEAD, a, Actions(s)) - V(s),
        title="Bellman residual of V for a policy",
        source="Sutton & Barto 2018, section 11.4",
        hint="Work out the right side of the Bellman equation with the given V, and subtract what V says.",
        note="It is $0$ in every state exactly where $V = V^π$.",
        place=Place.WORKING,
        misread={
            RESIDUAL_SIGN: V(s) - SumOver(pi(a, s) * LOOKAHEAD, a, Actions(s)),
            MAX_FOR_MEAN: MaxOver(LOOKAHEAD, a, Actions(s)) - V(s),
            ACTIONS_ALIKE: MeanOver(LOOKAHEAD, a, Actions(s)) - V(s),
            FORGOT_GAMMA: SumOver(pi(a, s) * WITHOUT_GAMMA, a, Actions(s)) - V(s),
        },
    )
    RESIDUAL_MEAN = Misconception(
        "mean-for-max",
        "The optimal value takes the best action; it does not average over the actions.",
        when=lambda given: any(len(actions) > 1 for actions in given.mdp.actions.values()),
    )
    MAXIMA_APART = Misconception(
        "maxima-apart",
        "Reward and next value belong to one action: add them up for every action, and take the greatest sum.",
    )
    NEXT_VALUE = SumOver(P(s, a, s1) * V(s1), s1, Successors(s, a))
    BELLMAN_OPTIMALITY_RESIDUAL = Formula(
        "bellman-optimality-residual",
        Residual(s),
        MaxOver(LOOKAHEAD, a, Actions(s)) - V(s),
        title="Bellman residual of V for the optimal value",
        source="Sutton & Barto 2018, sections 3.6 and 11.4",
        hint="Work out the right side of the optimality equation with the given V, and subtract what V says.",
        note="It is $0$ in every state exactly where $V = V^*$.",
        place=Place.WORKING,
        misread={
            RESIDUAL_SIGN: V(s) - MaxOver(LOOKAHEAD, a, Actions(s)),
            RESIDUAL_MEAN: MeanOver(LOOKAHEAD, a, Actions(s)) - V(s),
            FORGOT_GAMMA: MaxOver(WITHOUT_GAMMA, a, Actions(s)) - V(s),
        },
    )
    BELLMAN_OPTIMALITY_V = Formula(
        "bellman-optimality-v",
        Vstar(s),
        MaxOver(LOOKAHEAD_STAR, a, Actions(s)),
        title="Bellman optimality equation for V",
        source="Sutton & Barto 2018, eq. 3.19",
        hint="Take the best action: the greatest of the actions' averages.",
        also=(MaxOver(Qstar(s, a), a, Actions(s)),),
        misread={
            MAXIMA_APART: MaxOver(SumOver(P(s, a, s1) * R(s, a, s1), s1, Successors(s, a)), a, Actions(s))
            + gamma * MaxOver(SumOver(P(s, a, s1) * Vstar(s1), s1, Successors(s, a)), a, Actions(s)),
            BEST_OUTCOME: MaxOver(MaxOver(R(s, a, s1) + gamma * Vstar(s1), s1, Successors(s, a)), a, Actions(s)),
            Q_REWARD_UNWEIGHTED: MaxOver(
                SumOver(R(s, a, s1) + P(s, a, s1) * gamma * Vstar(s1), s1, Successors(s, a)), a, Actions(s)
            ),
        },
    )
    OPTIMAL_Q_BY_VALUE = Misconception(
        "by-next-value-alone", "The reward on the way counts too: add γ times the best next value to it."
    )
    OPTIMAL_Q_BY_REWARD = Misconception(
        "by-reward-alone", "What comes after the reward counts too: add γ times the best value in the next state."
    )
    OPTIMAL_Q_MEAN_FOR_MAX = Misconception(
        "mean-for-max", "In the next state the best action is taken: the greatest of its values counts, not their mean."
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
        misread={
            OPTIMAL_Q_BY_VALUE: SumOver(P(s, a, s1) * MaxOver(Qstar(s1, a1), a1, Actions(s1)), s1, Successors(s, a)),
            OPTIMAL_Q_BY_REWARD: SumOver(P(s, a, s1) * R(s, a, s1), s1, Successors(s, a)),
            OPTIMAL_Q_MEAN_FOR_MAX: SumOver(
                P(s, a, s1) * (R(s, a, s1) + gamma * MeanOver(Qstar(s1, a1), a1, Actions(s1))),
                s1,
                Successors(s, a),
            ),
            Q_REWARD_UNWEIGHTED: SumOver(
                R(s, a, s1) + P(s, a, s1) * gamma * MaxOver(Qstar(s1, a1), a1, Actions(s1)), s1, Successors(s, a)
            ),
        },
    )
    MEAN_OF_Q_STAR = Misconception(
        "mean-for-max",
        "The optimal policy takes the best action, so the optimal value is the greatest, not the mean.",
    )
    POLICY_FOR_MAX = Misconception(
        "policy-for-max",
        "The optimal value does not depend on the given policy: it is the greatest action value.",
    )
    WEIGHTED_BEST = Misconception(
        "best-one-weighted",
        "An optimal policy takes the best action for sure: the optimal value is its whole value, not π(a|s) times it.",
    )
    V_STAR_FROM_Q = Formula(
        "optimal-v-from-q",
        Vstar(s),
        MaxOver(Qstar(s, a), a, Actions(s)),
        title="Optimal V from Q",
        source="Sutton & Barto 2018, section 3.6",
        hint="The optimal value of a state is that of its best action.",
        place=Place.WORKING,
        misread={
            MEAN_OF_Q_STAR: MeanOver(Qstar(s, a), a, Actions(s)),
            POLICY_FOR_MAX: SumOver(pi(a, s) * Qstar(s, a), a, Actions(s)),
            WEIGHTED_BEST: MaxOver(pi(a, s) * Qstar(s, a), a, Actions(s)),
        },
    )
    Q_STAR_FROM_V = Formula(
        "optimal-q-from-v",
        Qstar(s, a),
        LOOKAHEAD_STAR,
        title="Optimal Q from V",
        source="Sutton & Barto 2018, eq. 3.17",
        hint="The first action is fixed; from the next state on, $V^*$ counts the best that can follow.",
        place=Place.WORKING,
        misread={
            Q_FORGOT_GAMMA: SumOver(P(s, a, s1) * (R(s, a, s1) + Vstar(s1)), s1, Successors(s, a)),
            OWN_VALUE: SumOver(P(s, a, s1) * (R(s, a, s1) + gamma * Vstar(s)), s1, Successors(s, a)),
            OPTIMAL_Q_BY_REWARD: SumOver(P(s, a, s1) * R(s, a, s1), s1, Successors(s, a)),
            Q_REWARD_UNWEIGHTED: SumOver(R(s, a, s1) + P(s, a, s1) * gamma * Vstar(s1), s1, Successors(s, a)),
        },
    )
    TAIL_LEFT_OUT = Misconception(
        "tail-left-out", "The reward of the next step is not all: add the best total from the state that it leads to."
    )
    PRINCIPLE_OF_OPTIMALITY = Formula(
        "principle-of-optimality",
        Vstar(s),
        MaxOver(EdgeReward(s, s1) + Vstar(s1), s1, Successors(s)),
        title="Principle of optimality",
        source="Bertsekas 2017, section 2.1",
        hint="Begin at the goal and go backwards: the best tail from the next state is already known.",
        note="Any part of an optimal policy is optimal for the subproblem that starts there.",
        misread={
            TAIL_LEFT_OUT: MaxOver(EdgeReward(s, s1), s1, Successors(s)),
        },
    )
    BEST_WAY_TO = Formula(
        "best-way-to",
        Head(s),
        MaxOver(EdgeReward(s, s1) + Head(s1), s1, Successors(s)),
        title="Best way to a state that is to be visited",
        source="Bertsekas 2017, section 2.1",
        hint="Take the state that is to be visited for the goal, and go backwards from it.",
        place=Place.WORKING,
        misread={
            TAIL_LEFT_OUT: MaxOver(EdgeReward(s, s1), s1, Successors(s)),
        },
    )
    STATIONARY = Formula(
        "stationary-distribution",
        Share(s1),
        SumOver(Share(s) * SumOver(pi(a, s) * P(s, a, s1), a, Actions(s)), s, Predecessors(s1)),
        title="Stationary distribution",
        source="Sutton & Barto 2018, section 10.3; Puterman 1994, section 8.2",
        hint="A state is entered as often as it is left: add up, over the states that lead there, their share "
        "times the probability of that step.",
        place=Place.WORKING,
    )
    SHARES_SUM = Formula(
        "shares-sum",
        Integer(1),
        SumOver(Share(s), s, States),
        title="Sum of the stationary distribution",
        source="Puterman 1994, section 8.2",
        hint="One of the stationary equations follows from the others; that the shares sum to 1 takes its place.",
        place=Place.WORKING,
    )
    EQUAL_SHARES = Misconception(
        "equal-shares",
        "Each state counts with the share of the steps that begin there, not with the same weight.",
        when=lambda given: given.average,
    )
    AVERAGE_REWARD = Formula(
        "average-reward",
        average,
        SumOver(
            Share(s) * SumOver(pi(a, s) * SumOver(P(s, a, s1) * R(s, a, s1), s1, Successors(s, a)), a, Actions(s)),
            s,
            States,
        ),
        title="Average reward",
        source="Sutton & Barto 2018, section 10.3",
        hint="Average what a step earns in every state, with the states' shares of the steps as weights.",
        place=Place.WORKING,
        misread={
            EQUAL_SHARES: MeanOver(
                SumOver(pi(a, s) * SumOver(P(s, a, s1) * R(s, a, s1), s1, Successors(s, a)), a, Actions(s)), s, States
            ),
        },
    )
