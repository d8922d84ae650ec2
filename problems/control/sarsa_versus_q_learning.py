"""The targets of Sarsa and of Q-learning on the same run, and which of the two is on-policy."""

from typing import Literal, Self

from pydantic import Field, model_validator

from rldrill.problems.asking_back import draw_forward
from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter
from rldrill.problems.family import Question
from rldrill.problems.parts import Choice, Number, Numbers, Part
from rldrill.problems.phrases import in_open
from rldrill.problems.runs import ActionRun, Trajectory, action_values_table, run_situation

TITLE = "Sarsa versus Q-learning"
SOURCE = "Sutton & Barto 2018, sections 6.4 and 6.5"
REVISION = 6
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
#: A word for each answer is as likely as for any other.
_WORDS: tuple[tuple[Word, ...], ...] = (
    ("on-policy",), ("off-policy",), ("model-free", "bootstrapping"), ("model-based", "a Monte Carlo method"),
)  # fmt: skip


class Given(ActionRun):
    """A run with all its actions, the action values before it, α and γ; and which word the last part asks about."""

    word: Word = Field(default="on-policy", description="The word that the last part asks about.")

    @model_validator(mode="after")
    def _bootstraps(self) -> Self:
        self.demand_last_action("Sarsa")
        return self


def draw(level: int, rng: Draws) -> Given:
    """One transition; then some that come back to a state; then some with γ left open."""
    visits = {1: ("ab",), 2: ("aba", "abac", "abcb", "aba."), 3: ("abc", "abc.", "abcd")}[level]
    found = draw_forward(rng, rng.choice(visits), 2 if level == 1 else 3, lambda row, _: max(row.values()))
    if len({tuple(row.values()) for row in found["values"].values()}) < len(found["values"]):
        return draw(level, rng)
    if level == 3:
        found["gamma"] = Parameter("gamma")
    return Given(**found, word=rng.choice(rng.choice(_WORDS)))


def _comes_back(run: Trajectory) -> bool:
    """Whether a target uses the row of a state that was updated before: only then does the step size matter."""
    return any(run.states[time + 1] in run.states[:time] for time in range(1, len(run.rewards)))


def question(given: Given) -> Question:
    """The run and the table before it; the targets of both methods, then the word for one of them."""
    steps = len(given.trajectory.rewards)
    blocks = (
        *run_situation(given, action_values_table(given.values), steps=_comes_back(given.trajectory)),
        Paragraph(
            "Sarsa and Q-learning both learn from this run, each with its own copy of this table, which it "
            "updates after every transition. The target $y_t$ is what the update moves $Q(s_t, a_t)$ towards."
        ),
    )
    targets = "$y_0$ and $y_1$" if steps == 2 else f"$y_0, …, y_{{{steps - 1}}}$"
    kind = Number() if steps == 1 else Numbers(tuple(f"y_{{{time}}}" for time in range(steps)))
    asked = "What is the target $y_0$" if steps == 1 else f"What are the targets {targets}"
    return Question(
        blocks,
        (
            Part(f"{asked} of Sarsa{in_open(given)}?", kind),
            Part(f"{asked} of Q-learning{in_open(given)}?", kind),
            Part(f"Which of the two is {given.word}: which one {_MEANING[given.word]}?", Choice(METHODS)),
        ),
    )
