"""The exact values of a policy, as several solvers need them: its equations solved, or read from the givens."""

from collections.abc import Mapping
from typing import Any

from rldrill.problems.models import Model
from rldrill.solutions.exact import ZERO, Value
from rldrill.solutions.formula.formula import Formula, slip
from rldrill.solutions.formula.notation import Vpi
from rldrill.solutions.work import Work

ONE_SWEEP = slip(
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
    if work.makes(ONE_SWEEP):
        old = before or dict.fromkeys(mdp.states, ZERO) | ends
        return {state: work.step(formula, s=state, V=old, **known) for state in mdp.states} | ends
    return work.system(formula, Vpi, [{"s": state} for state in mdp.states], V=ends, **known)
