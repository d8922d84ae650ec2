"""The targets of Sarsa and of Q-learning on the same run, and which of the two is on-policy."""

from typing import Literal, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.family import Question
from rldrill.problems.parts import Choice, Number, Numbers, Part
from rldrill.problems.phrases import in_open
from rldrill.problems.runs import ActionRun, action_values_table, draw_action_run, run_situation

TITLE = "Sarsa versus Q-learning"
SOURCE = "Sutton & Barto 2018, sections 6.4 and 6.5"
REVISION = 1

#: What the last part may be answered with.
METHODS = {"A": "Sarsa", "B": "Q-learning", "C": "both", "D": "neither"}
_MEANING = {
    "on-policy": "learns the values of the very policy that chooses its actions",
    "off-policy": "learns the values of another policy than the one that chooses its actions",
}


class Given(ActionRun):
    """A run with all its actions, the action values before it, α and γ; and which word the last part asks about."""

    word: Literal["on-policy", "off-policy"] = Field(
        default="on-policy", description="The word that the last part asks about."
    )

    @model_validator(mode="after")
    def _bootstraps(self) -> Self:
        self.demand_last_action("Sarsa")
        return self


def draw(level: int, rng: Draws) -> Given:
    """One transition; then three that come back to a state; then five over three states."""
    visits = {1: "ab", 2: "abab", 3: "abacb."}[level]
    trajectory, values = draw_action_run(rng, visits, 2 if level == 1 else 3)
    return Given(
        trajectory=trajectory,
        values=values,
        alpha=rng.fraction("1/2", "1/4"),
        gamma=rng.fraction("1/2", "4/5", "9/10") if level < 3 else rng.fraction("1/2", "4/5"),
        word=rng.choice(("on-policy", "off-policy")),
    )


def question(given: Given) -> Question:
    """The run and the table before it; the targets of both methods, then the word for one of them."""
    steps = len(given.trajectory.rewards)
    blocks = (
        *run_situation(given, action_values_table(given.values)),
        Paragraph(
            "Sarsa and Q-learning both learn from this run, each with a copy of this table for itself, which it "
            "updates after every transition. A target is what an update moves $Q(s_t, a_t)$ towards."
        ),
    )
    kind = Number() if steps == 1 else Numbers(tuple(f"y_{{{time}}}" for time in range(steps)))
    asked = "What is the target $y_0$" if steps == 1 else f"What are the targets $y_0, …, y_{{{steps - 1}}}$"
    return Question(
        blocks,
        (
            Part(f"{asked} of Sarsa{in_open(given)}?", kind),
            Part(f"{asked} of Q-learning{in_open(given)}?", kind),
            Part(f"Which of the two is {given.word}, so that it {_MEANING[given.word]}?", Choice(METHODS)),
        ),
    )
