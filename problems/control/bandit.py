"""A bandit: sample averages and the greedy arm, upper confidence bounds, or a step on its preferences."""

from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph
from rldrill.problems.document import Table as Cells
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import Name, check_keys
from rldrill.problems.parts import Part, Policy, Values

TITLE = "Bandits"
SOURCE = "Sutton & Barto 2018, chapter 2"
REVISION = 1

#: What the choice of the next arm is asked for.
NEXT = "next"


class Pull(NamedTuple):
    """An arm that was pulled, and the reward that it gave."""

    arm: Name
    reward: Exact


class Given(Givens):
    """The pulls so far; with ``c`` bounds are asked for, with preferences, α and one more pull a gradient step."""

    pulls: tuple[Pull, ...] = Field(min_length=1, max_length=100)
    c: Exact | None = Field(default=None, gt=0)
    preferences: dict[Name, Exact] | None = Field(default=None, min_length=2)
    alpha: Exact | None = Field(default=None, gt=0)
    pulled: Pull | None = None
    story: str = Field(default="", max_length=200, pattern=r"^[^$\\]*$")

    @model_validator(mode="after")
    def _one_kind(self) -> Self:
        gradient = (self.preferences, self.alpha, self.pulled)
        if any(part is not None for part in gradient):
            if any(part is None for part in gradient):
                raise ValueError("a gradient step needs all of preferences, alpha and pulled")
            if self.c is not None:
                raise ValueError("c belongs to UCB, preferences to a gradient step; give one of them")
            check_keys(dict.fromkeys(pull.arm for pull in self.every_pull), self.arms, "a pull", needed=())
        if len(self.arms) < 2:
            raise ValueError("there must be at least two arms")
        return self

    @property
    def kind(self) -> str:
        """What is asked for: ``estimates``, ``ucb`` or ``gradient``."""
        return "gradient" if self.preferences is not None else "estimates" if self.c is None else "ucb"

    @property
    def arms(self) -> tuple[str, ...]:
        """The arms, in the order of the preferences or else of their first pulls."""
        return tuple(self.preferences or dict.fromkeys(pull.arm for pull in self.pulls))

    @property
    def every_pull(self) -> tuple[Pull, ...]:
        """The pulls so far, and the one more."""
        return (*self.pulls, self.pulled) if self.pulled else self.pulls


@dataclass(frozen=True, slots=True)
class _Story:
    told: str
    arms: tuple[str, ...]


_STORIES = (
    _Story("A robot tries grips on an unknown object.", ("pinch", "hook", "suction")),
    _Story("A web shop tries banners.", ("red", "green", "blue")),
    _Story("A gambler plays slot machines.", ("left", "middle", "right")),
    _Story("A rover tries soils for drilling.", ("sand", "clay", "gravel")),
)


def draw(level: int, rng: Draws) -> Given:
    """Estimates from five pulls; then bounds from five or six; then a gradient step with a baseline."""
    story = rng.choice(_STORIES)
    arms = story.arms
    if level == 3:
        pulls = tuple(Pull(rng.choice(arms), rng.whole(0, 8)) for _ in range(rng.choice((5, 6))))
        low = rng.nonzero(-2, 2)
        preferences = dict.fromkeys(arms, low) | {rng.choice(arms): low + rng.fraction("1/2", "1", "2")}
        return Given(
            pulls=pulls,
            preferences=preferences,
            alpha=rng.fraction("1/2", "1/4", "1/10", "1/5"),
            pulled=Pull(rng.choice(arms), rng.whole(0, 9)),
            story=story.told,
        )
    extra = tuple(rng.choice(arms) for _ in range(2 if level == 1 else rng.choice((2, 3))))
    order = (*arms, *rng.shuffled(extra))
    pulls = tuple(Pull(arm, rng.whole(0, 9)) for arm in order)
    return Given(pulls=pulls, c=None if level == 1 else rng.fraction("1", "2", "1/2"), story=story.told)


def question(given: Given) -> Question:
    """The pulls, then what is asked of that kind of bandit."""
    pulls = len(given.pulls)
    told = f"{given.story} " if given.story else ""
    blocks = (
        Paragraph(f"{told}There are {len(given.arms)} arms, and so far these pulls ($r_i$ is the reward of pull $i$):"),
        Cells(
            header=("$i$", *(f"${number}$" for number in range(1, pulls + 1))),
            rows=(
                ("$a_i$", *(pull.arm for pull in given.pulls)),
                ("$r_i$", *(f"${shown(pull.reward)}$" for pull in given.pulls)),
            ),
        ),
    )
    if given.kind == "gradient":
        return Question((*blocks, *_preferences(given)), _gradient_parts(given))
    estimates = Part("What is the sample average $Q(a)$ of every arm?", Values("Q", given.arms), zero=True)
    choice = Policy({NEXT: given.arms})
    if given.kind == "estimates":
        return Question(blocks, (estimates, Part("Which arm is pulled next, if the choice is greedy?", choice)))
    explained = Paragraph(
        f"The next arm is chosen at time $t = {pulls + 1}$ by its upper confidence bound $U(a)$ (UCB), in which the "
        f"exploration is weighted with $c = {shown(given.c or Fraction(0))}$."
    )
    return Question(
        (*blocks, explained),
        (
            estimates,
            Part("What is the upper confidence bound $U(a)$ of every arm?", Values("U", given.arms), points=2),
            Part("Which arm does UCB pull next?", choice),
        ),
    )


def _preferences(given: Given) -> tuple[Block, ...]:
    if given.preferences is None or given.alpha is None or given.pulled is None:
        return ()
    pulls = len(given.pulls)
    return (
        Paragraph("A gradient bandit now has these preferences:"),
        Cells(
            header=("$a$", *given.preferences),
            rows=(("$H(a)$", *(f"${shown(value)}$" for value in given.preferences.values())),),
        ),
        Paragraph(
            f"Pull ${pulls + 1}$ is {given.pulled.arm} and gives the reward $r_{{{pulls + 1}}} = "
            f"{shown(given.pulled.reward)}$. The baseline is the mean of the rewards before it, $r_1$ to "
            f"$r_{{{pulls}}}$. The step size is $α = {shown(given.alpha)}$."
        ),
    )


def _gradient_parts(given: Given) -> tuple[Part, ...]:
    last = len(given.every_pull)
    return (
        Part(f"With which probability $π(a)$ was every arm chosen at pull ${last}$?", Values("π", given.arms)),
        Part(f"What is the preference $H(a)$ of every arm after pull ${last}$?", Values("H", given.arms), points=2),
    )
