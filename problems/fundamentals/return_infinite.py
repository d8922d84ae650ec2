"""The return of rewards that never end: some first ones, then rewards that repeat for ever."""

from fractions import Fraction

from pydantic import Field, field_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Exact, Parameter, Scalar, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.parts import Number, Part
from rldrill.problems.phrases import discount, in_open

TITLE = "Return without an end"
SOURCE = "Sutton & Barto 2018, section 3.3"
REVISION = 1


class Given(Givens):
    """The first rewards r_1 … r_k, the rewards that come round and round after them, and the discount."""

    first: tuple[Exact, ...] = Field(
        default=(), max_length=200, description="The rewards that come once, before the others."
    )
    repeated: tuple[Exact, ...] = Field(
        min_length=1, max_length=60, description="The rewards that come round and round after them."
    )
    gamma: Discount

    @field_validator("gamma")
    @classmethod
    def _converges(cls, gamma: Scalar) -> Scalar:
        if isinstance(gamma, Fraction) and gamma == 1:
            raise ValueError("must be below 1, or rewards without an end have no sum")
        return gamma


def draw(level: int, rng: Draws) -> Given:
    """One reward and then a constant; then two and a round of two; then the same with γ left open."""
    first = tuple(rng.nonzero(-4, 9) for _ in range(min(level, 2)))
    repeated = tuple(rng.nonzero(-4, 9) for _ in range(min(level, 2)))
    if level == 3:
        return Given(first=first, repeated=repeated, gamma=Parameter("gamma"))
    return Given(first=first, repeated=repeated, gamma=rng.fraction("1/2", "1/3", "2/3", "3/4", "4/5", "9/10"))


def question(given: Given) -> Question:
    """The rewards in words; the return from where they begin to repeat, then the return from the start."""
    k = len(given.first)
    first = ", ".join(f"r_{{{time + 1}}} = {shown(reward)}" for time, reward in enumerate(given.first))
    opening = (
        f"A task never ends. Its first reward{'s are' if k > 1 else ' is'} ${first}$. " if k else "A task never ends. "
    )
    since = f"From $r_{{{k + 1}}}$ on" if k else "From the first one on"
    if len(given.repeated) == 1:
        told = f"{since}, every reward is ${shown(given.repeated[0])}$."
    else:
        round_ = ", ".join(shown(reward) for reward in given.repeated)
        told = f"{since}, the rewards are ${round_}$, and again ${round_}$, and so on for ever."
    limits = " It is at least $0$ and below $1$." if isinstance(given.gamma, Parameter) else ""
    blocks = (Paragraph(f"{opening}{told} {discount(given.gamma)}{limits}"),)
    parts = [Part(f"What is the return $R_{{{k}}}${in_open(given)}?", Number())]
    if k:
        parts.append(Part(f"What is the return $R_{{0}}${in_open(given)}?", Number()))
    return Question(blocks, tuple(parts))
