"""The Bellman equations of all states, solved as a linear system."""

from typing import Any

from msgspec.structs import replace

from rldrill.problems.bellman.policy_value import Given
from rldrill.problems.recurrence import predecessors
from rldrill.solutions import knowns
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, chances, swept, tensors
from rldrill.solutions.policy_values import Evaluation, equal_chances, evaluated, of_states, one_backup, terminal_value
from rldrill.solutions.reward_processes import fitting
from rldrill.solutions.sheet.bellman import (
    AVERAGE_REWARD,
    BELLMAN_V,
    DISCOUNTED_REWARD,
    EQUAL_SHARES,
    FORGOT_GAMMA,
    SHARES_SUM,
    STATIONARY,
    TRANSPOSED,
    Share,
)
from rldrill.solutions.work import Work


def solve(given: Given, work: Work, evaluation: Evaluation = evaluated) -> None:
    """One equation for every state; what is reached and terminal is worth nothing."""
    known = knowns.model_and_policy(given.mdp, given.chances, given.gamma)
    if given.average:
        _in_the_long_run(given, work, known)
        return
    formula, letters = fitting(BELLMAN_V, given.mdp)
    work.answer(of_states(given.mdp, evaluation(work, formula, given.mdp, known | letters)))


def _in_the_long_run(given: Given, work: Work, known: dict[str, Any]) -> None:
    """How often every state is visited where nothing ends, and what a step earns then on average."""
    ways = {
        state: [(action, [row.next for row in given.mdp.outcomes[state, action]]) for action in actions]
        for state, actions in given.mdp.actions.items()
    }
    before = dict.fromkeys(given.mdp.states, ()) | predecessors(ways)
    work.say(
        "In the long run every state is entered as often as it is left. The equation of the last "
        "state follows from the others; that the shares sum to $1$ takes its place:"
    )
    cases = [{"s1": state} for state in given.mdp.states]
    entering, letters = fitting(STATIONARY, given.mdp)
    known |= letters
    shares = work.answer(
        of_states(given.mdp, work.system(entering, Share, cases, instead=SHARES_SUM, predecessors=before, **known))
    )
    work.answer(work.step(fitting(AVERAGE_REWARD, given.mdp)[0], visited=shares, **known))


MISCONCEPTIONS = (
    replace(one_backup(solve), when=lambda given: not given.average),
    terminal_value(solve),
    TRANSPOSED,
    EQUAL_SHARES,
    equal_chances(solve),
    FORGOT_GAMMA.where_it_shows(),
    replace(DISCOUNTED_REWARD.where_it_shows(), when=lambda given: given.gamma != 1),
)


def oracle(given: Given) -> Answers:
    """Sweeps of evaluation until nothing changes, on arrays; the mean of very many powers of the chain."""
    if given.average:
        return _mean_of_powers(given)
    return (swept(given)[0][: len(given.mdp.states)],)


def _mean_of_powers(given: Given) -> Answers:
    states = given.mdp.states
    P, R = tensors(given.mdp)
    pi = chances(given.chances, given.mdp)
    power, mean = np.einsum("ij,ijk->ik", pi, P), np.eye(len(states))
    for _ in range(60):  # the mean of the first 2ⁿ powers, and the power that comes next
        mean = (mean + mean @ power) / 2
        power = power @ power
        power /= power.sum(axis=1, keepdims=True)
    shares = mean[0]
    return (shares, float(np.einsum("i,ij,ijk,ijk->", shares, pi, P, np.where(np.isinf(R), 0.0, R))))
