"""The values of the visited states after Monte Carlo updates from one episode, first visit or every visit."""

from typing import Literal

from pydantic import Field

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter
from rldrill.problems.family import Question
from rldrill.problems.models import values_table
from rldrill.problems.parts import Number, Numbers, Part, Values
from rldrill.problems.phrases import in_open
from rldrill.problems.runs import Episode, ValueRun, draw_episode, run_situation, values_asked
from rldrill.problems.settings import draw_setting

TITLE = "Monte Carlo prediction"
SOURCE = "Sutton & Barto 2018, sections 5.1 and 6.1"
REVISION = 1


class Given(ValueRun):
    """An episode, the values before it, the step size, the discount, and which visits count."""

    trajectory: Episode = Field(description="The episode.")
    visits: Literal["first", "every"] = Field(
        description="Whether only the first visit to a state counts, or every visit."
    )

    @property
    def in_parts(self) -> bool:
        """Whether the returns are a part of their own; they say nothing about an open α."""
        return not isinstance(self.alpha, Parameter)

    @property
    def revisits(self) -> bool:
        """Whether a state is visited more than once."""
        return len(self.visited) < len(self.trajectory.rewards)

    @property
    def counted(self) -> tuple[int, ...]:
        """The times of the visits that count: the first of each state, or all."""
        states = self.trajectory.states[:-1]
        return tuple(time for time, state in enumerate(states) if self.visits == "every" or states.index(state) == time)


def draw(level: int, rng: Draws) -> Given:
    """Two steps; then four that come back to a state; then the same with γ left open."""
    setting = draw_setting(rng)
    first, second, third = rng.shuffled(setting.states)[:3]
    tours = ((first, second, first, third), (first, second, third, first), (first, second, third, second))
    states = (first, second) if level == 1 else rng.choice(tours)
    return Given(
        trajectory=draw_episode(rng, states, setting.terminal),
        values={state: rng.nonzero(-4, 10) for state in setting.states if state in states},
        alpha=rng.fraction("1/2", "1/4", "1/10") if level < 3 else rng.fraction("1/2", "1/4"),
        gamma=Parameter("gamma") if level == 3 else rng.fraction("1/2", "4/5"),
        visits=rng.choice(("first", "every")),
    )


def question(given: Given) -> Question:
    """The returns first, then the updated values; in an open α the values alone."""
    order = (
        "Only the first visit to a state in the episode counts: first-visit Monte Carlo."
        if given.visits == "first"
        else "Every visit to a state counts: every-visit Monte Carlo."
    )
    blocks = (
        *run_situation(given, values_table(given.values)),
        Paragraph(
            f"{order} All returns are computed when the episode is over. Then the updates are made in the order of "
            "the visits, each with the value that is current then."
        ),
    )
    tail = in_open(given)
    values = f"What is {values_asked(given)} after the updates{tail}?"
    if not given.in_parts:
        return Question(blocks, (Part(values, Values("V", given.visited)),))
    entries = tuple(f"R_{{{time}}}" for time in range(len(given.trajectory.rewards)))
    if len(entries) == 1:
        returns = Part(f"What is the return ${entries[0]}${tail}?", Number())
    else:
        listed = ", ".join(entries) if len(entries) < 4 else f"{entries[0]}, …, {entries[-1]}"
        returns = Part(f"What are the returns ${listed}$, in this order{tail}?", Numbers(entries))
    return Question(blocks, (returns, Part(values, Values("V", given.visited))))
