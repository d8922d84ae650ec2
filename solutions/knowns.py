"""What problems give, as what formulas need: exact values by the formulas' letters."""

from collections.abc import Callable, Mapping, Sequence
from functools import wraps
from typing import Any, TypeVar

from rldrill.problems.beliefs import Motion
from rldrill.problems.exact import Scalar
from rldrill.problems.models import Dynamics, Model, Policy
from rldrill.problems.runs import ActionMove, ActionMoves, ActionRun, StateMove, Trajectory, ValueMoves, ValueRun
from rldrill.solutions.exact import ZERO, Value, exact
from rldrill.solutions.rational import RationalFunction

Key = TypeVar("Key")
Given = TypeVar("Given")
Known = TypeVar("Known", dict[str, Any], list[Any])

#: So many states, and motions of no probability stand in a working as zeros; among more they only fill the line.
_FEW = 4

#: The one action of a terminal state, worth nothing; no action of a problem can have this name.
NO_ACTION = "–"


def kept(known: Callable[[Given], Known]) -> Callable[[Given], Known]:
    """Remember what came out for the last givens: their mistakes ask for what their solution asked for."""
    last: tuple[Any, Any] = None, None

    @wraps(known)
    def remembered(given: Given) -> Known:
        nonlocal last
        found = last
        if found[0] is not given:
            last = found = given, known(given)
        return found[1].copy()

    return remembered


class Sparse(dict[Any, Value]):
    """A table in which what is not there is 0, and leaves no place in a working."""

    def __missing__(self, key: Any) -> Value:
        return ZERO


def values(numbers: Mapping[Key, Scalar]) -> dict[Key, Value]:
    """A mapping of given numbers as exact values."""
    return {key: exact(number) for key, number in numbers.items()}


def state_values(numbers: Mapping[str, Scalar], terminal: tuple[str, ...]) -> dict[str, Value]:
    """Given state values; a terminal state is worth 0."""
    return values(numbers) | dict.fromkeys(terminal, ZERO)


def discounts(gamma: Scalar | tuple[Scalar, ...]) -> dict[str, Any]:
    """The discount γ, or the discounts of the steps, γ_1 first."""
    if isinstance(gamma, tuple):
        return {"gammas": {time: exact(each) for time, each in enumerate(gamma, 1)}}
    return {"gamma": exact(gamma)}


@kept
def model(given: Dynamics) -> dict[str, Any]:
    """A model as P, R, actions and successors; pairs of states without a transition have P = R = 0."""
    P: dict[Any, Value] = Sparse()
    R: dict[Any, Value] = Sparse()
    successors = {}
    for pair, outcomes in given.outcomes.items():
        successors[pair] = tuple(outcome.next for outcome in outcomes)
        for outcome in outcomes:
            P[outcome[:3]] = exact(outcome.probability)
            R[outcome[:3]] = exact(outcome.reward)
    return {"P": P, "R": R, "actions": given.actions, "successors": successors}


def policy(given: Policy) -> dict[tuple[str, str], Value]:
    """A policy as π(a|s), with the action first; actions that it does not name are never taken."""
    named = {(action, state): exact(chance) for state, chances in given.items() for action, chance in chances.items()}
    return Sparse({pair: chance for pair, chance in named.items() if chance != 0})


def model_and_policy(mdp: Model, chances: Policy, gamma: Scalar) -> dict[str, Any]:
    """A model, a policy and the discount, as the Bellman equations need them."""
    states = mdp.every_state
    return model(mdp) | {"pi": policy(chances), "gamma": exact(gamma), "states": states}


def motion(given: Motion) -> dict[tuple[str, str, str], Value]:
    """Where actions lead, as p(s′|s, a) with the next state first; what cannot be reached has 0.

    In a working these zeros keep their place, as the table of the question prints them, unless there are many states.
    """
    known = Sparse()
    for action, rows in given.items():
        for state, chances in rows.items():
            known |= {(target, state, action): ZERO for target in (rows if len(rows) <= _FEW else ())}
            known |= {(target, state, action): exact(chance) for target, chance in chances.items()}
    return known


def likelihood(given: Mapping[str, Mapping[str, Scalar]]) -> dict[tuple[str, str], Value]:
    """What a sensor reads, as p(z|s) with the reading first."""
    return {(reading, state): exact(chance) for reading, row in given.items() for state, chance in row.items()}


def features(given: Mapping[str, Sequence[Scalar]]) -> dict[tuple[int, str], Value]:
    """Features of states (or other vectors) by the number of the component, counted from 1, and the state."""
    return {(index, state): exact(value) for state, row in given.items() for index, value in enumerate(row, 1)}


@kept
def trajectory(run: Trajectory) -> dict[str, Any]:
    """A run as s_t, a_t and r_t, by time."""
    return {
        "S": dict(enumerate(run.states)),
        "A": dict(enumerate(run.actions)),
        "r": {time + 1: exact(reward) for time, reward in enumerate(run.rewards)},
    }


@kept
def moves(given: ValueRun | ValueMoves | ActionRun | ActionMoves) -> list[dict[str, Any]]:
    """What is known of every transition, which goes from its time t to t + 1: t, s, a and r."""
    seen: Sequence[StateMove | ActionMove] = given.moves
    return [_move(time, move, given.terminal) for time, move in enumerate(seen)]


def _move(time: int, move: StateMove | ActionMove, terminal: tuple[str, ...]) -> dict[str, Any]:
    known = {"t": time, "S": {time: move.state, time + 1: move.next}, "r": {time + 1: exact(move.reward)}}
    if isinstance(move, ActionMove):
        following = NO_ACTION if move.next in terminal else move.following
        known["A"] = {time: move.action} | ({} if following is None else {time + 1: following})
    return known


def action_run(given: ActionRun) -> dict[str, Any]:
    """A run with its action values, α and γ; where an episode ends there is one action, worth 0."""
    run = given.trajectory
    known = trajectory(run) | action_values(given)
    if run.ends:
        known["A"] = known["A"] | {len(run.rewards): NO_ACTION}
    return known


@kept
def action_values(given: ActionRun | ActionMoves) -> dict[str, Any]:
    """The action values, α and γ; where an episode ends there is one action, worth 0."""
    return {
        "alpha": exact(given.alpha),
        "gamma": exact(given.gamma),
        "actions": {state: tuple(row) for state, row in given.values.items()}
        | dict.fromkeys(given.terminal, (NO_ACTION,)),
        "Q": {(state, action): exact(value) for state, row in given.values.items() for action, value in row.items()}
        | {(state, NO_ACTION): ZERO for state in (*given.values, *given.terminal)},
    }


def pays_at_the_end(given: Model) -> bool:
    """Whether reaching a terminal state earns anything, so that it may be taken for the state's value."""
    return any(last_rewards(given).values())


def last_rewards(given: Model) -> dict[str, Value]:
    """What reaching each terminal state earns: what somebody takes for its value who gives it one."""
    return {row.next: exact(row.reward) for row in given.transitions if row.next in given.terminal}


def settled(values: dict[Key, Any], found: Value) -> dict[Key, Any]:
    """Values, with what was found put in for the letter left open, which stands in them alone or as 1 minus it."""
    filled = {
        key: value.top[0] + value.top[1] * found if isinstance(value, RationalFunction) else value
        for key, value in values.items()
    }
    return type(values)(filled)
