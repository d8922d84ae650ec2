"""The return of a finite sequence of rewards, from the start and from later times."""

from collections.abc import Sequence
from typing import Annotated

from pydantic import Discriminator, Field, Tag, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Discounts, Exact, Open, Parameter, Scalar, shown
from rldrill.problems.family import AskedFor, Question
from rldrill.problems.fractions import Fraction, plain
from rldrill.problems.parts import Choice, Number, Numbers, Part
from rldrill.problems.phrases import RETURN_DEFINED, check_one_open, discount, in_open
from rldrill.problems.reversible import Reversible, letter_asked, unknown
from rldrill.problems.runs import per_step

TITLE = "Return"
SOURCE = "Sutton & Barto 2018, section 3.3"
REVISION = 5

#: The two episodes that are compared.
EPISODES = {"A": "the first", "B": "the second"}


class Single(Reversible):
    """The rewards r_1 … r_T of an episode, the discount, and the time from which the return is asked.

    Without ``time`` the returns from all times are asked for. Instead of one discount there may be a list with one for
    every step: the first multiplies all that comes after the first reward. Where ``known`` is the return from the
    start, the reward or the discount that is left open is asked for.
    """

    rewards: tuple[Open, ...] = Field(
        min_length=1, max_length=500, description="The rewards of the episode from the first, r_1, to the last."
    )
    gamma: Discounts
    time: int | None = Field(
        default=None, ge=0, description="The time from which the return is asked for; without it, from all times."
    )

    @model_validator(mode="after")
    def _inside(self) -> "Single":
        if self.time is not None and self.time >= len(self.rewards):
            raise ValueError(
                f"time is {self.time}, but the episode ends at {len(self.rewards)}; choose an earlier time"
            )
        per_step(self.gamma, len(self.rewards))
        check_one_open(self)
        return self


class Compared(AskedFor):
    """The rewards of two episodes, and their discount; one left open is asked for, so that both are equally good."""

    rewards: tuple[Exact, ...] = Field(min_length=1, max_length=100, description="The rewards of the first episode.")
    others: tuple[Exact, ...] = Field(min_length=1, max_length=100, description="The rewards of the second episode.")
    gamma: Discount

    @property
    def sought(self) -> bool:
        """Whether the discount at which both are equally good is asked for."""
        return isinstance(self.gamma, Parameter)


def _kind(given: object) -> str:
    return "compared" if isinstance(given, dict) and "others" in given else "single"


Given = Annotated[Annotated[Single, Tag("single")] | Annotated[Compared, Tag("compared")], Discriminator(_kind)]


def draw(level: int, rng: Draws) -> Single | Compared:
    """A return and the one from the start; all returns, or two episodes; then a reward or a discount is asked for."""
    if level == 1:
        gamma = rng.fraction("1/2", "1/3")
        return Single(rewards=_rewards(rng, 4, gamma), gamma=gamma, time=1)
    gamma = rng.fraction("1/2", "2/3", "3/4", "4/5")
    count = 5 if gamma.denominator < 4 else 4
    kind = rng.below(4)
    if level == 2:
        if kind == 0:
            return _compared(rng, gamma, count)
        return Single(rewards=_rewards(rng, count, gamma), gamma=gamma, time=rng.choice((None, 2)))
    if kind == 0:
        return _equally_good(rng)
    if kind == 1:
        return _earned_twice(rng)
    rewards = _rewards(rng, count, gamma)
    return _hidden(rewards, gamma, (1 + rng.below(len(rewards) - 1),))


def _rewards(rng: Draws, count: int, gamma: Fraction) -> tuple[Fraction, ...]:
    """Rewards whose returns are not 0 or equal to the one before, and whole at the end."""
    rewards: tuple[Fraction, ...] = (gamma.denominator * rng.nonzero(-2, 3),)
    for number in range(1, count):
        multiple = gamma.denominator if number == 1 else 1
        rewards = (_reward_before(rng, _total(rewards, gamma), gamma, multiple), *rewards)
    return rewards


def _reward_before(rng: Draws, later: Fraction, gamma: Fraction, multiple: int) -> Fraction:
    """A reward that makes a multiple of a number with what comes later, where that is whole; but not 0 or the same."""
    after, same = plain(gamma * later), plain(later)
    whole = multiple if after.denominator == 1 else Fraction(1, after.denominator)
    return rng.fitting(-4, 9, lambda reward: reward + after not in (0, same) and (reward + after) % whole == 0)


def _total(rewards: Sequence[Fraction], gamma: Fraction) -> Fraction:
    return sum((gamma**time * reward for time, reward in enumerate(rewards)), Fraction(0))


def _hidden(rewards: Sequence[Fraction], gamma: Fraction, places: Sequence[int]) -> Single:
    """An episode whose return is told, and the reward in these places is not."""
    seen: tuple[Scalar, ...] = tuple(Parameter("x") if place in places else r for place, r in enumerate(rewards))
    return Single(rewards=seen, gamma=gamma, known=_total(rewards, gamma))


def _earned_twice(rng: Draws) -> Single:
    """An episode in which the same reward, which is not known, is earned at two times."""
    gamma, places = rng.fraction("1/2", "1/3", "2/3"), rng.choice(((0, 2), (0, 3), (1, 3), (1, 2), (2, 3)))
    rewards = list(_rewards(rng, 4, gamma))
    rewards[places[1]] = rewards[places[0]]
    return _hidden(rewards, gamma, places)


def _compared(rng: Draws, gamma: Fraction, count: int) -> Compared:
    """Two episodes; in half of them the one with the larger return has the smaller sum of rewards."""
    deceives, swapped = (rng.chance(Fraction(1, 2)) for _ in range(2))
    while True:
        better, worse = _rewards(rng, count - 1, gamma), _rewards(rng, count - 2, gamma)
        lead = _total(better, gamma) - _total(worse, gamma)
        undiscounted = sum(better) - sum(worse)
        if lead and undiscounted and (undiscounted * lead < 0) == deceives:
            break
    first, second = (better, worse) if (lead > 0) != swapped else (worse, better)
    return Compared(rewards=first, others=second, gamma=gamma)


def _equally_good(rng: Draws) -> Compared:
    """Two episodes that pay the same at a discount between 0 and 1."""
    gamma = rng.fraction("1/2", "1/3", "2/3", "1/4", "3/4", "2/5", "3/5", "4/5")
    now, later = rng.nonzero(-2, 6), rng.nonzero(-3, 6)
    times = rng.choice((1, 1, 2)) * rng.choice((1, -1))
    first = (now + gamma.numerator * times, later)
    return Compared(rewards=first, others=(now, later + gamma.denominator * times), gamma=Parameter("gamma"))


def question(given: Single | Compared) -> Question:
    """All returns as a vector, or one of them and then the return from the start; or two episodes to compare."""
    if isinstance(given, Compared):
        return _comparison(given)
    end = len(given.rewards)
    told = unknown(given, f"{_letter_told(given)}{discount(given.gamma)}")
    if given.known is not None:
        told += f" The return from the start is $R_0 = {shown(given.known)}$."
    run = f"An episode has the rewards ${_listed(given.rewards)}$ and ends at $T = {end}$."
    blocks = (Paragraph(f"{run} {RETURN_DEFINED} {told}"),)
    if given.known is not None:
        return Question(blocks, (letter_asked(given),))
    if given.time is None:
        entries = tuple(f"R_{{{time}}}" for time in range(end))
        named = "$R_0$ and $R_1$" if end == 2 else f"$R_0, …, R_{{{end - 1}}}$"
        returns = f"are the returns {named}, in this order" if end > 1 else "is the return $R_0$"
        ask = f"What {returns}{in_open(given)}?"
        return Question(blocks, (Part(ask, Numbers(entries)),))
    parts = [Part(f"What is the return $R_{{{given.time}}}${in_open(given)}?", Number())]
    if given.time:
        parts.append(Part(f"What is the return $R_0${in_open(given)}?", Number()))
    return Question(blocks, tuple(parts))


def _letter_told(given: Single) -> str:
    hidden = next((reward for reward in given.rewards if isinstance(reward, Parameter)), None)
    return f"The reward ${shown(hidden)}$ is left open. " if hidden else ""


def _listed(rewards: Sequence[Scalar]) -> str:
    return ", ".join(f"r_{{{time}}} = {shown(reward)}" for time, reward in enumerate(rewards, 1))


def _comparison(given: Compared) -> Question:
    told = "$γ$ is the discount of both." if given.sought else f"The discount of both is $γ = {shown(given.gamma)}$."
    blocks = (
        Paragraph(
            f"An episode has the rewards ${_listed(given.rewards)}$. A second one has the rewards "
            f"${_listed(given.others)}$. Each ends after its last reward; $R_0 = r_1 + γ r_2 + …$ is the return of the "
            f"first, $R'_0$ that of the second. {told}"
        ),
    )
    if given.sought:
        return Question(
            blocks,
            (
                Part("For which discount $γ$ is $R_0 = R'_0$?", Number()),
                Part("Which of them has the larger return if $γ$ is larger than that?", Choice(EPISODES)),
            ),
        )
    return Question(
        blocks,
        (
            Part("What are the returns $R_0$ and $R'_0$, in this order?", Numbers(("R_0", "R'_0"))),
            Part("Which of them would have the larger return if nothing were discounted ($γ = 1$)?", Choice(EPISODES)),
        ),
    )
