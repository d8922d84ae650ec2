"""A bandit: sample averages and the greedy arm, upper confidence bounds and their weight, or a gradient step."""

from math import log, sqrt
from typing import Annotated, NamedTuple, Self

from msgspec import Struct
from pydantic import Discriminator, Field, Tag, model_validator

from rldrill.problems.document import Block, Paragraph, joined
from rldrill.problems.document import Table as Cells
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Logarithm, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.features import ActionPreferences
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Name, check_keys
from rldrill.problems.parts import Number, Part, Policy, Values

TITLE = "Bandits"
SOURCE = "Sutton & Barto 2018, chapter 2"
REVISION = 3

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
            raise ValueError("there must be at least two arms; add one")
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


class Balance(Averaged):
    """The pulls so far, and two arms whose upper confidence bounds some weight of the exploration makes equal."""

    between: tuple[Name, Name] = Field(
        description="Two arms: the one with the greater sample average, then one that was pulled less often.",
        examples=[["b", "a"]],
    )
    story: Story = Field(default="", description="A sentence that is printed first.")

    @model_validator(mode="after")
    def _balances(self) -> Self:
        for arm in self.between:
            if arm not in self.tried:
                raise ValueError(
                    f"between: {arm!r} was never pulled, so it has no upper confidence bound; name another"
                )
        better, rarer = ([pull.reward for pull in self.pulls if pull.arm == arm] for arm in self.between)
        if len(better) <= len(rarer) or sum(better) * len(rarer) <= sum(rarer) * len(better):
            raise ValueError(
                f"between: {self.between[0]!r} must have the greater sample average and more pulls than "
                f"{self.between[1]!r}, or no weight above 0 makes their bounds equal"
            )
        return self


class Preferences(Bandit):
    """The pulls so far, the preferences after them, and one more pull, from which they learn with step size α."""

    preferences: ActionPreferences = Field(min_length=2, description="The preference of every arm after these pulls.")
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

    @property
    def sum_to_zero(self) -> bool:
        """Whether the preferences sum to 0, so that they themselves cannot be normalised; logarithms never do."""
        numbers = [value for value in self.preferences.values() if isinstance(value, Fraction)]
        return len(numbers) == len(self.preferences) and sum(numbers) == 0


def _kind(given: object) -> str | None:
    match given:
        case {"c": _, "preferences": _} | {"c": _, "alpha": _} | {"c": _, "pulled": _} | {"c": _, "between": _}:
            return None
        case {"c": _}:
            return "bounds"
        case {"between": _}:
            return "balance"
        case {"preferences": _} | {"alpha": _} | {"pulled": _}:
            return "preferences"
    return "estimates"


Given = Annotated[
    Annotated[Estimates, Tag("estimates")]
    | Annotated[Bounds, Tag("bounds")]
    | Annotated[Balance, Tag("balance")]
    | Annotated[Preferences, Tag("preferences")],
    Discriminator(
        _kind,
        custom_error_type="kind",
        custom_error_message="c belongs to UCB, preferences to a gradient step, between to the c that is asked for; "
        "give one of them",
    ),
]


class _Story(Struct, frozen=True):
    told: str
    arms: tuple[str, ...]


_STORIES = (
    _Story("A robot tries grips on an unknown object.", ("pinch", "hook", "palm")),
    _Story("A web shop tries banners.", ("red", "green", "blue")),
    _Story("A gambler plays slot machines.", ("left", "middle", "right")),
    _Story("A rover tries soils for drilling.", ("sand", "clay", "gravel")),
)


#: How often the arms were pulled, with UCB: never all alike, so that the bonuses differ.
_COUNTS = ((1, 4), (4, 1), (2, 4), (1, 2, 4), (1, 1, 4), (2, 1, 2), (1, 3, 2), (1, 4, 4))


def draw(level: int, rng: Draws) -> Given:
    """Sample averages of some pulls; then bounds, which outvote them in half of the draws; then c, or a gradient."""
    story = rng.choice(_STORIES)
    if level == 1:
        return Estimates(pulls=_pulls(rng, story.arms, rng.shuffled((2, 2, 1 + rng.below(2)))), story=story.told)
    if level == 2:
        return _bounds_drawn(rng, story, outvoted=rng.chance(Fraction(1, 2)))
    return _balance_drawn(rng, story) if rng.chance(Fraction(1, 2)) else _preferences_drawn(rng, story)


def _pulls(rng: Draws, arms: tuple[str, ...], counts: tuple[int, ...], means: tuple[int, ...] = ()) -> tuple[Pull, ...]:
    """So many pulls of every arm in any order; all averages differ, and are those wanted."""
    means = means or tuple(map(int, rng.distinct(len(arms), 2, 6)))
    rewards = {arm: _rewards(rng, count, mean) for arm, count, mean in zip(arms, counts, means, strict=False)}
    order = rng.shuffled([arm for arm, row in rewards.items() for _ in row])
    return tuple(Pull(arm, rewards[arm].pop()) for arm in order)


def _rewards(rng: Draws, count: int, mean: int) -> list[Fraction]:
    """Rewards around that mean, which is none of the first; the last one makes it exact."""
    while True:
        first = [rng.whole(max(0, mean - 4), mean + 4) for _ in range(count - 1)]
        last = mean * count - sum(first)
        if 0 <= last <= mean + 6 and mean not in first:
            return [*first, Fraction(last)]


def _bounds_drawn(rng: Draws, story: _Story, *, outvoted: bool) -> Bounds:
    """Whether the arm that UCB takes is not the greedy one is drawn before the numbers."""
    while True:
        counts = rng.choice(_COUNTS)
        means = tuple(map(int, rng.distinct(len(counts), 1, 6)))
        c = rng.fraction("1", "2", "3")
        time = sum(counts) + 1
        bounds = [mean + float(c) * sqrt(log(time) / count) for mean, count in zip(means, counts, strict=True)]
        best, second = sorted(bounds)[:-3:-1]
        if best - second > 0.1 and (bounds.index(best) != means.index(max(means))) == outvoted:
            return Bounds(pulls=_pulls(rng, story.arms, counts, means), c=c, story=story.told)


def _balance_drawn(rng: Draws, story: _Story) -> Balance:
    """Numbers of pulls whose roots are whole, or double one another."""
    often, seldom = rng.choice(((4, 1), (9, 1), (8, 2), (9, 4)))
    low, high = sorted(map(int, rng.distinct(2, 1, 9)))
    better, rarer = rng.sample(story.arms, 2) if rng.chance(Fraction(1, 2)) else rng.sample(story.arms, 2)[::-1]
    return Balance(
        pulls=_pulls(rng, (better, rarer), (often, seldom), (high, low)), between=(better, rarer), story=story.told
    )


def _preferences_drawn(rng: Draws, story: _Story) -> Preferences:
    """Preferences whose exponentials are whole numbers, and another reward than the mean of those before it."""
    arms = story.arms[: rng.choice((2, 3))]
    count = rng.choice((3, 4, 5))
    mean = 2 + rng.below(5)
    rewards = _rewards(rng, count, mean)
    weights = rng.shuffled((1, 2, 3))[: len(arms)]
    return Preferences(
        pulls=tuple(Pull(rng.choice(arms), reward) for reward in rewards),
        preferences={a: Logarithm(f"ln {w}") if w > 1 else Fraction(0) for a, w in zip(arms, weights, strict=True)},
        alpha=rng.fraction("1/2", "1/4", "1/10", "1/5"),
        pulled=Pull(rng.choice(arms), mean + rng.nonzero(-2, 4)),
        story=story.told,
    )


def question(given: Given) -> Question:
    """The pulls, then what is asked of that kind of bandit."""
    pulls = len(given.pulls)
    told = f"{given.story} " if given.story else ""
    blocks = (
        Paragraph(f"{told}These are the pulls of {_listed(given)} so far; $r_i$ is the reward of pull $i$:"),
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
            greedy = Part("Which arm does a greedy choice pull next?", Policy({NEXT: given.every_arm}, ""))
            return Question(
                (*blocks, *_untried(given, "a greedy choice leaves out what has none")), (_averages(given), greedy)
            )
        case Bounds():
            first = "UCB takes an arm that was never pulled before all others"
            return Question(
                (*blocks, _exploration(given), *_untried(given, first)), (_averages(given), *_bounds(given))
            )
        case Balance():
            return Question((*blocks, _weighed(given)), (_averages(given), *_balance(given)))
        case Preferences():
            return Question((*blocks, *_preferences(given)), _gradient_step(given))


def _listed(given: Bandit) -> str:
    """How many arms there are; by name, where the pulls do not name them all."""
    named = isinstance(given, Averaged) and given.untried
    return f"a bandit with {len(given.every_arm)} arms" + (f", {joined([*given.every_arm])}" if named else "")


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


#: The bound as it is given: another root is as common, and then another arm wins.
_BOUND = "$U(a) = Q(a) + c √({ln t}/{N(a)})$, where arm $a$ was pulled $N(a)$ times,"


def _exploration(given: Bounds) -> Block:
    return Paragraph(
        f"The next arm is chosen at time $t = {len(given.pulls) + 1}$ by its upper confidence bound (UCB), "
        f"{_BOUND} with $c = {shown(given.c)}$."
    )


def _bounds(given: Bounds) -> tuple[Part, ...]:
    return (
        Part(f"What is the upper confidence bound $U(a)$ of {_pulled(given)}?", Values("U", given.tried)),
        Part("Which arm does UCB pull next?", Policy({NEXT: given.every_arm}, "")),
    )


def _weighed(given: Balance) -> Block:
    return Paragraph(
        f"The next arm is chosen at time $t = {len(given.pulls) + 1}$ by its upper confidence bound (UCB), "
        f"{_BOUND} with $c > 0$."
    )


def _balance(given: Balance) -> tuple[Part, ...]:
    better, rarer = given.between
    return (
        Part(f"For which $c$ are the upper confidence bounds of {better} and {rarer} equal?", Number()),
        Part(
            f"Which of {joined(list(_in_order(given)))} has the greater bound if $c$ is greater than that?",
            Policy({NEXT: _in_order(given)}, ""),
        ),
    )


def _in_order(given: Balance) -> tuple[str, ...]:
    return tuple(arm for arm in given.every_arm if arm in given.between)


def _preferences(given: Preferences) -> tuple[Block, ...]:
    pulls = len(given.pulls)
    return (
        Paragraph("A gradient bandit has these preferences after these pulls:"),
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
        Part(f"With what probability $π(a)$ was each arm chosen at pull ${last}$?", Values("π", arms)),
        Part(f"What is the preference $H(a)$ of every arm after pull ${last}$?", Values("H", arms)),
    )
