"""The targets of Sarsa and of Q-learning on the same run, or the step size from one; which of the two is on-policy."""

from collections.abc import Mapping
from typing import Any, Literal, NamedTuple, Self

from msgspec.structs import replace
from pydantic import Field, model_validator

from rldrill.problems.asking_back import Rates, Rows, Worth, draw_forward, draw_rates, updates_of
from rldrill.problems.document import Paragraph, joined
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, shown
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.models import Name
from rldrill.problems.parts import Choice, Number, Numbers, Part
from rldrill.problems.phrases import in_open, not_known
from rldrill.problems.runs import ActionRun, Trajectory, action_values_table, run_situation

TITLE = "Sarsa versus Q-learning"
SOURCE = "Sutton & Barto 2018, sections 6.4 and 6.5"
REVISION = 8
DISTRACTORS = (
    "values.*",  # a table has the values of other pairs, too
    "alpha",  # it is printed only where a value that it has moved is used
    "instead.2",  # "neither" is an answer, too
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


class Other(NamedTuple):
    """What a pair might have been worth before the run instead."""

    state: Name
    action: Name
    value: Exact


class Given(ActionRun):
    """A run with all its actions, the action values before it, α and γ; and what the last part asks about.

    That is a word, or whose targets would change with ``instead``, another value of a pair before the run.
    """

    word: Word = Field(default="on-policy", description="The word that the last part asks about.")
    instead: Other | None = Field(
        default=None,
        exclude_if=lambda instead: instead is None,
        description="Another action value before the run: instead of a word it is asked whose targets it would change.",
        examples=[["B", "left", 3]],
    )
    known: Exact | None = Field(
        default=None,
        exclude_if=lambda known: known is None,
        description="Sarsa's first target that reads an updated value, where alpha is left open and asked for instead.",
    )

    @model_validator(mode="after")
    def _bootstraps(self) -> Self:
        self.demand_last_action("Sarsa")
        if self.instead is not None and self.instead.action not in self.values.get(self.instead.state, {}):
            raise ValueError(f"instead: {self.instead.action!r} has no value in {self.instead.state!r}; add it")
        if self.instead is not None and self.changed == self.values:
            raise ValueError("instead: that is the value that it has; give another one")
        if self.instead is not None and self.gamma == 0:
            raise ValueError("instead: with γ = 0 no value counts; give a discount above 0")
        if self.known is None:
            return self
        if not isinstance(self.alpha, Parameter):
            raise ValueError("known: leave alpha open, which is asked for then")
        if first_that_reads_again(self.trajectory) is None:
            raise ValueError("known: no target of Sarsa reads an updated value, so alpha does not follow; leave it out")
        return self

    @property
    def changed(self) -> Rows:
        """The action values before the run with the one that might have been."""
        state, action, value = self.instead or Other("", "", Fraction(0))
        return {name: {**row, **({action: value} if name == state else {})} for name, row in self.values.items()}

    def parameters(self) -> tuple[str, ...]:
        """The letters that answers are expressions in: not the step size that is asked for."""
        left_open = self.left_open
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
    if level == 1:
        return given
    sarsa, q_learning = (_targets(found, worth) for worth in (_taken, _best))
    again = first_that_reads_again(given.trajectory) or 0
    if sarsa[again] == q_learning[again] or not all(_is_read_again(found, worth) for worth in (_taken, _best)):
        return draw(level, rng)
    if level == 2:
        return given
    instead = _other_value(rng, found, rng.choice(tuple(METHODS)))
    if instead is None or sarsa[again] == 0:
        return draw(level, rng)
    sought = {"known": sarsa[again], "alpha": Parameter("alpha"), "instead": instead}
    return Given(**found).model_copy(update=sought)


def _other_value(rng: Draws, found: Mapping[str, Any], wanted: str) -> Other | None:
    """Another value in a state that is entered, by which only the targets of the methods of that letter change."""
    values: Rows = found["values"]
    right = [_targets(found, worth) for worth in (_taken, _best)]
    entered = dict.fromkeys(found["trajectory"].states[1:])
    for state, action in rng.shuffled([(name, action) for name in entered for action in values.get(name, ())]):
        value = values[state][action] + rng.nonzero(-3, 3) * found["gamma"].denominator
        if not value or value in values[state].values():
            continue
        other = {**found, "values": {**values, state: {**values[state], action: value}}}
        sarsa, q_learning = (_targets(other, worth) != old for worth, old in zip((_taken, _best), right, strict=True))
        if method(sarsa=sarsa, q_learning=q_learning) == wanted:
            return Other(state, action, value)
    return None


def method(*, sarsa: bool, q_learning: bool) -> str:
    """The letter of the option that names these methods."""
    return "DABC"[sarsa + 2 * q_learning]


def _sought_rates(rng: Draws) -> Rates:
    """A step size that is not guessed, and a discount."""
    alpha = rng.fraction("1/2", "1/3", "2/3", "1/4", "3/4", "1/5", "2/5", "3/5")
    gamma = rng.fraction(*(number for number in ("1/2", "1/4", "3/4") if fraction_of(number) != alpha))
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


def comes_back(run: Trajectory) -> bool:
    """Whether a target uses the row of a state that was updated before: only then is the step size printed."""
    return any(run.states[time + 1] in run.states[:time] for time in range(1, len(run.rewards)))


def question(given: Given) -> Question:
    """The run and the table before it; the targets of both methods, or the step size; then the word for one of them."""
    run = given.trajectory
    steps = len(run.rewards)
    situation = run_situation(given, action_values_table(given.values), steps=comes_back(run))
    if given.known is not None:
        situation = tuple(
            Paragraph(not_known(block.text)) if isinstance(block, Paragraph) else block for block in situation
        )
    learn = (
        "Sarsa and Q-learning both learn from this transition."
        if steps == 1
        else "Sarsa and Q-learning both learn from this run, each with its own copy of this table, which it updates "
        "after every transition."
    )
    target = f"The target $y_{0 if steps == 1 else 't'}$ is what the update moves"
    updated = "$Q(s_0, a_0)$" if steps == 1 else "$Q(s_t, a_t)$"
    blocks = (*situation, Paragraph(f"{learn} {target} {updated} towards."))
    sarsa, q_learning = (_targets_asked(given, steps, method) for method in ("Sarsa", "Q-learning"))
    if given.known is not None:
        told = f"Sarsa's target is $y_{{{first_that_reads_again(run)}}} = {shown(given.known)}$."
        sarsa = Part(f"{told} What is the step size $α$?", Number())
        q_learning = replace(q_learning, ask=f"With this step size, {q_learning.ask[0].lower()}{q_learning.ask[1:]}")
    return Question(blocks, (sarsa, q_learning, Part(_last_asked(given), Choice(METHODS))))


def _last_asked(given: Given) -> str:
    if given.instead is None:
        return f"Which of the two is {given.word}: which one {_MEANING[given.word]}?"
    state, action, value = given.instead
    rate = " With the same step size, which" if given.known is not None else " Which"
    return (
        f'Suppose that $Q("{state}", "{action}")$ had been ${shown(value)}$ before the first update.{rate} of the two '
        "would have had another target at some time $t$?"
    )


def _targets_asked(given: Given, steps: int, method: str) -> Part:
    """The part that asks for all targets of a method."""
    if steps == 1:
        return Part(f"What is the target $y_0$ of {method}{in_open(given)}?", Number())
    names = tuple(f"y_{{{time}}}" for time in range(steps))
    told = joined([f"${name}$" for name in names])
    return Part(f"What are the targets {told} of {method}{in_open(given)}?", Numbers(names))
