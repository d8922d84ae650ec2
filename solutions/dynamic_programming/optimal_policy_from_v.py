"""One look ahead with every action, from the optimal values."""

from collections.abc import Mapping
from typing import Any

from flint import fmpq

from rldrill.problems.dynamic_programming.optimal_policy_from_v import Given
from rldrill.problems.valued import ROUNDING
from rldrill.solutions import knowns
from rldrill.solutions.exact import ONE, NoSolution, Value, equals, exact, parameters
from rldrill.solutions.formula.compiling import arg_max
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.greedy import taken
from rldrill.solutions.numerics import np
from rldrill.solutions.optimality import optimum
from rldrill.solutions.oracle import Answers, at, best_actions, tensors, without_loss
from rldrill.solutions.rational import generator
from rldrill.solutions.sheet.bellman import FORGOT_GAMMA, OWN_VALUE, Q_FORGOT_GAMMA, Q_STAR_FROM_V, V_STAR_FROM_Q
from rldrill.solutions.sheet.dynamic_programming import (
    GREEDY_BY_REWARD,
    GREEDY_BY_VALUE,
    GREEDY_FROM_Q,
    GREEDY_FROM_V,
    SMALLEST_Q,
)
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """The value that is missing, the values of the actions, the best action of every state."""
    V = knowns.state_values(given.values, given.mdp.terminal)
    found: dict[tuple[str, str], Value] = {}
    if given.missing is not None:
        value, found = _missing(given, given.missing, work, _known(given) | {"V": V})
        V[given.missing] = work.answer(value)
        if V[given.missing] != value:  # whoever has another value goes on with it
            found = {}
    _look_ahead(given, work, dict.fromkeys(given.mdp.states, V), found)


def _known(given: Given) -> dict[str, Any]:
    return knowns.model(given.mdp) | {"gamma": exact(given.gamma)}


def _look_ahead(
    given: Given,
    work: Work,
    ahead_of: Mapping[str, Mapping[str, Value]],
    found: Mapping[tuple[str, str], Value],
) -> None:
    """The best actions, by the values that are ahead of each state; some values of actions may be found already."""
    known = _known(given)
    if given.action_values:
        if found:
            work.say(f"The values of the actions in {given.missing} are those of part (a).")
        pairs = [pair for pair in given.mdp.pairs if pair not in found]
        rest = {(s, a): work.step(Q_STAR_FROM_V, s=s, a=a, V=ahead_of[s], **known) for s, a in pairs}
        Q = work.answer({pair: {**found, **rest}[pair] for pair in given.mdp.pairs})
        greedy = {state: work.step(GREEDY_FROM_Q, s=state, Q=Q, **known) for state in given.mdp.states}
    else:
        greedy = {s: work.step(GREEDY_FROM_V, s=s, V=ahead_of[s], **known) for s in given.mdp.states}
    if given.gamma == 1:
        best = optimum(given.mdp, given.gamma)
        if given.missing is None:
            _check(given, best.values)
        best.tell(work)
        greedy = best.among(greedy)
        if given.missing is None:  # values that are rounded may hide the best action
            greedy = {state: actions if {*actions} <= {*best.best[state]} else best.best[state]
                      for state, actions in greedy.items()}  # fmt: skip
    work.say(f"So these actions are optimal: {taken(greedy)}.")
    work.answer(greedy)


def _check(given: Given, values: Mapping[str, fmpq]) -> None:
    """Refuse what only solves the equation: without a discount it has other solutions than the optimal values."""
    for state, value in given.values.items():
        if abs(exact(value) - values[state]) > exact(ROUNDING) * max(ONE, abs(values[state])):
            raise NoSolution(
                f"with γ = 1 the optimal value of {state!r} is {values[state]}, not {value}; correct it in values"
            )


def _missing(given: Given, state: str, work: Work, known: dict[str, Any]) -> tuple[Value, dict[tuple[str, str], Value]]:
    """The value of a state from those of the others, that of its best action taken each time; and its action values.

    An action that may lead back to the state gives an equation for the value; what it is worth where another is best,
    is known only then.
    """
    x = generator("x")
    back = any(row.next == state for row in given.mdp.transitions if row.state == state)
    letter = f'Let $x = V^*("{state}")$. Then the' if back else "The"
    work.say(f"{letter} actions in {state} have these values:")
    fixed: dict[tuple[str, str], Value] = {}
    again: list[str] = []
    for action in given.mdp.actions[state]:
        worth = work.step(Q_STAR_FROM_V, s=state, a=action, **{**known, "V": {**known["V"], state: x}})
        if parameters(worth):
            work.say(f"If {action} is optimal in {state}, this is $x$ itself:")
            worth = work.equate("x", worth, x)
            again.append(action)
        fixed[state, action] = worth
    largest = work.value(V_STAR_FROM_Q, s=state, Q=fixed, actions=known["actions"])
    (action, *_) = arg_max(given.mdp.actions[state], list(fixed.values()))
    values = dict(fixed)
    if again:
        beaten = [other for other in again if other != action]
        work.say(f"The greatest of these is $x {equals(largest)}$, that of {action}.{' With this $x$:' * bool(beaten)}")
        for other in beaten:
            values[state, other] = work.step(
                Q_STAR_FROM_V, s=state, a=other, **{**known, "V": {**known["V"], state: largest}}
            )
    best = work.step(V_STAR_FROM_Q, s=state, Q=values, actions=known["actions"])
    work.say(f"The best action in {state} is {action}.")
    return best, values


@slip(
    "value-kept-at-the-end",
    "In a terminal state nothing more is earned: it is worth 0, whatever the state before it is worth.",
    when=lambda given: given.missing is None and bool(given.mdp.terminal),
)
def value_kept(given: Given, work: Work) -> None:
    """A state's own value where the end is next."""
    V = knowns.state_values(given.values, given.mdp.terminal)
    kept = {state: V | dict.fromkeys(given.mdp.terminal, V[state]) for state in given.mdp.states}
    _look_ahead(given, work, kept, {})


MISCONCEPTIONS = (
    FORGOT_GAMMA.where_it_shows(),
    GREEDY_BY_VALUE,
    GREEDY_BY_REWARD,
    SMALLEST_Q,
    Q_FORGOT_GAMMA,
    OWN_VALUE,
    value_kept.where_it_shows(),
)


def oracle(given: Given) -> Answers:
    """Every action's mean reward and mean next value, as two arrays; what is missing by sweeps, the best by trying."""
    states = given.mdp.every_state
    P, R = tensors(given.mdp)
    V = np.array([at(given.values.get(state, 0)) for state in states])
    pay = (P * R.clip(min=-1e300)).sum(axis=2)
    answers: list[Any] = []
    if given.missing is not None:
        place = states.index(given.missing)
        for _ in range(2000):
            V[place] = (pay + at(given.gamma) * P @ V)[place].max()
        answers.append(V[place])
    worth = pay + at(given.gamma) * P @ V
    if given.action_values:
        names = given.mdp.every_action
        answers.append([worth[states.index(s), names.index(a)] for s, a in given.mdp.pairs])
    best = best_actions(given.mdp, worth[: len(given.mdp.states)])
    return [*answers, without_loss(given.mdp, best) if given.gamma == 1 else best]
