"""The values of a policy from its Bellman equations, and the mistakes that are made on the way to them."""

from collections.abc import Mapping
from typing import Any

from rldrill.problems.models import Model, Policy
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, Value
from rldrill.solutions.formula.formula import Formula, fork
from rldrill.solutions.formula.notation import Vpi
from rldrill.solutions.sheet.bellman import BELLMAN_V
from rldrill.solutions.work import Work

ONE_BACKUP = fork(
    "one-backup",
    "One backup from zero is only the expected reward; the values must solve all equations at once.",
)
TERMINAL_VALUE = fork(
    "terminal-value",
    "A terminal state is worth 0: the reward for reaching it is already earned on the way there.",
    when=lambda given: knowns.pays_at_the_end(given.mdp),
)
ONE_SWEEP = fork(
    "one-sweep",
    "One sweep only gives the reward of the next step; the values of a policy must solve all equations at once.",
    when=lambda given: getattr(given, "values", None) is None,  # where they are given, nothing is evaluated
)


def evaluated(
    work: Work, formula: Formula, mdp: Model, known: Mapping[str, Any], before: Mapping[str, Value] | None = None
) -> dict[str, Value]:
    """The values of the policy in ``known``, those of terminal states among them.

    Args:
        work: where the steps are written; it may make the slip of one sweep only.
        formula: the policy's equation, in the form that fits how the policy is given.
        mdp: the model.
        known: the model, the policy and the discount, as the formula needs them.
        before: the values from which that one sweep would start; 0, if none.

    Raises:
        NoSolution: the policy has no unique values.
    """
    ends = dict.fromkeys(mdp.terminal, ZERO)
    if work.makes(TERMINAL_VALUE):
        ends |= knowns.last_rewards(mdp)
    if work.makes(ONE_SWEEP) or work.makes(ONE_BACKUP):
        old = before or dict.fromkeys(mdp.states, ZERO) | ends
        return {state: work.step(formula, s=state, V=old, **known) for state in mdp.states} | ends
    return work.system(formula, Vpi, [{"s": state} for state in mdp.states], V=ends, **known)


def evaluate_policy(mdp: Model, policy: Policy, gamma: Value, work: Work) -> dict[str, Value]:
    """The values of all states under a policy, terminal ones among them: one equation for every state.

    Raises:
        NoSolution: the equations have no unique solution.
    """
    known = knowns.model(mdp) | {
        "pi": knowns.policy(policy),
        "gamma": gamma,
        "states": (*mdp.states, *mdp.terminal),
    }
    return evaluated(work, BELLMAN_V, mdp, known)


def of_states(mdp: Model, values: Mapping[str, Value]) -> dict[str, Value]:
    """The values of the states that are not terminal."""
    return {state: values[state] for state in mdp.states}
