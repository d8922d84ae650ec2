"""The values of a policy from its Bellman equations, and the mistakes that are made on the way to them."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any, TypeAlias

from rldrill.problems.models import Model
from rldrill.problems.recurrence import end_components
from rldrill.solutions import knowns
from rldrill.solutions.endless import Loop, no_value
from rldrill.solutions.exact import ONE, ZERO, NoSolution, Value, exact, is_zero
from rldrill.solutions.formula.formula import Formula, Misconception, slip
from rldrill.solutions.formula.notation import Vpi
from rldrill.solutions.sheet.bellman import ACTIONS_ALIKE
from rldrill.solutions.work import Work

#: How somebody comes to the values of a policy, those of terminal states among them: from the policy's equation, in
#: the form that fits how the policy is given, and from the model, the policy and the discount, as it needs them.
#: Where there are values to begin with, they are among what is known.
Evaluation: TypeAlias = Callable[[Work, Formula, Model, Mapping[str, Any]], dict[str, Value]]
#: A solver that evaluates a policy on its way.
Solve: TypeAlias = Callable[[Any, Work, Evaluation], None]


def evaluated(work: Work, formula: Formula, mdp: Model, known: Mapping[str, Any]) -> dict[str, Value]:
    """The values of a policy: one equation for every state; terminal states keep what they begin with, 0 in general.

    Without discount they are expected totals: a loop that is never left and pays nothing is worth 0, and the
    equations of the other states have one solution then (Puterman 1994, section 7.1).

    Raises:
        NoSolution: the policy has no values: without discount, since it goes on for ever in a loop that pays.
    """
    begin = _begin(mdp, known)
    fixed = {state: begin[state] for state in mdp.terminal} | _resting(work, formula, mdp, known)
    cases = [{"s": state} for state in mdp.states if state not in fixed]
    return work.system(formula, Vpi, cases, **{**known, "V": fixed}) if cases else fixed


def _resting(work: Work, formula: Formula, mdp: Model, known: Mapping[str, Any]) -> dict[str, Value]:
    """The states that an undiscounted process never leaves although it has not ended: they must be worth 0."""
    resting: dict[str, Value] = {}
    for loop in endless(mdp, known):
        if not loop.pays_nothing:
            raise NoSolution(
                no_value(loop, "the policy goes on for ever with", "let it lead to an end, let the loop pay nothing")
            )
        work.say(
            f"Whoever comes to {loop} stays there for ever, and every step there pays $0$ on average. With $γ = 1$ the "
            "equations would hold there with any number, but the value is the sum of all rewards to come, and that is:"
        )
        for state in loop.actions:
            work.give(formula, ZERO, s=state)
            resting[state] = ZERO
    return resting


def endless(mdp: Model, known: Mapping[str, Any]) -> list[Loop]:
    """The loops that a policy never leaves, where there is no discount; terminal states end everything."""
    if known["gamma"] != ONE:
        return []
    taken = {state: _taken(known["pi"], state, mdp.actions[state]) for state in mdp.states}
    chances: dict[str, dict[str, Value]] = {state: {} for state in mdp.states}
    for state, actions in taken.items():
        for action, chance in actions.items():
            for row in mdp.outcomes[state, action]:
                way = chance * exact(row.probability)
                if not is_zero(way):
                    chances[state][row.next] = chances[state].get(row.next, ZERO) + way
    ways = {state: [(None, to)] for state, to in chances.items() if not any(end in to for end in mdp.terminal)}
    return [_loop(mdp, component, taken, chances) for component in end_components(ways)]


def _loop(mdp: Model, states: Iterable[str], taken: Mapping[str, Mapping[str, Value]], chances: Any) -> Loop:
    return Loop(
        {state: tuple(taken[state]) for state in states},
        {
            state: sum(
                (
                    chance * exact(row.probability) * exact(row.reward)
                    for action, chance in taken[state].items()
                    for row in mdp.outcomes[state, action]
                ),
                ZERO,
            )
            for state in states
        },
        {state: chances[state] for state in states},
    )


def _taken(policy: Mapping[Any, Any], state: str, actions: Iterable[str]) -> dict[str, Value]:
    """What a policy does in a state, by its probabilities or by its one action; what it never does is left out."""
    if state in policy:
        return {policy[state]: ONE}
    return {action: policy[action, state] for action in actions if not is_zero(policy[action, state])}


def of_states(mdp: Model, values: Mapping[str, Value]) -> dict[str, Value]:
    """The values of the states that are not terminal."""
    return {state: values[state] for state in mdp.states}


def _begin(mdp: Model, known: Mapping[str, Any]) -> dict[str, Value]:
    return dict.fromkeys(mdp.every_state, ZERO) | known.get("V", {})


def _paid_again(work: Work, formula: Formula, mdp: Model, known: Mapping[str, Any]) -> dict[str, Value]:
    return evaluated(work, formula, mdp, {**known, "V": knowns.last_rewards(mdp)})


def swept_once(work: Work, formula: Formula, mdp: Model, known: Mapping[str, Any]) -> dict[str, Value]:
    """The values after one sweep, from those that are known, or from zero."""
    known = {**known, "V": _begin(mdp, known)}
    return known["V"] | {state: work.step(formula, s=state, **known) for state in mdp.states}


def one_backup(solve: Solve) -> Misconception:
    """The slip of a solver that takes the first backup for the values."""
    return slip(
        "one-backup",
        "One backup from zero is only the expected reward; the values must solve all equations at once.",
    )(lambda given, work: solve(given, work, swept_once))


def one_sweep(solve: Solve) -> Misconception:
    """The slip of a solver that evaluates a policy by a single sweep."""
    return slip(
        "one-sweep",
        "One sweep gives only the reward of the next step; the values of a policy must solve all equations at once.",
        when=lambda given: getattr(given, "values", None) is None,  # where they are given, nothing is evaluated
    )(lambda given, work: solve(given, work, swept_once))


def terminal_value(solve: Solve) -> Misconception:
    """The slip of a solver that gives a terminal state the reward for reaching it as its value."""
    return slip(
        "terminal-value",
        "A terminal state is worth 0: the reward for reaching it is already earned on the way there.",
        when=lambda given: knowns.pays_at_the_end(given.mdp),
    )(lambda given, work: solve(given, work, _paid_again))


def equal_chances(solve: Callable[[Any, Work], None]) -> Misconception:
    """The slip of a solver that averages over the actions as if all of them were equally probable."""
    made = slip("equal-chances", ACTIONS_ALIKE.says)(
        lambda given, work: solve(given.model_copy(update={"policy": None}), work)
    )
    return made.where_it_shows()
