"""The return of a finite sequence of rewards, from the start and from later times."""

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discounts, Exact, Parameter, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.parts import Number, Numbers, Part
from rldrill.problems.phrases import check_one_open, discount, in_open
from rldrill.problems.runs import per_step

TITLE = "Return"
SOURCE = "Sutton & Barto 2018, section 3.3"
REVISION = 1


class Given(Givens):
    """The rewards r_1 … r_T of an episode, the discount, and the time from which the return is asked.

    Without ``time`` the returns from all times are asked for. Instead of one discount there may be a list with one for
    every step: the first multiplies all that comes after the first reward.
    """

    rewards: tuple[Exact, ...] = Field(
        min_length=1, max_length=500, description="The rewards of the episode from the first, r_1, to the last."
    )
    gamma: Discounts
    time: int | None = Field(
        default=None, ge=0, description="The time from which the return is asked for; without it, from all times."
    )

    @model_validator(mode="after")
    def _inside(self) -> "Given":
        if self.time is not None and self.time >= len(self.rewards):
            raise ValueError(f"time is {self.time}, but the episode ends at {len(self.rewards)}")
        per_step(self.gamma, len(self.rewards))
        check_one_open(self)
        return self


def draw(level: int, rng: Draws) -> Given:
    """Three or four rewards; then all returns; then an expression in γ."""
    if level == 1:
        rewards = tuple(rng.nonzero(-2, 8) for _ in range(4))
        return Given(rewards=rewards, gamma=rng.fraction("1/2", "1/3", "1/10"), time=1)
    if level == 2:
        rewards = tuple(rng.nonzero(-4, 9) for _ in range(5))
        return Given(rewards=rewards, gamma=rng.fraction("1/2", "1/3", "2/3", "9/10", "1/5"))
    rewards = tuple(rng.nonzero(-4, 9) for _ in range(5))
    return Given(rewards=rewards, gamma=Parameter("gamma"), time=rng.choice((1, 2)))


def question(given: Given) -> Question:
    """All returns as a vector, or one of them and then the return from the start."""
    end = len(given.rewards)
    rewards = ", ".join(f"r_{{{time + 1}}} = {shown(reward)}" for time, reward in enumerate(given.rewards))
    blocks = (Paragraph(f"An episode earns the rewards ${rewards}$ and ends at $T = {end}$. {discount(given.gamma)}"),)
    if given.time is None:
        entries = tuple(f"R_{{{time}}}" for time in range(end))
        ask = f"What are the returns $R_0, …, R_{{{end - 1}}}$, in this order{in_open(given)}?"
        return Question(blocks, (Part(ask, Numbers(entries)),))
    parts = [Part(f"What is the return $R_{{{given.time}}}${in_open(given)}?", Number())]
    if given.time:
        parts.append(Part(f"What is the return $R_0${in_open(given)}?", Number()))
    return Question(blocks, tuple(parts))
