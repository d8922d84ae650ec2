"""The Bellman equations of all states, solved as a linear system."""

from rldrill.problems.bellman.policy_value import Given
from rldrill.solutions.exact import exact
from rldrill.solutions.oracle import Answers, swept
from rldrill.solutions.policy_values import ONE_BACKUP, TERMINAL_VALUE, evaluate_policy, of_states
from rldrill.solutions.sheet.bellman import TRANSPOSED
from rldrill.solutions.work import Work

MISCONCEPTIONS = (ONE_BACKUP, TERMINAL_VALUE, TRANSPOSED)


def solve(given: Given, work: Work) -> None:
    """One equation for every state; what is reached and terminal is worth nothing."""
    values = evaluate_policy(given.mdp, given.chances, exact(given.gamma), work)
    work.answer(of_states(given.mdp, values))


def oracle(given: Given) -> Answers:
    """Sweeps of evaluation until nothing changes, on arrays."""
    return (swept(given)[0][: len(given.mdp.states)],)
