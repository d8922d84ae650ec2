"""A bandit: sample averages and the greedy arm, upper confidence bounds, or a step on its preferences."""

from dataclasses import dataclass
from typing import Annotated, NamedTuple, Self

from pydantic import Discriminator, Field, Tag, model_validator

from rldrill.problems.document import Block, Paragraph, joined
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


Story = Annotated[str, Field(max_length=200, pattern=r"^[^$\\]*$")]


class Bandit(Givens):
    """The pulls so far."""

    pulls: tuple[Pull, ...] = Field(min_length=1, max_length=100, description="The pulls so far, in their order.")

    @model_validator(mode="after")
    def _choice(self) -> Self:
        if len(self.every_arm) < 2:
            raise ValueError("there must be at least two arms")
        check_keys(dict.fromkeys(pull.arm for pull in self.every_pull), self.every_arm, "a pull", needed=())
        return self

    @property
    def every_pull(self) -> tuple[Pull, ...]:
        """All pulls."""
        return self.pulls

    @property
    def every_arm(self) -> tuple[str, ...]:
        """The arms, in the order of their first pulls."""
        return tuple(dict.fromkeys(pull.arm for pull in self.pulls))


class Averaged(Bandit):
    """The pulls so far, and all arms if some were never pulled."""

    arms: tuple[Name, ...] = Field(
        default=(),
        max_length=100,
        exclude_if=lambda arms: not arms,
        description="All arms, those that were never pulled too; left out, they are the arms of the pulls.",
        examples=[["a", "b", "c"]],
    )

    @property
    def every_arm(self) -> tuple[str, ...]:
        """The arms, in the order of the list or of their first pulls."""
        return tuple(dict.fromkeys(self.arms)) or super().every_arm

    @property
    def tried(self) -> tuple[str, ...]:
        """The arms that were pulled, which alone have a sample average."""
        return tuple(arm for arm in self.every_arm if any(pull.arm == arm for pull in self.pulls))

    @property
    def untried(self) -> tuple[str, ...]:
        """The arms that were never pulled."""
        return tuple(arm for arm in self.every_arm if arm not in self.tried)


class Estimates(Averaged):
    """The pulls so far, which are averaged."""

    story: Story = Field(default="", description="A sentence that is printed first.")


class Bounds(Averaged):
    """The pulls so far, and the weight of the exploration in upper confidence bounds."""

    c: Exact = Field(gt=0, description="The weight of the exploration, above 0.")
    story: Story = Field(default="", description="A sentence that is printed first.")


class Preferences(Bandit):
    """The pulls so far, the preferences after them, and one more pull, from which they learn with step size α."""

    preferences: dict[Name, Exact] = Field(min_length=2, description="The preference of every arm after these pulls.")
    alpha: Exact = Field(gt=0, description="The step size, above 0.")
    pulled: Pull = Field(description="The pull after them, from which the preferences learn.")
    story: Story = Field(default="", description="A sentence that is printed first.")

    @property
    def every_arm(self) -> tuple[str, ...]:
        """The arms, in the order of their preferences."""
        return tuple(self.preferences)

    @property
    def every_pull(self) -> tuple[Pull, ...]:
        """The pulls so far, and the one more."""
        return (*self.pulls, self.pulled)


def _kind(given: object) -> str | None:
    match given:
        case {"c": _, "preferences": _} | {"c": _, "alpha": _} | {"c": _, "pulled": _}:
            return None
        case {"c": _}:
            return "bounds"
        case {"preferences": _} | {"alpha": _} | {"pulled": _}:
            return "preferences"
    return "estimates"


Given = Annotated[
    Annotated[Estimates, Tag("estimates")]
    | Annotated[Bounds, Tag("bounds")]
    | Annotated[Preferences, Tag("preferences")],
    Discriminator(
        _kind,
        custom_error_type="kind",
        custom_error_message="c belongs to UCB, preferences to a gradient step; give one of them",
    ),
]


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
        return Preferences(
            pulls=pulls,
            preferences=preferences,
            alpha=rng.fraction("1/2", "1/4", "1/10", "1/5"),
            pulled=Pull(rng.choice(arms), rng.whole(0, 9)),
            story=story.told,
        )
    extra = tuple(rng.choice(arms) for _ in range(2 if level == 1 else rng.choice((2, 3))))
    order = (*arms, *rng.shuffled(extra))
    pulls = tuple(Pull(arm, rng.whole(0, 9)) for arm in order)
    if level == 1:
        return Estimates(pulls=pulls, story=story.told)
    return Bounds(pulls=pulls, c=rng.fraction("1", "2", "1/2"), story=story.told)


def question(given: Given) -> Question:
    """The pulls, then what is asked of that kind of bandit."""
    pulls = len(given.pulls)
    told = f"{given.story} " if given.story else ""
    blocks = (
        Paragraph(f"{told}There are {_listed(given)}, and so far these pulls ($r_i$ is the reward of pull $i$):"),
        Cells(
            header=("$i$", *(f"${number}$" for number in range(1, pulls + 1))),
            rows=(
                ("$a_i$", *(pull.arm for pull in given.pulls)),
                ("$r_i$", *(f"${shown(pull.reward)}$" for pull in given.pulls)),
            ),
        ),
    )
    match given:
        case Estimates():
            greedy = Part("Which arm is pulled next, if the choice is greedy?", Policy({NEXT: given.every_arm}))
            return Question(
                (*blocks, *_untried(given, "a greedy choice leaves out what has none")), (_averages(given), greedy)
            )
        case Bounds():
            first = "UCB takes an arm that was never pulled before all others"
            return Question(
                (*blocks, _exploration(given), *_untried(given, first)), (_averages(given), *_bounds(given))
            )
        case Preferences():
            return Question((*blocks, *_preferences(given)), _gradient_step(given))


def _listed(given: Bandit) -> str:
    """How many arms there are; by name, where the pulls do not name them all."""
    named = isinstance(given, Averaged) and given.untried
    return f"{len(given.every_arm)} arms" + (f", {joined([*given.every_arm])}" if named else "")


def _untried(given: Averaged, then: str) -> tuple[Block, ...]:
    """What follows from an arm's never having been pulled."""
    if not given.untried:
        return ()
    verb, of = ("was", "its sample average does") if len(given.untried) == 1 else ("were", "their sample averages do")
    return (Paragraph(f"{joined([*given.untried])} {verb} never pulled, so {of} not exist: {then}."),)


def _pulled(given: Averaged) -> str:
    return "every arm that was pulled" if given.untried else "every arm"


def _averages(given: Averaged) -> Part:
    return Part(f"What is the sample average $Q(a)$ of {_pulled(given)}?", Values("Q", given.tried), zero=True)


def _exploration(given: Bounds) -> Block:
    return Paragraph(
        f"The next arm is chosen at time $t = {len(given.pulls) + 1}$ by its upper confidence bound $U(a)$ (UCB), in "
        f"which the exploration is weighted with $c = {shown(given.c)}$."
    )


def _bounds(given: Bounds) -> tuple[Part, ...]:
    return (
        Part(f"What is the upper confidence bound $U(a)$ of {_pulled(given)}?", Values("U", given.tried)),
        Part("Which arm does UCB pull next?", Policy({NEXT: given.every_arm})),
    )


def _preferences(given: Preferences) -> tuple[Block, ...]:
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


def _gradient_step(given: Preferences) -> tuple[Part, ...]:
    last, arms = len(given.every_pull), given.every_arm
    return (
        Part(f"With which probability $π(a)$ was every arm chosen at pull ${last}$?", Values("π", arms)),
        Part(f"What is the preference $H(a)$ of every arm after pull ${last}$?", Values("H", arms)),
    )
