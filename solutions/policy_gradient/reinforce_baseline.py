"""As REINFORCE, each return relative to the state's baseline."""

from rldrill.problems.policy_gradient.reinforce_baseline import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import exact
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.policy_gradient import (
    BASELINE,
    BASELINE_ADDED,
    BASELINE_FORGOTTEN,
    BASELINE_ON_THE_POLICY,
    DESCENT,
    DISCOUNTED_AGAIN,
    GRADIENT_ASCENT,
    LOG_FORGOTTEN,
    OTHER_SUBTRACTED,
    REINFORCE_BASELINE,
)
from rldrill.solutions.softmax import discounted_returns, episode_gradient, known_run, returns, scores
from rldrill.solutions.vector import Vector
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """All steps with the weights before the episode."""
    known = known_run(given) | {"baseline": knowns.values(given.baseline)}
    known["G"] = returns(work, known)
    times = range(known["T"])
    differences = work.answer(tuple(work.step(BASELINE, t=time, **known) for time in times))
    if given.gamma != 1:
        work.say("The factor $γ^t$ before $δ_t$ is left out, as the question says:")
    work.recall(REINFORCE_BASELINE)
    known |= scores(work, given, known) | {"delta": dict(enumerate(differences))}
    gradient = Vector(work.answer(tuple(work.step(REINFORCE_BASELINE, **known))))
    work.answer(tuple(work.step(GRADIENT_ASCENT, gradient=gradient, alpha=exact(given.alpha), **known)))


MISCONCEPTIONS = (
    BASELINE_ADDED,
    BASELINE_ON_THE_POLICY,
    BASELINE_FORGOTTEN,
    DESCENT,
    LOG_FORGOTTEN.where_it_shows(),
    DISCOUNTED_AGAIN.where_it_shows(),
    OTHER_SUBTRACTED.where_it_shows(),
)


def oracle(given: Given) -> Answers:
    """The gradient of the weighted log-likelihood of the episode by complex steps."""
    run = given.trajectory
    G = discounted_returns([at(reward) for reward in run.rewards], at(given.gamma))
    differences = G - [at(given.baseline[state]) for state in run.states[:-1]]
    gradient = episode_gradient(given, differences)
    theta = np.array([at(weight) for weight in given.theta])
    return (differences, gradient, theta + at(given.alpha) * gradient)
