"""Sweeps of iterative policy evaluation: from the old values, or with the newest."""

from msgspec.structs import replace

from rldrill.problems.dynamic_programming.policy_evaluation import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, exact
from rldrill.solutions.formula.notation import V, numbered
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at, chances, tensors
from rldrill.solutions.reward_processes import fitting
from rldrill.solutions.sheet.bellman import ACTIONS_ALIKE, FORGOT_GAMMA, MAX_FOR_MEAN
from rldrill.solutions.sheet.dynamic_programming import POLICY_EVALUATION, synchronous
from rldrill.solutions.sweeps import order_slips
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """Sweep after sweep, one step for every state."""
    mdp = given.mdp
    formula, letters = fitting(POLICY_EVALUATION, mdp)
    known = knowns.model(mdp) | letters | {"gamma": exact(given.gamma), "pi": knowns.policy(given.chances)}
    values = dict.fromkeys(mdp.states, ZERO) | knowns.state_values(given.start or {}, mdp.terminal)
    formula = formula if given.in_place else synchronous(formula)
    if given.in_place:
        work.say("Every new value is used at once: the steps after it take it in place of the old one.")
    for sweep in range(1, given.sweeps + 1):
        work.say(f"Sweep {sweep}:")
        old = values
        for state in mdp.states:
            current = values if given.in_place else old
            value = work.step(formula, s=state, V=current, into=numbered(V, sweep), **known)
            values = values | {state: value}
    work.answer({state: values[state] for state in mdp.states})


def _comparable(given: Given) -> bool:
    return not given.parameters() and any(len(actions) > 1 for actions in given.mdp.actions.values())


MISCONCEPTIONS = (
    *order_slips(solve),
    replace(MAX_FOR_MEAN, when=_comparable),
    ACTIONS_ALIKE.where_it_shows(),
    FORGOT_GAMMA,
)


def oracle(given: Given) -> Answers:
    """The policy's own chain of states as one matrix; a sweep in place goes through its lines one by one."""
    states = given.mdp.every_state
    n = len(given.mdp.states)
    P, R = tensors(given.mdp)
    pi = chances(given.chances, given.mdp)
    chain = np.einsum("ij,ijk->ik", pi, P)
    pay = np.einsum("ij,ijk,ijk->i", pi, P, np.where(np.isinf(R), 0.0, R))
    values = np.array([at((given.start or {}).get(state, 0)) for state in states])
    values[n:] = 0
    for _ in range(given.sweeps):
        source = values if given.in_place else values.copy()
        for line in range(n):
            values[line] = pay[line] + at(given.gamma) * chain[line] @ source
    return (values[:n],)
