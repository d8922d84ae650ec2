"""For every transition: the TD error, then the critic's and the actor's steps."""

from collections.abc import Mapping
from typing import Any

from rldrill.problems.policy_gradient.actor_critic import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import Value, exact
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.formula.nodes.leaves import put_in_name
from rldrill.solutions.formula.notation import V
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.bellman import FORGOT_GAMMA
from rldrill.solutions.sheet.policy_gradient import (
    ACTOR_CRITIC,
    CRITIC,
    CRITIC_WITHOUT_ALPHA,
    NEXT_VALUE_FORGOTTEN,
    OTHER_SUBTRACTED,
    TD_ERROR,
    WEIGHTED_BY_REWARD,
)
from rldrill.solutions.softmax import Chances, by_number, chances, exponentials_added, known_run, log_gradient, score
from rldrill.solutions.work import Equality, Work


def solve(given: Given, work: Work, policy: Chances = chances) -> None:
    """The critic sees values only, so its whole way comes first; then the actor's, with the errors found."""
    _act(given, work, _criticise(given, work), policy)


def _criticise(given: Given, work: Work) -> dict[str, Any]:
    """The TD errors and the critic's values; what the actor goes on with."""
    run = given.trajectory
    known = known_run(given) | {"alpha": exact(given.alpha), "beta": exact(given.beta)}
    before = knowns.state_values(given.values, run.terminal)
    known["delta"] = dict(enumerate(work.answer(_errors(work, known, before))))

    values = before
    last = known["T"] - 1
    for time in range(last):  # these steps stand in the working of (a)
        values = values | {run.states[time]: work.value(CRITIC, t=time, V=values, **known)}
    if earlier := [state for state in given.visited if state != run.states[last]]:
        work.say("From the updates in (a):")
        work.lines += [Equality(V(put_in_name(state)), (values[state],)) for state in earlier]
    values = values | {run.states[last]: work.step(CRITIC, t=last, V=values, **known)}
    work.answer({state: values[state] for state in given.visited})
    return known


def _act(given: Given, work: Work, known: dict[str, Any], policy: Chances = chances) -> None:
    """The actor's weights, transition by transition."""
    run = given.trajectory
    for time, (state, action) in enumerate(zip(run.states, run.actions, strict=False)):
        actions = tuple(given.features[state])
        known["pi"] = policy(work, known, state, actions)
        known["score"] = {(action, state): score(work, known, state, action, actions)}
        known |= by_number(tuple(work.step(ACTOR_CRITIC, t=time, **known)))
    work.answer(tuple(known["theta_vector"]))


def _errors(work: Work, known: Mapping[str, Any], values: Mapping[str, Value]) -> tuple[Value, ...]:
    """The TD error of every transition; each update of the critic counts in the next."""
    errors: list[Value] = []
    for time in range(known["T"]):
        if time:
            delta = dict(enumerate(errors))
            learnt = work.step(CRITIC, t=time - 1, V=values, delta=delta, alpha=known["alpha"], S=known["S"])
            values = {**values, known["S"][time - 1]: learnt}
        errors.append(work.step(TD_ERROR, t=time, V=values, **known))
    return tuple(errors)


@slip(
    "step-sizes-swapped",
    "α belongs to the critic, β to the actor; they were exchanged.",
    when=lambda given: given.alpha != given.beta,
)
def swapped(given: Given, work: Work) -> None:
    """The critic's step size for the actor, and the actor's for the critic."""
    solve(given.model_copy(update={"alpha": given.beta, "beta": given.alpha}), work)


@slip(
    "error-after-the-critic",
    "Critic and actor learn from the same TD error, that of the values before the critic's update.",
)
def error_late(given: Given, work: Work) -> None:
    """The actor by the errors that are left after the critic's updates."""
    known = _criticise(given, work)
    states = known["S"]
    values = knowns.state_values(given.values, given.trajectory.terminal)
    left = {}
    for time in range(known["T"]):
        values = values | {states[time]: work.value(CRITIC, t=time, V=values, **known)}
        left[time] = work.value(TD_ERROR, t=time, V=values, **known)
    _act(given, work, known | {"delta": left})


MISCONCEPTIONS = (
    NEXT_VALUE_FORGOTTEN,
    FORGOT_GAMMA.where_it_shows(),
    WEIGHTED_BY_REWARD,
    swapped,
    error_late.where_it_shows(),
    CRITIC_WITHOUT_ALPHA.where_it_shows(),
    OTHER_SUBTRACTED.where_it_shows(),
    exponentials_added(solve),
)


def oracle(given: Given) -> Answers:
    """Both learners stepped through the run, the scores by complex steps."""
    run = given.trajectory
    values = {state: at(number) for state, number in given.values.items()} | dict.fromkeys(run.terminal, 0.0)
    theta = np.array([at(weight) for weight in given.theta])
    errors = []
    for time, (state, action) in enumerate(zip(run.states, run.actions, strict=False)):
        error = at(run.rewards[time]) + at(given.gamma) * values[run.states[time + 1]] - values[state]
        theta = theta + at(given.beta) * error * log_gradient(theta, given.features[state], action)
        values[state] += at(given.alpha) * error
        errors.append(error)
    return (errors, [values[state] for state in given.visited], theta)
