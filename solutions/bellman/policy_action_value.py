"""The values of the states as a linear system, then one average for every action."""

from rldrill.problems.bellman.policy_action_value import Given
from rldrill.problems.document import joined
from rldrill.solutions import knowns
from rldrill.solutions.oracle import Answers, swept
from rldrill.solutions.policy_values import Evaluation, equal_chances, evaluated, of_states, one_backup, terminal_value
from rldrill.solutions.sheet.bellman import (
    BELLMAN_Q,
    BELLMAN_V,
    DISCOUNTED_REWARD,
    FORGOT_GAMMA,
    OWN_VALUE,
    Q_FORGOT_GAMMA,
    Q_REWARD_UNWEIGHTED,
    TRANSPOSED,
)
from rldrill.solutions.work import Work


def solve(given: Given, work: Work, evaluation: Evaluation = evaluated) -> None:
    """Q follows from V: the action is free, and the policy is followed after it."""
    mdp = given.mdp
    known = knowns.model_and_policy(mdp, given.chances, given.gamma)
    values = evaluation(work, BELLMAN_V, mdp, known)
    values |= work.answer(of_states(mdp, values))
    worths = {(s, a): work.step(BELLMAN_Q, s=s, a=a, V=values, **known) for s, a in mdp.pairs}
    only = {
        s: a for s, row in given.chances.items() for a, chance in row.items() if chance == 1 and len(mdp.actions[s]) > 1
    }
    if only:
        same = joined([f'$Q^π("{state}", "{action}") = V^π("{state}")$' for state, action in only.items()])
        work.say(f"Where $π$ takes only one action, that action is worth what the state is worth: {same}.")
    work.answer(worths)


MISCONCEPTIONS = (
    one_backup(solve), terminal_value(solve), equal_chances(solve), TRANSPOSED,
    Q_FORGOT_GAMMA, OWN_VALUE, Q_REWARD_UNWEIGHTED,
    FORGOT_GAMMA.where_it_shows(), DISCOUNTED_REWARD.where_it_shows(),
)  # fmt: skip


def oracle(given: Given) -> Answers:
    """Sweeps of evaluation until nothing changes, on arrays; the worth of all actions comes with them."""
    V, Q = swept(given)
    names = given.mdp.every_action
    states = given.mdp.states
    return (V[: len(states)], [Q[states.index(s), names.index(a)] for s, a in given.mdp.pairs])
