"""The targets of Sarsa and of Q-learning on the same run, or the step size from one; which of the two is on-policy."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Literal, Self

from pydantic import Field, model_validator

from rldrill.problems.asking_back import Rates, Worth, draw_forward, draw_rates, updates_of
from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, shown
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.parts import Choice, Number, Numbers, Part
from rldrill.problems.phrases import in_open, not_known
from rldrill.problems.runs import ActionRun, Trajectory, action_values_table, run_situation

TITLE = "Sarsa versus Q-learning"
SOURCE = "Sutton & Barto 2018, sections 6.4 and 6.5"
REVISION = 7
DISTRACTORS = (
    "values.*",  # a table has the values of other pairs, too
    "alpha",  # it is printed only where a value that it has moved is used
)

#: What the last part may be answered with.
METHODS = {"A": "Sarsa", "B": "Q-learning", "C": "both", "D": "neither"}
#: What the words of the last part mean.
_MEANING = {
    "on-policy": "learns the values of the very policy that chooses its actions",
    "off-policy": "learns the values of another policy than the one that chooses its actions",
    "model-free": "learns without knowing the transition probabilities",
    "bootstrapping": "has current estimates in its targets",
    "model-based": "plans with transition probabilities that it knows or learns",
    "a Monte Carlo method": "has to wait for the end of the episode before it learns",
}
Word = Literal["on-policy", "off-policy", "model-free", "bootstrapping", "model-based", "a Monte Carlo method"]
#: The largest denominator of a target.
_FINEST = 20
#: A word for each answer is as likely as for any other.
_WORDS: tuple[tuple[Word, ...], ...] = (
    ("on-policy",), ("off-policy",), ("model-free", "bootstrapping"), ("model-based", "a Monte Carlo method"),
)  # fmt: skip


class Given(ActionRun):
    """A run with all its actions, the action values before it, α and γ; and which word the last part asks about."""

    word: Word = Field(default="on-policy", description="The word that the last part asks about.")
    known: Exact | None = Field(
        default=None,
        exclude_if=lambda known: known is None,
        description="Sarsa's first target that reads an updated value, where alpha is left open and asked for instead.",
    )

    @model_validator(mode="after")
    def _bootstraps(self) -> Self:
        self.demand_last_action("Sarsa")
        if self.known is None:
            return self
        if not isinstance(self.alpha, Parameter):
            raise ValueError("known: leave alpha open, which is asked for then")
        if first_that_reads_again(self.trajectory) is None:
            raise ValueError("known: no target of Sarsa reads an updated value, so alpha does not follow; leave it out")
        return self

    def parameters(self) -> tuple[str, ...]:
        """The letters that answers are expressions in: not the step size that is asked for."""
        left_open = super().parameters()
        return left_open if self.known is None else tuple(name for name in left_open if name != "alpha")


def first_that_reads_again(run: Trajectory) -> int | None:
    """The time of the first target of Sarsa that reads an updated value, if there is one."""
    pairs = [*zip(run.states, run.actions, strict=False)]
    return next((t for t in range(1, len(run.rewards)) if t + 1 < len(pairs) and pairs[t + 1] in pairs[:t]), None)


def draw(level: int, rng: Draws) -> Given:
    """One transition; then some that come back to a pair; then the step size follows from a target."""
    visits = {1: ("ab",), 2: ("aba", "abac", "abcb", "aba."), 3: ("abac", "abcb", "aba.", "abab")}[level]
    rates = _sought_rates if level == 3 else draw_rates
    found = draw_forward(rng, rng.choice(visits), 2 if level == 1 else 3, _best, rates)
    given = Given(**found, word=rng.choice(rng.choice(_WORDS)))
    if len({tuple(row.values()) for row in given.values.values()}) < len(given.values):
        return draw(level, rng)
    if level > 1 and not all(_is_read_again(found, worth) for worth in (_taken, _best)):
        return draw(level, rng)
    if level < 3:
        return given
    known = _targets(found, _taken)[first_that_reads_again(given.trajectory) or 0]
    return given.model_copy(update={"known": known, "alpha": Parameter("alpha")}) if known else draw(level, rng)


def _sought_rates(rng: Draws) -> Rates:
    """A step size that is not guessed, and a discount."""
    alpha = rng.fraction("1/2", "1/3", "2/3", "1/4", "3/4", "1/5", "2/5", "3/5")
    gamma = rng.fraction(*(number for number in ("1/2", "1/4", "3/4") if Fraction(number) != alpha))
    return Rates(alpha, gamma, gamma.denominator)


def _best(row: Mapping[str, Fraction], _: str) -> Fraction:
    return max(row.values())


def _taken(row: Mapping[str, Fraction], action: str) -> Fraction:
    return row[action]


def _targets(found: Mapping[str, Any], worth: Worth) -> list[Fraction]:
    """The targets along a run."""
    rewards = found["trajectory"].rewards
    ahead = [update.ahead for update in updates_of(found, worth)]
    return [reward + found["gamma"] * value for reward, value in zip(rewards, ahead, strict=True)]


def _is_read_again(found: Mapping[str, Any], worth: Worth) -> bool:
    """Whether somebody who keeps the old table finds other targets; and whether the right ones are easily read."""
    kept = _targets({**found, "alpha": Fraction(0)}, worth)
    right = _targets(found, worth)
    return right != kept and all(target.denominator <= _FINEST for target in right)


def _comes_back(run: Trajectory) -> bool:
    """Whether a target uses the row of a state that was updated before: only then does the step size matter."""
    return any(run.states[time + 1] in run.states[:time] for time in range(1, len(run.rewards)))


def question(given: Given) -> Question:
    """The run and the table before it; the targets of both methods, or the step size; then the word for one of them."""
    run = given.trajectory
    steps = len(run.rewards)
    situation = run_situation(given, action_values_table(given.values), steps=_comes_back(run))
    if given.known is not None:
        situation = tuple(
            Paragraph(not_known(block.text)) if isinstance(block, Paragraph) else block for block in situation
        )
    blocks = (
        *situation,
        Paragraph(
            "Sarsa and Q-learning both learn from this run, each with its own copy of this table, which it "
            "updates after every transition. The target $y_t$ is what the update moves $Q(s_t, a_t)$ towards."
        ),
    )
    sarsa, q_learning = (_targets_asked(given, steps, method) for method in ("Sarsa", "Q-learning"))
    if given.known is not None:
        told = f"Sarsa's target is $y_{{{first_that_reads_again(run)}}} = {shown(given.known)}$."
        sarsa = Part(f"{told} What is the step size $α$?", Number())
        q_learning = replace(q_learning, ask=f"With this step size, {q_learning.ask[0].lower()}{q_learning.ask[1:]}")
    word = Part(f"Which of the two is {given.word}: which one {_MEANING[given.word]}?", Choice(METHODS))
    return Question(blocks, (sarsa, q_learning, word))


def _targets_asked(given: Given, steps: int, method: str) -> Part:
    """The part that asks for all targets of a method."""
    if steps == 1:
        return Part(f"What is the target $y_0$ of {method}{in_open(given)}?", Number())
    names = tuple(f"y_{{{time}}}" for time in range(steps))
    told = "$y_0$ and $y_1$" if steps == 2 else f"$y_0, …, y_{{{steps - 1}}}$"
    return Part(f"What are the targets {told} of {method}{in_open(given)}?", Numbers(names))
