"""The return of rewards that never end: some first ones, then rewards that repeat for ever."""

from pydantic import Field, field_validator, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Open, Parameter, Scalar, shown
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.parts import Number, Part
from rldrill.problems.phrases import RETURN_DEFINED, check_one_open, discount, in_open
from rldrill.problems.reversible import Reversible, letter_asked, unknown

TITLE = "Return without an end"
SOURCE = "Sutton & Barto 2018, section 3.3"
REVISION = 5


class Given(Reversible):
    """The first rewards r_1 … r_k, the rewards that come round and round after them, and the discount.

    Where ``known`` is the return from the start, what is left open is asked for beside the return from where the
    rewards begin to repeat: a reward after that return, the discount before it.
    """

    first: tuple[Open, ...] = Field(
        default=(), max_length=200, description="The rewards that come once, before the others."
    )
    repeated: tuple[Open, ...] = Field(
        min_length=1, max_length=60, description="The rewards that come round and round after them."
    )
    gamma: Discount

    @field_validator("gamma")
    @classmethod
    def _converges(cls, gamma: Scalar) -> Scalar:
        if isinstance(gamma, Fraction) and gamma == 1:
            raise ValueError("must be below 1, or rewards without an end have no sum")
        return gamma

    @model_validator(mode="after")
    def _one_open(self) -> "Given":
        check_one_open(self)
        return self


def draw(level: int, rng: Draws) -> Given:
    """One reward and then a constant; then rounds of two or three; then a letter left open or asked for."""
    if level == 1:
        gamma = rng.fraction("1/2", "1/3", "2/3")
        opening, always = rng.nonzero(-4, 9), rng.nonzero(-4, 7)
        return Given(first=(opening,), repeated=(always,), gamma=gamma) if opening != always else draw(level, rng)
    gamma = rng.fraction("1/2", "1/3", "2/3", "3/4", "4/5")
    if level == 2:
        length = rng.choice((2, 2, 3)) if gamma == Fraction(1, 2) else 2
        first = _first(rng, rng.choice((0, 1, 1, 2, 2, 2)))
        unit = Fraction(1, gamma.denominator if len(first) < 2 else 1)
        repeated = _round(rng, length, gamma, unit)
        rewards = (*first, *repeated)
        if first and _from_start(rewards, len(first), gamma) == _from_start(repeated, 0, gamma):
            return draw(level, rng)
        return Given(first=first, repeated=repeated, gamma=gamma)
    kind = rng.below(3)
    if kind == 0:
        first, repeated = _first(rng, 1 + rng.below(2)), _first(rng, 2)
        if first[-1] == repeated[-1] or repeated[0] == repeated[1]:  # or the round would begin a step earlier
            return draw(level, rng)
        return Given(first=first, repeated=repeated, gamma=Parameter("gamma"))
    if kind == 1:
        opening, always = rng.distinct(2, 1, 9)
        known = opening + gamma * always / (1 - gamma)
        return Given(first=(opening,), repeated=(always,), gamma=Parameter("gamma"), known=known)
    first, (one, other) = _first(rng, 1 + rng.below(2)), _round(rng, 2, gamma)
    known = _from_start((*first, one, other), len(first), gamma)
    hidden = (Parameter("x"), other) if rng.chance(Fraction(1, 2)) else (one, Parameter("x"))
    return Given(first=first, repeated=hidden, gamma=gamma, known=known)


def _first(rng: Draws, count: int) -> tuple[Fraction, ...]:
    return tuple(rng.nonzero(-4, 9) for _ in range(count))


def _round(rng: Draws, length: int, gamma: Fraction, unit: Fraction = Fraction(1)) -> tuple[Fraction, ...]:
    """Rewards of a round, not all equal, whose return is a multiple of the unit."""
    opening = _first(rng, length - 1)

    def fits(last: int) -> bool:
        worth = _from_start((*opening, Fraction(last)), 0, gamma)
        return worth != 0 and worth % unit == 0 and last != opening[0]

    last = rng.fitting(-9, 12, fits)
    return (*opening, last) if fits(int(last)) else _round(rng, length, gamma, unit)


def _from_start(rewards: tuple[Fraction, ...], first: int, gamma: Fraction) -> Fraction:
    """The return of rewards that come again and again after the first ones."""
    worth = [gamma**time * reward for time, reward in enumerate(rewards)]
    return sum(worth[:first], Fraction(0)) + sum(worth[first:], Fraction(0)) / (1 - gamma ** (len(rewards) - first))


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
        told = f"{since}, the rewards are ${round_}$, then again ${round_}$, and so on for ever."
    limits = ", with $0 ≤ γ < 1$." if isinstance(given.gamma, Parameter) else "."
    letter = "The reward $x$ is left open. " if "x" in given.letters else ""
    more = unknown(
        given,
        f"{RETURN_DEFINED} {letter}{discount(given.gamma)[:-1]}{limits}",
    )
    if given.known is not None:
        more += f" The return from the start is $R_0 = {shown(given.known)}$."
        tail = [Part(f"What is the return $R_{{{k}}}$?", Number())] if k else []
        asked = (letter_asked(given), *tail) if given.letter == "gamma" else (*tail, letter_asked(given))
        return Question((Paragraph(f"{opening}{told} {more}"),), asked)
    parts = [Part(f"What is the return $R_{{{k}}}${in_open(given)}?", Number())]
    if k:
        parts.append(Part(f"What is the return $R_{{0}}${in_open(given)}?", Number()))
    return Question((Paragraph(f"{opening}{told} {more}"),), tuple(parts))
