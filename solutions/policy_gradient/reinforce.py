"""Returns backwards in time, the scores, their weighted sum, and a step along it."""

from rldrill.problems.policy_gradient.reinforce import Given
from rldrill.solutions.exact import exact
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.policy_gradient import (
    DESCENT,
    DISCOUNTED_AGAIN,
    FIRST_RETURN_EVERYWHERE,
    GRADIENT_ASCENT,
    LOG_FORGOTTEN,
    MEAN_OVER_STEPS,
    OTHER_SUBTRACTED,
    REINFORCE,
    REINFORCE_ESTIMATE,
    REWARD_FOR_RETURN,
)
from rldrill.solutions.softmax import discounted_returns, episode_gradient, known_run, returns, scores
from rldrill.solutions.vector import Vector
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """All steps with the weights before the episode."""
    known = known_run(given)
    G = dict(enumerate(work.answer(tuple(returns(work, known).values()))))
    if given.gamma != 1:
        work.say(
            "Without the factor $γ^t$ before $R_t$, which is left out as the question says, the gradient is taken as"
        )
    work.recall(REINFORCE)
    known |= scores(work, given, known)
    gradient = Vector(work.answer(tuple(work.step(REINFORCE_ESTIMATE, G=G, **known))))
    work.answer(tuple(work.step(GRADIENT_ASCENT, gradient=gradient, alpha=exact(given.alpha), **known)))


MISCONCEPTIONS = (
    FIRST_RETURN_EVERYWHERE,
    DESCENT,
    LOG_FORGOTTEN,
    REWARD_FOR_RETURN,
    DISCOUNTED_AGAIN.where_it_shows(),
    MEAN_OVER_STEPS.where_it_shows(),
    OTHER_SUBTRACTED.where_it_shows(),
)


def oracle(given: Given) -> Answers:
    """The gradient of the weighted log-likelihood of the episode by complex steps."""
    G = discounted_returns([at(reward) for reward in given.trajectory.rewards], at(given.gamma))
    gradient = episode_gradient(given, G)
    theta = np.array([at(weight) for weight in given.theta])
    return (G, gradient, theta + at(given.alpha) * gradient)
