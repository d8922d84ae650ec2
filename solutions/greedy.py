"""ε-greedy choice, a step for every action; several solvers take it."""

from collections.abc import Mapping, Sequence

from rldrill.problems.document import joined
from rldrill.solutions.exact import Value
from rldrill.solutions.formula.compiling import arg_max
from rldrill.solutions.sheet.control import EPSILON_GREEDY, EPSILON_GREEDY_TIED
from rldrill.solutions.work import Work


def best_actions(values: Mapping[str, Value]) -> tuple[str, ...]:
    """The actions of greatest value.

    Raises:
        NoSolution: which they are depends on what is left open.
    """
    best: tuple[str, ...] = arg_max(tuple(values), tuple(values.values()))
    return best


def epsilon_greedy(
    work: Work,
    state: str,
    values: Mapping[str, Value],
    epsilon: Value,
    label: str | None = None,
    only: Sequence[str] = (),
    *,
    again: bool = False,
) -> dict[str, Value]:
    """The probability of every action of a state; tied best actions share that of the greedy choice.

    Args:
        work: where the steps are written.
        state: the state.
        values: the value of each of its actions.
        epsilon: the exploration rate.
        label: when it is, where the policy changes with the values.
        only: the actions whose probabilities are needed; all if empty.
        again: whether it is said already which actions are best.

    Raises:
        NoSolution: which action is best depends on what is left open.
    """
    best = best_actions(values)
    formula = EPSILON_GREEDY if len(best) == 1 else EPSILON_GREEDY_TIED
    known = {"epsilon": epsilon, "actions": {state: tuple(values)}, "best": {state: best[0]}, "greedy": {state: best}}
    size = f'$|A("{state}")| = {len(values)}$'
    if not again and len(best) == 1:
        work.say(f'The greedy action is $a^*("{state}") = "{best[0]}"$, one of {size} actions.')
    elif not again:
        work.say(f'The best actions are {joined([*best])}: $|A^*("{state}")| = {len(best)}$ of {size}.')
    return {action: work.step(formula, s=state, a=action, label=label, **known) for action in only or values}


def taken(best: Mapping[str, Sequence[str]]) -> str:
    """The best actions of several states, in words."""
    return joined([f"{' or '.join(actions)} in {state}" for state, actions in best.items()])


def greedy(best: Sequence[str], among: int) -> str:
    """The conclusion from an arg max among so many actions, in words."""
    if len(best) == 1:
        return f"{best[0]} has the {'greater' if among == 2 else 'greatest'} value: it is greedy"
    if among == 2:
        return f"{joined(list(best))} have the same value: both are greedy"
    return f"{joined(list(best))} have the same greatest value: they are all greedy"
