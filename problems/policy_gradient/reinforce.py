"""REINFORCE: the gradient estimated from one episode, and the weights after a step along it."""

from pydantic import Field

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter, StepSize
from rldrill.problems.family import Question
from rldrill.problems.phrases import discount, step_size
from rldrill.problems.softmax import (
    Episode,
    draw_episode,
    episode_blocks,
    every_step_counts,
    gradient,
    gradient_parts,
    returns,
)

TITLE = "REINFORCE"
SOURCE = "Sutton & Barto 2018, section 13.3"
REVISION = 10


class Given(Episode):
    """An episode, the features and weights of the policy that was followed, α and γ."""

    alpha: StepSize = Field(description="The step size.")


def draw(level: int, rng: Draws) -> Given:
    """Two steps and even chances; then three steps in two states; then three actions and γ left open."""
    episode = draw_episode(level, rng)
    gamma = episode["gamma"]
    run = episode["trajectory"]
    if not isinstance(gamma, Parameter):
        found = returns(run, gamma)
        alike = len(set(found)) < len(found)  # one return could be taken for another
        if alike or not every_step_counts(run, found) or 0 in gradient(episode, found):  # a weight would stay as it is
            return draw(level, rng)
    return Given(**episode, alpha=rng.fraction("1/2", "1/4") if level < 3 else rng.fraction("1/2", "1/4", "1/5"))


def question(given: Given) -> Question:
    """The episode and the policy; the returns, the gradient and the new weights are asked for."""
    factor = "" if given.gamma == 1 else "There is no further factor $γ^t$. "
    note = Paragraph(
        "REINFORCE multiplies the score $∇_θ log π(a_t|s_t)$ of each action by the discounted return from its own step "
        "on, $R_t = r_{t+1} + γ r_{t+2} + …$, and sums over the episode. "
        f"{factor}All steps use the weights above. {discount(given.gamma)} {step_size(given.alpha)}"
    )
    entries = tuple(f"R_{{{time}}}" for time in range(len(given.trajectory.rewards)))
    return Question((*episode_blocks(given), note), gradient_parts(given, "returns", entries))
