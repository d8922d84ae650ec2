"""Four kinds of bandits: sample averages, upper confidence bounds, their weight, and preferences on a gradient."""

from math import isqrt
from typing import Any

from sympy import Mul

from rldrill.problems.control.bandit import NEXT, Averaged, Balance, Bounds, Estimates, Given, Preferences, Pull
from rldrill.problems.document import joined
from rldrill.solutions.exact import NoSolution, Value, exact, near, to_sympy, told
from rldrill.solutions.formula.compiling import arg_max
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.formula.putting_in import put_in
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.rational import generator
from rldrill.solutions.sheet.control import (
    ALL_PULLS_COUNTED,
    ARM_ESTIMATE,
    BANDIT_WITHOUT_EXP,
    BASELINE_FORGOTTEN,
    GRADIENT_BANDIT,
    GRADIENT_BANDIT_POLICY,
    GREEDY_ARM,
    LOG_10_IN_UCB,
    OTHERS_UNCHANGED,
    OWN_COUNT_FORGOTTEN,
    OWN_MEAN_AS_BASELINE,
    PULLS_FOR_TIME,
    REWARD_BASELINE,
    TIME_FOR_LOG,
    UCB,
    UCB_ARM,
    UCB_BALANCE,
)
from rldrill.solutions.work import Equality, Work


def solve(given: Given, work: Work) -> None:
    """What the kind of bandit asks for."""
    match given:
        case Estimates():
            averages = _averages(given, work)
            best = work.step(GREEDY_ARM, n=len(given.pulls), Q=averages, choices=given.tried)
            work.say(f"The greatest average is that of {' or '.join(best)}.")
            work.answer({NEXT: best})
        case Bounds():
            _explore(given, work, _averages(given, work))
        case Balance():
            _balance(given, work, _averages(given, work))
        case Preferences():
            _follow_gradient(given, work)


def _pulls(pulls: tuple[Pull, ...]) -> dict[str, Any]:
    """Arms and rewards by the number of the pull."""
    return {
        "A": {number: pull.arm for number, pull in enumerate(pulls, 1)},
        "r": {number: exact(pull.reward) for number, pull in enumerate(pulls, 1)},
    }


def _averages(given: Averaged, work: Work) -> dict[str, Value]:
    """The first answer: what each arm gave on average."""
    known = _pulls(given.pulls) | {"n": len(given.pulls)}
    work.say(
        f"Of the $n = {len(given.pulls)}$ pulls only those of the arm itself count; any other adds $0$ above and "
        "below, which is left out."
    )
    averages: dict[str, Value] = work.answer({arm: work.step(ARM_ESTIMATE, a=arm, **known) for arm in given.tried})
    return averages


def _explore(given: Bounds, work: Work, averages: dict[str, Value]) -> None:
    """The bounds, then the arm that has the greatest."""
    known = _counted(given, averages) | {"c": exact(given.c)}
    bounds = work.answer({arm: work.step(UCB, a=arm, **known) for arm in given.tried})
    work.say(lambda: f"In decimals: {', '.join(f'$U({arm}) {near(bound, 4)}$' for arm, bound in bounds.items())}.")
    if given.untried:
        work.say(f"No bound is as great as that of an arm that was never pulled: {joined([*given.untried])}.")
        work.answer({NEXT: given.untried})
    else:
        work.recall(UCB_ARM)
        chosen = work.value(UCB_ARM, t=known["t"], U=bounds, choices=given.tried)
        greedy = arg_max(tuple(averages), tuple(averages.values()))
        if set(chosen) & set(greedy):
            work.say(f"The greatest bound is that of {chosen[0]}, which has the greatest average, too.")
        else:
            better = "greater" if len(averages) == 2 else "greatest"
            work.say(
                f"UCB takes {chosen[0]}, although {greedy[0]} has the {better} average: {chosen[0]} is less certain."
            )
        work.answer({NEXT: chosen})


@slip(
    "bonus-ignored",
    "UCB takes the arm whose bound is greatest, bonus included; the greatest average alone is the greedy choice.",
    when=lambda given: isinstance(given, Bounds),
)
def greedy_for_ucb(given: Bounds, work: Work) -> None:
    """The arm with the greatest average, where that is another one."""
    averages = _averages(given, work)
    known = _counted(given, averages) | {"c": exact(given.c)}
    bounds = work.answer({arm: work.step(UCB, a=arm, **known) for arm in given.tried})
    greedy = arg_max(tuple(averages), tuple(averages.values()))
    if set(greedy) & set(given.untried or arg_max(tuple(bounds), tuple(bounds.values()))):
        raise NoSolution("UCB takes the greedy arm, too")
    work.answer({NEXT: greedy})


def _counted(given: Averaged, averages: dict[str, Value]) -> dict[str, Any]:
    """The averages, how often every arm was pulled, and the time of the next choice."""
    counts = {arm: exact(sum(pull.arm == arm for pull in given.pulls)) for arm in given.tried}
    return {"Q": averages, "t": len(given.pulls) + 1, "N": counts}


def _balance(given: Balance, work: Work, averages: dict[str, Value]) -> None:
    """The weight with which both bounds are equal; above it the arm that was pulled less often is ahead."""
    better, rarer = given.between
    known = _counted(given, averages)
    if work.misconception is None:  # nobody reads the working of a mistake
        _set_equal(work, known, better, rarer)
    weight = work.answer(work.step(UCB_BALANCE, a=better, b=rarer, **known))
    work.say(
        lambda: (
            f"The bound of {rarer}, which was pulled less often, grows faster with $c$: above "
            f"$c {near(weight, 3)}$ it is the greater one."
        )
    )
    work.answer({NEXT: (rarer,)})


def _set_equal(work: Work, known: dict[str, Any], better: str, rarer: str) -> None:
    """The equation of both bounds, and what is left of it when the terms with c stand on one side."""
    work.recall(UCB)
    work.say(f"Let $a$ be {better} and $b$ {rarer}. Then $U(a) = U(b)$ if")
    bounds = [put_in(UCB.right, {**known, "a": arm, "c": generator("c")}) for arm in (better, rarer)]
    above, below = UCB_BALANCE.right.args
    ahead, faster = (put_in(side, {**known, "a": better, "b": rarer}) for side in (above, below.base))
    work.lines.append(Equality(bounds[0], (bounds[1],)))
    work.lines.append(Equality(Mul(to_sympy(generator("c")), faster, evaluate=False), (ahead,)))
    if shorter := _shorter(known, better, rarer):
        work.say(shorter)


def _shorter(known: dict[str, Any], better: str, rarer: str) -> str | None:
    """That one root is a multiple of the other, where the numbers of pulls are in the ratio of two squares."""
    times = known["N"][better] / known["N"][rarer]
    above, below = isqrt(int(times.p)), isqrt(int(times.q))
    if (above**2, below**2) != (times.p, times.q):
        return None
    one, other = (f"√((ln {known['t']})/{told(known['N'][arm])})" for arm in (better, rarer))
    return f"Here ${one} = {below}/{above}·{other}$."


def _follow_gradient(given: Preferences, work: Work) -> None:
    """Probabilities, the baseline, then all preferences at once."""
    known = _pulls(given.every_pull) | {
        "n": len(given.pulls),
        "choices": given.every_arm,
        "H": {arm: exact(value) for arm, value in given.preferences.items()},
        "alpha": exact(given.alpha),
    }
    known["pi"] = work.answer({arm: work.step(GRADIENT_BANDIT_POLICY, a=arm, **known) for arm in given.every_arm})
    known["rbar"] = {known["n"]: work.step(REWARD_BASELINE, r=known["r"], A=known["A"], n=known["n"])}
    work.answer({arm: work.step(GRADIENT_BANDIT, a=arm, **known) for arm in given.every_arm})


MISCONCEPTIONS = (
    ALL_PULLS_COUNTED,
    TIME_FOR_LOG,
    OWN_COUNT_FORGOTTEN,
    PULLS_FOR_TIME,
    LOG_10_IN_UCB,
    greedy_for_ucb,
    BANDIT_WITHOUT_EXP,
    BASELINE_FORGOTTEN,
    OTHERS_UNCHANGED,
    OWN_MEAN_AS_BASELINE.where_it_shows(),
)


def oracle(given: Given) -> Answers:
    """Estimates by masks; the gradient step by finite differences of the expected reward's surrogate."""
    rewards = np.array([at(pull.reward) for pull in given.pulls])
    if isinstance(given, Preferences):
        H = np.array([at(value) for value in given.preferences.values()])
        surplus = at(given.pulled.reward) - rewards.mean()
        slope = _slope(H, given.every_arm.index(given.pulled.arm))
        return (np.exp(_log_softmax(H)), H + at(given.alpha) * surplus * slope)
    pulled = np.array([[pull.arm == arm for pull in given.pulls] for arm in given.tried])
    means = np.array([rewards[mask].mean() for mask in pulled])
    if isinstance(given, Estimates):
        return (means, {NEXT: _best(given, means)})
    if isinstance(given, Balance):
        better, rarer = map(given.tried.index, given.between)
        roots = np.sqrt(np.log(len(rewards) + 1) / pulled.sum(axis=1))
        return (means, np.linalg.solve([[roots[rarer] - roots[better]]], [means[better] - means[rarer]]),
                {NEXT: {given.between[1]}})  # fmt: skip
    bounds = means + at(given.c) * np.sqrt(np.log(len(rewards) + 1) / pulled.sum(axis=1))
    never = set(given.every_arm) - {pull.arm for pull in given.pulls}
    return (means, bounds, {NEXT: never or _best(given, bounds)})


def _best(given: Averaged, worth: Array) -> set[str]:
    return {arm for arm, value in zip(given.tried, worth, strict=True) if np.isclose(value, worth.max(), rtol=1e-12)}


def _log_softmax(H: Array) -> Array:
    result: Array = H - np.logaddexp.reduce(H)
    return result


def _slope(H: Array, arm: int) -> Array:
    """The gradient of ln π(arm), by central differences of fourth order."""
    slope = np.zeros(len(H))
    for index, unit in enumerate(np.eye(len(H)) * 1e-3):
        one, two = (_log_softmax(H + k * unit)[arm] - _log_softmax(H - k * unit)[arm] for k in (1, 2))
        slope[index] = (8 * one - two) / 12e-3
    return slope
