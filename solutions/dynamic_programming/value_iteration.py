"""Sweeps of value iteration, over states or over actions, and the greedy actions; or a reward, from a value."""

from collections.abc import Callable, Mapping
from typing import Any

from rldrill.problems.document import joined
from rldrill.problems.dynamic_programming.value_iteration import Given, Sought, Swept
from rldrill.problems.models import Model
from rldrill.solutions import knowns
from rldrill.solutions.exact import ONE, ZERO, NoSolution, NotGiven, Value, exact, largest, sign, to_sympy
from rldrill.solutions.formula.formula import Formula, slip
from rldrill.solutions.formula.notation import MaxOver, V, numbered
from rldrill.solutions.formula.notation import Q as ActionValue
from rldrill.solutions.greedy import taken
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import Answers, at, best_actions, lookahead, tensors
from rldrill.solutions.rational import generator
from rldrill.solutions.reaching import Chosen, Known, reached, rewarded
from rldrill.solutions.sheet.bellman import FORGOT_GAMMA, MAXIMA_APART, OPTIMAL_Q_BY_REWARD
from rldrill.solutions.sheet.dynamic_programming import (
    MEAN_FOR_MAX,
    SMALLEST_Q,
    SWEEP_OVER_ACTIONS,
    VALUE_ITERATION,
    ahead_of,
    greedy,
    synchronous,
)
from rldrill.solutions.sweeps import order_slips
from rldrill.solutions.work import Work


def solve(
    given: Given,
    work: Work,
    ends: Callable[[Model], dict[str, Value]] = lambda mdp: dict.fromkeys(mdp.terminal, ZERO),
) -> None:
    """Each sweep from the values of the one before, or with the newest in place; an end is worth nothing."""
    if isinstance(given, Sought):
        _sought(given, work, min)
        return
    mdp = given.mdp
    known = knowns.model(mdp) | {"gamma": exact(given.gamma)}
    if given.action_values:
        _over_actions(given, work, known, ends(mdp))
        return
    values = dict.fromkeys(mdp.states, ZERO) | knowns.values(given.start or {}) | ends(mdp)
    formula = VALUE_ITERATION if given.in_place else synchronous(VALUE_ITERATION)
    for sweep in range(1, given.sweeps + 1):
        work.say(f"Sweep {sweep}:")
        before = values
        for state in mdp.states:
            V_k = values if given.in_place else before
            values = values | {state: work.step(formula, s=state, V=V_k, into=numbered(V, sweep), **known)}
    values |= work.answer({state: values[state] for state in mdp.states})
    if given.tie:
        _tie(given.tie, work, ahead_of(given.sweeps), known | {"V": values})
        return
    _greedy(mdp, work, given.sweeps, known | {"V": values})


def _greedy(mdp: Model, work: Work, sweeps: int, known: dict[str, Any]) -> None:
    """The greedy policy for the values after the last sweep."""
    work.say(f"The greedy policy $π$ for $V_{{{sweeps}}}$, which need not be an optimal policy yet:")
    best = {state: work.step(greedy(sweeps)[0], s=state, **known) for state in mdp.states}
    work.say(f"So these actions are greedy: {taken(best)}.")
    work.answer(best)


def _sought(given: Sought, work: Work, chosen: Chosen) -> None:
    """The first sweep but for the value that follows from the second, then the reward; the rest of the second sweep."""
    mdp, state, row = given.mdp, given.state, given.row
    known = knowns.model(mdp) | {"gamma": exact(given.gamma)}
    start = knowns.state_values(given.start, mdp.terminal)
    sweep = synchronous(VALUE_ITERATION)
    others = [each for each in mdp.states if each != row.state]
    work.say(f"Sweep 1 in {joined(others)}:")
    first = start | {each: work.step(sweep, s=each, V=start, into=numbered(V, 1), **known) for each in others}
    target = exact(given.outcome[state])
    averaging = not work.reading(sweep).has(MaxOver)  # then every action counts, and both equations are linear
    if averaging:
        unknown = generator("y")
        value = work.equate("y", work.value(sweep, s=state, V=first | {row.state: unknown}, **known), target)
    else:
        value, _ = reached(work, ahead_of(1), Known("V_2", state, target, "V_1", row.state), first, chosen, **known)
    first[row.state] = work.answer(value)
    if averaging:
        mean = work.value(sweep, s=row.state, V=start, **known)
        reward = work.equate(str(row.reward), mean, first[row.state])
    else:
        certain = first[row.state] == value
        reward, _ = rewarded(work, ahead_of(0), row, "V_1", first[row.state], start, demanding=certain, **known)
    known["R"] = {**known["R"], row[:3]: work.answer(reward)}
    work.say("Sweep 2:")
    second = first | {state: target}
    for each in mdp.states:
        if each != state:
            second |= {each: work.step(sweep, s=each, V=first, into=numbered(V, 2), **known)}
    second |= work.answer({each: second[each] for each in mdp.states if each != state})
    _greedy(mdp, work, 2, known | {"V": second})


def _tie(state: str, work: Work, worth_of: Formula, known: dict[str, Any]) -> None:
    """The discount with which both actions of a state are worth the same, and which is worth more below it."""
    actions = known["actions"][state]
    worth = [work.step(worth_of, s=state, a=action, **known) for action in actions]
    work.say("Both are greedy where these are equal:")
    gamma = work.equate("gamma", *worth)
    if sign(gamma) == 0:
        raise NoSolution(
            f"both actions in {state!r} are greedy with γ = 0, and no discount is smaller; change a reward"
        )
    if sign(gamma) < 0 or sign(ONE - gamma) < 0:
        raise NoSolution(f"with no discount from 0 to 1 are both actions in {state!r} greedy; change a reward")
    below = work.answer(gamma) / 2
    first, second = (work.value(worth_of, s=state, a=action, **known | {"gamma": below}) for action in actions)
    letter = "A" if sign(first - second) > 0 else "B"
    at_once = [work.value(worth_of, s=state, a=action, **known | {"gamma": ZERO}) for action in actions]
    told = joined([f"{action} ${to_sympy(value)}$" for action, value in zip(actions, at_once, strict=True)])
    work.say(
        f"With $γ = 0$ the actions would be worth their rewards, {told}. Both values are linear in $γ$ and equal only "
        f"at $γ = {to_sympy(gamma)}$: so {actions['AB'.index(letter)]} is greedy for every smaller $γ$."
    )
    work.answer(letter)


def _over_actions(given: Swept, work: Work, known: dict[str, Any], ends: Mapping[str, Value]) -> None:
    """The same for the values of states with actions; an end has one action, worth nothing."""
    mdp = given.mdp
    known["actions"] = mdp.actions | dict.fromkeys(mdp.terminal, (knowns.NO_ACTION,))
    Q = dict.fromkeys(mdp.pairs, ZERO) | {(state, knowns.NO_ACTION): value for state, value in ends.items()}
    for sweep in range(1, given.sweeps + 1):
        work.say(f"Sweep {sweep}:")
        name, before = numbered(ActionValue, sweep), Q
        Q = before | {
            (s, a): work.step(synchronous(SWEEP_OVER_ACTIONS), s=s, a=a, Q=before, into=name, **known)
            for s, a in mdp.pairs
        }
    Q |= work.answer({pair: Q[pair] for pair in mdp.pairs})
    work.say(f"The greedy policy $π$ for $Q_{{{given.sweeps}}}$, which need not be an optimal policy yet:")
    best = {state: work.step(greedy(given.sweeps)[1], s=state, Q=Q, **known) for state in mdp.states}
    work.say(f"So these actions are greedy: {taken(best)}.")
    work.answer(best)


@slip(
    "terminal-reward-twice",
    "A terminal state is worth 0: the reward for reaching it is earned once, on the way there.",
    when=lambda given: _swept(given) and knowns.pays_at_the_end(given.mdp),
)
def paid_twice(given: Given, work: Work) -> None:
    """An end is worth what the way there earned."""
    solve(given, work, ends=knowns.last_rewards)


@slip(
    "greedy-on-reward",
    "The action with the greatest reward need not be the best one: the value of what follows is added before actions "
    "are compared.",
    when=lambda given: _swept(given) and not given.action_values,
)
def most_paid(given: Swept, work: Work) -> None:
    """Only the actions that earn most at once."""
    mdp = given.mdp
    earned = {
        pair: sum((exact(row.probability) * exact(row.reward) for row in rows), ZERO)
        for pair, rows in mdp.outcomes.items()
    }
    most = {state: largest([earned[state, action] for action in actions]) for state, actions in mdp.actions.items()}
    rows = tuple(row for row in mdp.transitions if earned[row.state, row.action] == most[row.state])
    solve(given.model_copy(update={"mdp": mdp.model_copy(update={"transitions": rows})}), work)


@slip(
    "one-sweep-short",
    "This comes of one sweep less than is asked for: every sweep looks one step further ahead.",
    when=lambda given: isinstance(given, Swept),
)
def stopped_early(given: Swept, work: Work) -> None:
    """The values before the last sweep, if they are not those of the start."""
    if given.sweeps == 1:
        raise NotGiven("there is no sweep before the first")
    solve(given.model_copy(update={"sweeps": given.sweeps - 1}), work)


@slip(
    "exceeds-the-maximum",
    "V₂ takes the greatest of the actions' values, so none may exceed it: the smallest value that reaches it is right.",
    when=lambda given: isinstance(given, Sought) and _ways(given) > 1,
)
def exceeds(given: Sought, work: Work) -> None:
    """The greatest of the values that reach what is known."""
    _sought(given, work, max)


def _swept(given: Given) -> bool:
    """Whether sweeps are gone through, with every number known."""
    return isinstance(given, Swept) and given.tie is None


def _ways(given: Sought) -> int:
    """How many actions may lead from the state whose value is known to the one where the reward is left open."""
    return len({row.action for row in given.mdp.transitions if (row.state, row.next) == (given.state, given.row.state)})


MISCONCEPTIONS = (
    *order_slips(solve, lambda given: _swept(given) and not given.in_place and not given.action_values),
    paid_twice, stopped_early, MEAN_FOR_MAX, exceeds, most_paid.where_it_shows(),
    MAXIMA_APART.where_it_shows(), SMALLEST_Q.where_it_shows(),
    FORGOT_GAMMA,
    OPTIMAL_Q_BY_REWARD,
)  # fmt: skip


def oracle(given: Given) -> Answers:
    """The same sweeps as array operations; the greedy action by trying all."""
    return _halved(given) if isinstance(given, Sought) else _in_floats(given)


def _halved(given: Sought) -> Answers:
    """The reward by halving: what two sweeps give does not fall where it rises."""
    mdp, gamma = given.mdp, at(given.gamma)
    states, n = mdp.every_state, len(mdp.states)
    place = states.index(given.state)

    def swept(x: float) -> tuple[Array, Array, Array]:
        P, R = tensors(mdp, x)
        sweeps = [np.array([at(given.start.get(state, 0)) for state in states])]
        for _ in range(2):
            sweeps.append(np.r_[lookahead(P, R, sweeps[-1], gamma)[:n].max(axis=1), sweeps[0][n:]])
        return sweeps[1], sweeps[2], lookahead(P, R, sweeps[2], gamma)[:n]

    low, high = -1e4, 1e4
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if swept(middle)[1][place] < at(given.outcome[given.state]) else (low, middle)
    first, second, worth = swept(high)
    return (first[states.index(given.row.state)], high, np.delete(second[:n], place), best_actions(mdp, worth.round(6)))


def _in_floats(given: Swept) -> Answers:
    """The sweeps, and the greedy actions or the discount of a tie."""
    states = given.mdp.every_state
    P, R = tensors(given.mdp)
    V = np.array([at((given.start or {}).get(state, 0)) for state in states])
    n = len(given.mdp.states)
    V[n:] = 0
    for _ in range(given.sweeps):
        worth = lookahead(P, R, V, at(given.gamma))[:n]
        for line in range(n):
            source = lookahead(P, R, V, at(given.gamma)) if given.in_place else worth
            V[line] = source[line].max()
    if given.action_values:
        names = given.mdp.every_action
        values = [worth[states.index(state), names.index(action)] for state, action in given.mdp.pairs]
        return (values, best_actions(given.mdp, worth))
    if given.tie:
        line, gains = states.index(given.tie), [lookahead(P, R, V, gamma) for gamma in (0.0, 1.0)]
        first, last = ((gain[line] * [1, -1]).sum() for gain in gains)
        return (V[:n], first / (first - last), "A" if first > 0 else "B")
    return (V[:n], best_actions(given.mdp, lookahead(P, R, V, at(given.gamma))[:n]))
