"""The values of a policy from its Bellman equations, and the mistakes that are made on the way to them."""

from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

from rldrill.problems.models import Model
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, Value
from rldrill.solutions.formula.formula import Formula, Misconception, slip
from rldrill.solutions.formula.notation import Vpi
from rldrill.solutions.work import Work

#: How somebody comes to the values of a policy, those of terminal states among them: from the policy's equation, in
#: the form that fits how the policy is given, and from the model, the policy and the discount, as it needs them.
#: Where there are values to begin with, they are among what is known.
Evaluation: TypeAlias = Callable[[Work, Formula, Model, Mapping[str, Any]], dict[str, Value]]
#: A solver that evaluates a policy on its way.
Solve: TypeAlias = Callable[[Any, Work, Evaluation], None]


def evaluated(work: Work, formula: Formula, mdp: Model, known: Mapping[str, Any]) -> dict[str, Value]:
    """The values of a policy: one equation for every state; terminal states keep what they begin with, 0 in general.

    Raises:
        NoSolution: the policy has no unique values.
    """
    begin = _begin(mdp, known)
    ends = {state: begin[state] for state in mdp.terminal}
    return work.system(formula, Vpi, [{"s": state} for state in mdp.states], **{**known, "V": ends})


def of_states(mdp: Model, values: Mapping[str, Value]) -> dict[str, Value]:
    """The values of the states that are not terminal."""
    return {state: values[state] for state in mdp.states}


def _begin(mdp: Model, known: Mapping[str, Any]) -> dict[str, Value]:
    return dict.fromkeys((*mdp.states, *mdp.terminal), ZERO) | known.get("V", {})


def _paid_again(work: Work, formula: Formula, mdp: Model, known: Mapping[str, Any]) -> dict[str, Value]:
    return evaluated(work, formula, mdp, {**known, "V": knowns.last_rewards(mdp)})


def _swept(work: Work, formula: Formula, mdp: Model, known: Mapping[str, Any]) -> dict[str, Value]:
    known = {**known, "V": _begin(mdp, known)}
    return known["V"] | {state: work.step(formula, s=state, **known) for state in mdp.states}


def one_backup(solve: Solve) -> Misconception:
    """The slip of a solver that takes the first backup for the values."""
    return slip(
        "one-backup",
        "One backup from zero is only the expected reward; the values must solve all equations at once.",
    )(lambda given, work: solve(given, work, _swept))


def one_sweep(solve: Solve) -> Misconception:
    """The slip of a solver that evaluates a policy by a single sweep."""
    return slip(
        "one-sweep",
        "One sweep only gives the reward of the next step; the values of a policy must solve all equations at once.",
        when=lambda given: getattr(given, "values", None) is None,  # where they are given, nothing is evaluated
    )(lambda given, work: solve(given, work, _swept))


def terminal_value(solve: Solve) -> Misconception:
    """The slip of a solver that gives a terminal state the reward for reaching it as its value."""
    return slip(
        "terminal-value",
        "A terminal state is worth 0: the reward for reaching it is already earned on the way there.",
        when=lambda given: knowns.pays_at_the_end(given.mdp),
    )(lambda given, work: solve(given, work, _paid_again))
