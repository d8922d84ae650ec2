"""Section 5 of the sheet: TD control; beyond it, what else there is to learn from a choice of actions."""

from typing import Any

from msgspec.structs import replace
from sympy import Expr, evaluate, exp, log, sqrt

from rldrill.problems.mathematics import (
    Accent,
    Fence,
    Math,
    Script,
    listed,
    number,
    operator,
    punctuation,
    row,
    variable,
)
from rldrill.solutions.asking_back import asks_for
from rldrill.solutions.formula.formula import Formula, Misconception, Place
from rldrill.solutions.formula.notation import (
    A,
    Actions,
    ArgMaxOver,
    Cases,
    Choices,
    Counting,
    Indicator,
    MaxOver,
    MeanOver,
    Member,
    ProductOver,
    Q,
    S,
    Size,
    SumOver,
    T,
    Visited,
    a,
    a1,
    alpha,
    b,
    called,
    conditioned,
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
    subscripted,
    t,
)
from rldrill.solutions.sheet.temporal_difference import TARGET_FOR_VALUE


def _starred(head: str) -> Script:
    return Script(variable(head), above=operator("*"))


def _numbered_table(index: Math, *arguments: Math) -> Math:
    return row(Script(variable("Q"), index), Fence(listed(arguments)))


j = letter("j")
c = letter("c")
y = quantity("y", subscripted("y"))
delta = quantity("delta", subscripted("δ"))
e = quantity("e", called("e"))
Best = quantity("best", called(_starred("a")))
Greedy = quantity("greedy", called(_starred("A")))
Qi = quantity("Qi", _numbered_table)
Selected = quantity("selected", lambda time: Script(variable("a"), time, operator("*")))
behaviour = quantity("behaviour", conditioned("b"))
rho = quantity("rho", subscripted("ρ"))
V_hat = quantity("V", called(Script(Accent(variable("V"), "hat"), above=variable("π"))))
#: R₀ of an episode; the lecture writes an n in brackets above the R for a return of n steps.
Ri = quantity("Ri", lambda episode: Script(variable("R"), row(number(0), punctuation(","), episode)))
N = quantity("N", called("N"))
U = quantity("U", called("U"))
H = quantity("H", called("H"))
rbar = quantity("rbar", subscripted(Accent(variable("r"), "bar")))
model_reward = quantity("model_reward", called(Accent(variable("r"), "hat")))
model_next = quantity("model_next", called(Accent(variable("s"), "hat")))


def _next_action_is_known_here(given: Any) -> bool:
    """Whether every action that is taken next also has a value in the state that is left."""
    return all(
        move.next in given.terminal or move.following is None or move.following in given.values[move.state]
        for move in given.moves
    )


def _last_action_is_known(given: Any) -> bool:
    return bool(given.last_action_known)


def _moved(target: Expr) -> Expr:
    """The value of the pair just left, moved a step α towards a target."""
    return Q(S(t), A(t)) + alpha * (target - Q(S(t), A(t)))


with evaluate(False):
    _SARSA_TARGET = r(t + 1) + gamma * Q(S(t + 1), A(t + 1))
    _Q_LEARNING_TARGET = r(t + 1) + gamma * MaxOver(Q(S(t + 1), a), a, Actions(S(t + 1)))
    _WITHOUT_GAMMA = r(t + 1) + Q(S(t + 1), A(t + 1))
    _MAX_WITHOUT_GAMMA = r(t + 1) + MaxOver(Q(S(t + 1), a), a, Actions(S(t + 1)))
    _MEAN_TARGET = r(t + 1) + gamma * MeanOver(Q(S(t + 1), a), a, Actions(S(t + 1)))

    MAX_FOR_TAKEN = Misconception(
        "max-for-action-taken",
        "Sarsa takes the value of the action taken in the next state; the greatest is Q-learning's.",
    )
    STATE_FOR_NEXT = Misconception(
        "state-for-next-state",
        "The next action is valued in the next state s′, where it is taken, not in the state that is left.",
        when=_next_action_is_known_here,
    )
    SARSA_FORGOT_GAMMA = Misconception(
        "forgot-gamma",
        "The value of the next pair of state and action is discounted by γ.",
        when=lambda given: not asks_for(given, "gamma"),
    )
    TARGET_FOR_PAIR = replace(TARGET_FOR_VALUE, when=lambda given: not asks_for(given, "alpha"))
    SARSA = Formula(
        "sarsa",
        Q(S(t), A(t)),
        _moved(_SARSA_TARGET),
        title="Sarsa",
        source="Sutton & Barto 2018, eq. 6.7",
        hint="The target takes the value of the action that is taken in the next state, best or not.",
        sign="←",
        misread={
            MAX_FOR_TAKEN: _moved(_Q_LEARNING_TARGET),
            STATE_FOR_NEXT: _moved(r(t + 1) + gamma * Q(S(t), A(t + 1))),
            SARSA_FORGOT_GAMMA: _moved(_WITHOUT_GAMMA),
            TARGET_FOR_PAIR: _SARSA_TARGET,
        },
    )

    SARSA_TARGET_FORGOT_GAMMA = Misconception(
        "sarsa-forgot-gamma", "In Sarsa's target too the value of the next pair of state and action is discounted by γ."
    )
    SARSA_TARGET = Formula(
        "sarsa-target",
        y(t),
        _SARSA_TARGET,
        title="Target of Sarsa",
        source="Sutton & Barto 2018, eq. 6.7",
        hint="Reward plus γ times the value of the action that is taken in the next state, best or not.",
        place=Place.WORKING,
        misread={
            SARSA_TARGET_FORGOT_GAMMA: _WITHOUT_GAMMA,
        },
    )

    TOWARDS_TARGET = Formula(
        "towards-target",
        Q(S(t), A(t)),
        _moved(y(t)),
        title="Update towards a target",
        source="Sutton & Barto 2018, eq. 2.4",
        hint="Move the old value a step α towards the target.",
        sign="←",
        place=Place.WORKING,
    )
    SARSA_TD_ERROR = Formula(
        "sarsa-td-error",
        delta(t),
        _SARSA_TARGET - Q(S(t), A(t)),
        title="TD error of Sarsa",
        source="Sutton & Barto 2018, section 12.7",
        hint="Sarsa's target minus the old value of the pair just left.",
        misread={
            MAX_FOR_TAKEN: _Q_LEARNING_TARGET - Q(S(t), A(t)),
        },
    )
    TRACE_WITHOUT_LAMBDA = Misconception(
        "decay-without-lambda",
        "Traces decay by the product γλ, not by γ alone.",
        when=lambda given: not asks_for(given, "lambda"),
    )
    TRACE_WITHOUT_GAMMA = Misconception(
        "decay-without-gamma", "Traces decay by the product γλ, not by λ alone.", when=lambda given: given.gamma != 1
    )
    ACTION_TRACE = Formula(
        "action-eligibility-trace",
        e(s, a),
        gamma * lam * e(s, a) + Visited(s, S(t), a, A(t)),
        title="Eligibility trace of an action",
        source="Sutton & Barto 2018, section 12.7; 1998, section 7.5",
        hint="Let every trace decay by γλ, then add 1 to the trace of the pair just visited.",
        sign="←",
        misread={
            TRACE_WITHOUT_LAMBDA: gamma * e(s, a) + Visited(s, S(t), a, A(t)),
            TRACE_WITHOUT_GAMMA: lam * e(s, a) + Visited(s, S(t), a, A(t)),
        },
    )
    ACCUMULATING_ACTION_TRACE = Misconception(
        "accumulating-trace",
        "A replacing trace is set to 1 at a visit; only accumulating traces add 1 to what is left.",
    )
    REPLACING_ACTION_TRACE = Formula(
        "replacing-action-trace",
        e(s, a),
        Cases(Indicator(s, S(t), a, A(t)), 1, gamma * lam * e(s, a)),
        title="Replacing eligibility trace of an action",
        source="Sutton & Barto 1998, section 7.8",
        hint="The trace of the visited pair is set to 1; every other one decays by γλ.",
        sign="←",
        place=Place.WORKING,
        misread={
            ACCUMULATING_ACTION_TRACE: gamma * lam * e(s, a) + Visited(s, S(t), a, A(t)),
            TRACE_WITHOUT_LAMBDA: Cases(Indicator(s, S(t), a, A(t)), 1, gamma * e(s, a)),
            TRACE_WITHOUT_GAMMA: Cases(Indicator(s, S(t), a, A(t)), 1, lam * e(s, a)),
        },
    )
    SARSA_LAMBDA = Formula(
        "sarsa-lambda",
        Q(s, a),
        Q(s, a) + alpha * delta(t) * e(s, a),
        title="Sarsa(λ)",
        source="Sutton & Barto 2018, section 12.7; 1998, section 7.5",
        hint="Every pair moves by α times the one TD error δ, in proportion to its own trace.",
        sign="←",
        note="For all pairs of state and action, after their traces.",
    )

    NOT_DISCOUNTED = Misconception(
        "forgot-gamma",
        "The value of the next state is discounted by γ.",
        when=lambda given: given.gamma != 1 and not asks_for(given, "gamma"),
    )
    TAKEN_FOR_MAX = Misconception(
        "action-taken-for-max",
        "Q-learning takes the greatest action value of the next state; the action taken there is Sarsa's.",
        when=_last_action_is_known,
    )
    MEAN_FOR_MAX = Misconception(
        "mean-for-max", "Q-learning takes the greatest action value of the next state, not the mean."
    )
    MAX_OF_OLD_STATE = Misconception(
        "max-over-state-left",
        "The greatest action value is taken in the next state, not in the state that is left.",
    )
    Q_LEARNING = Formula(
        "q-learning",
        Q(S(t), A(t)),
        _moved(_Q_LEARNING_TARGET),
        title="Q-learning",
        source="Sutton & Barto 2018, eq. 6.8",
        hint="The target takes the best action value of the next state, whatever is done there.",
        sign="←",
        misread={
            TAKEN_FOR_MAX: _moved(_SARSA_TARGET),
            MEAN_FOR_MAX: _moved(_MEAN_TARGET),
            NOT_DISCOUNTED: _moved(_MAX_WITHOUT_GAMMA),
            MAX_OF_OLD_STATE: _moved(r(t + 1) + gamma * MaxOver(Q(S(t), a), a, Actions(S(t)))),
            TARGET_FOR_PAIR: _Q_LEARNING_TARGET,
        },
    )

    Q_LEARNING_TARGET_FORGOT_GAMMA = Misconception(
        "q-learning-forgot-gamma", "In Q-learning's target too the value of the next state is discounted by γ."
    )
    Q_LEARNING_TARGET = Formula(
        "q-learning-target",
        y(t),
        _Q_LEARNING_TARGET,
        title="Target of Q-learning",
        source="Sutton & Barto 2018, eq. 6.8",
        hint="Reward plus γ times the best action value of the next state, whatever is done there.",
        place=Place.WORKING,
        misread={
            Q_LEARNING_TARGET_FORGOT_GAMMA: _MAX_WITHOUT_GAMMA,
        },
    )

    def _planned(target: Expr) -> Expr:
        return Q(s, a) + alpha * (target - Q(s, a))

    OWN_STATE_MAX = Misconception(
        "max-over-own-state",
        "A planned update takes the greatest action value of the next state in the model, not of the state it updates.",
    )
    PLANNED_UPDATE = Formula(
        "planned-update",
        Q(s, a),
        _planned(model_reward(s, a) + gamma * MaxOver(Q(model_next(s, a), a1), a1, Actions(model_next(s, a)))),
        title="Planned update of Dyna-Q",
        source="Sutton & Barto 2018, section 8.2",
        hint="Update as Q-learning does, with the reward and the next state that the model holds for this pair.",
        sign="←",
        note="The model holds the reward $r̂$ and the next state $ŝ$ that followed last.",
        place=Place.BEYOND,
        misread={
            MEAN_FOR_MAX: _planned(
                model_reward(s, a) + gamma * MeanOver(Q(model_next(s, a), a1), a1, Actions(model_next(s, a)))
            ),
            NOT_DISCOUNTED: _planned(
                model_reward(s, a) + MaxOver(Q(model_next(s, a), a1), a1, Actions(model_next(s, a)))
            ),
            OWN_STATE_MAX: _planned(model_reward(s, a) + gamma * MaxOver(Q(s, a1), a1, Actions(s))),
        },
    )

    Q_LEARNING_TD_ERROR = Formula(
        "q-learning-td-error",
        delta(t),
        _Q_LEARNING_TARGET - Q(S(t), A(t)),
        title="TD error of Q-learning",
        source="Sutton & Barto 2018, eq. 6.8",
        hint="Q-learning's target minus the old value of the pair just left.",
        place=Place.WORKING,
        misread={
            TAKEN_FOR_MAX: _SARSA_TARGET - Q(S(t), A(t)),
            NOT_DISCOUNTED: _MAX_WITHOUT_GAMMA - Q(S(t), A(t)),
        },
    )

    SHARE_FORGOTTEN = Misconception(
        "share-of-epsilon-forgotten",
        "Exploring picks among all actions, so the greedy action gets its share ε/|A| too, on top of 1 − ε.",
    )
    SHARED_AMONG_OTHERS = Misconception(
        "shared-among-the-others",
        "Exploring picks among all |A| actions, the greedy one too, not among the other |A| − 1.",
    )
    EXPLORING_FORGOTTEN = Misconception(
        "exploring-forgotten",
        "What is left beside 1 − ε is not lost: with probability ε one of all |A| actions is taken, which counts too.",
    )
    EPSILON_GREEDY = Formula(
        "epsilon-greedy",
        pi(a, s),
        Cases(Indicator(a, Best(s)), 1 - epsilon + epsilon / Size(Actions(s)), epsilon / Size(Actions(s))),
        title="ε-greedy policy",
        source="Sutton & Barto 2018, section 5.4",
        hint="Every action, the greedy one too, gets its share of ε; the greedy one gets 1 − ε on top.",
        misread={
            SHARE_FORGOTTEN: Cases(Indicator(a, Best(s)), 1 - epsilon, epsilon / Size(Actions(s))),
            SHARED_AMONG_OTHERS: Cases(Indicator(a, Best(s)), 1 - epsilon, epsilon / (Size(Actions(s)) - 1)),
            EXPLORING_FORGOTTEN: Cases(Indicator(a, Best(s)), 1 - epsilon, 0),
        },
    )

    TIED_SHARE_FORGOTTEN = Misconception(
        "share-of-epsilon-forgotten-in-a-tie",
        "Exploring picks among all actions, so the tied best actions get their shares ε/|A| too.",
    )
    TIED_SHARED_AMONG_OTHERS = Misconception(
        "shared-among-those-not-best",
        "Exploring picks among all |A| actions, the tied best ones too, not among the others only.",
        when=lambda given: len(given.best) < len(given.values),
    )
    NOT_SPLIT = Misconception(
        "not-split-in-a-tie", "Tied best actions share the probability 1 − ε; none of them alone has all of it."
    )
    EPSILON_GREEDY_TIED = Formula(
        "epsilon-greedy-tied",
        pi(a, s),
        Cases(
            Member(a, Greedy(s)),
            (1 - epsilon) / Size(Greedy(s)) + epsilon / Size(Actions(s)),
            epsilon / Size(Actions(s)),
        ),
        title="ε-greedy policy with tied best actions",
        source="Sutton & Barto 2018, sections 2.2 and 5.4",
        hint="The best actions share 1 − ε evenly; on top, every action gets its share of ε.",
        place=Place.WORKING,
        misread={
            TIED_SHARE_FORGOTTEN: Cases(
                Member(a, Greedy(s)), (1 - epsilon) / Size(Greedy(s)), epsilon / Size(Actions(s))
            ),
            TIED_SHARED_AMONG_OTHERS: Cases(
                Member(a, Greedy(s)),
                (1 - epsilon) / Size(Greedy(s)),
                epsilon / (Size(Actions(s)) - Size(Greedy(s))),
            ),
            NOT_SPLIT: Cases(
                Member(a, Greedy(s)), 1 - epsilon + epsilon / Size(Actions(s)), epsilon / Size(Actions(s))
            ),
        },
    )

    MAX_FOR_EXPECTATION = Misconception(
        "max-for-expectation",
        "Expected Sarsa averages over the policy's actions; the greatest value is Q-learning's.",
        when=lambda given: not asks_for(given, "epsilon"),
    )
    SAMPLE_FOR_EXPECTATION = Misconception(
        "sample-for-expectation",
        "Expected Sarsa averages over all actions of the policy; the one that was taken is Sarsa's.",
        when=lambda given: _last_action_is_known(given) and not asks_for(given, "epsilon"),
    )
    UNWEIGHTED_EXPECTATION = Misconception(
        "unweighted-mean",
        "Each action value counts with the probability π(a|s′) of its action; a plain mean does not.",
        when=lambda given: not asks_for(given, "epsilon"),
    )
    EXPECTED_FORGOT_GAMMA = Misconception(
        "forgot-gamma",
        "The expected value of the next state is discounted by γ.",
        when=lambda given: not asks_for(given, "gamma"),
    )
    EXPECTED_SARSA = Formula(
        "expected-sarsa",
        Q(S(t), A(t)),
        _moved(r(t + 1) + gamma * SumOver(pi(a, S(t + 1)) * Q(S(t + 1), a), a, Actions(S(t + 1)))),
        title="Expected Sarsa",
        source="Sutton & Barto 2018, eq. 6.9",
        hint="The target averages the next state's action values, each with its probability under the policy.",
        sign="←",
        place=Place.BEYOND,
        misread={
            MAX_FOR_EXPECTATION: _moved(_Q_LEARNING_TARGET),
            SAMPLE_FOR_EXPECTATION: _moved(_SARSA_TARGET),
            UNWEIGHTED_EXPECTATION: _moved(_MEAN_TARGET),
            EXPECTED_FORGOT_GAMMA: _moved(r(t + 1) + SumOver(pi(a, S(t + 1)) * Q(S(t + 1), a), a, Actions(S(t + 1)))),
        },
    )

    _SELECT = ArgMaxOver(Qi(i, S(t + 1), a), a, Actions(S(t + 1)))

    OTHER_TABLE_SELECTS = Misconception(
        "other-table-selects",
        "The table that is updated selects the action; the other one only says what that action is worth.",
    )
    ROLES_EXCHANGED = Misconception(
        "roles-exchanged", "The table that is updated selects the action and the other one values it, not the reverse."
    )
    DOUBLE_Q_ACTION = Formula(
        "double-q-action",
        Selected(t + 1),
        _SELECT,
        title="Double Q-learning: the action selected",
        source="Sutton & Barto 2018, eq. 6.10",
        hint="The table that is updated selects its best action of the next state.",
        place=Place.WORKING,
        misread={
            OTHER_TABLE_SELECTS: ArgMaxOver(Qi(j, S(t + 1), a), a, Actions(S(t + 1))),
            ROLES_EXCHANGED: ArgMaxOver(Qi(j, S(t + 1), a), a, Actions(S(t + 1))),
        },
    )
    SAME_TABLE_EVALUATES = Misconception(
        "same-table-evaluates",
        "The selected action is valued by the other table; with the same table it is plain Q-learning.",
    )
    DOUBLE_Q_LEARNING = Formula(
        "double-q-learning",
        Qi(i, S(t), A(t)),
        Qi(i, S(t), A(t)) + alpha * (r(t + 1) + gamma * Qi(j, S(t + 1), Selected(t + 1)) - Qi(i, S(t), A(t))),
        title="Double Q-learning",
        source="Sutton & Barto 2018, eq. 6.10",
        hint="The table that is updated selects the next action; the other table says what it is worth.",
        sign="←",
        also=(Qi(i, S(t), A(t)) + alpha * (r(t + 1) + gamma * Qi(j, S(t + 1), _SELECT) - Qi(i, S(t), A(t))),),
        note="$i$ is the table that is updated, $j$ the other one.",
        place=Place.BEYOND,
        hidden=True,
        misread={
            SAME_TABLE_EVALUATES: Qi(i, S(t), A(t))
            + alpha * (r(t + 1) + gamma * Qi(i, S(t + 1), Selected(t + 1)) - Qi(i, S(t), A(t))),
            ROLES_EXCHANGED: Qi(i, S(t), A(t))
            + alpha * (r(t + 1) + gamma * Qi(i, S(t + 1), Selected(t + 1)) - Qi(i, S(t), A(t))),
            NOT_DISCOUNTED: Qi(i, S(t), A(t))
            + alpha * (r(t + 1) + Qi(j, S(t + 1), Selected(t + 1)) - Qi(i, S(t), A(t))),
        },
    )

    _STEPS = Counting(0, T - 1)
    _EPISODES = Counting(1, n)

    RATIO_INVERTED = Misconception(
        "ratio-inverted",
        "The target policy π stands above the line and the behaviour policy b, which acted, below it.",
        when=lambda given: given.target_takes_all,
    )
    RATIOS_ADDED = Misconception(
        "ratios-added",
        "An episode has the product of its actions' probabilities, so their ratios are multiplied, not added.",
        when=lambda given: any(len(episode.rewards) > 1 for episode in given.episodes),
    )
    FIRST_ACTION_ALONE = Misconception(
        "first-action-alone",
        "The ratio of an episode is the product over all its actions, not that of its first action alone.",
        when=lambda given: any(len(episode.rewards) > 1 for episode in given.episodes),
    )
    IMPORTANCE_RATIO = Formula(
        "importance-ratio",
        rho(i),
        ProductOver(pi(A(t), S(t)) / behaviour(A(t), S(t)), t, _STEPS),
        title="Importance sampling ratio of an episode",
        source="Sutton & Barto 2018, eq. 5.3",
        hint="For every action taken divide its target probability by its behaviour probability, and multiply.",
        place=Place.BEYOND,
        misread={
            RATIO_INVERTED: ProductOver(behaviour(A(t), S(t)) / pi(A(t), S(t)), t, _STEPS),
            RATIOS_ADDED: SumOver(pi(A(t), S(t)) / behaviour(A(t), S(t)), t, _STEPS),
            FIRST_ACTION_ALONE: pi(A(0), S(0)) / behaviour(A(0), S(0)),
        },
    )
    WEIGHTED_FOR_ORDINARY = Misconception(
        "weighted-for-ordinary",
        "The ordinary estimate divides by the number of episodes; the sum of the ratios is the weighted one's.",
    )
    RATIOS_FORGOTTEN = Misconception(
        "ratios-forgotten", "A plain mean estimates the value of the behaviour policy b; the ratios correct for that."
    )
    SUM_OF_EPISODES = Misconception(
        "sum-of-episodes",
        "The estimate is a mean over the episodes: divide the sum by their number n.",
        when=lambda given: len(given.episodes) > 1,
    )
    ORDINARY_IMPORTANCE_SAMPLING = Formula(
        "ordinary-importance-sampling",
        V_hat(S(0)),
        SumOver(rho(i) * Ri(i), i, _EPISODES) / n,
        title="Ordinary importance sampling",
        source="Sutton & Barto 2018, eq. 5.5",
        hint="Weight every episode's return with its ratio, add, and divide by the number of episodes.",
        place=Place.BEYOND,
        misread={
            WEIGHTED_FOR_ORDINARY: SumOver(rho(i) * Ri(i), i, _EPISODES) / SumOver(rho(i), i, _EPISODES),
            RATIOS_FORGOTTEN: SumOver(Ri(i), i, _EPISODES) / n,
            SUM_OF_EPISODES: SumOver(rho(i) * Ri(i), i, _EPISODES),
        },
    )
    ORDINARY_FOR_WEIGHTED = Misconception(
        "ordinary-for-weighted",
        "The weighted estimate divides by the sum of the ratios; the number of episodes is the ordinary one's.",
        when=lambda given: len(given.episodes) > 1,
    )
    WEIGHTED_IMPORTANCE_SAMPLING = Formula(
        "weighted-importance-sampling",
        V_hat(S(0)),
        SumOver(rho(i) * Ri(i), i, _EPISODES) / SumOver(rho(i), i, _EPISODES),
        title="Weighted importance sampling",
        source="Sutton & Barto 2018, eq. 5.6",
        hint="Weight every episode's return with its ratio, add, and divide by the sum of the ratios.",
        place=Place.BEYOND,
        misread={
            ORDINARY_FOR_WEIGHTED: SumOver(rho(i) * Ri(i), i, _EPISODES) / n,
        },
    )

    _EARNED = SumOver(r(i) * Indicator(A(i), a), i, Counting(1, n))

    ALL_PULLS_COUNTED = Misconception(
        "all-pulls-counted", "Each arm's rewards are divided by the number of its own pulls, not of all pulls."
    )
    ARM_ESTIMATE = Formula(
        "arm-estimate",
        Q(a),
        _EARNED / SumOver(Indicator(A(i), a), i, Counting(1, n)),
        title="Sample average of an arm",
        source="Sutton & Barto 2018, eq. 2.1",
        hint="Add the rewards of this arm's own pulls, and divide by how many those were.",
        place=Place.WORKING,
        misread={
            ALL_PULLS_COUNTED: _EARNED / n,
        },
    )
    GREEDY_ARM = Formula(
        "greedy-arm",
        A(n + 1),
        ArgMaxOver(Q(a), a, Choices),
        title="Greedy arm",
        source="Sutton & Barto 2018, eq. 2.2",
        hint="Take the arm whose estimate is greatest.",
        place=Place.WORKING,
    )
    TIME_FOR_LOG = Misconception("t-for-ln-t", "Under the root stands the logarithm ln t, not the time t itself.")
    OWN_COUNT_FORGOTTEN = Misconception(
        "own-count-forgotten",
        "ln t is divided by the arm's own count N(a): the bonus shrinks as an arm is pulled more often.",
    )
    PULLS_FOR_TIME = Misconception(
        "pulls-for-time",
        "t is the time of the pull that comes next; the number of pulls so far is one less.",
    )
    LOG_10_IN_UCB = Misconception("log-base", "The logarithm ln t under the root is natural, to the base e.")
    ROOT_FORGOTTEN = Misconception(
        "root-forgotten", "The bonus is c times the square root of (ln t)/N(a), not c times the quotient itself."
    )
    COUNT_OUTSIDE_THE_ROOT = Misconception(
        "count-outside-the-root", "N(a) stands under the root, too: the bonus shrinks as 1/√N(a), not as 1/N(a)."
    )
    UCB = Formula(
        "ucb",
        U(a),
        Q(a) + c * sqrt(log(t) / N(a)),
        title="Upper confidence bound of an arm",
        source="Sutton & Barto 2018, eq. 2.10",
        hint="To the estimate add c times the root of ln t divided by how often this arm was pulled.",
        place=Place.BEYOND,
        misread={
            TIME_FOR_LOG: Q(a) + c * sqrt(t / N(a)),
            ROOT_FORGOTTEN: Q(a) + c * log(t) / N(a),
            OWN_COUNT_FORGOTTEN: Q(a) + c * sqrt(log(t)),
            PULLS_FOR_TIME: Q(a) + c * sqrt(log(t - 1) / N(a)),
            LOG_10_IN_UCB: Q(a) + c * sqrt(log(t) / log(10) / N(a)),
            COUNT_OUTSIDE_THE_ROOT: Q(a) + c * sqrt(log(t)) / N(a),
        },
    )
    UCB_ARM = Formula(
        "ucb-arm",
        A(t),
        ArgMaxOver(U(a), a, Choices),
        title="Arm chosen by UCB",
        source="Sutton & Barto 2018, eq. 2.10",
        hint="Take the arm whose upper confidence bound is greatest, not the one whose estimate is.",
        place=Place.WORKING,
    )

    UCB_BALANCE = Formula(
        "ucb-balance",
        c,
        (Q(a) - Q(b)) / (sqrt(log(t) / N(b)) - sqrt(log(t) / N(a))),
        title="Weight with which two upper confidence bounds are equal",
        source="Sutton & Barto 2018, from eq. 2.10",
        hint="Write both bounds with c, set them equal, and solve for c.",
        place=Place.WORKING,
        misread={
            TIME_FOR_LOG: (Q(a) - Q(b)) / (sqrt(t / N(b)) - sqrt(t / N(a))),
            ROOT_FORGOTTEN: (Q(a) - Q(b)) / (log(t) / N(b) - log(t) / N(a)),
            PULLS_FOR_TIME: (Q(a) - Q(b)) / (sqrt(log(t - 1) / N(b)) - sqrt(log(t - 1) / N(a))),
            COUNT_OUTSIDE_THE_ROOT: (Q(a) - Q(b)) / (sqrt(log(t)) / N(b) - sqrt(log(t)) / N(a)),
        },
    )

    BANDIT_WITHOUT_EXP = Misconception(
        "normalised-without-exp",
        "The preferences are exponentiated before they are normalised.",
        when=lambda given: not given.sum_to_zero,
    )
    GRADIENT_BANDIT_POLICY = Formula(
        "gradient-bandit-policy",
        pi(a),
        exp(H(a)) / SumOver(exp(H(b)), b, Choices),
        title="Gradient bandit: probabilities",
        source="Sutton & Barto 2018, eq. 2.11",
        hint="Exponentiate every arm's preference, then divide by the sum of them all.",
        place=Place.BEYOND,
        misread={
            BANDIT_WITHOUT_EXP: H(a) / SumOver(H(b), b, Choices),
        },
    )
    OWN_MEAN_AS_BASELINE = Misconception(
        "own-mean-as-baseline",
        "The baseline is the mean of all rewards so far, whichever arm earned them, not of those of the arm pulled.",
        when=lambda given: any(pull.arm == given.pulled.arm for pull in given.pulls),
    )
    REWARD_BASELINE = Formula(
        "reward-baseline",
        rbar(n),
        SumOver(r(i), i, Counting(1, n)) / n,
        title="Gradient bandit: baseline",
        source="Sutton & Barto 2018, section 2.8",
        hint="The baseline is the mean of all rewards so far, whichever arm earned them.",
        place=Place.WORKING,
        misread={
            OWN_MEAN_AS_BASELINE: SumOver(r(i) * Indicator(A(i), A(n + 1)), i, Counting(1, n))
            / SumOver(Indicator(A(i), A(n + 1)), i, Counting(1, n)),
        },
    )
    BASELINE_FORGOTTEN = Misconception(
        "baseline-forgotten", "What counts is how far the reward is above or below the baseline, not the reward itself."
    )
    OTHERS_UNCHANGED = Misconception(
        "others-unchanged", "The preferences of the arms that were not pulled move too, the other way."
    )
    OTHERS_BY_COMPLEMENT = Misconception(
        "complement-for-the-others",
        "Only the arm that was pulled moves by 1 − π(a); every other one moves by its own π(a), the other way.",
    )
    GRADIENT_BANDIT = Formula(
        "gradient-bandit",
        H(a),
        Cases(
            Indicator(a, A(n + 1)),
            H(a) + alpha * (r(n + 1) - rbar(n)) * (1 - pi(a)),
            H(a) - alpha * (r(n + 1) - rbar(n)) * pi(a),
        ),
        title="Gradient bandit: preferences",
        source="Sutton & Barto 2018, eq. 2.12",
        hint="A reward above the baseline raises the preference of the arm pulled, and lowers all others.",
        sign="←",
        note="$r̄_n$ is the mean of the rewards so far.",
        place=Place.BEYOND,
        misread={
            BASELINE_FORGOTTEN: Cases(
                Indicator(a, A(n + 1)),
                H(a) + alpha * r(n + 1) * (1 - pi(a)),
                H(a) - alpha * r(n + 1) * pi(a),
            ),
            OTHERS_BY_COMPLEMENT: Cases(
                Indicator(a, A(n + 1)),
                H(a) + alpha * (r(n + 1) - rbar(n)) * (1 - pi(a)),
                H(a) - alpha * (r(n + 1) - rbar(n)) * (1 - pi(a)),
            ),
            OTHERS_UNCHANGED: Cases(Indicator(a, A(n + 1)), H(a) + alpha * (r(n + 1) - rbar(n)) * (1 - pi(a)), H(a)),
        },
    )
