"""REINFORCE with a baseline: the gradient from one episode, each return taken relative to the state's baseline."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, StepSize
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Named, check_keys, values_table
from rldrill.problems.phrases import discount, step_size
from rldrill.problems.softmax import (
    Episode,
    denominator,
    draw_episode,
    episode_blocks,
    every_step_counts,
    gradient,
    gradient_parts,
    returns,
)

TITLE = "REINFORCE with a baseline"
SOURCE = "Sutton & Barto 2018, section 13.4"
REVISION = 10


class Given(Episode):
    """An episode, the features and weights of the policy that was followed, the baseline b(s), α and γ."""

    baseline: Named[Exact] = Field(description="The baseline of every state.")
    alpha: StepSize = Field(description="The step size.")

    @model_validator(mode="after")
    def _based(self) -> Self:
        check_keys(self.baseline, tuple(self.baseline), "the baseline", needed=self.trajectory.states[:-1])
        return self


def draw(level: int, rng: Draws) -> Given:
    """Two steps and even chances; then three steps in two states; then three actions and γ left open."""
    episode = draw_episode(level, rng)
    run, gamma = episode["trajectory"], episode["gamma"]
    baseline = {state: rng.nonzero(-2, 5) for state in dict.fromkeys(run.states[:-1])}
    known = Fraction(0) if isinstance(gamma, Parameter) else gamma
    differences = [G - baseline[state] for state, G in zip(run.states, returns(run, known), strict=False)]
    below = denominator(episode["theta"], episode["features"])
    steps = {*zip(run.states, run.actions, differences, strict=False)}
    if len(steps) < len(differences):  # which of two times is which would not show
        return draw(level, rng)
    if not every_step_counts(run, differences) or (level == 2 and sum(map(abs, differences)) * below > _MOST):
        return draw(level, rng)
    if 0 in gradient(episode, differences):  # a weight would stay as it is
        return draw(level, rng)
    alpha = rng.fraction("1/2", "1/4") if level < 3 else rng.fraction("1/2", "1/4", "1/5")
    return Given(**episode, baseline=baseline, alpha=alpha)


#: The largest sum of the differences over a common denominator: the gradient's entries then stay below 300.
_MOST = 360


def question(given: Given) -> Question:
    """The episode, the policy and the baseline; the differences, the gradient and the new weights are asked for."""
    factor = "" if given.gamma == 1 else "There is no further factor $γ^t$. "
    note = Paragraph(
        "The score $∇_θ log π(a_t|s_t)$ of each action is multiplied by $δ_t = R_t − b(s_t)$, where "
        "$R_t = r_{t+1} + γ r_{t+2} + …$ is the discounted return from its own step on; the products are summed over "
        f"the episode. {factor}All steps use the weights above. {discount(given.gamma)} {step_size(given.alpha)} "
        "The baseline is:"
    )
    entries = tuple(f"δ_{{{time}}}" for time in range(len(given.trajectory.rewards)))
    blocks = (*episode_blocks(given), note, values_table(given.baseline, "b"))
    return Question(blocks, gradient_parts(given, "differences between return and baseline,", entries))
