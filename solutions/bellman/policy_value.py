"""The Bellman equations of all states, solved as a linear system."""

import numpy as np

from rldrill.problems.bellman.policy_value import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, exact
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.formula.notation import Vpi
from rldrill.solutions.oracle import Answers, at, chances, lookahead, tensors
from rldrill.solutions.sheet.bellman import BELLMAN_V, TRANSPOSED
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
MISCONCEPTIONS = (ONE_BACKUP, TERMINAL_VALUE, TRANSPOSED)


def solve(given: Given, work: Work) -> None:
    """One equation for every state; what is reached and terminal is worth nothing."""
    mdp = given.mdp
    known = knowns.model(mdp) | {
        "pi": knowns.policy(given.chances),
        "gamma": exact(given.gamma),
        "states": (*mdp.states, *mdp.terminal),
    }
    fixed = dict.fromkeys(mdp.terminal, ZERO)
    if work.makes(TERMINAL_VALUE):
        fixed |= knowns.last_rewards(mdp)
    if work.makes(ONE_BACKUP):
        start = fixed | dict.fromkeys(mdp.states, ZERO)
        values = {state: work.step(BELLMAN_V, s=state, V=start, **known) for state in mdp.states}
    else:
        values = work.system(BELLMAN_V, Vpi, [{"s": state} for state in mdp.states], V=fixed, **known)
    work.answer("a", {state: values[state] for state in mdp.states})


def oracle(given: Given) -> Answers:
    """Sweeps of evaluation until nothing changes, on arrays."""
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
    return {"a": V[: len(given.mdp.states)]}
