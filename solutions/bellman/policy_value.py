"""The Bellman equations of all states, solved as a linear system."""

from rldrill.problems.bellman.policy_value import Given
from rldrill.solutions import knowns
from rldrill.solutions.oracle import Answers, swept
from rldrill.solutions.policy_values import Evaluation, evaluated, of_states, one_backup, terminal_value
from rldrill.solutions.sheet.bellman import BELLMAN_V, TRANSPOSED
from rldrill.solutions.work import Work


def solve(given: Given, work: Work, evaluation: Evaluation = evaluated) -> None:
    """One equation for every state; what is reached and terminal is worth nothing."""
    known = knowns.model_and_policy(given.mdp, given.chances, given.gamma)
    if not given.mdp.chooses:
        work.say("There is nothing to choose, so $V$ is $V^π$ of the only policy there is.")
    work.answer(of_states(given.mdp, evaluation(work, BELLMAN_V, given.mdp, known)))


MISCONCEPTIONS = (one_backup(solve), terminal_value(solve), TRANSPOSED)


def oracle(given: Given) -> Answers:
    """Sweeps of evaluation until nothing changes, on arrays."""
    return (swept(given)[0][: len(given.mdp.states)],)
