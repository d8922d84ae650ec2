"""The values of a policy from its Bellman equations, and the mistakes that are made on the way to them."""

from collections.abc import Mapping

import numpy as np

from rldrill.problems.models import Model, ModelAndPolicy, Policy
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, Value
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.formula.notation import Vpi
from rldrill.solutions.oracle import Array, at, chances, lookahead, tensors
from rldrill.solutions.sheet.bellman import BELLMAN_V
from rldrill.solutions.work import Work

ONE_BACKUP = slip(
    "one-backup",
    "One backup from zero is only the expected reward; the values must solve all equations at once.",
)
TERMINAL_VALUE = slip(
    "terminal-value",
    "A terminal state is worth 0: the reward for reaching it is already earned on the way there.",
    when=lambda given: knowns.pays_at_the_end(given.mdp),
)


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
    fixed = dict.fromkeys(mdp.terminal, ZERO)
    if work.makes(TERMINAL_VALUE):
        fixed |= knowns.last_rewards(mdp)
    if work.makes(ONE_BACKUP):
        start = fixed | dict.fromkeys(mdp.states, ZERO)
        return fixed | {state: work.step(BELLMAN_V, s=state, V=start, **known) for state in mdp.states}
    return work.system(BELLMAN_V, Vpi, [{"s": state} for state in mdp.states], V=fixed, **known)


def of_states(mdp: Model, values: Mapping[str, Value]) -> dict[str, Value]:
    """The values of the states that are not terminal."""
    return {state: values[state] for state in mdp.states}


def swept(given: ModelAndPolicy) -> tuple[Array, Array]:
    """For oracles: the values of all states, and the worth of all actions, by sweeps until nothing changes."""
    states = (*given.mdp.states, *given.mdp.terminal)
    P, R = tensors(given.mdp, states)
    pi = chances(given.chances, given.mdp, states)
    V = np.zeros(len(states))
    for _ in range(100_000):
        worth = lookahead(P, R, V, at(given.gamma))
        after = np.where(pi > 0, pi * np.where(np.isinf(worth), 0.0, worth), 0.0).sum(axis=1)
        if np.abs(after - V).max() < 1e-13:
            break
        V = after
    return V, lookahead(P, R, V, at(given.gamma))
