"""Section 1 of the sheet: the Markov property, returns and the goal."""

from functools import cache

from msgspec.structs import replace
from sympy import Expr, Pow, evaluate

from rldrill.problems.mathematics import Fence, Math, Script, listed, operator, relation, row, variable, word
from rldrill.problems.pictures import Timeline
from rldrill.solutions.formula.formula import Formula, Misconception, Place
from rldrill.solutions.formula.notation import (
    DOTS,
    INFINITY,
    A,
    Counting,
    G,
    MaxOver,
    MeanOver,
    P,
    ProductOver,
    S,
    States,
    SumOver,
    T,
    called,
    conditioned,
    gamma,
    gammas,
    h,
    i,
    letter,
    n,
    pi,
    quantity,
    r,
    s,
    s1,
    t,
)
from rldrill.solutions.sheet import Gallery


def _is(event: Math, outcome: Math) -> Math:
    return row(event, relation("="), outcome)


_TAU = variable("τ")


def _of_episode(run: Math) -> Math:
    """(τ), or (τ₁) where the number of an episode is put in."""
    return Fence(run if run == _TAU else Script(_TAU, run))


tau = letter("tau", "τ")
reward = letter("reward", "r")
Episodes = letter("episodes", "E")
_R_0 = Script(variable("R"), word("0"))
expected_return = letter("expected_return", row(Script(operator("𝔼"), variable("π")), Fence(_R_0)))

Is = quantity("is_", _is)
Pair = quantity("pair", lambda *items: listed(items))
Pr = quantity("Pr", conditioned(word("Pr")))
#: How often three states were seen one after the other; or with what probability they are.
N = quantity("N", called("N"))
Joint = quantity("N", called(word("Pr")))
Start = quantity("start", called(word("Pr")))
#: The probability of an episode, its return, and its return from a time.
EpisodePr = quantity("episode_pr", lambda run: row(word("Pr"), _of_episode(run)))
EpisodeReturn = quantity("episode_return", lambda run: row(_R_0, _of_episode(run)))
ReturnOf = quantity("G", lambda below, run=_TAU: row(Script(variable("R"), below), _of_episode(run)))

GALLERY = Gallery(
    (
        Timeline(
            times=("",) * 3,
            states=("$s_t$", "$s_{t+1}$", "$s_{t+2}$"),
            actions=("$a_t$", "$a_{t+1}$", "$a_{t+2}$"),
            rewards=("$r_{t+1}$", "$r_{t+2}$"),
        ),
    )
)

with evaluate(False):
    _NEXT = Pair(Is(S(t + 1), s), Is(r(t + 1), reward))

    MARKOV_PROPERTY = Formula(
        "markov-property",
        Pr(_NEXT, S(0), A(0), r(1), DOTS, r(t), S(t), A(t)),
        Pr(_NEXT, S(t), A(t)),
        title="Markov property",
        source="Sutton & Barto 2018, section 3.1",
        hint="Given the present state and action, what came before them changes no probability.",
    )

    _SEEN = N(S(t - 1), S(t), S(t + 1))

    JOINT_FOR_CONDITIONAL = Misconception(
        "joint-for-conditional",
        "That is the joint probability of all three states; given the history, divide by the history's own total.",
    )
    HISTORY_LEFT_OUT = Misconception(
        "history-left-out-below",
        "Below the line only the rows with the same whole history count, not all rows with the same present state.",
    )
    ROWS_PUT_TOGETHER = Misconception(
        "rows-put-together",
        "Each history has a row of its own: rows with the same present state are not added up, they are compared.",
    )
    COLUMN_FOR_ROW = Misconception(
        "column-for-row",
        "Divide by the total of the history's row: that of the column would give Pr(history|next state).",
    )
    ODDS_FOR_SHARE = Misconception(
        "odds-for-share",
        "A probability is the share of all cases, not the odds: divide by the total of the row, all its numbers added.",
    )
    RELATIVE_FREQUENCY = Formula(
        "relative-frequency",
        Pr(S(t + 1), S(t - 1), S(t)),
        _SEEN * Pow(SumOver(N(S(t - 1), S(t), s1), s1, States), -1),
        title="Probability of the next state, from a table",
        source="Thrun, Burgard & Fox 2005, section 2.2",
        hint="Divide by the total of the rows with the same history, not by the total of the table.",
        place=Place.WORKING,
        misread={
            JOINT_FOR_CONDITIONAL: _SEEN
            * Pow(SumOver(SumOver(SumOver(N(h, s, s1), s1, States), s, States), h, States), -1),
            HISTORY_LEFT_OUT: _SEEN * Pow(SumOver(SumOver(N(h, S(t), s1), s1, States), h, States), -1),
            ROWS_PUT_TOGETHER: SumOver(N(h, S(t), S(t + 1)), h, States)
            * Pow(SumOver(SumOver(N(h, S(t), s1), s1, States), h, States), -1),
            COLUMN_FOR_ROW: _SEEN * Pow(SumOver(SumOver(N(h, s, S(t + 1)), s, States), h, States), -1),
            ODDS_FOR_SHARE: _SEEN * Pow(SumOver(N(S(t - 1), S(t), s1), s1, States) - _SEEN, -1),
        },
    )

    _ALL = Counting(0, T - t - 1, INFINITY)

    FIRST_DISCOUNTED = Misconception(
        "first-reward-discounted", "The first reward after time t is not discounted: its factor is γ⁰ = 1."
    )
    STARTS_EARLY = Misconception(
        "starts-at-r-t", "The return from time t begins with the reward that comes after it, at t + 1."
    )
    UNDISCOUNTED = Misconception("no-discount", "Later rewards are discounted by powers of γ.")
    LINEAR_DISCOUNT = Misconception(
        "gamma-times-i",
        "The discount of a reward i steps later is the power γⁱ, not the product γ·i.",
        when=lambda given: given.gamma != 1,
    )
    DISCOUNTED_FROM_START = Misconception(
        "discounted-from-the-start",
        "The return from time t discounts the rewards by the steps from t on, not from the start of the episode.",
    )
    LAST_LEFT_OUT = Misconception(
        "last-reward-left-out",
        "The return goes on to the end of the episode: the reward on entering its last state counts.",
    )
    RETURN = Formula(
        "return",
        G(t),
        SumOver(gamma**i * r(t + 1 + i), i, _ALL),
        title="Return",
        source="Sutton & Barto 2018, eq. 3.8",
        hint="Add the rewards after time t; each further step brings one more factor γ.",
        also=(r(t + 1) + gamma * r(t + 2) + gamma**2 * r(t + 3) + DOTS,),
        misread={
            FIRST_DISCOUNTED: SumOver(gamma ** (i + 1) * r(t + 1 + i), i, _ALL),
            STARTS_EARLY: SumOver(gamma**i * r(t + i), i, Counting(0, T - t, INFINITY)),
            UNDISCOUNTED: SumOver(r(t + 1 + i), i, _ALL),
            LINEAR_DISCOUNT: SumOver(gamma * i * r(t + 1 + i), i, _ALL),
            DISCOUNTED_FROM_START: SumOver(gamma ** (t + i) * r(t + 1 + i), i, _ALL),
            LAST_LEFT_OUT: SumOver(gamma**i * r(t + 1 + i), i, Counting(0, T - t - 2)),
        },
    )

    RECURSION_UNDISCOUNTED = Misconception("no-discount", "The return that follows is discounted by γ.")
    RETURN_RECURSIVE = Formula(
        "return-recursive",
        G(t),
        r(t + 1) + gamma * G(t + 1),
        title="Return, recursively",
        source="Sutton & Barto 2018, eq. 3.9",
        hint="Begin with the last return, which is the last reward, and go back in time.",
        misread={
            RECURSION_UNDISCOUNTED: r(t + 1) + G(t + 1),
        },
    )

    STEP_UNDISCOUNTED = Misconception(
        "discount-of-the-step-forgotten", "All that comes after a reward is multiplied by the discount of its step."
    )
    RETURN_STEP_BY_STEP = Formula(
        "return-step-by-step",
        G(t),
        r(t + 1) + gammas(t + 1) * G(t + 1),
        title="Return with a discount for every step",
        source="Sutton & Barto 2018, eq. 17.1",
        hint="Begin with the last return, and go back in time; every step has its own discount.",
        place=Place.WORKING,
        misread={
            STEP_UNDISCOUNTED: r(t + 1) + G(t + 1),
        },
    )

    _FIRST = SumOver(gamma**i * r(t + 1 + i), i, Counting(0, n - 1))

    TAIL_FORGOTTEN = Misconception(
        "tail-forgotten",
        "The rewards go on for ever after the first ones; their return belongs to the sum.",
        when=lambda given: given.known is None,
    )
    TAIL_UNDISCOUNTED = Misconception(
        "tail-not-discounted",
        "The return from n steps later is discounted by γⁿ before it is added.",
    )
    RETURN_UNROLLED = Formula(
        "return-unrolled",
        G(t),
        _FIRST + gamma**n * G(t + n),
        title="Return, n rewards and the rest",
        source="Sutton & Barto 2018, eq. 3.9, applied n times",
        hint="The return from n steps later is worth γⁿ of itself now.",
        place=Place.WORKING,
        misread={
            TAIL_FORGOTTEN: _FIRST,
            TAIL_UNDISCOUNTED: _FIRST + G(t + n),
            FIRST_DISCOUNTED: gamma * _FIRST + gamma**n * G(t + n),
        },
    )

    PLUS_FOR_MINUS = Misconception(
        "plus-for-minus", "The geometric series 1 + q + q² + … sums to 1/(1 − q), not to 1/(1 + q)."
    )
    ROUND_OF_ONE = Misconception(
        "round-of-one",
        "A round of n rewards comes again after n steps, so the series runs in γⁿ, not in γ.",
        when=lambda given: len(given.repeated) > 1,
    )
    FIRST_OF_ROUND = Misconception(
        "first-of-round",
        "All rewards of a round come again and again, not only the first: each of them belongs to the series.",
    )
    ONE_ROUND = Misconception(
        "one-round-alone",
        "After the first round the rewards go on for ever: the sum of one round is divided by 1 − γⁿ.",
    )
    GEOMETRIC_SERIES = Formula(
        "geometric-series",
        G(t),
        _FIRST * Pow(1 - gamma**n, -1),
        title="Return of rewards that repeat after n steps",
        source="Sutton & Barto 2018, eq. 3.10, for n rewards in turn",
        hint="Add up one round; every further round is worth γⁿ times the one before, so divide by 1 − γⁿ.",
        place=Place.BEYOND,
        misread={
            PLUS_FOR_MINUS: _FIRST * Pow(1 + gamma**n, -1),
            ROUND_OF_ONE: _FIRST * Pow(1 - gamma, -1),
            FIRST_OF_ROUND: r(t + 1) * Pow(1 - gamma, -1),
            ONE_ROUND: _FIRST,
            FIRST_DISCOUNTED: gamma * _FIRST * Pow(1 - gamma**n, -1),
        },
    )

    UNWEIGHTED = Misconception(
        "unweighted-mean",
        "The episodes are not equally probable: each return counts with its episode's probability.",
        when=lambda given: given.known is None,
    )
    BEST_EPISODE = Misconception(
        "maximum-for-mean",
        "The expected return averages over what can happen; it is not the luckiest episode's return.",
        when=lambda given: given.known is None,
    )
    GOAL = Formula(
        "goal",
        expected_return,
        SumOver(EpisodePr(tau) * EpisodeReturn(tau), tau, Episodes),
        title="Goal",
        source="Sutton & Barto 2018, section 3.3",
        hint="Every episode τ that can happen counts with its probability.",
        note="The agent looks for the policy $π$ that maximises it from the start state $s_0$.",
        misread={
            UNWEIGHTED: MeanOver(EpisodeReturn(tau), tau, Episodes),
            BEST_EPISODE: MaxOver(EpisodeReturn(tau), tau, Episodes),
        },
    )

    START_DROPPED = Misconception(
        "start-probability-dropped",
        "An episode is only as probable as its start state to begin with.",
        when=lambda given: len(given.start) > 1 and given.sought != "start",
    )
    POLICY_DROPPED = Misconception(
        "policy-probability-dropped",
        "Each action on the way counts with the probability with which the policy takes it.",
        when=lambda given: given.chooses and given.sought != "policy",
    )
    LAST_BRANCH_DROPPED = Misconception("last-branch-dropped", "The last step of an episode has its probability too.")
    EPISODE_PROBABILITY = Formula(
        "episode-probability",
        EpisodePr(tau),
        Start(S(0)) * ProductOver(pi(A(t), S(t)) * P(S(t), A(t), S(t + 1)), t, Counting(0, T - 1)),
        title="Probability of an episode",
        source="Sutton & Barto 2018, section 5.5",
        hint="Multiply along the branch: the start, then for every step the action and where it leads.",
        place=Place.WORKING,
        misread={
            START_DROPPED: ProductOver(pi(A(t), S(t)) * P(S(t), A(t), S(t + 1)), t, Counting(0, T - 1)),
            POLICY_DROPPED: Start(S(0)) * ProductOver(P(S(t), A(t), S(t + 1)), t, Counting(0, T - 1)),
            LAST_BRANCH_DROPPED: Start(S(0))
            * ProductOver(pi(A(t), S(t)) * P(S(t), A(t), S(t + 1)), t, Counting(0, T - 2)),
        },
    )


@cache
def of_joint(formula: Formula) -> Formula:
    """A formula on counts, on joint probabilities in their place."""

    def read(right: Expr) -> Expr:
        return right.xreplace({count: Joint(*count.args) for count in right.atoms(N)})

    with evaluate(False):
        misread = {mistake: read(right) for mistake, right in formula.misread.items()}
        return replace(formula, right=read(formula.right), misread=misread)
